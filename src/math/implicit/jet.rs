//! A function's value and derivatives at a point, and how those of two functions make those of a third.

use glam::{DMat3, DVec3};

/// A function of space near a point, to the second order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jet {
    /// Its value, in girdle radii.
    pub value: f64,
    /// Its gradient.
    pub gradient: DVec3,
    /// The gradient's change per displacement: symmetric, in 1 / girdle radii.
    pub hessian: DMat3,
}

impl Jet {
    /// How far a point lies beyond a plane with a unit normal.
    #[inline]
    pub(super) fn plane(value: f64, normal: DVec3) -> Self {
        Self { value, gradient: normal, hessian: DMat3::ZERO }
    }

    /// Distance from an axis or a point, `away` from it: both parts square to what `across` projects on.
    #[inline]
    pub(super) fn radial(away: DVec3, across: DMat3) -> Self {
        let value = away.length();
        let gradient = away / value;
        Self { value, gradient, hessian: (across - outer(gradient, gradient)) * value.recip() }
    }

    /// The function less a number.
    #[inline]
    pub(super) fn less(self, by: f64) -> Self {
        Self { value: self.value - by, ..self }
    }

    /// The signed distance from what two solids share, of their signed distances along directions that are square to each
    /// other. Where the edge between them is `sharp`, only faces count: the same surface, with the normal of a face at
    /// every point of it.
    #[inline]
    pub(super) fn and(self, other: Self, sharp: bool) -> Self {
        let (a, b) = (self, other);
        if sharp || a.value.min(b.value) <= 0.0 {
            return if a.value > b.value { a } else { b };
        }
        let value = (a.value * a.value + b.value * b.value).sqrt();
        let gradient = (a.gradient * a.value + b.gradient * b.value) / value;
        // d² = a² + b², differentiated twice.
        let sum = outer(a.gradient, a.gradient)
            + outer(b.gradient, b.gradient)
            + (a.hessian * a.value + b.hessian * b.value)
            - outer(gradient, gradient);
        Self { value, gradient, hessian: sum * value.recip() }
    }

    /// The function of the same thing scaled and turned.
    pub(super) fn moved(self, scale: f64, turn: DMat3) -> Self {
        Self {
            value: self.value * scale,
            gradient: turn * self.gradient,
            hessian: turn * self.hessian * turn.transpose() * scale.recip(),
        }
    }

    /// The gradient's direction.
    pub(super) fn normal(&self) -> DVec3 {
        self.gradient / self.gradient.length()
    }

    /// Change of that direction per displacement within the level surface.
    pub(super) fn bend(&self) -> DMat3 {
        let normal = self.normal();
        let within = DMat3::IDENTITY - outer(normal, normal);
        within * self.hessian * within * self.gradient.length().recip()
    }
}

/// a bᵀ
#[inline]
pub(super) fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(a * b.x, a * b.y, a * b.z)
}
