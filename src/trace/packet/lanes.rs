//! Numbers, one in each lane of a register, with the operators of arithmetic.
//!
//! Everything here is inlined always. A function that is not inlined, or a closure, would not be compiled for the processor
//! that pulp finds when the program runs. Sums are not fused, so that results do not depend on the processor.

use super::Vec3s;
use pulp::{Simd, bytemuck};
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

/// A number in each lane.
#[derive(Clone, Copy)]
pub(super) struct Lanes<S: Simd> {
    simd: S,
    pub values: S::f32s,
}

/// A truth value in each lane.
#[derive(Clone, Copy)]
pub(super) struct Mask<S: Simd> {
    simd: S,
    bits: S::m32s,
}

/// A vector in each lane.
pub(super) type Vector<S> = [Lanes<S>; 3];

impl<S: Simd> Lanes<S> {
    #[inline(always)]
    pub fn new(simd: S, values: S::f32s) -> Self {
        Self { simd, values }
    }

    #[inline(always)]
    pub fn splat(simd: S, value: f32) -> Self {
        Self { simd, values: simd.splat_f32s(value) }
    }

    /// Returns the same number in every lane.
    #[inline(always)]
    pub fn all(self, value: f32) -> Self {
        Self::splat(self.simd, value)
    }

    #[inline(always)]
    pub fn abs(self) -> Self {
        Self { values: self.simd.abs_f32s(self.values), ..self }
    }

    #[inline(always)]
    pub fn sqrt(self) -> Self {
        Self { values: self.simd.sqrt_f32s(self.values), ..self }
    }

    #[inline(always)]
    pub fn min(self, other: Self) -> Self {
        Self { values: self.simd.min_f32s(self.values, other.values), ..self }
    }

    #[inline(always)]
    pub fn max(self, other: Self) -> Self {
        Self { values: self.simd.max_f32s(self.values, other.values), ..self }
    }

    /// Returns the numbers, negated in the lanes where `other` is negative.
    #[inline(always)]
    pub fn turned_as(self, other: Self) -> Self {
        let sign = self.simd.and_f32s(other.values, self.simd.splat_f32s(-0.0));
        Self { values: self.simd.xor_f32s(self.values, sign), ..self }
    }

    #[inline(always)]
    pub fn less(self, other: Self) -> Mask<S> {
        Mask { simd: self.simd, bits: self.simd.less_than_f32s(self.values, other.values) }
    }

    #[inline(always)]
    pub fn at_most(self, other: Self) -> Mask<S> {
        Mask { simd: self.simd, bits: self.simd.less_than_or_equal_f32s(self.values, other.values) }
    }

    #[inline(always)]
    pub fn is_negative(self) -> Mask<S> {
        self.less(self.all(0.0))
    }

    #[inline(always)]
    pub fn is_positive(self) -> Mask<S> {
        self.all(0.0).less(self)
    }
}

/// Implements an operator between the lanes of two registers, and between the lanes of one and a number.
macro_rules! operator {
    ($operator:ident, $name:ident, $simd_name:ident) => {
        impl<S: Simd> $operator for Lanes<S> {
            type Output = Self;

            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                Self { values: self.simd.$simd_name(self.values, other.values), ..self }
            }
        }

        impl<S: Simd> $operator<f32> for Lanes<S> {
            type Output = Self;

            #[inline(always)]
            fn $name(self, other: f32) -> Self {
                Self { values: self.simd.$simd_name(self.values, self.simd.splat_f32s(other)), ..self }
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
        Self { values: self.simd.neg_f32s(self.values), ..self }
    }
}

impl<S: Simd> Mask<S> {
    /// Returns the mask that is true in no lane.
    #[inline(always)]
    pub fn none(simd: S) -> Self {
        let zero = simd.splat_f32s(0.0);
        Self { simd, bits: simd.less_than_f32s(zero, zero) }
    }

    /// Whether the mask is true in any lane.
    #[inline(always)]
    pub fn any(self) -> bool {
        let simd = self.simd;
        let bits = simd.select_u32s(self.bits, simd.splat_u32s(1), simd.splat_u32s(0));
        let mut any = 0;
        for &lane in bytemuck::cast_slice::<S::u32s, u32>(std::slice::from_ref(&bits)) {
            any |= lane;
        }
        any != 0
    }

    #[inline(always)]
    pub fn select(self, if_true: Lanes<S>, if_false: Lanes<S>) -> Lanes<S> {
        let simd = self.simd;
        Lanes { simd, values: simd.select_f32s(self.bits, if_true.values, if_false.values) }
    }
}

impl<S: Simd> BitAnd for Mask<S> {
    type Output = Self;

    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        Self { bits: self.simd.and_m32s(self.bits, other.bits), ..self }
    }
}

impl<S: Simd> BitOr for Mask<S> {
    type Output = Self;

    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Self { bits: self.simd.or_m32s(self.bits, other.bits), ..self }
    }
}

impl<S: Simd> Not for Mask<S> {
    type Output = Self;

    #[inline(always)]
    fn not(self) -> Self {
        Self { bits: self.simd.not_m32s(self.bits), ..self }
    }
}

/// Gives vectors the operators of [`Lanes`].
#[inline(always)]
pub(super) fn vector<S: Simd>(simd: S, [x, y, z]: Vec3s<S>) -> Vector<S> {
    [Lanes::new(simd, x), Lanes::new(simd, y), Lanes::new(simd, z)]
}

/// Returns what a vector's lanes hold.
#[inline(always)]
pub(super) fn values<S: Simd>([x, y, z]: Vector<S>) -> Vec3s<S> {
    [x.values, y.values, z.values]
}

#[inline(always)]
pub(super) fn dot<S: Simd>(a: Vector<S>, b: Vector<S>) -> Lanes<S> {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Returns `a` + `b` times `factor`.
#[inline(always)]
pub(super) fn along<S: Simd>(a: Vector<S>, b: Vector<S>, factor: Lanes<S>) -> Vector<S> {
    [a[0] + b[0] * factor, a[1] + b[1] * factor, a[2] + b[2] * factor]
}

#[inline(always)]
pub(super) fn times<S: Simd>(a: Vector<S>, factor: Lanes<S>) -> Vector<S> {
    [a[0] * factor, a[1] * factor, a[2] * factor]
}
