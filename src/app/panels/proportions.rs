//! The proportions of a round brilliant as the panel shows them: the name and the range of each, and what laboratories call
//! excellent.

use crate::cut::{Crown, LowerHalf, Pavilion, RoundBrilliant, Unit};
use std::f64::consts::FRAC_PI_8;
use std::ops::RangeInclusive;

/// A proportion that is shown with a slider.
pub struct Proportion {
    /// The name in the panel.
    pub name: &'static str,
    /// The key in cut files.
    pub key: &'static str,
    /// The meaning, in a sentence.
    pub meaning: &'static str,
    /// The unit: percent, degrees, or a count.
    pub unit: Unit,
    /// The range of the slider; other numbers may be typed.
    pub slider: RangeInclusive<f64>,
    /// GIA's range for the grade Excellent (GIA, 2006), where there is one.
    pub excellent: Option<RangeInclusive<f64>>,
    /// Returns the number, given or derived; it is not finite where the proportions allow none.
    pub get: fn(&RoundBrilliant) -> f64,
    /// Sets the number; of a pair, the one that is held stays the one that is given.
    pub set: fn(&mut RoundBrilliant, f64),
    /// Of a pair: whether this proportion is held while others change, and how to hold it.
    pub hold: Option<Hold>,
}

/// How one proportion of a pair is held.
pub struct Hold {
    /// Whether the proportion is held.
    pub is: fn(&RoundBrilliant) -> bool,
    /// Holds the proportion at its present value.
    pub set: fn(&mut RoundBrilliant),
}

/// GIA's range for the total depth of the grade Excellent, percent (GIA, 2006).
pub const EXCELLENT_DEPTH: RangeInclusive<f64> = 58.1..=63.6;

