//! The baguette: steps on a slim rectangle with sharp corners.
//!
//! Ranges: a design of 17 facets, of which four are on the girdle, has L/W 2.0, one crown row at 35 degrees and two
//! pavilion rows at 51 and 41 (GemCad's library, PC 12.001); table and lengths are chosen around it.

use super::super::facet_net::{FacetNet, NoRoom};
use super::super::family::Family;
use super::super::family_cut::FamilyCut;
use super::steps::{Rectangle, StepPlaces};
use super::{rows, step_rows};

const LENGTH: usize = 0;
const TABLE: usize = 1;
const CROWN_ROWS: usize = 2;
const CROWN: usize = 3;
const CROWN_STEP: usize = 4;
const PAVILION_ROWS: usize = 5;
const PAVILION: usize = 6;
const PAVILION_STEP: usize = 7;
const KEEL: usize = 8;
const GIRDLE: usize = 9;

const PLACES: StepPlaces = StepPlaces {
    table: TABLE,
    crown: [CROWN_ROWS, CROWN, CROWN_STEP],
    pavilion: [PAVILION_ROWS, PAVILION, PAVILION_STEP],
    girdle: GIRDLE,
};

/// The family of the baguette.
pub static BAGUETTE: Family = Family {
    key: "baguette",
    name: "Baguette",
    first: FamilyCut::first(&BAGUETTE, &[2.0, 65.0, 1.0, 35.0, 8.0, 2.0, 46.0, 10.0, 100.0, 3.0]),
    net: Some(net),
    depth: Some(|cut| PLACES.profile(cut, outline(cut).reach()).depth()),
    proportions: &[
        rows::length_to_width::<LENGTH>([1.5, 3.0]),
        rows::table::<TABLE>([50.0, 75.0]),
        step_rows::crown_rows::<CROWN_ROWS>(),
        step_rows::crown::<CROWN>([26.0, 42.0]),
        step_rows::crown_step::<CROWN_STEP>(),
        step_rows::pavilion_rows::<PAVILION_ROWS>(),
        step_rows::pavilion::<PAVILION>([40.0, 52.0]),
        step_rows::pavilion_step::<PAVILION_STEP>(),
        step_rows::keel::<KEEL>(),
        rows::girdle_thickness::<GIRDLE>(),
        rows::step_depth([58.0, 76.0]),
    ],
};

fn outline(cut: &FamilyCut) -> Rectangle {
    Rectangle { length: cut[LENGTH], corner: 0.0, keel: cut[KEEL] / 100.0 }
}

fn net(cut: &FamilyCut) -> Result<FacetNet, NoRoom> {
    outline(cut).net(cut, &PLACES)
}
