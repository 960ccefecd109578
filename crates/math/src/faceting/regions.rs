//! Gathers triangles that share a plane into regions, starting from the largest triangles.

use super::fit::{PlaneFit, fit};
use crate::edges::{Edges, NONE};
use crate::{Plane, Surface};
use glam::DVec3;

/// The greatest number of times that a region is gathered again from its improved plane.
const ROUNDS: usize = 6;

/// The plane is fitted again whenever a region has grown by this factor.
const GROWN: f64 = 1.5;

/// A smaller region is joined to a larger one if it lies within this many tolerances of the larger one's plane: that
/// plane may be one tolerance off, and corners one more.
const MERGED: f64 = 3.0;

/// Two regions are also joined if both lie within this many tolerances of the plane fitted to both, and their planes
/// differ in direction by no more than [`TURNED`] allows. Two halves of a square whose corners are each one tolerance
/// off are up to four tolerances apart.
const JOINT: f64 = 1.2;
/// The greatest difference in direction of the planes of joined regions: the angle that this many tolerances make at
/// the width of each region.
const TURNED: f64 = 3.0;

/// The normal of a triangle whose height is below this many tolerances is only noise.
const SLIVER: f64 = 4.0;

/// The plane of a region narrower than this many tolerances is only noise.
const NARROW: f64 = 6.0;

/// The mark of a triangle that belongs to no region.
pub(super) const NOWHERE: u32 = u32::MAX;

/// A surface that is divided into regions.
pub(super) struct Regions {
    /// The region of each triangle, or [`NOWHERE`].
    pub of: Vec<u32>,
    /// The plane of each region; the largest region is first.
    pub fits: Vec<PlaneFit>,
}

/// Gathers regions whose corners lie within `tolerance` of their planes; `None` where there are more than `most`.
pub(super) fn regions(surface: &Surface, edges: &Edges, tolerance: f64, most: usize) -> Option<Regions> {
    let areas: Vec<DVec3> = (0..surface.triangles.len()).map(|t| surface.area_vector(t)).collect();
    let mut order: Vec<u32> = (0..areas.len() as u32).collect();
    order.sort_by(|&a, &b| {
        let size = |t: u32| areas[t as usize].length_squared();
        size(b).total_cmp(&size(a)).then(a.cmp(&b))
    });
    let count = areas.len();
    let mut grower =
        Grower { surface, edges, areas, tolerance, of: vec![NOWHERE; count], seen: vec![0; count], round: 0 };
    let mut members = vec![];
    for seed in order {
        if grower.of[seed as usize] == NOWHERE && !grower.is_sliver(seed) {
            let found = grower.grow(seed);
            found.iter().for_each(|&t| grower.of[t as usize] = members.len() as u32);
            members.push(found);
            if members.len() > 4 * most {
                return None;
            }
        }
    }
    let joined = joined(surface, edges, tolerance, grower.of, members);
    (joined.fits.len() <= most).then_some(joined)
}

/// Makes regions of the given triangles, and joins those that share a plane.
pub(super) fn joined(
    surface: &Surface,
    edges: &Edges,
    tolerance: f64,
    of: Vec<u32>,
    members: Vec<Vec<u32>>,
) -> Regions {
    let fits = members.iter().map(|m| fit(surface, m)).collect();
    let mut joiner = Joiner { surface, edges, tolerance, of, members, fits };
    joiner.join();
    joiner.finish()
}

struct Grower<'a> {
    surface: &'a Surface,
    edges: &'a Edges,
    areas: Vec<DVec3>,
    tolerance: f64,
    of: Vec<u32>,
    /// The last round in which each triangle was visited.
    seen: Vec<u32>,
    round: u32,
}

/// Returns whether a triangle is so low that its normal is only noise.
pub(super) fn is_sliver(surface: &Surface, triangle: usize, tolerance: f64) -> bool {
    2.0 * surface.area_vector(triangle).length() <= SLIVER * tolerance * surface.longest_edge(triangle)
}

impl Grower<'_> {
    fn is_sliver(&self, triangle: u32) -> bool {
        is_sliver(self.surface, triangle as usize, self.tolerance)
    }

    fn grow(&mut self, seed: u32) -> Vec<u32> {
        let mut best = vec![seed];
        for round in 0..ROUNDS {
            let Some(PlaneFit { plane, .. }) = fit(self.surface, &best) else { break };
            let found = self.flood(seed, plane, round == 0);
            let settled = found.len() == best.len();
            best = found;
            if settled {
                break;
            }
        }
        best
    }

    /// Returns connected triangles within the tolerance of a plane. If `follows` is true, the plane is fitted again
    /// while the region grows.
    fn flood(&mut self, seed: u32, mut plane: Plane, follows: bool) -> Vec<u32> {
        self.round += 1;
        self.seen[seed as usize] = self.round;
        let mut found = vec![seed];
        let mut next_fit = 3.0;
        let mut at = 0;
        while at < found.len() {
            for n in self.edges.neighbours[found[at] as usize] {
                if n != NONE && self.seen[n as usize] != self.round && self.of[n as usize] == NOWHERE {
                    self.seen[n as usize] = self.round;
                    if self.belongs(n, &plane) {
                        found.push(n);
                    }
                }
            }
            at += 1;
            if follows && found.len() as f64 >= next_fit {
                next_fit = GROWN * found.len() as f64;
                plane = fit(self.surface, &found).map_or(plane, |f| f.plane);
            }
        }
        found
    }

    fn belongs(&self, triangle: u32, plane: &Plane) -> bool {
        let corners = self.surface.corners(triangle as usize);
        let near = corners.iter().all(|&c| plane.distance(c).abs() <= self.tolerance);
        near && (self.areas[triangle as usize].dot(plane.normal) > 0.0 || self.is_sliver(triangle))
    }
}

