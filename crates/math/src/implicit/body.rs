//! The body of a form in its own frame, before any shear: an outline drawn out along an axis, with a ball rolled around it.

use super::jet::Jet;
use super::profile::{Profile, Triangle};
use glam::DVec3;
use std::f64::consts::PI;

/// A convex body around the origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct RoundedBody {
    pub profile: Profile,
    /// The axis along which the outline is drawn out.
    pub axis: DVec3,
    /// Half the length of the core along the axis.
    pub half: f64,
    /// The radius of the ball.
    pub edge: f64,
}

impl RoundedBody {
    pub fn pill(size: DVec3, edge: f64) -> Self {
        Self::pane(size, size.x.min(size.y) / 2.0, edge)
    }

    pub fn pane(size: DVec3, corner: f64, edge: f64) -> Self {
        let size = size / 2.0;
        let profile = Profile::Rectangle { half: size.truncate() - corner, round: corner - edge };
        Self { profile, axis: DVec3::Z, half: size.z - edge, edge }
    }

    pub fn block(size: DVec3, edge: f64) -> Self {
        let half = size / 2.0 - edge;
        let profile = Profile::Rectangle { half: half.truncate(), round: 0.0 };
        Self { profile, axis: DVec3::Z, half: half.z, edge }
    }

    pub fn prism(size: DVec3, edge: f64) -> Self {
        let profile = Profile::Triangle(Triangle::new(size.y, size.z, edge));
        Self { profile, axis: DVec3::X, half: size.x / 2.0 - edge, edge }
    }

    /// Returns the signed distance from the body, with its derivatives.
    ///
    /// With `on_surface`, for a point on the surface or on the way to it, a sharp edge has the normal of one of its faces.
    /// Rounding would give it any normal between them.
    #[inline]
    pub fn jet(&self, p: DVec3, on_surface: bool) -> Jet {
        let sharp = on_surface && self.edge == 0.0;
        let along = p.dot(self.axis);
        let end = Jet::plane(along.abs() - self.half, self.axis * 1.0_f64.copysign(along));
        self.profile.jet(p, sharp).and(end, sharp).less(self.edge)
    }

    /// Returns the value at a point and its slope along a direction.
    #[inline]
    pub fn along(&self, p: DVec3, direction: DVec3) -> (f64, f64) {
        let jet = self.jet(p, true);
        (jet.value, jet.gradient.dot(direction))
    }

    /// Returns the greatest coordinate along a unit direction.
    pub fn support(&self, direction: DVec3) -> f64 {
        self.profile.support(direction) + direction.dot(self.axis).abs() * self.half + self.edge
    }

    /// Returns the distance of the farthest point from the origin.
    pub fn reach(&self) -> f64 {
        self.profile.reach().hypot(self.half) + self.edge
    }

    /// Returns the volume, by Steiner's formula V + S r + M r² + 4π/3 r³.
    ///
    /// The integral mean curvature M of a cylinder is π (length + circumference / 2).
    pub fn volume(&self) -> f64 {
        let (area, length, r) = (self.profile.area(), 2.0 * self.half, self.edge);
        let around = self.profile.circumference(DVec3::ZERO, 1.0);
        let surface = 2.0 * area + length * around;
        area * length + r * (surface + r * (PI * (length + around / 2.0) + 4.0 * PI / 3.0 * r))
    }

    /// Returns the area of the body's shadow along a unit direction, by Steiner's formula in the plane, A + L r + π r².
    pub fn silhouette_area(&self, direction: DVec3) -> f64 {
        let cos = direction.dot(self.axis);
        let sideways = direction - self.axis * cos;
        let sin = sideways.length();
        // The core's shadow is the shadow of its outline, drawn out along the shadow of its axis.
        let drawn = 2.0 * self.half * sin;
        let across = self.axis.cross(sideways).try_normalize().unwrap_or(DVec3::ZERO);
        let width = self.profile.support(across) + self.profile.support(-across);
        let area = self.profile.area() * cos.abs() + drawn * width;
        let around = self.profile.circumference(sideways, cos.abs()) + 2.0 * drawn;
        area + self.edge * (around + PI * self.edge)
    }
}
