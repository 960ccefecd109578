//! Searches a bounding volume hierarchy: four boxes, or four triangles, are tried side by side.
//!
//! What the processor can do is found out when the program runs. The loops over four numbers are compiled for it, so there
//! are no closures in them. Sums are not fused, so that the answer does not depend on the processor.

use super::Plane;
use super::bvh::BvhNode;
use glam::{BVec3, DVec3};
use pulp::{Arch, Simd, WithSimd};
use std::sync::LazyLock;

/// How many boxes or triangles are tried side by side.
const SIDE: usize = 4;

/// The numbers of boxes or triangles that are tried side by side.
type Four = [f64; SIDE];

/// The bit of a box's content that says that it holds triangles.
const IS_LEAF: u32 = 1 << 31;

/// How much larger boxes are taken to be on all sides, as a part of the greatest distance of any triangle from the ray's
/// origin: twice what rounding does to triangles that are not seen edge on.
const BOX_SLACK: f64 = 16.0 * f64::EPSILON;

/// The boxes that wait without taking memory from the heap; few rays need more.
const FEW_PENDING: usize = 24;

/// The instructions that the processor has.
static ARCH: LazyLock<Arch> = LazyLock::new(Arch::new);

/// A tree of boxes in fours, around triangles in fours.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct WideTree {
    boxes: Vec<FourBoxes>,
    leaves: Vec<FourTriangles>,
}

#[derive(Debug, Clone, PartialEq)]
struct FourBoxes {
    /// The least coordinates, then the greatest, axis by axis. A box that is not there holds no point.
    bounds: [[Four; 3]; 2],
    /// What is in each box: the place of its four boxes, or that of its triangles with [`IS_LEAF`].
    content: [u32; SIDE],
}

#[derive(Debug, Clone, PartialEq)]
struct FourTriangles {
    /// The coordinates of each of the three corners, axis by axis.
    corners: [[Four; 3]; 3],
    /// The place of the first triangle in the order of the hierarchy.
    first: u32,
    /// The number of triangles.
    count: u32,
}

/// A ray, with what turns triangles so that the ray runs along z.
pub(super) struct Sheared {
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

/// A triangle that a ray meets: its place in the order of the hierarchy, and the distance.
pub(super) type Found = (usize, f64);

impl WideTree {
    /// Gathers the boxes of a hierarchy of halves, and its triangles in the order in which the boxes hold them.
    pub fn new(nodes: &[BvhNode], corners: &[[DVec3; 3]]) -> Self {
        let mut spans: Vec<(u32, u32)> = nodes.iter().map(|node| (node.start, node.count)).collect();
        for k in (0..nodes.len()).rev().filter(|&k| nodes[k].count == 0) {
            let (left, right) = (spans[k + 1], spans[k + nodes[k].start as usize]);
            spans[k] = (left.0, left.1 + right.1);
        }
        let mut tree = Self::default();
        if !nodes.is_empty() {
            Gathering { nodes, spans: &spans, corners, tree: &mut tree }.fill(vec![0]);
        }
        tree
    }

    /// Finds the first triangle that a ray meets at a distance above `after`, among those for which `keep`, given their
    /// places, is true; of several at one distance, the one of the first place.
    pub fn nearest(&self, ray: &Sheared, after: f64, keep: impl Fn(usize) -> bool) -> Option<Found> {
        ARCH.dispatch(Nearest { tree: self, ray, after, keep })
    }

    /// Whether any corner lies farther than `slack` beyond a plane.
    pub fn reaches_beyond(&self, plane: &Plane, slack: f64) -> bool {
        let is_beyond = |[x, y, z]: [f64; 3]| plane.distance(DVec3::new(x, y, z)) > slack;
        let highest = plane.normal.cmpge(DVec3::ZERO);
        let mut open = if self.boxes.is_empty() { vec![] } else { vec![0] };
        while let Some(at) = open.pop() {
            if at & IS_LEAF != 0 {
                let leaf = &self.leaves[(at ^ IS_LEAF) as usize];
                let of_lane = |k: usize| leaf.corners.iter().any(|c| is_beyond([c[0][k], c[1][k], c[2][k]]));
                if (0..leaf.count as usize).any(of_lane) {
                    return true;
                }
                continue;
            }
            let boxes = &self.boxes[at as usize];
            let farthest = |k: usize| [0, 1, 2].map(|i| boxes.bounds[usize::from(highest.test(i))][i][k]);
            open.extend((0..SIDE).filter(|&k| is_beyond(farthest(k))).map(|k| boxes.content[k]));
        }
        false
    }

