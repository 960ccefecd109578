//! The convex hull of a surface's corners, and whether a surface is meant to be that hull.
//!
//! A surface is meant to be its hull where, for example, facets of four corners were cut into triangles along the wrong
//! diagonal, which bends them inward.

use super::change::Change;
use super::deviation::deviation;
use super::search::{Limits, MatchingSolid, NOISE, SAME, SolidSearch};
use crate::math::{Plane, Surface, convex_hull};

/// If a surface is meant to be its hull, its corners lie within this part of its size from the hull: as near as careless
/// modelling leaves them.
const NEAR: f64 = 1e-3;

/// If a surface is meant to be its hull, the hull has at most this part more volume. The bent kites of a stone that most
/// demos load leave 1.4 %.
const SWOLLEN: f64 = 0.03;

/// If a surface is meant to be its hull, none of its points lies deeper below the hull than this part of its size.
const DEEPEST: f64 = 0.03;

/// A convex hull, as a surface with no other corners than those of the hull.
pub(super) struct Hull(Surface);

impl Hull {
    /// Computes the hull of a surface's corners; `None` where they lie in one plane.
    pub fn of(surface: &Surface) -> Option<Self> {
        let mut triangles = convex_hull(&surface.vertices)?;
        let mut place = vec![None; surface.vertices.len()];
        let mut corners = vec![];
        for corner in triangles.iter_mut().flatten() {
            let known = &mut place[*corner as usize];
            *corner = *known.get_or_insert_with(|| {
                corners.push(surface.vertices[*corner as usize]);
                corners.len() as u32 - 1
            });
        }
        Some(Self(Surface::new(corners, triangles)))
    }

    /// Returns how far the hull reaches beyond a plane; below 0 where it stays behind the plane.
    pub fn outside(&self, plane: &Plane) -> f64 {
        self.0.vertices.iter().map(|corner| plane.distance(*corner)).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Returns the hull as a solid between the fewest planes that fit; `None` where it is curved or has too many facets.
    pub fn solid(&self) -> Option<MatchingSolid> {
        let (search, size) = (SolidSearch::of(&self.0), self.0.size());
        NOISE.iter().rev().find_map(|noise| search.solid(Limits { tolerance: noise * size, same: SAME }))
    }

    /// Returns the hull as a solid, if the surface is meant to be its hull.
    pub fn meant(&self, surface: &Surface) -> Option<MatchingSolid> {
        if self.0.volume() > (1.0 + SWOLLEN) * surface.volume() {
            return None;
        }
        let size = surface.size();
        let mut solid = self.solid()?;
        // The solid may leave the hull's own corners, and corners below the hull are not to blame for that distance.
        let limit = NEAR * size + solid.deviation;
        solid.deviation = deviation(&solid.polytope, &surface.vertices);
        let is_near = solid.deviation <= limit;
        let is_shallow = || Change::of(surface, &solid.polytope).deepest <= DEEPEST * size;
        (is_near && is_shallow()).then_some(solid)
    }
}