/// Joins regions, small ones first, to larger neighbours that share their plane.
struct Joiner<'a> {
    surface: &'a Surface,
    edges: &'a Edges,
    tolerance: f64,
    of: Vec<u32>,
    members: Vec<Vec<u32>>,
    /// The fitted plane of each region; `None` for a region that has been joined to another.
    fits: Vec<Option<PlaneFit>>,
}

impl Joiner<'_> {
    fn join(&mut self) {
        let area = |r: u32| self.area(r);
        let mut order: Vec<u32> = (0..self.members.len() as u32).collect();
        order.sort_by(|&a, &b| area(a).total_cmp(&area(b)).then(b.cmp(&a)));
        for small in order {
            let beside = self.beside(small);
            let fitting = beside.into_iter().filter_map(|large| Some((self.misfit(small, large)?, large)));
            let best = fitting.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            if let Some((_, large)) = best {
                let moved = std::mem::take(&mut self.members[small as usize]);
                moved.iter().for_each(|&t| self.of[t as usize] = large);
                self.members[large as usize].extend(moved);
                self.fits[small as usize] = None;
                self.fits[large as usize] = fit(self.surface, &self.members[large as usize]);
            }
        }
    }

    fn area(&self, region: u32) -> f64 {
        self.fits[region as usize].map_or(0.0, |f| f.area)
    }

    /// Returns the neighbouring regions that are no smaller than this one.
    fn beside(&self, region: u32) -> Vec<u32> {
        let across = self.members[region as usize].iter().flat_map(|&t| self.edges.neighbours[t as usize]);
        let regions = across.filter(|&n| n != NONE).map(|n| self.of[n as usize]);
        let larger = |r: &u32| *r != NOWHERE && *r != region && self.area(*r) >= self.area(region);
        let mut beside: Vec<u32> = regions.filter(larger).collect();
        beside.sort_unstable();
        beside.dedup();
        beside
    }

    /// Returns the greatest distance of the corners of two regions from a common plane; `None` where the two do not
    /// share a plane.
    fn misfit(&self, small: u32, large: u32) -> Option<f64> {
        let (mine, other) = (&self.members[small as usize], &self.members[large as usize]);
        let (own, fits) = (self.fits[small as usize], self.fits[large as usize]?);
        let off = |plane: &Plane, of: &[u32]| {
            let corners = of.iter().flat_map(|&t| self.surface.corners(t as usize));
            corners.map(|c| plane.distance(c).abs()).fold(0.0, f64::max)
        };
        let facing = own.is_none_or(|o| o.plane.normal.dot(fits.plane.normal) > 0.5);
        let reached = off(&fits.plane, mine);
        if facing && reached <= MERGED * self.tolerance {
            return Some(reached);
        }
        // Noise alone may have turned the two planes apart, so the plane fitted to both regions decides.
        let own = own?;
        let apart = (own.plane.normal - fits.plane.normal).length();
        if apart > TURNED * self.tolerance * (1.0 / own.width + 1.0 / fits.width) {
            return None;
        }
        let both: Vec<u32> = mine.iter().chain(other).copied().collect();
        let joint = off(&fit(self.surface, &both)?.plane, &both);
        (joint <= JOINT * self.tolerance).then_some(joint)
    }

    /// Leaves out regions that are too narrow to have a plane, and numbers the rest by area.
    fn finish(self) -> Regions {
        let Self { mut of, fits, .. } = self;
        let kept = |f: &PlaneFit| f.width > NARROW * self.tolerance;
        let mut left: Vec<(usize, PlaneFit)> =
            fits.into_iter().enumerate().filter_map(|(old, fit)| Some((old, fit.filter(kept)?))).collect();
        left.sort_by(|(i, a), (j, b)| b.area.total_cmp(&a.area).then(i.cmp(j)));
        let mut number = vec![NOWHERE; self.members.len()];
        (0..).zip(&left).for_each(|(new, (old, _))| number[*old] = new);
        of.iter_mut().filter(|r| **r != NOWHERE).for_each(|r| *r = number[*r as usize]);
        Regions { of, fits: left.into_iter().map(|(_, fit)| fit).collect() }
    }
}
