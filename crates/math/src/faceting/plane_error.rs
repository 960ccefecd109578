//! The standard error of a plane that was fitted to a scan's corners.

use crate::{Plane, Pose};
use glam::DVec3;

/// The standard errors of a plane that was fitted to corners with noise. The errors of the distance at `middle` and of the
/// tilts toward the two axes are independent of one another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlaneError {
    /// The mean of the corners, at which the plane's distance is known best.
    pub middle: DVec3,
    /// The principal axes of the corners, unit vectors along the plane.
    pub axes: [DVec3; 2],
    /// The standard error of the plane's distance at `middle`, in the unit of lengths.
    pub distance: f64,
    /// The standard errors of the normal's tilts toward the axes, radians.
    pub tilts: [f64; 2],
}

impl PlaneError {
    /// Returns the errors of the plane after a pose has carried it.
    pub fn placed(&self, pose: &Pose) -> Self {
        Self {
            middle: pose.place(self.middle),
            axes: self.axes.map(|axis| pose.turn * axis),
            distance: pose.scale * self.distance,
            tilts: self.tilts,
        }
    }

    /// Returns the standard error of the normal's tilt toward a direction along the plane, radians; `toward` is a unit
    /// vector.
    pub fn tilt(&self, toward: DVec3) -> f64 {
        (self.axes[0].dot(toward) * self.tilts[0]).hypot(self.axes[1].dot(toward) * self.tilts[1])
    }

    /// Returns the standard error of the angle between the plane's normal and a fixed axis, radians.
    pub fn slope(&self, plane: &Plane, axis: DVec3) -> f64 {
        let along = axis - axis.dot(plane.normal) * plane.normal;
        match along.try_normalize() {
            Some(toward) => self.tilt(toward),
            // A level facet leans in some direction: the greater tilt bounds the error.
            None => self.tilts[0].max(self.tilts[1]),
        }
    }

    /// Returns the standard error of the azimuth of the plane's normal about a fixed axis, radians; `None` for a plane square
    /// to the axis, which has no azimuth.
    pub fn azimuth(&self, plane: &Plane, axis: DVec3) -> Option<f64> {
        let across = axis.cross(plane.normal);
        let toward = across.try_normalize()?;
        Some(self.tilt(toward) / across.length())
    }

    /// Returns how far another plane lies from the fitted one: the sum of the squares of distance and tilts, each in standard
    /// errors (χ² with three degrees of freedom if the other plane is the true one).
    pub fn squares(&self, fitted: &Plane, other: &Plane) -> f64 {
        let tilt = |k: usize| (other.normal - fitted.normal).dot(self.axes[k]) / self.tilts[k];
        let distance = (other.distance(self.middle) - fitted.distance(self.middle)) / self.distance;
        distance * distance + tilt(0).powi(2) + tilt(1).powi(2)
    }
}
