//! A bounding volume hierarchy: nested boxes around triangles, by which the first triangle that a ray meets is found without
//! trying all.
//!
//! Two triangles never let a ray through along the edge that they share, however the numbers are rounded. `bvh_build` builds
//! the hierarchy, `bvh_search` searches it. Sources: S. Woop, C. Benthin and I. Wald, *Watertight Ray/Triangle Intersection*, JCGT 2 (1), 2013, for
//! triangles; T. Ize, *Robust BVH Ray Traversal*, JCGT 2 (2), 2013, for boxes.

use super::bvh_search::{Sheared, WideTree};
use super::{Plane, bvh_build};
use glam::DVec3;

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
    /// The same boxes in fours, and the corners of the triangles in the same order as `order`.
    wide: WideTree,
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

impl Bvh {
    /// Builds the boxes around triangles; a million take about a second. The same triangles give the same boxes.
    ///
    /// # Panics
    /// Panics where a triangle names a corner that does not exist, or there are more than 2³² - 1 triangles.
    pub fn new(vertices: &[DVec3], triangles: &[[u32; 3]]) -> Self {
        let (nodes, order) = bvh_build::build(vertices, triangles);
        let corners_of = |&k: &u32| triangles[k as usize].map(|v| vertices[v as usize]);
        let corners: Vec<[DVec3; 3]> = order.iter().map(corners_of).collect();
        let (wide, depth) = (WideTree::new(&nodes, &corners), depth(&nodes));
        Self { nodes, order, wide, depth }
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
        let ray = Sheared::new(origin, direction, self.nodes.first()?)?;
        let (place, distance) = self.wide.nearest(&ray, after, |place| keep(self.order[place]))?;
        Some(Hit { triangle: self.order[place], distance })
    }

    /// Whether any corner of a triangle lies farther than `slack` beyond a plane.
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
