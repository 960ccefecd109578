//! A bounding volume hierarchy: nested boxes around triangles, which show the first triangle that a ray meets without
//! a test of all triangles.
//!
//! No ray passes between two triangles along the edge that they share, whatever the rounding. `bvh_build` builds the
//! hierarchy, `bvh_search` searches it. Sources: S. Woop, C. Benthin and I. Wald, *Watertight Ray/Triangle
//! Intersection*, JCGT 2 (1), 2013, for triangles; T. Ize, *Robust BVH Ray Traversal*, JCGT 2 (2), 2013, for boxes.

use super::bvh_search::{Sheared, WideTree};
use super::{Plane, bvh_build};
use glam::DVec3;

/// A node of the hierarchy: a box around triangles.
///
/// The nodes of a hierarchy are stored depth first: the first child of a box follows the box itself.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BvhNode {
    /// The least coordinates of the box.
    pub low: DVec3,
    /// The greatest coordinates of the box.
    pub high: DVec3,
    /// In a box of boxes, the number of nodes from this node to its second child; in a box of triangles, the place of
    /// its first triangle in [`Bvh::order`].
    pub start: u32,
    /// The number of triangles that the box itself holds; 0 for a box of boxes.
    pub count: u32,
}

/// A hierarchy of boxes around triangles, together with the triangles.
#[derive(Debug, Clone, PartialEq)]
pub struct Bvh {
    nodes: Vec<BvhNode>,
    order: Vec<u32>,
    /// The same boxes in groups of four, and the corners of the triangles in the same order as `order`.
    wide: WideTree,
    depth: u32,
}

/// The side of a surface from which a ray meets its triangles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FromSide {
    /// The ray runs against the outward normals.
    Outside,
    /// The ray runs along the outward normals.
    Inside,
}

/// A triangle that a ray meets, and the distance at which the ray meets it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// The triangle, as its place in the list that was given to [`Bvh::new`].
    pub triangle: u32,
    /// The distance from the ray's origin, in units of the length of the ray's direction.
    pub distance: f64,
}

impl Bvh {
    /// Builds the boxes around triangles. This takes about a second for a million triangles. The same triangles
    /// always give the same boxes.
    ///
    /// # Panics
    /// Panics where a triangle names a corner that does not exist, or where there are more than 2³² - 1 triangles.
    pub fn new(vertices: &[DVec3], triangles: &[[u32; 3]]) -> Self {
        let (nodes, order) = bvh_build::build(vertices, triangles);
        let corners_of = |&k: &u32| triangles[k as usize].map(|v| vertices[v as usize]);
        let corners: Vec<[DVec3; 3]> = order.iter().map(corners_of).collect();
        let (wide, depth) = (WideTree::new(&nodes, &corners), depth(&nodes));
        Self { nodes, order, wide, depth }
    }

    /// Adds the outward normal of each triangle, given by its place in the list of triangles, for
    /// [`nearest_from`](Self::nearest_from).
    pub fn with_normals(mut self, normal: impl Fn(u32) -> DVec3) -> Self {
        let normals: Vec<DVec3> = self.order.iter().map(|&k| normal(k)).collect();
        self.wide.set_normals(&normals);
        self
    }

    /// Returns the boxes, the outermost first; none where there are no triangles.
    pub fn nodes(&self) -> &[BvhNode] {
        &self.nodes
    }

    /// Returns the triangles in the order in which the boxes hold them, as places in the list that was given to
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
    /// Distances are in units of the length of `direction`; `after` may be negative. Of several triangles at the same
    /// distance, the one that is first in [`order`](Self::order) is returned.
    pub fn nearest(
        &self,
        origin: DVec3,
        direction: DVec3,
        after: f64,
        keep: impl Fn(u32) -> bool,
    ) -> Option<Hit> {
        let ray = Sheared::new(origin, direction, self.nodes.first()?)?;
        let (place, distance) = self.wide.nearest(&ray, after, |place| keep(self.order[place]))?;
        Some(Hit { triangle: self.order[place], distance })
    }

    /// Finds the first triangle that a ray meets from one side of the surface at a distance above `after`, as
    /// [`nearest`](Self::nearest) does. Boxes whose triangles all face the other way are passed over; so this is quicker.
    /// Without [normals](Self::with_normals) no triangle is found.
    pub fn nearest_from(&self, side: FromSide, origin: DVec3, direction: DVec3, after: f64) -> Option<Hit> {
        let ray = Sheared::new(origin, direction, self.nodes.first()?)?;
        let along = if side == FromSide::Inside { direction } else { -direction };
        let (place, distance) = self.wide.nearest_along(&ray, after, along)?;
        Some(Hit { triangle: self.order[place], distance })
    }

    /// Returns whether any corner of a triangle lies farther than `slack` beyond a plane.
    pub fn reaches_beyond(&self, plane: &Plane, slack: f64) -> bool {
        self.wide.reaches_beyond(plane, slack)
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

#[cfg(test)]
mod tests;
