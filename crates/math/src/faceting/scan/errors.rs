//! The standard errors of fitted planes: from the noise about each plane, its correlation, and rounding.

use super::members::Members;
use super::patches::ScanCorners;
use super::points::PlaneEstimate;
use super::rounding;
use crate::faceting::plane_error::PlaneError;
use crate::solved;
use glam::{DMat3, DVec3};

/// The weight of the variance that all facets give for the direction of a facet beside that of its own corners, in corners.
const COMMON: f64 = 20.0;

/// The least part of the mean variance that is taken for any direction.
const LEAST: f64 = 0.02;

/// The least part of a facet's noise that is taken to be left after the fit.
const MOST_FOLLOWED: f64 = 0.3;

/// Returns the variance of the noise about each plane.
///
/// The noise of a scanner depends on the direction. So a facet's own corners and what all facets tell of its direction are
/// averaged. No variance is below that of the `least` noise.
pub(super) fn variances(fits: &[PlaneEstimate], least: f64) -> Vec<f64> {
    let freedom: f64 = fits.iter().map(|fit| fit.freedom() as f64).sum();
    let mean = fits.iter().map(|fit| fit.squares).sum::<f64>() / freedom.max(1.0);
    let noise = by_direction(fits, mean);
    let each = |fit: &PlaneEstimate| {
        let normal = fit.plane.normal;
        let common = normal.dot(noise * normal).max(LEAST * mean);
        ((fit.squares + COMMON * common) / (fit.freedom() as f64 + COMMON)).max(least * least)
    };
    fits.iter().map(each).collect()
}

/// Returns the covariance matrix of the corners' noise that fits the variances about all planes best, near to the same
/// `mean` in all directions where the facets do not tell.
fn by_direction(fits: &[PlaneEstimate], mean: f64) -> DMat3 {
    let mut matrix = [[0.0; 7]; 6];
    for (k, row) in matrix.iter_mut().enumerate() {
        // One corner's worth of a belief that the directions are alike.
        row[k] = 1.0;
    }
    for fit in fits.iter().filter(|fit| fit.freedom() > 0) {
        let n = fit.plane.normal;
        let terms = [n.x * n.x, n.y * n.y, n.z * n.z, 2.0 * n.x * n.y, 2.0 * n.x * n.z, 2.0 * n.y * n.z];
        let weight = fit.freedom() as f64;
        for i in 0..6 {
            for j in 0..6 {
                matrix[i][j] += weight * terms[i] * terms[j];
            }
            matrix[i][6] += weight * terms[i] * (fit.variance() - mean);
        }
    }
    let [x, y, z, xy, xz, yz] = solved(matrix);
    DMat3::from_cols(DVec3::new(x, xy, xz), DVec3::new(xy, y, yz), DVec3::new(xz, yz, z))
        + DMat3::from_diagonal(DVec3::splat(mean))
}

/// Returns the standard errors of all planes. `inflation` is that of the noise's variance by its correlation.
pub(super) fn errors(
    corners: &ScanCorners,
    members: &Members,
    fits: &[PlaneEstimate],
    inflation: f64,
) -> Vec<PlaneError> {
    let each = |((fit, variance), of): ((&PlaneEstimate, f64), &Vec<u32>)| {
        let at: Vec<DVec3> = of.iter().map(|&v| corners.at[v as usize]).collect();
        let count = fit.count as f64;
        // What rounding added to the noise is left out.
        let own = rounding::variance(corners.steps, fit.plane.normal);
        let alike = rounding::alike(corners.steps, fit, &at, (variance - own).max(0.0).sqrt());
        // A fit follows correlated noise more, so that less of it is left.
        let left = (count - 3.0).max(1.0) / (count - 3.0 * inflation).max(MOST_FOLLOWED * count).max(1.0);
        let one = variance * inflation * left.max(1.0);
        let tilt = |k: usize| (one / fit.moments[k] + alike.tilts[k]).sqrt();
        PlaneError {
            middle: fit.middle,
            axes: fit.axes,
            distance: (one / count + alike.distance).sqrt(),
            tilts: [tilt(0), tilt(1)],
        }
    };
    fits.iter().zip(variances(fits, corners.least_noise)).zip(&members.of).map(each).collect()
}
