//! Patches of neighbouring corners: what they show of the noise, and the planes that begin facets.

use super::points::{PlaneEstimate, PointSums};
use super::rounding::steps;
use crate::Surface;
use glam::DVec3;
use rayon::prelude::*;

/// The size of the smallest patches: a corner and its neighbours, which usually are six.
const RING: usize = 7;

/// The size of the smallest patches of free corners alone, which fit into narrow facets without corners within.
const NARROW: usize = 8;

/// The most corners of a patch.
const MOST: usize = 400;

/// A surface has at least this many patches, so that they are small beside its facets.
const PATCHES: usize = 60;

/// The number of corners of a patch for noise of one edge's length. The plane of a patch of m corners leans by 3.5 times
/// the noise in edges, divided by m: here by 0.01 radians.
const PER_NOISE: f64 = 350.0;

/// The most patches that are fitted. Even a facet of a thousandth of the surface has dozens of them.
const MOST_PATCHES: usize = 50_000;

/// The part of the patches that lie flat for certain, by whose greatest variance the noise is judged: the others may lie
/// across an edge.
const FLAT: f64 = 0.25;

/// The normal distribution's quantile of [`FLAT`].
const FLAT_QUANTILE: f64 = -0.674_489_75;

/// The part of a facet's corners, and the number besides, that may lie beyond its plane by more than noise: noise has tails.
const BEYOND: f64 = 5e-3;
const BEYOND_ALWAYS: usize = 2;

/// The least noise that is told from none, as a part of the size. Coordinates of 32 bits are rounded by less, to which sums of squares are
/// not exact, and corners on a facet square to an axis show none.
const LEAST_NOISE: f64 = 5e-7;

/// The corners that share an edge with each corner.
pub(super) struct Neighbours {
    first: Vec<u32>,
    all: Vec<u32>,
}

impl Neighbours {
    pub fn of(surface: &Surface) -> Self {
        let mut sides: Vec<[u32; 2]> = surface
            .triangles
            .iter()
            .flat_map(|t| (0..3).flat_map(|k| [[t[k], t[(k + 1) % 3]], [t[(k + 1) % 3], t[k]]]))
            .collect();
        sides.par_sort_unstable();
        sides.dedup();
        let mut first = vec![0; surface.vertices.len() + 1];
        sides.iter().for_each(|side| first[side[0] as usize + 1] += 1);
        (1..first.len()).for_each(|v| first[v] += first[v - 1]);
        Self { first, all: sides.into_iter().map(|side| side[1]).collect() }
    }

    pub fn of_corner(&self, corner: u32) -> &[u32] {
        let at = corner as usize;
        &self.all[self.first[at] as usize..self.first[at + 1] as usize]
    }
}

/// A corner, and the plane of the corners around it.
pub(super) struct Patch {
    pub corner: u32,
    pub fit: PlaneEstimate,
}

/// Marks of corners that were visited.
#[derive(Clone)]
pub(super) struct Visited {
    marks: Vec<u32>,
    round: u32,
}

impl Visited {
    pub fn of(corners: usize) -> Self {
        Self { marks: vec![0; corners], round: 0 }
    }

    /// Forgets all visits.
    pub fn clear(&mut self) {
        self.round += 1;
    }

    /// Visits a corner, and returns whether that is its first visit.
    pub fn visit(&mut self, corner: u32) -> bool {
        std::mem::replace(&mut self.marks[corner as usize], self.round) != self.round
    }
}

/// The corners of a scan, their neighbours, and a point inside.
pub(super) struct ScanCorners<'a> {
    pub at: &'a [DVec3],
    pub triangles: &'a [[u32; 3]],
    pub neighbours: Neighbours,
    /// The mean of the corners.
    pub inside: DVec3,
    /// The usual distance between neighbouring corners.
    pub spacing: f64,
    /// The steps to which the coordinates were rounded, along each axis; 0 where none is found.
    pub steps: DVec3,
    /// The standard deviation of the noise that is the least in any scan.
    pub least_noise: f64,
}

impl<'a> ScanCorners<'a> {
    pub fn of(surface: &'a Surface) -> Self {
        let count = surface.vertices.len() as f64;
        Self {
            at: &surface.vertices,
            triangles: &surface.triangles,
            neighbours: Neighbours::of(surface),
            inside: surface.vertices.iter().sum::<DVec3>() / count,
            // Corners in triangles of equal sides share the area evenly.
            spacing: (surface.area() / count * 2.0 / 3.0_f64.sqrt()).sqrt(),
            steps: steps(&surface.vertices),
            least_noise: LEAST_NOISE * surface.size(),
        }
    }

