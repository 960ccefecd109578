//! A piece of rough, and the largest stone that can be cut from it, table up.

use super::design::DIAMETERS_MM;
use super::facet_zones::EXACT;
use super::outline::diameter;
use super::{Outline, Size, SizeError};
use brillianteer_math::{Calipers, Plane, Polytope, PolytopeError, SolidRef, hull, span};
use brillianteer_optics::Material;
use glam::DVec2;
use serde::{Deserialize, Serialize};
use std::f64::consts::{FRAC_PI_2, PI};
use std::str::FromStr;

/// The sides that a piece of rough may have, mm.
const SIDES_MM: std::ops::RangeInclusive<f64> = 0.1..=1000.0;

/// Scales nearer to one another than this part are equal, so that rounding turns no stone.
const EQUAL: f64 = 1e-9;

/// A turn that makes the stone larger by less than this part is not made.
const WORTH_TURNING: f64 = 1e-3;

/// The number of halvings of the interval of scales where a weight and the thickness of the girdle are given: to the
/// last digit.
const HALVINGS: u32 = 100;

/// A stone whose weight differs by less than this part counts as having the requested weight.
const WEIGHED: f64 = 1e-6;

/// A box of rough, mm.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Rough {
    /// The sides: length, width, and the depth, along which the stone's axis lies; each 0.1 to 1000 mm.
    pub sides_mm: [f64; 3],
}

/// The reason why no stone can be cut as requested.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RoughError {
    /// A text that is no box.
    #[error("'{text}' is no piece of rough; write length, width and depth in mm, as in 12x9x7")]
    Text {
        /// The text as given, at most 80 characters of it.
        text: String,
    },
    /// A side out of range.
    #[error("a side of {mm} mm must be from {} to {} mm", SIDES_MM.start(), SIDES_MM.end())]
    Side {
        /// The side as given, mm.
        mm: f64,
    },
    /// A thickness of the girdle that is below 0, not a number, or does not fit.
    #[error("a girdle of {mm} mm does not fit; give from 0 to below {most:.3} mm")]
    Girdle {
        /// The thickness as given, mm.
        mm: f64,
        /// The thickness that leaves no room for the rest of the stone, mm.
        most: f64,
    },
    /// A thickness of the girdle that is below 0, not a number, or makes every stone heavier than the requested
    /// weight.
    #[error("no stone of {carats} ct has a girdle of {mm} mm; give a thinner one, from 0")]
    GirdleOfWeight {
        /// The thickness as given, mm.
        mm: f64,
        /// The requested weight, carats.
        carats: f64,
    },
    /// A stone that does not close with this girdle.
    #[error("with a girdle of {mm} mm the facets enclose no stone; give a thicker one")]
    Thin {
        /// The thickness as given, mm.
        mm: f64,
    },
    /// A thickness of the girdle where the body has no girdle between planes.
    #[error(
        "the girdle of a stone that is not convex keeps its share of the size; give no thickness of the girdle, or change the girdle \
         in the cut file"
    )]
    GirdleOfMesh,
    /// A body within a smooth surface.
    #[error(
        "a glass shape is curved, and no cut stone; `info` prints the size, volume and weight of any body"
    )]
    Smooth,
    /// A finished stone whose diameter is out of range.
    #[error(
        "the finished stone would be {mm:.3} mm across, and from {} to {} mm are possible; give other rough, or a thinner girdle",
        DIAMETERS_MM.start(),
        DIAMETERS_MM.end()
    )]
    Diameter {
        /// The diameter, mm.
        mm: f64,
    },
    /// A weight of a material whose density is not known, or that is not above 0.
    #[error(transparent)]
    Size(#[from] SizeError),
}

/// The quantity that keeps a stone from being larger.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FitLimit {
    /// The length and width of the rough.
    Footprint,
    /// The depth of the rough.
    Depth,
    /// The requested weight.
    Weight,
    /// The requested diameter.
    Diameter,
}

/// A finished stone.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Finished {
    /// The diameter, mm, as `docs/formats.md` defines it.
    pub diameter_mm: f64,
    /// The extents along the sides of the rough, or, where a weight is requested, along the axes of the stone's
    /// frame, mm.
    pub size_mm: [f64; 3],
    /// The extents along the axes of the stone's own frame, mm: its size however it lies in the rough.
    pub own_size_mm: [f64; 3],
    /// The angle by which the stone is turned about its axis in the rough, counter-clockwise seen from the table, degrees.
    pub turn_deg: f64,
    /// The thickness of the girdle, mm; `None` of a stone that is not convex, whose girdle is not measured.
    pub girdle_mm: Option<f64>,
    /// The volume, mm³.
    pub volume_mm3: f64,
    /// The quantity that keeps the stone from being larger.
    pub limit: FitLimit,
    /// The depth of the rough that the stone leaves, by which its girdle could be thicker, mm; 0 where a weight is
    /// requested.
    pub depth_left_mm: f64,
}

