//! The steps to which a scan's coordinates were rounded.
//!
//! Rounding adds noise with a variance of a twelfth of the squared step. Where a facet is square to an axis, all its corners
//! are rounded alike, and the error of their mean does not shrink with their number.

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

/// Returns the additional variance of a facet's distance, and of that of each of its corners for its tilts, where `steps`
/// round corners of a facet alike. `normal` is the facet's, `reach` its extent along each axis, `count` its number of corners
/// and `noise` the standard deviation before rounding.
///
/// Noise s before the rounding to steps q leaves e^(-4 π² s²/q²) of the variance q²/12 to what the true place decides (B. Widrow,
/// 1956).
pub(super) fn alike(steps: DVec3, normal: DVec3, reach: DVec3, noise: f64, count: f64) -> f64 {
    let one = |axis: usize| {
        let q = steps[axis];
        if q == 0.0 {
            return 0.0;
        }
        let left = (-4.0 * PI * PI * (noise / q).powi(2)).exp();
        // Corners in different steps are rounded independently.
        let independent = (1.0 + reach[axis] / q).min(count);
        normal[axis].powi(2) * q * q / 12.0 * left / independent
    };
    (0..3).map(one).sum()
}
