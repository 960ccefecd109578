//! The stone whose facets all corners lie on, in a mesh without noise whose triangles lie across its edges.
//!
//! Corners that were spread over a stone without regard to its edges, by directions or by rows, all lie on its facets; but triangles
//! between corners of two facets cut the edge off. Each makes a facet of its own, or a dent. The stone is found by what such triangles
//! lack: every corner of theirs lies on a true facet as well. The planes on which all corners lie are gathered from the region of most corners
//! on, and those without which the others still hold all corners are left out.

use super::fit::{PlaneFit, fit};
use super::regions::{NOWHERE, Regions, regions};
use super::scan;
use super::search::{MOST_FACETS, MatchingSolid, SAME};
use crate::edges::{Edges, NONE};
use crate::{Plane, Polytope, Surface};
use rayon::prelude::*;

/// The tolerance of coordinates of 32 bits, as a part of the size.
const SINGLE: f64 = 1e-6;

/// The coarsest rounding of a mesh without noise, as a part of the size: four decimals of a stone of 3 mm.
const COARSEST: f64 = 4e-5;

/// The part of the triangles whose neighbours all lie in their plane: in a surface with fewer there is no stone to be found. One that is
/// curved, or has noise, has next to none.
const FLAT: f64 = 0.1;

/// The most regions that are gathered: each triangle across an edge is one.
const MOST_REGIONS: usize = 10_000;

/// The fewest corners that lie on a facet and on no other: any three lie in one plane.
const OWN: usize = 4;

/// The greatest part of the volume that triangles across the edges may cut off, as in scans.
const CUT_OFF: f64 = 0.02;

/// Returns the solid on whose facets all corners of a surface lie; `None` where there is none, or where the surface has noise. `trusted` is
/// the solid that reproduces the surface otherwise, if there is one: it stays, unless it is that of a scan that hides some of the facets.
pub(super) fn covering(
    surface: &Surface,
    edges: &Edges,
    trusted: Option<&MatchingSolid>,
) -> Option<MatchingSolid> {
    if surface.vertices.len() < scan::FEWEST || trusted.is_some_and(|solid| solid.errors.is_none()) {
        return None;
    }
    let tolerance = tolerance(surface)?;
    let is_complete = trusted.is_some_and(|solid| solid.deviation <= SAME * tolerance);
    if is_complete || flat_part(surface, edges, tolerance) < FLAT {
        return None;
    }
    let found = regions(surface, edges, tolerance, MOST_REGIONS)?;
    let mut cover = Cover { surface, near: SAME * tolerance, kept: vec![], times: vec![] };
    cover.gather(&found)?;
    cover.prune();
    let solid = cover.solid(tolerance)?;
    let count = solid.polytope.facets().len();
    trusted.is_none_or(|scan| count > scan.polytope.facets().len()).then_some(solid)
}

/// Returns the distance that rounding moves corners; `None` where it is more than that of a mesh without noise.
fn tolerance(surface: &Surface) -> Option<f64> {
    let (size, rounding) = (surface.size(), scan::steps(&surface.vertices).length() / 2.0);
    (rounding <= COARSEST * size).then_some(rounding.max(SINGLE * size))
}

/// Returns the part of the triangles whose neighbours all lie in their plane.
fn flat_part(surface: &Surface, edges: &Edges, tolerance: f64) -> f64 {
    let is_flat = |&t: &usize| {
        let [a, b, c] = surface.corners(t);
        let normal = (b - a).cross(c - a);
        let most = tolerance * normal.length() * SAME;
        let is_in_plane = |n: &u32| {
            *n != NONE && surface.corners(*n as usize).iter().all(|v| normal.dot(*v - a).abs() <= most)
        };
        edges.neighbours[t].iter().all(is_in_plane)
    };
    let count = surface.triangles.len();
    (0..count).into_par_iter().filter(is_flat).count() as f64 / count as f64
}

/// A facet, with the corners that lie on it.
struct Kept {
    fit: PlaneFit,
    corners: Vec<u32>,
}

/// The facets so far, and how many of them each corner lies on.
struct Cover<'a> {
    surface: &'a Surface,
    /// The distance within which a corner lies on a facet.
    near: f64,
    kept: Vec<Kept>,
    times: Vec<u32>,
}

