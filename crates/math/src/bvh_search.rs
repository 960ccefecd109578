//! Searches a bounding volume hierarchy. Four boxes, or four triangles, are tested side by side (SIMD).
//!
//! The instruction set of the processor is detected when the program runs. The compiler would not compile closures
//! for it, so the code that runs side by side has none. Products and sums are not fused, so that the result does not
//! depend on the processor.

use super::Plane;
use super::bvh::BvhNode;
use super::bvh_build::FULL;
use glam::{BVec3, DVec3};
use pulp::{Arch, Simd, WithSimd};
use std::sync::LazyLock;

/// The number of boxes or triangles that are tested side by side.
const SIDE: usize = 4;

// All triangles that one box holds are tested at once.
const _: () = assert!(FULL <= SIDE);

/// One number for each of the boxes or triangles that are tested side by side.
type Four = [f64; SIDE];

/// The bit of a box's content that marks a box of triangles.
const IS_LEAF: u32 = 1 << 31;

/// The length by which boxes are enlarged on all sides, as a part of the greatest distance of any triangle from the
/// ray's origin: twice the rounding error of triangles that the ray does not meet edge on.
const BOX_SLACK: f64 = 16.0 * f64::EPSILON;

/// The greatest reciprocal of a component of a direction, for rays along an axis.
const MOST_PER: DVec3 = DVec3::splat(1e200);

/// The number of waiting boxes that need no memory from the heap; few rays need more.
const FEW_PENDING: usize = 24;

/// The instruction set of the processor.
static ARCH: LazyLock<Arch> = LazyLock::new(Arch::new);

/// A tree of boxes in groups of four, around triangles in groups of four.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct WideTree {
    boxes: Vec<FourBoxes>,
    leaves: Vec<FourTriangles>,
    /// The coordinates of the normals of each leaf's triangles, axis by axis; empty where none were given.
    normals: Vec<[Four; 3]>,
}

#[derive(Debug, Clone, PartialEq)]
struct FourBoxes {
    /// The least coordinates, then the greatest, axis by axis. An unused place has a box that holds no point.
    bounds: [[Four; 3]; 2],
    /// The content of each box: the place of its four boxes, or that of its triangles with [`IS_LEAF`].
    content: [u32; SIDE],
}

#[derive(Debug, Clone, PartialEq)]
struct FourTriangles {
    /// The coordinates of each of the three corners of the triangles, axis by axis.
    corners: [[Four; 3]; 3],
    /// The place of the first triangle of the group in the order of the hierarchy.
    first: u32,
    /// The number of triangles in the group.
    count: u32,
}

/// A ray, and the numbers by which triangles are turned so that the ray runs along z.
pub(super) struct Sheared {
    origin: DVec3,
    axes: [usize; 3],
    shear: DVec3,
    per_component: DVec3,
    /// True for the axes along which the ray's direction is positive.
    is_up: BVec3,
    /// The origin, moved so that boxes count as larger by [`BOX_SLACK`]: `before` for entering a box, `beyond` for
    /// leaving it.
    before: DVec3,
    beyond: DVec3,
}

/// A triangle that a ray meets: its place in the order of the hierarchy, and the distance.
pub(super) type FoundTriangle = (usize, f64);

impl WideTree {
    /// Gathers the boxes of a binary hierarchy in groups of four, with its triangles in the order in which the boxes
    /// hold them.
    pub fn new(nodes: &[BvhNode], corners: &[[DVec3; 3]]) -> Self {
        let mut spans: Vec<(u32, u32)> = nodes.iter().map(|node| (node.start, node.count)).collect();
        for k in (0..nodes.len()).rev().filter(|&k| nodes[k].count == 0) {
            let (left, right) = (spans[k + 1], spans[k + nodes[k].start as usize]);
            spans[k] = (left.0, left.1 + right.1);
        }
        // An unused place refers to the first leaf, which is empty.
        let nothing = FourTriangles { corners: [[[0.0; SIDE]; 3]; 3], first: 0, count: 0 };
        let mut tree = Self { boxes: vec![], leaves: vec![nothing], normals: vec![] };
        if !nodes.is_empty() {
            Gathering { nodes, spans: &spans, corners, tree: &mut tree }.fill(vec![0]);
        }
        tree
    }

