//! The noise of scans: how it is smoothed, and how it is distinguished from curved facets.
//!
//! Noise moves the corners off the facets of a solid at random; a curved facet moves them together.

use super::deviation::outermost;
use crate::math::{Plane, Polytope, Surface};
use glam::DVec3;
use rayon::prelude::*;

/// The greatest correlation between the distances of neighbouring corners from their plane that counts as noise.
///
/// On a curved facet neighbouring corners leave the plane by nearly the same distance, and the correlation is near 1; for a
/// groove in six strips it is 0.6. For noise it is 0, or less where planes are fitted to few corners.
const MOST_CORRELATED: f64 = 0.4;

/// How often each corner is moved to the mean of itself and its neighbours. Six times leave a fifth of the noise, and round
/// edges by no more than the triangles beside them.
const SMOOTHINGS: usize = 6;

/// Returns the surface with its corners moved between their neighbours.
pub(super) fn smoothed(surface: &Surface) -> Surface {
    let mut smooth = surface.clone();
    for _ in 0..SMOOTHINGS {
        let mut sums: Vec<(DVec3, f64)> = smooth.vertices.iter().map(|v| (*v, 1.0)).collect();
        for corners in &smooth.triangles {
            for k in 0..3 {
                let sum = &mut sums[corners[k] as usize];
                // Every edge has two triangles, each of which adds half of the neighbour.
                let beside =
                    [corners[(k + 1) % 3], corners[(k + 2) % 3]].map(|v| smooth.vertices[v as usize]);
                *sum = (sum.0 + (beside[0] + beside[1]) / 2.0, sum.1 + 1.0);
            }
        }
        smooth.vertices = sums.into_iter().map(|(sum, count)| sum / count).collect();
    }
    smooth
}

/// In a scan, half of the corners lie farther off their planes than this part of the size. In a model they do not, though a
/// few may where something was cut out of it.
const LEAST: f64 = 3e-5;

/// The distance of a corner counts as no more than this many medians.
const FAR: f64 = 4.0;

/// Whether noise moves corners off the facets of a solid: most corners lie off, and those that share an edge and a facet do
/// so independently of one another.
pub(super) fn is_noise(surface: &Surface, polytope: &Polytope) -> bool {
    let planes: Vec<Plane> = polytope.planes().collect();
    let lies: Vec<(usize, f64)> =
        surface.vertices.par_iter().map(|corner| outermost(&planes, *corner)).collect();
    let mut sizes: Vec<f64> = lies.iter().map(|(_, distance)| distance.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    let median = sizes.get(sizes.len() / 2).copied().unwrap_or_default();
    // A few corners far off, as where noise hides a culet, say nothing of the others.
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
