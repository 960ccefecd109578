//! Smooth noise, the same on every machine for the same seed, from which clouds, waves, wood and windows are made.
//!
//! Gradient noise after K. Perlin, *An Image Synthesizer*, SIGGRAPH 1985, with the fade of *Improving Noise*, 2002.

use glam::{DMat2, DVec2, DVec3};

/// The number of directions that a corner's gradient may have.
const DIRECTIONS: usize = 16;

/// Between octaves the pattern turns by this cosine and sine (3, 4, 5), so that their grids never lie on each other.
const TURN: DMat2 = DMat2::from_cols(DVec2::new(0.8, 0.6), DVec2::new(-0.6, 0.8));

/// The directions of gradients, as unit vectors: cosines of sixteenths of a turn.
const GRADIENTS: [DVec2; DIRECTIONS] = {
    const A: f64 = 0.923_879_532_511_286_7;
    const B: f64 = 0.382_683_432_365_089_8;
    const C: f64 = std::f64::consts::FRAC_1_SQRT_2;
    [
        DVec2::new(1.0, 0.0),
        DVec2::new(A, B),
        DVec2::new(C, C),
        DVec2::new(B, A),
        DVec2::new(0.0, 1.0),
        DVec2::new(-B, A),
        DVec2::new(-C, C),
        DVec2::new(-A, B),
        DVec2::new(-1.0, 0.0),
        DVec2::new(-A, -B),
        DVec2::new(-C, -C),
        DVec2::new(-B, -A),
        DVec2::new(0.0, -1.0),
        DVec2::new(B, -A),
        DVec2::new(C, -C),
        DVec2::new(A, -B),
    ]
};

/// Odd numbers that spread the coordinates of cells and seeds over 32 bits (those of xxHash).
const ACROSS: u32 = 0x9e37_79b1;
const UP: u32 = 0x85eb_ca77;
const SEEDED: u32 = 0xc2b2_ae3d;

fn mixed(x: i64, y: i64, seed: u32) -> u32 {
    let mut h = (x as u32).wrapping_mul(ACROSS) ^ (y as u32).wrapping_mul(UP);
    h ^= seed.wrapping_mul(SEEDED);
    h = (h ^ (h >> 15)).wrapping_mul(0x2c1b_3c6d);
    h = (h ^ (h >> 12)).wrapping_mul(0x297a_2d39);
    h ^ (h >> 15)
}

/// Returns the greatest whole number that is not above `x`: quicker than `floor` where the processor has no instruction for it.
pub(super) fn whole(x: f64) -> i64 {
    let near = x as i64;
    near - i64::from(x < near as f64)
}

/// Returns a number from 0 to 1 that looks random, for a cell of a grid.
pub(super) fn random(x: i64, y: i64, seed: u32) -> f64 {
    f64::from(mixed(x, y, seed)) / f64::from(u32::MAX)
}

/// Returns noise, about -0.7 to 0.7 with a root mean square of 0.25, and its gradient; one swell is about 2 wide.
pub(super) fn noise(p: DVec2, seed: u32) -> (f64, DVec2) {
    let (x, y) = (whole(p.x), whole(p.y));
    let f = p - DVec2::new(x as f64, y as f64);
    let (left, low) =
        ((x as u32).wrapping_mul(ACROSS) ^ seed.wrapping_mul(SEEDED), (y as u32).wrapping_mul(UP));
    let (right, high) =
        ((x as u32).wrapping_add(1).wrapping_mul(ACROSS) ^ seed.wrapping_mul(SEEDED), low.wrapping_add(UP));
    let gradient = |h: u32| GRADIENTS[((h ^ (h >> 15)).wrapping_mul(0x2c1b_3c6d) >> 28) as usize];
    let [ga, gb, gc, gd] = [left ^ low, right ^ low, left ^ high, right ^ high].map(gradient);
    let (a, b) = (ga.dot(f), gb.dot(f - DVec2::X));
    let (c, d) = (gc.dot(f - DVec2::Y), gd.dot(f - DVec2::ONE));
    let u = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    let du = 30.0 * f * f * (f * (f - 2.0) + 1.0);
    let twist = a - b - c + d;
    let value = a + u.x * (b - a) + u.y * (c - a) + u.x * u.y * twist;
    let slope = ga + u.x * (gb - ga) + u.y * (gc - ga) + u.x * u.y * (ga - gb - gc + gd);
    (value, slope + du * DVec2::new(b - a + u.y * twist, c - a + u.x * twist))
}

/// Returns the sum of octaves of noise, each twice as fine and half as strong as the one before, about -1 to 1. Octaves
/// that are finer than `footprint`, in units of `p`, are left out softly.
pub(super) fn fractal(p: DVec2, octaves: u32, footprint: f64, seed: u32) -> f64 {
    let (mut at, mut weight, mut sum, mut width) = (p, 1.0, 0.0, footprint);
    for octave in 0..octaves {
        let seen = 1.0 - ramp(0.3, 0.9, width);
        if seen <= 0.0 {
            break;
        }
        sum += weight * seen * noise(at, seed + octave).0;
        at = TURN * at * 2.03 + DVec2::new(17.3, 9.1);
        (weight, width) = (weight * 0.5, width * 2.0);
    }
    sum
}

/// Rises smoothly from 0 at `from` to 1 at `to`.
pub(super) fn ramp(from: f64, to: f64, x: f64) -> f64 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Returns the part of a footprint around `x` that lies between two edges, 0 to 1.
pub(super) fn band(from: f64, to: f64, x: f64, footprint: f64) -> f64 {
    let half = 0.5 * footprint.max(1e-9);
    (((x + half).min(to) - (x - half).max(from)) / (2.0 * half)).clamp(0.0, 1.0)
}

/// Returns a smooth curve through colours that stand at even steps from 0 to 1 (Catmull and Rom).
pub(super) fn curve(colours: &[DVec3], x: f64) -> DVec3 {
    let last = colours.len() - 1;
    let at = x.clamp(0.0, 1.0) * last as f64;
    let k = (at as usize).min(last.saturating_sub(1));
    let f = at - k as f64;
    let [a, b, c, d] = [k.saturating_sub(1), k, (k + 1).min(last), (k + 2).min(last)].map(|i| colours[i]);
    let smooth = b + 0.5 * f * (c - a + f * (2.0 * a - 5.0 * b + 4.0 * c - d + f * (3.0 * (b - c) + d - a)));
    smooth.max(DVec3::ZERO)
}
