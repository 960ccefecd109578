//! The room itself: walls with pictures and the window, floor and ceiling.

use super::super::noise::{band, fractal, noise, ramp, random};
use super::surfaces::RoomSurface;
use super::{HIGH, LOW, SPOTS, WARM};
use glam::{DVec2, DVec3};

/// Returns the surface of the room's walls, floor and ceiling.
pub(super) fn shell(p: DVec3, d: DVec3, width: f64) -> RoomSurface {
    let gaps = [HIGH.z - p.z, p.z - LOW.z, HIGH.x - p.x, p.x - LOW.x, HIGH.y - p.y, p.y - LOW.y];
    let least = gaps.iter().copied().fold(f64::MAX, f64::min);
    let face = gaps.iter().position(|&gap| gap <= least).unwrap_or(0);
    match face {
        0 => ceiling(p, d, width),
        1 => floor(p, d, width),
        2 => front(p, d, width),
        3 => wall(DVec2::new(p.y, p.z - LOW.z), DVec3::X, width),
        4 => wall(DVec2::new(p.x, p.z - LOW.z), -DVec3::Y, width),
        _ => side(p, width),
    }
}

fn ceiling(p: DVec3, d: DVec3, width: f64) -> RoomSurface {
    let mut surface = RoomSurface::new(-DVec3::Z, DVec3::new(0.62, 0.58, 0.52));
    let width = width / d.z.abs().max(0.05);
    for spot in SPOTS {
        let off = (p.truncate() - spot).length();
        let lamp = 1.0 - ramp(0.032 - 0.5 * width, 0.032 + 0.5 * width, off);
        let ring = 1.0 - ramp(0.048 - 0.5 * width, 0.048 + 0.5 * width, off);
        surface.albedo = surface.albedo.lerp(DVec3::new(0.25, 0.2, 0.12), ring);
        surface.own += DVec3::new(150.0, 104.0, 58.0) * lamp + WARM * 0.25 / (1.0 + (off / 0.05).powi(3));
    }
    surface
}

fn floor(p: DVec3, d: DVec3, width: f64) -> RoomSurface {
    let mut surface = RoomSurface::new(DVec3::Z, DVec3::ONE);
    let wide = width / d.z.abs().max(0.05).sqrt();
    const BOARD: f64 = 0.14;
    let row = (p.y / BOARD).floor();
    let length = 1.5;
    let shift = random(row as i64, 0, 51) * length;
    let plank = ((p.x + shift) / length).floor();
    let tone = random(row as i64, plank as i64, 52);
    let at = DVec2::new(p.x * 1.6 + 31.0 * tone, p.y * 24.0 + 7.0 * tone);
    let grain = fractal(at, 4, wide * 16.0, 53);
    let (across, along) = ((p.y / BOARD).rem_euclid(1.0) * BOARD, (p.x + shift).rem_euclid(length));
    let gap = band(0.0, 0.004, across, width).max(band(0.0, 0.004, along, wide));
    let oak = DVec3::new(0.25, 0.135, 0.062) * (0.78 + 0.42 * tone) * (1.0 + 0.32 * grain);
    surface.albedo = oak * (1.0 - 0.72 * gap);
    (surface.gloss, surface.blur) = (0.85 * (1.0 - 0.6 * gap), 0.03);
    surface.tilt = DVec2::new(0.010 * grain, 0.012 * (tone - 0.5) + 0.012 * grain);
    surface.shelter = contact(p);
    rug(&mut surface, p, wide);
    surface
}

