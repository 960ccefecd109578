//! A plane as the boundary of a half-space.

use glam::DVec3;

/// The half-space `normal · x <= offset`; its boundary is the facet's plane.
///
/// Lengths are in units of the girdle radius. Where a plane has been validated (inside a
/// [`Polytope`](super::Polytope)) the normal is a unit vector that points out of the stone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// Outward normal.
    pub normal: DVec3,
    /// Distance of the plane from the origin along the normal.
    pub offset: f64,
}

impl Plane {
    /// A plane from its outward normal, of any length but zero, and offset in the units of that length.
    pub const fn new(normal: DVec3, offset: f64) -> Self {
        Self { normal, offset }
    }

    /// The plane whose unit normal leans `slope` away from the +z axis toward `azimuth`, both in radians.
    ///
    /// A slope of 0 is a table, π/2 a girdle facet, π a culet. Facet tables write a pavilion facet by its
    /// angle b from the girdle plane, which is the slope π - b.
    pub fn from_slope(slope: f64, azimuth: f64, offset: f64) -> Self {
        let (sin, cos) = slope.sin_cos();
        Self::new(DVec3::new(sin * azimuth.cos(), sin * azimuth.sin(), cos), offset)
    }

    /// The same half-space with a unit normal, or `None` where the normal has no direction or a number is not
    /// finite.
    pub fn normalized(&self) -> Option<Self> {
        let length = self.normal.length();
        let unit = Self::new(self.normal / length, self.offset / length);
        (length > f64::MIN_POSITIVE && unit.normal.is_finite() && unit.offset.is_finite()).then_some(unit)
    }

    /// How far `point` lies outside the half-space (negative inside), in the units of the normal's length.
    pub fn distance(&self, point: DVec3) -> f64 {
        self.normal.dot(point) - self.offset
    }
}
