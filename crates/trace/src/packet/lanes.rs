//! Numbers and vectors in single precision, with one ray's in each lane of the processor's registers.
//!
//! Every function is inlined into the code that is compiled for the processor's widest instructions; closures would
//! not be. Products and sums are not fused, so that the result does not depend on the processor.

use brillianteer_optics::{Real, Truth, Vector};
use glam::Vec3;
use pulp::{Simd, bytemuck};
use std::ops::{Add, BitAnd, BitOr, Div, Index, Mul, Neg, Not, Sub};

/// The most lanes that any processor has.
pub(super) const MOST_LANES: usize = 16;

/// The greatest component of a fan or a shift. A larger fan would cover more than the whole sphere, and a larger shift
/// more than the body, and each bounce may multiply them.
const WIDEST_FAN: f32 = 1e4;

/// A number in each lane.
#[derive(Clone, Copy)]
pub(super) struct Lanes<S: Simd> {
    simd: S,
    values: S::f32s,
}

/// A vector in each lane; each of the three coordinates has all lanes.
#[derive(Clone, Copy)]
pub(super) struct Vectors<S: Simd>(pub [Lanes<S>; 3]);

/// A truth value in each lane.
#[derive(Clone, Copy)]
pub(super) struct Mask<S: Simd> {
    simd: S,
    mask: S::m32s,
}

impl<S: Simd> Lanes<S> {
    #[inline(always)]
    pub fn splat(simd: S, value: f32) -> Self {
        Self { simd, values: simd.splat_f32s(value) }
    }

    /// Returns the same number in every lane; [`Real::constant`] does so for formulae that any number type shares.
    #[inline(always)]
    pub fn all(self, value: f32) -> Self {
        Self::splat(self.simd, value)
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
        let all_but_sign = self.simd.splat_f32s(f32::from_bits(0x7fff_ffff));
        Self { values: self.simd.and_f32s(self.values, all_but_sign), ..self }
    }

    #[inline(always)]
    pub fn sqrt(self) -> Self {
        Self { values: self.simd.sqrt_f32s(self.values), ..self }
    }

    /// Returns the numbers times the sign of `other`: negated in the lanes where `other` is negative.
    #[inline(always)]
    pub fn times_sign_of(self, other: Self) -> Self {
        let sign = self.simd.and_f32s(other.values, self.simd.splat_f32s(-0.0));
        Self { values: self.simd.xor_f32s(self.values, sign), ..self }
    }

    #[inline(always)]
    pub fn less(self, other: Self) -> Mask<S> {
        Mask { simd: self.simd, mask: self.simd.less_than_f32s(self.values, other.values) }
    }

    #[inline(always)]
    pub fn at_most(self, other: Self) -> Mask<S> {
        Mask { simd: self.simd, mask: self.simd.less_than_or_equal_f32s(self.values, other.values) }
    }

    #[inline(always)]
    pub fn is_negative(self) -> Mask<S> {
        self.less(self.all(0.0))
    }

    #[inline(always)]
    pub fn is_positive(self) -> Mask<S> {
        self.all(0.0).less(self)
    }

    #[inline(always)]
    pub fn lane(&self, lane: usize) -> f32 {
        self.as_slice()[lane]
    }

    #[inline(always)]
    pub fn set_lane(&mut self, lane: usize, value: f32) {
        bytemuck::cast_slice_mut(std::slice::from_mut(&mut self.values))[lane] = value;
    }

    #[inline(always)]
    pub fn as_slice(&self) -> &[f32] {
        bytemuck::cast_slice(std::slice::from_ref(&self.values))
    }
}

impl<S: Simd> Mask<S> {
    /// Returns whether the mask is true in any lane.
    #[inline(always)]
    pub fn any(self) -> bool {
        self.simd.first_true_m32s(self.mask) != S::F32_LANES
    }

    /// Returns whether the mask is true in all lanes.
    #[inline(always)]
    pub fn all(self) -> bool {
        self.simd.first_true_m32s(self.simd.not_m32s(self.mask)) == S::F32_LANES
    }

    /// Returns `yes` in the lanes where the mask is true, and `no` in the others.
    #[inline(always)]
    pub fn select(self, yes: Lanes<S>, no: Lanes<S>) -> Lanes<S> {
        Lanes { values: self.simd.select_f32s(self.mask, yes.values, no.values), ..yes }
    }
}

/// Implements an operator between numbers lane by lane, and between the numbers of all lanes and one number.
macro_rules! operator {
    ($operator:ident, $method:ident, $instruction:ident) => {
        impl<S: Simd> $operator for Lanes<S> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self { values: self.simd.$instruction(self.values, other.values), ..self }
            }
        }

        impl<S: Simd> $operator<f32> for Lanes<S> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: f32) -> Self {
                Self { values: self.simd.$instruction(self.values, self.simd.splat_f32s(other)), ..self }
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
        Self { values: self.simd.xor_f32s(self.values, self.simd.splat_f32s(-0.0)), ..self }
    }
}

impl<S: Simd> BitAnd for Mask<S> {
    type Output = Self;

    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        Self { mask: self.simd.and_m32s(self.mask, other.mask), ..self }
    }
}

impl<S: Simd> BitOr for Mask<S> {
    type Output = Self;

    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Self { mask: self.simd.or_m32s(self.mask, other.mask), ..self }
    }
}

