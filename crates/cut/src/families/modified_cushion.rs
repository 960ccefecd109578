//! The modified cushion: the crown of a brilliant on a pavilion of chevrons, 61 to 77 facets.
//!
//! Chevrons replace the mains of the pavilion, in 2 to 4 rows (caratwire.com). L/W, table and depth are those of the
//! cushion with mains. No source gives angles of the rows: they are chosen so that the depth is 61 to 68
//! (gemmology.dev).

use super::super::facet_net::{FacetNet, NoRoom};
use super::super::family::BoundAt::{Fixed, Of};
use super::super::family::{Bound, Family, Proportion};
use super::super::family_cut::{FamilyCut, number};
use super::super::shape::Cut;
use super::brilliant::Brilliant;
use super::curves::around;
use super::cushion_chevrons::CushionChevrons;
use super::girdle::Girdle;
use super::{brilliant_rows, cushion, rows};
use brillianteer_base::Unit;
use glam::DVec2;

const LENGTH: usize = 0;
const BULGE: usize = 1;
const CORNER: usize = 2;
const TABLE: usize = 3;
const CROWN: usize = 4;
const UPPER: usize = 5;
const LOWER: usize = 6;
const STAR: usize = 7;
const TIP: usize = 8;
const GIRDLE: usize = 9;
const CULET: usize = 10;
const ROWS: usize = 11;

/// The family of the modified cushion.
pub static MODIFIED_CUSHION: Family = Family {
    key: "modified_cushion",
    name: "Modified cushion",
    first: FamilyCut::first(
        &MODIFIED_CUSHION,
        &[1.05, 6.0, 20.0, 62.0, 34.0, 50.0, 37.0, 50.0, 25.0, 4.0, 0.0, 3.0],
    ),
    net: Some(net),
    depth: Some(depth),
    proportions: &[
        rows::length_to_width::<LENGTH>([1.0, 1.4]),
        cushion::bulge::<BULGE>(),
        cushion::corner::<CORNER>(),
        rows::table::<TABLE>([50.0, 70.0]),
        brilliant_rows::crown_angle::<CROWN>([28.0, 40.0]),
        Proportion {
            meaning: "The angle of the first row of chevrons, at the girdle, along the middle of a long side.",
            least: Bound::before(Of(lower), "where the rows would be one"),
            ..rows::slope::<UPPER>("upper_angle", "Angle of the first row", [47.0, 58.0])
        },
        Proportion {
            meaning: "The angle of the last row of chevrons, at the culet, along the middle of a long side. The angles of the other rows lie in between.",
            ..rows::slope::<LOWER>("lower_angle", "Angle of the last row", [33.0, 42.0])
        },
        brilliant_rows::star_length::<STAR>(),
        Proportion {
            meaning: "The depth of the tips, each the point that all rows of half a side share.",
            ..rows::part::<TIP>("tip_depth", "Depth of the tips", "of the pavilion's depth", [18.0, 32.0])
        },
        rows::girdle_thickness::<GIRDLE>(),
        rows::culet::<CULET>(),
        Proportion {
            key: "rows",
            name: "Rows",
            unit: Unit::Count,
            of: "on each side of the pavilion",
            meaning: "The number of rows of chevrons on each side of the pavilion: few rows make broad flashes, many rows make small ones.",
            usual: [2.0, 4.0],
            step: 1.0,
            speed: 0.02,
            least: Bound::at(Fixed(2.0), "the fewest rows that a chevron has"),
            most: Bound::at(Fixed(4.0), "the most rows allowed"),
            ..number::<ROWS>()
        },
        rows::total_depth([58.0, 72.0], &["upper_angle", "lower_angle"]),
    ],
};

/// Returns the angle of the last row, in degrees.
fn lower(cut: &Cut) -> f64 {
    match cut {
        Cut::Family(cut) => cut[LOWER],
        _ => f64::NAN,
    }
}

/// Returns the tangents of the rows' angles, from the girdle to the culet, in even steps.
fn slopes(cut: &FamilyCut) -> Vec<f64> {
    let ([upper, lower], rows) = ([UPPER, LOWER].map(|end| cut[end].to_radians().tan()), cut[ROWS] as usize);
    (0..rows).map(|row| upper + (lower - upper) * row as f64 / (rows - 1).max(1) as f64).collect()
}

fn depth(cut: &FamilyCut) -> f64 {
    let crown = (1.0 - cut[TABLE] / 100.0) * cut[CROWN].to_radians().tan();
    let slopes = slopes(cut);
    let pavilion = slopes.iter().sum::<f64>() / slopes.len().max(1) as f64;
    crown + cut[GIRDLE] / 50.0 + pavilion * (1.0 - cut[CULET] / 100.0)
}

fn net(cut: &FamilyCut) -> Result<FacetNet, NoRoom> {
    let quarter = cushion::quarter(cut[LENGTH], cut[BULGE], cut[CORNER])?;
    let girdle = Girdle::new(8, |way| around(way, |part| quarter.at(part)));
    let (table, thickness) = (cut[TABLE] / 100.0, cut[GIRDLE] / 50.0);
    let chevrons = CushionChevrons { girdle: &girdle, thickness, slopes: slopes(cut), tip: cut[TIP] / 100.0 };
    let brilliant = Brilliant {
        girdle: &girdle,
        middle: DVec2::ZERO,
        table,
        crown_height: (1.0 - table) * cut[CROWN].to_radians().tan(),
        star: cut[STAR] / 100.0,
        is_star_free: false,
        thickness,
        pavilion_depth: chevrons.depth(),
        lower_half: 0.0,
        culet: cut[CULET] / 100.0,
    };
    let mut net = brilliant.without_pavilion()?;
    chevrons.add_to(&mut net)?;
    Ok(net)
}
