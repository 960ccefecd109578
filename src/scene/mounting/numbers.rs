//! The numbers that describe a ring: key, unit and range of each, in one row. `Ring::default` has their usual values;
//! docs/formats.md gives their meanings.

use super::{Ring, RingError};

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
}

/// The numbers that describe a ring, in the order of its fields.
pub const RING_NUMBERS: [RingNumber; 12] = [
    RingNumber {
        key: "inner_diameter_mm",
        range: [12.0, 26.0],
        unit: "mm",
        get: |ring| ring.inner_diameter_mm,
    },
    RingNumber { key: "width_mm", range: [1.0, 12.0], unit: "mm", get: |ring| ring.width_mm },
    RingNumber { key: "thickness_mm", range: [0.8, 4.0], unit: "mm", get: |ring| ring.thickness_mm },
    RingNumber { key: "comfort_mm", range: [0.05, 1.5], unit: "mm", get: |ring| ring.comfort_mm },
    RingNumber { key: "taper", range: [0.4, 1.0], unit: "", get: |ring| ring.taper },
    RingNumber {
        key: "prong_diameter_mm",
        range: [0.4, 2.0],
        unit: "mm",
        get: |ring| ring.prong_diameter_mm,
    },
    RingNumber { key: "notch", range: [0.2, 0.45], unit: "", get: |ring| ring.notch },
    RingNumber { key: "grip_mm", range: [0.1, 2.0], unit: "mm", get: |ring| ring.grip_mm },
    RingNumber { key: "culet_gap_mm", range: [0.05, 5.0], unit: "mm", get: |ring| ring.culet_gap_mm },
    RingNumber { key: "rail_diameter_mm", range: [0.3, 2.0], unit: "mm", get: |ring| ring.rail_diameter_mm },
    RingNumber {
        key: "small_diameter_mm",
        range: [0.8, 4.0],
        unit: "mm",
        get: |ring| ring.small_diameter_mm,
    },
    RingNumber { key: "small_gap_mm", range: [0.08, 1.0], unit: "mm", get: |ring| ring.small_gap_mm },
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