/// The stone that a piece of rough gives, or that has a requested weight or size, with its yield.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct YieldReport {
    /// The name of the design.
    pub name: String,
    /// The name of the material.
    pub material: String,
    /// The density of the material, g/cm³; `None` where it is not known.
    pub density: Option<f64>,
    /// The sides of the rough, mm; `None` where no rough is given.
    pub rough_mm: Option<[f64; 3]>,
    /// The weight of the rough, carats; `None` where it is not given.
    pub rough_carats: Option<f64>,
    /// The stone.
    pub finished: Finished,
    /// The weight of the stone, carats; `None` where the density is not known.
    pub carats: Option<f64>,
    /// The volume of the stone in percent of that of the rough's box; `None` where its sides are not given.
    pub yield_of_box_percent: Option<f64>,
    /// The weight of the stone in percent of that of the rough; `None` where either is not known.
    pub yield_of_weight_percent: Option<f64>,
}

impl YieldReport {
    /// Describes a stone of a design's name and of this material, cut from a piece of rough, and its weight in carats, as far
    /// as they are known.
    pub fn of(
        name: &str,
        material: &Material,
        finished: Finished,
        rough: Option<Rough>,
        rough_carats: Option<f64>,
    ) -> Self {
        let carats = material.carats(finished.volume_mm3);
        let of_weight = carats.zip(rough_carats).map(|(carats, rough)| carats / rough);
        let of_box = rough.map(|rough| finished.yield_of(rough.volume_mm3()));
        Self {
            name: name.to_owned(),
            material: material.name.clone(),
            density: material.density,
            rough_mm: rough.map(|rough| rough.sides_mm),
            rough_carats,
            finished,
            carats,
            yield_of_box_percent: of_box.map(|part| 100.0 * part),
            yield_of_weight_percent: of_weight.map(|part| 100.0 * part),
        }
    }
}

impl Finished {
    /// Returns the largest stone of this shape that fits into a piece of rough, table up. It is turned about its axis
    /// to the best fit, and not at all where no turn makes it larger by a thousandth.
    ///
    /// `girdle_mm` gives the thickness of the girdle, mm, whatever the scale; without it the girdle scales with the
    /// stone. A mesh that is not convex, such as a heart, has no girdle to change. The rough is a box, so a cleft
    /// saves nothing of it.
    ///
    /// # Errors
    /// Fails for a girdle that does not fit, for a body that is no cut stone, and where the diameter is out of the
    /// range of sizes.
    pub fn from_rough<'a>(
        body: impl Into<SolidRef<'a>>,
        rough: &Rough,
        girdle_mm: Option<f64>,
    ) -> Result<Self, RoughError> {
        let [length, width, depth] = rough.sides_mm;
        let shape = Shape::of(body.into())?;
        if let Some(mm) = girdle_mm.filter(|mm| !(*mm >= 0.0 && *mm < depth)) {
            return Err(RoughError::Girdle { mm, most: depth });
        }
        let by_depth = match girdle_mm {
            Some(mm) => (depth - mm) / (shape.depth - shape.girdle()?.thickness).max(0.0),
            None => depth / shape.depth,
        };
        let plan = &shape.plan;
        let unturned = (plan.scale([length, width], 0.0), 0.0);
        let largest = plan.largest([length, width]);
        let is_enough = unturned.0 * (1.0 + WORTH_TURNING) >= by_depth.min(largest.0);
        let (by_plan, turn) = if is_enough { unturned } else { largest };
        let limit = if by_depth < by_plan { FitLimit::Depth } else { FitLimit::Footprint };
        let scale = by_depth.min(by_plan);
        let mm = scale * shape.diameter;
        if !DIAMETERS_MM.contains(&mm) {
            return Err(RoughError::Diameter { mm });
        }
        let mut finished = shape.finished(scale, turn, girdle_mm)?;
        finished.limit = limit;
        if limit == FitLimit::Footprint {
            finished.depth_left_mm = (depth - finished.size_mm[2]).max(0.0);
        }
        Ok(finished)
    }

    /// Returns the stone of this shape that has a weight or a diameter. `girdle_mm` is as for [`from_rough`](Self::from_rough).
    ///
    /// # Errors
    /// Fails for a size that is none, a weight of a material without a density, a stone out of the range of sizes, a
    /// girdle that does not fit, and a body that is no cut stone.
    pub fn of_size<'a>(
        body: impl Into<SolidRef<'a>>,
        size: Size,
        material: &Material,
        girdle_mm: Option<f64>,
    ) -> Result<Self, RoughError> {
        let shape = Shape::of(body.into())?;
        let in_radii = shape.volume * (2.0 / shape.diameter).powi(3);
        let scale = size.diameter_mm(in_radii, material)? / shape.diameter;
        let Size::Carats(carats) = size else {
            if let Some(mm) = girdle_mm.filter(|mm| !(*mm >= 0.0 && mm.is_finite())) {
                return Err(RoughError::Girdle { mm, most: *DIAMETERS_MM.end() });
            }
            let found = shape.finished(scale, 0.0, girdle_mm)?;
            return Ok(Self { limit: FitLimit::Diameter, ..found });
        };
        let Some(mm) = girdle_mm else { return shape.finished(scale, 0.0, None) };
        shape.girdle()?;
        let refused = Err(RoughError::GirdleOfWeight { mm, carats });
        if !(mm >= 0.0 && mm.is_finite()) {
            return refused;
        }
        let wanted = shape.volume * scale.powi(3);
        let (mut low, mut high) = (0.01 * scale, 2.0 * scale);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            // Below the least scale that closes, the stone is too small as well.
            let volume = shape.finished(middle, 0.0, Some(mm)).map_or(0.0, |found| found.volume_mm3);
            if volume < wanted { low = middle } else { high = middle }
        }
        let found = shape.finished(high, 0.0, Some(mm))?;
        if (found.volume_mm3 / wanted - 1.0).abs() < WEIGHED { Ok(found) } else { refused }
    }

    /// Returns the part of a volume of rough, mm³, that the stone keeps.
    pub fn yield_of(&self, rough_mm3: f64) -> f64 {
        self.volume_mm3 / rough_mm3
    }
}