    /// Sets the normals of the triangles, in the order in which the boxes hold them.
    pub fn set_normals(&mut self, normals: &[DVec3]) {
        let of_leaf = |leaf: &FourTriangles| {
            let mut four = [[0.0; SIDE]; 3];
            for (k, normal) in normals[leaf.first as usize..][..leaf.count as usize].iter().enumerate() {
                (0..3).for_each(|axis| four[axis][k] = normal[axis]);
            }
            four
        };
        self.normals = self.leaves.iter().map(of_leaf).collect();
    }

    /// Finds the first triangle that a ray meets at a distance above `after`, among those for whose places `keep` is
    /// true. Of several triangles at the same distance, the one with the first place is returned.
    pub fn nearest(&self, ray: &Sheared, after: f64, keep: impl Fn(usize) -> bool) -> Option<FoundTriangle> {
        ARCH.dispatch(Nearest { tree: self, ray, after, along: None, keep })
    }

    /// Finds the first triangle that a ray meets at a distance above `after`, as [`nearest`](Self::nearest) does, among
    /// those whose normals have a positive part along a vector.
    pub fn nearest_along(&self, ray: &Sheared, after: f64, along: DVec3) -> Option<FoundTriangle> {
        if self.normals.is_empty() {
            return None;
        }
        ARCH.dispatch(Nearest { tree: self, ray, after, along: Some(along), keep: |_| true })
    }

    /// Returns whether any corner lies farther than `slack` beyond a plane.
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

/// A tree of groups of four that is being gathered from a binary hierarchy.
struct Gathering<'a> {
    nodes: &'a [BvhNode],
    /// The first triangle of each node, and the number of its triangles.
    spans: &'a [(u32, u32)],
    corners: &'a [[DVec3; 3]],
    tree: &'a mut WideTree,
}

impl Gathering<'_> {
    /// Opens the largest of some nodes until there are four or all are leaves. Adds them as a group of boxes and
    /// returns its place.
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
            content: [IS_LEAF; SIDE],
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

    /// Adds the content of a node, and returns it as the content of a box.
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
    /// Where it is given, only triangles whose normals have a positive part along it count.
    along: Option<DVec3>,
    keep: K,
}

/// The boxes that wait to be opened: the content of each, and the distance at which the ray enters it.
struct Pending {
    content: [u32; FEW_PENDING],
    distance: [f64; FEW_PENDING],
    count: usize,
    more: Vec<(u32, f64)>,
}

impl Pending {
    #[inline(always)]
    fn push(&mut self, content: u32, distance: f64) {
        if self.count < FEW_PENDING {
            (self.content[self.count], self.distance[self.count]) = (content, distance);
            self.count += 1;
        } else {
            self.more.push((content, distance));
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
        Some((self.content[self.count], self.distance[self.count]))
    }

    /// Adds the boxes that a ray meets, the nearest of them last.
    #[inline(always)]
    fn push_sorted(&mut self, boxes: &FourBoxes, distances: &Four) {
        let (mut lanes, mut count) = ([0_usize; SIDE], 0);
        for lane in 0..SIDE {
            if distances[lane] < f64::INFINITY {
                let mut place = count;
                while place > 0 && distances[lanes[place - 1]] < distances[lane] {
                    lanes[place] = lanes[place - 1];
                    place -= 1;
                }
                lanes[place] = lane;
                count += 1;
            }
        }
        for &lane in &lanes[..count] {
            self.push(boxes.content[lane], distances[lane]);
        }
    }
}

impl<K: Fn(usize) -> bool> WithSimd for Nearest<'_, K> {
    type Output = Option<FoundTriangle>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Option<FoundTriangle> {
        let Self { tree, ray, after, along, keep } = self;
        let (mut best, mut far) = (None, f64::INFINITY);
        let mut pending =
            Pending { content: [0; FEW_PENDING], distance: [0.0; FEW_PENDING], count: 0, more: Vec::new() };
        let mut at = 0;
        loop {
            if at & IS_LEAF == 0 {
                let boxes = &tree.boxes[at as usize];
                pending.push_sorted(boxes, &ray.enters(simd, boxes, after, far));
            } else {
                let number = (at ^ IS_LEAF) as usize;
                let leaf = &tree.leaves[number];
                let facing = match along {
                    Some(along) => parts(simd, &tree.normals[number], along),
                    None => [1.0; SIDE],
                };
                if facing[0] > 0.0 || facing[1] > 0.0 || facing[2] > 0.0 || facing[3] > 0.0 {
                    let met = ray.meets(simd, &leaf.corners);
                    for (k, &distance) in met.iter().enumerate().take(leaf.count as usize) {
                        let place = leaf.first as usize + k;
                        let is_first =
                            distance < far || distance == far && best.is_some_and(|first| place < first);
                        if distance > after && is_first && facing[k] > 0.0 && keep(place) {
                            (best, far) = (Some(place), distance);
                        }
                    }
                }
            }
            loop {
                let Some((next, distance)) = pending.pop() else { return Some((best?, far)) };
                // A box that lies behind the best triangle found since then need not be opened.
                if distance <= far {
                    at = next;
                    break;
                }
            }
        }
    }
}

