//! Rough metal: a surface of microscopic mirrors, whose slopes follow the law of Trowbridge and Reitz (GGX).
//!
//! Light that the mirrors reflect once follows B. Walter et al., *Microfacet Models for Refraction through Rough
//! Surfaces*, EGSR 2007, with Smith's masking and shadowing correlated by height (E. Heitz, *Understanding the
//! Masking-Shadowing Function in Microfacet-Based BRDFs*, JCGT 3 (2), 2014). Its directions are sampled by E. Heitz,
//! *Sampling the GGX Distribution of Visible Normals*, JCGT 7 (4), 2018. That model loses light that the mirrors
//! reflect more than once; it is added by the method of C. Kulla and A. Conty, *Revisiting Physically Based Shading
//! at Imageworks*, SIGGRAPH courses 2017. So a surface that absorbs nothing loses no light, and the reflection stays
//! reciprocal: the two directions can be exchanged. The numbers are derived from these models without their authors'
//! code.
//!
//! Directions are in a frame whose z is the surface's normal, have length 1, and point away from the surface.

use super::metal::metal_reflectance;
use glam::DVec3;
use num_complex::Complex64;
use std::collections::VecDeque;
use std::f64::consts::{FRAC_1_PI, TAU};
use std::sync::{Arc, Mutex, PoisonError};

/// The roughness below which a surface is a mirror: its reflections are spread over less than 1/500 degree.
const MIRROR: f64 = 0.004;

/// The number of steps in the table of the light that one reflection returns.
const STEPS: usize = 64;

/// The number of slopes along each of both axes, over which a value of that table is averaged.
const SLOPES: usize = 64;

/// The most rough surfaces that are kept for the next picture; each has about a hundred numbers.
const MOST_KEPT: usize = 64;

/// The number of angles over which reflectances are averaged.
const ANGLES: usize = 32;

/// A rough surface of any metal.
#[derive(Debug, Clone, PartialEq)]
pub struct Roughness {
    /// The width of the law of slopes, which is the square of the roughness; 0 for a mirror.
    alpha: f64,
    /// The share of light that leaves at the first reflection where the mirrors absorb nothing, for the cosines (k /
    /// STEPS)².
    once: Vec<f64>,
    /// The share of light that the first reflection loses, averaged over even light between the cosines of each step;
    /// empty for a mirror.
    lost: Vec<f64>,
    /// The mean of `once` over even light from all sides.
    once_mean: f64,
}

/// A rough surface of a metal at one wavelength.
#[derive(Debug, Clone)]
pub struct RoughMetal {
    roughness: Arc<Roughness>,
    index: Complex64,
    /// The share of the light reflected several times that the metal does not absorb.
    again: f64,
}

/// Light that a rough surface has reflected.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scattered {
    /// The direction that the light comes from or goes to.
    pub direction: DVec3,
    /// The factor by which the light from this direction counts.
    pub weight: f64,
    /// The density with which this direction is drawn, per steradian; infinite for a mirror.
    pub density: f64,
}

impl Roughness {
    /// Makes a surface of this roughness, 0 (a mirror) to 1. The roughness is the square root of the law's width, as
    /// in most programs.
    pub fn new(roughness: f64) -> Self {
        let roughness = roughness.clamp(0.0, 1.0);
        let alpha = if roughness < MIRROR { 0.0 } else { roughness * roughness };
        let mut surface = Self { alpha, once: vec![1.0; STEPS + 1], lost: vec![], once_mean: 1.0 };
        if alpha > 0.0 {
            surface.once = (0..=STEPS).map(|k| once(alpha, (k as f64 / STEPS as f64).powi(2))).collect();
            surface.lost = (0..STEPS).map(|k| surface.lost_in(k)).collect();
            let light = |k: usize| square_cos(k as f64 + 1.0) - square_cos(k as f64);
            surface.once_mean = 1.0 - (0..STEPS).map(|k| surface.lost[k] * light(k)).sum::<f64>();
        }
        surface
    }