impl Cover<'_> {
    /// Takes the planes of regions, those of most corners first, that no corner lies beyond and that hold a corner which none before has; `None`
    /// where they do not hold all corners, or are too many.
    fn gather(&mut self, found: &Regions) -> Option<()> {
        self.times = vec![0; self.surface.vertices.len()];
        let mut left = self.surface.vertices.len();
        let mut regions: Vec<(&PlaneFit, Vec<u32>)> = found.fits.iter().zip(self.corners_of(found)).collect();
        regions.sort_by_key(|(_, corners)| std::cmp::Reverse(corners.len()));
        for (fit, own) in regions {
            if own.iter().all(|&v| self.times[v as usize] > 0) {
                continue;
            }
            let Some(corners) = self.on(&fit.plane) else { continue };
            for &v in &corners {
                left -= usize::from(self.times[v as usize] == 0);
                self.times[v as usize] += 1;
            }
            self.kept.push(Kept { fit: *fit, corners });
            if left == 0 || self.kept.len() > MOST_FACETS {
                break;
            }
        }
        (left == 0).then_some(())
    }

    /// Returns the corners of the triangles of each region.
    fn corners_of(&self, found: &Regions) -> Vec<Vec<u32>> {
        let mut corners = vec![vec![]; found.fits.len()];
        for (t, &region) in
            self.surface.triangles.iter().zip(&found.of).filter(|(_, region)| **region != NOWHERE)
        {
            corners[region as usize].extend(t);
        }
        corners.iter_mut().for_each(|of: &mut Vec<u32>| {
            of.sort_unstable();
            of.dedup();
        });
        corners
    }

    /// Returns the corners on a plane; `None` where some lie beyond it.
    fn on(&self, plane: &Plane) -> Option<Vec<u32>> {
        let mut on = vec![];
        for (v, at) in (0..).zip(&self.surface.vertices) {
            let distance = plane.distance(*at);
            if distance > self.near {
                return None;
            }
            if distance >= -self.near {
                on.push(v);
            }
        }
        Some(on)
    }

    /// Leaves out facets whose corners all lie on others, the smallest first.
    fn prune(&mut self) {
        for place in (0..self.kept.len()).rev() {
            if self.kept[place].corners.iter().all(|&v| self.times[v as usize] > 1) {
                let left_out = self.kept.remove(place);
                left_out.corners.iter().for_each(|&v| self.times[v as usize] -= 1);
            }
        }
    }

    /// Returns the solid between the planes, fitted to all triangles on them; `None` where a facet has too few corners of its own, or
    /// where the solid differs from the surface by more than triangles across its edges explain.
    fn solid(&self, tolerance: f64) -> Option<MatchingSolid> {
        let own = |kept: &Kept| kept.corners.iter().filter(|&&v| self.times[v as usize] == 1).count();
        if self.kept.iter().any(|kept| own(kept) < OWN) {
            return None;
        }
        let fits: Vec<PlaneFit> = self.kept.par_iter().map(|kept| self.whole(kept)).collect();
        let planes: Vec<Plane> = fits.iter().map(|fit| fit.plane).collect();
        let polytope = Polytope::from_planes(&planes).ok()?;
        if polytope.facets().len() != planes.len() {
            return None;
        }
        let deviation = super::deviation(&polytope, &self.surface.vertices);
        let excess = polytope.volume() - self.surface.volume();
        let is_cut_off =
            excess >= -self.near * polytope.surface_area() && excess <= CUT_OFF * polytope.volume();
        let is_same = deviation <= self.near && is_cut_off;
        let of = super::search::facet_of_triangles(self.surface, &polytope);
        let found = Regions { of, fits };
        is_same.then(|| MatchingSolid {
            found,
            polytope,
            deviation,
            tolerance,
            errors: None,
            are_bent: vec![],
        })
    }

    /// Returns the plane of all triangles whose corners lie on a facet.
    fn whole(&self, kept: &Kept) -> PlaneFit {
        let lies = |t: &u32| {
            let corners = self.surface.triangles[*t as usize];
            corners.iter().all(|v| kept.corners.binary_search(v).is_ok())
        };
        let all: Vec<u32> = (0..self.surface.triangles.len() as u32).filter(lies).collect();
        fit(self.surface, &all).unwrap_or(kept.fit)
    }
}
