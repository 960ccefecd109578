//! The motion between two pictures of resting bodies under a moving eye, for temporal antialiasing.

use super::MotionVector;
use brillianteer_scene::View;
use brillianteer_trace::ray::{Camera, SceneProbe};
use brillianteer_trace::sampling::LitScene;
use glam::{DMat2, DVec2};
use rayon::prelude::*;

/// Returns for each pixel of a picture the body that it shows, and the place of the same point in another view on the
/// same film. The backplate moves with the eye. Metal counts as background.
pub fn motion_of_view(lit_scene: &LitScene, before: &View) -> Vec<MotionVector> {
    let probe = SceneProbe::new(lit_scene);
    let eye = Camera::reaching(before, lit_scene.scene.reach());
    let film = &lit_scene.film;
    let pixels = film.pixels_from_image(DMat2::IDENTITY);
    let [width, height] = film.size;
    let at = |k: u64| {
        let at = DVec2::new((k % u64::from(width)) as f64, (k / u64::from(width)) as f64) + 0.5;
        let Some(seen) = probe.through(at.x, at.y) else { return MotionVector { body: None, from: at } };
        let point = seen.origin + seen.direction * seen.distance;
        let from = eye.project(point).map_or(DVec2::NAN, |(image, _)| pixels.transform_point2(image));
        MotionVector { body: Some(seen.stone as u32), from }
    };
    (0..u64::from(width) * u64::from(height)).into_par_iter().map(at).collect()
}
