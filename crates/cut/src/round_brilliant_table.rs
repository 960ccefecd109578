//! The table of the round brilliant's proportions.
//!
//! Upper bounds are geometry: beyond them a facet has nowhere to lie. Lower bounds keep every facet well clear of its
//! neighbours, and catch fractions written for percent and radians written for degrees: they lie above 1 % and π/2°.

use super::Cut;
use super::family::BoundAt::{Fixed, Of};
use super::family::{Bound, Family, ProfileHandle, Proportion};
use super::proportions::{Derived, Proportions, STAR_AZIMUTH};
use super::published_ranges;
use super::round_brilliant::{Crown, LowerHalf, Pavilion, RoundBrilliant, TOLKOWSKY};
use brillianteer_base::Unit;
use std::f64::consts::FRAC_PI_8;

/// The flattest bezel or main, degrees.
const LEAST_ANGLE: f64 = 2.0;
/// The shortest lower half, radial percent.
const LEAST_LOWER_HALF: f64 = 2.0;
/// The cosine of [`STAR_AZIMUTH`].
const STAR_COS: f64 = 0.923_879_532_511_286_7;

/// The family of the round brilliant.
pub static ROUND_BRILLIANT: Family = Family {
    key: "round_brilliant",
    name: "Round brilliant",
    first: Cut::RoundBrilliant(TOLKOWSKY),
    net: None,
    depth: None,
    proportions: &[
        Proportion {
            key: "table",
            name: "Table",
            meaning: "The flat facet on top, corner to opposite corner, in percent of the girdle's diameter.",
            usual: [45.0, 75.0],
            least: Bound::at(Fixed(5.0), "the smallest table allowed"),
            most: Bound::before(Fixed(100.0 * STAR_COS), "where no star facet fits between table and girdle"),
            excellent: published_ranges::TABLE.excellent(),
            handles: &[ProfileHandle::TableEdge],
            get: |cut| of(cut, |b| b.table),
            give: Some(|cut, v| give(cut, |b| b.table = v)),
            ..Proportion::BLANK
        },
        Proportion {
            key: "crown_angle",
            name: "Crown angle",
            meaning: "The angle between the bezels and the girdle plane.",
            usual: [22.0, 44.0],
            least: Bound::at(Fixed(LEAST_ANGLE), "the flattest facet allowed"),
            most: Bound::before(Fixed(90.0), "where the bezels would stand upright"),
            excellent: published_ranges::CROWN_ANGLE.excellent(),
            handles: &[ProfileHandle::CrownSlope],
            get: |cut| of(cut, |b| crown(b).0),
            give: Some(|cut, v| give(cut, |b| b.crown = Crown::Angle(v))),
            pair: Some("crown_height"),
            is_given: |cut| is(cut, |b| matches!(b.crown, Crown::Angle(_))),
            ..ANGLE
        },
        Proportion {
            key: "crown_height",
            name: "Crown height",
            meaning: "The distance from the girdle's upper edge to the table, in percent of the girdle's diameter.",
            usual: [6.0, 24.0],
            least: Bound::at(
                Of(|cut| of(cut, |b| rise(LEAST_ANGLE, 50.0 - 0.5 * b.table))),
                "where the bezels lie at 2°",
            ),
            handles: &[ProfileHandle::TableLine],
            get: |cut| of(cut, |b| crown(b).1),
            give: Some(|cut, v| give(cut, |b| b.crown = Crown::Height(v))),
            pair: Some("crown_angle"),
            is_given: |cut| is(cut, |b| matches!(b.crown, Crown::Height(_))),
            ..Proportion::BLANK
        },
        Proportion {
            key: "pavilion_angle",
            name: "Pavilion angle",
            meaning: "The angle between the mains, the eight large facets below, and the girdle plane. Nothing affects \
                light return more.",
            usual: [38.0, 45.0],
            least: Bound::at(Fixed(LEAST_ANGLE), "the flattest facet allowed"),
            most: Bound::before(Fixed(90.0), "where the mains would stand upright"),
            excellent: published_ranges::PAVILION_ANGLE.excellent(),
            handles: &[ProfileHandle::PavilionSlope],
            get: |cut| of(cut, |b| pavilion(b).0),
            give: Some(|cut, v| give(cut, |b| b.pavilion = Pavilion::Angle(v))),
            pair: Some("pavilion_depth"),
            is_given: |cut| is(cut, |b| matches!(b.pavilion, Pavilion::Angle(_))),
            ..ANGLE
        },
        Proportion {
            key: "pavilion_depth",
            name: "Pavilion depth",
            meaning: "The distance from the girdle's lower edge to the culet, in percent of the girdle's diameter.",
            usual: [38.0, 50.0],
            least: Bound::at(
                Of(|cut| of(cut, |b| rise(LEAST_ANGLE, 50.0 - 0.5 * b.culet))),
                "where the mains lie at 2°",
            ),
            handles: &[ProfileHandle::PavilionTip],
            get: |cut| of(cut, |b| pavilion(b).1),
            give: Some(|cut, v| give(cut, |b| b.pavilion = Pavilion::Depth(v))),
            pair: Some("pavilion_angle"),
            is_given: |cut| is(cut, |b| matches!(b.pavilion, Pavilion::Depth(_))),
            ..Proportion::BLANK
        },
        Proportion {
            key: "star_length",
            name: "Star length",
            of: "of the way from the table's edge to the girdle",
            meaning: "The reach of the stars from the table's edge to the girdle, seen from above.",
            usual: [30.0, 75.0],
            least: Bound::before(
                Of(|cut| of(cut, |b| least_star_length(b.table))),
                "where the star facets would lie flat with the table",
            ),
            most: Bound::before(
                Fixed(100.0),
                "where the star tips would lie on the girdle and the upper halves stand upright",
            ),
            excellent: published_ranges::STAR_LENGTH.excellent(),
            get: |cut| of(cut, |b| b.star_length),
            give: Some(|cut, v| give(cut, |b| b.star_length = v)),
            ..Proportion::BLANK
        },
        Proportion {
            key: "lower_half_length",
            name: "Lower half",
            of: "of the way from the girdle to the centre",
            meaning: "The reach of the lower halves from the girdle to the centre, seen from below. Long ones make narrow \
                      arrows.",
            usual: [50.0, 95.0],
            least: Bound::at(
                Fixed(LEAST_LOWER_HALF),
                "where the lower halves end within 2 % of the girdle, nearly upright",
            ),
            most: Bound::before(
                Fixed(100.0),
                "where the lower halves would meet in the centre and leave no mains",
            ),
            excellent: published_ranges::LOWER_HALF_LENGTH.excellent(),
            get: |cut| of(cut, |b| lower_half(b).0),
            give: Some(|cut, v| give(cut, |b| b.lower_half = LowerHalf::Radial(v))),
            pair: Some("lower_half_length_vertical"),
            is_given: |cut| is(cut, |b| matches!(b.lower_half, LowerHalf::Radial(_))),
            ..Proportion::BLANK
        },
        Proportion {
            key: "lower_half_length_vertical",
            name: "Lower half, side",
            of: "of the depth from the girdle to where the mains meet",
            meaning: "The same length seen from the side, in percent of the pavilion's depth, as some laboratories measure \
                      it.",
            usual: [50.0, 95.0],
            least: Bound::at(
                Fixed(100.0 - (100.0 - LEAST_LOWER_HALF) * STAR_COS),
                "where the lower halves end within 2 % of the girdle, nearly upright",
            ),
            most: Bound::before(
                Fixed(100.0),
                "where the lower halves would meet in the centre and leave no mains",
            ),
            get: |cut| of(cut, |b| lower_half(b).1),
            give: Some(|cut, v| give(cut, |b| b.lower_half = LowerHalf::Vertical(v))),
            pair: Some("lower_half_length"),
            is_given: |cut| is(cut, |b| matches!(b.lower_half, LowerHalf::Vertical(_))),
            ..Proportion::BLANK
        },
        Proportion {
            key: "girdle_thickness",
            name: "Girdle",
            of: "of the girdle diameter, at the bezels",
            meaning: "The girdle's thickness at the bezels, where it is greatest, in percent of the stone's diameter.",
            usual: [0.0, 8.0],
            least: Bound::at(Fixed(0.0), "a knife edge all round"),
            handles: &[ProfileHandle::GirdleUpper, ProfileHandle::GirdleLower],
            get: |cut| of(cut, |b| b.girdle_thickness),
            give: Some(|cut, v| give(cut, |b| b.girdle_thickness = v)),
            ..Proportion::BLANK
        },
        Proportion {
            key: "girdle_facets",
            name: "Girdle facets",
            unit: Unit::Count,
            meaning: "The number of small upright facets of the girdle; multiples of 8 keep the stone's symmetry.",
            usual: [16.0, 128.0],
            step: 8.0,
            speed: 0.2,
            least: Bound::at(Fixed(16.0), "one for each half facet"),
            most: Bound::at(Fixed(128.0), "the most facets of any girdle"),
            get: |cut| of(cut, |b| f64::from(b.girdle_facets)),
            give: Some(|cut, v| give(cut, |b| b.girdle_facets = v as u32)),
            ..Proportion::BLANK
        },
        Proportion {
            key: "culet",
            name: "Culet",
            of: "of the girdle diameter, 0 for a point",
            meaning: "A flat facet instead of the lowest point, in percent of the girdle's diameter; 0 is a point.",
            usual: [0.0, 12.0],
            least: Bound::at(Fixed(0.0), "a pointed culet"),
            most: Bound::before(Fixed(100.0), "where the culet would be as wide as the girdle"),
            handles: &[ProfileHandle::CuletEdge],
            get: |cut| of(cut, |b| b.culet),
            give: Some(|cut, v| give(cut, |b| b.culet = v)),
            ..Proportion::BLANK
        },
        Proportion {
            key: "total_depth",
            name: "Total depth",
            meaning: "The distance from table to culet. Setting it changes the depth of the pavilion; crown and girdle stay.",
            usual: [52.0, 70.0],
            moves: &["pavilion_depth"],
            // Up to this value, rounding errors stay below every tolerance.
            most: Bound::at(
                Fixed(300.0),
                "beyond which the total depth is more than 300 %, that of a needle and not of a brilliant",
            ),
            excellent: Some([58.1, 63.6]),
            get: |cut| derived(cut, |d| d.total_depth),
            ..Proportion::BLANK
        },
        Proportion {
            key: "star_angle",
            name: "Star angle",
            meaning: "The angle between the small facets around the table and the girdle plane.",
            get: |cut| derived(cut, |d| d.star_angle),
            ..ANGLE
        },
        Proportion {
            key: "upper_half_angle",
            name: "Upper halves",
            meaning: "The angle between the crown facets at the girdle and the girdle plane.",
            get: |cut| derived(cut, |d| d.upper_half_angle),
            ..ANGLE
        },
        Proportion {
            key: "lower_half_angle",
            name: "Lower halves",
            meaning: "The angle between the pavilion facets at the girdle and the girdle plane.",
            get: |cut| derived(cut, |d| d.lower_half_angle),
            ..ANGLE
        },
        Proportion {
            key: "girdle_thickness_valley",
            name: "Girdle valleys",
            meaning: "The girdle's thickness between the bezels, where it is least.",
            nothing: Some("closed"),
            get: |cut| derived(cut, |d| d.girdle_thickness_valley),
            ..Proportion::BLANK
        },
    ],
};

