//! The numbers that describe a ring: key, unit and range of each, in one row. `Ring::default` has their usual values;
//! docs/formats.md gives their meanings.
//!
//! To add a number, add a field of `Ring`, a row here, a key in `crates/files/src/scene_file/ring_form.rs`, a row
//! in `crates/editor/src/panels/ring_rows.rs` and one in docs/formats.md.

use super::{Ring, RingError, RingStyle};

/// A number that describes a ring, such as the width of its band.
pub struct RingNumber {
    /// The key in scene files.
    pub key: &'static str,
    /// The least and the greatest value.
    pub range: [f64; 2],
    /// The unit; empty for a part of something.
    pub unit: &'static str,
    /// Returns the value that a ring has.
    pub get: fn(&Ring) -> f64,
    /// Sets the number of a ring, whether it is in its range or not.
    pub set: fn(&mut Ring, f64),
    /// Returns whether the metal of a ring of this style depends on the number.
    pub matters: fn(RingStyle) -> bool,
}

/// Makes a row of a field of [`Ring`], whose name is its key.
macro_rules! number {
    ($field:ident, $least:literal to $most:literal, $unit:literal, $matters:expr) => {
        RingNumber {
            key: stringify!($field),
            range: [$least, $most],
            unit: $unit,
            get: |ring| ring.$field,
            set: |ring, value| ring.$field = value,
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
    number!(inner_diameter_mm, 12.0 to 26.0, "mm", always),
    number!(width_mm, 1.0 to 12.0, "mm", always),
    number!(thickness_mm, 0.8 to 4.0, "mm", always),
    number!(comfort_mm, 0.05 to 1.5, "mm", always),
    number!(taper, 0.4 to 1.0, "", always),
    number!(prong_diameter_mm, 0.4 to 2.0, "mm", with_prongs),
    number!(notch, 0.2 to 0.45, "", with_prongs),
    number!(grip_mm, 0.1 to 2.0, "mm", with_prongs),
    number!(culet_gap_mm, 0.05 to 5.0, "mm", with_stones),
    number!(rail_diameter_mm, 0.3 to 2.0, "mm", with_prongs),
    number!(small_diameter_mm, 0.8 to 4.0, "mm", RingStyle::has_small),
    number!(small_gap_mm, 0.08 to 1.0, "mm", RingStyle::has_small),
];

impl RingNumber {
    /// Checks that a ring's number lies in its range.
    ///
    /// # Errors
    /// Fails where the number is out of its range or not finite.
    pub fn check(&self, ring: &Ring) -> Result<(), RingError> {
        let value = (self.get)(ring);
        let [least, most] = self.range;
        if (least..=most).contains(&value) {
            return Ok(());
        }
        Err(RingError::OutOfRange { key: self.key, value, least, most, unit: self.unit })
    }
}
