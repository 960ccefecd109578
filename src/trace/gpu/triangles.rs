//! Packs triangles and the boxes around them for the graphics card.

use super::gpu_types::{Body, BvhNode, Triangle, with};
use super::solids::MOST_LEVELS;
use crate::math::{self, SolidRef, TriangleMesh};
use crate::trace::gpu::GpuError;
use glam::DVec3;
use std::sync::Arc;

/// The most triangles that one picture may hold: 48 bytes each, in a buffer of less than the 128 MiB that all cards take.
/// Their indices are exact in f32.
pub const MOST_TRIANGLES: usize = 2_500_000;

/// The triangles of all stones, the boxes around them, and which stone they belong to.
pub(super) struct GpuTriangles {
    pub triangles: Vec<Triangle>,
    pub nodes: Vec<BvhNode>,
    pub bodies: Vec<Body>,
}

impl GpuTriangles {
    pub fn new(stones: &[SolidRef], balls: &[(DVec3, f64)]) -> Result<Self, GpuError> {
        let mut all = Self { triangles: vec![], nodes: vec![], bodies: vec![] };
        let shells = stones.iter().map(shell).collect::<Result<Vec<Arc<TriangleMesh>>, GpuError>>()?;
        let count = shells.iter().map(|s| s.facets().len()).sum();
        if count > MOST_TRIANGLES || shells.iter().any(|s| s.bvh().depth() as usize > MOST_LEVELS) {
            return Err(GpuError::TooManyTriangles { count, most: MOST_TRIANGLES });
        }
        for (shell, &(middle, radius)) in shells.iter().zip(balls) {
            let (first, first_node) = (all.triangles.len(), all.nodes.len());
            all.triangles.extend(shell.bvh().order().iter().map(|&k| triangle(shell, k as usize)));
            all.nodes.extend(shell.bvh().nodes().iter().map(|n| node(n, first)));
            let range = [first, all.triangles.len(), first_node, all.nodes.len()].map(|k| k as u32);
            all.bodies.push(Body { middle: with(middle, radius), range });
        }
        Ok(all)
    }
}

/// Returns a solid as triangles; a convex stone's facets are triangulated.
fn shell(solid: &SolidRef) -> Result<Arc<TriangleMesh>, GpuError> {
    match solid {
        SolidRef::Convex(polytope) => Ok(Arc::new(TriangleMesh::of_polytope(polytope))),
        SolidRef::Triangles(shell) => Ok(Arc::clone(shell)),
        SolidRef::Smooth(_) => Err(GpuError::MixedKinds),
    }
}

fn triangle(shell: &TriangleMesh, k: usize) -> Triangle {
    let [a, b, c] = shell.surface().triangles[k].map(|v| shell.vertices()[v as usize]);
    let normal = shell.planes()[shell.facets()[k] as usize].normal;
    Triangle { a: with(a, normal.x), b: with(b, normal.y), c: with(c, normal.z) }
}

fn node(node: &math::BvhNode, first_triangle: usize) -> BvhNode {
    let start = node.start as usize + if node.count > 0 { first_triangle } else { 0 };
    // A box's corners are rounded like the triangles' own, so that no triangle lies outside.
    BvhNode { low: with(node.low, start as f64), high: with(node.high, f64::from(node.count)) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Surface;
    use crate::math::fixture::{heart, star};

    #[test]
    fn every_triangle_is_within_its_boxes_and_each_stone_has_its_own() {
        let shells = [heart(), star()].map(|(vertices, triangles)| {
            let shell = TriangleMesh::new(Surface::new(vertices, triangles)).unwrap();
            Arc::new(shell.moved(1.0, glam::DQuat::from_rotation_x(0.7), DVec3::new(0.3, 1.1, -0.2)))
        });
        let solids = shells.each_ref().map(SolidRef::from);
        let all = GpuTriangles::new(&solids, &[(DVec3::ZERO, 1.0); 2]).unwrap();
        assert_eq!(all.bodies[0].range[1], all.bodies[1].range[0]);
        assert_eq!(all.bodies[1].range[3] as usize, all.nodes.len());
        let mut next = 0;
        for node in all.nodes.iter().filter(|n| n.high[3] > 0.0) {
            let [first, count] = [node.low[3] as usize, node.high[3] as usize];
            assert_eq!(first, next);
            next += count;
            for corner in all.triangles[first..next].iter().flat_map(|t| [t.a, t.b, t.c]) {
                assert!((0..3).all(|i| node.low[i] <= corner[i] && corner[i] <= node.high[i]));
            }
        }
        assert_eq!(next, all.triangles.len());
    }
}
