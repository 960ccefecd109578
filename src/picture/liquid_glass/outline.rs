//! The pane's outline, and the dome over it.

use glam::{DVec2, DVec3};

/// A rectangle with rounded corners around the origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PaneOutline {
    /// Half the width and height, above 0.
    pub half: DVec2,
    /// Radius of the corners, from 0 to the lesser half.
    pub radius: f64,
}

/// A point of the dome over an outline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct DomePoint {
    /// Relative distance from the middle: 0 there, 1 on the outline and beyond, growing evenly along every line from the
    /// middle.
    pub distance: f64,
    /// Unit direction from the middle; zero in the middle itself.
    pub radial: DVec2,
    /// Unit normal, z toward the eye: upright in the middle, level on the outline. Over a circle the dome is half a
    /// ball.
    pub normal: DVec3,
}

impl PaneOutline {
    /// Returns the signed distance of a place from the outline, negative inside.
    pub fn distance(&self, at: DVec2) -> f64 {
        let beyond = at.abs() - (self.half - self.radius);
        beyond.max(DVec2::ZERO).length() + beyond.max_element().min(0.0) - self.radius
    }

    /// Returns the dome's point at a place; beyond the outline it is as on the outline.
    pub fn dome(&self, at: DVec2) -> DomePoint {
        let (distance, outward) = self.gauge(at.abs());
        let distance = distance.min(1.0);
        let level = outward * at.signum() * distance;
        DomePoint {
            distance,
            radial: at.try_normalize().unwrap_or(DVec2::ZERO),
            normal: level.extend((1.0 - distance * distance).max(0.0).sqrt()),
        }
    }

    /// Returns the factor by which the outline must be scaled to run through a place of the first quarter (H.
    /// Minkowski's functional), and the outline's unit normal there.
    fn gauge(&self, at: DVec2) -> (f64, DVec2) {
        let inner = (self.half - self.radius).max(DVec2::ZERO);
        if at.y * self.half.x <= inner.y * at.x {
            return (at.x / self.half.x, DVec2::X);
        }
        if at.x * self.half.y <= inner.x * at.y {
            return (at.y / self.half.y, DVec2::Y);
        }
        // The line from the middle meets the corner's circle where |k at - inner| = radius; the greater k is the farther
        // point.
        let (a, b) = (at.length_squared(), at.dot(inner));
        let k = (b + (b * b - a * (inner.length_squared() - self.radius * self.radius)).max(0.0).sqrt()) / a;
        (k.recip(), (at * k - inner).try_normalize().unwrap_or(DVec2::ZERO))
    }
}
