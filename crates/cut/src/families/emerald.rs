//! The emerald cut: steps on a rectangle with cut corners, and a keel.
//!
//! Ranges: L/W 1.40 to 1.70 (amorejewelry.com) and somewhat around it; table 58 to 65, crown 32 to 35 and pavilion 43.3 to
//! 46.8 degrees (diamondcuttersintl.com), table 55 to 75 (gemmology.dev). Three rows of eight facets on either side make the
//! usual 49 facets with the table; corners and steps have no published figures.

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

/// The family of the emerald cut.
pub static EMERALD: Family = Family {
    key: "emerald",
    name: "Emerald cut",
    first: FamilyCut::first(&EMERALD, &[1.45, 16.0, 62.0, 3.0, 34.0, 9.0, 3.0, 45.0, 8.0, 100.0, 3.0]),
    net: Some(net),
    depth: Some(|cut| PLACES.profile(cut, outline(cut).reach()).depth()),
    proportions: &[
        rows::length_to_width::<LENGTH>([1.2, 1.8]),
        step_rows::corner::<CORNER>([8.0, 24.0]),
        rows::table::<TABLE>([50.0, 75.0]),
        step_rows::crown_rows::<CROWN_ROWS>(),
        step_rows::crown::<CROWN>([26.0, 42.0]),
        step_rows::crown_step::<CROWN_STEP>(),
        step_rows::pavilion_rows::<PAVILION_ROWS>(),
        step_rows::pavilion::<PAVILION>([40.0, 52.0]),
        step_rows::pavilion_step::<PAVILION_STEP>(),
        step_rows::keel::<KEEL>(),
        rows::girdle_thickness::<GIRDLE>(),
        rows::step_depth([58.0, 72.0]),
    ],
};

fn outline(cut: &FamilyCut) -> Rectangle {
    Rectangle { length: cut[LENGTH], corner: cut[CORNER] / 50.0, keel: cut[KEEL] / 100.0 }
}

fn net(cut: &FamilyCut) -> Result<FacetNet, NoRoom> {
    outline(cut).net(cut, &PLACES)
}
