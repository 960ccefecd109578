//! A living room at dusk: blue light in a window, lamps and the pools of their light on green walls, boards that mirror
//! them, a picture, a sideboard, shelves. z is up; the eye is 1.35 m above the floor and looks at the window wall, which
//! is the middle of the picture, along +x. Lengths are in metres.

mod furniture;
mod surfaces;
mod walls;

use super::noise::ramp;
use furniture::{SHADES, Thing, first_box, furniture};
use glam::{DVec2, DVec3};
use surfaces::RoomSurface;
use walls::shell;

/// The room's corners, seen from the eye.
const LOW: DVec3 = DVec3::new(-2.6, -2.3, -1.35);
const HIGH: DVec3 = DVec3::new(5.0, 2.3, 1.55);

const WARM: DVec3 = DVec3::new(1.0, 0.58, 0.25);

/// The distribution of a lamp's light.
#[derive(Clone, Copy)]
enum Spread {
    /// Through the openings of a shade, above and below, and a little through its cloth.
    Shade,
    /// Evenly in all directions, as a globe of frosted glass does.
    Globe,
    /// Downward alone, like a lamp in the ceiling.
    Down,
}

/// A light source: its place, its colour times its intensity, its distribution.
struct Light(DVec3, DVec3, Spread);

const fn warm(by: f64) -> DVec3 {
    DVec3::new(by, 0.58 * by, 0.25 * by)
}

const TABLE_LAMP: DVec3 = DVec3::new(4.70, -1.72, -0.08);
const FLOOR_LAMP: DVec3 = DVec3::new(4.45, 1.92, 0.28);
const SCONCE: DVec3 = DVec3::new(3.2, -2.20, 0.55);
const FAR_LAMP: DVec3 = DVec3::new(-2.2, 1.5, 0.10);

const LIGHTS: [Light; 9] = [
    Light(TABLE_LAMP, warm(1.15), Spread::Shade),
    Light(FLOOR_LAMP, warm(1.15), Spread::Shade),
    Light(SCONCE, warm(0.65), Spread::Shade),
    Light(FAR_LAMP, warm(1.5), Spread::Shade),
    Light(DVec3::new(1.7, 0.0, 0.95), warm(0.62), Spread::Globe),
    Light(DVec3::new(3.02, 0.05, -0.78), warm(0.09), Spread::Globe),
    Light(DVec3::new(4.55, -1.2, 1.54), warm(1.9), Spread::Down),
    Light(DVec3::new(1.6, -1.9, 1.54), warm(1.5), Spread::Down),
    Light(DVec3::new(-1.4, -1.2, 1.54), warm(1.5), Spread::Down),
];

/// The globes that hang from the ceiling, and their radius.
const GLOBES: [DVec3; 3] =
    [DVec3::new(1.7, -0.38, 0.98), DVec3::new(1.9, 0.02, 0.80), DVec3::new(1.6, 0.40, 0.92)];
const GLOBE_RADIUS: f64 = 0.085;
/// The small lamps in the ceiling.
const SPOTS: [DVec2; 6] = [
    DVec2::new(4.55, -1.2),
    DVec2::new(1.6, -1.9),
    DVec2::new(-1.4, -1.2),
    DVec2::new(-1.4, 1.2),
    DVec2::new(0.4, 1.7),
    DVec2::new(0.2, -1.0),
];
/// The flames of the candles on the low table.
const FLAMES: [DVec3; 3] =
    [DVec3::new(3.02, 0.17, -0.775), DVec3::new(3.10, 0.05, -0.725), DVec3::new(2.97, -0.08, -0.800)];

/// The square of the angle in radians at which the halo of a flame ends.
const FARTHEST_HALO: f64 = 0.04;

/// The middle of the window, and the radiance with which it lights the room.
const WINDOW: DVec3 = DVec3::new(5.0, 0.9, 0.30);
const DUSK: DVec3 = DVec3::new(0.15, 0.24, 0.50);

/// Returns the radiance from a unit direction, averaged over a footprint in radians.
pub(super) fn radiance(d: DVec3, footprint: f64) -> DVec3 {
    let (surface, p, t) = hit(DVec3::ZERO, d, footprint);
    let light = lit(&surface, p, d) + flames(DVec3::ZERO, d, t, footprint);
    if surface.gloss <= 0.0 {
        return light;
    }
    let cos = -d.dot(surface.normal);
    let mirror = surface.gloss * (0.05 + 0.95 * (1.0 - cos.clamp(0.0, 1.0)).powi(5));
    let tilt = surface.tilt;
    let out = d + 2.0 * cos * surface.normal + DVec3::new(tilt.x, tilt.y, 0.0);
    let out = out / out.length();
    let from = p + surface.normal * 1e-4;
    let blur = footprint.max(surface.blur);
    let (other, q, reach) = hit(from, out, blur);
    light + mirror * (lit(&other, q, out) + flames(from, out, reach, blur))
}

