//! A ball around a solid, by which rays that miss the solid are found quickly.

use super::bounds;
use glam::DVec3;

/// A ball that encloses a solid, in the solid's units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ball {
    /// The centre of the ball.
    pub middle: DVec3,
    /// The radius of the ball.
    pub radius: f64,
}

impl Ball {
    /// Returns a ball that holds all points; its centre is that of the box around them.
    pub fn around(points: &[DVec3]) -> Self {
        let (low, high) = bounds(points.iter().copied());
        let middle = (low + high) / 2.0;
        Self { middle, radius: points.iter().map(|p| p.distance(middle)).fold(0.0, f64::max) }
    }

    /// Returns whether a ray from `origin` along a unit direction runs through the ball.
    pub fn is_met(&self, origin: DVec3, direction: DVec3) -> bool {
        let away = self.middle - origin;
        let along = away.dot(direction);
        along > -self.radius && away.length_squared() - along * along < self.radius * self.radius
    }
}
