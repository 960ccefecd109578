//! Traces pictures under light by point rays: several stones, and light that goes from one to the next.

use super::sight::{Met, nearest};
use super::{Camera, Exit, InstanceTracer, Loss, MeetingRay, Roulette};
use crate::scene::Medium;
use crate::trace::packet::{EyeRay, PacketTracer};
use crate::trace::sampling::{LitScene, MOST_WAITING, ProgressiveImage, RadiancePixel, SamplePass, colour};
use crate::trace::{Stopped, Watch};
use glam::{DVec2, DVec3, DVec4};
use rayon::prelude::*;
use std::ops::Range;

/// Rows traced between two calls of the watch.
const PIECE: usize = 8;

/// A tracer of several stones, each of one medium, and of the light that goes from one to the next.
#[derive(Clone)]
pub struct SceneTracer {
    tracers: Vec<InstanceTracer>,
    least_weight: f64,
}

/// A ray on its way, and the stone that it left.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WaitingRay {
    /// The point where it begins.
    pub origin: DVec3,
    /// The direction in which the light travels, of length 1.
    pub direction: DVec3,
    /// The change of that direction over the medium's spread of indices.
    pub sweep: DVec3,
    /// The share of the light from that direction that reaches the eye.
    pub weight: f64,
    /// By what chance weak light goes on in solids that are not convex; without it, all of it does.
    pub roulette: Option<Roulette>,
    left: Option<usize>,
    /// The number of bounces inside stones on its way so far.
    bounces: u32,
}

impl WaitingRay {
    /// Returns a ray from the eye.
    pub fn from_eye((origin, direction): (DVec3, DVec3)) -> Self {
        Self { origin, direction, sweep: DVec3::ZERO, weight: 1.0, roulette: None, left: None, bounces: 0 }
    }
}

impl SceneTracer {
    /// Prepares the stones of a scene; [`made_of`](Self::made_of) gives them their media.
    pub fn new(lit_scene: &LitScene) -> Self {
        let (stones, options) = (&lit_scene.scene.instances, lit_scene.options);
        Self {
            tracers: InstanceTracer::of_all(stones, options, |_| Medium::clear(1.0)),
            least_weight: lit_scene.options.least_weight,
        }
    }

    /// Returns the stones with their media in each band of a sample pass.
    pub fn made_of(&self, pass: &SamplePass) -> Vec<Self> {
        let of_band = |band: usize| {
            let made = |(tracer, media): (&InstanceTracer, &Vec<Medium>)| tracer.made_of(media[band]);
            Self {
                tracers: self.tracers.iter().zip(&pass.media).map(made).collect(),
                least_weight: self.least_weight,
            }
        };
        (0..pass.responses.len()).map(of_band).collect()
    }

    /// Returns the stone that a ray meets first, and where; `None` where it meets none.
    pub fn first(&self, ray: &WaitingRay) -> Option<First> {
        nearest(&self.tracers, (ray.origin, ray.direction), ray.left).map(First)
    }

    /// Follows a ray through all stones, from the one that it is known to meet; calls `leave` for each ray that meets no
    /// stone any more.
    pub fn follow(&self, start: &WaitingRay, first: &First, mut leave: impl FnMut(&WaitingRay)) -> Loss {
        let mut waiting = Vec::new();
        let mut rest = self.through(start, first.0, &mut waiting, &mut leave);
        while let Some(ray) = waiting.pop() {
            match self.first(&ray) {
                Some(first) => {
                    let more = self.through(&ray, first.0, &mut waiting, &mut leave);
                    rest = rest.and(&more);
                }
                None => leave(&ray),
            }
        }
        rest
    }

    /// Follows a ray through one stone; exits that meet other stones are put into `waiting`.
    fn through(
        &self,
        ray: &WaitingRay,
        (stone, met): Met,
        waiting: &mut Vec<WaitingRay>,
        mut leave: impl FnMut(&WaitingRay),
    ) -> Loss {
        let (mut unseen, mut number, before) = (0.0, 0, ray.bounces);
        let exits = |exit: Exit| {
            let Exit { point: origin, direction, sweep, weight, .. } = exit;
            let bounces = before + exit.bounce;
            number += 1;
            let roulette = ray.roulette.map(|roulette| roulette.beyond(number));
            let ray = WaitingRay { origin, direction, sweep, weight, roulette, left: Some(stone), bounces };
            if !self.meets_any(&ray) {
                leave(&ray);
            } else if waiting.len() < MOST_WAITING && weight > self.least_weight {
                waiting.push(ray);
            } else {
                unseen += weight;
            }
        };
        let &WaitingRay { origin, direction, sweep, weight, roulette, .. } = ray;
        let meeting = MeetingRay { met, origin, direction, sweep, weight, roulette };
        let is_taken = |exit: &Exit, distance: f64| self.meets_before(exit, stone, distance);
        let rest = self.tracers[stone].follow_from(&meeting, is_taken, exits).unwrap_or_default();
        Loss { unresolved: rest.unresolved + unseen, bounces: before + rest.bounces, ..rest }
    }

