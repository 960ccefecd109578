//! A city at night across water: towers in several depths with warm and cool windows, signs, lamps along the shore,
//! the glow of the sky, and their drawn-out reflections in the water. z is up; the middle of the picture is at
//! azimuth 0.
//!
//! Towers are strips of azimuth. Windows that are finer than the footprint fade to their mean. In the water, light of the
//! city is gathered over the elevations from which the waves send it to the eye.

use super::noise::{band, fractal, noise, ramp, random};
use super::table::DirectionTable;
use super::waves::{WaterPoint, Waves, swells};
use glam::{DMat2, DVec2, DVec3};
use std::f64::consts::TAU;
use std::sync::LazyLock;

/// A depth of the skyline.
struct Depth {
    /// The number of plots around the horizon.
    plots: f64,
    /// The least and the greatest elevation of roofs, as tangents.
    low: f64,
    high: f64,
    /// The height of a storey as a tangent of elevation; windows are half as wide again.
    storey: f64,
    /// The share of windows that are lit.
    lit: f64,
    /// The radiance of lit windows, white being 1.
    bright: f64,
    /// The strength of the air's glow over the towers, 0 to 1.
    haze: f64,
    /// The seed of the plots.
    seed: u32,
}

const DEPTHS: [Depth; 4] = [
    Depth {
        plots: 520.0,
        low: 0.030,
        high: 0.190,
        storey: 0.0013,
        lit: 0.42,
        bright: 0.34,
        haze: 0.78,
        seed: 100,
    },
    Depth {
        plots: 260.0,
        low: 0.035,
        high: 0.400,
        storey: 0.0019,
        lit: 0.46,
        bright: 0.75,
        haze: 0.46,
        seed: 200,
    },
    Depth {
        plots: 170.0,
        low: 0.026,
        high: 0.300,
        storey: 0.0026,
        lit: 0.48,
        bright: 1.20,
        haze: 0.20,
        seed: 300,
    },
    Depth {
        plots: 130.0,
        low: 0.014,
        high: 0.085,
        storey: 0.0034,
        lit: 0.46,
        bright: 1.70,
        haze: 0.05,
        seed: 400,
    },
];

/// The water.
static WATER: LazyLock<Waves<6>> = LazyLock::new(|| Waves {
    eye: 4.0,
    finest: 0.20,
    coarser: 2.3,
    slopes: [0.024, 0.030, 0.030, 0.022, 0.015, 0.009],
    swells: swells(DMat2::IDENTITY, 0.7, (0.3, 0.8)),
    calm: 0.012,
    hidden_from: 1.2,
    longest: 40.0,
});

/// The number of lamps around the shore.
const LAMPS: f64 = 520.0;

/// Returns the radiance from a unit direction, averaged over a footprint in radians.
pub(super) fn radiance(d: DVec3, footprint: f64) -> DVec3 {
    if d.z > 0.0 { above(d, footprint) } else { water(d, footprint) }
}

fn above(d: DVec3, footprint: f64) -> DVec3 {
    let flat = d.truncate().length().max(1e-9);
    let (azimuth, up) = (d.y.atan2(d.x), d.z / flat);
    let mut light = sky(d, azimuth, footprint);
    if up < 0.6 {
        light = skyline(azimuth, up, footprint / flat, light);
        light += shore(azimuth, up, footprint);
    }
    light
}

/// Returns the density of the city at an azimuth, 0 to 1: greatest before the viewer.
fn downtown(azimuth: f64) -> f64 {
    let away = (azimuth + 0.06).abs();
    0.30 + 0.70 * (-(away / 0.50).powi(2)).exp() + 0.45 * (-((azimuth.abs() - 2.2) / 0.4).powi(2)).exp()
}

/// Returns the glow above the city by elevation.
fn glow(azimuth: f64, z: f64) -> DVec3 {
    let city = downtown(azimuth);
    DVec3::new(0.36, 0.150, 0.070) * (city * (-z / 0.050).exp())
        + DVec3::new(0.115, 0.060, 0.085) * (city * (-z / 0.17).exp())
        + DVec3::new(0.016, 0.046, 0.120) * (-z / 0.40).exp()
        + DVec3::new(0.0035, 0.0085, 0.027)
}

