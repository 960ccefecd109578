//! A bounding volume hierarchy: nested boxes around triangles, by which the first triangle that a ray meets is found without
//! trying all.
//!
//! Two triangles never let a ray through along the edge that they share, however the numbers are rounded. `bvh_build` builds
//! the hierarchy. Sources: S. Woop, C. Benthin and I. Wald, *Watertight Ray/Triangle Intersection*, JCGT 2 (1), 2013, for
//! triangles; T. Ize, *Robust BVH Ray Traversal*, JCGT 2 (2), 2013, for boxes.

use super::bvh_build;
use glam::{BVec3, DVec3};

/// The most boxes that wait while a ray is followed: one for each level at most, and `bvh_build` bounds the levels.
const MOST_PENDING: usize = 64;

/// How much larger boxes are taken to be on all sides, as a part of the greatest distance of any triangle from the ray's
/// origin: twice what rounding does to triangles that are not seen edge on.
const BOX_SLACK: f64 = 16.0 * f64::EPSILON;

/// A box around triangles.
///
/// The nodes of a hierarchy stand depth first: the first half of a box follows the box itself.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BvhNode {
    /// The least coordinates.
    pub low: DVec3,
    /// The greatest coordinates.
    pub high: DVec3,
    /// In a box of boxes, how many nodes after it the second half stands; in a box of triangles, the place of its first
    /// triangle in [`Bvh::order`].
    pub start: u32,
    /// How many triangles the box itself holds; 0 for a box of boxes.
    pub count: u32,
}

/// A hierarchy of boxes around triangles, together with the triangles.
#[derive(Debug, Clone, PartialEq)]
pub struct Bvh {
    nodes: Vec<BvhNode>,
    order: Vec<u32>,
    /// The corners of each triangle, in the same order as `order`.
    corners: Vec<[DVec3; 3]>,
    depth: u32,
}

/// A triangle that a ray meets, and the distance at which it does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// The triangle, by its place in the list that [`Bvh::new`] was given.
    pub triangle: u32,
    /// The distance from the ray's origin, in lengths of the ray's direction.
    pub distance: f64,
}

/// A ray, with what turns triangles so that the ray runs along z.
struct Sheared {
    origin: DVec3,
    axes: [usize; 3],
    shear: DVec3,
    per_component: DVec3,
    /// Along which axes the ray runs upward.
    is_up: BVec3,
    /// The origin moved so that boxes count as larger by [`BOX_SLACK`]: `before` for entering a box, `beyond` for leaving
    /// it.
    before: DVec3,
    beyond: DVec3,
}

impl Bvh {
    /// Builds the boxes around triangles; a million take about a second. The same triangles give the same boxes.
    ///
    /// # Panics
    /// Panics where a triangle names a corner that does not exist, or there are more than 2³² - 1 triangles.
    pub fn new(vertices: &[DVec3], triangles: &[[u32; 3]]) -> Self {
        let (nodes, order) = bvh_build::build(vertices, triangles);
        let corners_of = |&k: &u32| triangles[k as usize].map(|v| vertices[v as usize]);
        let corners = order.iter().map(corners_of).collect();
        let depth = depth(&nodes);
        Self { nodes, order, corners, depth }
    }

    /// Returns the boxes, the outermost first; none where there are no triangles.
    pub fn nodes(&self) -> &[BvhNode] {
        &self.nodes
    }

    /// Returns the triangles in the order in which the boxes hold them, by their places in the list given to
    /// [`new`](Self::new).
    pub fn order(&self) -> &[u32] {
        &self.order
    }

    /// Returns the number of levels of boxes.
    pub fn depth(&self) -> u32 {
        self.depth
    }

    /// Finds the first triangle that a ray meets at a distance above `after`, among those for which `keep` is true.
    ///
    /// Distances are in lengths of `direction`; `after` may be negative. Of several triangles at one distance, the one that
    /// stands first in [`order`](Self::order) is returned.
    pub fn nearest(
        &self,
        origin: DVec3,
        direction: DVec3,
        after: f64,
        keep: impl Fn(u32) -> bool,
    ) -> Option<Hit> {
        let root = self.nodes.first()?;
        let ray = Sheared::new(origin, direction, root)?;
        ray.enters(root, after, f64::INFINITY)?;
        let mut best: Option<(usize, f64)> = None;
        let mut pending = [(0_u32, 0.0_f64); MOST_PENDING];
        let mut waiting = 0;
        let mut at = 0_u32;
        loop {
            let node = &self.nodes[at as usize];
            let far = best.map_or(f64::INFINITY, |(_, d)| d);
            if node.count > 0 {
                best = self.in_leaf(&ray, node, after, best, &keep);
            } else {
                let (left, right) = (at + 1, at + node.start);
                let [a, b] = [left, right].map(|k| ray.enters(&self.nodes[k as usize], after, far));
                if let Some((near, farther)) = nearer_first((left, a), (right, b)) {
                    if let Some(farther) = farther {
                        pending[waiting] = farther;
                        waiting += 1;
                    }
                    at = near;
                    continue;
                }
            }
            // A box that lies behind the best triangle found meanwhile need not be opened.
            let far = best.map_or(f64::INFINITY, |(_, d)| d);
            let next = pending[..waiting].iter().rposition(|&(_, distance)| distance <= far);
            let Some(next) = next else { break };
            (at, waiting) = (pending[next].0, next);
        }
        best.map(|(k, distance)| Hit { triangle: self.order[k], distance })
    }

