//! The oval barion: an oval outline of sixteen sides, a step crown, and half-moons that carry a round pavilion.
//!
//! The cone of the [barion] is round here, and runs through the ends of the sides at both ends of the stone. Along
//! the long sides it lies outside the outline, so that every side but those two has a moon. Where two moons meet, a
//! crease runs down to the cone. Eight mains touch the cone: in the middle of a long side, at the crease in the
//! middle of a quarter, and at the ends. Two halves between neighbouring mains meet in a tip. So every facet ends in
//! points. The construction is this program's own. The facets are 49 in the crown with three rows, 38 in the pavilion
//! and 16 in the girdle.
//!
//! Source of the kind: PC 02.094 (Long and Steele, Facet Design 6, 1987): 16 sides, moons at 71, 64 and 58 degrees along each long
//! side and none at the ends, eight mains at 43 and 44, L/W 1.40, table .55, P/W .63, C/W .20.

use super::super::facet_net::{FacetNet, NoRoom};
use super::super::family::Family;
use super::super::family_cut::FamilyCut;
use super::barion::{self, BarionPavilion};
use super::chevrons::Quarters;
use super::oval::superellipse;
use super::steps::{self, StepRows, StepSide};
use super::{rows, step_rows};
use glam::{DMat2, DVec2};

const LENGTH: usize = 0;
const TABLE: usize = 1;
const CROWN_ROWS: usize = 2;
const CROWN: usize = 3;
const CROWN_STEP: usize = 4;
const HALF_MOON: usize = 5;
const PAVILION: usize = 6;
const LOWER_HALF: usize = 7;
const GIRDLE: usize = 8;
const CULET: usize = 9;

/// The places where the sides between the middle of a long side and the end of the stone meet the ellipse, as parts
/// of the way along the quarter from that middle to that end.
const ON_ELLIPSE: [f64; 4] = [0.12, 0.36, 0.6, 0.86];

/// The tiers of the moons, from the middle of a long side to the end.
const MOONS: [&str; 4] = ["half_moon", "side_moon", "shoulder_moon", "end_moon"];

/// The family of the oval barion.
pub static OVAL_BARION: Family = Family {
    key: "oval_barion",
    name: "Oval barion",
    first: FamilyCut::first(&OVAL_BARION, &[1.4, 58.0, 3.0, 36.0, 9.0, 70.0, 41.0, 75.0, 3.0, 0.0]),
    net: Some(net),
    depth: Some(|cut| crown(cut).height() + Outline::of(cut).pavilion(cut).depth(cut[CULET])),
    proportions: &[
        rows::length_to_width::<LENGTH>([1.3, 1.6]),
        rows::table::<TABLE>([50.0, 65.0]),
        step_rows::crown_rows::<CROWN_ROWS>(),
        step_rows::crown::<CROWN>([28.0, 42.0]),
        step_rows::crown_step::<CROWN_STEP>(),
        barion::half_moons::<HALF_MOON>(),
        barion::pavilion::<PAVILION>(),
        barion::lower_halves::<LOWER_HALF>(),
        rows::girdle_thickness::<GIRDLE>(),
        rows::culet::<CULET>(),
        rows::total_depth([70.0, 90.0], &["pavilion_angle", "half_moon_angle"]),
    ],
};

/// The sides of the outline in the first quarter, from +x to +y, each given by its unit normal and a point.
struct Outline {
    sides: [(DVec2, DVec2); 5],
    size: DVec2,
}

impl Outline {
    fn of(cut: &FamilyCut) -> Self {
        let size = DVec2::new(1.0, cut[LENGTH]);
        let [a, b, c, d] = ON_ELLIPSE.map(|part| superellipse(size.y, 2.0, 0.25 * part).at);
        let side = |from: DVec2, to: DVec2| (-(to - from).perp().normalize_or(DVec2::X), from);
        let sides = [(DVec2::X, DVec2::X), side(a, b), side(b, c), side(c, d), (DVec2::Y, DVec2::Y * size.y)];
        Self { sides, size }
    }

    /// Returns the corner between a side of the quarter and the next, and the displacement of this corner when both
    /// sides move inward by 1.
    fn corner(&self, place: usize) -> (DVec2, DVec2) {
        let [(a, on_a), (b, on_b)] = [self.sides[place], self.sides[place + 1]];
        let normals = DMat2::from_cols(a, b).transpose().inverse();
        (normals * DVec2::new(a.dot(on_a), b.dot(on_b)), normals * DVec2::NEG_ONE)
    }

    fn pavilion(&self, cut: &FamilyCut) -> BarionPavilion {
        BarionPavilion::round(cut, [PAVILION, HALF_MOON, LOWER_HALF, GIRDLE], self.corner(3).0)
    }
}

fn crown(cut: &FamilyCut) -> StepRows {
    StepRows::of(cut, [CROWN_ROWS, CROWN, CROWN_STEP], 1.0 - cut[TABLE] / 100.0)
}

fn net(cut: &FamilyCut) -> Result<FacetNet, NoRoom> {
    let (outline, thickness) = (Outline::of(cut), cut[GIRDLE] / 50.0);
    let pavilion = outline.pavilion(cut);
    let steps = StepSide::around(&outline.sides, outline.size);
    let mut net = FacetNet::default();
    crown(cut).add_crown(&mut net, &steps)?;
    steps::add_girdle(&mut net, &steps, thickness);
    let mut quarters = Quarters { net: &mut net, inside: -0.5 * thickness };
    let moon = NoRoom { tier: MOONS[0] };
    // The list runs from the middle of the long side over the feet of the creases to the girdle at the end.
    let mut feet = vec![pavilion.down(DVec2::X, DVec2::NEG_X * pavilion.cotangent).ok_or(moon)?];
    pavilion.add_half_moon(&mut quarters, DVec2::X, outline.size);
    for place in 0..3 {
        let (from, inward) = outline.corner(place);
        let no_room = NoRoom { tier: MOONS[place + 1] };
        let foot = pavilion.down(from, inward * pavilion.cotangent).ok_or(no_room)?;
        let ends = [from, outline.corner(place + 1).0].map(|at| pavilion.on_girdle(at));
        quarters.through(MOONS[place + 1], [ends[0], ends[1], foot])?;
        feet.push(foot);
    }
    let end = pavilion.on_girdle(outline.corner(3).0);
    let [side, between, middle, beyond] = [feet[0], feet[1], feet[2], feet[3]];
    let [first, second] = [side, middle].map(|at| pavilion.main_at(at));
    let last = (end - pavilion.point()).cross(glam::DVec3::X);
    let point = pavilion.point();
    quarters.pair("main", first, point);
    quarters.through("main", [point, middle, middle + second.truncate().perp().extend(0.0)])?;
    quarters.pair("main", last * -last.z.signum(), point);
    pavilion.add_halves(&mut quarters, [first, second], [side, between, middle])?;
    pavilion.add_halves(&mut quarters, [second, last], [middle, beyond, end])?;
    pavilion.add_culet(&mut net, cut[CULET]);
    Ok(net)
}