/// Returns the night sky: the glow, clouds that it lights from below, stars.
fn sky(d: DVec3, azimuth: f64, footprint: f64) -> DVec3 {
    let z = d.z.max(0.0);
    let light = glow(azimuth, z);
    let lift = z + 0.10;
    let p = d.truncate() / lift;
    let width = footprint / (lift * lift);
    let wide = fractal(p * DVec2::new(0.5, 0.28) + 0.4 * noise(p * 0.4, 15).0, 5, width, 17);
    let cover = ramp(0.02, 0.55, wide + 0.05) * ramp(0.02, 0.16, z);
    let lit = glow(azimuth, z * 0.40) * 0.9 + DVec3::new(0.020, 0.012, 0.016);
    light.lerp(lit, 0.7 * cover) + stars(d, footprint) * (1.0 - cover) * ramp(0.12, 0.5, z)
}

/// Half the width of a star, radians.
const STAR: f64 = 0.0007;

fn stars(d: DVec3, footprint: f64) -> DVec3 {
    if d.z < 0.1 {
        return DVec3::ZERO;
    }
    let p = d.truncate() / (1.0 + d.z) * 46.0;
    let cell = p.floor();
    let (x, y) = (cell.x as i64, cell.y as i64);
    let bright = random(x, y, 23);
    if bright < 0.72 {
        return DVec3::ZERO;
    }
    let middle = DVec2::new(0.2 + 0.6 * random(x, y, 21), 0.2 + 0.6 * random(x, y, 22));
    let size = 46.0 * footprint.max(STAR);
    let off = (p - cell - middle).length_squared() / (size * size) * 2.2;
    let magnitude = ((bright - 0.72) / 0.28).powi(5) * 3.4 + 0.07;
    let share = (STAR / footprint.max(STAR)).powi(2);
    DVec3::new(0.85, 0.92, 1.1) * (magnitude * share * (-off).exp())
}

/// The towers of every depth, by plot, each as [`tower`] returns it.
static TOWERS: LazyLock<Vec<Vec<[f64; 3]>>> = LazyLock::new(|| {
    let all = |depth: &Depth| (0..depth.plots as i64).map(|plot| tower(depth, plot)).collect();
    DEPTHS.iter().map(all).collect()
});

/// Returns the tower on a plot: its left edge and width in plots, and its roof as a tangent of elevation.
fn tower(depth: &Depth, plot: i64) -> [f64; 3] {
    let of = |k: u32| random(plot, 0, depth.seed + k);
    let azimuth = TAU * (plot as f64 + 0.5) / depth.plots;
    let azimuth = azimuth - TAU * (azimuth / TAU).round();
    let rank = of(1);
    let tall = downtown(azimuth) * (0.25 * rank + 0.75 * rank.powi(4));
    let roof = depth.low * (0.5 + 0.5 * of(2)) + (depth.high - depth.low) * tall;
    // Towers reach into the next plot, so that some hide others.
    let wide = (0.62 + 0.24 * of(4)) * (1.0 + 0.7 * random(plot, 3, depth.seed));
    [0.18 * of(3), wide, roof]
}

/// Lays the towers of all depths over the light behind them.
fn skyline(azimuth: f64, up: f64, footprint: f64, behind: DVec3) -> DVec3 {
    let mut light = behind;
    for (depth, towers) in DEPTHS.iter().zip(TOWERS.iter()) {
        if up > depth.high * 1.3 + 0.03 {
            continue;
        }
        let at = azimuth / TAU * depth.plots;
        let plot = at.floor() as i64;
        for plot in [plot - 1, plot] {
            let [left, wide, roof] = towers[plot.rem_euclid(towers.len() as i64) as usize];
            let x = at - plot as f64 - left;
            let pixel = footprint * depth.plots / TAU;
            if x < -0.5 * pixel || x > wide + 0.5 * pixel || up > roof * 1.35 + footprint {
                continue;
            }
            light = facade(depth, plot, DVec2::new(x, up), DVec2::new(wide, roof), [pixel, footprint], light);
        }
    }
    light
}

