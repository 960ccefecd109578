//! The radiant cut: a rectangle with cut corners, a brilliant or step crown, and a pavilion of chevrons.
//!
//! Ranges: 62 to 70 facets; a brilliant or a step crown over 2 to 4 rows of chevrons (caratwire). With three rows and a
//! culet the 70 facets of the trade (yourjewel.com) are those of this construction: 25 above, 8 in the girdle and 37 below.
//! L/W and depth are those of weight tables (1.0 to 1.5); other figures are chosen.

use super::super::facet_net::{FacetNet, NoRoom};
use super::super::family::{Family, Proportion};
use super::super::family_cut::FamilyCut;
use super::chevrons::{Chevrons, StarCrown};
use super::princess::{chevron_step, chevrons, pavilion_depth, shoulder, star_azimuth};
use super::steps::{self, Rectangle, StepRows};
use super::{rows, step_rows};

const LENGTH: usize = 0;
const CORNER: usize = 1;
const TABLE: usize = 2;
const CROWN_ROWS: usize = 3;
const CROWN: usize = 4;
const CROWN_STEP: usize = 5;
const STAR_AZIMUTH: usize = 6;
const CHEVRONS: usize = 7;
const DEPTH: usize = 8;
const STEP: usize = 9;
const SHOULDER: usize = 10;
const CORNER_STEP: usize = 11;
const GIRDLE: usize = 12;
const CULET: usize = 13;

/// The family of the radiant cut.
pub static RADIANT: Family = Family {
    key: "radiant",
    name: "Radiant cut",
    first: FamilyCut::first(
        &RADIANT,
        &[1.2, 17.0, 65.0, 0.0, 34.0, 12.0, 12.0, 3.0, 50.0, 6.0, 30.0, 10.0, 3.0, 1.0],
    ),
    net: Some(net),
    depth: Some(depth),
    proportions: &[
        rows::length_to_width::<LENGTH>([1.0, 1.5]),
        step_rows::corner::<CORNER>([12.0, 24.0]),
        rows::table::<TABLE>([55.0, 75.0]),
        Proportion {
            meaning: "The number of rows of steps in the crown; 0 is a brilliant crown, with a first row, a row of triangles, and stars.",
            nothing: Some("brilliant"),
            ..step_rows::count::<CROWN_ROWS>(
                "crown_rows",
                "Crown rows",
                [0.0, 4.0],
                ["a brilliant crown", "the most rows of any radiant"],
            )
        },
        step_rows::crown::<CROWN>([28.0, 40.0]),
        Proportion { usual: [6.0, 18.0], ..step_rows::crown_step::<CROWN_STEP>() },
        star_azimuth::<STAR_AZIMUTH>([8.0, 18.0]),
        chevrons::<CHEVRONS>(),
        pavilion_depth::<DEPTH>([44.0, 58.0]),
        chevron_step::<STEP>(),
        shoulder::<SHOULDER>(),
        Proportion {
            meaning: "How much flatter the mains are than the facets at the corners would be if both were equally wide. Those facets end in a point, where mains and chevrons meet.",
            ..step_rows::step::<CORNER_STEP>("corner_step", "Corner step", [5.0, 20.0])
        },
        rows::girdle_thickness::<GIRDLE>(),
        rows::culet::<CULET>(),
        rows::chevron_depth([56.0, 72.0]),
    ],
};

fn depth(cut: &FamilyCut) -> f64 {
    let crown = (1.0 - cut[TABLE] / 100.0) * cut[CROWN].to_radians().tan();
    crown + (cut[GIRDLE] + cut[DEPTH] * (1.0 - cut[CULET] / 100.0)) / 50.0
}

fn net(cut: &FamilyCut) -> Result<FacetNet, NoRoom> {
    let outline = Rectangle { length: cut[LENGTH], corner: cut[CORNER] / 50.0, keel: 1.0 };
    let (thickness, table) = (cut[GIRDLE] / 50.0, cut[TABLE] / 100.0);
    let steps = StepRows::of(cut, [CROWN_ROWS, CROWN, CROWN_STEP], 1.0 - table);
    let mut net = FacetNet::default();
    if steps.count > 0 {
        steps.add_crown(&mut net, &outline.sides())?;
    } else {
        let mains = StepRows { count: 2, ..steps }.tangents().ok_or(NoRoom { tier: "main_1" })?;
        let crown = StarCrown {
            table,
            mains: [mains[0], mains[1]],
            star_azimuth: cut[STAR_AZIMUTH].to_radians(),
            has_divided_corners: true,
        };
        crown.add_to(&mut net, &outline, -0.5 * thickness)?;
    }
    steps::add_girdle(&mut net, &outline.sides(), thickness);
    let pavilion = Chevrons {
        count: cut[CHEVRONS] as usize,
        depth: cut[DEPTH] / 50.0,
        step: cut[STEP],
        shoulder: cut[SHOULDER] / 100.0,
        corner_step: Some(cut[CORNER_STEP]),
        culet: cut[CULET] / 100.0,
    };
    pavilion.add_to(&mut net, &outline, thickness)?;
    Ok(net)
}
