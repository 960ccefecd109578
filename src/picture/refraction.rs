//! Refraction maps: for each pixel the place on a background where the light behind it comes from. Traced once, looked up
//! ever after: a background that moves is refracted without tracing.
//!
//! A pixel has one place, that of the strongest path which reaches the background through it, or several. The paths beside
//! them, inner reflections that come out elsewhere, are counted to the weight of the nearest: what is white behind stays
//! white. All light from elsewhere is in the diffuse layer, as it is under the light given.

mod trace;

use super::develop::{exposed, shown};
use super::{Develop, Linear};
use crate::math::Basis;
use crate::optics::Stratum;
use crate::scene::Panorama;
use crate::trace::environment::backplate_point;
use glam::{DMat3, DVec2, DVec3};
use rayon::prelude::*;

/// The plane that a background hangs on behind the stones, square to the axis to the eye.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Backdrop {
    /// Its distance behind the origin, in world units.
    pub distance: f64,
    /// Its width and height, in world units; its middle lies on the axis.
    pub size: DVec2,
    /// Whether the same picture, as in a mirror, hangs as far before the stones too, where only they see it. Light that
    /// a stone sends back toward the eye's side, most of that of a brilliant, then comes from it.
    pub both_sides: bool,
}

/// Where light comes from: a place on the background, and how much of it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SourcePlace {
    /// Across the background, 0 at its left border, 1 at its right one.
    pub u: f32,
    /// Down the background, 0 at its upper border, 1 at its lower one.
    pub v: f32,
    /// The share of light from behind that reaches the eye, 0 to 1. Where it is 0 the place means nothing.
    pub weight: f32,
}

/// One place of each pixel at one wavelength.
#[derive(Debug, Clone, PartialEq)]
pub struct MapBand {
    /// The wavelength in nm.
    pub nm: f64,
    /// The linear colour in which red, green and blue light of the background is seen that comes in this band alone: its
    /// columns. Over all bands the sum is 1; where pixels have several places, each is of a band of its own, one after the
    /// other, and all of them have the same response.
    pub response: DMat3,
    /// Row by row from the top.
    pub places: Vec<SourcePlace>,
}

/// A picture of where light comes from.
#[derive(Debug, Clone, PartialEq)]
pub struct RefractionMap {
    /// Pixels across and down.
    pub size: [u32; 2],
    /// One band for all light, or several, so that the look-up keeps its rainbow; each as often as pixels have places.
    pub bands: Vec<MapBand>,
    /// The diffuse layer: light that does not come from the background, premultiplied, and as cover what it hides of the
    /// background: 1 less the weight, as seen in white light and evened out over the pixel.
    pub diffuse: Linear,
}

/// How a map is traced.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Survey<'a> {
    /// The map's bands.
    pub bands: &'a [Stratum],
    /// Places of a pixel in each band, at least 1: of more, what is seen twice through a pixel is looked up twice.
    pub places: u32,
    /// The wavelengths of the diffuse layer.
    pub shades: &'a [Stratum],
    /// Looks that the diffuse layer is made of, at least 1; the first is through the pixels' middles.
    pub looks: u32,
}

/// How much of the light a map can show: means over what the stones cover.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Carried {
    /// The share of light that comes from the background.
    pub behind: f64,
    /// The part of it that comes from the places in the map themselves; the rest comes from others nearby or far.
    pub single: f64,
}

impl Backdrop {
    /// Where a ray meets the background; `None` where it passes it by.
    pub fn place(&self, eye: &Basis, from: DVec3, direction: DVec3) -> Option<DVec2> {
        let met = backplate_point(eye, self.distance, from, direction).or_else(|| {
            let opposite = Basis { toward: -eye.toward, ..*eye };
            self.both_sides.then(|| backplate_point(&opposite, self.distance, from, direction)).flatten()
        })?;
        let at = met * DVec2::new(1.0, -1.0) / self.size + 0.5;
        (at.cmpge(DVec2::ZERO).all() && at.cmple(DVec2::ONE).all()).then_some(at)
    }
}

impl RefractionMap {
    /// The same map with its diffuse layer developed as a render is, by exposure and tone, but without glow. The background
    /// shows as it is.
    pub fn developed(mut self, manner: &Develop) -> Self {
        self.diffuse = exposed(self.diffuse, &Develop { bloom: None, ..*manner });
        self.diffuse.pixels.iter_mut().for_each(|pixel| *pixel = shown(*pixel, manner));
        self
    }
}

/// Refracts a background by a map: linear light, all covered.
///
/// The background fills the map's plane and is cut where it is longer; it is moved to the left and up by `offset`, in parts
/// of itself, and goes on beyond its borders as in a mirror. It is looked up between its four nearest pixels; one much finer
/// than the map is best halved before.
pub fn refract(map: &RefractionMap, background: &Panorama, offset: DVec2) -> Linear {
    let [width, height] = map.size;
    let shape = f64::from(width) / f64::from(height.max(1));
    let whole = DVec2::new(f64::from(background.width), f64::from(background.height));
    let scale = whole.y.min(whole.x / shape) * DVec2::new(shape, 1.0);
    let mut picture = map.diffuse.clone().whole();
    picture.pixels.par_iter_mut().enumerate().for_each(|(k, pixel)| {
        let [red, green, blue, _] = pixel.map(f64::from);
        let mut light = DVec3::new(red, green, blue);
        for band in &map.bands {
            let SourcePlace { u, v, weight } = band.places.get(k).copied().unwrap_or_default();
            if weight > 0.0 {
                let at = (DVec2::new(f64::from(u), f64::from(v)) - 0.5) * scale + (0.5 + offset) * whole;
                let folded = whole - (at.rem_euclid(2.0 * whole) - whole).abs();
                light += band.response * background.between(folded - 0.5) * f64::from(weight);
            }
        }
        let [red, green, blue] = light.as_vec3().to_array();
        *pixel = [red, green, blue, 1.0];
    });
    picture
}
