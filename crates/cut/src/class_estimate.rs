//! A class for the cut of a round brilliant of diamond, estimated after the ranges that GIA publishes. It is not a
//! grade.
//!
//! The class is the worst of those of single proportions and of a limit for crown, pavilion and table together, which
//! is our own fit. docs/optics.md, "Estimate after GIA", describes its reliability.

use super::proportions::Proportions;
use super::published_ranges::PUBLISHED_RANGES;
use super::round_brilliant::{LowerHalf, RoundBrilliant};
use brillianteer_base::Unit;
use serde::Serialize;
use std::fmt;

/// A class of the cut, the best first. Its words are those of GIA's grades, but it is an estimate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub enum CutClass {
    /// Excellent.
    #[serde(rename = "EX")]
    Excellent,
    /// Very good.
    #[serde(rename = "VG")]
    VeryGood,
    /// Good.
    #[serde(rename = "G")]
    Good,
    /// Fair.
    #[serde(rename = "F")]
    Fair,
    /// Poor.
    #[serde(rename = "P")]
    Poor,
}

impl CutClass {
    /// The classes, the best first.
    pub const ALL: [Self; 5] = [Self::Excellent, Self::VeryGood, Self::Good, Self::Fair, Self::Poor];
}

impl fmt::Display for CutClass {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Excellent => "EX",
            Self::VeryGood => "VG",
            Self::Good => "G",
            Self::Fair => "F",
            Self::Poor => "P",
        })
    }
}

/// The proportions of a round brilliant that are judged: means over its facets, lengths in percent of the diameter, angles in degrees
/// from the girdle plane.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct BrilliantProportions {
    /// The table, corner to opposite corner.
    pub table: f64,
    /// The angle of the bezels.
    pub crown_angle: f64,
    /// The angle of the mains.
    pub pavilion_angle: f64,
    /// The distance that the stars reach from the table's edge toward the girdle, seen from above, percent of that
    /// way.
    pub star_length: f64,
    /// The distance that the lower halves reach from the girdle toward the centre, seen along the axis, percent of
    /// that way.
    pub lower_half_length: f64,
    /// The girdle's thickness at the bezels.
    pub girdle_thickness: f64,
    /// The height from the girdle's upper edge to the table.
    pub crown_height: f64,
}

impl BrilliantProportions {
    /// Returns the proportions that a design gives, and those that follow from them.
    pub fn of(design: &RoundBrilliant) -> Self {
        let derived = Proportions::unchecked(design).derived();
        Self {
            table: design.table,
            crown_angle: derived.crown_angle,
            pavilion_angle: derived.pavilion_angle,
            star_length: design.star_length,
            lower_half_length: match design.lower_half {
                LowerHalf::Radial(length) => length,
                LowerHalf::Vertical(_) => derived.lower_half_length,
            },
            girdle_thickness: design.girdle_thickness,
            crown_height: derived.crown_height,
        }
    }
}

/// The best class that one proportion, or crown, pavilion and table together, allow.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ClassLimit {
    /// The key of the proportion as in cut files; `crown_pavilion_table` for the three together.
    pub key: &'static str,
    /// The name that people read.
    #[serde(skip)]
    pub name: &'static str,
    /// The unit of both numbers.
    #[serde(skip)]
    pub unit: Unit,
    /// The proportion as it was measured; `None` for the three together.
    pub measured: Option<f64>,
    /// The same, rounded to the step to which GIA rounds it; a half is rounded up.
    pub rounded: Option<f64>,
    /// The best class that it allows.
    pub class: CutClass,
}

/// A class that a stone would have if a proportion beside a border of rounding were rounded the other way.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct NearbyClass {
    /// The key of the proportion.
    pub key: &'static str,
    /// The name that people read.
    #[serde(skip)]
    pub name: &'static str,
    /// The unit of the number.
    #[serde(skip)]
    pub unit: Unit,
    /// The value to which it would be rounded.
    pub rounded: f64,
    /// The class of the stone then.
    pub class: CutClass,
}

/// A class estimated after the ranges that GIA publishes. It is not a grade.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ClassEstimate {
    /// The class: the worst that a limit allows.
    pub class: CutClass,
    /// The limit by each proportion, and then that by the three together.
    pub limits: Vec<ClassLimit>,
    /// Other classes that are as near as a tenth of a step of rounding; one for each proportion that has one.
    pub nearby: Vec<NearbyClass>,
}

/// The part of a step from a border of rounding within which GIA's own averaging may round the other way.
const BESIDE_BORDER: f64 = 0.1;

