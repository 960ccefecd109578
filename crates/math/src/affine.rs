//! An affine function over the image plane: a constant plus a linear part.

use glam::DVec2;
use std::ops::{Add, Mul, Sub};

/// The affine function `constant + gradient · p` of a point `p` of the image plane.
///
/// Within a beam every quantity but the direction has this form: the point on a facet, the distance to the next
/// facet, the length of the path so far.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Affine {
    /// The value at the image's origin.
    pub constant: f64,
    /// The change per unit of image length.
    pub gradient: DVec2,
}

impl Affine {
    /// Makes the function with this value at the origin and this gradient.
    pub const fn new(constant: f64, gradient: DVec2) -> Self {
        Self { constant, gradient }
    }

    /// Returns the value at `p`.
    #[inline]
    pub fn at(&self, p: DVec2) -> f64 {
        self.constant + self.gradient.dot(p)
    }

    /// Returns an upper bound on the size of the terms over an image of half extent `extent`; rounding errors are
    /// proportional to it.
    #[inline]
    pub fn magnitude(&self, extent: f64) -> f64 {
        self.constant.abs() + extent * (self.gradient.x.abs() + self.gradient.y.abs())
    }
}

impl Add for Affine {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(self.constant + other.constant, self.gradient + other.gradient)
    }
}

impl Sub for Affine {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::new(self.constant - other.constant, self.gradient - other.gradient)
    }
}

impl Mul<f64> for Affine {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self::new(self.constant * factor, self.gradient * factor)
    }
}
