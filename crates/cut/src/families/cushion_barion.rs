//! The cushion barion: the outline of a cushion, a step crown, and half-moons that carry a round brilliant's pavilion.
//!
//! The outline has 16 sides, as cutters' square barion cushions have (PC 09.046, Long and Steele, Facet Design 6,
//! 1987). In each quarter, one side touches the curve in the middle of a side of the cushion, one closes the rounded
//! corner, and one lies between these. The cone of the [barion] runs through the ends of the corners' sides. Each of
//! the three sides between two corners has a half-moon; where two of them meet, a crease runs from the girdle down to
//! the cone, and two halves meet in its end. So every facet ends in points. The construction is this program's own.
//! The facets are 49 in the crown with three rows, 36 in the pavilion and 16 in the girdle. Ranges are those of the
//! cushion's outline and of the barion's angles.

use super::super::facet_net::{FacetNet, NoRoom};
use super::super::family::Family;
use super::super::family_cut::FamilyCut;
use super::barion::{self, BarionPavilion};
use super::chevrons::Quarters;
use super::curves::RoundedQuarter;
use super::steps::{self, StepRows, StepSide};
use super::{cushion, rows, step_rows};
use glam::{DMat2, DVec2};

const LENGTH: usize = 0;
const BULGE: usize = 1;
const CORNER: usize = 2;
const TABLE: usize = 3;
const CROWN_ROWS: usize = 4;
const CROWN: usize = 5;
const CROWN_STEP: usize = 6;
const HALF_MOON: usize = 7;
const PAVILION: usize = 8;
const LOWER_HALF: usize = 9;
const GIRDLE: usize = 10;
const CULET: usize = 11;

/// The place where the side beside the middle one touches the curve, as a part of the way from the middle of one side
/// of the cushion to the middle of the next.
const BESIDE: f64 = 0.2;

/// The place where the corner's side begins on the curve, as a part of that way.
const CORNER_FROM: f64 = 0.4;

/// The family of the cushion barion.
pub static CUSHION_BARION: Family = Family {
    key: "cushion_barion",
    name: "Cushion barion",
    first: FamilyCut::first(
        &CUSHION_BARION,
        &[1.1, 6.0, 22.0, 60.0, 3.0, 34.0, 9.0, 72.0, 41.0, 75.0, 3.0, 0.0],
    ),
    net: Some(net),
    depth: Some(depth),
    proportions: &[
        rows::length_to_width::<LENGTH>([1.0, 1.3]),
        cushion::bulge::<BULGE>(),
        cushion::corner::<CORNER>(),
        rows::table::<TABLE>([50.0, 70.0]),
        step_rows::crown_rows::<CROWN_ROWS>(),
        step_rows::crown::<CROWN>([28.0, 42.0]),
        step_rows::crown_step::<CROWN_STEP>(),
        barion::half_moons::<HALF_MOON>(),
        barion::pavilion::<PAVILION>(),
        barion::lower_halves::<LOWER_HALF>(),
        rows::girdle_thickness::<GIRDLE>(),
        rows::culet::<CULET>(),
        rows::total_depth([58.0, 78.0], &["pavilion_angle", "half_moon_angle"]),
    ],
};

/// The sides of the outline in the first quarter, from +x to +y, each given by its normal and a point.
struct Outline {
    sides: [(DVec2, DVec2); 5],
    /// Both ends of the corner's side.
    corner: [DVec2; 2],
    size: DVec2,
}

impl Outline {
    fn of(cut: &FamilyCut) -> Option<Self> {
        let size = DVec2::new(1.0, cut[LENGTH]);
        let quarter = RoundedQuarter::new(size.y, cut[BULGE] / 50.0, cut[CORNER] / 50.0)?;
        let [p, a, b, q] =
            [BESIDE, CORNER_FROM, 1.0 - CORNER_FROM, 1.0 - BESIDE].map(|part| quarter.at(part).at);
        let side = |from: DVec2, to: DVec2| (-(to - from).perp(), from);
        let sides = [(DVec2::X, DVec2::X), side(p, a), side(a, b), side(b, q), (DVec2::Y, DVec2::Y * size.y)];
        Some(Self { sides, corner: [a, b], size })
    }

    /// Returns the pavilion on the outline.
    fn brilliant(&self, cut: &FamilyCut) -> BarionPavilion {
        let [a, b] = self.corner;
        BarionPavilion::of(cut, [PAVILION, HALF_MOON, LOWER_HALF, GIRDLE], [b, a])
    }
}

fn depth(cut: &FamilyCut) -> f64 {
    Outline::of(cut)
        .map_or(f64::NAN, |outline| crown(cut).height() + outline.brilliant(cut).depth(cut[CULET]))
}

fn crown(cut: &FamilyCut) -> StepRows {
    StepRows::of(cut, [CROWN_ROWS, CROWN, CROWN_STEP], 1.0 - cut[TABLE] / 100.0)
}

fn net(cut: &FamilyCut) -> Result<FacetNet, NoRoom> {
    let outline = Outline::of(cut).ok_or(NoRoom { tier: "girdle" })?;
    let (thickness, steps, pavilion) =
        (cut[GIRDLE] / 50.0, StepSide::around(&outline.sides, outline.size), outline.brilliant(cut));
    let Outline { sides, corner: [a, b], size } = outline;
    let mut net = FacetNet::default();
    crown(cut).add_crown(&mut net, &steps)?;
    steps::add_girdle(&mut net, &steps, thickness);
    let mut quarters = Quarters { net: &mut net, inside: -0.5 * thickness };
    for (way, beside, end) in [(DVec2::X, sides[1], a), (DVec2::Y, sides[3], b)] {
        pavilion.add_half_moon(&mut quarters, way, size);
        let (normal, at) = (beside.0.normalize_or(way), beside.1);
        // The corner of the girdle between both half-moons, and the direction of their crease.
        let normals = DMat2::from_cols(way, normal).transpose().inverse();
        let from = normals * DVec2::new(way.dot(size), normal.dot(at));
        let between = pavilion.down(from, normals * DVec2::splat(-pavilion.cotangent));
        let foot = between.ok_or(NoRoom { tier: "half_moon" })?;
        let [from, to] = [from, end].map(|at| at.extend(-thickness));
        quarters.through("end_moon", [from, to, foot])?;
        pavilion.add_brilliant_side(&mut quarters, way, size, (between, end))?;
    }
    pavilion.add_corner_main(&mut quarters)?;
    pavilion.add_culet(&mut net, cut[CULET]);
    Ok(net)
}
