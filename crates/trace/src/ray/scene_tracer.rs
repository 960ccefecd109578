//! Traces pictures under light by point rays, through several stones and bodies of metal and from one to the next.

use super::lobe_luck::LobeLuck;
use super::metal_tracer::{MetalHit, MetalTracer, nearest_metal, wider};
use super::roulette::Sieve;
use super::sight::{Met, nearest};
use super::{Camera, Exit, InstanceTracer, Loss, MeetingRay, PathLight, Roulette};
use crate::DispersedRay;
use crate::packet::{EyeRay, PacketTracer};
use crate::sampling::{LitScene, MOST_WAITING, ProgressiveImage, RadiancePixel, SamplePass, colour};
use brillianteer_base::{Stopped, Watch};
use brillianteer_scene::Medium;
use glam::{DVec2, DVec4};
use rayon::prelude::*;
use std::ops::Range;

/// Rows traced between two calls of the watch.
const PIECE: usize = 8;

/// The most reflections by metal on a ray's way; light that would be reflected once more is unresolved.
const MOST_REFLECTIONS: u32 = 256;

/// A tracer of several stones, each of one medium, and of metal. It also follows light from one body to the next.
#[derive(Clone)]
pub struct SceneTracer {
    tracers: Vec<InstanceTracer>,
    metals: Vec<MetalTracer>,
    least_weight: f64,
}

/// A ray on its way, and the body that it has left.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WaitingRay {
    /// The ray, with its change over the range that it represents.
    pub ray: DispersedRay,
    /// The share of the light from that direction that reaches the eye.
    pub weight: f64,
    /// The chance by which weak light goes on in solids that are not convex and to other bodies; `None` where all
    /// light is followed.
    pub roulette: Option<Roulette>,
    /// The side, in radians, of the square of directions that the ray represents, because all rough metal and all
    /// frosted facets on its way spread light; 0 for one direction.
    pub spread: f64,
    /// The polarisation of light that has left a stone and meets another one, at any weight above 0; `None` where the
    /// light is not polarised. Metal is taken to leave light unpolarised.
    light: Option<PathLight>,
    left: LeftBody,
    /// The number of bounces inside stones so far.
    bounces: u32,
    /// The number of reflections by metal so far.
    reflections: u32,
    luck: LobeLuck,
}

/// The body that a ray has just left.
#[derive(Debug, Clone, Copy, PartialEq)]
enum LeftBody {
    /// No body: the ray comes from the eye.
    Eye,
    Stone(usize),
    /// A body of metal, and the triangle of it that the ray has left.
    Metal(usize, u32),
}

impl LeftBody {
    fn stone(self) -> Option<usize> {
        if let Self::Stone(stone) = self { Some(stone) } else { None }
    }

    fn metal(self) -> Option<(usize, u32)> {
        if let Self::Metal(metal, triangle) = self { Some((metal, triangle)) } else { None }
    }
}

impl WaitingRay {
    /// Returns a ray from the eye.
    pub fn from_eye(ray: DispersedRay) -> Self {
        Self {
            ray,
            weight: 1.0,
            roulette: None,
            spread: 0.0,
            light: None,
            left: LeftBody::Eye,
            bounces: 0,
            reflections: 0,
            luck: LobeLuck::default(),
        }
    }

    /// Returns whether metal has reflected the ray.
    pub fn is_reflected(&self) -> bool {
        self.reflections > 0
    }
}

impl SceneTracer {
    /// Prepares the bodies of a scene; [`made_of`](Self::made_of) gives them their media.
    pub fn new(lit_scene: &LitScene) -> Self {
        let (stones, options) = (&lit_scene.scene.instances, lit_scene.options);
        Self {
            tracers: InstanceTracer::of_all(stones, options, |_| Medium::clear(1.0)),
            metals: MetalTracer::of_all(&lit_scene.scene.metals),
            least_weight: lit_scene.options.least_weight,
        }
    }

    /// Returns the bodies with their media in each band of a sample pass.
    pub fn made_of(&self, pass: &SamplePass) -> Vec<Self> {
        let of_band = |band: usize| {
            let made = |(tracer, media): (&InstanceTracer, &Vec<Medium>)| tracer.made_of(media[band]);
            Self {
                tracers: self.tracers.iter().zip(&pass.media).map(made).collect(),
                metals: self
                    .metals
                    .iter()
                    .zip(&pass.metals)
                    .map(|(m, bands)| m.made_of(bands[band]))
                    .collect(),
                least_weight: self.least_weight,
            }
        };
        (0..pass.responses.len()).map(of_band).collect()
    }

    /// Returns the body that a ray meets first, and where; `None` where it meets none.
    pub fn first(&self, ray: &WaitingRay) -> Option<First> {
        self.first_body(ray).map(First)
    }