    /// Returns the corners of the triangle at each place, in order.
    #[cfg(test)]
    pub fn corners(&self) -> Vec<[DVec3; 3]> {
        let mut all: Vec<(u32, [DVec3; 3])> = vec![];
        for leaf in &self.leaves {
            let corner = |c: &[Four; 3], k: usize| DVec3::new(c[0][k], c[1][k], c[2][k]);
            let triangle = |k: u32| (leaf.first + k, leaf.corners.each_ref().map(|c| corner(c, k as usize)));
            all.extend((0..leaf.count).map(triangle));
        }
        all.sort_by_key(|(place, _)| *place);
        all.into_iter().map(|(_, corners)| corners).collect()
    }
}

/// A tree of fours that is being gathered from a hierarchy of halves.
struct Gathering<'a> {
    nodes: &'a [BvhNode],
    /// The first triangle of each node, and the number of its triangles.
    spans: &'a [(u32, u32)],
    corners: &'a [[DVec3; 3]],
    tree: &'a mut WideTree,
}

impl Gathering<'_> {
    /// Opens the largest of some nodes until there are four or all are leaves; adds them as boxes and returns their place.
    fn fill(&mut self, mut held: Vec<usize>) -> u32 {
        while held.len() < SIDE {
            let open = (0..held.len()).filter(|&i| self.spans[held[i]].1 as usize > SIDE);
            let area = |i: &usize| bounds_area(&self.nodes[held[*i]]);
            let Some(largest) = open.max_by(|a, b| area(a).total_cmp(&area(b))) else { break };
            let node = held[largest];
            held.splice(largest..=largest, [node + 1, node + self.nodes[node].start as usize]);
        }
        let place = self.tree.boxes.len();
        let mut boxes = FourBoxes {
            bounds: [[[f64::INFINITY; SIDE]; 3], [[f64::NEG_INFINITY; SIDE]; 3]],
            content: [0; SIDE],
        };
        self.tree.boxes.push(boxes.clone());
        for (k, node) in held.into_iter().enumerate() {
            for axis in 0..3 {
                boxes.bounds[0][axis][k] = self.nodes[node].low[axis];
                boxes.bounds[1][axis][k] = self.nodes[node].high[axis];
            }
            boxes.content[k] = self.content(node);
        }
        self.tree.boxes[place] = boxes;
        place as u32
    }

    /// Adds what is in a node, and returns it as a box's content.
    fn content(&mut self, node: usize) -> u32 {
        let (first, count) = self.spans[node];
        if count as usize > SIDE {
            return self.fill(vec![node + 1, node + self.nodes[node].start as usize]);
        }
        let mut corners = [[[0.0; SIDE]; 3]; 3];
        for (k, triangle) in self.corners[first as usize..(first + count) as usize].iter().enumerate() {
            for (corner, at) in triangle.iter().enumerate() {
                (0..3).for_each(|axis| corners[corner][axis][k] = at[axis]);
            }
        }
        self.tree.leaves.push(FourTriangles { corners, first, count });
        (self.tree.leaves.len() - 1) as u32 | IS_LEAF
    }
}

/// Returns half the surface area of a node's box.
fn bounds_area(node: &BvhNode) -> f64 {
    let d = node.high - node.low;
    d.x * d.y + d.y * d.z + d.z * d.x
}

/// The search for the nearest triangle.
struct Nearest<'a, K> {
    tree: &'a WideTree,
    ray: &'a Sheared,
    after: f64,
    keep: K,
}

/// Boxes that wait to be opened, each with the distance at which the ray enters it.
struct Pending {
    few: [(u32, f64); FEW_PENDING],
    count: usize,
    more: Vec<(u32, f64)>,
}

impl Pending {
    #[inline(always)]
    fn push(&mut self, waiting: (u32, f64)) {
        if self.count < FEW_PENDING {
            self.few[self.count] = waiting;
            self.count += 1;
        } else {
            self.more.push(waiting);
        }
    }

    #[inline(always)]
    fn pop(&mut self) -> Option<(u32, f64)> {
        if self.count == FEW_PENDING
            && let Some(last) = self.more.pop()
        {
            return Some(last);
        }
        self.count = self.count.checked_sub(1)?;
        Some(self.few[self.count])
    }
}

impl<K: Fn(usize) -> bool> WithSimd for Nearest<'_, K> {
    type Output = Option<Found>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Option<Found> {
        let Self { tree, ray, after, keep } = self;
        let (mut best, mut far) = (None, f64::INFINITY);
        let mut pending = Pending { few: [(0, 0.0); FEW_PENDING], count: 0, more: Vec::new() };
        let mut at = 0;
        loop {
            if at & IS_LEAF == 0 {
                let boxes = &tree.boxes[at as usize];
                let (into, out) = ray.enters(boxes, after, far);
                push_sorted(&mut pending, boxes, &into, &out);
            } else {
                let leaf = &tree.leaves[(at ^ IS_LEAF) as usize];
                let met = ray.meets(&leaf.corners);
                for k in 0..leaf.count as usize {
                    let (place, distance) = (leaf.first as usize + k, met[k]);
                    let is_first =
                        distance < far || distance == far && best.is_some_and(|first| place < first);
                    if distance > after && is_first && keep(place) {
                        (best, far) = (Some(place), distance);
                    }
                }
            }
            loop {
                let Some((next, distance)) = pending.pop() else { return Some((best?, far)) };
                // A box that lies behind the best triangle found meanwhile need not be opened.
                if distance <= far {
                    at = next;
                    break;
                }
            }
        }
    }
}

