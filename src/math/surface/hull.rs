//! The convex hull of a surface's corners, and whether the surface means it: as where facets of four corners were cut
//! into triangles along the wrong diagonal, which bends them inward.

use super::Surface;
use super::change::Change;
use super::edges::Edges;
use super::shape::{MatchingSolid, NOISE, SAME, deviation, solid};
use crate::math::{Plane, convex_hull};
use std::cell::OnceCell;

/// Corners of a surface that means its hull lie within this part of its size of it: what careless modelling leaves.
const NEAR: f64 = 1e-3;

/// The hull of such a surface has at most this part more volume. The bent kites of a stone that most demos load leave
/// 1.4 %.
const SWOLLEN: f64 = 0.03;

/// No point of such a surface lies deeper below the hull than this part of its size.
const DEEPEST: f64 = 0.03;

/// The convex hull of a surface's corners, made when it is first asked for: most surfaces do without.
pub(super) struct LazyHull<'a> {
    surface: &'a Surface,
    made: OnceCell<Option<Hull>>,
}

impl<'a> LazyHull<'a> {
    /// The hull of a surface's corners.
    pub fn of(surface: &'a Surface) -> Self {
        Self { surface, made: OnceCell::new() }
    }

    /// The hull; `None` where the corners lie in one plane.
    pub fn get(&self) -> Option<&Hull> {
        self.made.get_or_init(|| Hull::of(self.surface)).as_ref()
    }
}

/// A convex hull: a surface whose corners are all corners of the hull.
pub(super) struct Hull(Surface);

impl Hull {
    /// The hull of a surface's corners; `None` where they lie in one plane.
    fn of(surface: &Surface) -> Option<Self> {
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

    /// How far the hull reaches beyond a plane; below 0 where it does not reach it.
    pub fn outside(&self, plane: &Plane) -> f64 {
        self.0.vertices.iter().map(|corner| plane.distance(*corner)).fold(f64::NEG_INFINITY, f64::max)
    }

    /// The hull as a solid between the fewest planes that fit; `None` where it is curved or has too many.
    pub fn solid(&self) -> Option<MatchingSolid> {
        let (edges, size) = (Edges::of(&self.0), self.0.size());
        let own = LazyHull::of(&self.0);
        NOISE.iter().rev().find_map(|noise| solid(&self.0, &edges, &own, (noise * size, SAME)))
    }

    /// The hull as a solid, if the surface means it.
    pub fn meant(&self, surface: &Surface) -> Option<MatchingSolid> {
        if self.0.volume() > (1.0 + SWOLLEN) * surface.volume() {
            return None;
        }
        let size = surface.size();
        let mut solid = self.solid()?;
        // How far the solid leaves the hull's own corners is no fault of those that lie below it.
        let limit = NEAR * size + solid.deviation;
        solid.deviation = deviation(&solid.polytope, &surface.vertices);
        let is_near = solid.deviation <= limit;
        let is_shallow = || Change::of(surface, &solid.polytope).deepest <= DEEPEST * size;
        (is_near && is_shallow()).then_some(solid)
    }
}
