//! Packs triangles and the boxes around them for the graphics card.

use super::gpu_types::{BvhNode, Triangle, with};
use super::limits::{MOST_LEVELS, MOST_TRIANGLES};
use crate::math::{self, SolidRef, TriangleMesh};
use crate::trace::gpu::GpuError;
use std::sync::Arc;

/// The triangles of solids, the boxes around them, and the range of each solid, as in [`super::gpu_types::Body`].
pub(super) struct GpuTriangles {
    pub triangles: Vec<Triangle>,
    pub nodes: Vec<BvhNode>,
    pub ranges: Vec<[u32; 4]>,
}

impl GpuTriangles {
    pub fn new(solids: &[SolidRef]) -> Result<Self, GpuError> {
        let mut all = Self { triangles: vec![], nodes: vec![], ranges: vec![] };
        let shells = solids.iter().map(shell).collect::<Result<Vec<Arc<TriangleMesh>>, GpuError>>()?;
        let count = shells.iter().map(|s| s.facets().len()).sum();
        if count > MOST_TRIANGLES || shells.iter().any(|s| s.bvh().depth() as usize > MOST_LEVELS) {
            return Err(GpuError::TooManyTriangles { count, most: MOST_TRIANGLES });
        }
        for shell in &shells {
            let (first, first_node) = (all.triangles.len(), all.nodes.len());
            all.triangles.extend(shell.bvh().order().iter().map(|&k| triangle(shell, k as usize)));
            all.nodes.extend(shell.bvh().nodes().iter().map(|n| node(n, first)));
            all.ranges.push([first_node as u32, (SolidRef::from(shell).reach() as f32).to_bits(), 0, 0]);
        }
        Ok(all)
    }
}

/// Returns a solid as triangles; a convex stone's facets are triangulated.
fn shell(solid: &SolidRef) -> Result<Arc<TriangleMesh>, GpuError> {
    let flat = Some(solid).filter(|solid| !matches!(solid, SolidRef::Smooth(_)));
    flat.and_then(|solid| solid.mesh()).ok_or(GpuError::MixedKinds)
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
    use crate::math::fixture::{heart, star};
    use crate::math::{Pose, Surface};

    #[test]
    fn every_triangle_is_within_its_boxes_and_each_stone_has_its_own() {
        let shells = [heart(), star()].map(|(vertices, triangles)| {
            let shell = TriangleMesh::new(Surface::new(vertices, triangles)).unwrap();
            let (at, turn) = (glam::DVec3::new(0.3, 1.1, -0.2), glam::DQuat::from_rotation_x(0.7));
            Arc::new(shell.reframed(&Pose { at, turn, ..Pose::STILL }))
        });
        let solids = shells.each_ref().map(SolidRef::from);
        let all = GpuTriangles::new(&solids).unwrap();
        let roots = [0, shells[0].bvh().nodes().len() as u32];
        assert_eq!(all.ranges.iter().map(|range| range[0]).collect::<Vec<_>>(), roots);
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
