//! What a ring weighs: the volume of metal whose pieces reach into one another, and the densities of alloys.

use super::Mounting;
use crate::math::bounds;
use crate::optics::Metal;
use glam::DVec2;

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

impl Mounting {
    /// Returns the volume of the metal, in mm³, to about a thousandth of it. Where pieces reach into one another, their common
    /// part counts once.
    ///
    /// The metal is measured along lines in the direction y, the finger's, a fixed distance apart.
    pub fn volume_mm3(&self) -> f64 {
        let (low, high) = bounds(self.metal.iter().flat_map(|part| part.surface.points.iter().copied()));
        if !(high - low).is_finite() {
            return 0.0;
        }
        // Lines lie off the corners that symmetric rings have on round numbers.
        let first = DVec2::new(low.x, low.z) + DVec2::new(0.371, 0.417) * LINE_MM;
        let size = ((DVec2::new(high.x, high.z) - first) / LINE_MM).ceil();
        let (across, rows) = (size.x.max(1.0) as usize, size.y.max(1.0) as usize);
        let mut crossings: Vec<Vec<(f64, i32)>> = vec![vec![]; across * rows];
        for part in &self.metal {
            for number in 0..part.surface.corners.len() {
                let triangle = part.surface.triangle(number);
                let flat = triangle.map(|v| (DVec2::new(v.x, v.z) - first) / LINE_MM);
                let heights = triangle.map(|v| v.y);
                cross(flat, heights, across, rows, &mut |at, crossing| crossings[at].push(crossing));
            }
        }
        crossings.iter_mut().map(|line| inside(line)).sum::<f64>() * LINE_MM * LINE_MM
    }
}

/// Finds the lines of a grid that a triangle crosses: for each its place in the grid, the height where it does, and 1 where
/// the triangle faces down, where a line enters the metal, -1 where it leaves.
fn cross(
    [a, b, c]: [DVec2; 3],
    heights: [f64; 3],
    across: usize,
    rows: usize,
    found: &mut impl FnMut(usize, (f64, i32)),
) {
    let twice = (b - a).perp_dot(c - a);
    if twice == 0.0 {
        return;
    }
    let (low, high) = (a.min(b).min(c).ceil(), a.max(b).max(c).floor());
    let clamped = |value: f64, most: usize| value.clamp(0.0, most as f64 - 1.0) as usize;
    if high.x < 0.0 || high.y < 0.0 {
        return;
    }
    for y in clamped(low.y, rows)..=clamped(high.y, rows) {
        for x in clamped(low.x, across)..=clamped(high.x, across) {
            let at = DVec2::new(x as f64, y as f64);
            // An edge belongs to one of its two triangles: each computes the same product of it, with the other sign.
            let sides = [(b, c), (c, a), (a, b)].map(|(p, q)| edge(p, q, at));
            let is_in = |w: f64| (w > 0.0) == (twice > 0.0);
            if sides.into_iter().all(is_in) {
                let height = (sides[0] * heights[0] + sides[1] * heights[1] + sides[2] * heights[2]) / twice;
                // In the plane of x and z seen along y, faces turned toward y run clockwise.
                found(y * across + x, (height, if twice > 0.0 { 1 } else { -1 }));
            }
        }
    }
}

/// Returns twice the area of the triangle of an edge and a point, the same but for its sign for both directions of the edge.
fn edge(p: DVec2, q: DVec2, at: DVec2) -> f64 {
    if (p.x, p.y) < (q.x, q.y) { (p - at).perp_dot(q - at) } else { -(q - at).perp_dot(p - at) }
}

/// Returns the length of a line that lies within metal, where each crossing says whether it enters or leaves.
fn inside(crossings: &mut [(f64, i32)]) -> f64 {
    crossings.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (mut depth, mut entered, mut length) = (0, 0.0, 0.0);
    for &mut (height, step) in crossings {
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
