//! The pear: a brilliant with a head and a point, 57 facets.
//!
//! Ranges: L/W 1.50 to 1.75 (yourjewel.com), library of cutters' designs 1.23 to 1.72; table 53 to 60, crown 34 to 35, pavilion
//! 39.25 to 40.75 degrees (diamondcuttersintl.com, class I).

use super::super::facet_net::{FacetNet, NoRoom};
use super::super::family::BoundAt::Fixed;
use super::super::family::{Bound, Family, Proportion};
use super::super::family_cut::{FamilyCut, number};
use super::brilliant::Brilliant;
use super::curves::{Wing, around};
use super::girdle::{Girdle, GirdlePlace};
use super::{brilliant_rows, rows};
use glam::DVec2;
use std::f64::consts::FRAC_PI_2;

const LENGTH: usize = 0;
const FULLNESS: usize = 1;
const HEAD: usize = 2;
const MIDDLE: usize = 3;
const TABLE: usize = 4;
const MAINS: usize = 11;

/// The family of the pear.
pub static PEAR: Family = Family {
    key: "pear",
    name: "Pear",
    first: FamilyCut::first(&PEAR, &[1.6, 100.0, 100.0, 0.0, 57.0, 34.5, 40.75, 50.0, 75.0, 3.0, 0.0, 2.0]),
    net: Some(net),
    depth: Some(|cut| Brilliant::total_depth(cut, TABLE, 1.0)),
    proportions: &[
        rows::length_to_width::<LENGTH>([1.4, 1.9]),
        Proportion { name: "Shoulder fullness", ..brilliant_rows::fullness::<FULLNESS>() },
        Proportion {
            key: "head",
            name: "Head",
            of: "of half the width",
            meaning: "The length of the head from the widest place; 100 is a half circle.",
            usual: [85.0, 110.0],
            least: Bound::at(Fixed(40.0), "the flattest head allowed"),
            most: Bound::at(Fixed(200.0), "the longest head allowed"),
            ..number::<HEAD>()
        },
        Proportion {
            key: "middle",
            name: "Middle",
            meaning: "The distance of the culet and the middle of the table from the widest place toward the point.",
            least: Bound::at(Fixed(-30.0), "the lowest middle allowed"),
            most: Bound::at(Fixed(60.0), "the highest middle allowed"),
            ..rows::of_width::<MIDDLE>("middle", "Middle", [-5.0, 12.0])
        },
        rows::table::<TABLE>([50.0, 66.0]),
        brilliant_rows::crown_angle::<5>([28.0, 40.0]),
        brilliant_rows::pavilion_angle::<6>([38.0, 46.0]),
        brilliant_rows::star_length::<7>(),
        brilliant_rows::lower_half_length::<8>(),
        rows::girdle_thickness::<9>(),
        rows::culet::<10>(),
        brilliant_rows::mains_per_quarter::<MAINS>(),
        rows::total_depth([54.0, 68.0], &["pavilion_angle"]),
    ],
};

fn net(cut: &FamilyCut) -> Result<FacetNet, NoRoom> {
    let head = cut[HEAD] / 100.0;
    let point = 2.0 * cut[LENGTH] - head;
    let wing = Wing::new(point, cut[FULLNESS] / 100.0).ok_or(NoRoom { tier: "girdle" })?;
    // The widest place has this distance from the middle of the length.
    let widest = DVec2::new(0.0, head - cut[LENGTH]);
    let curve = |way: f64| {
        let place = around(way, |part| if way < 0.5 { wing.at(part) } else { ellipse(head, part) });
        GirdlePlace { at: place.at + widest, ..place }
    };
    let girdle = Girdle::new(4 * cut[MAINS] as usize, curve);
    let middle = widest + DVec2::Y * (cut[MIDDLE] / 50.0);
    Brilliant::of(cut, TABLE, &girdle, middle, 1.0).net()
}

/// Returns the place at a part of the way from (1, 0) to (0, `height`) on an ellipse.
fn ellipse(height: f64, part: f64) -> GirdlePlace {
    let (sin, cos) = if part == 1.0 { (1.0, 0.0) } else { (part * FRAC_PI_2).sin_cos() };
    let normal = DVec2::new(cos * height, sin).normalize_or(DVec2::X);
    GirdlePlace { at: DVec2::new(cos, sin * height), normal, is_corner: false }
}
