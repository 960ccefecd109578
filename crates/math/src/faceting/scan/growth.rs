//! Grows patches to regions that share a plane, whose planes no corner lies beyond.

use super::patches::{Patch, ScanCorners, Visited};
use super::points::PlaneEstimate;

/// Corners within this many standard deviations of the noise of a plane may lie on it.
pub(super) const NEAR: f64 = 4.5;

/// The least number of corners of a region.
const LEAST: usize = 6;

/// The plane is fitted again whenever a region has grown by this factor.
const GROWN: f64 = 1.5;

/// The number of times that a region is gathered again from its improved plane.
const ROUNDS: usize = 3;

/// A patch whose variance is above that of the noise by more than this many of its own standard deviations lies across
/// an edge.
const ACROSS: f64 = 6.0;

/// The mark of a corner that no region has.
const FREE: u8 = 0;
/// The mark of a corner of a region.
const TAKEN: u8 = 1;
/// The mark of a corner of a region that is no facet.
const REFUSED: u8 = 2;

/// Returns planes of facets for noise of this standard deviation. Corners whose `is_explained` is true lie on facets that are
/// known, so that no region begins there. `None` where there are more than `most`.
pub(super) fn grown(
    corners: &ScanCorners,
    noise: f64,
    is_explained: &[bool],
    most: usize,
) -> Option<Vec<PlaneEstimate>> {
    let marks = is_explained.iter().map(|&known| if known { TAKEN } else { FREE }).collect();
    let mut grower = Grower { corners, noise, marks, visited: Visited::of(corners.at.len()), found: vec![] };
    for size in corners.sizes(noise) {
        let is_free: Vec<bool> = grower.marks.iter().map(|&mark| mark != TAKEN).collect();
        grower.marks.iter_mut().filter(|mark| **mark == REFUSED).for_each(|mark| *mark = FREE);
        for patch in corners.patches(size, &is_free) {
            grower.try_patch(&patch);
            if grower.found.len() > most {
                return None;
            }
        }
    }
    Some(grower.found)
}

struct Grower<'a> {
    corners: &'a ScanCorners<'a>,
    noise: f64,
    marks: Vec<u8>,
    visited: Visited,
    found: Vec<PlaneEstimate>,
}

impl Grower<'_> {
    /// Grows a patch to a region, unless it lies across an edge, and keeps the region's plane if that may be a facet.
    fn try_patch(&mut self, patch: &Patch) {
        let freedom = patch.fit.freedom() as f64;
        let excess = (patch.fit.variance() / self.noise.powi(2) - 1.0) * (freedom / 2.0).sqrt();
        if self.marks[patch.corner as usize] != FREE || excess > ACROSS {
            return;
        }
        let (region, fit) = self.region(patch);
        let kept =
            fit.filter(|fit| region.len() >= LEAST && self.corners.is_outermost(fit, NEAR * self.noise));
        let mark = if kept.is_some() { TAKEN } else { REFUSED };
        for &v in region.iter().chain([&patch.corner]) {
            let known = &mut self.marks[v as usize];
            *known = if *known == TAKEN { TAKEN } else { mark };
        }
        self.found.extend(kept);
    }

    /// Returns whether a point lies on a plane except for noise.
    fn is_near(&self, fit: &PlaneEstimate, corner: u32) -> bool {
        fit.plane.distance(self.corners.at[corner as usize]).abs() <= NEAR * self.noise
    }

    /// Returns the region around a patch, and its plane.
    fn region(&mut self, patch: &Patch) -> (Vec<u32>, Option<PlaneEstimate>) {
        let mut fit = patch.fit;
        let mut region = self.flood(patch.corner, &mut fit, true);
        for _ in 1..ROUNDS {
            let Some(next) = self.corners.fit(&region) else { return (region, None) };
            fit = next;
            let again = self.flood(patch.corner, &mut fit, false);
            let is_settled = again.len() == region.len();
            region = again;
            if is_settled {
                break;
            }
        }
        let fit = self.corners.fit(&region);
        (region, fit)
    }

    /// Returns connected corners near to a plane. A region that was found before is entered by one corner, since its border
    /// may lie on both. If `follows` is true, the plane is fitted again while the region grows.
    fn flood(&mut self, seed: u32, fit: &mut PlaneEstimate, follows: bool) -> Vec<u32> {
        self.visited.clear();
        self.visited.visit(seed);
        let mut found = vec![seed];
        let (mut at, mut next_fit) = (0, GROWN * fit.count as f64);
        while at < found.len() {
            let corner = found[at];
            at += 1;
            if self.marks[corner as usize] == TAKEN {
                continue;
            }
            for &n in self.corners.neighbours.of_corner(corner) {
                if self.visited.visit(n) && self.is_near(fit, n) {
                    found.push(n);
                }
            }
            if follows && found.len() as f64 >= next_fit {
                next_fit = GROWN * found.len() as f64;
                *fit = self.corners.fit(&found).unwrap_or(*fit);
            }
        }
        found
    }
}
