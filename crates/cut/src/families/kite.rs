//! The kite step cut: two long sides, two short ones, and facets that meet in a point.
//!
//! Ranges are chosen; slopes and table are those of emerald cuts (diamondcuttersintl.com). At a shoulder of 50 % the outline
//! is a lozenge.

use super::super::facet_net::{FacetNet, NoRoom};
use super::super::family::{Family, Proportion};
use super::super::family_cut::FamilyCut;
use super::steps::{self, StepProfile, StepRows, StepSide};
use super::{rows, step_rows};
use glam::DVec2;

const LENGTH: usize = 0;
const SHOULDER: usize = 1;
const TABLE: usize = 2;
const CROWN_ROWS: usize = 3;
const CROWN: usize = 4;
const CROWN_STEP: usize = 5;
const PAVILION_ROWS: usize = 6;
const PAVILION: usize = 7;
const PAVILION_STEP: usize = 8;
const GIRDLE: usize = 9;

/// The family of the kite step cut.
pub static KITE: Family = Family {
    key: "kite",
    name: "Kite step cut",
    first: FamilyCut::first(&KITE, &[1.5, 66.0, 60.0, 2.0, 34.0, 10.0, 3.0, 45.0, 8.0, 3.0]),
    net: Some(net),
    depth: Some(|cut| profile(cut).depth()),
    proportions: &[
        rows::length_to_width::<LENGTH>([1.3, 2.0]),
        Proportion {
            meaning: "The distance of the widest place from the sharper end.",
            ..rows::part::<SHOULDER>(
                "shoulder",
                "Shoulder",
                "of the length, from the sharper end",
                [50.0, 75.0],
            )
        },
        rows::table::<TABLE>([50.0, 75.0]),
        step_rows::crown_rows::<CROWN_ROWS>(),
        step_rows::crown::<CROWN>([26.0, 42.0]),
        step_rows::crown_step::<CROWN_STEP>(),
        step_rows::pavilion_rows::<PAVILION_ROWS>(),
        step_rows::pavilion::<PAVILION>([40.0, 52.0]),
        step_rows::pavilion_step::<PAVILION_STEP>(),
        rows::girdle_thickness::<GIRDLE>(),
        rows::step_depth([46.0, 66.0]),
    ],
};

/// Returns the centre of the circle that touches all four sides, as its height above the middle of the length, and
/// its radius. The centre lies on the axis, at the same distance from long and short sides.
fn circle(cut: &FamilyCut) -> (f64, f64) {
    let (length, widest) = (cut[LENGTH], widest(cut));
    let [short, long] = [length - widest, length + widest].map(|reach| reach.hypot(1.0));
    let middle = (length * (long - short) / (long + short)).clamp(-length, length);
    (middle, (length - middle) / short)
}

/// Returns the height of the widest place above the middle of the length.
fn widest(cut: &FamilyCut) -> f64 {
    cut[LENGTH] * (2.0 * cut[SHOULDER] / 100.0 - 1.0)
}

/// Returns the rows of crown and pavilion, and the girdle between them.
fn profile(cut: &FamilyCut) -> StepProfile {
    let (_, radius) = circle(cut);
    let crown = StepRows::of(cut, [CROWN_ROWS, CROWN, CROWN_STEP], radius * (1.0 - cut[TABLE] / 100.0));
    let pavilion = StepRows::of(cut, [PAVILION_ROWS, PAVILION, PAVILION_STEP], radius);
    StepProfile { crown, thickness: cut[GIRDLE] / 50.0, pavilion, below: 0.0 }
}

fn net(cut: &FamilyCut) -> Result<FacetNet, NoRoom> {
    let (length, widest) = (cut[LENGTH], widest(cut));
    let to = |x: f64, y: f64, tip: f64| {
        let normal = DVec2::new(x, y).normalize_or(DVec2::X);
        StepSide { normal, distance: normal.dot(DVec2::new(0.0, tip)), crown_rate: 1.0, pavilion_rate: 1.0 }
    };
    let (up, down) = (length - widest, length + widest);
    let sides =
        [to(up, 1.0, length), to(-up, 1.0, length), to(-down, -1.0, -length), to(down, -1.0, -length)];
    steps::net(&sides, profile(cut))
}
