//! The oval brilliant: a round brilliant that is stretched, with its 57 facets.
//!
//! Ranges: L/W 1.30 to 1.65 (yourjewel.com), table 53 to 62, crown 33 to 36 and pavilion 40 to 42 degrees at the width
//! (gemmology.dev); the outline is an ellipse at an exponent of 2, and squarer above.

use super::super::facet_net::{FacetNet, NoRoom};
use super::super::family::BoundAt::Fixed;
use super::super::family::{Bound, Family, Proportion};
use super::super::family_cut::{FamilyCut, number};
use super::brilliant::Brilliant;
use super::girdle::{Girdle, GirdlePlace};
use super::{brilliant_rows, rows};
use brillianteer_base::Unit;
use glam::DVec2;
use std::f64::consts::TAU;

const LENGTH: usize = 0;
const FULLNESS: usize = 1;
const TABLE: usize = 2;
const MAINS: usize = 9;

/// The family of the oval brilliant.
pub static OVAL: Family = Family {
    key: "oval",
    name: "Oval brilliant",
    first: FamilyCut::first(&OVAL, &[1.4, 2.0, 57.0, 34.5, 40.75, 50.0, 75.0, 3.0, 0.0, 2.0]),
    net: Some(net),
    depth: Some(|cut| Brilliant::total_depth(cut, TABLE, 1.0)),
    proportions: &[
        rows::length_to_width::<LENGTH>([1.2, 1.8]),
        Proportion {
            key: "fullness",
            name: "Fullness",
            unit: Unit::Ratio,
            of: "the exponent of the superellipse",
            meaning: "The fullness of the outline between its ends and sides: 2 is an ellipse, and more is nearer to a rectangle.",
            usual: [2.0, 2.6],
            step: 0.05,
            speed: 0.005,
            least: Bound::at(Fixed(1.5), "where the outline is nearly a rhombus"),
            most: Bound::at(Fixed(4.0), "where the outline is nearly a rectangle"),
            ..number::<FULLNESS>()
        },
        rows::table::<2>([50.0, 68.0]),
        brilliant_rows::crown_angle::<3>([28.0, 40.0]),
        brilliant_rows::pavilion_angle::<4>([38.0, 46.0]),
        brilliant_rows::star_length::<5>(),
        brilliant_rows::lower_half_length::<6>(),
        rows::girdle_thickness::<7>(),
        rows::culet::<8>(),
        brilliant_rows::mains_per_quarter::<9>(),
        rows::total_depth([56.0, 70.0], &["pavilion_angle"]),
    ],
};

/// Returns the place on a superellipse of half-axes 1 and `length` at a part of the way around, from +x. Equal parts of
/// the way are equal angles of the circle from which it is stretched.
pub(super) fn superellipse(length: f64, exponent: f64, way: f64) -> GirdlePlace {
    // Quarters are exact, so that stones are symmetric to the last bit of their extents.
    let (sin, cos) = match (way * 4.0).fract() {
        0.0 => [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)][(way * 4.0) as usize % 4],
        _ => (way * TAU).sin_cos(),
    };
    let radius = (cos.abs().powf(exponent) + sin.abs().powf(exponent)).powf(-1.0 / exponent);
    let slope = |part: f64| part.signum() * (radius * part.abs()).powf(exponent - 1.0);
    GirdlePlace {
        at: DVec2::new(cos, sin * length) * radius,
        normal: DVec2::new(slope(cos), slope(sin) / length).normalize_or(DVec2::X),
        is_corner: false,
    }
}

fn net(cut: &FamilyCut) -> Result<FacetNet, NoRoom> {
    let mains = 4 * cut[MAINS] as usize;
    let girdle = Girdle::new(mains, |way| superellipse(cut[LENGTH], cut[FULLNESS], way));
    Brilliant::of(cut, TABLE, &girdle, DVec2::ZERO, 1.0).net()
}