    /// Returns `size` free corners around a corner, the nearest first by the number of edges between; for [`RING`] the corner
    /// and its neighbours, free or not. If a corner lies within a facet, so does its ring.
    fn around(&self, corner: u32, size: usize, is_free: &[bool], visited: &mut Visited) -> Vec<u32> {
        let mut found = vec![corner];
        if size == RING {
            found.extend(self.neighbours.of_corner(corner));
            return found;
        }
        visited.clear();
        visited.visit(corner);
        let mut at = 0;
        while at < found.len() && found.len() < size {
            let beside = self.neighbours.of_corner(found[at]).iter();
            found.extend(beside.filter(|&&n| is_free[n as usize] && visited.visit(n)));
            at += 1;
        }
        found.truncate(size);
        found
    }

    /// Returns the plane of some corners.
    pub fn fit(&self, of: &[u32]) -> Option<PlaneEstimate> {
        let mut sums = PointSums::about(self.at[*of.first()? as usize]);
        of.iter().for_each(|&v| sums.add(self.at[v as usize]));
        sums.fit(self.inside)
    }

    /// Returns whether no more corners lie beyond a plane by more than `near` and the plane's own error than tails of the noise explain.
    /// No corner lies beyond a facet of a convex solid.
    pub fn is_outermost(&self, fit: &PlaneEstimate, near: f64) -> bool {
        let most = BEYOND_ALWAYS + (BEYOND * fit.count as f64) as usize;
        let is_beyond = |distance: f64, at: DVec3| distance > near * (1.0 + fit.leverage(at)).sqrt();
        let beyond = self.at.iter().filter(|&&v| {
            let distance = fit.plane.distance(v);
            distance > near && is_beyond(distance, v)
        });
        beyond.take(most + 1).count() <= most
    }

    /// Returns patches of `size` corners that are free, the flattest first.
    pub fn patches(&self, size: usize, is_free: &[bool]) -> Vec<Patch> {
        let free: Vec<u32> = (0..self.at.len() as u32).filter(|&v| is_free[v as usize]).collect();
        let step = free.len().div_ceil(MOST_PATCHES).max(1);
        let chosen: Vec<u32> = free.into_iter().step_by(step).collect();
        let patch = |visited: &mut Visited, &corner: &u32| {
            let fit = self.fit(&self.around(corner, size, is_free, visited))?;
            Some(Patch { corner, fit })
        };
        let found = chosen.par_iter().map_init(|| Visited::of(self.at.len()), patch);
        let mut patches: Vec<Patch> = found.flatten_iter().collect();
        patches.sort_by(|a, b| a.fit.variance().total_cmp(&b.fit.variance()).then(a.corner.cmp(&b.corner)));
        patches
    }

    /// Returns the standard deviation of the noise, from patches that are as large as this noise needs; `None` where there
    /// are none.
    pub fn noise(&self) -> Option<f64> {
        let everywhere = vec![true; self.at.len()];
        let near = noise(&self.patches(RING, &everywhere))?.max(self.least_noise);
        match self.sizes(near)[0] {
            NARROW => Some(near),
            size => Some(near.max(noise(&self.patches(size, &everywhere))?)),
        }
    }

    /// Returns the sizes of patches for noise of a standard deviation, the largest first. The largest lean little, the small
    /// ones fit into narrow facets.
    pub fn sizes(&self, noise: f64) -> Vec<usize> {
        let enough = (PER_NOISE * noise / self.spacing) as usize;
        let largest = enough.clamp(NARROW, MOST).min((self.at.len() / PATCHES).max(NARROW));
        let halves = std::iter::successors(Some(largest), |size| Some(size / 2));
        halves.take_while(|&size| size > NARROW).chain([NARROW, RING]).collect()
    }
}

/// Returns the standard deviation of the noise that patches show, the flattest of which are first; `None` without patches.
fn noise(patches: &[Patch]) -> Option<f64> {
    let flat = patches.get((FLAT * patches.len() as f64) as usize)?;
    let freedom = flat.fit.freedom().max(1) as f64;
    // The quantile of χ² divided by its mean (E. B. Wilson and M. M. Hilferty, 1931).
    let part = 2.0 / (9.0 * freedom);
    let quantile = (1.0 - part + FLAT_QUANTILE * part.sqrt()).powi(3);
    Some((flat.fit.variance() / quantile).sqrt())
}
