//! The shape of a stone of triangles.

use super::outline;
use brillianteer_math::{Calipers, Pose, Surface, TriangleMesh, hull, span};
use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};
use std::ops::Deref;
use std::sync::Arc;

/// A surface that differs from the stone's frame by less than this, girdle radii, counts as lying in it: the
/// difference is rounding.
const IN_FRAME: f64 = 1e-9;

/// A closed surface of triangles in the stone's frame, shared because it may be large.
///
/// z is up and half the diameter is 1 (see [`Outline`](super::Outline)). The middle of the outline lies on the axis, and the
/// middle of the height at z = 0.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(try_from = "Surface", into = "Surface")]
pub struct MeshShape(pub Arc<TriangleMesh>);

impl MeshShape {
    /// Turns a surface and moves it into the stone's frame, unless it lies there already. Returns the shape and the pose
    /// that carried it there; `None` where the surface has no extent across.
    pub fn framed(mesh: &TriangleMesh, turn: DQuat) -> Option<(Self, Pose)> {
        let corners: Vec<DVec3> = mesh.vertices().iter().map(|&v| turn * v).collect();
        let around = hull(corners.iter().map(|v| v.truncate()).collect());
        let Calipers { width, middle, .. } = Calipers::of_stone(&around)?;
        let (low, high) = span(corners.iter().map(|v| v.z));
        let scale = 2.0 / outline::diameter(&around, middle, width);
        let shift = -scale * middle.extend((low + high) / 2.0);
        let is_framed = (scale - 1.0).abs() < IN_FRAME && shift.length() < IN_FRAME;
        let pose = Pose { at: shift, turn, scale };
        let mesh = if is_framed && turn == DQuat::IDENTITY { mesh.clone() } else { mesh.reframed(&pose) };
        let pose = if is_framed { Pose::turned(turn) } else { pose };
        Some((Self(Arc::new(mesh)), pose))
    }
}

impl PartialEq for MeshShape {
    /// Compares only corners and triangles. Everything else in a mesh follows from them, except for rounding that
    /// depends on the way it was made.
    fn eq(&self, other: &Self) -> bool {
        let (a, b) = (self.surface(), other.surface());
        Arc::ptr_eq(&self.0, &other.0) || (&a.vertices, &a.triangles) == (&b.vertices, &b.triangles)
    }
}

impl Deref for MeshShape {
    type Target = TriangleMesh;

    fn deref(&self) -> &TriangleMesh {
        &self.0
    }
}