/// The row of angles, without the properties in which they differ.
const ANGLE: Proportion =
    Proportion { unit: Unit::Degrees, of: "from the girdle plane", ..Proportion::BLANK };

fn of(cut: &Cut, read: fn(&RoundBrilliant) -> f64) -> f64 {
    cut.brilliant().map_or(f64::NAN, read)
}

fn is(cut: &Cut, test: fn(&RoundBrilliant) -> bool) -> bool {
    cut.brilliant().is_some_and(test)
}

fn give(cut: &mut Cut, write: impl FnOnce(&mut RoundBrilliant)) {
    if let Cut::RoundBrilliant(brilliant) = cut {
        write(brilliant);
    }
}

fn derived(cut: &Cut, read: fn(&Derived) -> f64) -> f64 {
    cut.brilliant().map_or(f64::NAN, |b| read(&Proportions::unchecked(b).derived()))
}

/// Returns the star length, percent, at which the stars lie flat with the table, because their tips lie on the bezels at the
/// table's level.
pub fn least_star_length(table: f64) -> f64 {
    let (t, cos, sin) = (table / 100.0, STAR_AZIMUTH.cos(), STAR_AZIMUTH.sin());
    100.0 * t * sin * sin / (cos * (1.0 - t * cos))
}

// Each of a pair follows from the other alone, whatever the fault in the rest of the proportions.

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

