//! The furniture of the room: lamps, boxes of wood and cloth, shelves.

use super::super::noise::{band, fractal, noise, ramp, random};
use super::surfaces::RoomSurface;
use super::{FAR_LAMP, FLOOR_LAMP, GLOBE_RADIUS, GLOBES, LOW, SCONCE, TABLE_LAMP, WARM};
use glam::{DVec2, DVec3};
use std::sync::LazyLock;

/// A thing in the room, by its place in its list.
#[derive(Clone, Copy)]
pub(super) enum Thing {
    Shade(usize),
    Globe(usize),
    Box(usize),
}

/// A lampshade: a cone around an upright axis, by its middle, half its height, and the radii at its lower and upper end.
pub(super) struct Shade {
    middle: DVec3,
    half: f64,
    radii: [f64; 2],
}

pub(super) const SHADES: [Shade; 4] = [
    Shade { middle: TABLE_LAMP, half: 0.13, radii: [0.19, 0.12] },
    Shade { middle: FLOOR_LAMP, half: 0.15, radii: [0.24, 0.16] },
    Shade { middle: FAR_LAMP, half: 0.18, radii: [0.26, 0.18] },
    Shade { middle: SCONCE, half: 0.10, radii: [0.07, 0.07] },
];

impl Shade {
    /// Returns the distance along a ray at which it meets the shade.
    pub(super) fn meets(&self, from: DVec3, d: DVec3) -> Option<f64> {
        let o = from - self.middle;
        let along = -o.truncate().dot(d.truncate()) / d.truncate().length_squared().max(1e-12);
        if (o + d * along).truncate().length_squared() > 0.07 {
            return None;
        }
        let slope = (self.radii[1] - self.radii[0]) / (2.0 * self.half);
        let radius = 0.5 * (self.radii[0] + self.radii[1]) + slope * o.z;
        let a = d.truncate().length_squared() - slope * slope * d.z * d.z;
        let b = o.truncate().dot(d.truncate()) - radius * slope * d.z;
        let c = o.truncate().length_squared() - radius * radius;
        let root = (b * b - a * c).max(-1.0).sqrt();
        let ends = [(-b - root) / a, (-b + root) / a];
        ends.into_iter().find(|&t| t > 1e-4 && (o.z + d.z * t).abs() < self.half)
    }
}

/// The material of a box.
#[derive(Clone, Copy, PartialEq)]
enum Stuff {
    Walnut,
    Brass,
    Cloth,
    Linen,
    Wax,
    Ceramic,
    Book(u8),
    Shelf,
}

/// A box: its corners, with z from the floor, and its material.
struct Block(DVec3, DVec3, Stuff);

const fn block(x: [f64; 2], y: [f64; 2], z: [f64; 2], stuff: Stuff) -> Block {
    Block(DVec3::new(x[0], y[0], z[0] - 1.35), DVec3::new(x[1], y[1], z[1] - 1.35), stuff)
}

static BLOCKS: [Block; 24] = [
    // The sideboard, and the things on it.
    block([4.52, 4.98], [-2.05, -0.35], [0.16, 0.74], Stuff::Walnut),
    block([4.58, 4.62], [-1.98, -1.94], [0.0, 0.16], Stuff::Brass),
    block([4.58, 4.62], [-0.46, -0.42], [0.0, 0.16], Stuff::Brass),
    block([4.64, 4.76], [-1.78, -1.66], [0.74, 1.02], Stuff::Ceramic),
    block([4.69, 4.71], [-1.73, -1.71], [1.02, 1.30], Stuff::Brass),
    block([4.62, 4.82], [-0.95, -0.68], [0.74, 0.78], Stuff::Book(0)),
    block([4.63, 4.81], [-0.93, -0.69], [0.78, 0.815], Stuff::Book(1)),
    block([4.64, 4.80], [-0.91, -0.72], [0.815, 0.84], Stuff::Book(2)),
    // The low table, its candles and books.
    block([2.62, 3.42], [-0.62, 0.62], [0.36, 0.40], Stuff::Walnut),
    block([2.72, 2.76], [-0.56, -0.52], [0.0, 0.36], Stuff::Brass),
    block([3.28, 3.32], [-0.56, -0.52], [0.0, 0.36], Stuff::Brass),
    block([2.72, 2.76], [0.52, 0.56], [0.0, 0.36], Stuff::Brass),
    block([3.28, 3.32], [0.52, 0.56], [0.0, 0.36], Stuff::Brass),
    block([2.99, 3.05], [0.14, 0.20], [0.40, 0.54], Stuff::Wax),
    block([3.07, 3.13], [0.02, 0.08], [0.40, 0.59], Stuff::Wax),
    block([2.94, 3.00], [-0.11, -0.05], [0.40, 0.515], Stuff::Wax),
    block([2.85, 3.10], [-0.48, -0.20], [0.40, 0.435], Stuff::Book(3)),
    // The armchair below the window.
    block([3.75, 4.45], [0.62, 1.38], [0.14, 0.44], Stuff::Cloth),
    block([4.28, 4.50], [0.62, 1.38], [0.44, 0.88], Stuff::Cloth),
    block([3.78, 4.48], [0.48, 0.62], [0.14, 0.62], Stuff::Cloth),
    block([3.78, 4.48], [1.38, 1.52], [0.14, 0.62], Stuff::Cloth),
    // The shelves along the left wall.
    block([3.82, 4.26], [0.63, 1.37], [0.44, 0.53], Stuff::Cloth),
    block([4.14, 4.30], [0.72, 1.10], [0.53, 0.86], Stuff::Linen),
    block([0.6, 3.5], [2.02, 2.3], [0.0, 2.35], Stuff::Shelf),
];

