//! Traces refraction maps.

use super::{Backdrop, Carried, MapBand, RefractionMap, SourcePlace, Survey};
use crate::{LUMINANCE, Linear};
use brillianteer_base::{Stopped, Watch};
use brillianteer_optics::Stratum;
use brillianteer_trace::DispersedRay;
use brillianteer_trace::environment::Environment;
use brillianteer_trace::ray::{Camera, First, SceneTracer, WaitingRay};
use brillianteer_trace::sampling::{LitScene, SamplePass, Sampling, colour};
use glam::{DMat3, DVec2, DVec3};
use rayon::prelude::*;

/// Places nearer to one another than this, in pixels of the picture, count as one.
const SAME: f64 = 0.25;

/// The number of rows traced between two calls of the watch.
const PIECE: u32 = 8;

/// A row of a map: its places band by band, its diffuse layer, and the sums for [`Carried`] with the number of their
/// pixels.
struct Row {
    places: Vec<Vec<SourcePlace>>,
    diffuse: Vec<[f32; 4]>,
    behind: f64,
    single: f64,
    hits: u32,
}

/// The scene and the plane of a map.
struct MapScene<'a> {
    lit_scene: &'a LitScene<'a>,
    environment: Environment<'a>,
    plane: &'a Backdrop,
    /// Width and height of the plane in pixels of the picture, seen straight on.
    pixels: DVec2,
    camera: Camera,
    tracer: SceneTracer,
}

impl RefractionMap {
    /// Traces a map of a lit scene; a photograph behind the scene is left out.
    ///
    /// # Errors
    /// Fails with [`Stopped`] when `watch` stops the work.
    pub fn trace(
        lit_scene: &LitScene,
        plane: &Backdrop,
        survey: &Survey,
        watch: Watch,
    ) -> Result<(Self, Carried), Stopped> {
        let scene = MapScene {
            lit_scene,
            environment: Environment { backplate: None, ..lit_scene.environment },
            plane,
            pixels: plane.size / lit_scene.film.pixel,
            camera: Camera::reaching(lit_scene.view, lit_scene.scene.reach()),
            tracer: SceneTracer::new(lit_scene),
        };
        let passes = |strata, count: u32| -> Vec<(SamplePass, Vec<SceneTracer>)> {
            let strength = survey.strength;
            let sampling = Sampling { stretches: false, strength, ..Sampling::of(survey.passes) };
            let pass = |number| sampling.pass(lit_scene.scene, strata, number);
            (0..count).map(pass).map(|pass| (pass.clone(), scene.tracer.made_of(&pass))).collect()
        };
        let (middle, shades) = (passes(survey.bands, 1), passes(survey.shades, survey.passes.max(1)));
        let [width, height] = lit_scene.film.size;
        let band = |s: &Stratum| {
            let [_, red, green, blue] = s.response;
            MapBand { nm: s.at(0.5), response: DMat3::from_cols(red, green, blue), places: Vec::new() }
        };
        let places = survey.places.max(1) as usize;
        let mut map = Self {
            size: [width, height],
            bands: survey
                .bands
                .whole()
                .iter()
                .flat_map(|s| std::iter::repeat_n(s, places))
                .map(band)
                .collect(),
            diffuse: Linear { width, height, pixels: Vec::new() },
        };
        let (mut carried, mut hits) = (Carried::default(), 0);
        for first in (0..height).step_by(PIECE as usize) {
            if watch(f64::from(first) / f64::from(height)).is_break() {
                return Err(Stopped);
            }
            let rows: Vec<Row> = (first..height.min(first + PIECE))
                .into_par_iter()
                .map(|y| scene.row(y, (&middle[0], places), &shades))
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
        let rays = f64::from(hits) * survey.bands.whole().len() as f64;
        let carried =
            Carried { behind: part(carried.behind, rays), single: part(carried.single, carried.behind) };
        Ok((map, carried))
    }
}

impl MapScene<'_> {
    fn row(
        &self,
        y: u32,
        ((pass, bands), places): (&(SamplePass, Vec<SceneTracer>), usize),
        shades: &[(SamplePass, Vec<SceneTracer>)],
    ) -> Row {
        let width = self.lit_scene.film.size[0];
        let mut row = Row {
            places: vec![Vec::with_capacity(width as usize); bands.len() * places],
            diffuse: Vec::with_capacity(width as usize),
            behind: 0.0,
            single: 0.0,
            hits: 0,
        };
        for x in 0..width {
            let corner = DVec2::new(f64::from(x), f64::from(y));
            let (start, first) = self.start(corner + 0.5);
            row.hits += u32::from(first.is_some());
            for (tracer, columns) in bands.iter().zip(row.places.chunks_mut(places)) {
                let (found, own) = self.strongest((tracer, pass), &start, first, places);
                let all: f64 = found.iter().map(|place| f64::from(place.weight)).sum();
                let padded = found.into_iter().chain(std::iter::repeat(SourcePlace::default()));
                columns.iter_mut().zip(padded).for_each(|(column, place)| column.push(place));
                if first.is_some() {
                    row.behind += all;
                    row.single += own;
                }
            }
            let light: Shade = shades.iter().map(|(pass, bands)| self.shade(pass, bands, corner)).sum();
            row.diffuse.push(light.pixel(shades.len()));
        }
        row
    }