    /// Returns the surface of this roughness, which all threads share. Making it takes a quarter of a million
    /// evaluations, and pictures are traced in many strips and passes, so the last few surfaces are kept.
    pub fn shared(roughness: f64) -> Arc<Self> {
        static KEPT: Mutex<VecDeque<(u64, Arc<Roughness>)>> = Mutex::new(VecDeque::new());
        let bits = roughness.to_bits();
        // Surfaces are complete before they are kept, so a thread that has panicked leaves no wrong surface behind.
        let mut kept = KEPT.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, surface)) = kept.iter().find(|(own, _)| *own == bits) {
            return Arc::clone(surface);
        }
        let surface = Arc::new(Self::new(roughness));
        kept.truncate(MOST_KEPT - 1);
        kept.push_front((bits, Arc::clone(&surface)));
        surface
    }

    /// The number of [`rows`](Self::rows).
    pub const ROWS: usize = STEPS + 1;

    /// Returns the surface as a table for the shaders, which shaders/microfacets.wgsl describes. It holds what is lost and not what
    /// is returned, because f32 would round that to 1 on smooth surfaces.
    pub fn rows(&self) -> impl Iterator<Item = [f64; 4]> + '_ {
        let mut before = 0.0;
        let step = move |k: usize| {
            let lost = self.lost.get(k).copied().unwrap_or(0.0);
            let row = [1.0 - self.once[k], 1.0 - self.once[k + 1], lost, before];
            before += lost * (square_cos(k as f64 + 1.0) - square_cos(k as f64));
            row
        };
        std::iter::once([self.alpha, 1.0 - self.once_mean, 0.0, 0.0]).chain((0..STEPS).map(step))
    }

    /// Returns the share of light that leaves at the first reflection, in a direction with this cosine.
    pub(super) fn once(&self, cos: f64) -> f64 {
        let at = cos.clamp(0.0, 1.0).sqrt() * STEPS as f64;
        let step = (at as usize).min(STEPS - 1);
        self.once[step] + (self.once[step + 1] - self.once[step]) * (at - step as f64)
    }

    /// Returns the share of light that is lost at the first reflection, averaged over even light between the cosines of a step.
    fn lost_in(&self, step: usize) -> f64 {
        let [low, high] = [step as f64, step as f64 + 1.0].map(square_cos);
        let part = |k: u32| 1.0 - self.once((low + (high - low) * (f64::from(k) + 0.5) / 8.0).sqrt());
        (0..8).map(part).sum::<f64>() / 8.0
    }

    /// Draws a direction of light that has met several microscopic mirrors, from two random numbers of at least 0 and
    /// below 1. The direction is drawn by the density of a table with even steps; returned with it is the exact
    /// density divided by the table's.
    fn several_times(&self, [u, v]: [f64; 2]) -> (DVec3, f64) {
        let mut left = u * (1.0 - self.once_mean);
        let mut step = 0;
        let mass = |step: usize| self.lost[step] * (square_cos(step as f64 + 1.0) - square_cos(step as f64));
        while step + 1 < STEPS && left >= mass(step) {
            left -= mass(step);
            step += 1;
        }
        let [low, high] = [step as f64, step as f64 + 1.0].map(square_cos);
        let square = low + (high - low) * (left / mass(step).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        let cos = square.clamp(1e-12, 1.0).sqrt();
        let (sin, (y, x)) = ((1.0 - cos * cos).max(0.0).sqrt(), (TAU * v).sin_cos());
        let exact = (1.0 - self.once(cos)) / self.lost[step].max(f64::MIN_POSITIVE);
        (DVec3::new(sin * x, sin * y, cos), exact)
    }

    /// Returns this surface as that of a metal with this complex index.
    pub fn of_metal(self: &Arc<Self>, index: Complex64) -> RoughMetal {
        let even = |k: usize| ((k as f64 + 0.5) / ANGLES as f64).sqrt();
        let mean = (0..ANGLES).map(|k| unpolarised(even(k), index)).sum::<f64>() / ANGLES as f64;
        // The metal absorbs light anew at each further reflection (Kulla and Conty, page 29).
        let again =
            mean * mean * self.once_mean / (1.0 - mean * (1.0 - self.once_mean)).max(f64::MIN_POSITIVE);
        RoughMetal { roughness: Arc::clone(self), index, again }
    }
}

impl RoughMetal {
    /// Returns the part of the light reflected several times that the metal does not absorb.
    pub fn again(&self) -> f64 {
        self.again
    }

    /// Draws a direction from which light arrives that the surface reflects to `out`, from three random numbers from
    /// 0 to below 1; `None` where the light that is drawn is lost.
    pub fn sample(&self, out: DVec3, luck: [f64; 3]) -> Option<Scattered> {
        let Roughness { alpha, once_mean, .. } = *self.roughness;
        if alpha == 0.0 {
            let direction = DVec3::new(-out.x, -out.y, out.z);
            let weight = unpolarised(out.z, self.index);
            return Some(Scattered { direction, weight, density: f64::INFINITY });
        }
        let first = self.roughness.once(out.z);
        if luck[2] >= first {
            let (direction, exact) = self.roughness.several_times([luck[0], luck[1]]);
            let even = (1.0 - self.roughness.once(direction.z)) / (1.0 - once_mean);
            let density = (1.0 - first) * even * direction.z * FRAC_1_PI / exact.max(f64::MIN_POSITIVE);
            return Some(Scattered { direction, weight: self.again * exact, density });
        }
        let middle = visible_normal(alpha, out, [luck[0], luck[1]]);
        let cos = out.dot(middle);
        let direction = middle * (2.0 * cos) - out;
        if direction.z <= 0.0 {
            return None;
        }
        let (own, other) = (1.0 + hidden(alpha, out.z), hidden(alpha, direction.z));
        let weight = unpolarised(cos, self.index) * own / ((own + other) * first);
        let density = first * slopes(alpha, middle.z) / (4.0 * out.z * own);
        Some(Scattered { direction, weight, density })
    }