    fn first_body(&self, ray: &WaitingRay) -> Option<FirstBody> {
        let way = (ray.ray.origin, ray.ray.direction);
        let stone = nearest(&self.tracers, way, ray.left.stone());
        let metal = nearest_metal(&self.metals, way, ray.left.metal());
        match (stone, metal) {
            (Some(met), Some(hit)) if hit.distance > met.1.1 => Some(FirstBody::Stone(met)),
            (_, Some(hit)) => Some(FirstBody::Metal(hit)),
            (met, None) => met.map(FirstBody::Stone),
        }
    }

    /// Follows a ray through all bodies, beginning with the body that it is known to meet, and calls `leave` for each
    /// ray that meets no further body.
    pub fn follow(&self, start: &WaitingRay, first: &First, mut leave: impl FnMut(&WaitingRay)) -> Loss {
        let mut waiting = Vec::new();
        let mut rest = self.onward(start, first.0, &mut waiting, &mut leave);
        while let Some((ray, first)) = waiting.pop() {
            let more = self.onward(&ray, first, &mut waiting, &mut leave);
            rest = rest.and(&more);
        }
        rest
    }

    /// Follows a ray through the body that it meets. Light that then meets another body is added to `waiting`.
    fn onward(
        &self,
        ray: &WaitingRay,
        first: FirstBody,
        waiting: &mut Vec<(WaitingRay, FirstBody)>,
        leave: impl FnMut(&WaitingRay),
    ) -> Loss {
        match first {
            FirstBody::Stone(met) => self.through(ray, met, waiting, leave),
            FirstBody::Metal(hit) => self.reflect(ray, &hit, waiting, leave),
        }
    }

    /// Follows a ray through one stone.
    fn through(
        &self,
        ray: &WaitingRay,
        (stone, met): Met,
        waiting: &mut Vec<(WaitingRay, FirstBody)>,
        mut leave: impl FnMut(&WaitingRay),
    ) -> Loss {
        let (mut unseen, mut number, before) = (0.0, 0, ray.bounces);
        let mut sieve = ray.roulette.map(|roulette| roulette.sieve());
        let is_frosted = self.tracers[stone].is_frosted();
        let exits = |exit: Exit, light: &dyn Fn() -> Option<PathLight>| {
            let Exit { point: origin, direction, fan, shift, weight, spread, .. } = exit;
            number += 1;
            let ray = WaitingRay {
                ray: DispersedRay { origin, direction, fan, shift },
                weight,
                roulette: ray.roulette.map(|roulette| roulette.beyond(number)),
                spread: wider(spread, ray.spread),
                light: None,
                left: LeftBody::Stone(stone),
                bounces: before + exit.bounce,
                reflections: ray.reflections,
                luck: if is_frosted { ray.luck.beyond(number).later() } else { ray.luck.beyond(number) },
            };
            match self.first_body(&ray) {
                Some(first) => unseen += self.wait((ray, light), first, sieve.as_mut(), waiting),
                None => leave(&ray),
            }
        };
        let &WaitingRay { ray: own, weight, roulette, light, luck, .. } = ray;
        let meeting = MeetingRay { met, ray: own, weight, roulette, light, luck: Some(luck) };
        let is_taken = |exit: &Exit, distance: f64| self.meets_before(exit, stone, distance);
        let rest = self.tracers[stone].follow_light(&meeting, is_taken, exits).unwrap_or_default();
        Loss { unresolved: rest.unresolved + unseen, bounces: before + rest.bounces, ..rest }
    }

    /// Reflects a ray at metal, and adds it to `waiting` where it meets another body.
    fn reflect(
        &self,
        ray: &WaitingRay,
        hit: &MetalHit,
        waiting: &mut Vec<(WaitingRay, FirstBody)>,
        mut leave: impl FnMut(&WaitingRay),
    ) -> Loss {
        let lost = |absorbed: f64, unresolved: f64| Loss { absorbed, unresolved, bounces: ray.bounces };
        if ray.reflections == MOST_REFLECTIONS {
            return lost(0.0, ray.weight);
        }
        let (luck, later) = ray.luck.draw();
        let Some(found) = self.metals[hit.metal].reflect(&ray.ray, hit, luck) else {
            return lost(ray.weight, 0.0);
        };
        let next = WaitingRay {
            ray: found.ray,
            weight: ray.weight * found.weight,
            roulette: ray.roulette.map(|roulette| roulette.beyond(1)),
            spread: wider(found.spread, ray.spread),
            light: None,
            left: LeftBody::Metal(hit.metal, hit.triangle),
            bounces: ray.bounces,
            reflections: ray.reflections + 1,
            luck: later,
        };
        let absorbed = ray.weight - next.weight;
        let Some(first) = self.first_body(&next) else {
            leave(&next);
            return lost(absorbed, 0.0);
        };
        let mut sieve = ray.roulette.map(|roulette| roulette.sieve());
        lost(absorbed, self.wait((next, &|| None), first, sieve.as_mut(), waiting))
    }

