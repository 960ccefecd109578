//! Planes of facets so narrow that all their corners lie on their edges, and so on their neighbours as well.
//!
//! Without such a facet, its neighbours meet outside of the scan, and its triangles lie deep below the solid between them.

use super::growth::NEAR;
use super::patches::ScanCorners;
use super::points::{PlaneEstimate, PointSums};
use crate::Plane;
use std::collections::{HashMap, HashSet};

/// The fewest corners of such a facet: three lie in one plane wherever they are.
const LEAST: usize = 4;

/// Returns the planes of the facets that triangles show which lie deep below a solid. `noise` is the standard deviation of the noise.
pub(super) fn planes(corners: &ScanCorners, deep: &[u32], noise: f64) -> Vec<Plane> {
    let mut left = Left::of(corners, deep);
    let area = |t: &u32| {
        let [a, b, c] = corners.triangles[*t as usize].map(|v| corners.at[v as usize]);
        (b - a).cross(c - a).length()
    };
    let mut seeds: Vec<u32> = deep.to_vec();
    seeds.sort_by(|a, b| area(b).total_cmp(&area(a)).then(a.cmp(b)));
    let grown = seeds.into_iter().filter_map(|seed| left.grow(seed, noise));
    let is_facet = |fit: &PlaneEstimate| fit.count >= LEAST && corners.is_outermost(fit, NEAR * noise);
    grown.filter(is_facet).map(|fit| fit.plane).collect()
}

/// The triangles that no region has yet.
struct Left<'a> {
    corners: &'a ScanCorners<'a>,
    /// The triangles beside each side.
    beside: HashMap<[u32; 2], Vec<u32>>,
    free: HashSet<u32>,
}

impl<'a> Left<'a> {
    fn of(corners: &'a ScanCorners<'a>, deep: &[u32]) -> Self {
        let mut beside: HashMap<[u32; 2], Vec<u32>> = HashMap::new();
        for &t in deep {
            sides(corners, t).into_iter().for_each(|side| beside.entry(side).or_default().push(t));
        }
        Self { corners, beside, free: deep.iter().copied().collect() }
    }

    /// Returns the plane of the triangles around one that lie in its plane except for noise, which are no longer free then; `None` where
    /// the triangle is not free or has no plane.
    fn grow(&mut self, seed: u32, noise: f64) -> Option<PlaneEstimate> {
        self.free.remove(&seed).then_some(())?;
        let first = self.corners.triangles[seed as usize];
        let mut known: HashSet<u32> = first.into_iter().collect();
        let mut sums = PointSums::about(self.corners.at[first[0] as usize]);
        first.iter().for_each(|&v| sums.add(self.corners.at[v as usize]));
        let mut fit = sums.fit(self.corners.inside)?;
        let mut region = vec![seed];
        let mut at = 0;
        while at < region.len() {
            for t in sides(self.corners, region[at]).into_iter().flat_map(|side| self.beside[&side].clone()) {
                let new: Vec<u32> =
                    self.corners.triangles[t as usize].into_iter().filter(|v| !known.contains(v)).collect();
                let is_near = |v: &u32| {
                    let at = self.corners.at[*v as usize];
                    // The plane of few corners is not known better than these.
                    fit.plane.distance(at).abs() <= NEAR * noise * (1.0 + fit.leverage(at)).sqrt()
                };
                if self.free.contains(&t) && new.iter().all(is_near) {
                    self.free.remove(&t);
                    new.iter().for_each(|&v| sums.add(self.corners.at[v as usize]));
                    known.extend(new);
                    fit = sums.fit(self.corners.inside)?;
                    region.push(t);
                }
            }
            at += 1;
        }
        Some(fit)
    }
}

/// Returns the sides of a triangle, the lower corner first.
fn sides(corners: &ScanCorners, triangle: u32) -> [[u32; 2]; 3] {
    let t = corners.triangles[triangle as usize];
    [0, 1, 2].map(|k| {
        let (a, b) = (t[k], t[(k + 1) % 3]);
        [a.min(b), a.max(b)]
    })
}
