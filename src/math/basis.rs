//! A right-handed frame that looks along one axis.

use glam::{DQuat, DVec2, DVec3};

/// Right, up and toward the eye: an image plane in space. Orthonormal, `right × up = toward`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Basis {
    /// The image's x axis.
    pub right: DVec3,
    /// The image's y axis.
    pub up: DVec3,
    /// Out of the image, toward the eye.
    pub toward: DVec3,
}

impl Basis {
    /// x to the right, y up, z toward the eye: a stone seen face up.
    pub const FACE_UP: Self = Self { right: DVec3::X, up: DVec3::Y, toward: DVec3::Z };

    /// The stone turned over about its y axis: seen through the pavilion.
    pub const FACE_DOWN: Self = Self { right: DVec3::NEG_X, up: DVec3::Y, toward: DVec3::NEG_Z };

    /// This frame carried by the smallest rotation that takes `toward` to the unit vector `new`.
    pub fn aimed(&self, new: DVec3) -> Self {
        let turn = DQuat::from_rotation_arc(self.toward, new);
        Self { right: turn * self.right, up: turn * self.up, toward: new }
    }

    /// The image coordinates of a point or direction, along `toward` dropped.
    pub fn project(&self, p: DVec3) -> DVec2 {
        DVec2::new(self.right.dot(p), self.up.dot(p))
    }

    /// The point of the image plane through the origin at these coordinates.
    pub fn lift(&self, p: DVec2) -> DVec3 {
        self.right * p.x + self.up * p.y
    }
}