impl Rough {
    /// Makes a box of rough.
    ///
    /// # Errors
    /// The error names the first side that is out of range.
    pub fn new(sides_mm: [f64; 3]) -> Result<Self, RoughError> {
        match sides_mm.into_iter().find(|mm| !SIDES_MM.contains(mm)) {
            Some(mm) => Err(RoughError::Side { mm }),
            None => Ok(Self { sides_mm }),
        }
    }

    /// Returns the volume, mm³.
    pub fn volume_mm3(&self) -> f64 {
        self.sides_mm.iter().product()
    }
}

impl FromStr for Rough {
    type Err = RoughError;

    fn from_str(text: &str) -> Result<Self, RoughError> {
        let refused = || RoughError::Text { text: text.chars().take(80).collect() };
        let numbers = text.trim().trim_end_matches("mm").split(['x', 'X', '×']);
        let sides: Vec<f64> =
            numbers.map(|number| number.trim().parse().map_err(|_| refused())).collect::<Result<_, _>>()?;
        Self::new(sides.try_into().map_err(|_| refused())?)
    }
}

/// The parts of a stone's shape that decide its size, in the stone's own unit.
struct Shape<'a> {
    plan: Plan,
    diameter: f64,
    depth: f64,
    volume: f64,
    /// The girdle; `None` for a mesh, whose facets are not moved.
    girdle: Option<ShapeGirdle<'a>>,
}

/// The girdle of a convex stone.
#[derive(Clone, Copy)]
struct ShapeGirdle<'a> {
    stone: &'a Polytope,
    thickness: f64,
}

impl<'a> Shape<'a> {
    fn of(body: SolidRef<'a>) -> Result<Self, RoughError> {
        let corners = hull(body.vertices().iter().map(|vertex| vertex.truncate()).collect());
        let (low, high) = body.bounds();
        let (girdle, across) = match body {
            SolidRef::Convex(stone) => {
                let outline = Outline::of(stone);
                let thickness = outline.girdle_thickness();
                (Some(ShapeGirdle { stone, thickness }), outline.diameter)
            }
            // The same diameter by which a mesh is scaled: see `MeshShape`.
            SolidRef::Triangles(_) => {
                let found = Calipers::of_stone(&corners);
                let least = (high - low).truncate().min_element();
                (None, found.map_or(least, |found| diameter(&corners, found.middle, found.width)))
            }
            SolidRef::Smooth(_) => return Err(RoughError::Smooth),
        };
        let (plan, depth, volume) = (Plan(corners), high.z - low.z, body.volume());
        Ok(Self { plan, diameter: across, depth, volume, girdle })
    }

