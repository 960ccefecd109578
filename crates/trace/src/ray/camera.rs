//! The camera of point rays.

use crate::DispersedRay;
use brillianteer_math::{Basis, Plane, SolidRef};
use brillianteer_scene::{Projection, View};
use glam::{DVec2, DVec3};

/// The camera of a view, which gives the ray that belongs to each point of the image plane.
#[derive(Debug, Clone, Copy)]
pub struct Camera {
    basis: Basis,
    /// The distance of the eye from the origin; infinite for parallel rays.
    distance: f64,
    /// The reach of the stone: the distance of its farthest point from the origin.
    reach: f64,
}

impl Camera {
    /// Creates the camera of a view of this stone.
    pub fn new<'a>(view: &View, solid: impl Into<SolidRef<'a>>) -> Self {
        Self::reaching(view, solid.into().reach())
    }

    /// Creates the camera of a view of a body whose farthest point is at this distance from the origin.
    pub fn reaching(view: &View, reach: f64) -> Self {
        let distance = match view.projection {
            Projection::Orthographic => f64::INFINITY,
            Projection::Perspective { distance } => distance,
        };
        Self { basis: view.basis(), distance, reach }
    }

    /// Returns half the side of the smallest square around the image's origin that holds the whole stone; `None`
    /// where a part of the stone is not in front of the eye.
    pub fn reach<'a>(&self, solid: impl Into<SolidRef<'a>>) -> Option<f64> {
        self.extent(solid.into().vertices().iter().copied()).map(DVec2::max_element)
    }

    /// Returns half the width and half the height of the smallest rectangle around the image's origin that holds all
    /// points; `None` where one of them is not in front of the eye.
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
        // The ray begins near the stone. If it began at a far eye, rounding would take digits of the point where it
        // meets the stone.
        (at - direction * from_eye.min(2.0 * self.reach + at.length()), direction)
    }

    /// Returns the ray through a point of the image plane as [`ray`](Self::ray) does, with its change, to first
    /// order, when that point moves by `by` (ray differentials: H. Igehy, *Tracing Ray Differentials*, SIGGRAPH
    /// 1999).
    pub fn ray_along(&self, p: DVec2, by: DVec2) -> DispersedRay {
        let (origin, direction) = self.ray(p);
        let (at, moved) = (self.basis.lift(p), self.basis.lift(by));
        if self.distance.is_infinite() {
            return DispersedRay { origin, direction, fan: DVec3::ZERO, shift: moved };
        }
        let from_eye = (at - self.basis.toward * self.distance).length();
        let fan = (moved - direction * moved.dot(direction)) / from_eye;
        // The point in the image plane moves by `moved`; the ray begins before that plane.
        DispersedRay { origin, direction, fan, shift: moved + fan * (origin - at).dot(direction) }
    }

    /// Returns the image point at which a point is seen, and the magnification there relative to the image plane,
    /// which is 1 for parallel rays. `None` where the point is not in front of the eye.
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

    /// Returns whether the eye is on the outer side of a plane.
    pub fn sees(&self, plane: &Plane) -> bool {
        let speed = plane.normal.dot(self.basis.toward);
        // Both sides are divided by the distance, which may be infinite.
        speed > plane.offset / self.distance
    }
}
