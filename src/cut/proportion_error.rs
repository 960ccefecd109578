//! The error for a crossed limit: which proportion crosses it, by how much, and what to change.

use std::f64::consts::FRAC_PI_2;
use std::fmt;

/// The reason why no round brilliant can have the given proportions.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ProportionError {
    /// A number that is NaN or infinite.
    #[error("{key}: {value} is not a finite number; write what was measured")]
    NotFinite {
        /// The proportion at fault, by its key in a cut file.
        key: &'static str,
        /// The value as given.
        value: f64,
    },
    /// A value below its lower limit.
    #[error("{}", .0.text("above", "at least", "raise"))]
    TooSmall(Limit),
    /// A value above its upper limit.
    #[error("{}", .0.text("below", "at most", "lower"))]
    TooLarge(Limit),
}

impl ProportionError {
    /// Returns the proportion at fault, by its key in a cut file, or `total_depth`.
    pub fn key(&self) -> &'static str {
        match self {
            Self::NotFinite { key, .. } => key,
            Self::TooSmall(limit) | Self::TooLarge(limit) => limit.key,
        }
    }

    /// Returns the limit that is crossed; `None` for a number that is not finite.
    pub fn limit(&self) -> Option<&Limit> {
        match self {
            Self::NotFinite { .. } => None,
            Self::TooSmall(limit) | Self::TooLarge(limit) => Some(limit),
        }
    }
}

/// A limit, and the value that crosses it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limit {
    /// The proportion at fault, by its key in a cut file, or `total_depth`.
    pub key: &'static str,
    /// The value as given.
    pub value: f64,
    /// The limit, in the same unit as the value.
    pub limit: f64,
    /// The unit of the value and the limit.
    pub unit: Unit,
    /// Whether the limit itself is allowed.
    pub inclusive: bool,
    /// What happens at the limit, as a clause for the message.
    pub reason: &'static str,
}

/// The unit of a proportion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// Percent of the girdle diameter, or of what the key says.
    Percent,
    /// Degrees from the girdle plane.
    Degrees,
    /// A whole number.
    Count,
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Percent => " %",
            Self::Degrees => "°",
            Self::Count => "",
        })
    }
}

impl Limit {
    fn text(&self, open: &str, closed: &str, change: &str) -> String {
        let Self { key, value, limit, unit, inclusive, reason } = *self;
        let gap = (value - limit).abs();
        let near = gap < 0.01;
        let limit = if near { given(limit) } else { rounded(limit) };
        let side = if inclusive { closed } else { open };
        let step = if inclusive { (gap * 100.0).ceil() } else { (gap * 100.0).floor() + 1.0 } / 100.0;
        let value = given(if near { value } else { four_decimals(value) });
        let (step, hint) = (rounded(step), self.unit_hint());
        format!(
            "{key}: {value}{unit} must be {side} {limit}{unit}, {reason}; {change} it by at least {step}{hint}"
        )
    }

    /// Returns a hint with the value in the proper unit, where the given one looks like a fraction or radians.
    fn unit_hint(&self) -> String {
        let Self { value, limit, unit, .. } = *self;
        let too_small = value > 0.0 && value < limit;
        match unit {
            Unit::Percent if too_small && value <= 1.0 => {
                format!(
                    " (the unit is percent, so {:?} if a fraction was meant)",
                    four_decimals(100.0 * value)
                )
            }
            Unit::Degrees if too_small && value < FRAC_PI_2 => {
                format!(
                    " (the unit is degrees, so {:?} if radians were meant)",
                    four_decimals(value.to_degrees())
                )
            }
            _ => String::new(),
        }
    }
}

/// Formats a number as it was written, with an exponent instead of hundreds of digits.
pub(super) fn given(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 || (1e-4..1e7).contains(&size) { format!("{value}") } else { format!("{value:e}") }
}

/// Formats a number to two decimals, without trailing zeros.
pub(super) fn rounded(value: f64) -> String {
    given((value * 100.0).round() / 100.0)
}

/// Rounds a number to four decimals. Numbers beyond 1e12 have none to round off.
fn four_decimals(value: f64) -> f64 {
    if value.abs() < 1e12 { (value * 1e4).round() / 1e4 } else { value }
}

#[cfg(test)]
mod tests {
    use super::super::limits::least_star_length;
    use super::super::round_brilliant::{Crown, MODERN, RoundBrilliant};

    fn text(given: RoundBrilliant) -> String {
        given.derived().unwrap_err().to_string()
    }

    #[test]
    fn fractions_and_radians_are_recognised() {
        let fraction = RoundBrilliant { table: 0.53, ..MODERN };
        assert!(text(fraction).ends_with("(the unit is percent, so 53.0 if a fraction was meant)"));
        let radians = RoundBrilliant { crown: Crown::Angle(34.5_f64.to_radians()), ..MODERN };
        assert!(text(radians).ends_with("(the unit is degrees, so 34.5 if radians were meant)"));
    }

    #[test]
    fn a_limit_missed_by_a_hair_is_written_in_full() {
        let least = least_star_length(56.0);
        let given = RoundBrilliant { star_length: least, ..MODERN };
        assert!(text(given).contains(&format!("{least} % must be above {least} %")), "{}", text(given));
        assert!(text(given).ends_with("raise it by at least 0.01"));
    }
}
