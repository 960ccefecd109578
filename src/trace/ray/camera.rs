//! The camera of point rays.

use crate::math::{Basis, Plane, SolidRef};
use crate::scene::{Projection, View};
use crate::trace::DispersedRay;
use glam::{DVec2, DVec3};

/// The camera of a view: says for each image point where its ray begins and in which direction it goes.
#[derive(Debug, Clone, Copy)]
pub struct Camera {
    basis: Basis,
    /// Distance of the eye from the origin; infinite for parallel rays.
    distance: f64,
    /// How far the stone reaches from the origin.
    reach: f64,
}

impl Camera {
    /// Creates the camera of a view of this stone.
    pub fn new<'a>(view: &View, solid: impl Into<SolidRef<'a>>) -> Self {
        Self::reaching(view, solid.into().reach())
    }

    /// Creates the camera of a view of anything that reaches this far from the origin.
    pub fn reaching(view: &View, reach: f64) -> Self {
        let distance = match view.projection {
            Projection::Orthographic => f64::INFINITY,
            Projection::Perspective { distance } => distance,
        };
        Self { basis: view.basis(), distance, reach }
    }

    /// Returns half the side of the smallest square around the image's origin that holds the whole stone; `None` where the
    /// eye is not in front of all of it.
    pub fn reach<'a>(&self, solid: impl Into<SolidRef<'a>>) -> Option<f64> {
        self.extent(solid.into().vertices().iter().copied()).map(DVec2::max_element)
    }

    /// Returns half the width and half the height of the smallest rectangle around the image's origin that holds all points;
    /// `None` where the eye is not in front of all of them.
    pub fn extent(&self, mut points: impl Iterator<Item = DVec3>) -> Option<DVec2> {
        points.try_fold(DVec2::ZERO, |extent, v| {
            let nearness = 1.0 - self.basis.toward.dot(v) / self.distance;
            (nearness > 0.0).then(|| extent.max(self.basis.project(v).abs() / nearness))
        })
    }

    /// Returns a point outside the stone on the ray through a point of the image plane, and the ray's unit direction.
    pub fn ray(&self, p: DVec2) -> (DVec3, DVec3) {
        let (at, toward) = (self.basis.lift(p), self.basis.toward);
        let (direction, from_eye) = if self.distance.is_infinite() {
            (-toward, f64::INFINITY)
        } else {
            let ray = at - toward * self.distance;
            (ray / ray.length(), ray.length())
        };
        // The ray begins near the stone: a long way from a far eye would cost the digits of the point where it meets the
        // stone.
        (at - direction * from_eye.min(2.0 * self.reach + at.length()), direction)
    }

    /// Returns the ray through a point of the image plane as [`ray`](Self::ray) does, with its change where that point moves by
    /// `by`: to first order, as ray differentials have it (H. Igehy, *Tracing Ray Differentials*, SIGGRAPH 1999).
    pub fn ray_along(&self, p: DVec2, by: DVec2) -> DispersedRay {
        let (origin, direction) = self.ray(p);
        let (at, moved) = (self.basis.lift(p), self.basis.lift(by));
        if self.distance.is_infinite() {
            return DispersedRay { origin, direction, fan: DVec3::ZERO, shift: moved };
        }
        let from_eye = (at - self.basis.toward * self.distance).length();
        let fan = (moved - direction * moved.dot(direction)) / from_eye;
        // The point in the image plane moves by `moved`, the ray's beginning lies before it.
        DispersedRay { origin, direction, fan, shift: moved + fan * (origin - at).dot(direction) }
    }

    /// Returns where in the image plane a point is seen, and how much larger things at the point look than things in the
    /// image plane, which is 1 for parallel rays. `None` where the point is not in front of the eye.
    pub fn project(&self, v: DVec3) -> Option<(DVec2, f64)> {
        let nearness = 1.0 - self.basis.toward.dot(v) / self.distance;
        (nearness > 0.0).then(|| (self.basis.project(v) / nearness, 1.0 / nearness))
    }

    /// Returns the unit direction from a point to the eye.
    pub fn toward_eye(&self, v: DVec3) -> DVec3 {
        if self.distance.is_infinite() {
            return self.basis.toward;
        }
        let way = self.basis.toward * self.distance - v;
        way / way.length()
    }

    /// Whether the eye is on a plane's outer side.
    pub fn sees(&self, plane: &Plane) -> bool {
        let speed = plane.normal.dot(self.basis.toward);
        // Both sides are divided by the distance, which may be infinite.
        speed > plane.offset / self.distance
    }
}