impl Sheared {
    /// Prepares a ray; `None` for a direction of no length, and where a number is not finite. `root` is the box
    /// around all triangles.
    pub fn new(origin: DVec3, direction: DVec3, root: &BvhNode) -> Option<Self> {
        let size = direction.abs();
        let z = if size.z >= size.x && size.z >= size.y { 2 } else { usize::from(size.y >= size.x) };
        let (mut x, mut y) = ((z + 1) % 3, (z + 2) % 3);
        if direction[z] < 0.0 {
            std::mem::swap(&mut x, &mut y);
        }
        let along = direction[z];
        let shear = DVec3::new(direction[x] / along, direction[y] / along, 1.0 / along);
        // Finite, so that a product with 0 is not NaN.
        let per_component = direction.recip().clamp(-MOST_PER, MOST_PER);
        let is_up = per_component.cmpge(DVec3::ZERO);
        let far = (root.low - origin).abs().max((root.high - origin).abs()).max_element();
        let slack = DVec3::select(is_up, DVec3::ONE, DVec3::NEG_ONE) * (far * BOX_SLACK);
        let (before, beyond) = (origin + slack, origin - slack);
        (shear.is_finite() && direction.is_finite() && origin.is_finite()).then_some(Self {
            origin,
            axes: [x, y, z],
            shear,
            per_component,
            is_up,
            before,
            beyond,
        })
    }

    /// Returns the distances at which the ray meets triangles, from either side (Woop, Benthin and Wald, appendix A);
    /// NaN or an infinity for a triangle that it does not meet.
    #[inline(always)]
    fn meets<S: Simd>(&self, simd: S, corners: &[[Four; 3]; 3]) -> Four {
        let mut distances = [f64::INFINITY; SIDE];
        for row in (0..SIDE).step_by(S::F64_LANES) {
            let [x0, y0, z0] = self.turned(simd, &corners[0], row);
            let [x1, y1, z1] = self.turned(simd, &corners[1], row);
            let [x2, y2, z2] = self.turned(simd, &corners[2], row);
            // Twice the areas between the ray and each edge. For the other triangle at an edge, the area has the
            // opposite sign and the same bits.
            let u = simd.sub_f64s(simd.mul_f64s(x2, y1), simd.mul_f64s(y2, x1));
            let v = simd.sub_f64s(simd.mul_f64s(x0, y2), simd.mul_f64s(y0, x2));
            let w = simd.sub_f64s(simd.mul_f64s(x1, y0), simd.mul_f64s(y1, x0));
            let zero = simd.splat_f64s(0.0);
            let is_beside = simd.and_m64s(
                simd.less_than_f64s(simd.min_f64s(simd.min_f64s(u, v), w), zero),
                simd.greater_than_f64s(simd.max_f64s(simd.max_f64s(u, v), w), zero),
            );
            // A triangle that the ray meets edge on has no area, so the quotient is NaN or infinite.
            let sum = simd.add_f64s(simd.add_f64s(u, v), w);
            let uv = simd.add_f64s(simd.mul_f64s(u, z0), simd.mul_f64s(v, z1));
            let met = simd.div_f64s(simd.add_f64s(uv, simd.mul_f64s(w, z2)), sum);
            let met = simd.select_f64s(is_beside, simd.splat_f64s(f64::INFINITY), met);
            store(simd, &mut distances, row, met);
        }
        distances
    }

