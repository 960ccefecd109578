//! The range of numbers, the bounding box of points, and the distance of the farthest point.

use glam::DVec3;

/// Returns the least and the greatest of some numbers; infinity and minus infinity where there are none.
pub fn span(numbers: impl IntoIterator<Item = f64>) -> (f64, f64) {
    let start = (f64::INFINITY, f64::NEG_INFINITY);
    numbers.into_iter().fold(start, |(low, high), x| (low.min(x), high.max(x)))
}

/// Returns the smallest box with sides along the axes that holds some points, as (least, greatest).
pub fn bounds(points: impl IntoIterator<Item = DVec3>) -> (DVec3, DVec3) {
    let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    points.into_iter().fold(start, |(low, high), v| (low.min(v), high.max(v)))
}

/// Returns the distance of the farthest point from the origin.
pub(super) fn reach(points: &[DVec3]) -> f64 {
    points.iter().map(|p| p.length()).fold(0.0, f64::max)
}
