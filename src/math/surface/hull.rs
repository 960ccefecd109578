//! The convex hull of a surface's corners, and whether the surface means it: as where facets of four corners were cut
//! into triangles along the wrong diagonal, which bends them inward.

use super::Surface;
use super::change::Change;
use super::edges::Edges;
use super::shape::{NOISE, SAME, Solid, deviation, solid};
use crate::math::{Plane, convex_hull};
use glam::DVec3;

/// Corners of a surface that means its hull lie within this part of its size of it: what careless modelling leaves.
const NEAR: f64 = 1e-3;

/// The hull of such a surface has at most this part more volume. The bent kites of a stone that most demos load leave
/// 1.4 %.
const SWOLLEN: f64 = 0.03;

/// No point of such a surface lies deeper below the hull than this part of its size.
const DEEPEST: f64 = 0.03;

/// A convex hull.
pub(super) struct Hull {
    /// Its triangles, among all corners of the surface.
    surface: Surface,
    /// Its corners.
    corners: Vec<DVec3>,
}

impl Hull {
    /// The hull of a surface's corners; `None` where they lie in one plane.
    pub fn of(surface: &Surface) -> Option<Self> {
        let triangles = convex_hull(&surface.vertices)?;
        let mut is_corner = vec![false; surface.vertices.len()];
        triangles.iter().flatten().for_each(|&v| is_corner[v as usize] = true);
        let corners = surface.vertices.iter().zip(is_corner).filter(|(_, is)| *is).map(|(v, _)| *v).collect();
        Some(Self { surface: Surface::new(surface.vertices.clone(), triangles), corners })
    }

    /// How far the hull reaches beyond a plane; below 0 where it does not reach it.
    pub fn outside(&self, plane: &Plane) -> f64 {
        self.corners.iter().map(|corner| plane.distance(*corner)).fold(f64::NEG_INFINITY, f64::max)
    }

    /// The hull as a solid between the fewest planes that fit; `None` where it is curved or has too many.
    pub fn solid(&self) -> Option<Solid> {
        let (edges, size) = (Edges::of(&self.surface), self.surface.size());
        NOISE.iter().rev().find_map(|noise| solid(&self.surface, &edges, self, (noise * size, SAME)))
    }

    /// The hull as a solid, if the surface means it.
    pub fn meant(&self, surface: &Surface) -> Option<Solid> {
        if self.surface.volume() > (1.0 + SWOLLEN) * surface.volume() {
            return None;
        }
        let size = surface.size();
        let mut solid = self.solid()?;
        // Corners below the hull count as those that lie on it.
        solid.deviation = deviation(&solid.polytope, &surface.vertices);
        let is_near = solid.deviation <= NEAR * size + SAME * solid.tolerance;
        let is_shallow = || Change::of(surface, &solid.polytope).deepest <= DEEPEST * size;
        (is_near && is_shallow()).then_some(solid)
    }
}
