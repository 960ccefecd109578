//! The steps to which a scan's coordinates were rounded.
//!
//! Rounding adds noise with a variance of a twelfth of the squared step. Where a facet is square to an axis, all its corners
//! are rounded alike, and the error of their mean does not shrink with their number.

use super::points::PlaneEstimate;
use glam::DVec3;
use std::f64::consts::PI;

/// Coordinates are multiples of a step where they are off by less than this part of it.
const MULTIPLE: f64 = 0.02;

/// Returns the steps to which the coordinates were rounded, along each axis; 0 where none is found.
pub(super) fn steps(at: &[DVec3]) -> DVec3 {
    DVec3::from_array([0, 1, 2].map(|axis| step(at.iter().map(|v| v[axis]).collect())))
}

fn step(mut all: Vec<f64>) -> f64 {
    all.sort_by(f64::total_cmp);
    let span = all.last().copied().unwrap_or_default() - all.first().copied().unwrap_or_default();
    // Numbers of 32 bits differ by less where they are the same in decimals.
    let digits = 2.0 * f64::from(f32::EPSILON) * all.iter().map(|x| x.abs()).fold(span, f64::max);
    let gaps = || all.windows(2).map(|w| w[1] - w[0]).filter(|gap| *gap > 4.0 * digits);
    let least = gaps().fold(f64::INFINITY, f64::min);
    let near = |gap: f64| (gap / least - (gap / least).round()).abs() * least <= MULTIPLE * least + digits;
    if least.is_finite() && digits < MULTIPLE * least && gaps().all(near) { least } else { 0.0 }
}

/// The part of the variance of rounding with which rows that are rounded alike may bend a facet.
const BENDING: f64 = 0.25;

/// Returns the variance that rounding to `steps` adds to the distances from a facet.
pub(super) fn variance(steps: DVec3, normal: DVec3) -> f64 {
    (normal * steps).length_squared() / 12.0
}

/// Returns by how much a bend that rounding alone makes may lower the sum of squared distances from a plane.
pub(super) fn bending(steps: DVec3, fit: &PlaneEstimate) -> f64 {
    BENDING * fit.count as f64 * variance(steps, fit.plane.normal)
}

/// Corners of a facet are rounded alike where this many times as many as an even spread gives have the same coordinate: rows of
/// corners along a level edge.
const CROWDED: f64 = 2.0;

/// Corners of a facet that lie within so few steps are rounded alike: the parts of a step where they lie do not average out.
const FEW_STEPS: f64 = 3.0;

/// The variances that a plane has because corners are rounded alike.
#[derive(Default)]
pub(super) struct Alike {
    /// That of the distance.
    pub distance: f64,
    /// Those of the tilts toward the facet's axes.
    pub tilts: [f64; 2],
}

/// Returns the variances that a facet's plane has because `steps` round some of its corners alike. `noise` is the standard deviation
/// before rounding.
///
/// Noise s before the rounding to steps q leaves e^(-4 π² s²/q²) of the variance q²/12 to what the true place decides (B. Widrow,
/// 1956). Corners with the same coordinate share its error if they lie in a row, and have independent ones if they are spread evenly.
pub(super) fn alike(steps: DVec3, fit: &PlaneEstimate, of: &[DVec3], noise: f64) -> Alike {
    let mut sum = Alike::default();
    for axis in (0..3).filter(|&axis| steps[axis] > 0.0) {
        let q = steps[axis];
        let left = (-4.0 * PI * PI * (noise / q).powi(2)).exp();
        let one = fit.plane.normal[axis].powi(2) * q * q / 12.0 * left;
        let mut sorted: Vec<DVec3> = of.to_vec();
        sorted.sort_by(|a, b| a[axis].total_cmp(&b[axis]));
        let taken = sorted
            .last()
            .zip(sorted.first())
            .map_or(0.0, |(last, first)| (last[axis] - first[axis]) / q + 1.0);
        let even = of.len() as f64 / taken;
        let rows = sorted.chunk_by(|a, b| b[axis] - a[axis] < 0.5 * q);
        for row in rows.filter(|row| taken <= FEW_STEPS || row.len() as f64 > CROWDED * even + 1.0) {
            let moment = |k: usize| row.iter().map(|at| (*at - fit.middle).dot(fit.axes[k])).sum::<f64>();
            sum.distance += one * (row.len() as f64 / of.len() as f64).powi(2);
            (0..2).for_each(|k| sum.tilts[k] += one * (moment(k) / fit.moments[k]).powi(2));
        }
    }
    sum
}