/// All proportions, in the order of the panel.
pub static PROPORTIONS: [Proportion; 11] = [
    Proportion {
        name: "Table",
        key: "table",
        meaning: "The flat facet on top, corner to opposite corner, in percent of the girdle's diameter.",
        unit: Unit::Percent,
        slider: 45.0..=75.0,
        excellent: Some(52.0..=62.0),
        get: |b| b.table,
        set: |b, v| b.table = v,
        hold: None,
    },
    Proportion {
        name: "Crown angle",
        key: "crown_angle",
        meaning: "How steep the bezels stand on the girdle plane.",
        unit: Unit::Degrees,
        slider: 22.0..=44.0,
        excellent: Some(31.5..=36.5),
        get: |b| crown(b).0,
        set: |b, v| set_crown(b, Crown::Angle(v)),
        hold: Some(Hold {
            is: |b| matches!(b.crown, Crown::Angle(_)),
            set: |b| b.crown = Crown::Angle(crown(b).0),
        }),
    },
    Proportion {
        name: "Crown height",
        key: "crown_height",
        meaning: "From the girdle's upper edge to the table, in percent of the girdle's diameter.",
        unit: Unit::Percent,
        slider: 6.0..=24.0,
        excellent: None,
        get: |b| crown(b).1,
        set: |b, v| set_crown(b, Crown::Height(v)),
        hold: Some(Hold {
            is: |b| matches!(b.crown, Crown::Height(_)),
            set: |b| b.crown = Crown::Height(crown(b).1),
        }),
    },
    Proportion {
        name: "Pavilion angle",
        key: "pavilion_angle",
        meaning: "How steep the mains, the eight large facets below, stand on the girdle plane. Light return depends \
                  on nothing as much.",
        unit: Unit::Degrees,
        slider: 38.0..=45.0,
        excellent: Some(40.6..=41.8),
        get: |b| pavilion(b).0,
        set: |b, v| set_pavilion(b, Pavilion::Angle(v)),
        hold: Some(Hold {
            is: |b| matches!(b.pavilion, Pavilion::Angle(_)),
            set: |b| b.pavilion = Pavilion::Angle(pavilion(b).0),
        }),
    },
    Proportion {
        name: "Pavilion depth",
        key: "pavilion_depth",
        meaning: "From the girdle's lower edge to the culet, in percent of the girdle's diameter.",
        unit: Unit::Percent,
        slider: 38.0..=50.0,
        excellent: None,
        get: |b| pavilion(b).1,
        set: |b, v| set_pavilion(b, Pavilion::Depth(v)),
        hold: Some(Hold {
            is: |b| matches!(b.pavilion, Pavilion::Depth(_)),
            set: |b| b.pavilion = Pavilion::Depth(pavilion(b).1),
        }),
    },
    Proportion {
        name: "Star length",
        key: "star_length",
        meaning: "How far the star facets reach from the table's edge to the girdle, seen from above.",
        unit: Unit::Percent,
        slider: 30.0..=75.0,
        excellent: Some(45.0..=65.0),
        get: |b| b.star_length,
        set: |b, v| b.star_length = v,
        hold: None,
    },
    Proportion {
        name: "Lower half",
        key: "lower_half_length",
        meaning: "How far the lower halves reach from the girdle to the centre, seen from below. Long ones make narrow \
                  arrows.",
        unit: Unit::Percent,
        slider: 50.0..=95.0,
        excellent: Some(70.0..=85.0),
        get: |b| lower_half(b).0,
        set: |b, v| set_lower_half(b, LowerHalf::Radial(v)),
        hold: Some(Hold {
            is: |b| matches!(b.lower_half, LowerHalf::Radial(_)),
            set: |b| b.lower_half = LowerHalf::Radial(lower_half(b).0),
        }),
    },
    Proportion {
        name: "Lower half, side",
        key: "lower_half_length_vertical",
        meaning: "The same length seen from the side, in percent of the pavilion's depth, as some laboratories measure \
                  it.",
        unit: Unit::Percent,
        slider: 50.0..=95.0,
        excellent: None,
        get: |b| lower_half(b).1,
        set: |b, v| set_lower_half(b, LowerHalf::Vertical(v)),
        hold: Some(Hold {
            is: |b| matches!(b.lower_half, LowerHalf::Vertical(_)),
            set: |b| b.lower_half = LowerHalf::Vertical(lower_half(b).1),
        }),
    },
    Proportion {
        name: "Girdle",
        key: "girdle_thickness",
        meaning: "The stone's rim, measured at the bezels where it is thickest, in percent of its diameter.",
        unit: Unit::Percent,
        slider: 0.0..=8.0,
        excellent: None,
        get: |b| b.girdle_thickness,
        set: |b, v| b.girdle_thickness = v,
        hold: None,
    },
    Proportion {
        name: "Girdle facets",
        key: "girdle_facets",
        meaning: "How many small upright facets the rim has; multiples of 8 keep the stone's symmetry.",
        unit: Unit::Count,
        slider: 16.0..=128.0,
        excellent: None,
        get: |b| f64::from(b.girdle_facets),
        set: |b, v| b.girdle_facets = v.round().clamp(16.0, 128.0) as u32,
        hold: None,
    },
    Proportion {
        name: "Culet",
        key: "culet",
        meaning: "A flat facet instead of the lowest point, in percent of the girdle's diameter; 0 is a point.",
        unit: Unit::Percent,
        slider: 0.0..=12.0,
        excellent: None,
        get: |b| b.culet,
        set: |b, v| b.culet = v,
        hold: None,
    },
];

// Each of a pair follows from the other alone, whatever is wrong with the rest of the proportions.

/// Returns the slope, degrees, that rises by `rise` over `run`, both in the same unit.
fn slope(rise: f64, run: f64) -> f64 {
    (rise / run).atan().to_degrees()
}

/// Returns the rise of a slope over `run`; infinite from 90 degrees on, where the tangent comes round again.
fn rise(degrees: f64, run: f64) -> f64 {
    if degrees.abs() < 90.0 { degrees.to_radians().tan() * run } else { f64::INFINITY }
}

/// Returns the angle, degrees, and the height, percent, of a crown.
fn crown(brilliant: &RoundBrilliant) -> (f64, f64) {
    let run = 50.0 - 0.5 * brilliant.table;
    match brilliant.crown {
        Crown::Angle(angle) => (angle, rise(angle, run)),
        Crown::Height(height) => (slope(height, run), height),
    }
}

/// Returns the angle, degrees, and the depth, percent, of a pavilion.
fn pavilion(brilliant: &RoundBrilliant) -> (f64, f64) {
    let run = 50.0 - 0.5 * brilliant.culet;
    match brilliant.pavilion {
        Pavilion::Angle(angle) => (angle, rise(angle, run)),
        Pavilion::Depth(depth) => (slope(depth, run), depth),
    }
}

