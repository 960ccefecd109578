//! The corners of a scan that lie on each facet of a solid, without regard to their noise.
//!
//! A corner is judged by its place along the facet, not by its distance from it, so that its noise is not selected: the mean
//! distance of the corners that noise moves beyond both planes of an edge is not 0. Corners so near to an edge that noise
//! hides on which side they belong are left out. Where the scan has corners on the edges, as a divided model has, they count
//! for both facets. Where facets lean little from each other, the errors of their planes move the edge between them far: what lies
//! within these errors of it counts for neither, so that no plane follows corners of its neighbour.

use super::patches::ScanCorners;
use super::points::{PlaneEstimate, PointSums};
use crate::faceting::deviation::outermost;
use crate::{Plane, Polytope};
use glam::DVec3;
use rayon::prelude::*;

/// Corners within this many standard deviations of an edge may belong to either facet.
const BORDER: f64 = 4.0;

/// A corner farther from its plane than this many standard deviations does not lie on the facet.
pub(super) const OUTLIER: f64 = 6.0;

/// What lies within this many standard errors of an edge may belong to either facet.
const UNSURE: f64 = 3.0;

/// The fewest corners that are left to a facet where those near its edges are left out; a facet with fewer keeps them all.
const LEAST_LEFT: usize = 16;

/// Corners lie on the edges of the stone where their number near the edges is this many times what an even spread gives.
const CROWDED: f64 = 2.0;

/// They lie at the corners of the stone as well, at more than this part of them: where there is no noise, an even spread gives none, and a
/// few lie on an edge by chance.
const PART: f64 = 0.5;

/// Corners can be told from those on the edges where their distance is this many standard deviations of the noise.
const APART: f64 = 8.0;

/// An edge of a facet, in the plane of the facet.
struct Border {
    /// The direction out of the facet, along its plane.
    outward: DVec3,
    offset: f64,
}

/// The facets of a solid, with their borders.
struct Outlined {
    plane: Plane,
    noise: f64,
    borders: Vec<Border>,
}

impl Outlined {
    /// Returns whether a point lies on the facet's plane except for noise.
    fn is_near(&self, point: DVec3) -> bool {
        self.plane.distance(point).abs() <= OUTLIER * self.noise
    }

    /// Returns how far a point lies beyond the outline, along the plane; negative inside.
    fn beyond(&self, point: DVec3) -> f64 {
        let foot = point - self.plane.distance(point) * self.plane.normal;
        self.borders.iter().map(|b| b.outward.dot(foot) - b.offset).fold(f64::NEG_INFINITY, f64::max)
    }
}

/// The corners of each facet.
pub(super) struct Members {
    /// The corners whose noise about a facet is known, of each facet.
    pub of: Vec<Vec<u32>>,
    /// Whether each corner, and each triangle beside it, lies on the solid except for noise.
    pub explained: Vec<bool>,
    /// The greatest distance of a corner from the solid's surface.
    pub deviation: f64,
    /// Whether the scan has corners on the edges of the solid, so that its triangles lie on one facet each.
    pub are_shared: bool,
    /// The triangles that lie deeper below the solid than noise explains, by their places; none where triangles may lie across edges.
    pub deep: Vec<u32>,
}

impl Members {
    /// Finds the corners of each facet of a solid, for noise with these standard deviations about the facets' planes.
    pub fn of(corners: &ScanCorners, solid: &Polytope, noises: &[f64]) -> Self {
        let facets = outlined(solid, noises);
        let planes: Vec<Plane> = solid.planes().collect();
        let lies: Vec<(usize, f64)> = corners.at.par_iter().map(|&v| outermost(&planes, v)).collect();
        let are_shared = has_corners_on_edges(corners, solid, &facets, &lies);
        let middles = if are_shared { middles(corners, &planes) } else { vec![] };
        let of = if are_shared {
            of_triangles(corners, &facets, solid, &middles)
        } else {
            within(corners, &facets, solid, &lies)
        };
        let mut explained: Vec<bool> =
            lies.iter().map(|&(f, d)| d.abs() <= OUTLIER * facets[f].noise).collect();
        let deep = deep_triangles(&middles, &facets);
        deep.iter().flat_map(|&t| corners.triangles[t as usize]).for_each(|v| explained[v as usize] = false);
        let deviation = lies.iter().map(|(_, d)| d.abs()).fold(0.0, f64::max);
        Self { of, explained, deviation, are_shared, deep }
    }

    /// Returns the sums over the corners of each facet.
    pub fn sums(&self, corners: &ScanCorners) -> Vec<PointSums> {
        self.of.par_iter().map(|of| sums(corners, of)).collect()
    }
}

