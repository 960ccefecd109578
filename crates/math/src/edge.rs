//! An edge of a solid, for drawing.

use super::Pose;
use glam::DVec3;

/// An edge between two facets, or a line on a smooth surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Edge {
    /// The two ends.
    pub ends: [DVec3; 2],
    /// The outward normals of the facets on both sides; on a smooth surface, the normals at both ends.
    pub normals: [DVec3; 2],
}

impl Edge {
    /// Returns the edge of a body as an edge in the world.
    pub fn placed(&self, pose: &Pose) -> Self {
        Self { ends: self.ends.map(|v| pose.place(v)), normals: self.normals.map(|n| pose.turn * n) }
    }
}