/// Lays the rug below the low table.
fn rug(surface: &mut RoomSurface, p: DVec3, width: f64) {
    let (x, y) = (p.x - 3.0, p.y);
    let inside = band(-1.05, 1.05, x, width) * band(-1.45, 1.45, y, width);
    if inside <= 0.0 {
        return;
    }
    let edge = (1.05 - x.abs()).min(1.45 - y.abs());
    let fuzz = 1.0 + 0.35 * fractal(p.truncate() * 60.0, 3, width * 60.0, 57);
    let ground =
        DVec3::new(0.26, 0.055, 0.040).lerp(DVec3::new(0.05, 0.060, 0.10), band(0.16, 0.30, edge, width));
    let line = band(0.13, 0.15, edge, width) + band(0.31, 0.33, edge, width) + band(0.04, 0.06, edge, width);
    let lozenge = (x.abs() / 0.52 + y.abs() / 0.85 - 1.0) * 0.4;
    let lozenges = (lozenge.rem_euclid(0.11) - 0.055).abs();
    let inner = f64::from(u8::from(edge > 0.36)) * band(0.0, 0.014, lozenges, width);
    let cloth = ground.lerp(DVec3::new(0.50, 0.38, 0.22), (line + 0.8 * inner).min(1.0));
    surface.albedo = surface.albedo.lerp(cloth * fuzz, inside);
    surface.gloss *= 1.0 - inside;
}

/// Returns the part of the light that reaches the floor beside and below furniture.
fn contact(p: DVec3) -> f64 {
    let under = |x: [f64; 2], y: [f64; 2], reach: f64, depth: f64| {
        let off = DVec2::new((x[0] - p.x).max(p.x - x[1]), (y[0] - p.y).max(p.y - y[1])).max(DVec2::ZERO);
        1.0 - depth * (-off.length() / reach).exp()
    };
    under([4.5, 5.0], [-2.05, -0.35], 0.16, 0.85)
        * under([2.7, 3.34], [-0.54, 0.54], 0.22, 0.62)
        * under([3.75, 4.5], [0.5, 1.5], 0.14, 0.85)
        * under([0.6, 3.5], [2.02, 2.3], 0.12, 0.75)
}

/// Returns a painted wall with its panels, base and cornice; `at` is along the wall and up from the floor.
fn wall(at: DVec2, normal: DVec3, width: f64) -> RoomSurface {
    let rough = 1.0 + 0.05 * fractal(DVec2::new(at.x, at.y) * 3.0, 4, width * 3.0, 61);
    let paint = DVec3::new(0.105, 0.150, 0.125) * rough;
    let mut surface = RoomSurface::new(normal, paint);
    let relief = |gap: f64| 0.55 * band(-0.012, 0.0, gap, width) - 0.45 * band(0.0, 0.014, gap, width);
    let bay = (at.x + 0.35).rem_euclid(1.15) - 0.575;
    let upper = (0.49 - bay.abs()).min((0.72 - (at.y - 1.80).abs()).min(1.0));
    let lower = (0.49 - bay.abs()).min(0.30 - (at.y - 0.52).abs());
    let mut tone = 1.0 + relief(upper) + relief(lower);
    tone += 0.5 * band(0.93, 0.955, at.y, width) - 0.4 * band(0.915, 0.93, at.y, width);
    let base = band(0.0, 0.13, at.y, width);
    let cornice = band(2.78, 3.0, at.y, width);
    tone -= 0.35 * band(0.13, 0.14, at.y, width) + 0.4 * band(2.765, 2.78, at.y, width);
    surface.albedo = (paint * tone.max(0.2)).lerp(DVec3::new(0.115, 0.160, 0.135), base);
    surface.albedo = surface.albedo.lerp(DVec3::new(0.55, 0.51, 0.45), cornice);
    surface.albedo *= 1.0 - 0.3 * band(2.82, 2.83, at.y, width);
    surface
}

/// Returns the wall to the right, with two pictures.
fn side(p: DVec3, width: f64) -> RoomSurface {
    let at = DVec2::new(p.x, p.z - LOW.z);
    let mut surface = wall(at, DVec3::Y, width);
    for (place, seed) in [(DVec2::new(4.15, 1.62), 3), (DVec2::new(2.1, 1.70), 4)] {
        painting(&mut surface, at - place, DVec2::new(0.30, 0.38), width, seed);
    }
    surface
}

