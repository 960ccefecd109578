//! What a ray meets: a convex stone's planes, or the triangles of any solid.
//!
//! Whether a ray is inside or outside is known from how it came, never asked of the solid. Outside it meets only what it
//! runs into, inside only what it runs out of; so it cannot meet the facet again that it starts from.

use super::search::Search;
use crate::math::{Plane, Shell};
use glam::DVec3;
use std::sync::Arc;

/// A solid's facets.
pub(super) trait Facets {
    /// Whether light that has left may meet the solid again.
    const BRANCHES: bool;

    /// A facet's outward normal.
    fn normal(&self, facet: usize) -> DVec3;

    /// Facet and distance, not below 0, at which a ray from a point outside or on the surface enters; `None` where it
    /// misses.
    fn entry(&self, origin: DVec3, direction: DVec3) -> Option<(usize, f64)>;

    /// Facet, distance and cosine of incidence at which a ray from a point inside or on the surface leaves; `None` where
    /// rounding has let it slip out.
    fn next(&self, point: DVec3, direction: DVec3) -> Option<(usize, f64, f64)>;
}

/// The facets of either kind of solid.
#[derive(Debug, Clone)]
pub(super) enum Shape {
    Planes(Arc<Planes>),
    Triangles(Triangles),
}

/// The planes of a convex solid.
#[derive(Debug)]
pub(super) struct Planes {
    planes: Vec<Plane>,
    search: Search,
}

/// The triangles of a solid that need not be convex.
#[derive(Debug, Clone)]
pub(super) struct Triangles {
    shell: Arc<Shell>,
    /// How far behind its start a ray may still meet a triangle.
    behind: f64,
}

/// Rounding may put the start of a ray so far beyond the triangle that it is about to meet, as a part of how far the solid
/// reaches from the origin: some thousand roundings, and far below any edge meant.
const BEHIND: f64 = 1e-12;

/// What stands no farther before a point of the surface is taken for the facets there, as a part of how far the solid
/// reaches: less than a pixel of any picture.
const CLOSE: f64 = 1e-6;

impl Shape {
    pub fn normal(&self, facet: usize) -> DVec3 {
        match self {
            Self::Planes(planes) => planes.normal(facet),
            Self::Triangles(triangles) => triangles.normal(facet),
        }
    }

    pub fn entry(&self, origin: DVec3, direction: DVec3) -> Option<(usize, f64)> {
        match self {
            Self::Planes(planes) => planes.entry(origin, direction),
            Self::Triangles(triangles) => triangles.entry(origin, direction),
        }
    }
}

impl Shape {
    /// After which distance light that leaves enters again.
    pub fn again(&self, (origin, direction): (DVec3, DVec3)) -> Option<f64> {
        match self {
            Self::Planes(_) => None,
            Self::Triangles(triangles) => triangles.entry(origin, direction).map(|(_, distance)| distance),
        }
    }
}

impl Planes {
    pub fn new(planes: Vec<Plane>) -> Self {
        Self { search: Search::new(&planes), planes }
    }
}

impl Facets for Planes {
    const BRANCHES: bool = false;

    #[inline]
    fn normal(&self, facet: usize) -> DVec3 {
        self.planes[facet].normal
    }

    fn entry(&self, origin: DVec3, direction: DVec3) -> Option<(usize, f64)> {
        let facet = self.search.entry(origin, direction)?;
        let plane = &self.planes[facet];
        let distance = -plane.distance(origin) / plane.normal.dot(direction);
        (distance > 0.0).then_some((facet, distance))
    }

    #[inline]
    fn next(&self, point: DVec3, direction: DVec3) -> Option<(usize, f64, f64)> {
        let facet = self.search.next(point, direction);
        let plane = &self.planes[facet];
        let cos_i = plane.normal.dot(direction);
        Some((facet, -plane.distance(point) / cos_i, cos_i))
    }
}

impl Triangles {
    pub fn new(shell: &Arc<Shell>) -> Self {
        let reach = shell.vertices().iter().map(|v| v.length()).fold(0.0, f64::max);
        Self { shell: Arc::clone(shell), behind: -BEHIND * reach }
    }

    /// Facet and distance of the first triangle whose normal's part along the ray `keep` takes.
    fn first(&self, origin: DVec3, direction: DVec3, keep: impl Fn(f64) -> bool) -> Option<(usize, f64)> {
        let facet = |triangle: u32| self.shell.facets()[triangle as usize] as usize;
        let is_kept = |triangle| keep(self.normal(facet(triangle)).dot(direction));
        let hit = self.shell.bvh().nearest(origin, direction, self.behind, is_kept)?;
        Some((facet(hit.triangle), hit.distance.max(0.0)))
    }
}

impl Triangles {
    /// Whether the solid stands before a point of its surface.
    pub fn hides(&self, (origin, direction): (DVec3, DVec3)) -> bool {
        // Away from the facets that meet in the point.
        let away = -self.behind / BEHIND * CLOSE;
        self.entry(origin + direction * away, direction).is_some()
    }
}

impl Facets for Triangles {
    const BRANCHES: bool = true;

    fn normal(&self, facet: usize) -> DVec3 {
        self.shell.planes()[facet].normal
    }

    fn entry(&self, origin: DVec3, direction: DVec3) -> Option<(usize, f64)> {
        self.first(origin, direction, |speed| speed < 0.0)
    }

    fn next(&self, point: DVec3, direction: DVec3) -> Option<(usize, f64, f64)> {
        let (facet, distance) = self.first(point, direction, |speed| speed > 0.0)?;
        Some((facet, distance, self.normal(facet).dot(direction)))
    }
}
