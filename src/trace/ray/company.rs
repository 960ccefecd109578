//! Pictures under light by point rays: stones beside one another, light going from one to the next.

use super::{Camera, Exit, Tracer};
use crate::math::Polytope;
use crate::scene::Medium;
use crate::trace::sitting::{Exposure, Lit, Look, Sitting};
use crate::trace::{Stopped, Watch};
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use std::ops::Range;

/// Rays of one pixel that may wait to meet another stone, as on a graphics card.
const MOST_WAITING: usize = 16;

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
        let tracer = |stone: &Polytope| Tracer::new(stone, Medium::clear(1.0), sitting.options);
        Self {
            sitting,
            camera: Camera::reaching(sitting.view, sitting.reach()),
            tracers: sitting.stones.iter().map(tracer).collect(),
            balls: sitting.balls(),
            sums: vec![Lit::default(); rows.len() * sitting.size[0] as usize],
            rows,
            looks: 0,
        }
    }

    /// What one ray of a pixel sees, over all wavelengths.
    fn see(&self, tracers: &[Vec<Tracer>], look: &Look, at: DVec2) -> Lit {
        let (origin, direction) = self.camera.ray(at);
        let start = Waiting { origin, direction, sweep: DVec3::ZERO, weight: 1.0, left: None };
        let mut lit = Lit::default();
        let mut waiting = Vec::with_capacity(MOST_WAITING);
        for (band, response) in look.responses.iter().enumerate() {
            let see = |ray: &Waiting| {
                let light = self.sitting.surround.radiance(ray.origin, ray.direction, ray.sweep) * ray.weight;
                response.iter().zip(light.to_array()).map(|(&colour, light)| colour * light).sum::<DVec3>()
            };
            waiting.push(start);
            let mut hit = false;
            while let Some(ray) = waiting.pop() {
                let Some(stone) = self.nearest(&ray) else {
                    if ray.left.is_some() {
                        lit.colour += see(&ray);
                    }
                    continue;
                };
                hit = true;
                let mut unseen = 0.0;
                let leave = |exit: Exit| {
                    let ray = Waiting {
                        origin: exit.point,
                        direction: exit.direction,
                        sweep: exit.sweep,
                        weight: exit.weight,
                        left: Some(stone),
                    };
                    if !self.may_meet(&ray) {
                        lit.colour += see(&ray);
                    } else if waiting.len() < MOST_WAITING && ray.weight > self.sitting.options.least_weight {
                        waiting.push(ray);
                    } else {
                        unseen += ray.weight;
                    }
                };
                let tracer = &tracers[stone][band];
                if let Some(rest) =
                    tracer.follow_swept(ray.origin, (ray.direction, ray.sweep), ray.weight, leave)
                {
                    lit.unresolved += rest.unresolved;
                    lit.absorbed += rest.absorbed;
                    lit.bounces += f64::from(rest.bounces);
                }
                lit.unresolved += unseen;
            }
            if !hit && self.sitting.surround.backdrop {
                lit.colour += see(&start);
            }
            lit.cover = f64::from(u8::from(hit || self.sitting.surround.backdrop));
        }
        let bands = look.responses.len() as f64;
        Lit {
            unresolved: lit.unresolved / bands,
            absorbed: lit.absorbed / bands,
            bounces: lit.bounces / bands,
            ..lit
        }
    }

    /// The stone that a ray meets first.
    fn nearest(&self, ray: &Waiting) -> Option<usize> {
        let others = (0..self.tracers.len()).filter(|&k| Some(k) != ray.left);
        let met = others.filter_map(|k| Some((k, self.tracers[k].meet(ray.origin, ray.direction)?.1)));
        met.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(k, _)| k)
    }

    /// Whether a ray comes so near to a stone other than the one that it left that it may meet it.
    fn may_meet(&self, ray: &Waiting) -> bool {
        self.balls.iter().enumerate().any(|(k, &(middle, radius))| {
            let away = middle - ray.origin;
            let along = away.dot(ray.direction);
            Some(k) != ray.left && along > -radius && away.length_squared() - along * along < radius * radius
        })
    }
}

impl<E: From<Stopped>> Exposure<E> for ByRays<'_> {
    fn look(&mut self, look: &Look, watch: Watch) -> Result<(), E> {
        let made =
            |(tracer, media): (&Tracer, &Vec<Medium>)| media.iter().map(|&m| tracer.made_of(m)).collect();
        let tracers: Vec<Vec<Tracer>> = self.tracers.iter().zip(&look.media).map(made).collect();
        let across = self.sitting.size[0] as usize;
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
                let lit = self.see(&tracers, look, self.sitting.image_from_pixel(x, y, look.shift));
                sum.colour += lit.colour;
                sum.cover += lit.cover;
                sum.unresolved += lit.unresolved;
                sum.absorbed += lit.absorbed;
                sum.bounces += lit.bounces;
            });
        }
        self.sums = sums;
        if stopped {
            return Err(Stopped.into());
        }
        self.looks += 1;
        Ok(())
    }

    fn lit(&self) -> Result<Vec<Lit>, E> {
        let share = 1.0 / f64::from(self.looks.max(1));
        let mean = |sum: &Lit| Lit {
            colour: sum.colour * share,
            cover: sum.cover * share,
            unresolved: sum.unresolved * share,
            absorbed: sum.absorbed * share,
            bounces: sum.bounces * share,
        };
        Ok(self.sums.iter().map(mean).collect())
    }
}