    /// Adds light that meets another body to `waiting`, weak light only by chance where there is a roulette; the
    /// function beside the ray computes the light's polarisation. Returns the weight of the light that is not followed.
    fn wait(
        &self,
        (mut ray, light): (WaitingRay, &dyn Fn() -> Option<PathLight>),
        first: FirstBody,
        sieve: Option<&mut Sieve>,
        waiting: &mut Vec<(WaitingRay, FirstBody)>,
    ) -> f64 {
        let has_room = waiting.len() < MOST_WAITING;
        match sieve {
            Some(sieve) => {
                let Some(weight) = sieve.pass(ray.weight) else { return 0.0 };
                ray.weight = weight;
            }
            None if ray.weight <= self.least_weight => return ray.weight,
            None => {}
        }
        if !has_room {
            return ray.weight;
        }
        if matches!(first, FirstBody::Stone(_)) {
            ray.light = light();
        }
        waiting.push((ray, first));
        0.0
    }

    /// Returns whether light that has left a stone meets another body at less than this distance.
    fn meets_before(&self, exit: &Exit, left: usize, distance: f64) -> bool {
        let way = (exit.point, exit.direction);
        let near = |&(k, tracer): &(usize, &InstanceTracer)| k != left && tracer.is_near(way);
        let met = |(_, tracer): (_, &InstanceTracer)| tracer.meet(way.0, way.1).map(|(_, distance)| distance);
        self.tracers.iter().enumerate().filter(near).filter_map(met).any(|other| other < distance)
            || nearest_metal(&self.metals, way, None).is_some_and(|hit| hit.distance < distance)
    }
}

/// The body that a ray meets first, and the place where it meets the body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct First(FirstBody);

/// The first hit of a ray, on a stone or on a body of metal.
#[derive(Debug, Clone, Copy, PartialEq)]
enum FirstBody {
    Stone(Met),
    Metal(MetalHit),
}

/// The tracer of the rays of a picture under light.
enum RayTracer<'a> {
    /// Packets in single precision, which are quicker.
    Packets(Box<PacketTracer<'a>>),
    /// Single rays in double precision.
    Single(SceneTracer),
}

/// Rows of a picture under light, traced by the processor.
pub struct ByRays<'a> {
    lit_scene: LitScene<'a>,
    camera: Camera,
    tracer: RayTracer<'a>,
    rows: Range<u32>,
    passes: u32,
    sums: Vec<RadiancePixel>,
}

impl<'a> ByRays<'a> {
    /// The most rows to trace at once: the sums of their passes are held in memory.
    pub const MOST_ROWS: u32 = 256;

    /// Prepares some rows of a picture. They are traced by packets of rays in single precision where these can follow
    /// light through all bodies, and otherwise by single rays in double precision. Metal, triangles, frosted facets,
    /// and bodies farther from the middle of the world than a thousand times their size need double precision.
    pub fn new(lit_scene: LitScene<'a>, rows: Range<u32>) -> Self {
        match PacketTracer::new(lit_scene) {
            Some(packets) => Self::of(lit_scene, rows, RayTracer::Packets(Box::new(packets))),
            None => Self::in_f64(lit_scene, rows),
        }
    }

    /// Prepares some rows of a picture in double precision.
    pub fn in_f64(lit_scene: LitScene<'a>, rows: Range<u32>) -> Self {
        Self::of(lit_scene, rows, RayTracer::Single(SceneTracer::new(&lit_scene)))
    }

    fn of(lit_scene: LitScene<'a>, rows: Range<u32>, tracer: RayTracer<'a>) -> Self {
        Self {
            lit_scene,
            camera: Camera::reaching(lit_scene.view, lit_scene.scene.reach()),
            tracer,
            sums: vec![RadiancePixel::default(); rows.len() * lit_scene.film.size[0] as usize],
            rows,
            passes: 0,
        }
    }

