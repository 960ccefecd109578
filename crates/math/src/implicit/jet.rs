//! Jets: a function's value and derivatives at a point, and how two jets combine into a third.

use crate::eigen::outer;
use glam::{DMat3, DVec3};

/// A function of space near a point, to the second order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jet {
    /// The value, in girdle radii.
    pub value: f64,
    /// The gradient.
    pub gradient: DVec3,
    /// The change of the gradient with displacement: symmetric, in 1 / girdle radii.
    pub hessian: DMat3,
}

impl Jet {
    /// Makes the jet of the distance `value` of a point beyond a plane with this unit normal.
    #[inline]
    pub(super) fn plane(value: f64, normal: DVec3) -> Self {
        Self { value, gradient: normal, hessian: DMat3::ZERO }
    }

    /// Makes the jet of the distance from an axis or a point, for a point displaced from it by `away`.
    ///
    /// `across` projects onto the directions in which this distance changes; `away` lies within them.
    #[inline]
    pub(super) fn radial(away: DVec3, across: DMat3) -> Self {
        let value = away.length();
        let gradient = away / value;
        Self { value, gradient, hessian: (across - outer(gradient, gradient)) * value.recip() }
    }

    /// Subtracts a number from the function.
    #[inline]
    pub(super) fn less(self, by: f64) -> Self {
        Self { value: self.value - by, ..self }
    }

    /// Combines the signed distances from two solids into the signed distance from their intersection; their gradients must
    /// be at right angles to each other.
    ///
    /// Where the edge between the solids is `sharp`, only faces count: the surface is the same, and each of its points has
    /// the normal of a face.
    #[inline]
    pub(super) fn and(self, other: Self, sharp: bool) -> Self {
        let (a, b) = (self, other);
        if sharp || a.value.min(b.value) <= 0.0 {
            return if a.value > b.value { a } else { b };
        }
        let value = (a.value * a.value + b.value * b.value).sqrt();
        let gradient = (a.gradient * a.value + b.gradient * b.value) / value;
        // The derivatives follow from d² = a² + b², differentiated twice.
        let sum = outer(a.gradient, a.gradient)
            + outer(b.gradient, b.gradient)
            + (a.hessian * a.value + b.hessian * b.value)
            - outer(gradient, gradient);
        Self { value, gradient, hessian: sum * value.recip() }
    }

    /// Returns the direction of the gradient.
    pub(super) fn normal(&self) -> DVec3 {
        self.gradient / self.gradient.length()
    }

    /// Returns the change of the normal with displacement within the level surface.
    pub(super) fn bend(&self) -> DMat3 {
        let normal = self.normal();
        let within = DMat3::IDENTITY - outer(normal, normal);
        within * self.hessian * within * self.gradient.length().recip()
    }
}
