//! Numbers and vectors in single precision, one in each lane of the processor's registers.
//!
//! Every function is inlined into the code that the processor's widest instructions are chosen for; closures would not be.
//! Sums are not fused, so that an answer does not depend on the processor.

use glam::Vec3;
use pulp::Simd;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// The most lanes that any processor has.
pub(super) const MOST_LANES: usize = 16;

/// A number in each lane.
#[derive(Clone, Copy)]
pub(super) struct Lanes<S: Simd> {
    simd: S,
    values: S::f32s,
}

/// A vector in each lane.
#[derive(Clone, Copy)]
pub(super) struct Vectors<S: Simd> {
    pub x: Lanes<S>,
    pub y: Lanes<S>,
    pub z: Lanes<S>,
}

/// A yes or no in each lane.
#[derive(Clone, Copy)]
pub(super) struct Mask<S: Simd> {
    simd: S,
    mask: S::m32s,
}

impl<S: Simd> Lanes<S> {
    #[inline(always)]
    pub fn all(simd: S, value: f32) -> Self {
        Self { simd, values: simd.splat_f32s(value) }
    }

    /// Returns this number in all lanes.
    #[inline(always)]
    pub fn same(self, value: f32) -> Self {
        Self::all(self.simd, value)
    }

    #[inline(always)]
    pub fn max(self, other: Self) -> Self {
        Self { values: self.simd.max_f32s(self.values, other.values), ..self }
    }

    #[inline(always)]
    pub fn min(self, other: Self) -> Self {
        Self { values: self.simd.min_f32s(self.values, other.values), ..self }
    }

    #[inline(always)]
    pub fn abs(self) -> Self {
        // The processor's own instruction for it is not inlined by `pulp`.
        self.max(-self)
    }

    #[inline(always)]
    pub fn sqrt(self) -> Self {
        Self { values: self.simd.sqrt_f32s(self.values), ..self }
    }

    #[inline(always)]
    pub fn exceeds(self, other: Self) -> Mask<S> {
        Mask { simd: self.simd, mask: self.simd.greater_than_f32s(self.values, other.values) }
    }

    #[inline(always)]
    pub fn lane(&self, lane: usize) -> f32 {
        self.as_slice()[lane]
    }

    #[inline(always)]
    pub fn set_lane(&mut self, lane: usize, value: f32) {
        pulp::bytemuck::cast_slice_mut(std::slice::from_mut(&mut self.values))[lane] = value;
    }

    #[inline(always)]
    pub fn as_slice(&self) -> &[f32] {
        pulp::bytemuck::cast_slice(std::slice::from_ref(&self.values))
    }
}

impl<S: Simd> Mask<S> {
    /// Whether any lane says yes.
    #[inline(always)]
    pub fn any(self) -> bool {
        self.simd.first_true_m32s(self.mask) != S::F32_LANES
    }

    /// Returns `yes` in the lanes of the mask, else `no`.
    #[inline(always)]
    pub fn select(self, yes: Lanes<S>, no: Lanes<S>) -> Lanes<S> {
        Lanes { values: self.simd.select_f32s(self.mask, yes.values, no.values), ..yes }
    }
}

/// Implements an operator for numbers.
macro_rules! operator {
    ($operator:ident, $method:ident, $instruction:ident) => {
        impl<S: Simd> $operator for Lanes<S> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self { values: self.simd.$instruction(self.values, other.values), ..self }
            }
        }
    };
}

operator!(Add, add, add_f32s);
operator!(Sub, sub, sub_f32s);
operator!(Mul, mul, mul_f32s);
operator!(Div, div, div_f32s);

impl<S: Simd> Neg for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        // The processor's own instruction for it is not inlined by `pulp`.
        self.same(0.0) - self
    }
}

impl<S: Simd> Vectors<S> {
    #[inline(always)]
    pub fn all(simd: S, vector: Vec3) -> Self {
        Self {
            x: Lanes::all(simd, vector.x),
            y: Lanes::all(simd, vector.y),
            z: Lanes::all(simd, vector.z),
        }
    }

    #[inline(always)]
    pub fn dot(self, other: Self) -> Lanes<S> {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    #[inline(always)]
    pub fn cross(self, other: Self) -> Self {
        Self {
            x: self.y * other.z - self.z * other.y,
            y: self.z * other.x - self.x * other.z,
            z: self.x * other.y - self.y * other.x,
        }
    }

    #[inline(always)]
    pub fn length_squared(self) -> Lanes<S> {
        self.dot(self)
    }

    #[inline(always)]
    pub fn lane(&self, lane: usize) -> Vec3 {
        Vec3::new(self.x.lane(lane), self.y.lane(lane), self.z.lane(lane))
    }

    #[inline(always)]
    pub fn set_lane(&mut self, lane: usize, value: Vec3) {
        self.x.set_lane(lane, value.x);
        self.y.set_lane(lane, value.y);
        self.z.set_lane(lane, value.z);
    }
}

impl<S: Simd> Add for Vectors<S> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y, z: self.z + other.z }
    }
}

impl<S: Simd> Sub for Vectors<S> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y, z: self.z - other.z }
    }
}

impl<S: Simd> Mul<Lanes<S>> for Vectors<S> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, by: Lanes<S>) -> Self {
        Self { x: self.x * by, y: self.y * by, z: self.z * by }
    }
}

impl<S: Simd> Neg for Vectors<S> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self { x: -self.x, y: -self.y, z: -self.z }
    }
}
