//! Rays outside and inside bodies, as single rays or one in each lane.

use super::lanes::{Lanes, Vectors};
use crate::DispersedRay;
use crate::coherency::Coherency;
use crate::ray::ChainEnd;
use brillianteer_scene::Medium;
use glam::Vec3;
use pulp::Simd;

/// A medium at one wavelength, in single precision.
#[derive(Debug, Clone, Copy)]
pub(super) struct PacketMedium {
    pub index: f32,
    /// The change of the index over the wavelengths that this wavelength represents.
    pub spread: f32,
    /// The absorption of the two polarisations, per unit of the body's frame.
    pub absorption: [f32; 2],
}

/// The history of light inside the body that it has left or is in.
#[derive(Debug, Clone, Copy)]
pub(super) struct Travelled {
    /// The share of the light that absorption has left.
    pub left: f32,
    /// The length of the path inside the body so far, in the unit of the body's frame.
    pub path: f32,
    pub bounces: u32,
}

/// A ray outside all bodies, in the world or in the frame of a body; or one that has just entered a body, in its frame.
#[derive(Clone, Copy)]
pub(super) struct SingleRay {
    pub origin: Vec3,
    /// The unit direction in which the light travels.
    pub direction: Vec3,
    /// The change of the direction over the range that the ray represents: a band of wavelengths and a stretch of the
    /// pixel.
    pub fan: Vec3,
    /// The displacement of the origin over the same range.
    pub shift: Vec3,
    /// The axis of s polarisation of the light.
    pub s: Vec3,
    /// The light that absorption has left.
    pub light: Coherency<f32>,
    pub travelled: Travelled,
    /// The number of the ray of the picture to which this ray belongs.
    pub tag: u32,
}

/// The point where a ray meets a body, in the frame of the body.
#[derive(Debug, Clone, Copy)]
pub(super) struct SingleHit {
    /// The distance along the ray; infinite where the ray misses.
    pub distance: f32,
    /// The unit outward normal; undefined where the ray misses.
    pub normal: Vec3,
}

/// A ray that is about to enter a body, in the frame of the body.
#[derive(Clone, Copy)]
pub(super) struct EnteringRay {
    pub ray: SingleRay,
    pub met: SingleHit,
    /// The body's medium.
    pub medium: PacketMedium,
    /// The random number, from 0 to below 1, that decides how far the ray's light is followed inside the body where
    /// it goes on by chance.
    pub luck: f32,
}

/// A ray that has just entered a body, in the frame of the body.
#[derive(Clone, Copy)]
pub(super) struct InnerRay {
    pub ray: SingleRay,
    pub medium: PacketMedium,
    pub end: ChainEnd<f32>,
}

/// The part of a ray's light that did not leave the body.
#[derive(Debug, Clone, Copy)]
pub(super) struct PacketLoss {
    pub absorbed: f32,
    pub unresolved: f32,
    pub tag: u32,
}

/// Rays inside a body, one in each lane.
#[derive(Clone, Copy)]
pub(super) struct InnerRays<S: Simd> {
    pub ray: DispersedRay<Vectors<S>>,
    /// The axis of s polarisation of the light.
    pub s: Vectors<S>,
    /// The light before the loss by absorption.
    pub light: Coherency<Lanes<S>>,
    pub index: Lanes<S>,
    pub spread: Lanes<S>,
    pub absorption: [Lanes<S>; 2],
    /// The share of the light that absorption has left.
    pub left: Lanes<S>,
    /// The length of the path inside the body so far, in the unit of the body's frame.
    pub path: Lanes<S>,
    /// The light that the body has absorbed.
    pub absorbed: Lanes<S>,
    pub end: ChainEnd<Lanes<S>>,
}

impl<S: Simd> DispersedRay<Vectors<S>> {
    /// Returns a ray along this direction in every lane, from the origin.
    #[inline(always)]
    pub(super) fn along(direction: Vectors<S>, none: Vectors<S>) -> Self {
        Self { origin: none, direction, fan: none, shift: none }
    }

    #[inline(always)]
    pub(super) fn set_lane(&mut self, lane: usize, ray: &SingleRay) {
        self.origin.set_lane(lane, ray.origin);
        self.direction.set_lane(lane, ray.direction);
        self.fan.set_lane(lane, ray.fan);
        self.shift.set_lane(lane, ray.shift);
    }
}