    fn girdle(&self) -> Result<ShapeGirdle<'a>, RoughError> {
        self.girdle.ok_or(RoughError::GirdleOfMesh)
    }

    /// Returns the stone at a scale, mm for each unit, turned in its rough. Its limit is at first the weight; the
    /// caller sets another one.
    fn finished(&self, scale: f64, turn: f64, girdle_mm: Option<f64>) -> Result<Finished, RoughError> {
        let (volume, thicker) = match girdle_mm {
            Some(mm) => {
                let ShapeGirdle { stone, thickness } = self.girdle()?;
                let thicker = mm / scale - thickness;
                let stone = thickened(stone, thicker).map_err(|_| RoughError::Thin { mm })?;
                (stone.volume(), thicker)
            }
            None => (self.volume, 0.0),
        };
        let depth = scale * (self.depth + thicker);
        let size = |turn: f64| {
            let [along, across] = self.plan.extents(turn);
            [scale * along, scale * across, depth]
        };
        Ok(Finished {
            diameter_mm: scale * self.diameter,
            size_mm: size(turn),
            own_size_mm: size(0.0),
            turn_deg: turn.to_degrees(),
            girdle_mm: self.girdle.map(|girdle| scale * (girdle.thickness + thicker)),
            volume_mm3: volume * scale.powi(3),
            limit: FitLimit::Weight,
            depth_left_mm: 0.0,
        })
    }
}

/// Returns the stone whose facets below the girdle are moved down by a length, so that its girdle is thicker by it.
fn thickened(stone: &Polytope, by: f64) -> Result<Polytope, PolytopeError> {
    let moved = |plane: Plane| {
        if plane.normal.z < -EXACT {
            Plane { offset: plane.offset - plane.normal.z * by, ..plane }
        } else {
            plane
        }
    };
    Polytope::from_planes(&stone.planes().map(moved).collect::<Vec<_>>())
}

/// The outline of a stone seen from above: its corners, counter-clockwise.
struct Plan(Vec<DVec2>);

impl Plan {
    /// Returns the extents along x and y after a turn, radians.
    fn extents(&self, turn: f64) -> [f64; 2] {
        let x = DVec2::from_angle(-turn);
        [x, x.perp()].map(|along| {
            let (low, high) = span(self.0.iter().map(|corner| corner.dot(along)));
            high - low
        })
    }

    /// Returns the largest scale at which the turned outline fits into a rectangle.
    fn scale(&self, sides: [f64; 2], turn: f64) -> f64 {
        let [x, y] = self.extents(turn);
        (sides[0] / x).min(sides[1] / y)
    }

    /// Returns the largest scale at which the outline fits into a rectangle, and the turn, radians, -π/2 to π/2; of equally
    /// good turns the least.
    ///
    /// Between the turns at which an edge lies along a side, each extent is a sine, which bends downward. So the largest scale
    /// is at one of these turns, or between two where the rectangle is touched on all sides.
    fn largest(&self, sides: [f64; 2]) -> (f64, f64) {
        let edges = self.0.iter().zip(self.0.iter().cycle().skip(1));
        let angles = edges.map(|(a, b)| (*b - *a).to_angle());
        let half = |angle: f64| (angle + FRAC_PI_2).rem_euclid(PI) - FRAC_PI_2;
        let mut turns: Vec<f64> = angles.flat_map(|angle| [half(-angle), half(FRAC_PI_2 - angle)]).collect();
        turns.extend([-FRAC_PI_2, 0.0, FRAC_PI_2]);
        turns.sort_by(f64::total_cmp);
        let between: Vec<f64> =
            turns.windows(2).filter_map(|pair| self.touching(sides, pair[0], pair[1])).collect();
        turns.extend(between);
        turns.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
        let scaled = turns.into_iter().map(|turn| (self.scale(sides, turn), turn));
        scaled
            .reduce(|best, next| if next.0 > best.0 * (1.0 + EQUAL) { next } else { best })
            .unwrap_or((0.0, 0.0))
    }

    /// Returns the turn between two neighbouring ones at which the outline touches all sides of the rectangle.
    fn touching(&self, sides: [f64; 2], from: f64, to: f64) -> Option<f64> {
        let x = DVec2::from_angle(-0.5 * (from + to));
        let diagonal = |along: DVec2| {
            let by = |a: &&DVec2, b: &&DVec2| a.dot(along).total_cmp(&b.dot(along));
            Some(*self.0.iter().max_by(by)? - *self.0.iter().min_by(by)?)
        };
        // With u the direction of x, the extents are a·u and b·perp(u) = (b.y, -b.x)·u; both fill their sides where
        // c·u is 0.
        let (a, b) = (diagonal(x)?, diagonal(x.perp())?);
        let c = a / sides[0] - DVec2::new(b.y, -b.x) / sides[1];
        let turn = -(c.to_angle() + FRAC_PI_2);
        let near = from + (turn - from).rem_euclid(PI);
        (near < to).then_some(near)
    }
}

#[cfg(test)]
mod tests;
