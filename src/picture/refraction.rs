//! Refraction maps: for each pixel the place on a background where the light behind it comes from. Traced once, looked up
//! ever after: a background that moves is refracted without tracing.
//!
//! A pixel has one place, that of the strongest path which reaches the background through it. The paths beside it, inner
//! reflections that come out elsewhere, are counted to its weight: what is white behind stays white. All light from
//! elsewhere is in the diffuse layer, as it is under the light given.

use super::{LUMINANCE, Linear};
use crate::math::Basis;
use crate::optics::Stratum;
use crate::scene::Panorama;
use crate::trace::ray::{Camera, Company, First, Waiting};
use crate::trace::sitting::{Look, Sitting};
use crate::trace::surround::{Surround, met_behind};
use crate::trace::{Stopped, Watch};
use glam::{DMat3, DVec2, DVec3};
use rayon::prelude::*;

/// Rows traced between two calls of the watch.
const PIECE: u32 = 8;

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
pub struct Place {
    /// Across the background, 0 at its left border, 1 at its right one.
    pub u: f32,
    /// Down the background, 0 at its upper border, 1 at its lower one.
    pub v: f32,
    /// The share of light from behind that reaches the eye, 0 to 1. Where it is 0 the place means nothing.
    pub weight: f32,
}

/// A map at one wavelength.
#[derive(Debug, Clone, PartialEq)]
pub struct MapBand {
    /// The wavelength in nm.
    pub nm: f64,
    /// The linear colour in which red, green and blue light of the background is seen that comes in this band alone: its
    /// columns. Over all bands the sum is 1.
    pub response: DMat3,
    /// Row by row from the top.
    pub places: Vec<Place>,
}

/// A picture of where light comes from.
#[derive(Debug, Clone, PartialEq)]
pub struct RefractionMap {
    /// Pixels across and down.
    pub size: [u32; 2],
    /// One band for all light, or several, so that the look-up keeps its rainbow.
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
    /// The wavelengths of the diffuse layer.
    pub shades: &'a [Stratum],
    /// Looks that the diffuse layer is made of, at least 1; the first is through the pixels' middles.
    pub looks: u32,
    /// What the diffuse layer's light is multiplied by.
    pub gain: f64,
}

/// How much of the light a map can show: means over what the stones cover.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Carried {
    /// The share of light that comes from the background.
    pub behind: f64,
    /// The part of it that comes from the places in the map themselves; the rest comes from others nearby or far.
    pub single: f64,
}

/// What is found of one row: its places band by band, its diffuse layer, and sums of what is carried with their number.
struct Row {
    places: Vec<Vec<Place>>,
    diffuse: Vec<[f32; 4]>,
    behind: f64,
    single: f64,
    hits: u32,
}

/// What is surveyed.
struct Scene<'a> {
    sitting: &'a Sitting<'a>,
    surround: Surround<'a>,
    plane: &'a Backdrop,
    camera: Camera,
    company: Company,
}

impl Backdrop {
    /// Where a ray meets the background; `None` where it passes it by.
    pub fn place(&self, eye: &Basis, from: DVec3, direction: DVec3) -> Option<DVec2> {
        let met = met_behind(eye, self.distance, from, direction).or_else(|| {
            let opposite = Basis { toward: -eye.toward, ..*eye };
            self.both_sides.then(|| met_behind(&opposite, self.distance, from, direction)).flatten()
        })?;
        let at = met * DVec2::new(1.0, -1.0) / self.size + 0.5;
        (at.cmpge(DVec2::ZERO).all() && at.cmple(DVec2::ONE).all()).then_some(at)
    }
}

impl RefractionMap {
    /// Traces a map of what a sitting shows; a photograph behind it is left out.
    ///
    /// # Errors
    /// [`Stopped`] when `watch` asks to stop.
    pub fn trace(
        sitting: &Sitting,
        plane: &Backdrop,
        survey: &Survey,
        watch: Watch,
    ) -> Result<(Self, Carried), Stopped> {
        let scene = Scene {
            sitting,
            surround: Surround { behind: None, ..sitting.surround },
            plane,
            camera: Camera::reaching(sitting.view, sitting.reach()),
            company: Company::new(sitting),
        };
        let looks = |strata, count: u32| -> Vec<(Look, Vec<Company>)> {
            let look = |number| Look::new(sitting.setting, strata, number);
            (0..count).map(look).map(|look| (look.clone(), scene.company.made_of(&look))).collect()
        };
        let (middle, shades) = (looks(survey.bands, 1), looks(survey.shades, survey.looks.max(1)));
        let [width, height] = sitting.film.size;
        let band = |s: &Stratum| {
            let [_, red, green, blue] = s.response;
            MapBand { nm: s.at(0.5), response: DMat3::from_cols(red, green, blue), places: Vec::new() }
        };
        let mut map = Self {
            size: [width, height],
            bands: survey.bands.iter().map(band).collect(),
            diffuse: Linear { width, height, pixels: Vec::new() },
        };
        let (mut carried, mut hits) = (Carried::default(), 0);
        for first in (0..height).step_by(PIECE as usize) {
            if watch(f64::from(first) / f64::from(height)).is_break() {
                return Err(Stopped);
            }
            let rows: Vec<Row> = (first..height.min(first + PIECE))
                .into_par_iter()
                .map(|y| scene.row(y, &middle[0].1, &shades, survey.gain))
                .collect();
            for row in rows {
                map.bands.iter_mut().zip(row.places).for_each(|(band, places)| band.places.extend(places));
                map.diffuse.pixels.extend(row.diffuse);
                carried.behind += row.behind;
                carried.single += row.single;
                hits += row.hits;
            }
        }
        let part = |of: f64, all: f64| if all > 0.0 { of / all } else { 0.0 };
        let rays = f64::from(hits) * survey.bands.len() as f64;
        let carried =
            Carried { behind: part(carried.behind, rays), single: part(carried.single, carried.behind) };
        Ok((map, carried))
    }
}

