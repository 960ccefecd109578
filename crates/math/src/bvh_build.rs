//! Builds the hierarchy of boxes around triangles. Each box is divided where rays then have the fewest triangles to
//! test (surface area heuristic).
//!
//! Source: I. Wald, *On fast Construction of SAH-based Bounding Volume Hierarchies*, IEEE Symposium on Interactive Ray
//! Tracing, 2007.

use super::bvh::BvhNode;
use glam::DVec3;
use rayon::prelude::*;

/// The number of slices along each axis into which a box is divided to count its triangles.
const BINS: usize = 16;

/// The most triangles that one box holds itself.
pub(super) const FULL: usize = 4;

/// From this level down, boxes are divided by the number of triangles alone. So there are at most log2 of that number
/// more levels than this.
const LEVELS_BY_AREA: u32 = 30;

/// Boxes of more triangles than this are divided on several cores at once.
const ALONE: usize = 1 << 13;

/// A triangle and its box, as they are sorted while the hierarchy is built.
#[derive(Clone, Copy)]
struct Part {
    low: DVec3,
    high: DVec3,
    triangle: u32,
}

/// Returns the boxes, and the triangles in the order in which the boxes hold them.
pub(super) fn build(vertices: &[DVec3], triangles: &[[u32; 3]]) -> (Vec<BvhNode>, Vec<u32>) {
    let part = |(k, t): (usize, &[u32; 3])| {
        let [a, b, c] = t.map(|v| vertices[v as usize]);
        Part { low: a.min(b).min(c), high: a.max(b).max(c), triangle: k as u32 }
    };
    let mut parts: Vec<Part> = triangles.par_iter().enumerate().map(part).collect();
    if parts.is_empty() {
        return (vec![], vec![]);
    }
    let nodes = halve(&mut parts, 0, 0);
    (nodes, parts.iter().map(|p| p.triangle).collect())
}

/// Returns the boxes of some triangles, which are at `first` and the places after it among all triangles.
fn halve(parts: &mut [Part], first: u32, level: u32) -> Vec<BvhNode> {
    if parts.len() <= ALONE {
        let mut nodes = Vec::with_capacity(parts.len());
        halve_alone(parts, first, level, &mut nodes);
        return nodes;
    }
    let (low, high) = bounds(parts);
    let middle = parted(parts, level).unwrap_or(parts.len() / 2);
    let (a, b) = parts.split_at_mut(middle);
    let (left, right) =
        rayon::join(|| halve(a, first, level + 1), || halve(b, first + middle as u32, level + 1));
    let mut nodes = Vec::with_capacity(1 + left.len() + right.len());
    nodes.push(BvhNode { low, high, start: 1 + left.len() as u32, count: 0 });
    nodes.extend(left);
    nodes.extend(right);
    nodes
}

fn halve_alone(parts: &mut [Part], first: u32, level: u32, nodes: &mut Vec<BvhNode>) {
    let (low, high) = bounds(parts);
    let here = nodes.len();
    nodes.push(BvhNode { low, high, start: first, count: parts.len() as u32 });
    let middle = if parts.len() > FULL {
        parted(parts, level).unwrap_or(parts.len() / 2)
    } else if let Some(middle) = parted(parts, level).filter(|_| parts.len() > 1) {
        middle
    } else {
        return;
    };
    let (a, b) = parts.split_at_mut(middle);
    halve_alone(a, first, level + 1, nodes);
    (nodes[here].start, nodes[here].count) = ((nodes.len() - here) as u32, 0);
    halve_alone(b, first + middle as u32, level + 1, nodes);
}

fn bounds(parts: &[Part]) -> (DVec3, DVec3) {
    let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    parts.iter().fold(start, |(low, high), p| (low.min(p.low), high.max(p.high)))
}

/// Returns half the surface area of a box; 0 for an empty box.
fn area(low: DVec3, high: DVec3) -> f64 {
    let d = (high - low).max(DVec3::ZERO);
    d.x * d.y + d.y * d.z + d.z * d.x
}

/// One slice of a box along one axis: the box around its triangles, and their number.
#[derive(Clone, Copy)]
struct Bin {
    low: DVec3,
    high: DVec3,
    count: usize,
}

impl Bin {
    const EMPTY: Self = Self { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY, count: 0 };

    fn joined(self, other: Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            count: self.count + other.count,
        }
    }

    /// Returns the cost, up to a constant factor, of testing the triangles of the slice for a ray that meets the
    /// surrounding box.
    fn cost(&self) -> f64 {
        if self.count == 0 { 0.0 } else { area(self.low, self.high) * self.count as f64 }
    }
}

/// Sorts triangles into two halves and returns the place where the second half begins.
///
/// `None` where the area cannot decide: from [`LEVELS_BY_AREA`] down, where no axis has a border with a finite cost,
/// and where one box for all triangles costs no more.
fn parted(parts: &mut [Part], level: u32) -> Option<usize> {
    if level >= LEVELS_BY_AREA {
        return None;
    }
    let middle = |p: &Part| 0.5 * p.low + 0.5 * p.high;
    let (low, high) = super::bounds(parts.iter().map(middle));
    // Axes without extent, or so long that the division fails, give no slices.
    let scale = (BINS as f64 * (1.0 - 1e-9)) / (high - low);
    let bin = |p: &Part, axis: usize| (((middle(p) - low) * scale)[axis] as usize).min(BINS - 1);
    let mut bins = [[Bin::EMPTY; BINS]; 3];
    for part in parts.iter() {
        let own = Bin { low: part.low, high: part.high, count: 1 };
        for (axis, bins) in bins.iter_mut().enumerate() {
            let k = bin(part, axis);
            bins[k] = bins[k].joined(own);
        }
    }
    let (axis, border, cost) = (0..3)
        .filter(|&axis| scale[axis].is_finite() && scale[axis] > 0.0)
        .filter_map(|axis| cheapest(&bins[axis]).map(|(border, cost)| (axis, border, cost)))
        .min_by(|a, b| a.2.total_cmp(&b.2))?;
    let whole = bounds(parts);
    let whole = area(whole.0, whole.1);
    // The test of a box costs about as much as the test of a triangle.
    if parts.len() <= FULL && whole * (parts.len() as f64 - 1.0) <= cost {
        return None;
    }
    // The order within each half is kept, so that the same triangles always give the same order.
    let (mut before, after): (Vec<Part>, Vec<Part>) = parts.iter().partition(|p| bin(p, axis) < border);
    let middle = before.len();
    before.extend(after);
    parts.copy_from_slice(&before);
    Some(middle)
}

/// Returns the border between slices with the least cost, and that cost. Neither half is empty.
fn cheapest(bins: &[Bin; BINS]) -> Option<(usize, f64)> {
    let mut after = [Bin::EMPTY; BINS + 1];
    for k in (0..BINS).rev() {
        after[k] = after[k + 1].joined(bins[k]);
    }
    let mut before = Bin::EMPTY;
    let mut best: Option<(usize, f64)> = None;
    for border in 1..BINS {
        before = before.joined(bins[border - 1]);
        let cost = before.cost() + after[border].cost();
        let is_split = before.count > 0 && after[border].count > 0;
        if is_split && cost.is_finite() && best.is_none_or(|(_, least)| cost < least) {
            best = Some((border, cost));
        }
    }
    best
}
