//! Frost: a Gaussian blur, whose width noise changes from place to place.

use super::outline::DomePoint;
use glam::{DVec2, IVec2};

/// The standard deviation of the blur at full intensity and roughness, as a part of the pane's shorter side.
const BLUR: f64 = 0.003;

/// The octaves of the noise: waves per shorter side of the pane, and weights.
const OCTAVES: [(f64, f64); 3] = [(40.0, 0.5), (80.0, 0.3), (160.0, 0.2)];

/// The distance of the outer samples from the middle one along each axis, in standard deviations: √3. With it and the
/// weights below, the samples have the moments of a Gaussian along each axis, up to the fifth (C. F. Gauss and C. Hermite).
const APART: f32 = 1.732_050_8;

/// A sample of the blur: its place in standard deviations, and its weight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FrostTap {
    pub at: [f32; 2],
    pub weight: f32,
}

const fn tap(x: f32, y: f32, weight: f32) -> FrostTap {
    FrostTap { at: [x * APART, y * APART], weight }
}

/// The sample of a place without frost.
pub(super) const CLEAR: [FrostTap; 1] = [tap(0.0, 0.0, 1.0)];

/// The samples of high quality: the middle, and two along each axis.
pub(super) const FIVE: [FrostTap; 5] = [
    tap(0.0, 0.0, 1.0 / 3.0),
    tap(1.0, 0.0, 1.0 / 6.0),
    tap(-1.0, 0.0, 1.0 / 6.0),
    tap(0.0, 1.0, 1.0 / 6.0),
    tap(0.0, -1.0, 1.0 / 6.0),
];

/// The samples of medium quality: the middle and one on either side, so that light spreads to the left and right alone.
/// They lie in the same two rows of pixels, of which the five need four.
pub(super) const THREE: [FrostTap; 3] =
    [tap(0.0, 0.0, 2.0 / 3.0), tap(1.0, 0.0, 1.0 / 6.0), tap(-1.0, 0.0, 1.0 / 6.0)];

/// Returns the standard deviation of the blur at a place of the pane, in parts of its shorter side.
pub(super) fn blur(at: DVec2, dome: &DomePoint, strength: f64) -> f64 {
    let intensity = (dome.normal.x.abs() + dome.normal.y.abs()) * strength / 100.0;
    if intensity == 0.0 {
        return 0.0;
    }
    intensity * roughness(at) * BLUR
}

/// Returns the roughness of the surface at a place, 0 to 1/3.
pub(super) fn roughness(at: DVec2) -> f64 {
    let noise = |((waves, weight), seed): ((f64, f64), u32)| weight * octave(at * waves, seed);
    OCTAVES.into_iter().zip(0..).map(noise).sum::<f64>() / 3.0
}

/// Returns value noise with a wave per unit, 0 to 1; the same place and seed give the same number.
fn octave(at: DVec2, seed: u32) -> f64 {
    let (base, part) = (at.floor(), at - at.floor());
    let corner = |dx, dy| value(base.as_ivec2().wrapping_add(IVec2::new(dx, dy)), seed);
    let even = part * part * (3.0 - 2.0 * part);
    let row = |dy| corner(0, dy) + (corner(1, dy) - corner(0, dy)) * even.x;
    row(0) + (row(1) - row(0)) * even.y
}

/// Returns the value of a lattice point, 0 to 1, by the hash pcg of M. Jarzynski and M. Olano, *Hash functions for GPU
/// rendering*, JCGT 9(3), 2020.
fn value(at: IVec2, seed: u32) -> f64 {
    let pcg = |v: u32| {
        let state = v.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
        (word >> 22) ^ word
    };
    let hash = pcg(at.x as u32 ^ pcg(at.y as u32 ^ pcg(seed)));
    f64::from(hash) / f64::from(u32::MAX)
}
