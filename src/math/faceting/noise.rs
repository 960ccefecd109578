//! The noise of scans: smoothing it, and distinguishing it from curved facets.
//!
//! Noise moves corners off the facets of a solid at random; on a curved facet neighbouring corners move together.

use super::deviation::outermost;
use crate::math::{Plane, Polytope, Surface};
use glam::DVec3;
use rayon::prelude::*;

/// The greatest correlation between neighbouring corners' distances from their plane that counts as noise.
///
/// On a curved facet neighbouring corners are at nearly the same distance from the plane, and the correlation is near
/// 1; for a groove in six strips it is 0.6. For noise it is 0, or less where planes are fitted to few corners.
const MOST_CORRELATED: f64 = 0.4;

/// The number of times that each corner is moved to the mean of itself and its neighbours. Six times leave a fifth of
/// the noise, and round edges over no more than the triangles beside them.
const SMOOTHINGS: usize = 6;

/// Returns the surface after smoothing: its corners are moved to the means of themselves and their neighbours.
pub(super) fn smoothed(surface: &Surface) -> Surface {
    let mut smooth = surface.clone();
    for _ in 0..SMOOTHINGS {
        let mut sums: Vec<(DVec3, f64)> = smooth.vertices.iter().map(|v| (*v, 1.0)).collect();
        for corners in &smooth.triangles {
            for k in 0..3 {
                let sum = &mut sums[corners[k] as usize];
                // Every edge has two triangles, each of which adds half of the neighbouring corner.
                let beside =
                    [corners[(k + 1) % 3], corners[(k + 2) % 3]].map(|v| smooth.vertices[v as usize]);
                *sum = (sum.0 + (beside[0] + beside[1]) / 2.0, sum.1 + 1.0);
            }
        }
        smooth.vertices = sums.into_iter().map(|(sum, count)| sum / count).collect();
    }
    smooth
}

/// In a scan, half of the corners lie farther off their planes than this part of the size. In a model they do not,
/// though a few may, where a part was cut out of it.
const LEAST: f64 = 3e-5;

/// Greater distances of a corner are limited to this many medians.
const FAR: f64 = 4.0;

/// Returns whether noise moves corners off the facets of a solid: most corners lie off their facets, and corners that
/// share an edge and a facet do so independently of one another.
pub(super) fn is_noise(surface: &Surface, polytope: &Polytope) -> bool {
    let planes: Vec<Plane> = polytope.planes().collect();
    let lies: Vec<(usize, f64)> =
        surface.vertices.par_iter().map(|corner| outermost(&planes, *corner)).collect();
    let mut sizes: Vec<f64> = lies.iter().map(|(_, distance)| distance.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    let median = sizes.get(sizes.len() / 2).copied().unwrap_or_default();
    // A few corners that are far off, as where noise hides a culet, say nothing about the others.
    let most = FAR * median;
    let (mut together, mut whole) = (0.0, 0.0);
    for [a, b, c] in &surface.triangles {
        for [i, j] in [[a, b], [b, c], [c, a]] {
            let ((one, x), (other, y)) = (lies[*i as usize], lies[*j as usize]);
            if one == other {
                let (x, y) = (x.clamp(-most, most), y.clamp(-most, most));
                together += x * y;
                whole += (x * x + y * y) / 2.0;
            }
        }
    }
    median > LEAST * surface.size() && together <= MOST_CORRELATED * whole
}
