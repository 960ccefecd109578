//! The tapered baguette: steps on a slim outline with one end narrower than the other.
//!
//! Ranges are chosen around those of the straight baguette (GemCad's library, PC 12.001: L/W 2.0, crown 35 degrees,
//! pavilion 51 and 41). All rows have the same slope on every side, so the keel rises toward the narrow end, where
//! the stone is less deep.

use super::super::facet_net::{FacetNet, NoRoom};
use super::super::family::BoundAt::Fixed;
use super::super::family::{Bound, Family, Proportion};
use super::super::family_cut::FamilyCut;
use super::steps::{self, StepProfile, StepRows, StepSide};
use super::{rows, step_rows};
use glam::DVec2;

const LENGTH: usize = 0;
const NARROW: usize = 1;
const TABLE: usize = 2;
const CROWN_ROWS: usize = 3;
const CROWN: usize = 4;
const CROWN_STEP: usize = 5;
const PAVILION_ROWS: usize = 6;
const PAVILION: usize = 7;
const PAVILION_STEP: usize = 8;
const GIRDLE: usize = 9;

/// The family of the tapered baguette.
pub static TAPERED_BAGUETTE: Family = Family {
    key: "tapered_baguette",
    name: "Tapered baguette",
    first: FamilyCut::first(&TAPERED_BAGUETTE, &[2.0, 65.0, 60.0, 1.0, 35.0, 8.0, 2.0, 46.0, 10.0, 3.0]),
    net: Some(net),
    depth: Some(|cut| profile(cut).depth()),
    proportions: &[
        rows::length_to_width::<LENGTH>([1.5, 3.0]),
        Proportion {
            meaning: "The width of the narrow end, in percent of the wide one.",
            least: Bound::at(Fixed(10.0), "the narrowest end allowed"),
            most: Bound::at(Fixed(100.0), "where both ends are as wide"),
            ..rows::of_width::<NARROW>("narrow_end", "Narrow end", [50.0, 90.0])
        },
        Proportion {
            meaning: "The width of the table half-way along the stone, in percent of the width of the stone there.",
            ..rows::table::<TABLE>([50.0, 75.0])
        },
        step_rows::crown_rows::<CROWN_ROWS>(),
        step_rows::crown::<CROWN>([26.0, 42.0]),
        step_rows::crown_step::<CROWN_STEP>(),
        step_rows::pavilion_rows::<PAVILION_ROWS>(),
        step_rows::pavilion::<PAVILION>([40.0, 52.0]),
        step_rows::pavilion_step::<PAVILION_STEP>(),
        rows::girdle_thickness::<GIRDLE>(),
        rows::step_depth([52.0, 70.0]),
    ],
};

/// Returns the tangent of the angle between a long side and the length.
fn lean(cut: &FamilyCut) -> f64 {
    0.5 * (1.0 - cut[NARROW] / 100.0) / cut[LENGTH]
}

/// Returns the rows of crown and pavilion, and the girdle between them.
fn profile(cut: &FamilyCut) -> StepProfile {
    let (lean, narrow) = (lean(cut), cut[NARROW] / 100.0);
    // `reach` leads to the point where both long sides and the narrow end meet, the first end of the keel. Below it,
    // the last row continues to the point where the long sides meet the wide end.
    let [reach, end] = [narrow / (lean.hypot(1.0) - lean), 1.0 / (lean.hypot(1.0) + lean)];
    let inset = 0.5 * (1.0 + narrow) * (1.0 - cut[TABLE] / 100.0) / lean.hypot(1.0);
    let crown = StepRows::of(cut, [CROWN_ROWS, CROWN, CROWN_STEP], inset);
    let pavilion = StepRows::of(cut, [PAVILION_ROWS, PAVILION, PAVILION_STEP], reach);
    StepProfile { crown, thickness: cut[GIRDLE] / 50.0, pavilion, below: end - reach }
}

fn net(cut: &FamilyCut) -> Result<FacetNet, NoRoom> {
    let (length, lean) = (cut[LENGTH], lean(cut));
    let to = |x: f64, y: f64, through: DVec2| StepSide {
        crown_rate: 1.0,
        pavilion_rate: 1.0,
        ..StepSide::toward(DVec2::new(x, y), through, DVec2::ZERO, DVec2::ZERO)
    };
    let (wide, tip) = (DVec2::new(1.0, -length), DVec2::new(0.0, length));
    let sides = [
        to(1.0, lean, wide),
        to(0.0, 1.0, tip),
        to(-1.0, lean, DVec2::new(-1.0, -length)),
        to(0.0, -1.0, -tip),
    ];
    steps::net(&sides, profile(cut))
}
