//! Refraction maps: for each pixel, the place on a background where the light behind it comes from. A map is traced once
//! and then looked up, so that a background that moves is refracted without tracing.
//!
//! A pixel has one place, that of the strongest path that reaches the background through it, or several. Other paths,
//! such as inner reflections that come out elsewhere, add their weight to the nearest place, so that a white background
//! stays white. All light from elsewhere is in the diffuse layer, as it appears under the given light.

mod trace;

use super::develop::{exposed, shown};
use super::{Develop, Linear};
use brillianteer_math::Basis;
use brillianteer_optics::Strata;
use brillianteer_scene::Panorama;
use brillianteer_trace::environment::backplate_point;
use glam::{DMat3, DVec2, DVec3};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// The plane behind the stones on which a background hangs, perpendicular to the axis to the eye.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Backdrop {
    /// Distance of the plane behind the origin, in world units.
    pub distance: f64,
    /// Width and height of the plane, in world units; its middle lies on the axis.
    pub size: DVec2,
    /// True where the same picture, mirrored, also hangs at the same distance in front of the stones, where only they
    /// see it. Light that a stone sends back toward the eye's side then comes from it; in a brilliant that is most of
    /// the light.
    pub both_sides: bool,
}

/// A place on the background from which light comes, with its weight.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SourcePlace {
    /// Position across the background, 0 at its left border, 1 at its right one.
    pub u: f32,
    /// Position down the background, 0 at its upper border, 1 at its lower one.
    pub v: f32,
    /// The share of light from the background that reaches the eye, 0 to 1. Where it is 0, the place has no meaning.
    pub weight: f32,
}

/// The places of all pixels at one wavelength.
#[derive(Debug, Clone, PartialEq)]
pub struct MapBand {
    /// The wavelength in nm.
    pub nm: f64,
    /// The linear colours, as columns, in which red, green and blue light of the background is seen through this band
    /// alone.
    ///
    /// Over all bands the sum is 1. Where pixels have several places, each place is in a band of its own, one after the
    /// other, and all of these have the same response.
    pub response: DMat3,
    /// The places, row by row from the top.
    pub places: Vec<SourcePlace>,
}

/// A picture whose pixels give the places that their light comes from.
#[derive(Debug, Clone, PartialEq)]
pub struct RefractionMap {
    /// The number of pixels across and down.
    pub size: [u32; 2],
    /// The bands: one for all light, or several, so that the look-up keeps the rainbow. Each occurs as often as
    /// pixels have places.
    pub bands: Vec<MapBand>,
    /// The diffuse layer: light that does not come from the background, premultiplied. Its cover is the part of the
    /// background that it hides: 1 less the weight, for white light and averaged over the pixel.
    pub diffuse: Linear,
}

/// The settings by which a map is traced.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Survey<'a> {
    /// The map's bands, which are whole strata.
    pub bands: &'a Strata,
    /// The number of places of a pixel in each band, at least 1. With more, two views through one pixel are both
    /// looked up.
    pub places: u32,
    /// The wavelengths at which the diffuse layer is traced.
    pub shades: &'a Strata,
    /// The number of sample passes of the diffuse layer, at least 1; the first goes through the pixels' middles.
    pub passes: u32,
    /// The part of the turn by refraction that light follows, 0 to 1; 1 is physics.
    pub strength: f64,
}

/// The share of the light that a map can show, as means over the pixels that the stones cover.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Carried {
    /// The share of light that comes from the background.
    pub behind: f64,
    /// The part of that light that comes from the map's places themselves; the rest comes from other places, near or
    /// far.
    pub single: f64,
}

impl Backdrop {
    /// Returns the place where a ray meets the background, 0 to 1 across and down; `None` where it passes by.
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
    /// Returns the same map with its diffuse layer developed like a render, by exposure and tone but without glare. The
    /// background is not developed.
    pub fn developed(mut self, manner: &Develop) -> Self {
        let gain = manner.gain();
        self.diffuse = self.diffuse.whole();
        self.diffuse.pixels.iter_mut().for_each(|pixel| *pixel = shown(exposed(pixel, gain), manner));
        self
    }
}

/// Refracts a background by a map. The result is linear light, and all pixels are covered.
///
/// The background fills the map's plane and is cut where it is longer. It is shifted to the left and up by `offset`, in
/// parts of itself, and continues beyond its borders as in a mirror. The look-up interpolates between the four nearest
/// pixels, so a background much finer than the map is best halved before.
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
