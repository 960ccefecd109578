//! The Asscher cut, or square emerald cut: steps on a square with wide corners, a high crown and a small table.
//!
//! Ranges: L/W from 1 (amorejewelry.com, which also names the high crown, the small table and the wide corners) up to
//! outlines that still look square. No figures are published for the crown. The figures here are chosen: corners
//! almost as wide as those of a regular octagon, so that the rows of the corners form the windmill, and the pavilion
//! of an emerald cut (diamondcuttersintl.com).

use super::super::facet_net::{FacetNet, NoRoom};
use super::super::family::Family;
use super::super::family_cut::FamilyCut;
use super::steps::{Rectangle, StepPlaces};
use super::{rows, step_rows};

const LENGTH: usize = 0;
const CORNER: usize = 1;
const TABLE: usize = 2;
const CROWN_ROWS: usize = 3;
const CROWN: usize = 4;
const CROWN_STEP: usize = 5;
const PAVILION_ROWS: usize = 6;
const PAVILION: usize = 7;
const PAVILION_STEP: usize = 8;
const KEEL: usize = 9;
const GIRDLE: usize = 10;

const PLACES: StepPlaces = StepPlaces {
    table: TABLE,
    crown: [CROWN_ROWS, CROWN, CROWN_STEP],
    pavilion: [PAVILION_ROWS, PAVILION, PAVILION_STEP],
    girdle: GIRDLE,
};

/// The family of the Asscher cut.
pub static ASSCHER: Family = Family {
    key: "asscher",
    name: "Asscher cut",
    first: FamilyCut::first(&ASSCHER, &[1.0, 22.0, 55.0, 3.0, 38.0, 9.0, 3.0, 46.0, 8.0, 100.0, 3.0]),
    net: Some(net),
    depth: Some(|cut| PLACES.profile(cut, outline(cut).reach()).depth()),
    proportions: &[
        rows::length_to_width::<LENGTH>([1.0, 1.08]),
        step_rows::corner::<CORNER>([16.0, 28.0]),
        rows::table::<TABLE>([45.0, 65.0]),
        step_rows::crown_rows::<CROWN_ROWS>(),
        step_rows::crown::<CROWN>([30.0, 46.0]),
        step_rows::crown_step::<CROWN_STEP>(),
        step_rows::pavilion_rows::<PAVILION_ROWS>(),
        step_rows::pavilion::<PAVILION>([40.0, 52.0]),
        step_rows::pavilion_step::<PAVILION_STEP>(),
        step_rows::keel::<KEEL>(),
        rows::girdle_thickness::<GIRDLE>(),
        rows::step_depth([62.0, 82.0]),
    ],
};

fn outline(cut: &FamilyCut) -> Rectangle {
    Rectangle { length: cut[LENGTH], corner: cut[CORNER] / 50.0, keel: cut[KEEL] / 100.0 }
}

fn net(cut: &FamilyCut) -> Result<FacetNet, NoRoom> {
    outline(cut).net(cut, &PLACES)
}
