//! A sunset over water: a sky from deep blue through rose to gold, thin clouds with lit edges, far hills, and the path of
//! the sun's light on the waves. z is up; the sun stands low, a little to the right of azimuth 0.
//!
//! Glitter is the reflection of the sun in facets of waves whose slopes are normally distributed (C. Cox and W. Munk,
//! *Measurement of the Roughness of the Sea Surface from Photographs of the Sun's Glitter*, 1954). Waves wider than
//! the footprint are drawn as shapes; the finer ones add to the spread of slopes.

use super::noise::{curve, fractal, noise, ramp};
use super::table::DirectionTable;
use super::waves::{WaterPoint, Waves, swells};
use glam::{DMat2, DVec2, DVec3};
use std::sync::LazyLock;

/// Azimuth and elevation of the sun, radians.
const SUN_AT: DVec2 = DVec2::new(-0.17, 0.052);
/// Half the sun's width, radians; wider than the true sun, as in haze.
const SUN_RADIUS: f64 = 0.0095;
const SUN_COLOUR: DVec3 = DVec3::new(900.0, 520.0, 200.0);

/// The sky toward the sun, from the horizon to the zenith at even steps of the root of the elevation.
const NEAR_SUN: [DVec3; 7] = [
    DVec3::new(1.00, 0.33, 0.07),
    DVec3::new(0.98, 0.36, 0.095),
    DVec3::new(0.50, 0.165, 0.135),
    DVec3::new(0.090, 0.078, 0.190),
    DVec3::new(0.034, 0.066, 0.195),
    DVec3::new(0.022, 0.050, 0.155),
    DVec3::new(0.013, 0.030, 0.10),
];

/// The sky away from the sun: the earth's shadow, rose above it.
const AWAY: [DVec3; 7] = [
    DVec3::new(0.11, 0.095, 0.16),
    DVec3::new(0.17, 0.115, 0.19),
    DVec3::new(0.24, 0.145, 0.215),
    DVec3::new(0.105, 0.105, 0.205),
    DVec3::new(0.043, 0.074, 0.18),
    DVec3::new(0.020, 0.046, 0.14),
    DVec3::new(0.013, 0.030, 0.10),
];

/// The radiance of the water itself.
const WATER: DVec3 = DVec3::new(0.004, 0.017, 0.030);

/// The direction to the sun.
static SUN: LazyLock<DVec3> = LazyLock::new(|| {
    let ((sin_a, cos_a), (sin_e, cos_e)) = (SUN_AT.x.sin_cos(), SUN_AT.y.sin_cos());
    DVec3::new(cos_e * cos_a, cos_e * sin_a, sin_e)
});

/// The water.
static WAVES: LazyLock<Waves<8>> = LazyLock::new(|| Waves {
    eye: 5.0,
    finest: 0.22,
    coarser: 2.1,
    slopes: [0.040, 0.046, 0.050, 0.046, 0.036, 0.026, 0.018, 0.012],
    swells: swells(DMat2::from_cols(DVec2::new(0.96, 0.28), DVec2::new(-0.28, 0.96)), 0.6, (0.4, 0.9)),
    calm: 0.022,
    hidden_from: 1.1,
    longest: 60.0,
});

/// Returns the radiance from a unit direction, averaged over a footprint in radians.
pub(super) fn radiance(d: DVec3, footprint: f64) -> DVec3 {
    let below = water(d, footprint);
    let above = if d.z > -footprint { sky(d, footprint, true) } else { DVec3::ZERO };
    above.lerp(below, 1.0 - ramp(-0.5, 0.5, d.z / footprint.max(1e-6)))
}

/// The sky of reflections, by azimuth and the root of the sine of the elevation.
static MIRRORED: LazyLock<DirectionTable> = LazyLock::new(|| {
    DirectionTable::new([1024, 128], |x, y| {
        let (sin, cos) = (std::f64::consts::TAU * x).sin_cos();
        let z = y * y;
        let flat = (1.0 - z * z).max(0.0).sqrt();
        sky(DVec3::new(flat * cos, flat * sin, z), 0.012, false)
    })
});

/// The tops of the ranges of hills by azimuth, as sines of their elevation: the farthest first.
static RANGES: LazyLock<DirectionTable> = LazyLock::new(|| DirectionTable::new([8192, 1], |x, _| ranges(x)));