    fn eye_ray(&self, at: DVec2) -> DispersedRay {
        let (origin, direction) = self.camera.ray(self.lit_scene.film.image_from_pixels(at));
        DispersedRay::new(origin, direction)
    }

    /// Returns the ray through a point of the picture, in pixels, and the stone that it meets first.
    fn start(&self, at: DVec2) -> (WaitingRay, Option<First>) {
        let start = WaitingRay::from_eye(self.eye_ray(at));
        (start, self.tracer.first(&start))
    }

    /// Returns the places of the strongest paths to the background, `most` at most, and the weight of these paths alone.
    /// The places together have the weight of all paths.
    fn strongest(
        &self,
        (tracer, pass): (&SceneTracer, &SamplePass),
        start: &WaitingRay,
        first: Option<First>,
        most: usize,
    ) -> (Vec<SourcePlace>, f64) {
        let mut paths: Vec<(DVec2, f64)> = vec![];
        let mut leave = |ray: &WaitingRay| {
            let seen = looked_up(pass, start, ray);
            let met = self.plane.place(&self.environment.eye, seen.origin, seen.direction);
            paths.extend(met.filter(|_| ray.weight > 0.0).map(|place| (place, ray.weight)));
        };
        match &first {
            Some(first) => drop(tracer.follow(start, first, leave)),
            None => leave(start),
        }
        // The sort is stable: among equally strong paths the first stays first.
        paths.sort_by(|a, b| b.1.total_cmp(&a.1));
        let (mut kept, mut own): (Vec<(DVec2, f64)>, f64) = (Vec::with_capacity(most), 0.0);
        for (at, weight) in paths {
            let apart = |kept: &(DVec2, f64)| ((kept.0 - at) * self.pixels).length_squared();
            let nearest = (0..kept.len()).min_by(|&a, &b| apart(&kept[a]).total_cmp(&apart(&kept[b])));
            match nearest {
                Some(nearest) if kept.len() == most || apart(&kept[nearest]) < SAME * SAME => {
                    kept[nearest].1 += weight;
                }
                _ => {
                    kept.push((at, weight));
                    own += weight;
                }
            }
        }
        // Rounding may make the sum greater than 1.
        let scale = 1.0 / kept.iter().map(|(_, weight)| weight).sum::<f64>().max(1.0);
        let place = |(at, weight): (DVec2, f64)| SourcePlace {
            u: at.x as f32,
            v: at.y as f32,
            weight: (weight * scale) as f32,
        };
        (kept.into_iter().map(place).collect(), own)
    }

    /// Returns the light of a pixel in one sample pass.
    fn shade(&self, pass: &SamplePass, bands: &[SceneTracer], corner: DVec2) -> Shade {
        let (start, first) = self.start(corner + pass.shift);
        let mut light = Shade::default();
        let Some(first) = first else {
            light.behind = DVec3::ONE;
            return light;
        };
        for (tracer, response) in bands.iter().zip(&pass.responses) {
            tracer.follow(&start, &first, |ray| {
                let seen = looked_up(pass, &start, ray);
                if self.plane.place(&self.environment.eye, seen.origin, seen.direction).is_some() {
                    light.behind += response[1..].iter().sum::<DVec3>() * ray.weight;
                } else {
                    let arriving = self.environment.radiance_around(&seen, 0.0);
                    light.elsewhere += colour(response, arriving * ray.weight);
                }
            });
        }
        light
    }
}

/// Returns the ray along which the light of a ray that has left all stones is looked up; `start` is the ray from the eye.
///
/// Only refracted light is mixed with the straight ray, as in renders.
fn looked_up(pass: &SamplePass, start: &WaitingRay, ray: &WaitingRay) -> DispersedRay {
    if ray.is_reflected() { ray.ray } else { pass.mixed(&start.ray, &ray.ray) }
}

/// Linear light of a pixel: that of a white background, and that from elsewhere.
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
    /// Returns the diffuse layer's pixel, given the number of sample passes in this sum.
    fn pixel(&self, passes: usize) -> [f32; 4] {
        let share = 1.0 / passes as f64;
        let [red, green, blue] = (self.elsewhere * share).as_vec3().to_array();
        let white = self.behind.dot(DVec3::from_array(LUMINANCE.map(f64::from))) * share;
        [red, green, blue, 1.0 - white.clamp(0.0, 1.0) as f32]
    }
}