/// Groups of boxes that stand together: the first and the number of them, and corners around all.
static GROUPS: LazyLock<Vec<(usize, usize, DVec3, DVec3)>> = LazyLock::new(|| {
    let around = |(first, count): (usize, usize)| {
        let all = &BLOCKS[first..first + count];
        let low = all.iter().fold(DVec3::INFINITY, |low, block| low.min(block.0));
        (first, count, low, all.iter().fold(DVec3::NEG_INFINITY, |high, block| high.max(block.1)))
    };
    [(0, 8), (8, 9), (17, 6), (23, 1)].into_iter().map(around).collect()
});

/// Returns the nearest box before `reach` that a ray meets, and its distance.
pub(super) fn first_box(from: DVec3, d: DVec3, reach: f64) -> Option<(usize, f64)> {
    let inverse = d.recip();
    let met = |low: DVec3, high: DVec3| {
        let (a, b) = ((low - from) * inverse, (high - from) * inverse);
        (a.min(b).max_element(), a.max(b).min_element())
    };
    let mut first = None;
    let mut reach = reach;
    for &(start, count, low, high) in GROUPS.iter() {
        let (enter, leave) = met(low, high);
        if enter >= leave || leave < 0.0 || enter >= reach {
            continue;
        }
        for (place, Block(low, high, _)) in BLOCKS.iter().enumerate().skip(start).take(count) {
            let (enter, leave) = met(*low, *high);
            if enter < leave && enter > 1e-4 && enter < reach {
                (first, reach) = (Some((place, enter)), enter);
            }
        }
    }
    first
}

/// Returns the surface of a thing at a point.
pub(super) fn furniture(thing: Thing, p: DVec3, d: DVec3, width: f64) -> RoomSurface {
    match thing {
        Thing::Globe(place) => {
            let n = (p - GLOBES[place]) / GLOBE_RADIUS;
            let limb = (-n.dot(d)).max(0.0);
            RoomSurface::shining(DVec3::new(16.0, 10.2, 5.2) * (0.35 + 0.65 * limb))
        }
        Thing::Shade(place) => {
            let shade = &SHADES[place];
            let out = (p - shade.middle).truncate();
            let n = out / out.length().max(1e-9);
            let facing = (-n.dot(d.truncate())).abs();
            let height = (p.z - shade.middle.z) / shade.half;
            let rim = ramp(0.90, 0.97, height.abs());
            let bulb = (-(height + 0.1).powi(2) / 0.5).exp() * (0.30 + 0.70 * facing * facing);
            let weave = 1.0 + 0.05 * noise(DVec2::new(out.to_angle() * 30.0, p.z * 300.0), 5).0;
            let cloth = DVec3::new(6.4, 3.5, 1.35) * bulb * weave + DVec3::new(0.60, 0.28, 0.09);
            RoomSurface::shining(cloth.lerp(DVec3::new(0.20, 0.10, 0.04), rim * 0.8))
        }
        Thing::Box(place) => block_surface(&BLOCKS[place], p, width),
    }
}

