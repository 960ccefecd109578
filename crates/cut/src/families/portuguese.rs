//! The Portuguese cut: equal rows of facets on crown and pavilion, each row turned by half a step against the row
//! before.
//!
//! The first cut has the numbers of PC 01.028A: 16 facets a row, crown 52/45/40/35/30, pavilion 60/56/52/48/44/40,
//! table .45. The trade quotes 161 to 193 facets. Ranges of angles and sizes are those of PC 01.028A, B and C,
//! widened by an estimate.

use super::super::facet_net::{FacetNet, NoRoom};
use super::super::family::BoundAt::Fixed;
use super::super::family::{Bound, Family, Proportion};
use super::super::family_cut::FamilyCut;
use super::super::shape::Cut;
use super::alternating::{AlternatingRows, StoneHalf, add_girdle};
use super::rows;
use glam::DVec3;

const FACETS: usize = 0;
const CROWN_ROWS: usize = 1;
const PAVILION_ROWS: usize = 2;
const TABLE: usize = 3;
const CROWN: usize = 4;
const PAVILION: usize = 5;
const ROSETTE: usize = 6;
const GIRDLE: usize = 7;

/// The family of the Portuguese cut.
pub static PORTUGUESE: Family = Family {
    key: "portuguese",
    name: "Portuguese cut",
    first: FamilyCut::first(&PORTUGUESE, &[16.0, 5.0, 6.0, 46.0, 52.0, 40.0, 26.5, 3.0]),
    net: Some(net),
    depth: Some(depth),
    proportions: &[
        rows::facets_per_row::<FACETS>([12.0, 24.0]),
        rows::row_count::<CROWN_ROWS>("crown_rows", "Crown rows", [2.0, 5.0]),
        rows::row_count::<PAVILION_ROWS>("pavilion_rows", "Pavilion rows", [2.0, 6.0]),
        Proportion {
            meaning: "The width of the flat facet on top, from corner to opposite corner. The last row of the crown touches it with its \
                      tips.",
            ..rows::table::<TABLE>([35.0, 60.0])
        },
        Proportion {
            meaning: "The angle between the row at the girdle and the girdle plane. Each row above it is flatter.",
            ..rows::slope::<CROWN>("crown_angle", "Crown angle", [35.0, 55.0])
        },
        Proportion {
            meaning: "The angle between the row at the culet and the girdle plane. Each row above it is steeper.",
            ..rows::slope::<PAVILION>("pavilion_angle", "Pavilion angle", [37.0, 44.0])
        },
        rows::rosette::<ROSETTE>("rosette", "Rosette", [25.0, 45.0]),
        rows::girdle_thickness::<GIRDLE>(),
        Proportion {
            key: "table_row_angle",
            name: "Row at the table",
            meaning: "The angle between the crown's row at the table and the girdle plane.",
            least: Bound::at(Fixed(2.0), "the flattest facet allowed"),
            get: |cut| angle(cut, |cut| crown(cut).last_flattening() * tangent(cut, CROWN)),
            ..ANGLE
        },
        Proportion {
            key: "girdle_row_angle",
            name: "Row at the girdle",
            meaning: "The angle between the pavilion's row at the girdle and the girdle plane.",
            most: Bound::at(Fixed(88.0), "the steepest facet allowed"),
            get: |cut| angle(cut, girdle_row_tangent),
            ..ANGLE
        },
        rows::total_depth([75.0, 100.0], &["pavilion_angle"]),
    ],
};

/// The common part of the rows of derived angles.
const ANGLE: Proportion = Proportion { give: None, ..rows::slope::<FACETS>("", "", [0.0, 90.0]) };

/// Returns the angle, in degrees, of a tangent that follows from the numbers.
fn angle(cut: &Cut, tangent: fn(&FamilyCut) -> f64) -> f64 {
    match cut {
        Cut::Family(cut) => tangent(cut).atan().to_degrees(),
        _ => f64::NAN,
    }
}

fn tangent(cut: &FamilyCut, place: usize) -> f64 {
    cut[place].to_radians().tan()
}

fn crown(cut: &FamilyCut) -> AlternatingRows {
    AlternatingRows {
        facets: cut[FACETS] as usize,
        count: cut[CROWN_ROWS] as usize,
        inner: cut[TABLE] / 100.0,
    }
}

fn pavilion(cut: &FamilyCut) -> AlternatingRows {
    AlternatingRows {
        facets: cut[FACETS] as usize,
        count: cut[PAVILION_ROWS] as usize,
        inner: cut[ROSETTE] / 100.0,
    }
}

/// Returns the tangent of the angle of the pavilion's row at the girdle.
fn girdle_row_tangent(cut: &FamilyCut) -> f64 {
    tangent(cut, PAVILION) / pavilion(cut).last_flattening()
}

fn depth(cut: &FamilyCut) -> f64 {
    let (crown, pavilion) = (crown(cut), pavilion(cut));
    let below = girdle_row_tangent(cut) * pavilion.point();
    tangent(cut, CROWN) * crown.last_ring() + cut[GIRDLE] / 50.0 + below
}

fn net(cut: &FamilyCut) -> Result<FacetNet, NoRoom> {
    let (crown, pavilion) = (crown(cut), pavilion(cut));
    let mut net = FacetNet::default();
    let tangent = tangent(cut, CROWN);
    net.plane("table", DVec3::Z, DVec3::Z * tangent * crown.last_ring());
    crown.add_to(&mut net, StoneHalf::Crown, 0.0, tangent);
    let thickness = cut[GIRDLE] / 50.0;
    if thickness > 0.0 {
        add_girdle(&mut net, crown.facets);
    }
    pavilion.add_to(&mut net, StoneHalf::Pavilion, -thickness, girdle_row_tangent(cut));
    Ok(net)
}
