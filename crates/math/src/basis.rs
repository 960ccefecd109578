//! A right-handed orthonormal frame whose third axis points toward the eye.

use glam::{DQuat, DVec2, DVec3};

/// An image plane in space: its right, its up and the direction toward the eye.
///
/// The axes are orthonormal, and `right × up = toward`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Basis {
    /// The image's x axis.
    pub right: DVec3,
    /// The image's y axis.
    pub up: DVec3,
    /// The direction out of the image, toward the eye.
    pub toward: DVec3,
}

impl Basis {
    /// The view of a stone face up: x to the right, y up, z toward the eye.
    pub const FACE_UP: Self = Self { right: DVec3::X, up: DVec3::Y, toward: DVec3::Z };

    /// The view through the pavilion: the stone is turned over about its y axis.
    pub const FACE_DOWN: Self = Self { right: DVec3::NEG_X, up: DVec3::Y, toward: DVec3::NEG_Z };

    /// Returns this frame after the smallest rotation that takes `toward` to the unit vector `new`.
    pub fn aimed(&self, new: DVec3) -> Self {
        let turn = DQuat::from_rotation_arc(self.toward, new);
        Self { right: turn * self.right, up: turn * self.up, toward: new }
    }

    /// Returns this frame after a rotation; the identity leaves every digit unchanged.
    pub fn turned(&self, by: DQuat) -> Self {
        if by == DQuat::IDENTITY {
            return *self;
        }
        Self { right: by * self.right, up: by * self.up, toward: by * self.toward }
    }

    /// Returns the image coordinates of a point or direction; its part along `toward` is dropped.
    #[inline]
    pub fn project(&self, p: DVec3) -> DVec2 {
        DVec2::new(self.right.dot(p), self.up.dot(p))
    }

    /// Returns the point with these coordinates in the image plane through the origin.
    pub fn lift(&self, p: DVec2) -> DVec3 {
        self.right * p.x + self.up * p.y
    }
}