    /// Returns the light reflected to `out` per light that arrives from `from`, per steradian and per cosine of
    /// `from`. Not for mirrors.
    pub fn value(&self, out: DVec3, from: DVec3) -> f64 {
        let Roughness { alpha, once_mean, .. } = *self.roughness;
        let middle = (out + from) / (out + from).length();
        let both = 1.0 + hidden(alpha, out.z) + hidden(alpha, from.z);
        let single = unpolarised(out.dot(middle), self.index) * slopes(alpha, middle.z)
            / (4.0 * out.z * from.z * both);
        let [a, b] = [out, from].map(|way| 1.0 - self.roughness.once(way.z));
        single + self.again * a * b * FRAC_1_PI / (1.0 - once_mean)
    }
}

/// Returns the share of unpolarised light that a metal reflects.
fn unpolarised(cos_i: f64, index: Complex64) -> f64 {
    let [s, p] = metal_reflectance(cos_i, index);
    0.5 * (s + p)
}

/// Returns the share of light that leaves at the first reflection, averaged over the slopes that are visible from a
/// direction with this cosine.
fn once(alpha: f64, cos: f64) -> f64 {
    let cos = cos.max(1e-4);
    let out = DVec3::new((1.0 - cos * cos).max(0.0).sqrt(), 0.0, cos);
    let returned = |k: usize| {
        let [i, j] = [k % SLOPES, k / SLOPES].map(|i| (i as f64 + 0.5) / SLOPES as f64);
        // Steep slopes are few and lose most light, so they are sampled more densely and each sample counts for less.
        let middle = visible_normal(alpha, out, [1.0 - i * i, j]);
        let from = middle * (2.0 * out.dot(middle)) - out;
        let own = hidden(alpha, cos);
        if from.z > 0.0 { 2.0 * i * (1.0 + own) / (1.0 + own + hidden(alpha, from.z)) } else { 0.0 }
    };
    (0..SLOPES * SLOPES).map(returned).sum::<f64>() / (SLOPES * SLOPES) as f64
}

/// Returns the density of normals with this cosine (Walter et al. 2007, eq. 33).
fn slopes(alpha: f64, cos: f64) -> f64 {
    let square = alpha * alpha;
    let fall = cos * cos * (square - 1.0) + 1.0;
    square * FRAC_1_PI / (fall * fall)
}

/// Returns Smith's function Λ: the hidden over the visible area of mirrors, seen from a direction with this cosine
/// (Heitz 2014, eq. 72).
pub(super) fn hidden(alpha: f64, cos: f64) -> f64 {
    let square = (cos * cos).max(1e-16);
    0.5 * ((1.0 + alpha * alpha * (1.0 - square) / square).sqrt() - 1.0)
}

/// Returns a normal among those that are visible from a direction, from two random numbers. The stretched mirrors
/// become a half sphere, which is seen as two half discs (Heitz 2018, section 3).
pub(super) fn visible_normal(alpha: f64, out: DVec3, [u, v]: [f64; 2]) -> DVec3 {
    let stretched = unit(DVec3::new(alpha * out.x, alpha * out.y, out.z));
    let flat = stretched.truncate().length_squared();
    let across = if flat > 0.0 { DVec3::new(-stretched.y, stretched.x, 0.0) / flat.sqrt() } else { DVec3::X };
    let up = stretched.cross(across);
    let (sin, cos) = (TAU * v).sin_cos();
    let (x, y) = (u.sqrt() * cos, u.sqrt() * sin);
    let seen = 0.5 * (1.0 + stretched.z);
    let y = (1.0 - seen) * (1.0 - x * x).max(0.0).sqrt() + seen * y;
    let normal = across * x + up * y + stretched * (1.0 - x * x - y * y).max(0.0).sqrt();
    unit(DVec3::new(alpha * normal.x, alpha * normal.y, normal.z.max(1e-9)))
}

/// Returns the square of the cosine at a step of the table.
fn square_cos(step: f64) -> f64 {
    (step / STEPS as f64).powi(4)
}

fn unit(vector: DVec3) -> DVec3 {
    vector / vector.length()
}

#[cfg(test)]
mod tests;