/// Puts the boxes that a ray enters before it leaves them on the pile, the nearest last.
#[inline(always)]
fn push_sorted(pending: &mut Pending, boxes: &FourBoxes, into: &Four, out: &Four) {
    let (mut entered, mut count) = ([(0, 0.0); SIDE], 0);
    for k in 0..SIDE {
        if into[k] <= out[k] {
            let mut place = count;
            while place > 0 && entered[place - 1].1 < into[k] {
                entered[place] = entered[place - 1];
                place -= 1;
            }
            entered[place] = (boxes.content[k], into[k]);
            count += 1;
        }
    }
    for waiting in &entered[..count] {
        pending.push(*waiting);
    }
}

impl Sheared {
    /// Returns `None` for a direction of no length. `root` is the box around all triangles.
    pub fn new(origin: DVec3, direction: DVec3, root: &BvhNode) -> Option<Self> {
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

    /// Returns the distances at which the ray meets triangles, from either side (Woop, Benthin and Wald, appendix A); NaN or
    /// an infinity where it does not.
    #[inline(always)]
    fn meets(&self, corners: &[[Four; 3]; 3]) -> Four {
        let [x, y, z] = self.axes;
        let (mut xs, mut ys, mut zs) = ([[0.0; SIDE]; 3], [[0.0; SIDE]; 3], [[0.0; SIDE]; 3]);
        for c in 0..3 {
            for k in 0..SIDE {
                let along = corners[c][z][k] - self.origin[z];
                xs[c][k] = corners[c][x][k] - self.origin[x] - self.shear.x * along;
                ys[c][k] = corners[c][y][k] - self.origin[y] - self.shear.y * along;
                zs[c][k] = self.shear.z * along;
            }
        }
        let mut distance = [0.0; SIDE];
        for k in 0..SIDE {
            // Twice the areas between the ray and each edge. In the other triangle of an edge the area has the opposite
            // sign, to the last bit.
            let u = xs[2][k] * ys[1][k] - ys[2][k] * xs[1][k];
            let v = xs[0][k] * ys[2][k] - ys[0][k] * xs[2][k];
            let w = xs[1][k] * ys[0][k] - ys[1][k] * xs[0][k];
            let is_beside = (least(least(u, v), w) < 0.0) & (greatest(greatest(u, v), w) > 0.0);
            // A triangle seen edge on has no area: the quotient is then no number, or infinite.
            let met = (u * zs[0][k] + v * zs[1][k] + w * zs[2][k]) / (u + v + w);
            distance[k] = if is_beside { f64::INFINITY } else { met };
        }
        distance
    }

    /// Returns the distance at which the ray meets one triangle, as [`meets`](Self::meets) does.
    #[cfg(test)]
    pub fn meets_one(&self, triangle: &[DVec3; 3]) -> f64 {
        self.meets(&triangle.map(|corner| corner.to_array().map(|c| [c; SIDE])))[0]
    }

    /// Returns the distances at which the ray is first within boxes, and those at which it leaves them or has come as far as
    /// `before`; it meets the boxes where the former are not greater.
    #[inline(always)]
    fn enters(&self, boxes: &FourBoxes, after: f64, before: f64) -> (Four, Four) {
        let (mut into, mut out) = ([after; SIDE], [before; SIDE]);
        for axis in 0..3 {
            let up = usize::from(self.is_up.test(axis));
            let (near, far) = (&boxes.bounds[1 - up][axis], &boxes.bounds[up][axis]);
            for k in 0..SIDE {
                // Where the ray runs along a side of the box, 0 times infinity is NaN, which is passed over.
                let entry = (near[k] - self.before[axis]) * self.per_component[axis];
                let exit = (far[k] - self.beyond[axis]) * self.per_component[axis];
                into[k] = greatest(entry, into[k]);
                out[k] = least(exit, out[k]);
            }
        }
        (into, out)
    }
}

/// Returns the lesser of two numbers, or `b` where `a` is NaN; this is one instruction, as `f64::min` is not.
#[inline(always)]
fn least(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// Returns the greater of two numbers, or `b` where `a` is NaN.
#[inline(always)]
fn greatest(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}