impl<S: Simd> ChainEnd<Lanes<S>> {
    #[inline(always)]
    pub fn lane(&self, lane: usize) -> ChainEnd<f32> {
        ChainEnd { threshold: self.threshold.lane(lane), least: self.least.lane(lane) }
    }

    #[inline(always)]
    pub fn set_lane(&mut self, lane: usize, end: ChainEnd<f32>) {
        self.threshold.set_lane(lane, end.threshold);
        self.least.set_lane(lane, end.least);
    }
}

impl<S: Simd> Coherency<Lanes<S>> {
    #[inline(always)]
    pub fn dark(simd: S) -> Self {
        let none = Lanes::splat(simd, 0.0);
        Self { ss: none, pp: none, re: none, im: none }
    }

    #[inline(always)]
    pub fn lane(&self, lane: usize) -> Coherency<f32> {
        Coherency {
            ss: self.ss.lane(lane),
            pp: self.pp.lane(lane),
            re: self.re.lane(lane),
            im: self.im.lane(lane),
        }
    }

    #[inline(always)]
    pub fn set_lane(&mut self, lane: usize, light: &Coherency<f32>) {
        self.ss.set_lane(lane, light.ss);
        self.pp.set_lane(lane, light.pp);
        self.re.set_lane(lane, light.re);
        self.im.set_lane(lane, light.im);
    }
}

impl PacketMedium {
    pub fn new(medium: &Medium) -> Self {
        Self {
            index: medium.index as f32,
            spread: medium.spread as f32,
            absorption: medium.absorption.map(|a| a as f32),
        }
    }

    pub fn is_clear(&self) -> bool {
        self.absorption == [0.0; 2]
    }
}

impl Travelled {
    /// The history of light that has not been in the body.
    pub const NONE: Self = Self { left: 1.0, path: 0.0, bounces: 0 };
}

impl InnerRay {
    /// A ray without light, for a lane that waits for a ray.
    pub const DARK: Self = Self {
        ray: SingleRay {
            origin: Vec3::ZERO,
            direction: Vec3::Z,
            fan: Vec3::ZERO,
            shift: Vec3::ZERO,
            s: Vec3::X,
            light: Coherency { ss: 0.0, pp: 0.0, re: 0.0, im: 0.0 },
            travelled: Travelled::NONE,
            tag: 0,
        },
        medium: PacketMedium { index: 1.0, spread: 0.0, absorption: [0.0; 2] },
        end: ChainEnd { threshold: 0.0, least: 0.0 },
    };
}

impl<S: Simd> InnerRays<S> {
    /// Returns lanes that hold no light.
    #[inline(always)]
    pub fn dark(simd: S) -> Self {
        let zero = Lanes::splat(simd, 0.0);
        let none = Vectors::splat(simd, Vec3::ZERO);
        let mut lanes = Self {
            ray: DispersedRay::along(none, none),
            s: none,
            light: Coherency::dark(simd),
            index: zero,
            spread: zero,
            absorption: [zero; 2],
            left: zero,
            path: zero,
            absorbed: zero,
            end: ChainEnd { threshold: zero, least: zero },
        };
        for lane in 0..S::F32_LANES {
            lanes.set_lane(lane, &InnerRay::DARK);
        }
        lanes
    }

    /// Puts a ray that has just entered into a lane.
    #[inline(always)]
    pub fn set_lane(&mut self, lane: usize, &InnerRay { ref ray, medium, end }: &InnerRay) {
        let Travelled { left, path, .. } = ray.travelled;
        self.ray.set_lane(lane, ray);
        self.s.set_lane(lane, ray.s);
        // Light of which absorption has left almost nothing is not followed, unless the least weight is 0.
        self.light.set_lane(lane, &ray.light.times(1.0 / left.max(f32::MIN_POSITIVE)));
        self.index.set_lane(lane, medium.index);
        self.spread.set_lane(lane, medium.spread);
        self.absorption[0].set_lane(lane, medium.absorption[0]);
        self.absorption[1].set_lane(lane, medium.absorption[1]);
        self.left.set_lane(lane, left);
        self.path.set_lane(lane, path);
        self.absorbed.set_lane(lane, 0.0);
        self.end.set_lane(lane, end);
    }

    #[inline(always)]
    pub fn weight(&self) -> Lanes<S> {
        self.light.weight() * self.left
    }

    /// Returns the factor by which light counts that has come so far; see [`ChainEnd::factor`].
    #[inline(always)]
    pub fn factor(&self) -> Lanes<S> {
        self.end.factor(self.weight())
    }
}
