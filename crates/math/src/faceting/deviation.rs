//! The distance of points from the surface of a convex solid.

use crate::{Plane, Polytope};
use glam::DVec3;
use rayon::prelude::*;

/// Returns the greatest distance of points from a solid's surface.
///
/// For a point outside, it is the greatest of its distances from the planes that it lies outside of.
pub fn deviation(polytope: &Polytope, points: &[DVec3]) -> f64 {
    let planes: Vec<Plane> = polytope.planes().collect();
    points.par_iter().map(|p| outermost(&planes, *p).1.abs()).reduce(|| 0.0, f64::max)
}

/// Returns the place of the plane that a point is farthest outside of, and the point's distance from that plane; of
/// equals, the first counts.
pub(super) fn outermost(planes: &[Plane], point: DVec3) -> (usize, f64) {
    let distances = planes.iter().map(|plane| plane.distance(point)).enumerate();
    // A comparison of its own for each plane would take three times as long.
    let farther = |most: (usize, f64), next: (usize, f64)| if next.1 > most.1 { next } else { most };
    distances.reduce(farther).unwrap_or_default()
}