/// Lays one tower over the light behind it. `at` is from its left edge, in plots, and up; `size` is its width and roof.
fn facade(
    depth: &Depth,
    plot: i64,
    at: DVec2,
    size: DVec2,
    [pixel, footprint]: [f64; 2],
    behind: DVec3,
) -> DVec3 {
    let ring = plot.rem_euclid(depth.plots as i64);
    let of = |k: u32| random(ring, 1, depth.seed + k);
    // Some towers step back or taper toward the top.
    let rise = at.y / size.y;
    let style = of(1);
    let inset = if style > 0.62 && rise > 0.80 { 0.16 } else { 0.0 }
        + if style > 0.85 && rise > 0.92 { 0.14 } else { 0.0 };
    let left = at.x - inset * size.x;
    let right = size.x * (1.0 - inset) - at.x;
    let cover =
        band(0.0, 1e9, left, pixel) * band(0.0, 1e9, right, pixel) * band(-1.0, size.y, at.y, footprint);
    let air = glow(TAU * plot as f64 / depth.plots, 0.02 + at.y * 0.6);
    let stone = DVec3::new(0.010, 0.010, 0.014) + DVec3::new(0.030, 0.018, 0.012) * (-at.y / 0.03).exp();
    let mut light = behind.lerp(stone.lerp(air, depth.haze), cover);
    light += windows(depth, ring, at, size, [pixel, footprint]) * (cover * (1.0 - 0.45 * depth.haze));
    light += crown(depth, ring, at, size, [pixel, footprint]) * (1.0 - 0.4 * depth.haze);
    light
}

/// Returns the light of a tower's windows, averaged over a footprint.
fn windows(depth: &Depth, ring: i64, at: DVec2, size: DVec2, [pixel, footprint]: [f64; 2]) -> DVec3 {
    let of = |k: u32| random(ring, 2, depth.seed + k);
    let pitch = DVec2::new(
        depth.storey * depth.plots / TAU * (0.75 + 0.7 * of(1)),
        depth.storey * (0.85 + 0.4 * of(2)),
    );
    let columns = (size.x / pitch.x).floor().max(2.0);
    let grid = DVec2::new(at.x / size.x * columns, (size.y - at.y) / pitch.y);
    let cell = grid.floor();
    let (x, y) = (cell.x as i64, cell.y as i64);
    let f = grid - cell;
    let blur = DVec2::new(pixel * columns / size.x, footprint / pitch.y);
    // Offices are lit by whole floors, homes window by window.
    let office = of(3);
    let share = depth.lit * (0.35 + 1.2 * of(4));
    let seed = depth.seed + 17;
    let key = x + 1009 * ring;
    let floor_lit = if random(ring, y, seed + 1) < 0.42 { 1.9 } else { 0.25 };
    let chance = if office > 0.55 { share * floor_lit } else { share };
    let is_lit = f64::from(u8::from(random(key, y, seed) < chance && y >= 1 && x >= 0 && x < columns as i64));
    let strength = 0.25 + 1.3 * random(key, y, seed + 2).powi(2);
    let wide = if of(5) > 0.7 { 0.46 } else { 0.34 };
    let pane = band(0.5 - wide, 0.5 + wide, f.x, blur.x) * band(0.22, 0.74, f.y, blur.y);
    let colour = tint(of(6), random(key, y, seed + 3));
    let mean = tint(of(6), 0.5) * (share * 0.68 * 2.0 * wide * 0.52);
    let far = ramp(0.6, 1.6, blur.max_element());
    (colour * (is_lit * strength * pane)).lerp(mean, far) * depth.bright
}

/// Returns the colour of a window: of its tower, and a little of its own.
fn tint(tower: f64, own: f64) -> DVec3 {
    const WARM: DVec3 = DVec3::new(2.4, 1.32, 0.52);
    const AMBER: DVec3 = DVec3::new(2.5, 1.02, 0.26);
    const WHITE: DVec3 = DVec3::new(1.75, 1.62, 1.35);
    const COOL: DVec3 = DVec3::new(0.95, 1.50, 1.95);
    let base = if tower < 0.45 {
        WARM
    } else if tower < 0.62 {
        AMBER
    } else if tower < 0.82 {
        WHITE
    } else {
        COOL
    };
    base.lerp(if own > 0.8 { COOL } else { WARM }, 0.5 * (2.0 * own - 1.0).abs())
}

