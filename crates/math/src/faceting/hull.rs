//! The convex hull of a surface's corners, and the test whether a surface is meant to be that hull.
//!
//! A surface is meant to be its hull where, for example, facets of four corners were divided into triangles along the
//! wrong diagonal, which bends them inward.

use super::change::Change;
use super::deviation::deviation;
use super::deviation::outermost;
use super::regions::NOWHERE;
use super::search::{Limits, MatchingSolid, NOISE, SAME, SolidSearch};
use crate::{Plane, Surface, convex_hull};
use glam::DVec3;

/// The greatest distance of a corner from the hull, as a part of the size, at which a surface may be meant to be its
/// hull. Careless modelling leaves corners as far off as this.
const NEAR: f64 = 1e-3;

/// The greatest additional volume of the hull, as a part of the surface's volume, at which a surface may be meant to
/// be its hull. The bent kites of a stone that most demos load give 1.4 %.
pub const SWOLLEN: f64 = 0.03;

/// The greatest depth of a point of the surface below the hull, as a part of the size, at which a surface may be
/// meant to be its hull.
const DEEPEST: f64 = 0.03;

/// A convex hull, as a surface whose corners are those of the hull only.
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

    /// Returns the volume of the hull.
    pub fn volume(&self) -> f64 {
        self.0.volume()
    }

    /// Returns the distance by which the hull reaches beyond a plane; negative where the hull stays behind the plane.
    pub fn outside(&self, plane: &Plane) -> f64 {
        self.0.vertices.iter().map(|corner| plane.distance(*corner)).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Returns the hull as a solid between the fewest planes that fit it, with the triangles of the surface that lie on its
    /// facets; `None` where the hull is curved or has too many facets.
    pub fn solid(&self, surface: &Surface) -> Option<MatchingSolid> {
        let (search, size) = (SolidSearch::of(&self.0), self.0.size());
        let limits = NOISE.iter().rev().map(|noise| Limits { tolerance: noise * size, same: SAME });
        let mut solid = limits.into_iter().find_map(|limits| search.solid(limits))?;
        solid.found.of = lying(surface, &solid);
        Some(solid)
    }

    /// Returns the hull as a solid; `None` where the surface is not meant to be its hull.
    pub fn meant(&self, surface: &Surface) -> Option<MatchingSolid> {
        if self.0.volume() > (1.0 + SWOLLEN) * surface.volume() {
            return None;
        }
        let size = surface.size();
        let mut solid = self.solid(surface)?;
        // The solid may deviate from the hull's own corners; this distance is no fault of the corners below the hull.
        let limit = NEAR * size + solid.deviation;
        solid.deviation = deviation(&solid.polytope, &surface.vertices);
        let is_near = solid.deviation <= limit;
        let is_shallow = || Change::of(surface, &solid.polytope).deepest <= DEEPEST * size;
        (is_near && is_shallow()).then_some(solid)
    }
}

/// Returns the region of each triangle of a surface by the facet of the solid on which it lies, and [`NOWHERE`] for those that
/// lie on none.
fn lying(surface: &Surface, solid: &MatchingSolid) -> Vec<u32> {
    let planes: Vec<Plane> = solid.polytope.planes().collect();
    let region = |t: usize| {
        let corners = surface.corners(t);
        let (facet, _) = outermost(&planes, corners.iter().sum::<DVec3>() / 3.0);
        let is_on = |corner: &DVec3| planes[facet].distance(*corner).abs() <= SAME * solid.tolerance;
        let faces = surface.area_vector(t).dot(planes[facet].normal) > 0.0;
        let source = solid.polytope.facets()[facet].source as u32;
        if faces && corners.iter().all(is_on) { source } else { NOWHERE }
    };
    (0..surface.triangles.len()).map(region).collect()
}
