//! Numbers that people set, each as one row that panels, files, options, errors and documents read.

use super::Unit;
use std::fmt;

/// A number of a `T` that people set.
pub struct NumberRow<T> {
    /// The key in files.
    pub key: &'static str,
    /// The name in panels.
    pub name: &'static str,
    /// The unit.
    pub unit: Unit,
    /// The least and the greatest value.
    pub range: [f64; 2],
    /// The part of the range over which a slider runs.
    pub span: [f64; 2],
    /// The step of a slider; 0 for none.
    pub step: f64,
    /// The number of decimals that a field shows.
    pub decimals: usize,
    /// What the number is, in a sentence or two.
    pub meaning: &'static str,
    /// Returns the number; `None` where it is not stated, so that another number stands in its place.
    pub get: fn(&T) -> Option<f64>,
    /// Sets the number, whether it is in its range or not.
    pub set: fn(&mut T, f64),
}

impl<T> NumberRow<T> {
    /// Makes a row whose slider runs over the whole range, by hundredths, or by ones where the number is a count.
    pub const fn new(
        key: &'static str,
        name: &'static str,
        unit: Unit,
        range: [f64; 2],
        meaning: &'static str,
        get: fn(&T) -> Option<f64>,
        set: fn(&mut T, f64),
    ) -> Self {
        let (step, decimals) = if matches!(unit, Unit::Count) { (1.0, 0) } else { (0.01, 2) };
        Self { key, name, unit, range, span: range, step, decimals, meaning, get, set }
    }

    /// Returns whether the number may have a value.
    pub fn allows(&self, value: f64) -> bool {
        let [least, most] = self.range;
        (least..=most).contains(&value) && (self.unit != Unit::Count || value.fract() == 0.0)
    }

    /// Checks that the number may have a value.
    ///
    /// # Errors
    /// Fails where the value is out of the range, not finite, or no whole number where one is expected.
    pub fn check(&self, value: f64) -> Result<(), NumberError> {
        let Self { key, unit, range, .. } = *self;
        if self.allows(value) { Ok(()) } else { Err(NumberError { key, value, unit, range }) }
    }

    /// Returns the range and the unit in words, such as `0 to 64 mm`.
    pub fn hint(&self) -> String {
        let ([least, most], unit) = (self.range, self.unit.name());
        format!("{least} to {most} {unit}").trim_end().to_owned()
    }
}

impl<T> fmt::Debug for NumberRow<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("NumberRow").field("key", &self.key).finish_non_exhaustive()
    }
}

/// A number may not have a value.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub struct NumberError {
    /// The key of the number.
    pub key: &'static str,
    /// The value.
    pub value: f64,
    /// The unit.
    pub unit: Unit,
    /// The least and the greatest value.
    pub range: [f64; 2],
}

impl fmt::Display for NumberError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { key, value, unit, range: [least, most] } = self;
        let whole = if *unit == Unit::Count { "a whole number " } else { "" };
        let unit = if unit.name().is_empty() { String::new() } else { format!(" {}", unit.name()) };
        write!(f, "{key}: {value} must be {whole}from {least} to {most}{unit}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROW: NumberRow<f64> = NumberRow::new(
        "height_mm",
        "Height",
        Unit::Millimetres,
        [0.0, 64.0],
        "The height.",
        |height| Some(*height),
        |height, value| *height = value,
    );

    #[test]
    fn values_beyond_the_range_are_refused_and_so_are_parts_of_a_count() {
        assert_eq!((ROW.check(0.0), ROW.check(64.0), ROW.allows(f64::NAN)), (Ok(()), Ok(()), false));
        assert_eq!(ROW.check(-1.5).unwrap_err().to_string(), "height_mm: -1.5 must be from 0 to 64 mm");
        let count = NumberRow { key: "steps", unit: Unit::Count, ..ROW };
        assert_eq!(
            count.check(2.5).unwrap_err().to_string(),
            "steps: 2.5 must be a whole number from 0 to 64"
        );
        assert_eq!(
            (count.check(2.0), ROW.hint(), count.hint()),
            (Ok(()), "0 to 64 mm".into(), "0 to 64".into())
        );
    }
}