/// The colours of signs and lit crowns.
const NEON: [DVec3; 6] = [
    DVec3::new(6.5, 0.35, 0.55),
    DVec3::new(0.25, 2.6, 6.5),
    DVec3::new(5.2, 2.3, 0.35),
    DVec3::new(3.6, 0.45, 5.6),
    DVec3::new(0.35, 5.0, 3.2),
    DVec3::new(5.5, 5.0, 4.2),
];

/// Returns the light at a tower's top: a lit crown, a spire with its beacon, a sign.
fn crown(depth: &Depth, ring: i64, at: DVec2, size: DVec2, [pixel, footprint]: [f64; 2]) -> DVec3 {
    let of = |k: u32| random(ring, 4, depth.seed + k);
    let mut light = DVec3::ZERO;
    let inside = band(0.0, size.x, at.x, pixel);
    let below = size.y - at.y;
    let is_tall = size.y > 0.55 * depth.high;
    let middle = (at.x - 0.5 * size.x).abs();
    let colour = NEON[(of(2) * 5.999) as usize];
    if is_tall && of(1) > 0.35 {
        // This light washes down from the roof.
        let wash = (-below.max(0.0) / (0.07 * size.y)).exp() * band(0.0, 1e9, below, footprint);
        light += colour * 0.10 * wash * inside;
        light += colour * 0.75 * inside * band(0.0, 0.0016, below, footprint);
    }
    if is_tall && of(3) > 0.3 {
        let spire = 0.30 * size.y * (0.4 + 0.6 * of(4));
        let mast = band(-0.012, 0.012, at.x - 0.5 * size.x, pixel) * band(-spire, 0.0, below, footprint);
        light += DVec3::new(0.035, 0.022, 0.022) * mast;
        let wide =
            DVec2::new((0.0011 * depth.plots / TAU).hypot(0.5 * pixel), 0.0011_f64.hypot(0.5 * footprint));
        let off = DVec2::new(middle, below + spire) / wide;
        let dim = 0.0011 * 0.0011 * depth.plots / TAU / (wide.x * wide.y);
        light += DVec3::new(14.0, 0.7, 0.35) * dim * (-off.length_squared()).exp();
    }
    if depth.haze < 0.3 && of(5) > 0.80 && size.y > 0.022 {
        let (half, drop) = (0.34 * size.x, 0.16 * size.y + 0.004);
        let high = 0.0035 + 0.006 * of(6);
        let sign = band(-half, half, at.x - 0.5 * size.x, pixel) * band(drop, drop + high, below, footprint);
        let letters =
            0.45 + 0.55 * band(0.25, 0.8, (at.x / (0.11 * size.x)).rem_euclid(1.0), 9.0 * pixel / size.x);
        light += colour * 1.15 * sign * letters;
        light += colour * 0.05 * (-((below - drop).abs() / 0.008)).exp() * inside;
    }
    light
}

/// Returns the lamp of a place along the shore: its azimuth, elevation as a tangent, and light.
fn lamp(place: i64) -> (f64, f64, DVec3) {
    let ring = place.rem_euclid(LAMPS as i64);
    let of = |k: u32| random(ring, 7, 500 + k);
    let azimuth = TAU * (place as f64 + 0.5 + 0.5 * (of(0) - 0.5)) / LAMPS;
    let kind = of(1);
    let colour = if kind > 0.93 {
        NEON[(of(2) * 5.999) as usize] * 1.6
    } else if kind > 0.7 {
        DVec3::new(7.0, 7.4, 7.6)
    } else {
        DVec3::new(10.5, 5.3, 1.5)
    };
    (azimuth, 0.0035 + 0.0022 * of(3), colour * (0.25 + 1.1 * of(4)))
}