fn around(d: DVec3) -> f64 {
    d.y.atan2(d.x) / std::f64::consts::TAU
}

/// Returns the sky with its clouds, the sun and the hills.
fn sky(d: DVec3, footprint: f64, is_direct: bool) -> DVec3 {
    let sun = *SUN;
    let from_sun = (d - sun).length();
    let flat = d.truncate().length().max(1e-9);
    let ahead = d.truncate().dot(sun.truncate()) / (flat * sun.truncate().length());
    let height = (d.z.clamp(0.0, 1.0).asin() / std::f64::consts::FRAC_PI_2).sqrt();
    let side = (0.5 + 0.5 * ahead).powi(2) * flat.min(1.0);
    let clear = curve(&AWAY, height).lerp(curve(&NEAR_SUN, height), side);
    let glow = DVec3::new(1.0, 0.46, 0.12) * 0.62 * (-from_sun / 0.115).exp()
        + DVec3::new(1.0, 0.62, 0.24) * 3.4 * (-from_sun / 0.028).exp();
    let mut light = clear + glow;
    if is_direct {
        let edge = (0.5 * footprint).max(0.0006);
        light += SUN_COLOUR * (1.0 - ramp(SUN_RADIUS - edge, SUN_RADIUS + edge, from_sun));
    }
    light = streaks(d, footprint, clouds(d, footprint, light, from_sun, side), from_sun, side);
    hills(d, footprint, light, from_sun)
}

/// Lays torn sheets of high cloud, drawn out along the wind, over the light of the sky.
fn clouds(d: DVec3, footprint: f64, behind: DVec3, from_sun: f64, side: f64) -> DVec3 {
    let lift = d.z.max(0.0) + 0.06;
    let p = d.truncate() / lift;
    let width = footprint / (lift * lift);
    let wind = DMat2::from_cols(DVec2::new(0.50, 0.24), DVec2::new(-0.80, 1.10));
    let q = wind * p;
    let wide = 0.62 * noise(q * 0.24 + 3.1, 31).0;
    if wide < -0.28 {
        return behind;
    }
    let torn = q + 0.5 * DVec2::new(noise(q * 0.9, 11).0, noise(q * 0.9 + 7.7, 12).0);
    let here = fractal(torn * 1.3, 6, width * 1.3, 21) + wide;
    let cover = ramp(-0.02, 0.36, here) * ramp(0.0, 0.10, d.z);
    if cover <= 0.0 {
        return behind;
    }
    let toward_sun = wind * SUN.truncate() * 0.10;
    let beyond = fractal((torn + toward_sun) * 1.3, 4, width * 1.3, 21) + wide;
    let lit = (0.36 + 1.9 * (here - beyond)).clamp(0.0, 1.0);
    let near = (-from_sun / 0.40).exp();
    let shade = DVec3::new(0.060, 0.055, 0.115).lerp(DVec3::new(0.26, 0.105, 0.10), near);
    let rim = DVec3::new(0.58, 0.24, 0.24) * (0.30 + 0.70 * side) + DVec3::new(3.2, 1.25, 0.34) * near;
    let colour = shade.lerp(rim, lit * lit);
    // Thin parts let the sky through and are bright toward the sun.
    let thin = behind + rim * 0.30;
    let sheet = thin.lerp(colour, ramp(0.15, 0.95, cover));
    behind.lerp(sheet, cover * 0.94)
}

/// Lays long banks of cloud near the horizon over the light: dark, with an edge of gold below.
fn streaks(d: DVec3, footprint: f64, behind: DVec3, from_sun: f64, side: f64) -> DVec3 {
    let belt = ramp(0.02, 0.075, d.z) * (1.0 - ramp(0.10, 0.22, d.z));
    if belt <= 0.0 {
        return behind;
    }
    let at = DVec2::new(8.0 * around(d) * std::f64::consts::TAU, d.z * 46.0);
    let bank = |lift: f64| {
        let p = at + DVec2::new(0.0, lift);
        fractal(p * DVec2::new(0.55, 1.0), 5, footprint * 46.0, 81)
    };
    let here = bank(0.0);
    let cover = ramp(0.10, 0.42, here) * belt;
    if cover <= 0.0 {
        return behind;
    }
    let lit = ((here - bank(-0.35)) * 2.4).clamp(0.0, 1.0);
    let near = (-from_sun / 0.30).exp();
    let shade = DVec3::new(0.085, 0.060, 0.105).lerp(DVec3::new(0.36, 0.12, 0.075), near);
    let rim = DVec3::new(0.55, 0.22, 0.17) * side + DVec3::new(4.2, 1.7, 0.45) * near;
    behind.lerp(shade.lerp(rim, lit), cover * 0.85)
}

