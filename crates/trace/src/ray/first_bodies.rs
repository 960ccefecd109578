//! Finds the body that is seen first at each of many points of a picture.

use super::sight::SceneProbe;
use crate::DispersedRay;
use crate::packet::{EyeRay, PacketTracer};
use crate::ray::Camera;
use crate::sampling::LitScene;
use glam::DVec2;
use rayon::prelude::*;

/// The number of points that are searched together.
const AT_ONCE: usize = 1024;

/// Finds the bodies that are seen first.
pub struct FirstBodies<'a> {
    lit_scene: LitScene<'a>,
    /// The camera of the picture.
    pub camera: Camera,
    rays: ProbingRays<'a>,
}

/// The rays that search for bodies.
enum ProbingRays<'a> {
    /// Packets in single precision, which are quicker.
    Packets(Box<PacketTracer<'a>>),
    /// Single rays in double precision, which meet bodies of all kinds.
    Single(Box<SceneProbe<'a>>),
}

impl<'a> FirstBodies<'a> {
    /// Prepares the bodies of a scene.
    pub fn new(lit_scene: &LitScene<'a>) -> Self {
        let camera = Camera::reaching(lit_scene.view, lit_scene.scene.reach());
        let rays = match PacketTracer::new(*lit_scene) {
            Some(packets) => ProbingRays::Packets(Box::new(packets)),
            None => ProbingRays::Single(Box::new(SceneProbe::new(lit_scene))),
        };
        Self { lit_scene: *lit_scene, camera, rays }
    }

    /// Returns, for each point, the index of the body that is seen there first; `None` where there is no body. Points
    /// are in pixels to the right of the picture's left border and below its upper one.
    pub fn at(&self, points: &[DVec2]) -> Vec<Option<u32>> {
        let packets = match &self.rays {
            ProbingRays::Packets(packets) => packets,
            ProbingRays::Single(probe) => {
                let single = |at: &DVec2| probe.through(at.x, at.y).map(|seen| seen.stone as u32);
                return points.par_iter().map(single).collect();
            }
        };
        let eye_ray = |at: &DVec2| {
            let (origin, direction) = self.camera.ray(self.lit_scene.film.image_from_pixels(*at));
            EyeRay { pixel: [0; 2], ray: DispersedRay::new(origin, direction) }
        };
        let together =
            |points: &[DVec2]| packets.first_bodies(&points.iter().map(eye_ray).collect::<Vec<_>>());
        points.par_chunks(AT_ONCE).flat_map_iter(together).collect()
    }
}
