//! The marquise: a brilliant with two points, 57 facets.
//!
//! Ranges: L/W 1.80 to 2.20 (yourjewel.com), library of cutters' designs 1.61 to 2.67; table 53 to 60, crown 34 to 35, pavilion
//! 39.25 to 40.75 degrees (diamondcuttersintl.com, class I).

use super::super::facet_net::{FacetNet, NoRoom};
use super::super::family::Family;
use super::super::family_cut::FamilyCut;
use super::brilliant::Brilliant;
use super::curves::{Wing, around};
use super::girdle::Girdle;
use super::{brilliant_rows, rows};
use glam::DVec2;

const LENGTH: usize = 0;
const FULLNESS: usize = 1;
const TABLE: usize = 2;
const MAINS: usize = 9;

/// The family of the marquise.
pub static MARQUISE: Family = Family {
    key: "marquise",
    name: "Marquise",
    first: FamilyCut::first(&MARQUISE, &[2.0, 100.0, 57.0, 34.5, 40.75, 50.0, 75.0, 3.0, 0.0, 2.0]),
    net: Some(net),
    depth: Some(|cut| Brilliant::total_depth(cut, TABLE, 1.0)),
    proportions: &[
        rows::length_to_width::<LENGTH>([1.6, 2.5]),
        brilliant_rows::fullness::<FULLNESS>(),
        rows::table::<TABLE>([50.0, 66.0]),
        brilliant_rows::crown_angle::<3>([28.0, 40.0]),
        brilliant_rows::pavilion_angle::<4>([38.0, 46.0]),
        brilliant_rows::star_length::<5>(),
        brilliant_rows::lower_half_length::<6>(),
        rows::girdle_thickness::<7>(),
        rows::culet::<8>(),
        brilliant_rows::mains_per_quarter::<MAINS>(),
        rows::total_depth([54.0, 68.0], &["pavilion_angle"]),
    ],
};

fn net(cut: &FamilyCut) -> Result<FacetNet, NoRoom> {
    let wing = Wing::new(cut[LENGTH], cut[FULLNESS] / 100.0).ok_or(NoRoom { tier: "girdle" })?;
    let girdle = Girdle::new(4 * cut[MAINS] as usize, |way| around(way, |part| wing.at(part)));
    Brilliant::of(cut, TABLE, &girdle, DVec2::ZERO, 1.0).net()
}
