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
use glam::{DVec2, DVec3};

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
    depth: Some(depth),
    proportions: &[
        rows::length_to_width::<LENGTH>([1.0, 1.3]),
        step_rows::corner::<CORNER>([8.0, 20.0]),
        rows::table::<TABLE>([50.0, 70.0]),
        step_rows::crown_rows::<CROWN_ROWS>(),
        step_rows::crown::<CROWN>([28.0, 42.0]),
        step_rows::crown_step::<CROWN_STEP>(),
        half_moons::<HALF_MOON>(),
        pavilion::<PAVILION>(),
        lower_halves::<LOWER_HALF>(),
        rows::girdle_thickness::<GIRDLE>(),
        rows::culet::<CULET>(),
        rows::total_depth([60.0, 80.0], &["pavilion_angle", "half_moon_angle"]),
    ],
};

/// Returns the row for the angle of the half-moons.
pub(super) const fn half_moons<const PLACE: usize>() -> Proportion {
    Proportion {
        meaning: "The angle between the half-moons, the facets that run along the sides below the girdle, and the girdle plane.",
        ..rows::slope::<PLACE>("half_moon_angle", "Half-moons", [62.0, 82.0])
    }
}

/// Returns the row for the angle of the brilliant pavilion.
pub(super) const fn pavilion<const PLACE: usize>() -> Proportion {
    Proportion {
        meaning: "The angle between those mains of the brilliant pavilion that lie below the sides and the girdle plane.",
        ..rows::slope::<PLACE>("pavilion_angle", "Pavilion angle", [38.0, 44.0])
    }
}

/// Returns the row for the reach of the lower halves of the brilliant pavilion.
pub(super) const fn lower_halves<const PLACE: usize>() -> Proportion {
    let of = "of the way from the girdle to the middle";
    Proportion {
        meaning: "The reach of the lower halves from the girdle to the middle, seen from below.",
        ..rows::part::<PLACE>("lower_half_length", "Lower halves", of, [60.0, 85.0])
    }
}

fn depth(cut: &FamilyCut) -> f64 {
    crown(cut).height() + brilliant(cut).depth(cut[CULET])
}

fn crown(cut: &FamilyCut) -> StepRows {
    StepRows::of(cut, [CROWN_ROWS, CROWN, CROWN_STEP], 1.0 - cut[TABLE] / 100.0)
}

fn brilliant(cut: &FamilyCut) -> BarionPavilion {
    let (sizes, corner) = (DVec2::new(1.0, cut[LENGTH]), cut[CORNER] / 50.0);
    let ends = [DVec2::X, DVec2::Y].map(|way| sizes - way * corner);
    BarionPavilion::of(cut, [PAVILION, HALF_MOON, LOWER_HALF, GIRDLE], ends)
}

fn net(cut: &FamilyCut) -> Result<FacetNet, NoRoom> {
    let outline = Rectangle { length: cut[LENGTH], corner: cut[CORNER] / 50.0, keel: 1.0 };
    let (thickness, sizes, pavilion) = (cut[GIRDLE] / 50.0, DVec2::new(1.0, cut[LENGTH]), brilliant(cut));
    let mut net = FacetNet::default();
    crown(cut).add_crown(&mut net, &outline.sides())?;
    steps::add_girdle(&mut net, &outline.sides(), thickness);
    let mut quarters = Quarters { net: &mut net, inside: -0.5 * thickness };
    for (way, end) in [DVec2::X, DVec2::Y].into_iter().zip(pavilion.corner.into_iter().rev()) {
        pavilion.add_half_moon(&mut quarters, way, sizes);
        let between = pavilion.down(0.5 * (way * way.dot(sizes) + end), -way * pavilion.cotangent);
        pavilion.add_brilliant_side(&mut quarters, way, sizes, (between, end))?;
    }
    pavilion.add_corner_main(&mut quarters)?;
    pavilion.add_culet(&mut net, cut[CULET]);
    Ok(net)
}

/// An upright elliptical cone with its point below.
#[derive(Debug, Clone, Copy)]
struct Cone {
    /// The inverse squares of its half-axes at the height of the girdle.
    inverse: DVec2,
    /// The depth of the cone's point below the girdle.
    depth: f64,
}

impl Cone {
    /// Returns the cone through two points of the girdle in its first quarter and their mirror images. `slope` is the
    /// tangent of the cone's angle along the width.
    fn through([a, b]: [DVec2; 2], slope: f64) -> Self {
        let (a, b) = (a * a, b * b);
        let inverse = DVec2::new(a.y - b.y, b.x - a.x) / (b.x * a.y - a.x * b.y);
        Self { inverse, depth: slope / inverse.x.sqrt() }
    }
}

/// The pavilion of a barion: half-moons that a cone cuts, and a brilliant's pavilion inside the cone.
#[derive(Debug, Clone, Copy)]
pub(super) struct BarionPavilion {
    cone: Cone,
    thickness: f64,
    /// Both ends of the girdle's edge at the corner of the first quarter, on the cone. The first end is the one
    /// nearer to the end of the length.
    corner: [DVec2; 2],
    /// The cotangent of the half-moons' angle.
    pub cotangent: f64,
    /// The part of the way from the middle to the girdle at which the tips of the halves lie.
    reach: f64,
}

impl BarionPavilion {
    /// Returns the pavilion for pavilion angle, half-moons' angle, length of the halves and girdle from four places
    /// of a table. `corner` holds both ends of the girdle's edge at the corner of the first quarter, the one nearer
    /// to +y first.
    pub fn of(cut: &FamilyCut, [slope, half_moon, half, girdle]: [usize; 4], corner: [DVec2; 2]) -> Self {
        Self {
            cone: Cone::through(corner, cut[slope].to_radians().tan()),
            thickness: cut[girdle] / 50.0,
            corner,
            cotangent: 1.0 / cut[half_moon].to_radians().tan(),
            reach: 1.0 - cut[half] / 100.0,
        }
    }

