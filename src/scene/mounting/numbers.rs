//! The numbers of a ring: key, unit, range, usual value and meaning of each, one row a number.

use super::{Ring, RingError};

/// A number of a ring.
pub struct RingNumber {
    /// The key in scene files.
    pub key: &'static str,
    /// The least and the greatest value.
    pub range: [f64; 2],
    /// The unit; empty for a part of something.
    pub unit: &'static str,
    /// The meaning, in a sentence or two.
    pub meaning: &'static str,
    /// Returns the value.
    pub get: fn(&Ring) -> f64,
}

/// All numbers of a ring.
pub const RING_NUMBERS: [RingNumber; 12] = [
    RingNumber {
        key: "inner_diameter_mm",
        range: [12.0, 26.0],
        unit: "mm",
        meaning: "The diameter of the finger's hole. The size of the United States is (mm - 11.63) / 0.8128, that of ISO 8653, \
                  which most of Europe uses, is the hole's circumference: 17.3 mm are 7 and 54.",
        get: |ring| ring.inner_diameter_mm,
    },
    RingNumber {
        key: "width_mm",
        range: [1.0, 12.0],
        unit: "mm",
        meaning: "The width of the band along the finger, opposite the head.",
        get: |ring| ring.width_mm,
    },
    RingNumber {
        key: "thickness_mm",
        range: [0.8, 4.0],
        unit: "mm",
        meaning: "The thickness of the band in its middle, from the finger outward.",
        get: |ring| ring.thickness_mm,
    },
    RingNumber {
        key: "comfort_mm",
        range: [0.05, 1.5],
        unit: "mm",
        meaning: "How far the inside of the band rises from its middle to its edges, rounded for comfort.",
        get: |ring| ring.comfort_mm,
    },
    RingNumber {
        key: "taper",
        range: [0.4, 1.0],
        unit: "",
        meaning: "The width of the band at the head, as a part of its width.",
        get: |ring| ring.taper,
    },
    RingNumber {
        key: "prong_diameter_mm",
        range: [0.4, 2.0],
        unit: "mm",
        meaning: "The diameter of a prong at the girdle.",
        get: |ring| ring.prong_diameter_mm,
    },
    RingNumber {
        key: "notch",
        range: [0.2, 0.45],
        unit: "",
        meaning: "The depth of the notch in which the girdle sits, as a part of the prong's diameter.",
        get: |ring| ring.notch,
    },
    RingNumber {
        key: "grip_mm",
        range: [0.1, 2.0],
        unit: "mm",
        meaning: "How far the middle of a prong goes over the crown from the girdle; its round tip goes on by about half a \
                  prong.",
        get: |ring| ring.grip_mm,
    },
    RingNumber {
        key: "culet_gap_mm",
        range: [0.05, 5.0],
        unit: "mm",
        meaning: "The height of the stone's lowest point above the metal under it.",
        get: |ring| ring.culet_gap_mm,
    },
    RingNumber {
        key: "rail_diameter_mm",
        range: [0.3, 2.0],
        unit: "mm",
        meaning: "The diameter of the rails between the prongs and under a halo.",
        get: |ring| ring.rail_diameter_mm,
    },
    RingNumber {
        key: "small_diameter_mm",
        range: [0.8, 4.0],
        unit: "mm",
        meaning: "The girdle diameter of the stones of a halo or an eternity band.",
        get: |ring| ring.small_diameter_mm,
    },
    RingNumber {
        key: "small_gap_mm",
        range: [0.08, 1.0],
        unit: "mm",
        meaning: "The least gap between the girdles of small stones, and between these and the main stone.",
        get: |ring| ring.small_gap_mm,
    },
];

impl RingNumber {
    /// Checks that a ring's number lies in its range.
    ///
    /// # Errors
    /// The number does not, or it is not finite.
    pub fn check(&self, ring: &Ring) -> Result<(), RingError> {
        let value = (self.get)(ring);
        let [least, most] = self.range;
        if (least..=most).contains(&value) {
            return Ok(());
        }
        Err(RingError::OutOfRange { key: self.key, value, least, most, unit: self.unit })
    }
}
