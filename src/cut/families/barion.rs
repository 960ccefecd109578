//! The barion cut: a step crown on a square or rectangle, and half-moon facets that carry a round brilliant's pavilion.
//!
//! A cone from the culet's point through the eight corners of the girdle cuts each half-moon, a steep facet along a side, in a
//! curve. Points of this curve are the girdle of the brilliant pavilion: side mains touch it in the middles of the
//! half-moons, corner mains run to the cut corners, and two halves between neighbouring mains meet in a tip. On a rectangle the
//! cone is elliptical. The construction is this program's own. Facets of the basic barion square: 25 in the crown, 28 in the
//! pavilion and a culet, 8 in the girdle. Ranges are those of emerald cuts above and of round brilliants below; that of the
//! half-moons is chosen.

use super::super::facet_net::{FacetNet, NoRoom};
use super::super::family::{Family, Proportion};
use super::super::family_cut::FamilyCut;
use super::chevrons::Quarters;
use super::steps::{self, Rectangle, StepRows};
use super::{rows, step_rows};
use glam::{DVec2, DVec3, Vec2Swizzles};

const LENGTH: usize = 0;
const CORNER: usize = 1;
const TABLE: usize = 2;
const CROWN_ROWS: usize = 3;
const CROWN: usize = 4;
const CROWN_STEP: usize = 5;
const HALF_MOON: usize = 6;
const PAVILION: usize = 7;
const LOWER_HALF: usize = 8;
const GIRDLE: usize = 9;
const CULET: usize = 10;

/// The family of the barion cut.
pub static BARION: Family = Family {
    key: "barion",
    name: "Barion cut",
    first: FamilyCut::first(&BARION, &[1.0, 15.0, 60.0, 3.0, 34.0, 9.0, 72.0, 41.0, 75.0, 3.0, 0.0]),
    net: Some(net),
    proportions: &[
        rows::length_to_width::<LENGTH>([1.0, 1.3]),
        step_rows::corner::<CORNER>([8.0, 20.0]),
        rows::table::<TABLE>([50.0, 70.0]),
        step_rows::crown_rows::<CROWN_ROWS>(),
        step_rows::crown::<CROWN>([28.0, 42.0]),
        step_rows::crown_step::<CROWN_STEP>(),
        Proportion {
            meaning: "How steep the half-moons stand, the facets that run along the sides below the girdle.",
            ..rows::slope::<HALF_MOON>("half_moon_angle", "Half-moons", [62.0, 82.0])
        },
        Proportion {
            meaning: "How steep the mains below the sides stand, those of the brilliant pavilion.",
            ..rows::slope::<PAVILION>("pavilion_angle", "Pavilion angle", [38.0, 44.0])
        },
        Proportion {
            meaning: "How far the lower halves reach from the girdle to the middle, seen from below.",
            ..rows::part::<LOWER_HALF>(
                "lower_half_length",
                "Lower halves",
                "of the way from the girdle to the middle",
                [60.0, 85.0],
            )
        },
        rows::girdle_thickness::<GIRDLE>(),
        rows::culet::<CULET>(),
    ],
};

fn net(cut: &FamilyCut) -> Result<FacetNet, NoRoom> {
    let outline = Rectangle { length: cut[LENGTH], corner: cut[CORNER] / 50.0, keel: 1.0 };
    let crown = StepRows::of(cut, [CROWN_ROWS, CROWN, CROWN_STEP], 1.0 - cut[TABLE] / 100.0);
    let thickness = cut[GIRDLE] / 50.0;
    let mut net = FacetNet::default();
    crown.add_crown(&mut net, &outline.sides())?;
    steps::add_girdle(&mut net, &outline.sides(), thickness);
    let cone = Cone::through(&outline, cut[PAVILION].to_radians().tan());
    let pavilion = Pavilion {
        cone,
        thickness,
        cotangent: 1.0 / cut[HALF_MOON].to_radians().tan(),
        reach: 1.0 - cut[LOWER_HALF] / 100.0,
    };
    let mut quarters = Quarters { net: &mut net, inside: -0.5 * thickness };
    let sizes = DVec2::new(1.0, cut[LENGTH]);
    pavilion.add_side(&mut quarters, DVec2::X, sizes, outline.corner)?;
    pavilion.add_side(&mut quarters, DVec2::Y, sizes, outline.corner)?;
    let [a, b, _] = pavilion.corner_main(sizes, outline.corner);
    quarters.through("main", [a, b, pavilion.point()])?;
    if cut[CULET] > 0.0 {
        net.plane("culet", DVec3::NEG_Z, pavilion.point() + DVec3::Z * cone.depth * cut[CULET] / 100.0);
    }
    Ok(net)
}

