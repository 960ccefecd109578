//! The surfaces that rays meet: the planes of a convex stone, the triangles of any solid, or a smooth surface.
//!
//! The tracer knows from the ray's path so far whether the ray is inside or outside, and never asks the solid. From
//! outside, a ray meets only facets that it runs into; from inside, only facets that it runs out of. So it never
//! meets the facet again from which it starts.

use super::exit_planes::ExitPlanes;
use super::search::Search;
use crate::facet_guess::FacetGuess;
use brillianteer_math::{FromSide, ImplicitSurface, Plane, Polytope, SolidRef, TriangleMesh};
use glam::DVec3;
use std::ops::Range;
use std::sync::Arc;

/// A search for the facets of a solid that rays meet.
pub(super) trait FacetSearch {
    /// Returns the unit outward normal at a point of a facet.
    fn normal(&self, facet: usize, point: DVec3) -> DVec3;

    /// Returns the change of that normal when the point moves along the surface by `by`; `None` where the surface is
    /// flat.
    #[inline]
    fn turned(&self, _point: DVec3, _by: DVec3) -> Option<DVec3> {
        None
    }

    /// Returns the facet and the distance, not below 0, at which a ray from a point outside or on the surface enters; `None`
    /// where it misses.
    fn entry(&self, origin: DVec3, direction: DVec3) -> Option<(usize, f64)>;

    /// Returns the facet and the distance at which light that leaves by a facet, at this point of it, enters the
    /// solid again.
    fn again(&self, _facet: usize, point: DVec3, direction: DVec3) -> Option<(usize, f64)> {
        self.entry(point, direction)
    }

    /// Returns the facet and the distance at which a ray from a point inside or on the surface leaves; `None` where rounding
    /// has let the ray slip out.
    fn next(&self, point: DVec3, direction: DVec3) -> Option<(usize, f64)>;
}

/// The facets of any kind of solid.
#[derive(Debug, Clone)]
pub(super) enum SolidFacets {
    Planes(Arc<Planes>),
    Triangles(TriangleFacets),
    Smooth(SmoothFacets),
    Wavy(Wavy),
}

/// A smooth convex surface.
#[derive(Debug, Clone)]
pub(super) struct SmoothFacets(pub ImplicitSurface);

/// A smooth surface that need not be convex.
#[derive(Debug, Clone)]
pub(super) struct Wavy(pub ImplicitSurface);

/// The planes of a convex solid.
#[derive(Debug)]
pub(super) struct Planes {
    planes: Vec<Plane>,
    guess: FacetGuess,
    search: Search,
    /// The planes that adjoin each facet, one facet's after the other's.
    neighbours: Vec<Plane>,
    /// For each facet, the range of its neighbours in that list.
    of: Vec<Range<usize>>,
}

/// The triangles of a solid that need not be convex.
#[derive(Debug, Clone)]
pub(super) struct TriangleFacets {
    mesh: Arc<TriangleMesh>,
    /// The distance from which on a ray may meet a triangle. It is negative, because rounding may put a triangle a
    /// little behind the ray's start.
    behind: f64,
    /// The planes by which light leaves, where the solid has few facets.
    exits: Option<Arc<ExitPlanes>>,
}

/// The farthest that rounding may put the start of a ray beyond the triangle that it is about to meet, as a part of
/// the solid's reach from the origin. It is some thousand roundings, and far below any edge that a designer wants.
const BEHIND: f64 = 1e-12;

/// The distance before a point of the surface within which all facets count as the facets at that point, as a part of
/// the solid's reach. It is less than a pixel of any picture.
const CLOSE: f64 = 1e-6;

impl SolidFacets {
    pub fn normal(&self, facet: usize, point: DVec3) -> DVec3 {
        match self {
            Self::Planes(planes) => planes.normal(facet, point),
            Self::Triangles(triangles) => triangles.normal(facet, point),
            Self::Smooth(SmoothFacets(field)) | Self::Wavy(Wavy(field)) => field.normal(point),
        }
    }

    pub fn entry(&self, origin: DVec3, direction: DVec3) -> Option<(usize, f64)> {
        match self {
            Self::Planes(planes) => planes.entry(origin, direction),
            Self::Triangles(triangles) => triangles.entry(origin, direction),
            Self::Smooth(smooth) => smooth.entry(origin, direction),
            Self::Wavy(wavy) => wavy.entry(origin, direction),
        }
    }

    /// Returns the distance at which light that leaves by a facet, at this point of it, enters the solid again.
    pub fn again(&self, facet: usize, point: DVec3, direction: DVec3) -> Option<f64> {
        match self {
            Self::Planes(_) | Self::Smooth(_) => None,
            Self::Triangles(triangles) => {
                triangles.again(facet, point, direction).map(|(_, distance)| distance)
            }
            Self::Wavy(Wavy(field)) => field.entry(point, direction),
        }
    }
}

impl Planes {
    pub fn new(polytope: &Polytope) -> Self {
        let planes: Vec<Plane> = polytope.planes().collect();
        let (mut neighbours, mut of) = (vec![], vec![]);
        for facet in polytope.facets() {
            let first = neighbours.len();
            neighbours.extend(facet.neighbours.iter().map(|&k| planes[k as usize]));
            of.push(first..neighbours.len());
        }
        let (guess, search) = (FacetGuess::new(polytope.planes()), Search::new(&planes));
        Self { planes, guess, search, neighbours, of }
    }

