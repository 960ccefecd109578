//! The oval brilliant: a round brilliant that is stretched, with its 57 facets.
//!
//! Ranges: L/W 1.30 to 1.65 (yourjewel.com), table 53 to 62, crown 33 to 36 and pavilion 40 to 42 degrees at the width
//! (gemmology.dev); the outline is an ellipse at an exponent of 2, and squarer above.

use super::super::facet_net::{FacetNet, Unfit};
use super::super::family::BoundAt::Fixed;
use super::super::family::{Bound, Family, Proportion, Unit};
use super::super::family_cut::{FamilyCut, number};
use super::brilliant::Brilliant;
use super::girdle::{Girdle, Station};
use super::rows;
use glam::DVec2;
use std::f64::consts::TAU;

const LENGTH: usize = 0;
const FULLNESS: usize = 1;
const TABLE: usize = 2;
const CROWN: usize = 3;
const PAVILION: usize = 4;
const STAR: usize = 5;
const LOWER_HALF: usize = 6;
const GIRDLE: usize = 7;
const CULET: usize = 8;

/// The family of the oval brilliant.
pub static OVAL: Family = Family {
    key: "oval",
    name: "Oval brilliant",
    first: FamilyCut::first(&OVAL, &[1.4, 2.0, 57.0, 34.5, 40.75, 50.0, 75.0, 3.0, 0.0]),
    net: Some(net),
    proportions: &[
        rows::length_to_width::<LENGTH>([1.2, 1.8]),
        Proportion {
            key: "fullness",
            name: "Fullness",
            unit: Unit::Ratio,
            of: "the exponent of the superellipse",
            meaning: "How full the outline is between its ends and sides: 2 is an ellipse, more is nearer to a rectangle.",
            usual: [2.0, 2.6],
            step: 0.05,
            speed: 0.005,
            least: Bound::at(Fixed(1.5), "where the outline is nearly a rhombus"),
            most: Bound::at(Fixed(4.0), "where the outline is nearly a rectangle"),
            ..number::<FULLNESS>()
        },
        rows::table::<TABLE>([50.0, 68.0]),
        Proportion {
            meaning: "How steep the bezels at the sides stand on the girdle plane. Toward the ends they are flatter.",
            ..rows::slope::<CROWN>("crown_angle", "Crown angle", [28.0, 40.0])
        },
        Proportion {
            meaning: "How steep the mains at the sides stand on the girdle plane. Toward the ends they are flatter.",
            ..rows::slope::<PAVILION>("pavilion_angle", "Pavilion angle", [38.0, 46.0])
        },
        Proportion {
            meaning: "How far the stars reach from the table's edge to the girdle, seen from above.",
            ..rows::part::<STAR>(
                "star_length",
                "Star length",
                "of the way from the table's edge to the girdle",
                [35.0, 65.0],
            )
        },
        Proportion {
            meaning: "How far the lower halves reach from the girdle to the middle, seen from below.",
            ..rows::part::<LOWER_HALF>(
                "lower_half_length",
                "Lower halves",
                "of the way from the girdle to the middle",
                [50.0, 90.0],
            )
        },
        rows::girdle_thickness::<GIRDLE>(),
        rows::culet::<CULET>(),
    ],
};

/// Returns the place on a superellipse of half-axes 1 and `length` at a part of the way around, from +x. Equal parts of
/// the way are equal angles of the circle from which it is stretched.
pub(super) fn superellipse(length: f64, exponent: f64, way: f64) -> Station {
    // Quarters are exact, so that stones are symmetric to the last bit of their extents.
    let (sin, cos) = match (way * 4.0).fract() {
        0.0 => [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)][(way * 4.0) as usize % 4],
        _ => (way * TAU).sin_cos(),
    };
    let radius = (cos.abs().powf(exponent) + sin.abs().powf(exponent)).powf(-1.0 / exponent);
    let slope = |part: f64| part.signum() * (radius * part.abs()).powf(exponent - 1.0);
    Station {
        at: DVec2::new(cos, sin * length) * radius,
        normal: DVec2::new(slope(cos), slope(sin) / length).normalize_or(DVec2::X),
    }
}

fn net(cut: &FamilyCut) -> Result<FacetNet, Unfit> {
    let girdle = Girdle::new(8, 4, |way| superellipse(cut[LENGTH], cut[FULLNESS], way));
    let table = cut[TABLE] / 100.0;
    let brilliant = Brilliant {
        girdle: &girdle,
        middle: DVec2::ZERO,
        table,
        crown_height: (1.0 - table) * cut[CROWN].to_radians().tan(),
        star: cut[STAR] / 100.0,
        thickness: cut[GIRDLE] / 50.0,
        pavilion_depth: cut[PAVILION].to_radians().tan(),
        lower_half: cut[LOWER_HALF] / 100.0,
        culet: cut[CULET] / 100.0,
    };
    brilliant.net()
}