/// An upright elliptical cone with its point below.
#[derive(Debug, Clone, Copy)]
struct Cone {
    /// The inverse squares of its half-axes at the height of the girdle.
    inverse: DVec2,
    /// How far its point lies below the girdle.
    depth: f64,
}

impl Cone {
    /// Returns the cone through all corners of an outline; `slope` is its tangent along the width.
    fn through(outline: &Rectangle, slope: f64) -> Self {
        let [wide, long] = [1.0, outline.length];
        let [short, less] = [wide - outline.corner, long - outline.corner];
        let determinant = (wide * long).powi(2) - (short * less).powi(2);
        let inverse = DVec2::new(long * long - less * less, wide * wide - short * short) / determinant;
        Self { inverse, depth: slope / inverse.x.sqrt() }
    }
}

/// The pavilion of a barion.
#[derive(Debug, Clone, Copy)]
struct Pavilion {
    cone: Cone,
    thickness: f64,
    /// The cotangent of the half-moons' angle.
    cotangent: f64,
    /// The part of the way from the middle to the girdle at which the halves' tips lie.
    reach: f64,
}

impl Pavilion {
    /// Returns the culet's point.
    fn point(&self) -> DVec3 {
        DVec3::NEG_Z * (self.thickness + self.cone.depth)
    }

    /// Returns three points of the main of the first quarter's corner: both ends of the cut corner, and the culet.
    fn corner_main(&self, size: DVec2, corner: f64) -> [DVec3; 3] {
        let [x, y] = [DVec2::X, DVec2::Y].map(|way| (size - way * corner).extend(-self.thickness));
        [x, y, self.point()]
    }

    /// Returns the point where the cone crosses the half-moon of the side toward `way`, at the distance `along` from the
    /// side's middle.
    fn on_half_moon(&self, way: DVec2, size: DVec2, along: f64) -> Option<DVec3> {
        let Self { cone: Cone { inverse, depth }, cotangent, .. } = *self;
        let [p, q] = [way.dot(inverse), way.yx().dot(inverse)];
        let size = way.dot(size);
        // (1 - z/D)² = p (size - z cot)² + q along², for the depth z.
        let square = 1.0 / (depth * depth) - p * cotangent * cotangent;
        let linear = 2.0 * (p * size * cotangent - 1.0 / depth);
        let free = 1.0 - p * size * size - q * along * along;
        let root = (linear * linear - 4.0 * square * free).sqrt();
        let z = 2.0 * free / (root - linear);
        let at = way * (size - z * cotangent) + way.yx() * along;
        z.is_finite().then_some(at.extend(-self.thickness - z))
    }

    /// Adds half-moon, main and halves of the side toward `way`, +x or +y.
    fn add_side(&self, net: &mut Quarters<'_>, way: DVec2, size: DVec2, corner: f64) -> Result<(), NoRoom> {
        let edge = way * way.dot(size);
        net.pair("half_moon", way.extend(-self.cotangent), edge.extend(-self.thickness));
        let unfit = NoRoom { tier: "half_moon" };
        let along = way.yx().dot(size) - corner;
        let middle = self.on_half_moon(way, size, 0.0).ok_or(unfit)?;
        let between = self.on_half_moon(way, size, 0.5 * along).ok_or(unfit)?;
        let end = (edge + way.yx() * along).extend(-self.thickness);
        let point = self.point();
        let rise = middle - point;
        let main = (way * rise.z).extend(-way.dot(rise.truncate()));
        net.pair("main", main, point);
        let [a, b, _] = self.corner_main(size, corner);
        // The line in which side main and corner main meet, upward from the culet.
        let line = main.cross((a - point).cross(b - point));
        let line = line * line.z.signum();
        let tip = point + line * (self.reach * between.truncate().length() / line.truncate().length());
        let halves = NoRoom { tier: "lower_half" };
        if !tip.is_finite() {
            return Err(halves);
        }
        net.through("lower_half", [tip, middle, between])?;
        net.through("lower_half", [tip, between, end])
    }
}
