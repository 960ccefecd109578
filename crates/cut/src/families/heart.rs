//! The heart: a brilliant with two lobes, a cleft and a point, of 59 facets, or 60 with a culet. It is not convex at
//! its cleft.
//!
//! Both halves are convex brilliants of the same construction, and meet in the plane x = 0. Each half has a bezel and
//! a main of its own at the cleft.
//!
//! Ranges: L/W 0.90 to 1.10 (yourjewel.com), library of cutters' designs 1.00 to 1.06; cleft, lobes and fullness are chosen to
//! look like the trade's pictures.

use super::super::facet_net::{FacetNet, NoRoom};
use super::super::family::BoundAt::{Fixed, Of};
use super::super::family::{Bound, Family, Proportion};
use super::super::family_cut::{FamilyCut, number};
use super::super::shape::Cut;
use super::brilliant::Brilliant;
use super::curves::Wing;
use super::girdle::{Girdle, GirdlePlace};
use super::{brilliant_rows, rows};
use brillianteer_base::Unit;
use glam::DVec2;
use std::f64::consts::FRAC_PI_2;

const LENGTH: usize = 0;
const CLEFT: usize = 1;
const LOBE: usize = 2;
const FULLNESS: usize = 3;
const MIDDLE: usize = 4;
const TABLE: usize = 5;
const MAINS: usize = 12;

/// The stations from the point to the widest place, as parts of the way from the widest place to the point, for a
/// heart with four gaps in each half. Mains and the places between them alternate; the first is a main. With more
/// gaps, stations are spread in the same way.
const SIDE: [f64; 4] = [1.0, 0.68, 0.34, 0.0];

/// The stations from the widest place to the top of the lobe, as parts of the quarter by which the outline turns. The
/// widest place and the top are stations, so that length and width are exact.
const OUTER_LOBE: [f64; 4] = [0.0, 0.4, 0.7, 1.0];

/// The family of the heart.
pub static HEART: Family = Family {
    key: "heart",
    name: "Heart",
    first: FamilyCut::first(
        &HEART,
        &[1.0, 14.0, 30.0, 100.0, 8.0, 56.0, 34.5, 40.75, 35.0, 75.0, 4.0, 0.0, 4.0],
    ),
    net: Some(net),
    depth: Some(|cut| Brilliant::total_depth(cut, TABLE, scale(cut))),
    proportions: &[
        rows::length_to_width::<LENGTH>([0.9, 1.1]),
        Proportion {
            meaning: "The depth of the cleft below the tops of the lobes.",
            least: Bound::at(Fixed(0.5), "where the lobes are one"),
            most: Bound::before(Of(lobe), "where both lobes are half circles or ellipses"),
            ..rows::of_width::<CLEFT>("cleft", "Cleft", [8.0, 20.0])
        },
        Proportion {
            meaning: "The height of the lobes above the widest place.",
            least: Bound::at(Fixed(5.0), "the flattest lobes allowed"),
            most: Bound::at(Fixed(70.0), "the highest lobes allowed"),
            ..rows::of_width::<LOBE>("lobe_height", "Lobe height", [25.0, 35.0])
        },
        brilliant_rows::fullness::<FULLNESS>(),
        Proportion {
            meaning: "The distance of the culet and the middle of the table from the widest place toward the point.",
            least: Bound::at(Fixed(-30.0), "the highest middle allowed"),
            most: Bound::at(Fixed(60.0), "the lowest middle allowed"),
            ..rows::of_width::<MIDDLE>("middle", "Middle", [0.0, 15.0])
        },
        rows::table::<TABLE>([50.0, 66.0]),
        Proportion {
            meaning: "The angle between the girdle plane and a bezel at half the width from the middle. Bezels farther away are \
                      flatter.",
            ..brilliant_rows::crown_angle::<6>([28.0, 40.0])
        },
        Proportion {
            meaning: "The angle between the girdle plane and a main at half the width from the middle. Mains farther away are \
                      flatter.",
            ..brilliant_rows::pavilion_angle::<7>([38.0, 46.0])
        },
        Proportion {
            of: "of the way from where they would lie flat to the girdle",
            meaning: "The reach of the stars toward the girdle, from the place where they would lie flat with the table.",
            usual: [20.0, 50.0],
            ..brilliant_rows::star_length::<8>()
        },
        brilliant_rows::lower_half_length::<9>(),
        rows::girdle_thickness::<10>(),
        rows::culet::<11>(),
        Proportion {
            key: "mains_per_half",
            name: "Mains per half",
            unit: Unit::Count,
            of: "in half of the outline",
            meaning: "The number of mains, and of bezels, in each half of the outline, besides the one at the point; 4 make nine bezels.",
            usual: [4.0, 6.0],
            step: 1.0,
            speed: 0.02,
            least: Bound::at(Fixed(4.0), "the fewest mains that follow the lobes"),
            most: Bound::at(Fixed(6.0), "the most mains allowed"),
            default: Some(4.0),
            ..number::<MAINS>()
        },
        rows::total_depth([54.0, 70.0], &["pavilion_angle"]),
    ],
};