/// Returns the tops of the three ranges at a place of the ring from 0 to 1. The near ones leave a bay open for the sun.
fn ranges(x: f64) -> DVec3 {
    let azimuth = (x - (x + 0.5).floor()) * std::f64::consts::TAU;
    let range = |k: u32, height: f64, coarse: f64, bay: f64| {
        // The noise is taken on a circle, so that the ranges close behind the viewer.
        let at = DVec2::from_angle(azimuth) * coarse + 31.0 * f64::from(k);
        let shape = 0.30 + 0.95 * fractal(at, 7, 0.0008 * coarse, 40 + 8 * k);
        let from = azimuth - SUN_AT.x;
        let open = 0.22 + 0.78 * ramp(bay - 0.14, bay + 0.42, from.abs() + 0.05 * from.signum());
        height * shape.max(0.0) * open
    };
    DVec3::new(range(0, 0.050, 5.0, 0.02), range(1, 0.046, 7.0, 0.18), range(2, 0.038, 10.0, 0.46))
}

/// Lays three ranges of hills over the light, the far ones pale with haze.
fn hills(d: DVec3, footprint: f64, behind: DVec3, from_sun: f64) -> DVec3 {
    if d.z > 0.07 {
        return behind;
    }
    let tops = RANGES.at(around(d), 0.0).to_array();
    let air = DVec3::new(0.25, 0.145, 0.175) + DVec3::new(1.0, 0.34, 0.075) * (-from_sun / 0.24).exp();
    let ground = DVec3::new(0.010, 0.010, 0.020);
    tops.into_iter().zip([0.66, 0.36, 0.10]).fold(behind, |light, (top, haze)| {
        let cover = 1.0 - ramp(-0.5, 0.5, (d.z - top) / footprint.max(8e-4));
        let haze = haze * (1.0 - 0.5 * ramp(0.0, top.max(1e-6), d.z));
        light.lerp(ground.lerp(air, haze), cover)
    })
}

/// Returns the water: the sky and the sun in its waves.
fn water(d: DVec3, footprint: f64) -> DVec3 {
    let WaterPoint { distance, slope, hidden, facing, mut mirrored } = WAVES.met(d, footprint);
    // Rough water shows mostly the sides of waves that face the eye.
    let spread = hidden.sqrt();
    let facing = (facing * facing + 0.6 * hidden).sqrt().min(1.0);
    let fresnel = 0.02 + 0.98 * (1.0 - facing).powi(5);
    mirrored.z = mirrored.z.abs() + 0.7 * spread;
    let mirrored = mirrored / mirrored.length();
    let seen = MIRRORED.at(around(mirrored), mirrored.z.max(0.0).sqrt());
    let light = fresnel * seen + (1.0 - fresnel) * WATER + glitter(d, slope, hidden, facing);
    let far = 1.0 - (-distance / 2500.0).exp();
    light.lerp(MIRRORED.at(around(d), 0.05), 0.5 * far)
}

/// Returns the sun in the waves.
fn glitter(d: DVec3, slope: DVec2, hidden: f64, facing: f64) -> DVec3 {
    let half = *SUN - d;
    let half = half / half.length();
    if half.z <= 0.0 {
        return DVec3::ZERO;
    }
    let wanted = -half.truncate() / half.z;
    let spread = hidden + 0.25 * SUN_RADIUS * SUN_RADIUS;
    let density =
        (-(wanted - slope).length_squared() / (2.0 * spread)).exp() / (std::f64::consts::TAU * spread);
    let fresnel = 0.02 + 0.98 * (1.0 - half.dot(*SUN).clamp(0.0, 1.0)).powi(5);
    let power = SUN_COLOUR * (std::f64::consts::PI * SUN_RADIUS * SUN_RADIUS);
    power * (fresnel * density / (4.0 * facing.max(0.06) * half.z.powi(4)))
}
