//! The weight of a ring: the volume of metal whose pieces overlap, and the densities of alloys.

use super::Mounting;
use brillianteer_math::bounds;
use brillianteer_optics::Metal;
use glam::{DVec2, DVec3};

/// An alloy of jewellery.
pub struct Alloy {
    /// Its name.
    pub name: &'static str,
    /// The metal that its surface shows; white gold is plated with rhodium.
    pub metal: Metal,
    /// Its density, in g/cm³.
    pub density: f64,
}

/// Alloys by name. The densities are those of a caster's table (Stuller, "Where to find gravity of materials", 2012); alloys
/// of other makers differ by a few percent.
pub const ALLOYS: [Alloy; 5] = [
    Alloy { name: "18 k yellow gold", metal: Metal::Gold, density: 15.58 },
    Alloy { name: "14 k yellow gold", metal: Metal::Gold, density: 13.07 },
    Alloy { name: "18 k white gold", metal: Metal::Rhodium, density: 14.64 },
    Alloy { name: "platinum-cobalt", metal: Metal::Platinum, density: 20.8 },
    Alloy { name: "sterling silver", metal: Metal::Silver, density: 10.4 },
];

impl Alloy {
    /// Returns the weight of a volume, in grams.
    pub fn grams(&self, volume_mm3: f64) -> f64 {
        volume_mm3 * self.density / 1000.0
    }
}

/// The distance between the lines along which metal is measured, in mm.
const LINE_MM: f64 = 0.02;

/// The most lines along one side of the metal: for larger metal they lie farther apart, so that any size takes its time.
const MOST_LINES: f64 = 65_536.0;

impl Mounting {
    /// Returns the volume of the metal, in mm³, to about a thousandth of it. Where pieces reach into one another, their common
    /// part counts once.
    ///
    /// The metal is measured along lines in the direction y, the finger's, a fixed distance apart. Only the lines of one row
    /// are kept at a time.
    pub fn volume_mm3(&self) -> f64 {
        let (low, high) = bounds(self.metal.iter().flat_map(|part| part.surface.points.iter().copied()));
        let extent = high - low;
        if !extent.is_finite() {
            return 0.0;
        }
        let apart = LINE_MM.max(extent.x.max(extent.z) / MOST_LINES);
        // Lines lie off the corners that symmetric rings have on round numbers.
        let first = DVec2::new(low.x, low.z) + DVec2::new(0.371, 0.417) * apart;
        let triangles = self.metal.iter().flat_map(|part| {
            let surface = &part.surface;
            (0..surface.corners.len())
                .filter_map(move |number| RowTriangle::new(surface.triangle(number), first, apart))
        });
        let mut triangles: Vec<RowTriangle> = triangles.collect();
        triangles.sort_by_key(|triangle| triangle.rows[0]);
        let (mut coming, mut here) = (triangles.into_iter().peekable(), vec![]);
        let (mut row, mut crossings, mut length) = (0, vec![], 0.0);
        while let Some(next) = here.first().map(|_| row).or_else(|| coming.peek().map(|t| t.rows[0])) {
            row = next;
            here.extend(std::iter::from_fn(|| coming.next_if(|triangle| triangle.rows[0] <= row)));
            here.iter().for_each(|triangle| triangle.cross(row, &mut crossings));
            crossings.sort_by(|a, b| a.line.cmp(&b.line).then(a.height.total_cmp(&b.height)));
            length += crossings.chunk_by(|a, b| a.line == b.line).map(inside).sum::<f64>();
            crossings.clear();
            row += 1;
            here.retain(|triangle| triangle.rows[1] >= row);
        }
        length * apart * apart
    }
}

/// A place where a line enters the metal or leaves it.
struct Crossing {
    /// The line's number in its row.
    line: i64,
    /// The height of the place, in mm.
    height: f64,
    /// 1 where the triangle faces down, so that the line enters; -1 where it leaves.
    step: i32,
}

/// A triangle over the rows of lines, seen along y.
struct RowTriangle {
    /// The corners along x and z, in distances of lines from the first.
    corners: [DVec2; 3],
    /// The height of each corner, in mm.
    heights: [f64; 3],
    /// Twice the area, positive for triangles that face down.
    twice: f64,
    /// The first and the last row that the triangle reaches.
    rows: [i64; 2],
}

impl RowTriangle {
    /// Returns a triangle over lines that lie `apart`; `None` where none can cross it.
    fn new(triangle: [DVec3; 3], first: DVec2, apart: f64) -> Option<Self> {
        let [a, b, c] = triangle.map(|v| (DVec2::new(v.x, v.z) - first) / apart);
        // In the plane of x and z, seen along y, faces turned toward y run clockwise.
        let twice = (b - a).perp_dot(c - a);
        let rows = [a.y.min(b.y).min(c.y).ceil().max(0.0), a.y.max(b.y).max(c.y).floor()];
        let is_crossed = twice != 0.0 && rows[0] <= rows[1];
        let rows = rows.map(|row| row as i64);
        is_crossed.then(|| Self { corners: [a, b, c], heights: triangle.map(|v| v.y), twice, rows })
    }

    /// Adds the crossings of the lines of a row.
    fn cross(&self, row: i64, crossings: &mut Vec<Crossing>) {
        let [a, b, c] = self.corners;
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for (p, q) in [(a, b), (b, c), (c, a)] {
            let part = ((row as f64 - p.y) / (q.y - p.y)).clamp(0.0, 1.0);
            // A level edge gives NaN, and its neighbours its ends.
            let x = p.x + (q.x - p.x) * part;
            let is_met = (p.y.min(q.y)..=p.y.max(q.y)).contains(&(row as f64));
            (low, high) = if is_met { (low.min(x), high.max(x)) } else { (low, high) };
        }
        // One more line on each side is tested, because the test below decides about rounded ends.
        for line in (low.floor() as i64).max(0)..=high.ceil() as i64 {
            let at = DVec2::new(line as f64, row as f64);
            // An edge belongs to one of its two triangles: each computes the same product of it, with the other sign.
            let sides = [(b, c), (c, a), (a, b)].map(|(p, q)| edge(p, q, at));
            if sides.into_iter().all(|w| (w > 0.0) == (self.twice > 0.0)) {
                let height =
                    sides.iter().zip(self.heights).map(|(w, height)| w * height).sum::<f64>() / self.twice;
                crossings.push(Crossing { line, height, step: if self.twice > 0.0 { 1 } else { -1 } });
            }
        }
    }
}

/// Returns twice the area of the triangle of an edge and a point. Both directions of the edge give the same number
/// with opposite signs.
fn edge(p: DVec2, q: DVec2, at: DVec2) -> f64 {
    if (p.x, p.y) < (q.x, q.y) { (p - at).perp_dot(q - at) } else { -(q - at).perp_dot(p - at) }
}

/// Returns the length of a line that lies within metal, of its crossings in the order of their heights.
fn inside(crossings: &[Crossing]) -> f64 {
    let (mut depth, mut entered, mut length) = (0, 0.0, 0.0);
    for &Crossing { height, step, .. } in crossings {
        if depth == 0 {
            entered = height;
        }
        depth += step;
        if depth == 0 {
            length += height - entered;
        }
    }
    length
}