impl<S: Simd> Not for Mask<S> {
    type Output = Self;

    #[inline(always)]
    fn not(self) -> Self {
        Self { mask: self.simd.not_m32s(self.mask), ..self }
    }
}

impl<S: Simd> Vectors<S> {
    #[inline(always)]
    pub fn splat(simd: S, vector: Vec3) -> Self {
        Self([Lanes::splat(simd, vector.x), Lanes::splat(simd, vector.y), Lanes::splat(simd, vector.z)])
    }

    #[inline(always)]
    pub fn dot(self, other: Self) -> Lanes<S> {
        self[0] * other[0] + self[1] * other[1] + self[2] * other[2]
    }

    #[inline(always)]
    pub fn cross(self, other: Self) -> Self {
        Self([
            self[1] * other[2] - self[2] * other[1],
            self[2] * other[0] - self[0] * other[2],
            self[0] * other[1] - self[1] * other[0],
        ])
    }

    #[inline(always)]
    pub fn length_squared(self) -> Lanes<S> {
        self.dot(self)
    }

    #[inline(always)]
    pub fn lane(&self, lane: usize) -> Vec3 {
        Vec3::new(self[0].lane(lane), self[1].lane(lane), self[2].lane(lane))
    }

    #[inline(always)]
    pub fn set_lane(&mut self, lane: usize, value: Vec3) {
        self.0[0].set_lane(lane, value.x);
        self.0[1].set_lane(lane, value.y);
        self.0[2].set_lane(lane, value.z);
    }
}

impl<S: Simd> Real for Lanes<S> {
    type Truth = Mask<S>;

    const LEAST_COS_T_SQUARED: f64 = f32::LEAST_COS_T_SQUARED;
    const LEAST_COS: f64 = f32::LEAST_COS;
    const SQUARE_ON: f64 = f32::SQUARE_ON;
    const TINY: f64 = f32::TINY;

    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        self.all(value as f32)
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self::max(self, other)
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self::min(self, other)
    }

    #[inline(always)]
    fn clamped(self) -> Self {
        Self::min(Self::max(self, self.all(0.0)), self.all(1.0))
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self::abs(self)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self::sqrt(self)
    }

    #[inline(always)]
    fn exp(self) -> Self {
        let mut powers = self;
        for lane in 0..S::F32_LANES {
            powers.set_lane(lane, self.lane(lane).exp());
        }
        powers
    }

    #[inline(always)]
    fn times_sign_of(self, other: Self) -> Self {
        Self::times_sign_of(self, other)
    }

    #[inline(always)]
    fn less(self, other: Self) -> Mask<S> {
        Self::less(self, other)
    }

    #[inline(always)]
    fn over(self, divisor: Self) -> Self {
        self * (self.all(1.0) / divisor)
    }

    #[inline(always)]
    fn of_single(self) -> Option<f64> {
        None
    }
}

impl<S: Simd> Truth<Lanes<S>> for Mask<S> {
    #[inline(always)]
    fn select(self, yes: Lanes<S>, no: Lanes<S>) -> Lanes<S> {
        Self::select(self, yes, no)
    }

    #[inline(always)]
    fn of_single(self) -> Option<bool> {
        None
    }
}

impl<S: Simd> Vector for Vectors<S> {
    type Real = Lanes<S>;

    #[inline(always)]
    fn dot(self, other: Self) -> Lanes<S> {
        Self::dot(self, other)
    }

    #[inline(always)]
    fn cross(self, other: Self) -> Self {
        Self::cross(self, other)
    }

    #[inline(always)]
    fn over(self, divisor: Lanes<S>) -> Self {
        self * (divisor.all(1.0) / divisor)
    }

    #[inline(always)]
    fn select(truth: Mask<S>, yes: Self, no: Self) -> Self {
        Self([truth.select(yes[0], no[0]), truth.select(yes[1], no[1]), truth.select(yes[2], no[2])])
    }

    #[inline(always)]
    fn renormalised(self) -> Self {
        // This is one Newton step toward unit length.
        let square = self.dot(self);
        self * (square.all(1.5) - square.all(0.5) * square)
    }

    #[inline(always)]
    fn limited(self) -> Self {
        let most = self[0].abs().max(self[1].abs()).max(self[2].abs()).max(self[0].all(1e-30));
        self * (most.all(WIDEST_FAN) / most).min(most.all(1.0))
    }
}

impl<S: Simd> Index<usize> for Vectors<S> {
    type Output = Lanes<S>;

    #[inline(always)]
    fn index(&self, axis: usize) -> &Lanes<S> {
        &self.0[axis]
    }
}

impl<S: Simd> Add for Vectors<S> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self([self[0] + other[0], self[1] + other[1], self[2] + other[2]])
    }
}

impl<S: Simd> Sub for Vectors<S> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self([self[0] - other[0], self[1] - other[1], self[2] - other[2]])
    }
}

impl<S: Simd> Mul<Lanes<S>> for Vectors<S> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, by: Lanes<S>) -> Self {
        Self([self[0] * by, self[1] * by, self[2] * by])
    }
}

impl<S: Simd> Neg for Vectors<S> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self([-self[0], -self[1], -self[2]])
    }
}