/// Returns the radial and the vertical length of the lower halves, percent.
fn lower_half(brilliant: &RoundBrilliant) -> (f64, f64) {
    // Seen from the side, the girdle's radius is foreshortened where the halves end, between two mains.
    let cos = FRAC_PI_8.cos();
    match brilliant.lower_half {
        LowerHalf::Radial(radial) => (radial, 100.0 - (100.0 - radial) * cos),
        LowerHalf::Vertical(vertical) => (100.0 - (100.0 - vertical) / cos, vertical),
    }
}

/// Sets a crown by its angle or its height; the one that is held stays the one that is given.
pub fn set_crown(brilliant: &mut RoundBrilliant, given: Crown) {
    let (angle, height) = crown(&RoundBrilliant { crown: given, ..*brilliant });
    brilliant.crown = match brilliant.crown {
        Crown::Angle(_) => Crown::Angle(angle),
        Crown::Height(_) => Crown::Height(height),
    };
}

/// Sets a pavilion by its angle or its depth; the one that is held stays the one that is given.
pub fn set_pavilion(brilliant: &mut RoundBrilliant, given: Pavilion) {
    let (angle, depth) = pavilion(&RoundBrilliant { pavilion: given, ..*brilliant });
    brilliant.pavilion = match brilliant.pavilion {
        Pavilion::Angle(_) => Pavilion::Angle(angle),
        Pavilion::Depth(_) => Pavilion::Depth(depth),
    };
}

fn set_lower_half(brilliant: &mut RoundBrilliant, given: LowerHalf) {
    let (radial, vertical) = lower_half(&RoundBrilliant { lower_half: given, ..*brilliant });
    brilliant.lower_half = match brilliant.lower_half {
        LowerHalf::Radial(_) => LowerHalf::Radial(radial),
        LowerHalf::Vertical(_) => LowerHalf::Vertical(vertical),
    };
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cut::TOLKOWSKY;

    #[test]
    fn what_is_set_is_what_is_read() {
        for proportion in &PROPORTIONS {
            let mut brilliant = TOLKOWSKY;
            let value = (proportion.get)(&brilliant) + 1.0;
            (proportion.set)(&mut brilliant, value);
            let off = ((proportion.get)(&brilliant) - value).abs();
            assert!(off < 1e-9, "{}: off by {off}", proportion.name);
            assert!(proportion.excellent.as_ref().is_none_or(|e| proportion.slider.contains(e.start())));
        }
    }

    #[test]
    fn pairs_are_what_the_closed_form_derives() {
        let vertical = RoundBrilliant { lower_half: LowerHalf::Vertical(80.0), culet: 3.0, ..TOLKOWSKY };
        for given in [TOLKOWSKY, vertical] {
            let d = given.derived().unwrap();
            let pairs = [
                (crown(&given), (d.crown_angle, d.crown_height)),
                (pavilion(&given), (d.pavilion_angle, d.pavilion_depth)),
                (lower_half(&given), (d.lower_half_length, d.lower_half_length_vertical)),
            ];
            for ((a, b), (c, d)) in pairs {
                assert!((a - c).abs() < 1e-9 && (b - d).abs() < 1e-9, "{a} {b}, not {c} {d}");
            }
        }
    }

    #[test]
    fn a_pair_is_known_while_something_else_cannot_be() {
        let mut brilliant = RoundBrilliant { table: 97.0, ..TOLKOWSKY };
        assert!(brilliant.derived().is_err());
        assert!(PROPORTIONS.iter().all(|p| (p.get)(&brilliant).is_finite()));
        set_crown(&mut brilliant, Crown::Height(1.0));
        assert!(matches!(brilliant.crown, Crown::Angle(angle) if angle > 30.0));
    }

    #[test]
    fn the_one_held_of_a_pair_stays_when_something_else_changes() {
        let [angle, height] =
            ["crown_angle", "crown_height"].map(|key| PROPORTIONS.iter().find(|p| p.key == key).unwrap());
        let mut brilliant = TOLKOWSKY;
        (height.set)(&mut brilliant, 16.0);
        assert!(matches!(brilliant.crown, Crown::Angle(_)), "the angle is still held");
        let held = (angle.get)(&brilliant);
        brilliant.table = 57.0;
        assert_eq!((angle.get)(&brilliant), held);
        (height.hold.as_ref().unwrap().set)(&mut brilliant);
        let held = (height.get)(&brilliant);
        brilliant.table = 60.0;
        assert!(
            ((height.get)(&brilliant) - held).abs() < 1e-12 && (height.hold.as_ref().unwrap().is)(&brilliant)
        );
    }
}