/// Returns the height of the lobes, in percent of the width.
fn lobe(cut: &Cut) -> f64 {
    match cut {
        Cut::Family(cut) => cut[LOBE],
        _ => f64::NAN,
    }
}

/// Returns half of the width in girdle radii, of which one is half of the shorter extent.
fn scale(cut: &FamilyCut) -> f64 {
    1.0 / cut[LENGTH].min(1.0)
}

fn net(cut: &FamilyCut) -> Result<FacetNet, NoRoom> {
    // Numbers are percent of the shorter extent, whose half is 1 in the result; the curve is made with half the width
    // as 1.
    let (length, scale) = (cut[LENGTH], scale(cut));
    let lobe = cut[LOBE] / 50.0 / scale;
    let point = 2.0 * length - lobe;
    let wing = Wing::new(point, cut[FULLNESS] / 100.0).ok_or(NoRoom { tier: "girdle" })?;
    let widest = DVec2::new(0.0, point - length) * scale;
    // Each lobe is an arc of an ellipse, from the widest place over its top to the cleft.
    let sine = 1.0 - cut[CLEFT] / cut[LOBE];
    let across = 1.0 / (1.0 + (1.0 - sine * sine).sqrt());
    let place = |at: DVec2, normal: DVec2, is_corner: bool| GirdlePlace {
        at: widest + at * scale,
        normal: normal.normalize_or(DVec2::X),
        is_corner,
    };
    let side = |part: f64| {
        let (GirdlePlace { at, normal, is_corner }, below) = (wing.at(part), DVec2::new(1.0, -1.0));
        place(at * below, normal * below, is_corner)
    };
    let lobe_at = |angle: f64| {
        // The top is exact to the last bit.
        let (sin, cos) = if angle == FRAC_PI_2 { (1.0, 0.0) } else { angle.sin_cos() };
        let normal = DVec2::new(cos, sin);
        let (sin, cos) = (sin / across, cos / lobe);
        let size = sin.hypot(cos);
        let at = DVec2::new(1.0 - across + across * cos / size, lobe * sin / size);
        place(at, normal, false)
    };
    // This is the angle of the normal at the cleft.
    let cleft = (sine * across).atan2(-(1.0 - sine * sine).sqrt() * lobe);
    let gaps = cut[MAINS] as usize;
    let (sides, outer) = (gaps - 1, gaps.div_ceil(2) + 1);
    let inner = 2 * gaps - sides - outer;
    let steps = sides + outer + inner;
    let curve = |way: f64| {
        let step = way * steps as f64;
        let (on_outer, on_inner) = (step - sides as f64, step - (sides + outer) as f64);
        if on_outer < 0.0 {
            side(station(&SIDE, step / sides as f64))
        } else if on_inner < 0.0 {
            lobe_at(station(&OUTER_LOBE, on_outer / outer as f64) * FRAC_PI_2)
        } else if on_inner < inner as f64 {
            lobe_at(station(&[FRAC_PI_2, cleft], on_inner / inner as f64))
        } else {
            let GirdlePlace { at, normal, .. } = lobe_at(cleft);
            GirdlePlace { at: DVec2::new(0.0, at.y), normal, is_corner: true }
        }
    };
    let girdle = Girdle::half(gaps, curve);
    let middle = widest - DVec2::Y * (cut[MIDDLE] / 50.0);
    Brilliant { is_star_free: true, ..Brilliant::of(cut, TABLE, &girdle, middle, scale) }.net()
}

/// Returns the number at a part of the way along a list, interpolated between two of its numbers.
fn station(list: &[f64], way: f64) -> f64 {
    let place = way * (list.len() - 1) as f64;
    let from = (place as usize).min(list.len() - 2);
    list[from] + (list[from + 1] - list[from]) * (place - from as f64)
}
