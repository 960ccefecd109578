//! A plane as the boundary of a half-space.

use super::Pose;
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// The half-space `normal · x <= offset`, whose boundary is the plane of a facet.
///
/// Lengths are in girdle radii. In a validated plane (inside a [`Polytope`](super::Polytope)) the normal is a unit vector
/// that points out of the stone.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Plane {
    /// The outward normal.
    pub normal: DVec3,
    /// The distance of the plane from the origin along the normal.
    pub offset: f64,
}

impl Plane {
    /// Makes a plane from its outward normal, of any length but zero, and its offset in units of that length.
    pub const fn new(normal: DVec3, offset: f64) -> Self {
        Self { normal, offset }
    }

    /// Makes the plane whose unit normal leans `slope` away from the +z axis toward `azimuth`, both in radians.
    ///
    /// A slope of 0 gives a table, π/2 a girdle facet, π a culet. Facet tables describe a pavilion facet by its angle
    /// b from the girdle plane; the slope is then π - b.
    #[inline]
    pub fn from_slope(slope: f64, azimuth: f64, offset: f64) -> Self {
        let (sin, cos) = slope.sin_cos();
        Self::new(DVec3::new(sin * azimuth.cos(), sin * azimuth.sin(), cos), offset)
    }

    /// Returns the same half-space with a unit normal; `None` where the normal has no direction or a number is not finite.
    #[inline]
    pub fn normalized(&self) -> Option<Self> {
        // The scaling keeps the square of a tiny or huge component from vanishing or overflowing.
        let largest = self.normal.abs().max_element();
        let scaled = self.normal / largest;
        let length = scaled.length();
        let unit = Self::new(scaled / length, self.offset / largest / length);
        (unit.normal.is_finite() && unit.offset.is_finite()).then_some(unit)
    }

    /// Returns a plane of a body as a plane in the world.
    #[inline]
    pub fn placed(&self, pose: &Pose) -> Self {
        let normal = pose.turn * self.normal;
        Self { normal, offset: self.offset * pose.scale + normal.dot(pose.at) }
    }

    /// Returns the distance of `point` outside the half-space (negative inside), in units of the normal's length.
    #[inline]
    pub fn distance(&self, point: DVec3) -> f64 {
        self.normal.dot(point) - self.offset
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_normal_of_any_length_becomes_a_unit_normal() {
        for length in [5e-324, 1e-200, 1.0, 3.0, 1e200, f64::MAX] {
            let unit = Plane::new(DVec3::new(length, 0.0, length), 0.5 * length).normalized().unwrap();
            let expected = Plane::from_slope(std::f64::consts::FRAC_PI_4, 0.0, 0.5 * 0.5_f64.sqrt());
            assert!((unit.normal - expected.normal).length() < 1e-15, "{unit:?}");
            assert!(length < 1e-300 || (unit.offset - expected.offset).abs() < 1e-15, "{unit:?}");
        }
    }

    #[test]
    fn a_plane_without_direction_or_distance_has_no_unit_normal() {
        for n in
            [DVec3::ZERO, DVec3::NAN, DVec3::new(f64::INFINITY, 0.0, 1.0), DVec3::new(1.0, f64::NAN, 0.0)]
        {
            assert_eq!(Plane::new(n, 1.0).normalized(), None, "{n}");
        }
        for (length, offset) in [(1.0, f64::NAN), (1.0, f64::INFINITY), (1e-300, 1e300)] {
            assert_eq!(Plane::new(DVec3::Z * length, offset).normalized(), None);
        }
    }
}
