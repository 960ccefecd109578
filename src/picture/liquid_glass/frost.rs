//! Frost: samples around a place, moved by noise.

use super::outline::DomePoint;
use glam::{DVec2, IVec2};

/// The unit of the samples' offsets at full intensity, as a part of the pane's shorter side.
const BLUR: f64 = 0.003;

/// The octaves of the noise: waves per shorter side of the pane, and weights.
const OCTAVES: [(f64, f64); 3] = [(40.0, 0.5), (80.0, 0.3), (160.0, 0.2)];

/// Offsets of the samples before noise moves them: the middle and a diagonal cross, in an order in which the first three
/// lie evenly.
const CROSS: [DVec2; 5] = [
    DVec2::ZERO,
    DVec2::splat(std::f64::consts::FRAC_1_SQRT_2),
    DVec2::splat(-std::f64::consts::FRAC_1_SQRT_2),
    DVec2::new(std::f64::consts::FRAC_1_SQRT_2, -std::f64::consts::FRAC_1_SQRT_2),
    DVec2::new(-std::f64::consts::FRAC_1_SQRT_2, std::f64::consts::FRAC_1_SQRT_2),
];

/// Returns the offsets of the samples around a place of the pane, all of the same weight. Without frost it is a single
/// offset of zero.
pub(super) fn taps(at: DVec2, dome: &DomePoint, strength: f64, count: usize) -> Vec<DVec2> {
    let reach = BLUR * (dome.normal.x.abs() + dome.normal.y.abs()) * strength / 100.0;
    if reach == 0.0 {
        return vec![DVec2::ZERO];
    }
    let stray = DVec2::new(noise(at, 0), noise(at, 1));
    CROSS.iter().take(count).map(|&place| (place + stray) * reach).collect()
}

/// Returns value noise, -1 to 1; the same place and seed give the same number.
pub(super) fn noise(at: DVec2, seed: u32) -> f64 {
    OCTAVES.into_iter().zip(0..).map(|((waves, weight), k)| weight * octave(at * waves, 3 * seed + k)).sum()
}

fn octave(at: DVec2, seed: u32) -> f64 {
    let (base, part) = (at.floor(), at - at.floor());
    let corner = |dx, dy| value(base.as_ivec2().wrapping_add(IVec2::new(dx, dy)), seed);
    let even = part * part * (3.0 - 2.0 * part);
    let row = |dy| corner(0, dy) + (corner(1, dy) - corner(0, dy)) * even.x;
    row(0) + (row(1) - row(0)) * even.y
}

/// Returns the number of a lattice point, -1 to 1, by the hash pcg of M. Jarzynski and M. Olano, *Hash functions for GPU
/// rendering*, JCGT 9(3), 2020.
fn value(at: IVec2, seed: u32) -> f64 {
    let pcg = |v: u32| {
        let state = v.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
        (word >> 22) ^ word
    };
    let hash = pcg(at.x as u32 ^ pcg(at.y as u32 ^ pcg(seed)));
    f64::from(hash) / f64::from(u32::MAX) * 2.0 - 1.0
}
