//! Rough pictures of bodies in full resolution: outlines and the backplate are as fine as in a finished picture, and
//! only the light in the bodies is rough.

use super::Linear;
use brillianteer_scene::Film;
use brillianteer_trace::ray::FirstBodies;
use brillianteer_trace::sampling::{LitScene, colour};
use glam::{DAffine2, DMat2, DVec2, DVec3, IVec2};
use rayon::prelude::*;

/// The body at a point, by its index in the scene; `None` beside all bodies.
type SeenBody = Option<u32>;

/// A picture with few pixels, and the body at each.
struct RoughPicture<'a> {
    picture: &'a Linear,
    /// The places of its rays in its pixels, 0 to 1.
    shift: DVec2,
    bodies: Vec<SeenBody>,
    /// For each pixel, the body that it and the fifteen pixels from one before it to two after it both ways show,
    /// where all show the same.
    agreed: Vec<Option<SeenBody>>,
}

/// A picture that is being enlarged.
struct Enlargement<'a> {
    rough: RoughPicture<'a>,
    /// The map from the pixels of the large picture to those of the rough one.
    rough_from_fine: DAffine2,
    lit_scene: LitScene<'a>,
    first: FirstBodies<'a>,
    white: &'a [DVec3; 4],
}

/// Returns a rough picture with as many pixels as the film of `lit_scene`, which has the same subject. `rough_film`
/// is the film of the picture, `shift` the place of its rays in its pixels, 0 to 1, and `white` the response to light
/// that goes straight to the eye (`SamplePass::whole`).
///
/// A pixel that shows a body has the light of this body in the nearest pixels of the rough picture, interpolated. A
/// body too small to appear in any of these has their mean. A pixel beside all bodies shows the backdrop. Where all
/// rough pixels around agree on a body, the fine ones between them show it too; for the others, the body is found one
/// by one.
pub fn enlarged(
    rough: &Linear,
    (rough_film, shift): (&Film, DVec2),
    lit_scene: &LitScene,
    white: &[DVec3; 4],
) -> Linear {
    let film = lit_scene.film;
    let first = FirstBodies::new(lit_scene);
    let rough_from_fine =
        rough_film.pixels_from_image(DMat2::IDENTITY) * film.pixels_from_image(DMat2::IDENTITY).inverse();
    let fine_from_rough = rough_from_fine.inverse();
    let across = rough.width.max(1) as usize;
    let place = |k: usize| DVec2::new((k % across) as f64, (k / across) as f64);
    let points: Vec<DVec2> =
        (0..rough.pixels.len()).map(|k| fine_from_rough.transform_point2(place(k) + shift)).collect();
    let rough = RoughPicture::new(rough, shift, first.at(&points));
    let enlargement = Enlargement { rough, rough_from_fine, lit_scene: *lit_scene, first, white };
    let [width, height] = film.size;
    let pixels = (0..height).into_par_iter().flat_map_iter(|y| enlargement.row(y)).collect();
    Linear { width, height, pixels }
}

impl Enlargement<'_> {
    /// Returns a row of the large picture.
    fn row(&self, y: u32) -> Vec<[f32; 4]> {
        let middle = |x: u32| DVec2::new(f64::from(x), f64::from(y)) + 0.5;
        let arounds: Vec<Around> = (0..self.lit_scene.film.size[0])
            .map(|x| self.rough.around(self.rough_from_fine.transform_point2(middle(x))))
            .collect();
        let in_doubt = (0..).zip(&arounds).filter(|(_, around)| around.agreed.is_none());
        let points: Vec<DVec2> = in_doubt.map(|(x, _)| middle(x)).collect();
        let mut seen = self.first.at(&points).into_iter();
        let pixel = |(x, around): (u32, &Around)| match around.agreed.or_else(|| seen.next()).flatten() {
            Some(body) => self.rough.light(around, body),
            None => self.backdrop(middle(x)),
        };
        (0..).zip(&arounds).map(pixel).collect()
    }

    /// Returns the backdrop at a point of the picture, in pixels.
    fn backdrop(&self, at: DVec2) -> [f32; 4] {
        let environment = &self.lit_scene.environment;
        if !environment.backdrop {
            return [0.0; 4];
        }
        let (origin, direction) = self.first.camera.ray(self.lit_scene.film.image_from_pixels(at));
        let light = colour(self.white, environment.radiance(origin, direction, DVec3::ZERO)).as_vec3();
        [light.x, light.y, light.z, 1.0]
    }
}

/// The four rough pixels around a point.
struct Around {
    /// The number of each pixel in the picture, and its share of the point.
    pixels: [(Option<usize>, f32); 4],
    /// The body that all of them, and those next to them, show.
    agreed: Option<SeenBody>,
}

impl<'a> RoughPicture<'a> {
    fn new(picture: &'a Linear, shift: DVec2, bodies: Vec<SeenBody>) -> Self {
        let mut rough = Self { picture, shift, bodies, agreed: vec![] };
        let width = picture.width.max(1) as i32;
        let corner = |k: usize| IVec2::new(k as i32 % width, k as i32 / width);
        rough.agreed = (0..rough.bodies.len()).map(|k| rough.agreed_from(corner(k))).collect();
        rough
    }

    /// Returns the rough pixels whose rays lie around a point, which is given in rough pixels.
    fn around(&self, at: DVec2) -> Around {
        let from_ray = at - self.shift;
        let corner = from_ray.floor();
        let part = (from_ray - corner).as_vec2();
        let corner = corner.as_ivec2();
        let steps = [IVec2::ZERO, IVec2::X, IVec2::Y, IVec2::ONE];
        let [left, up] = [1.0 - part.x, 1.0 - part.y];
        let shares = [left * up, part.x * up, left * part.y, part.x * part.y];
        let pixels = [0, 1, 2, 3].map(|k| (self.number(corner + steps[k]), shares[k]));
        Around { pixels, agreed: pixels[0].0.and_then(|k| self.agreed[k]) }
    }

    /// Returns the body that the sixteen pixels around the middle of four show, if they show the same; `corner` is the upper
    /// left of the four.
    fn agreed_from(&self, corner: IVec2) -> Option<SeenBody> {
        let first = self.bodies[self.number(corner)?];
        for y in -1..=2 {
            for x in -1..=2 {
                if self.bodies[self.number(corner + IVec2::new(x, y))?] != first {
                    return None;
                }
            }
        }
        Some(first)
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
        let [red, green, blue, cover] = self
            .mean(around, |seen| seen == Some(body))
            .or_else(|| self.mean(around, |seen| seen.is_some()))
            .or_else(|| self.mean(around, |_| true))
            .unwrap_or([0.0; 4]);
        // Blends of several pictures may cover a pixel in part; the body covers all of it.
        let per = if cover > 0.0 { 1.0 / cover } else { 0.0 };
        [red * per, green * per, blue * per, 1.0]
    }

    /// Returns the mean of those rough pixels around a point whose body `is_taken` accepts; `None` where there is
    /// none.
    fn mean(&self, around: &Around, is_taken: impl Fn(SeenBody) -> bool) -> Option<[f32; 4]> {
        let (mut sum, mut all) = ([0.0; 4], 0.0);
        for (number, share) in around.pixels {
            let Some(k) = number.filter(|k| is_taken(self.bodies[*k])) else { continue };
            // Pixels that the point almost touches contribute even where their share is 0.
            let share = share + 1e-4;
            all += share;
            sum.iter_mut().zip(self.picture.pixels[k]).for_each(|(sum, light)| *sum += share * light);
        }
        (all > 0.0).then(|| sum.map(|channel| channel / all))
    }
}