fn block_surface(Block(low, high, stuff): &Block, p: DVec3, width: f64) -> RoomSurface {
    let (middle, half) = (0.5 * (*low + *high), 0.5 * (*high - *low));
    let q = p - middle;
    let gap = half - q.abs();
    let face = gap.min_element();
    let sharp = DVec3::select(gap.cmple(DVec3::splat(face + 1e-9)), q.signum(), DVec3::ZERO);
    // Edges are rounded in their shading, not in their outline.
    let round = if matches!(stuff, Stuff::Cloth | Stuff::Linen) { 0.07 } else { 0.006 };
    let bent = q.signum() * (DVec3::ONE - (gap / round).min(DVec3::ONE)).powf(1.6) * 0.7 + sharp;
    let normal = bent / bent.length();
    let floor = p.z - LOW.z;
    let shelter = 1.0 - 0.7 * (-floor / 0.16).exp();
    let mut surface = RoomSurface::new(normal, DVec3::ONE);
    surface.shelter = shelter;
    match stuff {
        Stuff::Walnut => {
            let along = if sharp.z.abs() > 0.5 {
                DVec2::new(p.x * 26.0, p.y * 2.2)
            } else {
                DVec2::new(p.z * 26.0, p.y * 2.2)
            };
            let grain = fractal(along, 4, width * 26.0, 91);
            surface.albedo = DVec3::new(0.135, 0.068, 0.034) * (1.0 + 0.55 * grain);
            let seam = (p.y / 0.567 - 0.38).rem_euclid(1.0) * 0.567;
            if sharp.x.abs() > 0.5 && half.z > 0.2 {
                surface.albedo *= 1.0 - 0.75 * band(0.0, 0.008, seam, width);
            }
            (surface.gloss, surface.blur) = (0.9, 0.05);
        }
        Stuff::Brass => {
            surface.albedo = DVec3::new(0.42, 0.27, 0.10);
            (surface.gloss, surface.blur) = (1.0, 0.1);
        }
        Stuff::Cloth => {
            let weave = noise(DVec2::new(p.x + p.y, p.z) * 260.0, 93).0 * (1.0 - ramp(0.001, 0.004, width));
            surface.albedo = DVec3::new(0.33, 0.125, 0.055) * (1.0 + 0.3 * weave);
        }
        Stuff::Linen => {
            let stripe = band(0.25, 0.40, (p.y * 16.0).rem_euclid(1.0), width * 16.0);
            surface.albedo = DVec3::new(0.52, 0.44, 0.33).lerp(DVec3::new(0.08, 0.14, 0.20), stripe);
        }
        Stuff::Wax => {
            surface.albedo = DVec3::new(0.75, 0.66, 0.52);
            let below = high.z - p.z;
            surface.own = DVec3::new(1.5, 0.66, 0.20) * (-below / 0.035).exp();
        }
        Stuff::Ceramic => {
            surface.albedo = DVec3::new(0.10, 0.17, 0.20);
            (surface.gloss, surface.blur) = (1.0, 0.02);
        }
        Stuff::Book(k) => {
            surface.albedo = cover(u32::from(*k));
        }
        Stuff::Shelf => shelf(&mut surface, p, sharp, width),
    }
    surface
}

/// Returns the colour of a book's cover.
fn cover(k: u32) -> DVec3 {
    const COVERS: [DVec3; 8] = [
        DVec3::new(0.24, 0.045, 0.035),
        DVec3::new(0.60, 0.50, 0.36),
        DVec3::new(0.035, 0.075, 0.16),
        DVec3::new(0.42, 0.22, 0.055),
        DVec3::new(0.05, 0.12, 0.085),
        DVec3::new(0.50, 0.46, 0.42),
        DVec3::new(0.13, 0.055, 0.09),
        DVec3::new(0.045, 0.040, 0.042),
    ];
    COVERS[(k % 8) as usize]
}

/// Draws the front of the shelves: boards, and rows of books in the light of a strip under each board.
fn shelf(surface: &mut RoomSurface, p: DVec3, sharp: DVec3, width: f64) {
    let wood = DVec3::new(0.12, 0.066, 0.036);
    surface.albedo = wood;
    if sharp.y > -0.5 {
        return;
    }
    let height = p.z - LOW.z - 0.04;
    let (row, z) = ((height / 0.385).floor(), height.rem_euclid(0.385));
    let bay = (p.x - 0.6) / 0.725;
    let upright = bay.rem_euclid(1.0) * 0.725;
    let board = band(0.0, 0.028, z, width)
        .max(band(0.0, 0.024, upright, width))
        .max(f64::from(u8::from(height > 2.28)));
    let pitch = 0.036;
    let cell = (p.x / pitch).floor() as i64;
    let book = random(cell, row as i64, 71);
    let group = random((p.x / 0.29).floor() as i64, row as i64, 73);
    let is_empty = group < 0.16;
    let top = if is_empty { 0.0 } else { 0.19 + 0.12 * random(cell, row as i64, 72) + 0.02 * group };
    let spine = cover((book * 4096.0) as u32);
    let within = (p.x / pitch).rem_euclid(1.0);
    let curved = 1.0 - 0.45 * (2.0 * within - 1.0).powi(4);
    let title = band(0.6, 0.68, z / top.max(0.05), width * 4.0) * f64::from(u8::from(book > 0.45));
    let spine = spine.lerp(DVec3::new(0.62, 0.48, 0.22), title * 0.7) * curved;
    let back = DVec3::new(0.055, 0.034, 0.022);
    let is_book = band(0.028, 0.028 + top, z, width);
    let seen = back.lerp(spine, is_book);
    surface.albedo = seen.lerp(wood, board);
    let from_strip = 0.385 - z;
    let strip = WARM * 1.15 * (-from_strip / 0.12).exp() * (0.35 + 0.65 * is_book);
    surface.own = seen * strip * (1.0 - board) * f64::from(u8::from(height < 2.28));
    surface.shelter *= 1.0 - 0.5 * (1.0 - board) * (1.0 - is_book);
}
