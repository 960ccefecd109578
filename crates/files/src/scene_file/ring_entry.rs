//! A ring in a scene file.

use super::shared::{Angles, leaning};
use brillianteer_cut::{MaterialRef, Size};
use brillianteer_optics::Metal;
use brillianteer_scene::{Pose, Ring};
use glam::{DQuat, DVec3};

/// A ring of the program's own making in a scene, with its stones.
#[derive(Debug, Clone, PartialEq)]
pub struct RingEntry {
    /// The ring's numbers, checked.
    pub ring: Ring,
    /// The metal.
    pub metal: Metal,
    /// The roughness of its surface, 0 to 1.
    pub roughness: f64,
    /// The cut of the main stone, as in [`Entry::cut`](super::Entry::cut), where the style has one.
    pub stone: Option<String>,
    /// The main stone's material, checked; `None` for the cut file's.
    pub material: Option<MaterialRef>,
    /// The main stone's size; `None` for the cut file's.
    pub size: Option<Size>,
    /// The cut of the small stones, where the style has them.
    pub small_stone: Option<String>,
    /// The small stones' material, checked; `None` for the cut file's.
    pub small_material: Option<MaterialRef>,
    /// The turn about the head's axis, in degrees.
    pub turn: f64,
    /// The angle by which the head's axis leans toward `azimuth`, in degrees.
    pub tilt: f64,
    /// The direction in which the head leans, in degrees from +x toward +y.
    pub azimuth: f64,
    /// The middle of the finger's hole, in mm; in a layout, from the middle of the layout.
    pub at_mm: DVec3,
    /// The line of the file where the table begins, from 1.
    pub line: usize,
}

impl RingEntry {
    /// Makes an entry of a ring with its main stone and its small stones as their cut files say, if it has such stones. The
    /// pose carries the ring from its own frame to its place, in mm.
    pub fn placed(
        ring: Ring,
        [stone, small_stone]: [Option<String>; 2],
        (metal, roughness): (Metal, f64),
        pose: &Pose,
    ) -> Self {
        let Angles { turn, tilt, azimuth } = Angles::of(pose.turn);
        Self {
            ring,
            metal,
            roughness,
            stone,
            material: None,
            size: None,
            small_stone,
            small_material: None,
            turn,
            tilt,
            azimuth,
            at_mm: pose.at,
            line: 0,
        }
    }

    /// Returns the rotation from the ring's frame, whose head lies in the direction +z, to the world's.
    pub fn turned(&self) -> DQuat {
        leaning(self.turn, self.tilt, self.azimuth)
    }
}
