//! Finds the body and the facet that are seen first at a point of a picture.

use super::metal_tracer::{MetalTracer, nearest_metal};
use super::{Camera, InstanceTracer};
use crate::sampling::LitScene;
use brillianteer_optics::line;
use glam::{DVec2, DVec3};

/// The index of a stone, and the facet and the distance at which a ray meets it.
pub(super) type Met = (usize, (usize, f64));

/// The stones of a scene at sodium's D line, 589.3 nm, and the camera. It finds what is visible at points of the
/// picture.
pub struct SceneProbe<'a> {
    lit_scene: LitScene<'a>,
    /// The picture's camera.
    pub camera: Camera,
    /// The stones, in the scene's order.
    pub tracers: Vec<InstanceTracer>,
    /// The metal, which may hide stones.
    metals: Vec<MetalTracer>,
}

/// A ray from the eye that meets a stone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProbeRay {
    /// The point where the ray begins.
    pub origin: DVec3,
    /// The direction in which the light travels, of length 1.
    pub direction: DVec3,
    /// The index of the stone that the ray meets first.
    pub stone: usize,
    /// The facet that the ray meets there, by its index in the solid.
    pub facet: u32,
    /// The distance from the ray's origin to that facet, in world units.
    pub distance: f64,
}

impl<'a> SceneProbe<'a> {
    /// Prepares the stones of a scene.
    pub fn new(lit_scene: &LitScene<'a>) -> Self {
        let scene = lit_scene.scene;
        let medium = |stone: &_| scene.medium(stone, (line::SODIUM_D, line::SODIUM_D, line::SODIUM_D));
        Self {
            lit_scene: *lit_scene,
            camera: Camera::reaching(lit_scene.view, lit_scene.scene.reach()),
            tracers: InstanceTracer::of_all(&scene.instances, lit_scene.options, medium),
            metals: MetalTracer::of_all(&scene.metals),
        }
    }

    /// Returns the ray through a point of the picture, in pixels to the right of its left border and below its upper
    /// one; `None` where the ray meets no stone, or meets metal first.
    pub fn through(&self, x: f64, y: f64) -> Option<ProbeRay> {
        let at = self.lit_scene.film.image_from_pixels(DVec2::new(x, y));
        let (origin, direction) = self.camera.ray(at);
        let (stone, (facet, distance)) = nearest(&self.tracers, (origin, direction), None)?;
        let metal = nearest_metal(&self.metals, (origin, direction), None);
        if metal.is_some_and(|hit| hit.distance <= distance) {
            return None;
        }
        Some(ProbeRay { origin, direction, stone, facet: facet as u32, distance })
    }

    /// Returns whether a point of a stone's surface is hidden from the eye by another body or, where the stone is not
    /// convex, by the stone itself.
    pub fn is_hidden(&self, stone: usize, point: DVec3) -> bool {
        let way = (point, self.camera.toward_eye(point));
        nearest(&self.tracers, way, Some(stone)).is_some()
            || nearest_metal(&self.metals, way, None).is_some()
            || self.tracers[stone].hides_itself(way)
    }
}

/// Returns the facet that is seen at a point of the picture, in pixels to the right of its left border and below its
/// upper one: the index of the stone, and the index of the facet in it. `None` beside the stones. For many points,
/// use a [`SceneProbe`].
pub fn facet_at(lit_scene: &LitScene, x: f64, y: f64) -> Option<(usize, u32)> {
    SceneProbe::new(lit_scene).through(x, y).map(|glance| (glance.stone, glance.facet))
}

/// Returns the stone that a ray meets first and the place where it meets it, except for the stone that the ray has
/// just left.
pub(super) fn nearest(
    tracers: &[InstanceTracer],
    (origin, direction): (DVec3, DVec3),
    left: Option<usize>,
) -> Option<Met> {
    let near = |&k: &usize| Some(k) != left && tracers[k].is_near((origin, direction));
    let others = (0..tracers.len()).filter(near);
    let met = others.filter_map(|k| Some((k, tracers[k].meet(origin, direction)?)));
    met.min_by(|(_, a), (_, b)| a.1.total_cmp(&b.1))
}