/// Hangs a framed picture on a wall: a landscape in bands of colour.
fn painting(surface: &mut RoomSurface, q: DVec2, half: DVec2, width: f64, seed: u32) {
    let edge = half - q.abs();
    let gap = edge.min_element();
    if gap < -0.09 {
        return;
    }
    // The shadow on the wall around it.
    surface.shelter *= 1.0 - 0.55 * (-(-gap).max(0.0) / 0.03).exp();
    let frame = DVec3::new(0.34, 0.22, 0.085) * (0.65 + 12.0 * (gap - 0.02).abs());
    surface.albedo = surface.albedo.lerp(frame, ramp(-0.5, 0.5, gap / width.max(1e-6)));
    let mat = DVec3::new(0.66, 0.62, 0.55);
    surface.albedo = surface.albedo.lerp(mat, ramp(-0.5, 0.5, (gap - 0.035) / width.max(1e-6)));
    let v = q.y / (half.y - 0.10);
    let u = q.x / (half.x - 0.10);
    let hill = |k: f64| {
        0.35 * k + 0.28 * fractal(DVec2::new(u * 1.3 + 9.0 * k, f64::from(seed)), 4, width * 6.0, seed)
    };
    let mut colour = DVec3::new(0.62, 0.36, 0.20).lerp(DVec3::new(0.16, 0.30, 0.44), ramp(-0.3, 1.0, v));
    let sun = (DVec2::new(u - 0.35, v - 0.25) * half).length();
    colour = colour.lerp(DVec3::new(0.85, 0.60, 0.28), 1.0 - ramp(0.045, 0.055, sun));
    for (level, tint) in [
        (0.0, DVec3::new(0.30, 0.20, 0.24)),
        (-1.0, DVec3::new(0.10, 0.13, 0.17)),
        (-2.0, DVec3::new(0.045, 0.065, 0.06)),
    ] {
        colour = colour.lerp(tint, ramp(-0.02, 0.02, hill(level) - v));
    }
    surface.albedo = surface.albedo.lerp(colour, ramp(-0.5, 0.5, (gap - 0.10) / width.max(1e-6)));
}

/// Returns the wall with the window, its curtains and a picture.
fn front(p: DVec3, d: DVec3, width: f64) -> RoomSurface {
    let at = DVec2::new(p.y, p.z - LOW.z);
    let mut surface = wall(at, -DVec3::X, width);
    painting(&mut surface, at - DVec2::new(-1.2, 1.70), DVec2::new(0.50, 0.36), width, 2);
    window(&mut surface, at, d, width);
    curtains(&mut surface, at, width);
    surface
}

fn window(surface: &mut RoomSurface, at: DVec2, d: DVec3, width: f64) {
    let q = at - DVec2::new(0.9, 1.66);
    let half = DVec2::new(0.76, 0.86);
    let edge = (half - q.abs()).min_element();
    if edge < -0.12 {
        return;
    }
    let trim = DVec3::new(0.42, 0.40, 0.36);
    surface.albedo = surface.albedo.lerp(trim, ramp(-0.5, 0.5, (edge + 0.09) / width.max(1e-6)));
    surface.albedo *= 1.0 - 0.35 * band(-0.092, -0.082, edge, width) - 0.5 * band(-0.012, 0.0, edge, width);
    let inside = ramp(-0.5, 0.5, edge / width.max(1e-6));
    // Frame and glazing bars: two wide by three high.
    let bars = [(q.x.abs(), 0.028), ((q.y - 0.30).abs(), 0.016), ((q.y + 0.28).abs(), 0.016), (edge, 0.05)];
    let bar = bars
        .into_iter()
        .map(|(off, half)| 1.0 - ramp(half - 0.5 * width, half + 0.5 * width, off))
        .fold(0.0, f64::max);
    let glass = inside * (1.0 - bar);
    surface.albedo = surface.albedo.lerp(DVec3::ZERO, glass);
    surface.own = surface.own.lerp(dusk(d), glass);
    if glass < 1.0 {
        surface.albedo = surface.albedo.max(DVec3::splat(1e-4));
        // The bars stand against the light: their sides catch the blue.
        surface.own += DVec3::new(0.020, 0.032, 0.060) * inside * bar;
    }
}