impl Scene<'_> {
    fn row(&self, y: u32, bands: &[Company], shades: &[(Look, Vec<Company>)], gain: f64) -> Row {
        let width = self.sitting.film.size[0];
        let mut row = Row {
            places: vec![Vec::with_capacity(width as usize); bands.len()],
            diffuse: Vec::with_capacity(width as usize),
            behind: 0.0,
            single: 0.0,
            hits: 0,
        };
        for x in 0..width {
            let corner = DVec2::new(f64::from(x), f64::from(y));
            let (start, first) = self.start(corner + 0.5);
            row.hits += u32::from(first.is_some());
            for (company, places) in bands.iter().zip(&mut row.places) {
                let (place, single) = self.strongest(company, &start, first);
                places.push(place);
                if first.is_some() {
                    row.behind += f64::from(place.weight);
                    row.single += single;
                }
            }
            let light: Shade = shades.iter().map(|(look, bands)| self.shade(look, bands, corner)).sum();
            row.diffuse.push(light.pixel(gain, shades.len()));
        }
        row
    }

    /// The ray through a point of the picture, in pixels, and the stone that it meets first.
    fn start(&self, at: DVec2) -> (Waiting, Option<First>) {
        let start = Waiting::from_eye(self.camera.ray(self.sitting.film.image_from_pixels(at)));
        (start, self.company.first(&start))
    }

    /// The strongest path to the background with the weight of all of them, and its own.
    fn strongest(&self, company: &Company, start: &Waiting, first: Option<First>) -> (Place, f64) {
        let (mut at, mut most, mut sum) = (DVec2::ZERO, 0.0, 0.0);
        let mut leave = |ray: &Waiting| {
            if let Some(place) = self.plane.place(&self.surround.eye, ray.origin, ray.direction) {
                sum += ray.weight;
                if ray.weight > most {
                    (at, most) = (place, ray.weight);
                }
            }
        };
        match &first {
            Some(first) => drop(company.follow(start, first, leave)),
            None => leave(start),
        }
        (Place { u: at.x as f32, v: at.y as f32, weight: sum.min(1.0) as f32 }, most)
    }

    /// What one look sees at a pixel.
    fn shade(&self, look: &Look, bands: &[Company], corner: DVec2) -> Shade {
        let (start, first) = self.start(corner + look.shift);
        let mut light = Shade::default();
        let Some(first) = first else {
            light.behind = DVec3::ONE;
            return light;
        };
        for (company, response) in bands.iter().zip(&look.responses) {
            company.follow(&start, &first, |ray| {
                let way = look.middle(ray.direction, ray.sweep);
                if self.plane.place(&self.surround.eye, ray.origin, way).is_some() {
                    light.behind += response[1..].iter().sum::<DVec3>() * ray.weight;
                } else {
                    let arriving = self.surround.radiance(ray.origin, way, ray.sweep) * ray.weight;
                    let seen = response.iter().zip(arriving.to_array()).map(|(&c, l)| c * l);
                    light.elsewhere += seen.sum::<DVec3>();
                }
            });
        }
        light
    }
}

/// Linear light of a pixel: from a white background, and from elsewhere.
#[derive(Clone, Copy, Default)]
struct Shade {
    behind: DVec3,
    elsewhere: DVec3,
}

impl std::iter::Sum for Shade {
    fn sum<I: Iterator<Item = Self>>(all: I) -> Self {
        all.fold(Self::default(), |a, b| Self {
            behind: a.behind + b.behind,
            elsewhere: a.elsewhere + b.elsewhere,
        })
    }
}

impl Shade {
    /// The diffuse layer's pixel, of the sum of so many looks.
    fn pixel(&self, gain: f64, looks: usize) -> [f32; 4] {
        let share = 1.0 / looks as f64;
        let [red, green, blue] = (self.elsewhere * share * gain).as_vec3().to_array();
        let white = self.behind.dot(DVec3::from_array(LUMINANCE.map(f64::from))) * share;
        [red, green, blue, 1.0 - white.clamp(0.0, 1.0) as f32]
    }
}

/// Refracts a background by a map: linear light, all covered.
///
/// The background fills the map's plane and is cut where it is longer. It is looked up between its four nearest pixels;
/// one much finer than the map is best halved before.
pub fn refract(map: &RefractionMap, background: &Panorama) -> Linear {
    let [width, height] = map.size;
    let shape = f64::from(width) / f64::from(height.max(1));
    let whole = DVec2::new(f64::from(background.width), f64::from(background.height));
    let scale = whole.y.min(whole.x / shape) * DVec2::new(shape, 1.0);
    let mut picture = map.diffuse.clone().whole();
    picture.pixels.par_iter_mut().enumerate().for_each(|(k, pixel)| {
        let [red, green, blue, _] = pixel.map(f64::from);
        let mut light = DVec3::new(red, green, blue);
        for band in &map.bands {
            let Place { u, v, weight } = band.places.get(k).copied().unwrap_or_default();
            if weight > 0.0 {
                let at = (DVec2::new(f64::from(u), f64::from(v)) - 0.5) * scale + 0.5 * whole - 0.5;
                light += band.response * background.between(at) * f64::from(weight);
            }
        }
        let [red, green, blue] = light.as_vec3().to_array();
        *pixel = [red, green, blue, 1.0];
    });
    picture
}