fn sums(corners: &ScanCorners, of: &[u32]) -> PointSums {
    let mut sums = PointSums::about(of.first().map_or(corners.inside, |&v| corners.at[v as usize]));
    of.iter().for_each(|&v| sums.add(corners.at[v as usize]));
    sums
}

/// The middle of a triangle, and how it lies.
struct Middle {
    at: DVec3,
    /// The facet that it is farthest outside of.
    facet: usize,
    /// Its distance from the plane of that facet.
    distance: f64,
}

/// Returns the middles of all triangles.
fn middles(corners: &ScanCorners, planes: &[Plane]) -> Vec<Middle> {
    let middle = |t: &[u32; 3]| {
        let at = t.iter().map(|&v| corners.at[v as usize]).sum::<DVec3>() / 3.0;
        let (facet, distance) = outermost(planes, at);
        Middle { at, facet, distance }
    };
    corners.triangles.par_iter().map(middle).collect()
}

/// Returns the corners of the triangles that lie on each facet, where triangles lie on one facet each.
fn of_triangles(
    corners: &ScanCorners,
    facets: &[Outlined],
    solid: &Polytope,
    middles: &[Middle],
) -> Vec<Vec<u32>> {
    let gathered = |is_sure: &[bool]| {
        let mut of = vec![vec![]; facets.len()];
        for ((&Middle { facet: f, .. }, t), _) in
            middles.iter().zip(corners.triangles).zip(is_sure).filter(|(_, sure)| **sure)
        {
            of[f].extend(t.iter().filter(|&&v| facets[f].is_near(corners.at[v as usize])));
        }
        of.par_iter_mut().for_each(|of: &mut Vec<u32>| {
            of.sort_unstable();
            of.dedup();
        });
        of
    };
    let all = gathered(&vec![true; middles.len()]);
    let edges = UnsureEdges::of(corners, solid, facets, &all);
    let is_sure: Vec<bool> =
        middles.par_iter().map(|middle| edges.is_sure(middle.at, middle.facet)).collect();
    left(all, gathered(&is_sure))
}

/// Returns the corners within each facet. `lies` holds the facet that each corner is farthest outside of.
fn within(
    corners: &ScanCorners,
    facets: &[Outlined],
    solid: &Polytope,
    lies: &[(usize, f64)],
) -> Vec<Vec<u32>> {
    let mut all = vec![vec![]; facets.len()];
    for (v, &(f, _)) in (0..).zip(lies) {
        let (facet, at) = (&facets[f], corners.at[v as usize]);
        if facet.is_near(at) && facet.beyond(at) <= -BORDER * facet.noise {
            all[f].push(v);
        }
    }
    let edges = UnsureEdges::of(corners, solid, facets, &all);
    let sure = |(f, of): (usize, &Vec<u32>)| {
        of.iter().copied().filter(|&v| edges.is_sure(corners.at[v as usize], f)).collect()
    };
    let sure = all.par_iter().enumerate().map(sure).collect();
    left(all, sure)
}

/// Returns the corners that certainly lie on each facet, and all for facets to which few would be left.
fn left(all: Vec<Vec<u32>>, sure: Vec<Vec<u32>>) -> Vec<Vec<u32>> {
    all.into_iter().zip(sure).map(|(all, sure)| if sure.len() < LEAST_LEFT { all } else { sure }).collect()
}

/// The edges of a solid whose places are known as well as the planes beside them.
struct UnsureEdges<'a> {
    solid: &'a Polytope,
    facets: &'a [Outlined],
    fits: Vec<Option<PlaneEstimate>>,
}

impl<'a> UnsureEdges<'a> {
    /// Takes the standard errors of the planes from the corners `of` the facets.
    fn of(corners: &ScanCorners, solid: &'a Polytope, facets: &'a [Outlined], of: &[Vec<u32>]) -> Self {
        let fits = of.par_iter().map(|of| sums(corners, of).fit(corners.inside)).collect();
        Self { solid, facets, fits }
    }

    /// Returns the variance of a facet's plane at a point; 0 where it is not known.
    fn variance(&self, facet: usize, point: DVec3) -> f64 {
        self.fits[facet].as_ref().map_or(0.0, |fit| self.facets[facet].noise.powi(2) * fit.leverage(point))
    }

    /// Returns whether a point that lies on a facet lies certainly not on a neighbour. The noise of the point itself moves it off
    /// both planes alike.
    fn is_sure(&self, point: DVec3, facet: usize) -> bool {
        let own = &self.solid.facets()[facet];
        let (distance, variance) = (own.plane.distance(point), self.variance(facet, point));
        own.neighbours.iter().map(|&n| n as usize).all(|n| {
            let apart = distance - self.solid.facets()[n].plane.distance(point);
            apart > 0.0 && apart * apart >= UNSURE * UNSURE * (variance + self.variance(n, point))
        })
    }
}