    /// Returns the pavilion for the same numbers on a round cone through a point of the girdle in the first quarter
    /// and its mirror image across x = 0.
    pub fn round(cut: &FamilyCut, [slope, half_moon, half, girdle]: [usize; 4], end: DVec2) -> Self {
        let ends = [end * DVec2::new(-1.0, 1.0), end];
        let (inverse, tangent) = (DVec2::splat(1.0 / end.length_squared()), cut[slope].to_radians().tan());
        let cone = Cone { inverse, depth: tangent * end.length() };
        // The cone is set here, because `of` would need two points in the quarter.
        Self { cone, ..Self::of(cut, [slope, half_moon, half, girdle], ends) }
    }

    /// Returns the height of pavilion and girdle together, for a culet of this percentage of the pavilion's depth.
    pub fn depth(&self, culet: f64) -> f64 {
        self.thickness + self.cone.depth * (1.0 - culet / 100.0)
    }

    /// Returns the point of the cone, in which the pavilion ends without a culet.
    pub fn point(&self) -> DVec3 {
        DVec3::NEG_Z * (self.thickness + self.cone.depth)
    }

    /// Returns a point of the girdle's lower edge.
    pub fn on_girdle(&self, at: DVec2) -> DVec3 {
        at.extend(-self.thickness)
    }

    /// Returns the point where a line from the girdle's lower edge meets the cone; `None` where it does not. The line
    /// moves by `inward` for each unit that it goes down.
    pub fn down(&self, from: DVec2, inward: DVec2) -> Option<DVec3> {
        let Cone { inverse, depth } = self.cone;
        // (1 - z/D)² = p x² + q y² at from + z inward, for the depth z.
        let square = 1.0 / (depth * depth) - inverse.dot(inward * inward);
        let linear = -2.0 * (inverse.dot(from * inward) + 1.0 / depth);
        let free = 1.0 - inverse.dot(from * from);
        let root = (linear * linear - 4.0 * square * free).sqrt();
        let z = 2.0 * free / (root - linear);
        z.is_finite().then_some(self.on_girdle(from + inward * z) - DVec3::Z * z)
    }

    /// Adds the half-moon in the middle of the side toward `way`, which is +x or +y. `size` is half of width and
    /// length.
    pub fn add_half_moon(&self, net: &mut Quarters<'_>, way: DVec2, size: DVec2) {
        net.pair("half_moon", way.extend(-self.cotangent), self.on_girdle(way * way.dot(size)));
    }

    /// Adds the main below the middle of the side toward `way`, which is +x or +y, and the halves beside it. The
    /// halves meet the cone in the middle of the side, in the point `between` and at the end of the side.
    ///
    /// # Errors
    /// Fails with the tier that has no room.
    pub fn add_brilliant_side(
        &self,
        net: &mut Quarters<'_>,
        way: DVec2,
        size: DVec2,
        (between, end): (Option<DVec3>, DVec2),
    ) -> Result<(), NoRoom> {
        let unfit = NoRoom { tier: "half_moon" };
        let middle = self.down(way * way.dot(size), -way * self.cotangent).ok_or(unfit)?;
        let (between, end, point) = (between.ok_or(unfit)?, self.on_girdle(end), self.point());
        let main = self.main_at(middle);
        net.pair("main", main, point);
        let [a, b] = self.corner.map(|at| self.on_girdle(at) - point);
        self.add_halves(net, [main, a.cross(b)], [middle, between, end])
    }

    /// Returns the normal of the main that touches the cone at a point of it.
    pub fn main_at(&self, at: DVec3) -> DVec3 {
        let Cone { inverse, depth } = self.cone;
        let left = 1.0 + (at.z + self.thickness) / depth;
        (inverse * at.truncate()).extend(-left / depth)
    }

    /// Adds the two halves between a main and the next, which are given by their normals. The halves share a tip on
    /// the line in which both mains meet. They meet the cone in three points: at the first main, between the mains,
    /// and at the second.
    ///
    /// # Errors
    /// Fails with the tier that has no room.
    pub fn add_halves(
        &self,
        net: &mut Quarters<'_>,
        mains: [DVec3; 2],
        [from, between, to]: [DVec3; 3],
    ) -> Result<(), NoRoom> {
        // The line runs upward from the culet.
        let line = mains[0].cross(mains[1]);
        let line = line * line.z.signum();
        let way = self.reach * between.truncate().length() / line.truncate().length();
        let tip = self.point() + line * way;
        if !tip.is_finite() {
            return Err(NoRoom { tier: "lower_half" });
        }
        net.through("lower_half", [tip, from, between])?;
        net.through("lower_half", [tip, between, to])
    }

    /// Adds the mains of the corners: each runs from the culet to the girdle's edge at a corner.
    ///
    /// # Errors
    /// Fails with the tier that has no room.
    pub fn add_corner_main(&self, net: &mut Quarters<'_>) -> Result<(), NoRoom> {
        let [a, b] = self.corner.map(|at| self.on_girdle(at));
        net.through("main", [a, b, self.point()])
    }

    /// Adds the culet where its size is above 0: a percentage of the pavilion's depth.
    pub fn add_culet(&self, net: &mut FacetNet, percent: f64) {
        if percent > 0.0 {
            net.plane("culet", DVec3::NEG_Z, DVec3::NEG_Z * self.depth(percent));
        }
    }
}