    /// Returns the light that one ray of a pixel receives, over all wavelengths.
    fn see(&self, bands: &[SceneTracer], pass: &SamplePass, pixel: [u32; 2]) -> RadiancePixel {
        let straight = self.eye_ray(pass, pixel);
        let mut start = WaitingRay::from_eye(straight);
        start.luck = LobeLuck::new(pixel, pass.number);
        // The ray meets the first body at the same point in all wavelengths.
        let first = bands.first().and_then(|tracer| tracer.first(&start));
        let is_seen = first.is_some() || self.lit_scene.environment.backdrop;
        let mut lit = RadiancePixel { cover: f64::from(u8::from(is_seen)), ..RadiancePixel::default() };
        let Some(first) = first else {
            if is_seen {
                let light = self.lit_scene.environment.radiance_around(&straight, 0.0);
                lit.colour = colour(&pass.whole, light);
            }
            return lit;
        };
        for (band, (tracer, response)) in bands.iter().zip(&pass.responses).enumerate() {
            let mut light = DVec4::ZERO;
            start.roulette = pass.roulette(pixel, band);
            let rest = tracer.follow(&start, &first, |ray| light += self.arriving(ray, &straight, pass));
            lit.unresolved += rest.unresolved;
            lit.absorbed += rest.absorbed;
            lit.colour += colour(response, light);
        }
        let share = 1.0 / pass.responses.len() as f64;
        let RadiancePixel { unresolved, absorbed, .. } = lit;
        RadiancePixel { unresolved: unresolved * share, absorbed: absorbed * share, ..lit }
    }

    /// Returns the light of the environment along a ray that has left all stones. `straight` is the ray from the eye
    /// to which it belongs.
    fn arriving(&self, ray: &WaitingRay, straight: &DispersedRay, pass: &SamplePass) -> DVec4 {
        // Only refracted light is mixed with the straight ray.
        let seen = if ray.is_reflected() { ray.ray } else { pass.mixed(straight, &ray.ray) };
        self.lit_scene.environment.radiance_around(&seen, ray.spread) * ray.weight
    }

    /// Returns the ray of a pixel, given by column and row, with the stretch of the pixel that the ray represents.
    fn eye_ray(&self, pass: &SamplePass, [x, y]: [u32; 2]) -> DispersedRay {
        let (at, film) = (DVec2::new(f64::from(x), f64::from(y)) + pass.shift, &self.lit_scene.film);
        self.camera.ray_along(film.image_from_pixels(at), pass.footprint_in_image(film))
    }

    /// Adds the light of one ray through each pixel to the sums of some pixels. The pixels are in rows, and begin
    /// with the number `first`.
    fn add(&self, bands: &[SceneTracer], pass: &SamplePass, first: usize, sums: &mut [RadiancePixel]) {
        let across = self.lit_scene.film.size[0] as usize;
        let pixel = |k: usize| [(k % across) as u32, self.rows.start + (k / across) as u32];
        if let RayTracer::Packets(packets) = &self.tracer {
            let numbers = first..first + sums.len();
            let eye_ray = |k: usize| {
                let pixel = pixel(k);
                EyeRay { pixel, ray: self.eye_ray(pass, pixel) }
            };
            let rays: Vec<_> = numbers.map(eye_ray).collect();
            packets.see(pass, &rays, sums);
            return;
        }
        for (k, sum) in (first..).zip(sums) {
            let lit = self.see(bands, pass, pixel(k));
            sum.colour += lit.colour;
            sum.cover += lit.cover;
            sum.unresolved += lit.unresolved;
            sum.absorbed += lit.absorbed;
        }
    }
}

impl<E: From<Stopped>> ProgressiveImage<E> for ByRays<'_> {
    fn add_pass(&mut self, pass: &SamplePass, watch: Watch) -> Result<(), E> {
        let bands = match &self.tracer {
            RayTracer::Packets(_) => vec![],
            RayTracer::Single(tracer) => tracer.made_of(pass),
        };
        let across = self.lit_scene.film.size[0] as usize;
        let at_once = (PacketTracer::RAYS_AT_ONCE / pass.responses.len().max(1)).max(1);
        let mut sums = std::mem::take(&mut self.sums);
        let pieces = sums.chunks_mut(across * PIECE).enumerate();
        let count = pieces.len();
        let mut stopped = false;
        for (piece, pixels) in pieces {
            stopped = watch(piece as f64 / count as f64).is_break();
            if stopped {
                break;
            }
            let pixels = pixels.par_chunks_mut(at_once).enumerate();
            pixels.for_each(|(k, sums)| {
                self.add(&bands, pass, piece * PIECE * across + k * at_once, sums);
            });
        }
        self.sums = sums;
        if stopped {
            return Err(Stopped.into());
        }
        self.passes += 1;
        Ok(())
    }

    fn each_pixel(&self, each: &mut dyn FnMut(&RadiancePixel)) -> Result<(), E> {
        let share = 1.0 / f64::from(self.passes.max(1));
        let mean = |sum: &RadiancePixel| RadiancePixel {
            colour: sum.colour * share,
            cover: sum.cover * share,
            unresolved: sum.unresolved * share,
            absorbed: sum.absorbed * share,
        };
        self.sums.iter().for_each(|sum| each(&mean(sum)));
        Ok(())
    }
}

#[cfg(test)]
mod frosted_tests;
#[cfg(test)]
mod metal_tests;
#[cfg(test)]
mod polarised_tests;
#[cfg(test)]
mod tests;
