//! The real numbers over which formulae are written once: one in f64 or f32, or one ray's number in each lane of a
//! processor's registers.
//!
//! Implementations for lanes must inline every function into code that is compiled for the processor's widest
//! instructions; so must the formulae that are written over them, and none may pass a closure.

use glam::DVec3;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number, or one number in each lane.
pub trait Real:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// A truth value for each number.
    type Truth: Truth<Self>;

    /// Reflection counts as total where cos² of the angle of refraction is at or below this.
    ///
    /// In f64 the value is below every cos² that two different indices can give (their rounding is 1e-16), and far
    /// enough from 0 that dividing by it is safe. In f32 it is 0, because changes are divided by
    /// [`LEAST_COS`](Self::LEAST_COS) at least.
    const LEAST_COS_T_SQUARED: f64;

    /// The least cosine by which a change of a ray is divided. In f32 the change has no digits left nearer to 0; in f64 the
    /// value only prevents a division by 0.
    const LEAST_COS: f64;

    /// The sine of the angle between a ray and a facet's normal up to which the ray counts as perpendicular to the facet,
    /// because their cross product is mostly rounding.
    const SQUARE_ON: f64;

    /// The least positive number with all digits.
    const TINY: f64;

    /// Returns this constant in every lane.
    #[must_use]
    fn constant(self, value: f64) -> Self;

    /// Returns the greater of two numbers.
    #[must_use]
    fn max(self, other: Self) -> Self;

    /// Returns the lesser of two numbers.
    #[must_use]
    fn min(self, other: Self) -> Self;

    /// Returns the number, clamped to 0..=1.
    #[must_use]
    fn clamped(self) -> Self;

    /// Returns the absolute value.
    #[must_use]
    fn abs(self) -> Self;

    /// Returns the square root.
    #[must_use]
    fn sqrt(self) -> Self;

    /// Returns e to the power of the number.
    #[must_use]
    fn exp(self) -> Self;

    /// Returns the number times the sign of `other`: negated where `other` is negative.
    #[must_use]
    fn times_sign_of(self, other: Self) -> Self;

    /// Returns whether the number is less than another.
    fn less(self, other: Self) -> Self::Truth;

    /// Returns the number divided by another. Lanes are multiplied by the reciprocal, which the compiler computes once for
    /// all numbers that are divided by the same divisor.
    #[must_use]
    fn over(self, divisor: Self) -> Self;

    /// Returns a single number; `None` for lanes, which may hold different numbers.
    fn of_single(self) -> Option<f64>;
}

/// A truth value for each number.
pub trait Truth<N>: Copy {
    /// Returns `yes` where the value is true, and `no` elsewhere.
    fn select(self, yes: N, no: N) -> N;

    /// Returns the truth value of a single number; `None` for lanes, whose values may differ. The compiler knows which of
    /// the two it is, so that single numbers take one branch and lanes take both.
    fn of_single(self) -> Option<bool>;
}

/// A vector in space, or one vector in each lane.
pub trait Vector:
    Copy + Add<Output = Self> + Sub<Output = Self> + Neg<Output = Self> + Mul<Self::Real, Output = Self>
{
    /// The type of the coordinates.
    type Real: Real;

    /// Returns the scalar product.
    fn dot(self, other: Self) -> Self::Real;

    /// Returns the vector product.
    #[must_use]
    fn cross(self, other: Self) -> Self;

    /// Returns the vector divided by a number.
    #[must_use]
    fn over(self, divisor: Self::Real) -> Self;

    /// Returns `yes` where the value is true, and `no` elsewhere.
    fn select(truth: <Self::Real as Real>::Truth, yes: Self, no: Self) -> Self;

    /// Returns a nearly unit vector with the error of its length removed where the errors of a chain of bounces would
    /// add up, in single precision.
    #[must_use]
    fn renormalised(self) -> Self;

    /// Returns a change of a ray, shortened where single precision would let it grow without bounds from bounce to
    /// bounce.
    #[must_use]
    fn limited(self) -> Self;
}

impl<N> Truth<N> for bool {
    #[inline(always)]
    fn select(self, yes: N, no: N) -> N {
        if self { yes } else { no }
    }

    #[inline(always)]
    fn of_single(self) -> Option<bool> {
        Some(self)
    }
}

/// Implements the operations of a single number.
macro_rules! single {
    ($number:ident, $least_cos_t_squared:expr, $least_cos:expr, $square_on:expr) => {
        impl Real for $number {
            type Truth = bool;

            const LEAST_COS_T_SQUARED: f64 = $least_cos_t_squared;
            const LEAST_COS: f64 = $least_cos;
            const SQUARE_ON: f64 = $square_on;
            const TINY: f64 = $number::MIN_POSITIVE as f64;

            #[inline(always)]
            fn constant(self, value: f64) -> Self {
                value as $number
            }

            #[inline(always)]
            fn max(self, other: Self) -> Self {
                $number::max(self, other)
            }

            #[inline(always)]
            fn min(self, other: Self) -> Self {
                $number::min(self, other)
            }

            #[inline(always)]
            fn clamped(self) -> Self {
                self.clamp(0.0, 1.0)
            }

            #[inline(always)]
            fn abs(self) -> Self {
                $number::abs(self)
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                $number::sqrt(self)
            }

            #[inline(always)]
            fn exp(self) -> Self {
                $number::exp(self)
            }

            #[inline(always)]
            fn times_sign_of(self, other: Self) -> Self {
                if other.is_sign_negative() { -self } else { self }
            }

            #[inline(always)]
            fn less(self, other: Self) -> bool {
                self < other
            }

            #[inline(always)]
            fn over(self, divisor: Self) -> Self {
                self / divisor
            }

            #[inline(always)]
            fn of_single(self) -> Option<f64> {
                Some(self.into())
            }
        }
    };
}

// 1e-150 is the root of 1e-300.
single!(f64, 1e-300, 1e-150, 1e-9);
single!(f32, 0.0, 1e-4, 1e-4);

impl Vector for DVec3 {
    type Real = f64;

    #[inline(always)]
    fn dot(self, other: Self) -> f64 {
        Self::dot(self, other)
    }

    #[inline(always)]
    fn cross(self, other: Self) -> Self {
        Self::cross(self, other)
    }

    #[inline(always)]
    fn over(self, divisor: f64) -> Self {
        self / divisor
    }

    #[inline(always)]
    fn select(truth: bool, yes: Self, no: Self) -> Self {
        if truth { yes } else { no }
    }

    #[inline(always)]
    fn renormalised(self) -> Self {
        self
    }

    #[inline(always)]
    fn limited(self) -> Self {
        self
    }
}
