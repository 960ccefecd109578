//! The error for a crossed limit: the proportion, the excess, and the remedy.

use super::family::Proportion;
use brillianteer_base::Unit;
use brillianteer_math::as_written;
use std::f64::consts::FRAC_PI_2;

/// The reason why no cut of a family can have the given proportions. The message names the proportion by its key in cut
/// files; [`by_name`](Self::by_name) has the same message with the name that people read.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("{}: {}", self.row().key, self.statement())]
pub enum ProportionError {
    /// A number that is NaN or infinite.
    NotFinite {
        /// The proportion at fault.
        row: &'static Proportion,
        /// The value as given.
        value: f64,
    },
    /// A value below its lower limit.
    TooSmall(Limit),
    /// A value above its upper limit.
    TooLarge(Limit),
}

impl ProportionError {
    /// Returns the proportion at fault, given or derived.
    pub fn row(&self) -> &'static Proportion {
        match self {
            Self::NotFinite { row, .. } => row,
            Self::TooSmall(limit) | Self::TooLarge(limit) => limit.row,
        }
    }

    /// Returns the message with the name of the proportion, as panels show it.
    pub fn by_name(&self) -> String {
        format!("{}: {}", self.row().name, self.statement())
    }

    /// Returns the fault in words, without the proportion.
    fn statement(&self) -> String {
        match self {
            Self::NotFinite { value, .. } => {
                format!("{value} is not a finite number; write what was measured")
            }
            Self::TooSmall(limit) => limit.text("above", "at least", "raise"),
            Self::TooLarge(limit) => limit.text("below", "at most", "lower"),
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
    /// The proportion at fault, given or derived.
    pub row: &'static Proportion,
    /// The value as given.
    pub value: f64,
    /// The limit, in the same unit as the value.
    pub limit: f64,
    /// True where the limit itself is allowed.
    pub inclusive: bool,
    /// The event at the limit, as a clause for the message.
    pub reason: &'static str,
    /// The tier of the facets for which no room is left; empty where the reason alone explains the limit.
    pub tier: &'static str,
}

impl Limit {
    /// Returns the event at the limit, as a clause for a message. Reasons say "beyond" of either side; the clause
    /// says "above" of a maximum and "below" of a minimum.
    pub fn clause(&self) -> String {
        let side = if self.value > self.limit { "above which" } else { "below which" };
        let reason = self.reason.replacen("beyond which", side, 1);
        match self.tier {
            "" => reason,
            tier => format!("{reason} for the facets '{tier}'"),
        }
    }

    /// Returns the words for a change by at least so much; none for a change beyond all numbers.
    fn step(step: f64) -> String {
        if step.is_finite() { format!(" by at least {}", rounded(step)) } else { String::new() }
    }

    fn text(&self, open: &str, closed: &str, change: &str) -> String {
        let Self { row: Proportion { unit, .. }, value, limit, inclusive, .. } = *self;
        let gap = (value - limit).abs();
        let near = gap < 0.01;
        let limit = if near || limit.abs() < 0.005 { as_written(limit) } else { rounded(limit) };
        let side = if inclusive { closed } else { open };
        let step = if inclusive { (gap * 100.0).ceil() } else { (gap * 100.0).floor() + 1.0 } / 100.0;
        let value = as_written(if near { value } else { four_decimals(value) });
        let (step, hint) = (Self::step(step), self.unit_hint());
        format!("{value}{unit} must be {side} {limit}{unit}, {}; {change} it{step}{hint}", self.clause())
    }

    /// Returns a hint with the value in the proper unit, where the given one looks like a fraction or radians.
    fn unit_hint(&self) -> String {
        let Self { value, limit, .. } = *self;
        let too_small = value > 0.0 && value < limit;
        match self.row.unit {
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

/// Formats a number to two decimals, without trailing zeros.
pub(super) fn rounded(value: f64) -> String {
    as_written((value * 100.0).round() / 100.0)
}

/// Rounds a number to four decimals. Numbers beyond 1e12 have none to round off.
fn four_decimals(value: f64) -> f64 {
    if value.abs() < 1e12 { (value * 1e4).round() / 1e4 } else { value }
}

#[cfg(test)]
mod tests {
    use super::super::round_brilliant::{Crown, MODERN, RoundBrilliant};
    use super::super::round_brilliant_table::{ROUND_BRILLIANT, least_star_length};
    use super::Limit;

    fn text(given: RoundBrilliant) -> String {
        given.derived().unwrap_err().to_string()
    }

    #[test]
    fn a_minimum_is_what_nothing_fits_below_and_a_maximum_above() {
        let row = ROUND_BRILLIANT.proportion("table").unwrap();
        let clause = |value| {
            let reason = "beyond which no room is left";
            Limit { row, value, limit: 50.0, inclusive: true, reason, tier: "star" }.clause()
        };
        assert_eq!(clause(40.0), "below which no room is left for the facets 'star'");
        assert_eq!(clause(60.0), "above which no room is left for the facets 'star'");
    }

    #[test]
    fn fractions_and_radians_are_recognised() {
        let fraction = RoundBrilliant { table: 0.53, ..MODERN };
        assert!(text(fraction).ends_with("(the unit is percent, so 53.0 if a fraction was meant)"));
        let radians = RoundBrilliant { crown: Crown::Angle(34.5_f64.to_radians()), ..MODERN };
        assert!(text(radians).ends_with("(the unit is degrees, so 34.5 if radians were meant)"));
    }

    #[test]
    fn a_number_beyond_all_measure_has_no_step_and_few_digits() {
        let given = RoundBrilliant { star_length: 1e308, ..MODERN };
        assert!(text(given).contains("1e308 % must be below 100 %"), "{}", text(given));
        assert!(!text(given).contains("inf"), "{}", text(given));
    }

    #[test]
    fn a_limit_missed_by_a_hair_is_written_in_full() {
        let least = least_star_length(56.0);
        let given = RoundBrilliant { star_length: least, ..MODERN };
        assert!(text(given).contains(&format!("{least} % must be above {least} %")), "{}", text(given));
        assert!(text(given).ends_with("raise it by at least 0.01"));
    }
}
