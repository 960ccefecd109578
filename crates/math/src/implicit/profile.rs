//! The outlines from which cores are drawn out.

use super::jet::Jet;
use glam::{DMat3, DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// A convex outline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Profile {
    /// A rectangle in x and y with its corners at ±`half`, and a disc of radius `round` rolled around it. It is a stadium
    /// where one half is 0.
    Rectangle { half: DVec2, round: f64 },
    /// A triangle in y and z, symmetric in y.
    Triangle(Triangle),
}

/// An isosceles triangle with its base below.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Triangle {
    /// The end of the base at +y.
    pub corner: DVec2,
    /// The z of the apex.
    pub apex: f64,
    /// The outward unit normal of the flank at +y.
    pub normal: DVec2,
    /// The length of a flank.
    pub flank: f64,
}

/// Returns the radius of the circle inscribed in an isosceles triangle: the area over half the circumference.
pub(super) fn inradius(base: f64, height: f64) -> f64 {
    base * height / (base + base.hypot(2.0 * height))
}

impl Triangle {
    /// Makes a triangle with the origin halfway up, then moves its sides inward by `edge`: it shrinks toward the centre of
    /// its inscribed circle.
    pub fn new(base: f64, height: f64, edge: f64) -> Self {
        let flank = (base / 2.0).hypot(height);
        let shrunk = 1.0 - edge / inradius(base, height);
        let bottom = edge - height / 2.0;
        Self {
            corner: DVec2::new(base / 2.0 * shrunk, bottom),
            apex: bottom + height * shrunk,
            normal: DVec2::new(height, base / 2.0) / flank,
            flank: flank * shrunk,
        }
    }

    #[inline]
    fn jet(&self, p: DVec3, sharp: bool) -> Jet {
        let side = 1.0_f64.copysign(p.y);
        let folded = DVec2::new(p.y.abs(), p.z);
        let from_corner = folded - self.corner;
        let up = from_corner.dot(DVec2::new(-self.normal.y, self.normal.x));
        // Beyond a flank's end the nearest point is a corner; elsewhere it lies on a side.
        let beyond = if sharp {
            None
        } else if up > self.flank {
            Some(folded - DVec2::new(0.0, self.apex))
        } else {
            (up < 0.0 && from_corner.x > 0.0).then_some(from_corner)
        };
        if let Some(away) = beyond {
            let across = DMat3::from_diagonal(DVec3::new(0.0, 1.0, 1.0));
            return Jet::radial(DVec3::new(0.0, side * away.x, away.y), across);
        }
        let base = Jet::plane(-from_corner.y, DVec3::NEG_Z);
        let flank =
            Jet::plane(self.normal.dot(from_corner), DVec3::new(0.0, side * self.normal.x, self.normal.y));
        if base.value > flank.value { base } else { flank }
    }
}

impl Profile {
    /// Returns the signed distance from the outline; `sharp` as in [`Jet::and`].
    #[inline]
    pub fn jet(&self, p: DVec3, sharp: bool) -> Jet {
        match *self {
            Self::Rectangle { half, round } => {
                let x = Jet::plane(p.x.abs() - half.x, DVec3::X * 1.0_f64.copysign(p.x));
                let y = Jet::plane(p.y.abs() - half.y, DVec3::Y * 1.0_f64.copysign(p.y));
                x.and(y, sharp && round == 0.0).less(round)
            }
            Self::Triangle(triangle) => triangle.jet(p, sharp),
        }
    }

    /// Returns the outline's greatest coordinate along a direction.
    pub fn support(&self, direction: DVec3) -> f64 {
        match *self {
            Self::Rectangle { half, round } => {
                let d = direction.truncate();
                d.abs().dot(half) + d.length() * round
            }
            Self::Triangle(t) => {
                (direction.y.abs() * t.corner.x + direction.z * t.corner.y).max(direction.z * t.apex)
            }
        }
    }

    /// Returns the distance of the farthest point from the origin.
    pub fn reach(&self) -> f64 {
        match *self {
            Self::Rectangle { half, round } => half.length() + round,
            Self::Triangle(t) => t.corner.length().max(t.apex.abs()),
        }
    }

    /// Returns the area within the outline.
    pub fn area(&self) -> f64 {
        match *self {
            Self::Rectangle { half, round } => {
                4.0 * half.x * half.y + 4.0 * round * half.element_sum() + PI * round * round
            }
            Self::Triangle(t) => t.corner.x * (t.apex - t.corner.y),
        }
    }

    /// Returns the circumference of the outline as seen along a direction.
    ///
    /// `along` is the part of that direction within the outline's plane; `kept` is the factor by which lengths along this
    /// part appear shortened. The circumference of a Minkowski sum is the sum of the circumferences.
    pub fn circumference(&self, along: DVec3, kept: f64) -> f64 {
        let unit = along.try_normalize().unwrap_or(DVec3::ZERO);
        let seen = |edge: DVec3| (edge - unit * (edge.dot(unit) * (1.0 - kept))).length();
        match *self {
            Self::Rectangle { half, round } => {
                4.0 * (seen(DVec3::X) * half.x + seen(DVec3::Y) * half.y) + round * ellipse(kept)
            }
            Self::Triangle(t) => {
                let flank = |y: f64| seen(DVec3::new(0.0, y * t.corner.x, t.apex - t.corner.y));
                2.0 * t.corner.x * seen(DVec3::Y) + flank(1.0) + flank(-1.0)
            }
        }
    }
}

/// Returns the circumference of the ellipse with half axes 1 and b <= 1, by the arithmetic-geometric mean (Abramowitz and
/// Stegun 17.6).
fn ellipse(b: f64) -> f64 {
    let (mut a, mut g, mut sum, mut weight) = (1.0, b.max(f64::MIN_POSITIVE), 1.0 - 0.5 * (1.0 - b * b), 0.5);
    // Once the two means are near, each step doubles the digits: an ellipse as flat as 1e-300 takes a dozen steps.
    for _ in 0..16 {
        let c: f64 = (a - g) / 2.0;
        (a, g) = ((a + g) / 2.0, (a * g).sqrt());
        weight *= 2.0;
        sum -= weight * c * c;
    }
    TAU * sum / a
}