/// Returns the evening outside the window by direction.
fn dusk(d: DVec3) -> DVec3 {
    let up = d.z;
    let sky = DVec3::new(0.95, 0.46, 0.24)
        .lerp(DVec3::new(0.36, 0.33, 0.44), ramp(-0.03, 0.07, up))
        .lerp(DVec3::new(0.10, 0.20, 0.46), ramp(0.03, 0.17, up))
        .lerp(DVec3::new(0.035, 0.09, 0.30), ramp(0.12, 0.4, up));
    let azimuth = d.y / d.x.max(0.1);
    let cloud = fractal(DVec2::new(azimuth * 9.0, up * 60.0), 4, 0.05, 31);
    let sky =
        sky.lerp(DVec3::new(0.55, 0.27, 0.24), 0.4 * ramp(0.1, 0.5, cloud) * (1.0 - ramp(0.05, 0.16, up)));
    let far = -0.012 + 0.022 * fractal(DVec2::new(azimuth * 14.0, 0.5), 5, 0.02, 33);
    let near = -0.036 + 0.035 * fractal(DVec2::new(azimuth * 8.0, 7.5), 6, 0.02, 35);
    let mut light = sky.lerp(DVec3::new(0.085, 0.080, 0.13), ramp(-0.002, 0.002, far - up));
    light = light.lerp(DVec3::new(0.010, 0.013, 0.020), ramp(-0.002, 0.002, near - up));
    // Lights of houses, far away.
    let grid = DVec2::new(azimuth * 190.0, up * 300.0);
    let cell = grid.floor();
    let (x, y) = (cell.x as i64, cell.y as i64);
    let middle = DVec2::new(0.3 + 0.4 * random(x, y, 37), 0.3 + 0.4 * random(x, y, 38));
    let crowd = noise(DVec2::new(azimuth * 12.0, up * 40.0), 45).0;
    let is_lit = random(x, y, 39) > 0.97 - 0.5 * ramp(0.0, 0.4, crowd) && up < near.max(far) - 0.008;
    let spot = (-((grid - cell - middle) / DVec2::new(0.11, 0.16)).length_squared()).exp();
    light
        + DVec3::new(7.0, 3.6, 1.1).lerp(DVec3::new(4.0, 4.4, 5.0), random(x, y, 46).powi(3))
            * (0.25 + random(x, y, 47))
            * spot
            * f64::from(u8::from(is_lit))
}

fn curtains(surface: &mut RoomSurface, at: DVec2, width: f64) {
    let rod = band(2.655, 2.675, at.y, width) * band(-0.55, 2.25, at.x, width);
    surface.albedo = surface.albedo.lerp(DVec3::new(0.30, 0.19, 0.07), rod);
    surface.own *= 1.0 - rod;
    for (from, to, toward) in [(1.52, 2.12, 1.0), (-0.42, 0.24, -1.0)] {
        let drape = 0.03 * noise(DVec2::new(at.x * 3.0, at.y * 0.9), 41).0;
        let x = at.x + drape;
        let cover = band(from, to, x, width) * band(0.03, 2.655, at.y, width);
        if cover <= 0.0 {
            continue;
        }
        let phase = x * 62.0 + 1.3 * noise(DVec2::new(x * 4.0, at.y * 0.8), 43).0;
        let fold = phase.sin();
        let normal = DVec3::new(-1.0, 0.85 * phase.cos(), 0.0);
        surface.normal = surface.normal.lerp(normal / normal.length(), cover);
        let linen = DVec3::new(0.46, 0.37, 0.27) * (0.62 + 0.38 * fold);
        surface.albedo = surface.albedo.lerp(linen, cover);
        // Dusk shines through the edge that hangs before the glass.
        let before = if toward > 0.0 { 1.0 - ramp(1.55, 1.72, x) } else { ramp(0.06, 0.2, x) };
        let through =
            DVec3::new(0.030, 0.045, 0.085) * before * (0.6 + 0.4 * fold) * band(0.8, 2.52, at.y, 0.1);
        surface.own = surface.own.lerp(through, cover);
        surface.shelter *= 1.0 - 0.35 * cover * (0.5 - 0.5 * fold);
    }
}
