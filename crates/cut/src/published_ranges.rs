//! The ranges of single proportions that GIA publishes for the cut of round brilliants of diamond, and the steps to which it rounds.
//!
//! The ranges of EX stand on many public pages. Those of the other classes, and the ranges of girdle and crown
//! height, are known from one open program that restates them (docs/optics.md, "Estimate after GIA"). The ranges of
//! total depth are published in two versions, so they are left out.

use super::class_estimate::{BrilliantProportions, CutClass};
use brillianteer_base::Unit;

/// The ranges of one proportion.
pub struct PublishedRange {
    /// Its key in cut files.
    pub key: &'static str,
    /// The name that people read.
    pub name: &'static str,
    /// The unit: percent or degrees.
    pub unit: Unit,
    /// The step to which it is rounded before it is judged.
    pub step: f64,
    /// The least and the greatest value of EX, VG, G and F, both included; P is beyond them.
    pub classes: [[f64; 2]; 4],
    /// Returns the proportion.
    pub get: fn(&BrilliantProportions) -> f64,
}

/// The range that holds every number.
const ANY: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

/// Rounding of numbers such as 40.8, as a part of a step.
const ROUNDING: f64 = 1e-6;

/// The table.
pub const TABLE: PublishedRange = PublishedRange {
    key: "table",
    name: "Table",
    unit: Unit::Percent,
    step: 1.0,
    classes: [[52.0, 62.0], [50.0, 66.0], [47.0, 69.0], [44.0, 72.0]],
    get: |stone| stone.table,
};

/// The crown angle.
pub const CROWN_ANGLE: PublishedRange = PublishedRange {
    key: "crown_angle",
    name: "Crown angle",
    unit: Unit::Degrees,
    step: 0.5,
    classes: [[31.5, 36.5], [26.5, 38.5], [22.0, 40.0], [20.0, 41.5]],
    get: |stone| stone.crown_angle,
};

/// The pavilion angle.
pub const PAVILION_ANGLE: PublishedRange = PublishedRange {
    key: "pavilion_angle",
    name: "Pavilion angle",
    unit: Unit::Degrees,
    step: 0.2,
    classes: [[40.6, 41.8], [39.8, 42.4], [38.8, 43.0], [37.4, 44.0]],
    get: |stone| stone.pavilion_angle,
};

/// The star length.
pub const STAR_LENGTH: PublishedRange = PublishedRange {
    key: "star_length",
    name: "Star length",
    unit: Unit::Percent,
    step: 5.0,
    classes: [[45.0, 65.0], [40.0, 70.0], ANY, ANY],
    get: |stone| stone.star_length,
};

/// The lower halves.
pub const LOWER_HALF_LENGTH: PublishedRange = PublishedRange {
    key: "lower_half_length",
    name: "Lower half",
    unit: Unit::Percent,
    step: 5.0,
    classes: [[70.0, 85.0], [65.0, 90.0], ANY, ANY],
    get: |stone| stone.lower_half_length,
};

/// The girdle at the bezels.
const GIRDLE_THICKNESS: PublishedRange = PublishedRange {
    key: "girdle_thickness",
    name: "Girdle",
    unit: Unit::Percent,
    step: 0.5,
    classes: [[2.5, 4.5], [2.5, 5.5], [2.5, 7.5], [2.5, 10.5]],
    get: |stone| stone.girdle_thickness,
};

/// The crown height.
const CROWN_HEIGHT: PublishedRange = PublishedRange {
    key: "crown_height",
    name: "Crown height",
    unit: Unit::Percent,
    step: 0.5,
    classes: [[12.5, 17.0], [10.5, 18.0], [9.0, 19.5], [7.0, 21.0]],
    get: |stone| stone.crown_height,
};

/// The ranges: crown angle, pavilion angle and table first.
pub const PUBLISHED_RANGES: [PublishedRange; 7] =
    [CROWN_ANGLE, PAVILION_ANGLE, TABLE, STAR_LENGTH, LOWER_HALF_LENGTH, GIRDLE_THICKNESS, CROWN_HEIGHT];

impl PublishedRange {
    /// Returns the range of EX, as a row of a table of proportions holds it.
    pub const fn excellent(&self) -> Option<[f64; 2]> {
        Some(self.classes[0])
    }

    /// Rounds a value to the step; a half goes up.
    pub fn rounded(&self, value: f64) -> f64 {
        self.at((value / self.step + 0.5 + ROUNDING).floor())
    }

    /// Returns the value at so many steps, without the digits of rounding that 204 times 0.2 leaves.
    fn at(&self, steps: f64) -> f64 {
        (1e6 * steps * self.step).round() / 1e6
    }

    /// Returns the other value to which a value within this part of a step from a border of rounding could be
    /// rounded; `None` for values farther from a border.
    pub fn rounded_otherwise(&self, value: f64, part: f64) -> Option<f64> {
        let steps = value / self.step;
        let rounded = self.rounded(value) / self.step;
        let beyond = steps - rounded;
        (beyond.abs() > 0.5 - part).then(|| self.at(rounded.round() + beyond.signum()))
    }

    /// Returns the best class whose range holds a value.
    pub fn class(&self, value: f64) -> CutClass {
        let slack = ROUNDING * self.step;
        let holds = |range: &[f64; 2]| value >= range[0] - slack && value <= range[1] + slack;
        CutClass::ALL[self.classes.iter().position(holds).unwrap_or(self.classes.len())]
    }
}
