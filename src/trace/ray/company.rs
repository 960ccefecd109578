//! Pictures under light by point rays: stones beside one another, light going from one to the next.

use super::sight::{Met, is_near, nearest};
use super::{Camera, Exit, Tracer};
use crate::math::Solid;
use crate::scene::Medium;
use crate::trace::sitting::{Exposure, Lit, Look, MOST_WAITING, Sitting};
use crate::trace::{Stopped, Watch};
use glam::{DVec2, DVec3, DVec4};
use rayon::prelude::*;
use std::ops::Range;

/// Rows traced between two calls of the watch.
const PIECE: usize = 8;

/// Rows of a picture, traced by the processor in f64.
pub struct ByRays<'a> {
    sitting: Sitting<'a>,
    camera: Camera,
    tracers: Vec<Tracer>,
    balls: Vec<(DVec3, f64)>,
    rows: Range<u32>,
    looks: u32,
    sums: Vec<Lit>,
}

/// A ray on its way, and the stone that it left.
#[derive(Clone, Copy)]
struct Waiting {
    origin: DVec3,
    direction: DVec3,
    sweep: DVec3,
    weight: f64,
    left: Option<usize>,
}

impl<'a> ByRays<'a> {
    /// Prepares some rows of a picture.
    pub fn new(sitting: Sitting<'a>, rows: Range<u32>) -> Self {
        let tracer = |stone: &Solid| Tracer::new(stone, Medium::clear(1.0), sitting.options);
        Self {
            sitting,
            camera: Camera::reaching(sitting.view, sitting.reach()),
            tracers: sitting.stones().map(tracer).collect(),
            balls: sitting.balls(),
            sums: vec![Lit::default(); rows.len() * sitting.film.size[0] as usize],
            rows,
            looks: 0,
        }
    }

    /// What one ray of a pixel sees, over all wavelengths.
    fn see(&self, tracers: &[Vec<Tracer>], look: &Look, at: DVec2) -> Lit {
        let (origin, direction) = self.camera.ray(at);
        let start = Waiting { origin, direction, sweep: DVec3::ZERO, weight: 1.0, left: None };
        // Where it meets the first stone is the same for all wavelengths.
        let first = self.nearest(&start);
        let is_seen = first.is_some() || self.sitting.surround.backdrop;
        let mut lit = Lit { cover: f64::from(u8::from(is_seen)), ..Lit::default() };
        let mut waiting = Vec::with_capacity(MOST_WAITING);
        for (band, response) in look.responses.iter().enumerate() {
            let (mut light, mut unseen) = (DVec4::ZERO, 0.0);
            let mut through = |ray: &Waiting, met: Option<Met>, waiting: &mut Vec<Waiting>| {
                let Some((stone, met)) = met else { return light += self.arriving(ray, look) };
                let leave = |exit: Exit| {
                    let Exit { point: origin, direction, sweep, weight, .. } = exit;
                    let ray = Waiting { origin, direction, sweep, weight, left: Some(stone) };
                    if !self.meets_any(&ray) {
                        light += self.arriving(&ray, look);
                    } else if waiting.len() < MOST_WAITING && weight > self.sitting.options.least_weight {
                        waiting.push(ray);
                    } else {
                        unseen += weight;
                    }
                };
                let (tracer, way) = (&tracers[stone][band], (ray.direction, ray.sweep));
                let is_taken = |exit: &Exit, distance: f64| self.meets_before(exit, stone, distance);
                if let Some(rest) = tracer.follow_from(met, ray.origin, way, ray.weight, is_taken, leave) {
                    lit.unresolved += rest.unresolved;
                    lit.absorbed += rest.absorbed;
                }
            };
            if is_seen {
                through(&start, first, &mut waiting);
            }
            while let Some(ray) = waiting.pop() {
                through(&ray, self.nearest(&ray), &mut waiting);
            }
            lit.colour += response.iter().zip(light.to_array()).map(|(&c, l)| c * l).sum::<DVec3>();
            lit.unresolved += unseen;
        }
        let share = 1.0 / look.responses.len() as f64;
        let Lit { unresolved, absorbed, .. } = lit;
        Lit { unresolved: unresolved * share, absorbed: absorbed * share, ..lit }
    }

    /// The light that comes down a ray from what stands around.
    fn arriving(&self, ray: &Waiting, look: &Look) -> DVec4 {
        let middle = look.middle(ray.direction, ray.sweep);
        self.sitting.surround.radiance(ray.origin, middle, ray.sweep) * ray.weight
    }

    /// The stone that a ray meets first, and where.
    fn nearest(&self, ray: &Waiting) -> Option<Met> {
        nearest(&self.tracers, &self.balls, (ray.origin, ray.direction), ray.left)
    }

    /// Whether a ray meets a stone other than the one that it left.
    fn meets_any(&self, ray: &Waiting) -> bool {
        self.others(ray.left, (ray.origin, ray.direction)).next().is_some()
    }

    /// Whether light that has left a stone meets another at less than this distance.
    fn meets_before(&self, exit: &Exit, left: usize, distance: f64) -> bool {
        self.others(Some(left), (exit.point, exit.direction)).any(|other| other < distance)
    }

    /// The distances at which a ray meets stones other than the one that it left.
    fn others(&self, left: Option<usize>, way: (DVec3, DVec3)) -> impl Iterator<Item = f64> {
        let near = move |&(k, &ball): &(usize, &(DVec3, f64))| Some(k) != left && is_near(ball, way);
        let met = move |(k, _): (usize, _)| self.tracers[k].meet(way.0, way.1).map(|(_, distance)| distance);
        self.balls.iter().enumerate().filter(near).filter_map(met)
    }
}

impl<E: From<Stopped>> Exposure<E> for ByRays<'_> {
    fn look(&mut self, look: &Look, watch: Watch) -> Result<(), E> {
        let made =
            |(tracer, media): (&Tracer, &Vec<Medium>)| media.iter().map(|&m| tracer.made_of(m)).collect();
        let tracers: Vec<Vec<Tracer>> = self.tracers.iter().zip(&look.media).map(made).collect();
        let across = self.sitting.film.size[0] as usize;
        let mut sums = std::mem::take(&mut self.sums);
        let pieces = sums.chunks_mut(across * PIECE).enumerate();
        let count = pieces.len();
        let mut stopped = false;
        for (piece, pixels) in pieces {
            stopped = watch(piece as f64 / count as f64).is_break();
            if stopped {
                break;
            }
            pixels.par_iter_mut().enumerate().for_each(|(k, sum)| {
                let (x, y) = ((k % across) as u32, self.rows.start + (piece * PIECE + k / across) as u32);
                let lit = self.see(
                    &tracers,
                    look,
                    self.sitting.film.image_from_pixels(DVec2::new(f64::from(x), f64::from(y)) + look.shift),
                );
                sum.colour += lit.colour;
                sum.cover += lit.cover;
                sum.unresolved += lit.unresolved;
                sum.absorbed += lit.absorbed;
            });
        }
        self.sums = sums;
        if stopped {
            return Err(Stopped.into());
        }
        self.looks += 1;
        Ok(())
    }

    fn lit(&self, each: &mut dyn FnMut(&Lit)) -> Result<(), E> {
        let share = 1.0 / f64::from(self.looks.max(1));
        let mean = |sum: &Lit| Lit {
            colour: sum.colour * share,
            cover: sum.cover * share,
            unresolved: sum.unresolved * share,
            absorbed: sum.absorbed * share,
        };
        self.sums.iter().for_each(|sum| each(&mean(sum)));
        Ok(())
    }
}
