//! The wave that a plate is sheared by.

use super::jet::Jet;
use crate::eigen::outer;
use glam::{DMat3, DVec3};
use std::f64::consts::TAU;

/// The height z = a sin(k x + phase) sin(k y + phase) = a/2 (cos k(x - y) - cos(k(x + y) + 2 phase)).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Wave {
    pub amplitude: f64,
    /// The wave number k = 2π / wavelength.
    pub number: f64,
    phase: f64,
}

impl Wave {
    pub fn new(amplitude: f64, wavelength: f64, phase: f64) -> Self {
        Self { amplitude, number: TAU / wavelength, phase }
    }

    /// Returns the amplitude in units of `unit`, the number of waves in a unit, and the phase as a part of a turn, 0 to 1.
    pub fn parts(&self, unit: f64) -> [f64; 3] {
        [self.amplitude / unit, self.number * unit / TAU, (self.phase / TAU).rem_euclid(1.0)]
    }

    /// Returns the arguments of the two cosines.
    #[inline]
    fn angles(&self, p: DVec3) -> [f64; 2] {
        [self.number * (p.x - p.y), self.number * (p.x + p.y) + 2.0 * self.phase]
    }

    #[inline]
    pub fn height(&self, p: DVec3) -> f64 {
        let [a, b] = self.angles(p);
        self.amplitude / 2.0 * (a.cos() - b.cos())
    }

    /// Returns the height and its gradient, whose z is 0.
    #[inline]
    pub fn rise(&self, p: DVec3) -> (f64, DVec3) {
        let [(sin_a, cos_a), (sin_b, cos_b)] = self.angles(p).map(f64::sin_cos);
        let half = self.amplitude / 2.0;
        (half * (cos_a - cos_b), DVec3::new(sin_b - sin_a, sin_b + sin_a, 0.0) * (half * self.number))
    }

    /// Returns an upper bound for how fast the slope changes along any line of this direction: a k² (dx² + dy²).
    pub fn most_bend(&self, direction: DVec3) -> f64 {
        self.amplitude * self.number * self.number * direction.truncate().length_squared()
    }

    /// Returns the jet of the sheared body at `p`, from the jet of the body at the point with the shear undone.
    pub fn shear(&self, jet: Jet, p: DVec3) -> Jet {
        let (_, rise) = self.rise(p);
        let [a, b] =
            self.angles(p).map(|angle| angle.cos() * self.amplitude / 2.0 * self.number * self.number);
        let straight = b - a;
        let bend = DMat3::from_cols_array_2d(&[[straight, a + b, 0.0], [a + b, straight, 0.0], [0.0; 3]]);
        // The derivative of the point with the shear undone by the point itself: the identity less z times the rise.
        let change = DMat3::IDENTITY - outer(DVec3::Z, rise);
        let falling = jet.gradient.z;
        Jet {
            value: jet.value,
            gradient: jet.gradient - rise * falling,
            hessian: change.transpose() * jet.hessian * change - bend * falling,
        }
    }
}
