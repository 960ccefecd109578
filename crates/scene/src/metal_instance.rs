//! An opaque body of metal in its place.

use brillianteer_math::{Ball, Pose, ShadedMesh};
use brillianteer_optics::Metal;
use glam::DVec3;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// The roughness of hand-polished metal.
pub const POLISHED: f64 = 0.1;

/// A body of metal, such as the mounting of a stone.
///
/// Its surface reflects on both sides and need not be closed. Metal may touch stones and cut into them: light inside a stone
/// does not see it there, and light that leaves a stone inside the metal goes to and fro between both until they have
/// absorbed it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MetalInstance {
    /// The body's surface in its own frame. Instances of one body share it.
    pub mesh: Arc<ShadedMesh>,
    /// The pose that carries the body into the world.
    pub pose: Pose,
    /// The metal.
    pub metal: Metal,
    /// The roughness of its surface, from 0, a mirror, to 1: the square root of the width of GGX's law.
    pub roughness: f64,
    /// The name of the body; may be empty.
    pub label: String,
}

impl MetalInstance {
    /// Returns a polished body without a label, in the place and at the scale of its own frame.
    pub fn new(mesh: &Arc<ShadedMesh>, metal: Metal) -> Self {
        Self { mesh: Arc::clone(mesh), pose: Pose::STILL, metal, roughness: POLISHED, label: String::new() }
    }

    /// Returns the same body, carried on by a pose from its place.
    pub fn moved(self, pose: &Pose) -> Self {
        Self { pose: pose.after(&self.pose), ..self }
    }

    /// Returns the corners of its triangles in the world.
    pub fn vertices(&self) -> impl Iterator<Item = DVec3> + '_ {
        self.mesh.surface().points.iter().map(|&point| self.pose.place(point))
    }

    /// Returns a ball around the body in the world; it is a little larger than it must be, for rounding.
    pub fn ball(&self) -> Ball {
        let Ball { middle, radius } = self.mesh.ball();
        Ball { middle: self.pose.place(middle), radius: radius * self.pose.scale * (1.0 + 1e-5) }
    }

    /// Returns a distance from the world's origin that no corner exceeds.
    pub fn reach(&self) -> f64 {
        self.mesh.reach() * self.pose.scale + self.pose.at.length()
    }
}
