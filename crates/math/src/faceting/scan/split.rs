//! Divides facets that two planes fit far better than one.

use super::growth::NEAR;
use super::members::Members;
use super::patches::ScanCorners;
use super::points::{PlaneEstimate, PointSums};
use super::rounding::bending;
use crate::Plane;
use glam::DVec3;
use rayon::prelude::*;

/// A facet is divided where the squared distances from one plane exceed those from two by more than this many variances of the
/// noise, and by 3 ln n for n corners. It is more than [`merge`](super::merge) joins, so that facets are not divided and joined in
/// turn.
const EXCESS: f64 = 40.0;

/// The number of directions in which a facet is divided, and of places along each.
const DIRECTIONS: u32 = 12;
const PLACES: usize = 16;

/// The least number of corners of a part.
const LEAST: usize = 6;

/// Returns the planes of the two parts of each facet that is divided. `inflation` is that of the noise's variance by its
/// correlation.
pub(super) fn split(
    corners: &ScanCorners,
    members: &Members,
    fits: &[PlaneEstimate],
    inflation: f64,
) -> Vec<Option<[Plane; 2]>> {
    members.of.par_iter().zip(fits).map(|(of, fit)| parts(corners, of, fit, inflation)).collect()
}

/// The two parts of a facet that is divided.
struct Parts {
    /// The fall of the squared distances besides what rounding explains, in variances of the noise.
    excess: f64,
    /// The variance of the noise.
    variance: f64,
    fits: [PlaneEstimate; 2],
}

/// Returns the planes of the two parts into which a facet is divided best; `None` where one plane fits as well.
fn parts(corners: &ScanCorners, of: &[u32], fit: &PlaneEstimate, inflation: f64) -> Option<[Plane; 2]> {
    let best = (0..DIRECTIONS).filter_map(|k| {
        let turn = f64::from(k) / f64::from(DIRECTIONS) * std::f64::consts::PI;
        along(corners, of, fit, fit.axes[0] * turn.cos() + fit.axes[1] * turn.sin())
    });
    let best = best.max_by(|a, b| a.excess.total_cmp(&b.excess))?;
    let is_better = best.excess / inflation > EXCESS + 3.0 * (of.len() as f64).ln();
    let near = NEAR * best.variance.sqrt();
    let are_facets = || best.fits.iter().all(|fit| corners.is_outermost(fit, near));
    (is_better && are_facets()).then(|| best.fits.map(|fit| fit.plane))
}

/// Divides a facet across a direction at the best place.
fn along(corners: &ScanCorners, of: &[u32], fit: &PlaneEstimate, direction: DVec3) -> Option<Parts> {
    let parts = Chunks::along(corners, of.to_vec(), fit.middle, direction);
    let divided = (1..parts.sums.len()).filter_map(|place| {
        let (one, other) = (parts.fit(..place)?, parts.fit(place..)?);
        let rest = one.squares + other.squares;
        let variance = rest / (of.len() as f64 - 6.0);
        let excess = (fit.squares - rest - bending(corners.steps, fit)) / variance;
        is_convex(&one, &other).then_some(Parts { excess, variance, fits: [one, other] })
    });
    divided.max_by(|a, b| a.excess.total_cmp(&b.excess))
}

/// Returns whether both planes lie over the other part, so that the edge between bends outward.
fn is_convex(one: &PlaneEstimate, other: &PlaneEstimate) -> bool {
    one.plane.distance(other.middle) < 0.0 && other.plane.distance(one.middle) < 0.0
}

/// Sums over corners by their place along a direction.
struct Chunks<'a> {
    corners: &'a ScanCorners<'a>,
    sums: Vec<PointSums>,
}

impl<'a> Chunks<'a> {
    fn along(corners: &'a ScanCorners<'a>, mut of: Vec<u32>, origin: DVec3, direction: DVec3) -> Self {
        let place = |v: u32| corners.at[v as usize].dot(direction);
        of.sort_by(|&a, &b| place(a).total_cmp(&place(b)).then(a.cmp(&b)));
        let sums = of.chunks(of.len().div_ceil(PLACES).max(1)).map(|chunk| {
            let mut sums = PointSums::about(origin);
            chunk.iter().for_each(|&v| sums.add(corners.at[v as usize]));
            sums
        });
        Self { corners, sums: sums.collect() }
    }

    /// Returns the plane of some chunks; `None` where they have too few corners.
    fn fit(
        &self,
        of: impl std::slice::SliceIndex<[PointSums], Output = [PointSums]>,
    ) -> Option<PlaneEstimate> {
        let (first, rest) = self.sums[of].split_first()?;
        let sums = rest.iter().fold(*first, |sum, part| sum.with(part));
        sums.fit(self.corners.inside).filter(|_| sums.count >= LEAST)
    }
}