/// Returns the triangles that lie deeper below a solid than noise explains: all corners of a narrow facet may lie on its edges, and
/// so on its neighbours, but the triangles between them do not.
///
/// The noise of a triangle's middle is less than that of its corners, by a part that depends on their correlation.
fn deep_triangles(middles: &[Middle], facets: &[Outlined]) -> Vec<u32> {
    // Planes that fit without any noise leave only rounding.
    let depth = |middle: &Middle| middle.distance / facets[middle.facet].noise.max(f64::MIN_POSITIVE);
    let depths: Vec<f64> = middles.iter().map(depth).collect();
    let noise = median(depths.iter().map(|d| d.abs()).collect()) / MEDIAN;
    (0..).zip(&depths).filter(|(_, depth)| **depth < -OUTLIER * noise.min(1.0)).map(|(t, _)| t).collect()
}

/// The median of the size of a number that is distributed normally, in standard deviations.
const MEDIAN: f64 = 0.674_489_75;

/// Returns the median; 0 of no numbers.
fn median(mut sizes: Vec<f64>) -> f64 {
    let middle = sizes.len() / 2;
    if sizes.is_empty() { 0.0 } else { *sizes.select_nth_unstable_by(middle, f64::total_cmp).1 }
}

fn outlined(solid: &Polytope, noises: &[f64]) -> Vec<Outlined> {
    let facet = |(f, &noise): (&crate::Facet, &f64)| {
        let at: Vec<DVec3> = solid.corners(f).collect();
        let border = |k: usize| {
            let (from, to) = (at[k], at[(k + 1) % at.len()]);
            let outward = (to - from).cross(f.plane.normal).try_normalize()?;
            Some(Border { outward, offset: outward.dot(from) })
        };
        Outlined { plane: f.plane, noise, borders: (0..at.len()).filter_map(border).collect() }
    };
    solid.facets().iter().zip(noises).map(facet).collect()
}

/// Returns whether the scan has corners on the edges of the stone, which can be told from others.
fn has_corners_on_edges(
    corners: &ScanCorners,
    solid: &Polytope,
    facets: &[Outlined],
    lies: &[(usize, f64)],
) -> bool {
    // Not the greatest: planes that are still wrong leave much more than noise.
    let mut noises: Vec<f64> = facets.iter().map(|f| f.noise).collect();
    noises.sort_by(f64::total_cmp);
    let noise = noises[noises.len() / 2];
    if corners.spacing < APART * noise {
        return false;
    }
    let near = lies
        .iter()
        .zip(corners.at)
        .filter(|((f, _), v)| facets[*f].beyond(**v).abs() <= BORDER * noise)
        .count();
    let around: f64 = solid
        .facets()
        .iter()
        .map(|f| {
            let at: Vec<DVec3> = solid.corners(f).collect();
            (0..at.len()).map(|k| at[k].distance(at[(k + 1) % at.len()])).sum::<f64>()
        })
        .sum();
    let even = corners.at.len() as f64 * around * BORDER * noise / solid.surface_area();
    near as f64 > CROWDED * even + PART * solid.vertices().len() as f64
}

/// Returns the standard deviation of the noise about each plane: from the median of its own corners' distances where these
/// are many and deviate more than most, and otherwise from the median of all.
pub(super) fn noises(corners: &ScanCorners, members: &Members, fits: &[PlaneEstimate]) -> Vec<f64> {
    /// A median of fewer corners is too uncertain.
    const MANY: usize = 30;
    let sizes = |(fit, members): (&PlaneEstimate, &Vec<u32>)| -> Vec<f64> {
        members.iter().map(|&v| fit.plane.distance(corners.at[v as usize]).abs()).collect()
    };
    let each: Vec<Vec<f64>> = fits.par_iter().zip(&members.of).map(sizes).collect();
    let freedom = |sizes: &Vec<f64>| (sizes.len() as f64 / (sizes.len() as f64 - 3.0).max(0.5)).sqrt();
    let scaled = each.iter().filter(|sizes| sizes.len() > 3);
    let common = median(scaled.flat_map(|sizes| sizes.iter().map(|d| d * freedom(sizes))).collect()) / MEDIAN;
    let common = common.max(corners.least_noise);
    let own =
        |sizes: Vec<f64>| if sizes.len() < MANY { common } else { (median(sizes) / MEDIAN).max(common) };
    each.into_par_iter().map(own).collect()
}