    fn in_leaf(
        &self,
        ray: &Sheared,
        node: &BvhNode,
        after: f64,
        mut best: Option<(usize, f64)>,
        keep: &impl Fn(u32) -> bool,
    ) -> Option<(usize, f64)> {
        let first = node.start as usize;
        for k in first..first + node.count as usize {
            let Some(distance) = ray.meets(&self.corners[k]) else { continue };
            let is_first = best.is_none_or(|(j, d)| distance < d || distance == d && k < j);
            if distance > after && is_first && keep(self.order[k]) {
                best = Some((k, distance));
            }
        }
        best
    }
}

type Ahead = (u32, f64);

/// Returns the nearer of two boxes that the ray meets; then the other with its distance, if the ray meets it as well.
fn nearer_first(a: (u32, Option<f64>), b: (u32, Option<f64>)) -> Option<(u32, Option<Ahead>)> {
    match (a, b) {
        ((_, None), (_, None)) => None,
        ((a, Some(_)), (_, None)) => Some((a, None)),
        ((_, None), (b, Some(_))) => Some((b, None)),
        ((a, Some(s)), (b, Some(t))) => Some(if t < s { (b, Some((a, s))) } else { (a, Some((b, t))) }),
    }
}

fn depth(nodes: &[BvhNode]) -> u32 {
    let mut levels = vec![1_u32; nodes.len()];
    for (k, node) in nodes.iter().enumerate().filter(|(_, n)| n.count == 0) {
        levels[k + 1] = levels[k] + 1;
        levels[k + node.start as usize] = levels[k] + 1;
    }
    levels.into_iter().max().unwrap_or(0)
}

impl Sheared {
    /// Returns `None` for a direction of no length. `root` is the box around all triangles.
    fn new(origin: DVec3, direction: DVec3, root: &BvhNode) -> Option<Self> {
        let size = direction.abs();
        let z = if size.z >= size.x && size.z >= size.y { 2 } else { usize::from(size.y >= size.x) };
        let (mut x, mut y) = ((z + 1) % 3, (z + 2) % 3);
        if direction[z] < 0.0 {
            std::mem::swap(&mut x, &mut y);
        }
        let along = direction[z];
        let shear = DVec3::new(direction[x] / along, direction[y] / along, 1.0 / along);
        let per_component = direction.recip();
        let is_up = per_component.cmpge(DVec3::ZERO);
        let far = (root.low - origin).abs().max((root.high - origin).abs()).max_element();
        let slack = DVec3::select(is_up, DVec3::ONE, DVec3::NEG_ONE) * (far * BOX_SLACK);
        let (before, beyond) = (origin + slack, origin - slack);
        shear.is_finite().then_some(Self {
            origin,
            axes: [x, y, z],
            shear,
            per_component,
            is_up,
            before,
            beyond,
        })
    }

    /// Returns the distance at which the ray meets a triangle, from either side (Woop, Benthin and Wald, appendix A).
    fn meets(&self, corners: &[DVec3; 3]) -> Option<f64> {
        let [x, y, z] = self.axes;
        let turned = corners.map(|c| {
            let c = c - self.origin;
            DVec3::new(c[x] - self.shear.x * c[z], c[y] - self.shear.y * c[z], self.shear.z * c[z])
        });
        let [a, b, c] = turned;
        // Twice the areas between the ray and each edge. In the other triangle of an edge the area has the opposite sign, to
        // the last bit.
        let (u, v, w) = (c.x * b.y - c.y * b.x, a.x * c.y - a.y * c.x, b.x * a.y - b.y * a.x);
        if (u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0) {
            return None;
        }
        let sum = u + v + w;
        let distance = (u * a.z + v * b.z + w * c.z) / sum;
        // A triangle seen edge on has no area.
        (sum != 0.0 && distance.is_finite()).then_some(distance)
    }

    /// Returns the distance at which the ray is first within a box, if that lies between `after` and `before`.
    fn enters(&self, node: &BvhNode, after: f64, before: f64) -> Option<f64> {
        let near = (DVec3::select(self.is_up, node.low, node.high) - self.before) * self.per_component;
        let far = (DVec3::select(self.is_up, node.high, node.low) - self.beyond) * self.per_component;
        // Where the ray runs along a side of the box, 0 times infinity is NaN, which `min` and `max` of f64 pass over.
        let into = after.max(near.x).max(near.y).max(near.z);
        let out = far.x.min(far.y).min(far.z);
        (into <= out.min(before)).then_some(into)
    }
}

#[cfg(test)]
mod tests;
