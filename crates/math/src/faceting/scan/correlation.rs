//! How far the noise of neighbouring corners agrees, by which a mean of many corners is less certain than that of as many
//! independent ones.

use super::members::Members;
use super::patches::{ScanCorners, Visited};
use super::points::PlaneEstimate;
use rayon::prelude::*;

/// The most corners whose surroundings are examined.
const MOST: usize = 4_000;

/// The greatest number of edges between corners that are compared.
const RINGS: usize = 12;

/// Correlations below this many of their standard errors count as none.
const CERTAIN: f64 = 3.0;

/// The number of times that the effect of the fit is taken out with the factor known by then.
const ROUNDS: usize = 4;

/// The least number of corners of a facet, beyond three, whose distances tell of the correlation.
const LEAST_FREEDOM: usize = 8;

/// Sums over pairs of corners that are so many edges apart.
#[derive(Clone, Copy, Default)]
struct Ring {
    pairs: f64,
    products: f64,
    /// The parts by which the fitted planes follow both corners of the pairs, which lowers their products.
    followed: f64,
}

/// A corner's distance from its facet, in standard deviations of the noise.
#[derive(Clone, Copy)]
struct Residual {
    facet: u32,
    distance: f64,
}

/// The mark of a corner without a facet.
const NOWHERE: u32 = u32::MAX;

/// Returns the factor by which the noise's correlation multiplies the variance of means over a facet: 1 plus the sum of the
/// correlations of a corner with all others; 1 for independent noise.
pub(super) fn inflation(corners: &ScanCorners, members: &Members, fits: &[PlaneEstimate]) -> f64 {
    let residuals = residuals(corners, members, fits);
    let known: Vec<u32> =
        (0..residuals.len() as u32).filter(|&v| residuals[v as usize].facet != NOWHERE).collect();
    let step = known.len().div_ceil(MOST).max(1);
    let sampled: Vec<u32> = known.into_iter().step_by(step).collect();
    let rings = |visited: &mut Visited, &corner: &u32| rings(corners, &residuals, fits, corner, visited);
    let each: Vec<[Ring; RINGS]> =
        sampled.par_iter().map_init(|| Visited::of(corners.at.len()), rings).collect();
    let sum = |k: usize| {
        each.iter().fold(Ring::default(), |sum, rings| Ring {
            pairs: sum.pairs + rings[k].pairs,
            products: sum.products + rings[k].products,
            followed: sum.followed + rings[k].followed,
        })
    };
    let sums: Vec<Ring> = (0..RINGS).map(sum).collect();
    (0..ROUNDS).fold(1.0, |factor, _| summed(&sums, sampled.len() as f64, factor))
}

/// Returns 1 plus the sum of the correlations, up to the first ring that shows none. `factor` is the inflation known so far,
/// by which fits follow the noise more.
fn summed(rings: &[Ring], corners: f64, factor: f64) -> f64 {
    let mut sum = 1.0;
    for ring in rings.iter().filter(|ring| ring.pairs > 0.0) {
        let mean = (ring.products + factor * ring.followed) / ring.pairs;
        // Each pair of corners is counted twice.
        if mean < CERTAIN * (2.0 / ring.pairs).sqrt() {
            break;
        }
        sum += ring.pairs / corners * mean;
    }
    sum
}

fn residuals(corners: &ScanCorners, members: &Members, fits: &[PlaneEstimate]) -> Vec<Residual> {
    let mut all = vec![Residual { facet: NOWHERE, distance: 0.0 }; corners.at.len()];
    for ((facet, of), fit) in (0..).zip(&members.of).zip(fits) {
        let scale = fit.variance().sqrt();
        if fit.freedom() >= LEAST_FREEDOM && scale > 0.0 {
            for &v in of {
                let distance = fit.plane.distance(corners.at[v as usize]) / scale;
                all[v as usize] = Residual { facet, distance };
            }
        }
    }
    all
}

/// Returns the sums over the pairs of a corner with those around it, ring by ring.
fn rings(
    corners: &ScanCorners,
    residuals: &[Residual],
    fits: &[PlaneEstimate],
    corner: u32,
    visited: &mut Visited,
) -> [Ring; RINGS] {
    let mut rings = [Ring::default(); RINGS];
    let own = residuals[corner as usize];
    let fit = &fits[own.facet as usize];
    let from = corners.at[corner as usize] - fit.middle;
    visited.clear();
    visited.visit(corner);
    let mut front = vec![corner];
    for ring in &mut rings {
        let mut next = vec![];
        for v in front {
            next.extend(corners.neighbours.of_corner(v).iter().filter(|&&n| visited.visit(n)));
        }
        next.retain(|&n| residuals[n as usize].facet == own.facet);
        for &n in &next {
            let to = corners.at[n as usize] - fit.middle;
            let along = |k: usize| from.dot(fit.axes[k]) * to.dot(fit.axes[k]) / fit.moments[k];
            ring.pairs += 1.0;
            ring.products += own.distance * residuals[n as usize].distance;
            ring.followed += 1.0 / fit.count as f64 + along(0) + along(1);
        }
        front = next;
    }
    rings
}
