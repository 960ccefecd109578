//! What stands in the room, and what each surface is made of.

use super::{
    DVec2, DVec3, FAR_LAMP, FLOOR_LAMP, GLOBE_RADIUS, GLOBES, HIGH, LOW, SPOTS, TABLE_LAMP, WARM, band,
    fractal, noise, ramp, random,
};
use std::sync::LazyLock;

/// What a ray has met: how it looks there.
pub(super) struct Surface {
    pub(super) normal: DVec3,
    /// The share of light that is sent back; zero where only its own light counts.
    pub(super) albedo: DVec3,
    /// Light of its own.
    pub(super) own: DVec3,
    /// How much of the room's light reaches it, 0 to 1.
    pub(super) shelter: f64,
    /// The strength of its mirror image, 0 to 1, its blur in radians, and how the mirror leans.
    pub(super) gloss: f64,
    pub(super) blur: f64,
    pub(super) tilt: DVec2,
}

impl Surface {
    fn new(normal: DVec3, albedo: DVec3) -> Self {
        Self { normal, albedo, own: DVec3::ZERO, shelter: 1.0, gloss: 0.0, blur: 0.0, tilt: DVec2::ZERO }
    }

    fn shining(light: DVec3) -> Self {
        Self { own: light, ..Self::new(DVec3::Z, DVec3::ZERO) }
    }
}

/// A thing in the room, by its place in its list.
#[derive(Clone, Copy)]
pub(super) enum Thing {
    Shade(usize),
    Globe(usize),
    Box(usize),
}

/// A lampshade: a cone around an upright axis, `low` to `high`, and the radii there.
pub(super) struct Shade {
    middle: DVec3,
    half: f64,
    radii: [f64; 2],
}

pub(super) const SHADES: [Shade; 4] = [
    Shade { middle: TABLE_LAMP, half: 0.13, radii: [0.19, 0.12] },
    Shade { middle: FLOOR_LAMP, half: 0.15, radii: [0.24, 0.16] },
    Shade { middle: FAR_LAMP, half: 0.18, radii: [0.26, 0.18] },
    Shade { middle: super::SCONCE, half: 0.10, radii: [0.07, 0.07] },
];

impl Shade {
    /// Returns how far along a ray the shade is met.
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

/// What a box is made of.
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

/// A box: its corners, with z from the floor, and its stuff.
struct Block(DVec3, DVec3, Stuff);

const fn block(x: [f64; 2], y: [f64; 2], z: [f64; 2], stuff: Stuff) -> Block {
    Block(DVec3::new(x[0], y[0], z[0] - 1.35), DVec3::new(x[1], y[1], z[1] - 1.35), stuff)
}

static BLOCKS: [Block; 24] = [
    // The sideboard, what stands on it.
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

/// Returns the nearest box before `reach` that a ray meets, and how far away.
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

/// Returns the look of a thing at a point.
pub(super) fn furniture(thing: Thing, p: DVec3, d: DVec3, width: f64) -> Surface {
    match thing {
        Thing::Globe(place) => {
            let n = (p - GLOBES[place]) / GLOBE_RADIUS;
            let limb = (-n.dot(d)).max(0.0);
            Surface::shining(DVec3::new(16.0, 10.2, 5.2) * (0.35 + 0.65 * limb))
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
            Surface::shining(cloth.lerp(DVec3::new(0.20, 0.10, 0.04), rim * 0.8))
        }
        Thing::Box(place) => block_surface(&BLOCKS[place], p, width),
    }
}

fn block_surface(Block(low, high, stuff): &Block, p: DVec3, width: f64) -> Surface {
    let (middle, half) = (0.5 * (*low + *high), 0.5 * (*high - *low));
    let q = p - middle;
    let gap = half - q.abs();
    let face = gap.min_element();
    let sharp = DVec3::select(gap.cmple(DVec3::splat(face + 1e-9)), q.signum(), DVec3::ZERO);
    // Edges are rounded for the light, not in outline.
    let round = if matches!(stuff, Stuff::Cloth | Stuff::Linen) { 0.07 } else { 0.006 };
    let bent = q.signum() * (DVec3::ONE - (gap / round).min(DVec3::ONE)).powf(1.6) * 0.7 + sharp;
    let normal = bent / bent.length();
    let floor = p.z - LOW.z;
    let shelter = 1.0 - 0.7 * (-floor / 0.16).exp();
    let mut surface = Surface::new(normal, DVec3::ONE);
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

/// The front of the shelves: boards, and rows of books that a strip of light under each board shows.
fn shelf(surface: &mut Surface, p: DVec3, sharp: DVec3, width: f64) {
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

/// Returns the look of the room's walls, floor and ceiling.
pub(super) fn shell(p: DVec3, d: DVec3, width: f64) -> Surface {
    let gaps = [HIGH.z - p.z, p.z - LOW.z, HIGH.x - p.x, p.x - LOW.x, HIGH.y - p.y, p.y - LOW.y];
    let least = gaps.iter().copied().fold(f64::MAX, f64::min);
    let face = gaps.iter().position(|&gap| gap <= least).unwrap_or(0);
    match face {
        0 => ceiling(p, d, width),
        1 => floor(p, d, width),
        2 => front(p, d, width),
        3 => wall(p, DVec2::new(p.y, p.z - LOW.z), DVec3::X, width),
        4 => wall(p, DVec2::new(p.x, p.z - LOW.z), -DVec3::Y, width),
        _ => side(p, d, width),
    }
}

fn ceiling(p: DVec3, d: DVec3, width: f64) -> Surface {
    let mut surface = Surface::new(-DVec3::Z, DVec3::new(0.62, 0.58, 0.52));
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

fn floor(p: DVec3, d: DVec3, width: f64) -> Surface {
    let mut surface = Surface::new(DVec3::Z, DVec3::ONE);
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
fn rug(surface: &mut Surface, p: DVec3, width: f64) {
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

/// Returns how much light reaches the floor beside and below furniture.
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
fn wall(p: DVec3, at: DVec2, normal: DVec3, width: f64) -> Surface {
    let rough = 1.0 + 0.05 * fractal(DVec2::new(at.x, at.y) * 3.0, 4, width * 3.0, 61);
    let paint = DVec3::new(0.105, 0.150, 0.125) * rough;
    let mut surface = Surface::new(normal, paint);
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
    let _ = p;
    surface
}

/// The wall to the right, with two pictures.
fn side(p: DVec3, _: DVec3, width: f64) -> Surface {
    let at = DVec2::new(p.x, p.z - LOW.z);
    let mut surface = wall(p, at, DVec3::Y, width);
    for (place, seed) in [(DVec2::new(4.15, 1.62), 3), (DVec2::new(2.1, 1.70), 4)] {
        painting(&mut surface, at - place, DVec2::new(0.30, 0.38), width, seed);
    }
    surface
}

/// Hangs a framed picture on a wall: a landscape in bands of colour.
fn painting(surface: &mut Surface, q: DVec2, half: DVec2, width: f64, seed: u32) {
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

/// The wall with the window, its curtains and a picture.
fn front(p: DVec3, d: DVec3, width: f64) -> Surface {
    let at = DVec2::new(p.y, p.z - LOW.z);
    let mut surface = wall(p, at, -DVec3::X, width);
    painting(&mut surface, at - DVec2::new(-1.2, 1.70), DVec2::new(0.50, 0.36), width, 2);
    window(&mut surface, at, d, width);
    curtains(&mut surface, at, width);
    surface
}

fn window(surface: &mut Surface, at: DVec2, d: DVec3, width: f64) {
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

fn curtains(surface: &mut Surface, at: DVec2, width: f64) {
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