/// Returns the surface that a ray meets first, the point, and its distance.
fn hit(from: DVec3, d: DVec3, footprint: f64) -> (RoomSurface, DVec3, f64) {
    let walls = (LOW - from) / d;
    let far = ((HIGH - from) / d).max(walls);
    let t = far.min_element();
    let mut nearest = None;
    let mut reach = t;
    for (place, shade) in SHADES.iter().enumerate() {
        if let Some(t) = shade.meets(from, d).filter(|&t| t < reach) {
            (nearest, reach) = (Some(Thing::Shade(place)), t);
        }
    }
    for (place, globe) in GLOBES.iter().enumerate() {
        let (to, b) = (*globe - from, (*globe - from).dot(d));
        let under_root = b * b - to.length_squared() + GLOBE_RADIUS * GLOBE_RADIUS;
        if b > 0.0 && under_root > 0.0 && b - under_root.sqrt() < reach {
            (nearest, reach) = (Some(Thing::Globe(place)), b - under_root.sqrt());
        }
    }
    if let Some((place, t)) = first_box(from, d, reach) {
        (nearest, reach) = (Some(Thing::Box(place)), t);
    }
    let p = from + d * reach;
    let surface = match nearest {
        None => shell(p, d, footprint * reach),
        Some(thing) => furniture(thing, p, d, footprint * reach),
    };
    (surface, p, reach)
}

/// Returns the light that a surface sends back, of the lamps and the window, and its own.
fn lit(surface: &RoomSurface, p: DVec3, d: DVec3) -> DVec3 {
    if surface.albedo == DVec3::ZERO {
        return surface.own;
    }
    let n = if surface.normal.dot(d) > 0.0 { -surface.normal } else { surface.normal };
    let mut sum = DVec3::ZERO;
    for Light(place, light, spread) in &LIGHTS {
        let to = *place - p;
        let square = to.length_squared() + 0.004;
        let toward = to / square.sqrt();
        let cos = (n.dot(toward) * 0.92 + 0.08).max(0.0);
        let share = match spread {
            Spread::Globe => 1.0,
            Spread::Down => ramp(0.55, 0.98, toward.z),
            Spread::Shade => {
                let open =
                    if toward.z > 0.0 { ramp(0.50, 0.68, toward.z) } else { ramp(0.62, 0.80, -toward.z) };
                0.20 + 0.95 * open
            }
        };
        sum += *light * (cos * share / square);
    }
    sum += DUSK * window_share(n, p);
    let bounced = DVec3::new(0.125, 0.088, 0.062) * (0.8 + 0.2 * n.z);
    surface.own + surface.albedo * (sum * surface.shelter.sqrt() + bounced * corners(p, n) * surface.shelter)
}

/// Returns the part of a surface's view that the window takes.
fn window_share(n: DVec3, p: DVec3) -> f64 {
    let quarter = |y: f64| {
        let to = WINDOW + DVec3::new(0.0, y, 0.0) - p;
        let square = to.length_squared() + 0.15;
        let cos = n.dot(to).max(0.0) / square.sqrt();
        1.2 * cos * to.x.max(0.0) / square.sqrt() / (square * std::f64::consts::PI)
    };
    3.0 * (quarter(-0.4) + quarter(0.4))
}

/// Returns the part of the room's light that reaches a point: less in corners.
fn corners(p: DVec3, n: DVec3) -> f64 {
    let near = |gap: f64| 1.0 - 0.55 * (-gap.abs() / 0.30).exp();
    let (low, high) = (p - LOW, HIGH - p);
    let along = DVec3::ONE - n.abs();
    let side = |gap: f64, share: f64| 1.0 + (near(gap) - 1.0) * share;
    side(low.x, along.x)
        * side(high.x, along.x)
        * side(low.y, along.y)
        * side(high.y, along.y)
        * side(low.z, along.z)
        * side(high.z, along.z)
}

/// Returns the flames of the candles and the small lamps in the ceiling, where they are nearer than `reach`.
fn flames(from: DVec3, d: DVec3, reach: f64, footprint: f64) -> DVec3 {
    let mut light = DVec3::ZERO;
    for flame in FLAMES {
        let to = flame - from;
        let along = to.dot(d);
        if along < 0.0 || along > reach + 0.05 {
            continue;
        }
        let off = (from + d * along - flame) / along;
        let square = off.length_squared();
        if square > FARTHEST_HALO {
            continue;
        }
        let (wide, high) = (0.006 / along + 0.4 * footprint, 0.017 / along + 0.4 * footprint);
        let shape = (off.truncate().length_squared() / (wide * wide) + (off.z / high).powi(2)).min(30.0);
        let share = (0.006 * 0.017 / (along * along)) / (wide * high);
        light += DVec3::new(110.0, 52.0, 13.0) * share * (-shape).exp();
        let fading = 1.0 - square / FARTHEST_HALO;
        light += DVec3::new(0.30, 0.13, 0.035) * (fading / (1.0 + square / 1.44e-4)).powi(2);
    }
    light
}