/// Half the width of a lamp, radians.
const LAMP: f64 = 0.0010;

/// Returns the lamps along the shore, and the pale bank that they light.
fn shore(azimuth: f64, up: f64, footprint: f64) -> DVec3 {
    if up > 0.03 {
        return DVec3::ZERO;
    }
    let mut light = DVec3::new(0.055, 0.030, 0.014) * (-up / 0.0028).exp();
    let near = (azimuth / TAU * LAMPS).floor() as i64;
    for place in near - 1..=near + 1 {
        let (side, height, colour) = lamp(place);
        let size = LAMP.hypot(0.45 * footprint);
        let off = DVec2::new(azimuth - side, up - height).length_squared();
        let dim = (LAMP / size).powi(2);
        light += colour * (dim * 2.2 * (-off / (size * size)).exp() + 0.012 / (1.0 + off / 6e-6).powi(2));
    }
    light
}

/// The tangent of the highest elevation of [`CITY`].
const TOP: f64 = 0.50;

/// The city by azimuth and elevation up to [`TOP`], blurred upward over a hundredth of a radian, for reflections.
static CITY: LazyLock<DirectionTable> = LazyLock::new(|| {
    let (across, down) = (2048, 96);
    let pixel = TOP / (down - 1) as f64;
    DirectionTable::new([across, down], move |x, y| {
        let azimuth = TAU * (x - (x + 0.5).floor());
        let mean = |k: usize| {
            let up = (y * TOP + pixel * ((k as f64 + 0.5) / 2.0 - 0.5)).max(1e-4);
            let flat = 1.0 / (1.0 + up * up).sqrt();
            let (sin, cos) = azimuth.sin_cos();
            let d = DVec3::new(flat * cos, flat * sin, flat * up);
            skyline(azimuth, up, TAU / across as f64, sky(d, azimuth, 0.01)) + shore(azimuth, up, 0.5 * pixel)
        };
        (0..2).map(mean).sum::<DVec3>() / 2.0
    })
});

/// Coarser copies of [`CITY`] with wider and wider gathering upward: the spread grows by a factor of 2.3 to 3 from one to the next.
static GATHERED: LazyLock<Vec<DirectionTable>> = LazyLock::new(|| {
    let spreads = [0.004, 0.012, 0.030, 0.070];
    let gathered = |spread: f64| {
        DirectionTable::new([2048, 96], move |x, y| {
            let (mut sum, mut all) = (DVec3::ZERO, 0.0);
            for k in -5..=5 {
                let off = f64::from(k) / 2.2;
                let weight = (-0.5 * off * off).exp();
                let up = (y * TOP + off * spread).abs();
                sum += CITY.at(x, up / TOP) * weight;
                all += weight;
            }
            sum / all
        })
    };
    spreads.into_iter().map(gathered).collect()
});

/// Returns the city gathered over elevations around `up` with a spread.
fn reflected(azimuth: f64, up: f64, spread: f64) -> DVec3 {
    let level = ((spread.max(0.004) / 0.004).ln() / 2.6_f64.ln()).min(2.999);
    let (k, f) = (level as usize, level.fract());
    let at = |k: usize| GATHERED[k].at(azimuth / TAU, up / TOP);
    at(k).lerp(at(k + 1), f)
}

/// Returns the water with the city in it.
fn water(d: DVec3, footprint: f64) -> DVec3 {
    let WaterPoint { hidden, facing, mirrored: mut out, .. } = WATER.met(d, footprint);
    out.z = out.z.abs();
    let spread = hidden.sqrt();
    let flat = out.truncate().length().max(1e-9);
    let facing = (facing * facing + 0.5 * hidden).sqrt().min(1.0);
    let fresnel = 0.02 + 0.98 * (1.0 - facing).powi(5);
    let up = out.z / flat;
    let azimuth = out.y.atan2(out.x);
    let seen = if up < TOP - 0.02 { reflected(azimuth, up, 1.3 * spread) } else { glow(azimuth, out.z) };
    fresnel * seen + (1.0 - fresnel) * DVec3::new(0.0012, 0.0030, 0.0058)
}
