//! The wave by which a plate is sheared, in f32. It is the twin of `math/implicit/wave.rs`.

use super::super::lanes::{Lanes, Vectors};
use brillianteer_math::ImplicitSurface;
use pulp::Simd;
use std::f32::consts::TAU;

/// A wave with the height z = a sin(k x + phase) sin(k y + phase).
#[derive(Debug, Clone, Copy)]
pub(super) struct PacketWave {
    pub amplitude: f32,
    /// The wave number k.
    number: f32,
    /// The number of waves per unit of length.
    waves: f32,
    /// The phase, in turns.
    phase: f32,
}

/// A wave at a point.
pub(super) struct WavePoint<S: Simd> {
    pub height: Lanes<S>,
    /// The slopes of the wave along x and along y.
    pub rise: [Lanes<S>; 2],
    /// The second derivatives: the pure one, which is the same along x and along y, and the mixed one.
    pub bend: [Lanes<S>; 2],
}

impl PacketWave {
    /// Converts the wave of a shape to single precision; `None` where the shape has none.
    pub fn new(surface: &ImplicitSurface) -> Option<Self> {
        let reach = surface.reach();
        let [amplitude, waves, phase] = surface.parts().wave?;
        let waves = (waves / reach) as f32;
        Some(Self { amplitude: (amplitude * reach) as f32, number: waves * TAU, waves, phase: phase as f32 })
    }

    #[inline(always)]
    pub fn at<S: Simd>(&self, p: Vectors<S>) -> WavePoint<S> {
        let [sin_x, cos_x] = sin_cos(p[0] * self.waves + self.phase);
        let [sin_y, cos_y] = sin_cos(p[1] * self.waves + self.phase);
        let steep = self.amplitude * self.number;
        let height = sin_x * sin_y * self.amplitude;
        WavePoint {
            height,
            rise: [cos_x * sin_y * steep, sin_x * cos_y * steep],
            bend: [height * (-self.number * self.number), cos_x * cos_y * (steep * self.number)],
        }
    }

    /// Returns an upper bound for the rate of change of the slope along any line of this direction.
    #[inline(always)]
    pub fn most_bend<S: Simd>(&self, v: Vectors<S>) -> Lanes<S> {
        (v[0] * v[0] + v[1] * v[1]) * (self.amplitude * self.number * self.number)
    }
}

/// The sum of this number and a number from -2²² to 2²² has no fractional digits.
const WHOLE: f32 = 12_582_912.0;

/// Returns the sine and the cosine of an angle in turns, each with an error below 3e-7, in addition to the rounding
/// of the angle.
#[inline(always)]
pub(super) fn sin_cos<S: Simd>(turns: Lanes<S>) -> [Lanes<S>; 2] {
    let part = turns - ((turns + WHOLE) - WHOLE);
    let far = part.abs();
    let near = far.min(far.all(0.5) - far);
    [quarter_sine(near).times_sign_of(part), quarter_sine(far.all(0.25) - far)]
}

/// Returns the sine of an angle in turns, from minus a quarter turn to a quarter turn.
///
/// With the factor 2π in front, the greatest error of the polynomial is the least for its degree: 7.6e-9.
#[inline(always)]
fn quarter_sine<S: Simd>(turns: Lanes<S>) -> Lanes<S> {
    let z = turns * turns;
    let mut sum = z * 39.942_307 - 76.609_61;
    sum = sum * z + 81.604_004;
    sum = sum * z - 41.341_713;
    sum = sum * z + TAU;
    sum * turns
}