/// The border between two classes: a plane of crown angle, pavilion angle and table.
struct Border {
    /// True where crowns above the border are excluded, false where those below it are.
    is_above: bool,
    /// The crown angle at the border, less [`MIDDLE`]'s, at its pavilion and table, degrees.
    crown: f64,
    /// The change of that angle for each degree of the pavilion.
    by_pavilion: f64,
    /// The change of that angle, degrees, for each percent of the table.
    by_table: f64,
}

/// The crown angle, pavilion angle and table from which borders are counted.
const MIDDLE: [f64; 3] = [34.0, 41.2, 57.0];

const fn above(crown: f64, by_pavilion: f64, by_table: f64) -> Border {
    Border { is_above: true, crown, by_pavilion, by_table }
}

const fn below(crown: f64, by_pavilion: f64, by_table: f64) -> Border {
    Border { is_above: false, crown, by_pavilion, by_table }
}

/// The borders of EX, VG and G: our own fit, 27 numbers (docs/optics.md).
const BORDERS: [[Border; 3]; 3] = [
    [above(3.85, -2.5, 0.7), above(1.9, -2.0, -0.25), below(-2.95, -5.2, 0.1)],
    [above(3.75, -1.0, -0.35), above(5.85, -2.5, 0.6), below(-6.35, -6.5, 0.15)],
    [above(8.65, -2.4, 0.55), above(39.15, 12.6, -1.8), below(-10.15, -4.8, 0.0)],
];

/// Rounding of numbers such as 40.8, far below each step.
const ROUNDING: f64 = 1e-6;

impl Border {
    fn holds(&self, [crown, pavilion, table]: [f64; 3]) -> bool {
        let [c, p, t] = [crown - MIDDLE[0], pavilion - MIDDLE[1], table - MIDDLE[2]];
        let beyond = c - (self.crown + self.by_pavilion * p + self.by_table * t);
        if self.is_above { beyond <= ROUNDING } else { beyond >= -ROUNDING }
    }
}

/// Returns the best class that rounded crown angle, pavilion angle and table allow together.
fn together(rounded: &[f64; RANGES]) -> CutClass {
    let [crown, pavilion, table, ..] = *rounded;
    let holds = |border: &Border| border.holds([crown, pavilion, table]);
    let worse = BORDERS.iter().rposition(|borders| !borders.iter().all(holds));
    CutClass::ALL[worse.map_or(0, |k| k + 1)]
}

/// The number of proportions with a published range.
const RANGES: usize = PUBLISHED_RANGES.len();

impl ClassEstimate {
    /// Estimates the class of a round brilliant of diamond with these proportions.
    pub fn after_gia(stone: &BrilliantProportions) -> Self {
        let measured: [f64; RANGES] = std::array::from_fn(|k| (PUBLISHED_RANGES[k].get)(stone));
        let rounded: [f64; RANGES] = std::array::from_fn(|k| PUBLISHED_RANGES[k].rounded(measured[k]));
        let class = worst(&rounded);
        let nearby = (0..).zip(&PUBLISHED_RANGES).filter_map(|(k, range): (usize, _)| {
            let mut other = rounded;
            other[k] = range.rounded_otherwise(measured[k], BESIDE_BORDER)?;
            let (key, name, rounded, unit) = (range.key, range.name, other[k], range.unit);
            let found = worst(&other);
            (found != class).then_some(NearbyClass { key, name, unit, rounded, class: found })
        });
        let single = (0..).zip(&PUBLISHED_RANGES).map(|(k, range): (usize, _)| ClassLimit {
            key: range.key,
            name: range.name,
            unit: range.unit,
            measured: Some(measured[k]),
            rounded: Some(rounded[k]),
            class: range.class(rounded[k]),
        });
        let joint = ClassLimit {
            key: "crown_pavilion_table",
            name: "These three together",
            unit: Unit::Degrees,
            measured: None,
            rounded: None,
            class: together(&rounded),
        };
        let mut limits: Vec<ClassLimit> = single.collect();
        limits.insert(JOINT, joint);
        Self { class, nearby: nearby.collect(), limits }
    }
}

/// The number of published ranges, the first, that crown angle, pavilion angle and table have.
const JOINT: usize = 3;

/// Returns the worst class that rounded proportions allow, in the order of [`PUBLISHED_RANGES`].
fn worst(rounded: &[f64; RANGES]) -> CutClass {
    let single = PUBLISHED_RANGES.iter().zip(rounded).map(|(range, value)| range.class(*value));
    single.fold(together(rounded), CutClass::max)
}
