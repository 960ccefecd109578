//! Noise of scans: a surface with less of it, and whether corners leave the facets of a solid at random, as noise makes
//! them, or together, as those of a curved facet do.

use super::Surface;
use crate::math::{Plane, Polytope};
use glam::DVec3;
use rayon::prelude::*;

/// Neighbouring corners on a facet that is curved leave its plane by nearly the same distance, and their correlation is
/// near 1: of a groove in six strips it is 0.6. Of noise it is 0, and less where planes are fitted to few corners.
const MOST_CORRELATED: f64 = 0.4;

/// How often each corner is moved to the middle of itself and its neighbours: six leave a fifth of the noise, and round
/// edges by no more than the triangles beside them.
const SMOOTHINGS: usize = 6;

/// The surface with its corners between their neighbours.
pub(super) fn smoothed(surface: &Surface) -> Surface {
    let mut smooth = surface.clone();
    for _ in 0..SMOOTHINGS {
        let mut sums: Vec<(DVec3, f64)> = smooth.vertices.iter().map(|v| (*v, 1.0)).collect();
        for corners in &smooth.triangles {
            for k in 0..3 {
                let sum = &mut sums[corners[k] as usize];
                // Every edge has two triangles, and so counts once in all.
                let beside =
                    [corners[(k + 1) % 3], corners[(k + 2) % 3]].map(|v| smooth.vertices[v as usize]);
                *sum = (sum.0 + (beside[0] + beside[1]) / 2.0, sum.1 + 1.0);
            }
        }
        smooth.vertices = sums.into_iter().map(|(sum, count)| sum / count).collect();
    }
    smooth
}

/// Half the corners of a scan lie farther off their planes than this part of the size; those of a model do not, though a few
/// may where something was cut out of it.
const LEAST: f64 = 3e-5;

/// A corner that is farther off than this many medians counts as if it were there.
const FAR: f64 = 4.0;

/// Whether corners leave the facets of a solid by noise: most of them do, and those that are joined by an edge and lie on
/// one facet do so independently of one another.
pub(super) fn is_noise(surface: &Surface, polytope: &Polytope) -> bool {
    let planes: Vec<Plane> = polytope.planes().collect();
    let on = |corner: &DVec3| {
        let distances = planes.iter().map(|plane| plane.distance(*corner)).enumerate();
        distances.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or_default()
    };
    let lies: Vec<(usize, f64)> = surface.vertices.par_iter().map(on).collect();
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
