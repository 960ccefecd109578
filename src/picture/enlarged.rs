//! Rough pictures of bodies in full resolution: outlines and what hangs behind are as fine as in a finished picture, and only
//! the light in the bodies is rough.

use super::Linear;
use crate::scene::Film;
use crate::trace::ray::SceneProbe;
use crate::trace::sampling::{LitScene, colour};
use glam::{DMat2, DVec2, DVec3, IVec2};
use rayon::prelude::*;

/// Which body is seen at a point, by its index in the scene; `None` beside all bodies.
type SeenBody = Option<u32>;

/// A picture with few pixels, and what is in sight at each.
struct RoughPicture<'a> {
    picture: &'a Linear,
    /// The places of its rays in its pixels, 0 to 1.
    shift: DVec2,
    bodies: Vec<SeenBody>,
}

/// Returns a rough picture with as many pixels as the film of `lit_scene`, which shows the same. `rough_film` is the film of
/// the picture, `shift` the place of its rays in its pixels, 0 to 1, and `white` the response of light that goes straight to
/// the eye (`SamplePass::whole`).
///
/// A pixel that shows a body has the light of this body in the nearest pixels of the rough picture, interpolated. A body too
/// small to be seen in any of these has their mean. A pixel beside all bodies shows what is behind them. Where all rough
/// pixels around agree on a body, so do the fine ones between them; the others are looked at one by one.
pub fn enlarged(
    rough: &Linear,
    (rough_film, shift): (&Film, DVec2),
    lit_scene: &LitScene,
    white: &[DVec3; 4],
) -> Linear {
    let probe = SceneProbe::new(lit_scene);
    let film = lit_scene.film;
    let fine_from_image = film.pixels_from_image(DMat2::IDENTITY);
    let rough_from_image = rough_film.pixels_from_image(DMat2::IDENTITY);
    let body_at = |at: DVec2| probe.through(at.x, at.y).map(|seen| seen.stone as u32);
    let (across, count) = (rough.width.max(1) as usize, rough.pixels.len());
    let of_rough = |k: usize| {
        let at = DVec2::new((k % across) as f64, (k / across) as f64) + shift;
        body_at(fine_from_image.transform_point2(rough_film.image_from_pixels(at)))
    };
    let bodies = (0..count).into_par_iter().map(of_rough).collect();
    let rough = RoughPicture { picture: rough, shift, bodies };
    let pixel = |x: u32, y: u32| {
        let at = DVec2::new(f64::from(x), f64::from(y)) + 0.5;
        let around = rough.around(rough_from_image.transform_point2(film.image_from_pixels(at)));
        let body = around.agreed.unwrap_or_else(|| body_at(at));
        match body {
            Some(body) => rough.light(&around, body),
            None => backdrop(lit_scene, &probe, at, white),
        }
    };
    let [width, height] = film.size;
    let pixels = (0..height)
        .into_par_iter()
        .flat_map_iter(|y| (0..width).map(move |x| (x, y)).map(|(x, y)| pixel(x, y)).collect::<Vec<_>>())
        .collect();
    Linear { width, height, pixels }
}

/// Returns what is seen behind all bodies at a point of the picture, in pixels.
fn backdrop(lit_scene: &LitScene, probe: &SceneProbe, at: DVec2, white: &[DVec3; 4]) -> [f32; 4] {
    if !lit_scene.environment.backdrop {
        return [0.0; 4];
    }
    let (origin, direction) = probe.camera.ray(lit_scene.film.image_from_pixels(at));
    let light = colour(white, lit_scene.environment.radiance(origin, direction, DVec3::ZERO)).as_vec3();
    [light.x, light.y, light.z, 1.0]
}

/// The four rough pixels around a point.
struct Around {
    /// The number of each, where it lies in the picture, and its share of the point.
    pixels: [(Option<usize>, f32); 4],
    /// What all of them, and those next to them, show.
    agreed: Option<SeenBody>,
}

impl RoughPicture<'_> {
    /// Returns the rough pixels whose rays lie around a point, which is given in rough pixels.
    fn around(&self, at: DVec2) -> Around {
        let from_ray = at - self.shift;
        let corner = from_ray.floor();
        let part = (from_ray - corner).as_vec2();
        let corner = corner.as_ivec2();
        let steps = [IVec2::ZERO, IVec2::X, IVec2::Y, IVec2::ONE];
        let shares = [
            (1.0 - part.x) * (1.0 - part.y),
            part.x * (1.0 - part.y),
            (1.0 - part.x) * part.y,
            part.x * part.y,
        ];
        let pixels = [0, 1, 2, 3].map(|k| (self.number(corner + steps[k]), shares[k]));
        Around { pixels, agreed: self.agreed(corner) }
    }

    /// Returns the body that the sixteen rough pixels around a point show, if they show the same; `corner` is the upper left of the
    /// middle four.
    fn agreed(&self, corner: IVec2) -> Option<SeenBody> {
        let first = self.bodies[self.number(corner)?];
        let own = (-1..=2).flat_map(|y| (-1..=2).map(move |x| corner + IVec2::new(x, y)));
        let mut own = own.map(|at| self.number(at).map(|k| self.bodies[k]));
        own.all(|body| body == Some(first)).then_some(first)
    }

    /// Returns the number of a pixel; `None` beside the picture.
    fn number(&self, at: IVec2) -> Option<usize> {
        let (width, height) = (self.picture.width as i32, self.picture.height as i32);
        let is_inside = at.x >= 0 && at.y >= 0 && at.x < width && at.y < height;
        is_inside.then_some((at.y * width + at.x) as usize)
    }

    /// Returns the light of a body at a point: of the rough pixels around it that show the body or, where none of these does, of
    /// all around it that show any.
    fn light(&self, around: &Around, body: u32) -> [f32; 4] {
        let mean = |is_taken: &dyn Fn(SeenBody) -> bool| {
            let (mut sum, mut all) = ([0.0; 4], 0.0);
            for (number, share) in around.pixels {
                let Some(k) = number.filter(|k| is_taken(self.bodies[*k])) else { continue };
                // Pixels that the point almost touches count even where their share is 0.
                let share = share + 1e-4;
                all += share;
                sum.iter_mut().zip(self.picture.pixels[k]).for_each(|(sum, light)| *sum += share * light);
            }
            (all > 0.0).then(|| sum.map(|channel| channel / all))
        };
        let [red, green, blue, _] = mean(&|seen| seen == Some(body))
            .or_else(|| mean(&|seen| seen.is_some()))
            .or_else(|| mean(&|_| true))
            .unwrap_or([0.0; 4]);
        [red, green, blue, 1.0]
    }
}