    /// Returns one corner of each triangle of a row, turned so that the ray runs along z from the origin.
    #[inline(always)]
    fn turned<S: Simd>(&self, simd: S, corner: &[Four; 3], row: usize) -> [S::f64s; 3] {
        let [x, y, z] = self.axes;
        let along = simd.sub_f64s(load(simd, &corner[z], row), simd.splat_f64s(self.origin[z]));
        let right = simd.sub_f64s(load(simd, &corner[x], row), simd.splat_f64s(self.origin[x]));
        let up = simd.sub_f64s(load(simd, &corner[y], row), simd.splat_f64s(self.origin[y]));
        [
            simd.sub_f64s(right, simd.mul_f64s(simd.splat_f64s(self.shear.x), along)),
            simd.sub_f64s(up, simd.mul_f64s(simd.splat_f64s(self.shear.y), along)),
            simd.mul_f64s(simd.splat_f64s(self.shear.z), along),
        ]
    }

    /// Returns the distance at which the ray meets one triangle, as [`meets`](Self::meets) does.
    #[cfg(test)]
    pub fn meets_one(&self, triangle: &[DVec3; 3]) -> f64 {
        self.meets(pulp::Scalar, &triangle.map(|corner| corner.to_array().map(|c| [c; SIDE])))[0]
    }

    /// Returns the distances at which the ray enters boxes, at least `after`; infinite for a box that it does not
    /// enter at a distance below `before`.
    #[inline(always)]
    fn enters<S: Simd>(&self, simd: S, boxes: &FourBoxes, after: f64, before: f64) -> Four {
        let mut distances = [f64::INFINITY; SIDE];
        for row in (0..SIDE).step_by(S::F64_LANES) {
            let (mut into, mut out) = (simd.splat_f64s(after), simd.splat_f64s(before));
            for axis in 0..3 {
                let up = usize::from(self.is_up.test(axis));
                let per = simd.splat_f64s(self.per_component[axis]);
                let near = load(simd, &boxes.bounds[1 - up][axis], row);
                let far = load(simd, &boxes.bounds[up][axis], row);
                let entry = simd.mul_f64s(simd.sub_f64s(near, simd.splat_f64s(self.before[axis])), per);
                let exit = simd.mul_f64s(simd.sub_f64s(far, simd.splat_f64s(self.beyond[axis])), per);
                into = simd.max_f64s(entry, into);
                out = simd.min_f64s(exit, out);
            }
            let is_met = simd.less_than_or_equal_f64s(into, out);
            let met = simd.select_f64s(is_met, into, simd.splat_f64s(f64::INFINITY));
            store(simd, &mut distances, row, met);
        }
        distances
    }
}

/// Returns the parts of four vectors, given axis by axis, along another; the sums are those of [`DVec3::dot`].
#[inline(always)]
fn parts<S: Simd>(simd: S, vectors: &[Four; 3], along: DVec3) -> Four {
    let mut parts = [0.0; SIDE];
    for row in (0..SIDE).step_by(S::F64_LANES) {
        let x = simd.mul_f64s(load(simd, &vectors[0], row), simd.splat_f64s(along.x));
        let y = simd.mul_f64s(load(simd, &vectors[1], row), simd.splat_f64s(along.y));
        let z = simd.mul_f64s(load(simd, &vectors[2], row), simd.splat_f64s(along.z));
        store(simd, &mut parts, row, simd.add_f64s(simd.add_f64s(x, y), z));
    }
    parts
}

/// Returns as many numbers, from a place on, as the processor takes side by side; places beyond the end give 0.
#[inline(always)]
fn load<S: Simd>(simd: S, numbers: &Four, place: usize) -> S::f64s {
    match S::as_simd_f64s(&numbers[place..]).0.first() {
        Some(row) => *row,
        None => simd.partial_load_f64s(&numbers[place..]),
    }
}

/// Stores the numbers of a row, from a place on.
#[inline(always)]
fn store<S: Simd>(simd: S, numbers: &mut Four, place: usize, row: S::f64s) {
    match S::as_mut_simd_f64s(&mut numbers[place..]).0.first_mut() {
        Some(places) => *places = row,
        None => simd.partial_store_f64s(&mut numbers[place..], row),
    }
}
