//! The trillion: a brilliant on a triangle with bulged sides, 43 facets.
//!
//! Ranges: L/W 0.90 to 1.10 (yourjewel.com); 31 to 50 facets; library of cutters' designs: table 30 to 59, pavilion depth 38 to
//! 51. The length follows from the bulge; from a corner to the opposite side it is always the shorter extent of the outline.

use super::super::facet_net::{FacetNet, NoRoom};
use super::super::family::BoundAt::Fixed;
use super::super::family::{Bound, Family, Proportion};
use super::super::family_cut::{FamilyCut, number};
use super::super::shape::Cut;
use super::brilliant::Brilliant;
use super::girdle::{Girdle, GirdlePlace};
use super::{brilliant_rows, rows};
use brillianteer_base::Unit;
use glam::DVec2;
use std::f64::consts::{FRAC_PI_3, FRAC_PI_6, TAU};

const BULGE: usize = 0;
const TABLE: usize = 1;
const MAINS: usize = 8;

/// The distance of the middle of a triangle's side from its centre, in halves of a side.
const INNER: f64 = 0.577_350_269_189_625_8;

/// The family of the trillion.
pub static TRILLION: Family = Family {
    key: "trillion",
    name: "Trillion",
    first: FamilyCut::first(&TRILLION, &[9.0, 55.0, 34.0, 41.0, 50.0, 70.0, 3.0, 0.0, 2.0]),
    net: Some(net),
    depth: Some(|cut| Brilliant::total_depth(cut, TABLE, reach(cut))),
    proportions: &[
        Proportion {
            key: "bulge",
            name: "Bulge of the sides",
            of: "of the distance between two corners",
            meaning: "The distance by which the sides bulge out between the corners.",
            usual: [3.0, 12.0],
            least: Bound::at(Fixed(0.5), "where the sides are straight"),
            most: Bound::at(Fixed(13.3), "where the stone is as wide in all directions"),
            ..number::<BULGE>()
        },
        rows::table::<TABLE>([45.0, 65.0]),
        brilliant_rows::crown_angle::<2>([28.0, 42.0]),
        brilliant_rows::pavilion_angle::<3>([38.0, 46.0]),
        brilliant_rows::star_length::<4>(),
        brilliant_rows::lower_half_length::<5>(),
        rows::girdle_thickness::<6>(),
        rows::culet::<7>(),
        Proportion {
            key: "mains_per_side",
            name: "Mains per side",
            of: "in a third of the outline",
            meaning: "The number of mains, and of bezels, in a third of the outline, including the one at a corner; 2 make six mains.",
            usual: [2.0, 3.0],
            most: Bound::at(Fixed(3.0), "the most mains allowed"),
            ..brilliant_rows::mains_per_quarter::<MAINS>()
        },
        Proportion {
            key: "length_to_width",
            name: "Length to width",
            unit: Unit::Ratio,
            of: "the longer extent as a multiple of the shorter",
            meaning: "The longer extent of the outline, along a side with two corners, as a multiple of the shorter, from a corner to the \
                      opposite side.",
            get: |cut| match cut {
                Cut::Family(cut) => 1.0 / length(cut),
                _ => f64::NAN,
            },
            ..Proportion::BLANK
        },
        rows::total_depth([42.0, 58.0], &["pavilion_angle"]),
    ],
};

/// Returns the extent from a corner to the opposite side as a multiple of the distance between two corners, below 1.
fn length(cut: &FamilyCut) -> f64 {
    1.5 * INNER + bulge(cut) / 2.0
}

/// Returns the bulge in halves of the distance between two corners.
fn bulge(cut: &FamilyCut) -> f64 {
    cut[BULGE] / 50.0
}

/// Returns the distance of the middle of a side from the axis, in girdle radii.
fn reach(cut: &FamilyCut) -> f64 {
    (INNER + bulge(cut)) / length(cut)
}

fn net(cut: &FamilyCut) -> Result<FacetNet, NoRoom> {
    let (bulge, length) = (bulge(cut), length(cut));
    let radius = (1.0 + bulge * bulge) / (2.0 * bulge);
    let widest = (1.0 / radius).asin();
    // The length is shorter than the width, so half of the length is 1.
    let centre = DVec2::Y * ((INNER + bulge) / length - 1.0);
    let place = |at: DVec2, normal: f64, is_corner: bool| GirdlePlace {
        at: centre + at / length,
        normal: DVec2::from_angle(normal),
        is_corner,
    };
    let corner = |number: f64| {
        let angle = number * TAU / 3.0 + 3.0 * FRAC_PI_6;
        (DVec2::from_angle(angle) * (2.0 * INNER), angle)
    };
    let curve = |way: f64| {
        let (number, part) = ((3.0 * way).floor(), (3.0 * way).fract());
        let (at, angle) = corner(number);
        if part == 0.0 {
            return place(at, angle, true);
        }
        let (side, turn) = (angle + FRAC_PI_3, (2.0 * part - 1.0) * widest);
        let arc = DVec2::from_angle(side) * (INNER + bulge - radius);
        place(arc + DVec2::from_angle(side + turn) * radius, side + turn, false)
    };
    let girdle = Girdle::new(3 * cut[MAINS] as usize, curve);
    Brilliant::of(cut, TABLE, &girdle, centre, reach(cut)).net()
}
