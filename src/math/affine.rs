//! A function that is linear in the image's coordinates, up to a constant.

use glam::DVec2;
use std::ops::{Add, Mul, Sub};

/// `constant + gradient · p` over the image plane.
///
/// Inside a beam everything about a ray but its direction is of this form: where it stands on a facet, how far
/// it has to go to the next one, how far it has come.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Affine {
    /// Value at the image's origin.
    pub constant: f64,
    /// Change per unit of image length.
    pub gradient: DVec2,
}

impl Affine {
    /// The function with this value at the origin and this slope.
    pub const fn new(constant: f64, gradient: DVec2) -> Self {
        Self { constant, gradient }
    }

    /// Value at `p`.
    #[inline]
    pub fn at(&self, p: DVec2) -> f64 {
        self.constant + self.gradient.dot(p)
    }

    /// An upper bound of the magnitude of its terms over an image of this half extent: the scale of rounding errors.
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
