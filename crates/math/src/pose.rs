//! The pose of a body: the transform from the frame in which it was built to the world.

use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

/// The transform of a body: a rotation about its origin and a scale, then a translation.
///
/// The body itself does not change. Rays are carried into its frame, and the points and directions found there are
/// carried back.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Pose {
    /// The place of the body's origin in the world.
    pub at: DVec3,
    /// The rotation of the body about its origin.
    pub turn: DQuat,
    /// The length of the body's unit in the world, above 0.
    #[serde(default = "unscaled")]
    pub scale: f64,
}

fn unscaled() -> f64 {
    1.0
}

impl Pose {
    /// The pose that changes nothing.
    pub const STILL: Self = Self { at: DVec3::ZERO, turn: DQuat::IDENTITY, scale: 1.0 };

    /// Returns the pose of a body that is only turned.
    #[inline]
    pub fn turned(turn: DQuat) -> Self {
        Self { turn, ..Self::STILL }
    }

    /// Returns the place in the world of a point of the body.
    #[inline]
    pub fn place(&self, point: DVec3) -> DVec3 {
        self.turn * point * self.scale + self.at
    }

    /// Returns the point of the body at a place in the world.
    #[inline]
    pub fn unplace(&self, place: DVec3) -> DVec3 {
        self.turn.inverse() * (place - self.at) / self.scale
    }

    /// Returns the pose that carries a body first by `first` and then by this pose.
    #[inline]
    pub fn after(&self, first: &Self) -> Self {
        Self { at: self.place(first.at), turn: self.turn * first.turn, scale: self.scale * first.scale }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pose_takes_points_there_and_back_and_one_pose_after_another_is_one() {
        let turn = DQuat::from_euler(glam::EulerRot::XYZ, 0.4, -1.1, 2.3);
        let pose = Pose { at: DVec3::new(1.0, -2.0, 0.5), turn, scale: 0.3 };
        let other = Pose { scale: 2.0, ..Pose::turned(DQuat::from_rotation_x(0.7)) };
        let point = DVec3::new(0.3, 0.2, -0.9);
        assert!(pose.unplace(pose.place(point)).distance(point) < 1e-14);
        assert!(pose.after(&other).place(point).distance(pose.place(other.place(point))) < 1e-14);
        assert!(other.after(&pose).place(point).distance(pose.place(other.place(point))) > 0.1);
    }

    #[test]
    fn a_still_pose_changes_no_digit() {
        let point = DVec3::new(0.1, -1.0 / 3.0, 1e-300);
        assert_eq!((Pose::STILL.place(point), Pose::STILL.unplace(point)), (point, point));
    }
}
