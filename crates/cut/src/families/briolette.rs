//! The briolette: a drop without table and girdle. Its rows of facets alternate by half a step, above and below its
//! widest place.
//!
//! The kind of its rows is that of PC 01.386: 16 facets a row, five rows below and four above. That stone is a
//! barrel. The drop here, its length and the sizes of the rosettes are estimates of the shape of earrings.

use super::super::facet_net::{FacetNet, NoRoom};
use super::super::family::{Family, Proportion};
use super::super::family_cut::FamilyCut;
use super::alternating::{AlternatingRows, StoneHalf};
use super::rows;

const FACETS: usize = 0;
const UPPER_ROWS: usize = 1;
const LOWER_ROWS: usize = 2;
const LENGTH: usize = 3;
const DROP: usize = 4;
const UPPER_ROSETTE: usize = 5;
const LOWER_ROSETTE: usize = 6;

/// The family of the briolette.
pub static BRIOLETTE: Family = Family {
    key: "briolette",
    name: "Briolette",
    first: FamilyCut::first(&BRIOLETTE, &[16.0, 7.0, 6.0, 1.8, 62.0, 25.0, 60.0]),
    net: Some(net),
    depth: Some(|cut| 2.0 * cut[LENGTH]),
    proportions: &[
        rows::facets_per_row::<FACETS>([12.0, 24.0]),
        rows::row_count::<UPPER_ROWS>("upper_rows", "Upper rows", [2.0, 7.0]),
        rows::row_count::<LOWER_ROWS>("lower_rows", "Lower rows", [2.0, 6.0]),
        Proportion {
            name: "Drop length to width",
            of: "the length along the axis as a multiple of the width",
            meaning: "The length of the drop from tip to tip as a multiple of its width.",
            ..rows::length_to_width::<LENGTH>([1.2, 3.0])
        },
        Proportion {
            meaning: "The part of the length that lies above the widest place, on the side by which the drop hangs.",
            ..rows::part::<DROP>("drop", "Drop", "of the length", [45.0, 75.0])
        },
        rows::rosette::<UPPER_ROSETTE>("upper_rosette", "Upper rosette", [15.0, 40.0]),
        rows::rosette::<LOWER_ROSETTE>("lower_rosette", "Lower rosette", [25.0, 65.0]),
        Proportion {
            meaning: "The height of the whole stone. Setting it scales the drop along its axis.",
            ..rows::total_depth([120.0, 300.0], &["length_to_width"])
        },
    ],
};

fn net(cut: &FamilyCut) -> Result<FacetNet, NoRoom> {
    let rows = |count: usize, rosette: usize| AlternatingRows {
        facets: cut[FACETS] as usize,
        count: cut[count] as usize,
        inner: cut[rosette] / 100.0,
    };
    let (upper, lower) = (rows(UPPER_ROWS, UPPER_ROSETTE), rows(LOWER_ROWS, LOWER_ROSETTE));
    let length = 2.0 * cut[LENGTH];
    let above = length * cut[DROP] / 100.0;
    let mut net = FacetNet::default();
    upper.add_to(&mut net, StoneHalf::Crown, 0.0, above / upper.point());
    lower.add_to(&mut net, StoneHalf::Pavilion, 0.0, (length - above) / lower.point());
    Ok(net)
}
