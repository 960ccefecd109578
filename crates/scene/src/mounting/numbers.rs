//! The numbers that describe a ring, each in one row that scene files, the panel, errors and documents read.
//! `Ring::default` has their usual values.
//!
//! To add a number, add a field of `Ring` with its usual value (`ring.rs`), a row at the end of those here, the form that it
//! changes (`band.rs`, `head.rs`, `halo.rs`, `row.rs`), a limit that depends on other numbers in `Ring::check` (`making.rs`), its
//! field in `any_ring` of `tests.rs`, and a line in docs/formats.md.

use super::{Ring, RingError, RingStyle};
use brillianteer_base::{NumberRow, Unit};

/// A number that describes a ring, such as the width of its band.
pub struct RingNumber {
    /// Its row.
    pub row: NumberRow<Ring>,
    /// Returns whether the metal of a ring of this style depends on the number.
    pub matters: fn(RingStyle) -> bool,
}

/// Makes a row of a field of [`Ring`], whose name is its key.
macro_rules! number {
    ($field:ident, $name:literal, $least:literal to $most:literal, $unit:ident, $matters:expr, $meaning:literal) => {
        RingNumber {
            row: NumberRow::new(
                stringify!($field),
                $name,
                Unit::$unit,
                [$least, $most],
                $meaning,
                |ring| Some(ring.$field),
                |ring, value| ring.$field = value,
            ),
            matters: $matters,
        }
    };
}

fn always(_: RingStyle) -> bool {
    true
}

fn with_prongs(style: RingStyle) -> bool {
    style.prongs() > 0
}

fn with_stones(style: RingStyle) -> bool {
    style != RingStyle::Band
}

/// The numbers that describe a ring, in the order of its fields.
pub const RING_NUMBERS: [RingNumber; 12] = [
    number!(inner_diameter_mm, "Inner diameter", 12.0 to 26.0, Millimetres, always, "The diameter of the finger's hole."),
    number!(width_mm, "Band width", 1.0 to 12.0, Millimetres, always, "The width of the band along the finger, opposite the head."),
    number!(thickness_mm, "Band thickness", 0.8 to 4.0, Millimetres, always, "The thickness of the band in its middle."),
    number!(comfort_mm, "Comfort", 0.05 to 1.5, Millimetres, always, "The height by which the inside of the band rises from its middle to its edges."),
    number!(taper, "Taper", 0.4 to 1.0, Ratio, always, "The width of the band at the head, as a part of its width."),
    number!(prong_diameter_mm, "Prong diameter", 0.4 to 2.0, Millimetres, with_prongs, "The diameter of a prong at the girdle; its tip is thinner."),
    number!(notch, "Notch", 0.2 to 0.45, Ratio, with_prongs, "The depth of the notch in which the girdle sits, as a part of the prong's diameter."),
    number!(grip_mm, "Grip", 0.1 to 2.0, Millimetres, with_prongs, "The length by which the middle of a prong reaches over the crown from the girdle."),
    number!(culet_gap_mm, "Culet gap", 0.05 to 5.0, Millimetres, with_stones, "The height of the stone's lowest point above the metal under it."),
    number!(rail_diameter_mm, "Rail diameter", 0.3 to 2.0, Millimetres, with_prongs, "The diameter of the rails between the prongs and under a halo."),
    number!(small_diameter_mm, "Small stones", 0.8 to 4.0, Millimetres, RingStyle::has_small, "The girdle diameter of the small stones. As many are set as fit."),
    number!(small_gap_mm, "Small gap", 0.08 to 1.0, Millimetres, RingStyle::has_small, "The least gap between the girdles of small stones, and between these and the main stone."),
];

impl RingNumber {
    /// Checks that a ring's number lies in its range.
    ///
    /// # Errors
    /// Fails where the number is out of its range or not finite.
    pub fn check(&self, ring: &Ring) -> Result<(), RingError> {
        let value = (self.row.get)(ring).unwrap_or(f64::NAN);
        Ok(self.row.check(value)?)
    }
}
