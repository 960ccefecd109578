//! The cushion with mains: a brilliant on a rectangle with bulged sides and rounded corners, 57 facets.
//!
//! Ranges: table 58 to 68 (55 to 75), depth 61 to 68, crown 33 to 38, pavilion 40 to 42 (38 to 44) degrees (gemmology.dev);
//! L/W 1.00 to 1.05 square, to 1.30 long; library of cutters' designs: table 45 to 62. Bulge and corners are chosen to look
//! like the trade's pictures.

use super::super::facet_net::{FacetNet, NoRoom};
use super::super::family::BoundAt::Fixed;
use super::super::family::{Bound, Family, Proportion};
use super::super::family_cut::{FamilyCut, number};
use super::brilliant::Brilliant;
use super::curves::{RoundedQuarter, around};
use super::girdle::Girdle;
use super::{brilliant_rows, rows};
use glam::DVec2;

const LENGTH: usize = 0;
const BULGE: usize = 1;
const CORNER: usize = 2;
const TABLE: usize = 3;
const MAINS: usize = 10;

/// The family of the cushion with mains.
pub static CUSHION: Family = Family {
    key: "cushion",
    name: "Cushion brilliant",
    first: FamilyCut::first(&CUSHION, &[1.1, 6.0, 22.0, 60.0, 35.0, 41.0, 50.0, 75.0, 4.0, 0.0, 2.0]),
    net: Some(net),
    depth: Some(|cut| Brilliant::total_depth(cut, TABLE, 1.0)),
    proportions: &[
        rows::length_to_width::<LENGTH>([1.0, 1.4]),
        bulge::<BULGE>(),
        corner::<CORNER>(),
        rows::table::<TABLE>([50.0, 70.0]),
        brilliant_rows::crown_angle::<4>([28.0, 40.0]),
        brilliant_rows::pavilion_angle::<5>([38.0, 46.0]),
        brilliant_rows::star_length::<6>(),
        brilliant_rows::lower_half_length::<7>(),
        rows::girdle_thickness::<8>(),
        rows::culet::<9>(),
        brilliant_rows::mains_per_quarter::<MAINS>(),
        rows::total_depth([58.0, 72.0], &["pavilion_angle"]),
    ],
};

/// Returns the row for the bulge of the sides.
pub(super) const fn bulge<const PLACE: usize>() -> Proportion {
    Proportion {
        meaning: "The distance by which the sides would bulge out between corners that are not rounded.",
        least: Bound::at(Fixed(0.1), "where the sides are straight"),
        most: Bound::at(Fixed(40.0), "where the outline is nearly round"),
        ..rows::of_width::<PLACE>("bulge", "Bulge of the sides", [4.0, 10.0])
    }
}

/// Returns the row for the radius of the corners.
pub(super) const fn corner<const PLACE: usize>() -> Proportion {
    Proportion {
        key: "corner_radius",
        name: "Corner radius",
        of: "of the width",
        meaning: "The radius of the rounded corners.",
        usual: [12.0, 30.0],
        least: Bound::at(Fixed(1.0), "where the corners are sharp"),
        most: Bound::at(Fixed(50.0), "where the outline is nearly round"),
        ..number::<PLACE>()
    }
}

/// Returns the curve of a cushion's outline, as a function of the part of the way from +x to +y.
///
/// # Errors
/// Fails where the sides and corners do not follow one another.
pub(super) fn quarter(length: f64, bulge: f64, corner: f64) -> Result<RoundedQuarter, NoRoom> {
    RoundedQuarter::new(length, bulge / 50.0, corner / 50.0).ok_or(NoRoom { tier: "girdle" })
}

fn net(cut: &FamilyCut) -> Result<FacetNet, NoRoom> {
    let quarter = quarter(cut[LENGTH], cut[BULGE], cut[CORNER])?;
    let girdle = Girdle::new(4 * cut[MAINS] as usize, |way| around(way, |part| quarter.at(part)));
    Brilliant::of(cut, TABLE, &girdle, DVec2::ZERO, 1.0).net()
}
