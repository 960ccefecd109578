//! Units of the numbers that people set.

use std::fmt;

/// The unit of a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// Percent of the girdle diameter, or of the quantity that the row names.
    Percent,
    /// Degrees from the girdle plane, or from the one that the row names.
    Degrees,
    /// Millimetres.
    Millimetres,
    /// Stops of exposure: one more is twice the light.
    Stops,
    /// A whole number.
    Count,
    /// A quotient, a part of something, or an exponent.
    Ratio,
}

impl Unit {
    /// Returns the name of the unit; those of a count and a ratio are empty.
    pub fn name(self) -> &'static str {
        match self {
            Self::Percent => "percent",
            Self::Degrees => "degrees",
            Self::Millimetres => "mm",
            Self::Stops => "stops",
            Self::Count | Self::Ratio => "",
        }
    }

    /// Returns what is written behind a number of the unit, such as `°`, with the space before it.
    pub fn suffix(self) -> &'static str {
        match self {
            Self::Percent => " %",
            Self::Degrees => "°",
            Self::Millimetres => " mm",
            Self::Stops => " stops",
            Self::Count | Self::Ratio => "",
        }
    }
}

impl fmt::Display for Unit {
    /// Writes what is written behind a number of the unit.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.suffix())
    }
}