#[cfg(test)]
mod tests {
    use super::*;

    fn row(key: &str) -> &'static Proportion {
        ROUND_BRILLIANT.proportion(key).unwrap()
    }

    #[test]
    fn what_is_set_is_what_is_read() {
        for row in ROUND_BRILLIANT.editable() {
            let mut cut = ROUND_BRILLIANT.first.clone();
            let value = (row.get)(&cut) + 1.0;
            row.set(&mut cut, value);
            let off = ((row.get)(&cut) - value).abs();
            assert!(off < 1e-9, "{row:?}: off by {off}");
            assert!(row.excellent.is_none_or(|[least, _]| least >= row.usual[0]));
        }
    }

    #[test]
    fn the_constant_is_the_cosine() {
        assert_eq!(STAR_COS, STAR_AZIMUTH.cos());
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
        let mut cut = Cut::RoundBrilliant(RoundBrilliant { table: 97.0, ..TOLKOWSKY });
        assert!(cut.check().is_err());
        assert!(ROUND_BRILLIANT.editable().all(|row| (row.get)(&cut).is_finite()));
        row("crown_height").set(&mut cut, 1.0);
        assert!(is(&cut, |b| matches!(b.crown, Crown::Angle(angle) if angle > 30.0)));
    }

    #[test]
    fn the_one_held_of_a_pair_stays_when_something_else_changes() {
        let [table, angle, height] = ["table", "crown_angle", "crown_height"].map(row);
        let mut cut = ROUND_BRILLIANT.first.clone();
        height.set(&mut cut, 16.0);
        assert!((angle.is_given)(&cut), "the angle is still held");
        let held = (angle.get)(&cut);
        table.set(&mut cut, 57.0);
        assert_eq!((angle.get)(&cut), held);
        height.hold(&mut cut);
        let held = (height.get)(&cut);
        table.set(&mut cut, 60.0);
        assert!(((height.get)(&cut) - held).abs() < 1e-12 && (height.is_given)(&cut));
    }
}