    /// Returns the distance at which a ray from inside leaves by this facet; `None` where it leaves by another one,
    /// because it meets the plane of a neighbour first.
    #[inline]
    fn leaves_by(&self, facet: usize, point: DVec3, direction: DVec3) -> Option<f64> {
        let plane = &self.planes[facet];
        let speed = plane.normal.dot(direction);
        let distance = -plane.distance(point) / speed;
        let end = point + direction * distance;
        let mut around = self.neighbours[self.of[facet].clone()].iter();
        (speed > 0.0 && around.all(|plane| plane.distance(end) <= 0.0)).then_some(distance)
    }
}

impl FacetSearch for Planes {
    #[inline]
    fn normal(&self, facet: usize, _: DVec3) -> DVec3 {
        self.planes[facet].normal
    }

    fn entry(&self, origin: DVec3, direction: DVec3) -> Option<(usize, f64)> {
        let facet = self.search.entry(origin, direction)?;
        let plane = &self.planes[facet];
        let distance = -plane.distance(origin) / plane.normal.dot(direction);
        (distance > 0.0).then_some((facet, distance))
    }

    #[inline]
    fn next(&self, point: DVec3, direction: DVec3) -> Option<(usize, f64)> {
        let guess = self.guess.ahead_of(point, direction) as usize;
        if let Some(distance) = self.leaves_by(guess, point, direction) {
            return Some((guess, distance));
        }
        let facet = self.search.next(point, direction);
        let plane = &self.planes[facet];
        Some((facet, -plane.distance(point) / plane.normal.dot(direction)))
    }
}

impl TriangleFacets {
    pub fn new(mesh: &Arc<TriangleMesh>) -> Self {
        let slack = BEHIND * SolidRef::from(mesh).reach();
        let exits = ExitPlanes::new(mesh, slack).map(Arc::new);
        Self { mesh: Arc::clone(mesh), behind: -slack, exits }
    }

    /// Returns whether the solid hides a point of its surface from an eye in this direction.
    pub fn hides(&self, (origin, direction): (DVec3, DVec3)) -> bool {
        // The ray starts at a distance from the facets that meet in the point.
        let away = -self.behind / BEHIND * CLOSE;
        self.entry(origin + direction * away, direction).is_some()
    }
}

/// Returns the facet and the distance of the first triangle that a ray meets from one side of the surface, beyond `behind`.
fn first(
    mesh: &TriangleMesh,
    side: FromSide,
    (origin, direction): (DVec3, DVec3),
    behind: f64,
) -> Option<(usize, f64)> {
    let hit = mesh.bvh().nearest_from(side, origin, direction, behind)?;
    Some((mesh.facets()[hit.triangle as usize] as usize, hit.distance.max(0.0)))
}

impl Wavy {
    /// Returns whether the solid hides a point of its surface, or of a line drawn on it, from an eye in this
    /// direction.
    pub fn hides(&self, (origin, direction): (DVec3, DVec3)) -> bool {
        let jet = self.0.jet(origin);
        let steep = jet.gradient.length();
        // The ray starts on the surface above the point, and a little farther out.
        let lift = ((-jet.value).max(0.0) / steep + CLOSE * self.0.reach()) / steep;
        self.0.entry(origin + jet.gradient * lift, direction).is_some()
    }
}

impl FacetSearch for TriangleFacets {
    fn normal(&self, facet: usize, _: DVec3) -> DVec3 {
        self.mesh.planes()[facet].normal
    }

    fn entry(&self, origin: DVec3, direction: DVec3) -> Option<(usize, f64)> {
        first(&self.mesh, FromSide::Outside, (origin, direction), self.behind)
    }

    fn again(&self, facet: usize, point: DVec3, direction: DVec3) -> Option<(usize, f64)> {
        self.mesh.is_overtopped(facet).then(|| self.entry(point, direction)).flatten()
    }

    fn next(&self, point: DVec3, direction: DVec3) -> Option<(usize, f64)> {
        match &self.exits {
            Some(exits) => exits.next((point, direction), self.behind),
            None => first(&self.mesh, FromSide::Inside, (point, direction), self.behind),
        }
    }
}

/// Implements `FacetSearch` for a smooth surface.
macro_rules! smooth {
    ($kind:ident) => {
        impl FacetSearch for $kind {
            #[inline]
            fn normal(&self, _: usize, point: DVec3) -> DVec3 {
                self.0.normal(point)
            }

            fn turned(&self, point: DVec3, by: DVec3) -> Option<DVec3> {
                Some(self.0.bend(point) * by)
            }

            fn entry(&self, origin: DVec3, direction: DVec3) -> Option<(usize, f64)> {
                let distance = self.0.entry(origin, direction)?;
                Some((self.0.facet(origin + direction * distance) as usize, distance))
            }

            fn next(&self, point: DVec3, direction: DVec3) -> Option<(usize, f64)> {
                let distance = self.0.exit(point, direction)?;
                Some((self.0.facet(point + direction * distance) as usize, distance))
            }
        }
    };
}

smooth!(SmoothFacets);
smooth!(Wavy);