    /// Whether a ray meets a stone other than the one that it left.
    fn meets_any(&self, ray: &WaitingRay) -> bool {
        self.others(ray.left, (ray.origin, ray.direction)).next().is_some()
    }

    /// Whether light that has left a stone meets another at less than this distance.
    fn meets_before(&self, exit: &Exit, left: usize, distance: f64) -> bool {
        self.others(Some(left), (exit.point, exit.direction)).any(|other| other < distance)
    }

    /// Returns the distances at which a ray meets stones other than the one that it left.
    fn others(&self, left: Option<usize>, way: (DVec3, DVec3)) -> impl Iterator<Item = f64> {
        let near = move |&(k, tracer): &(usize, &InstanceTracer)| Some(k) != left && tracer.is_near(way);
        let met =
            move |(_, tracer): (_, &InstanceTracer)| tracer.meet(way.0, way.1).map(|(_, distance)| distance);
        self.tracers.iter().enumerate().filter(near).filter_map(met)
    }
}

/// The stone that a ray meets first, and where.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct First(Met);

/// What follows the rays of a picture under light.
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

    /// Prepares some rows of a picture: by packets of rays in single precision where these can follow light through all
    /// bodies, else by single rays in double precision. Triangles, and bodies a thousand times their size away from the
    /// middle of the world, need the latter.
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

    /// Returns what one ray of a pixel sees, over all wavelengths.
    fn see(&self, bands: &[SceneTracer], pass: &SamplePass, pixel: [u32; 2]) -> RadiancePixel {
        let straight = self.eye_ray(pass, pixel);
        let mut start = WaitingRay::from_eye(straight);
        // The ray meets the first stone at the same point in all wavelengths.
        let first = bands.first().and_then(|tracer| tracer.first(&start));
        let is_seen = first.is_some() || self.lit_scene.environment.backdrop;
        let mut lit = RadiancePixel { cover: f64::from(u8::from(is_seen)), ..RadiancePixel::default() };
        let Some(first) = first else {
            if is_seen {
                let (from, direction) = straight;
                let light = self.lit_scene.environment.radiance(from, direction, DVec3::ZERO);
                lit.colour = colour(&pass.whole, light);
            }
            return lit;
        };
        for (band, (tracer, response)) in bands.iter().zip(&pass.responses).enumerate() {
            let mut light = DVec4::ZERO;
            start.roulette = pass.roulette(pixel, band);
            let rest = tracer.follow(&start, &first, |ray| light += self.arriving(ray, straight, pass));
            lit.unresolved += rest.unresolved;
            lit.absorbed += rest.absorbed;
            lit.colour += colour(response, light);
        }
        let share = 1.0 / pass.responses.len() as f64;
        let RadiancePixel { unresolved, absorbed, .. } = lit;
        RadiancePixel { unresolved: unresolved * share, absorbed: absorbed * share, ..lit }
    }

    /// Returns the environment's light along a ray that has left all stones; `straight` is the ray from the eye that it goes
    /// back to.
    fn arriving(&self, ray: &WaitingRay, straight: (DVec3, DVec3), pass: &SamplePass) -> DVec4 {
        let (from, direction, sweep) = pass.mixed(straight, (ray.origin, ray.direction, ray.sweep));
        self.lit_scene.environment.radiance(from, direction, sweep) * ray.weight
    }

    /// Returns the ray of a pixel, given by column and row.
    fn eye_ray(&self, pass: &SamplePass, [x, y]: [u32; 2]) -> (DVec3, DVec3) {
        let at = DVec2::new(f64::from(x), f64::from(y)) + pass.shift;
        self.camera.ray(self.lit_scene.film.image_from_pixels(at))
    }

    /// Adds what one ray of each pixel sees to the sums of some pixels, which stand row by row from the number `first` on.
    fn add(&self, bands: &[SceneTracer], pass: &SamplePass, first: usize, sums: &mut [RadiancePixel]) {
        let across = self.lit_scene.film.size[0] as usize;
        let pixel = |k: usize| [(k % across) as u32, self.rows.start + (k / across) as u32];
        if let RayTracer::Packets(packets) = &self.tracer {
            let numbers = first..first + sums.len();
            let eye_ray = |k: usize| {
                let pixel = pixel(k);
                let (origin, direction) = self.eye_ray(pass, pixel);
                EyeRay { pixel, origin, direction }
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
mod tests;
