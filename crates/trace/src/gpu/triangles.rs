//! Packs triangles and the boxes around them for the graphics card.

use super::gpu_types::{BvhNode, Triangle, three};
use super::limits::{MOST_LEVELS, MOST_TRIANGLES};
use crate::gpu::GpuError;
use brillianteer_math::{Bvh, ShadedMesh, SolidRef, TriangleMesh};
use glam::DVec3;
use std::sync::Arc;

/// The triangles of solids and of metal, the boxes around them, and the range of each body, as in [`super::gpu_types::Body`].
pub(super) struct GpuTriangles {
    /// The triangles, then the smooth normals of those of metal.
    pub triangles: Vec<Triangle>,
    pub nodes: Vec<BvhNode>,
    pub of_solids: Vec<[u32; 4]>,
    pub of_metals: Vec<[u32; 4]>,
}

impl GpuTriangles {
    /// Packs some solids and some bodies of metal.
    pub fn new(solids: &[SolidRef], metals: &[&ShadedMesh]) -> Result<Self, GpuError> {
        let meshes = solids.iter().map(mesh_of).collect::<Result<Vec<Arc<TriangleMesh>>, GpuError>>()?;
        let of_metals: usize = metals.iter().map(|mesh| mesh.surface().corners.len()).sum();
        let count = meshes.iter().map(|s| s.facets().len()).sum::<usize>() + 2 * of_metals;
        let mut trees = meshes.iter().map(|s| s.bvh()).chain(metals.iter().map(|mesh| mesh.bvh()));
        if count > MOST_TRIANGLES || trees.any(|tree| tree.depth() as usize > MOST_LEVELS) {
            return Err(GpuError::TooManyTriangles { count, most: MOST_TRIANGLES });
        }
        let mut all = Self { triangles: vec![], nodes: vec![], of_solids: vec![], of_metals: vec![] };
        for mesh in &meshes {
            let root = all.add_boxes(mesh.bvh());
            all.triangles.extend(mesh.bvh().order().iter().map(|&k| triangle(mesh, k as usize)));
            all.of_solids.push([root, reach_bits(SolidRef::from(mesh).reach()), 0, 0]);
        }
        for mesh in metals {
            let root = all.add_boxes(mesh.bvh());
            all.triangles.extend(mesh.bvh().order().iter().map(|&k| shaded_triangle(mesh, k)));
            // The normals follow all triangles, in their order.
            all.of_metals.push([root, reach_bits(mesh.reach()), of_metals as u32, 0]);
        }
        for mesh in metals {
            all.triangles.extend(mesh.bvh().order().iter().map(|&k| smooth_normals(mesh, k)));
        }
        Ok(all)
    }

    /// Adds the boxes around triangles that will be added next, and returns the place of the outermost box.
    fn add_boxes(&mut self, tree: &Bvh) -> u32 {
        let (root, first) = (self.nodes.len() as u32, self.triangles.len());
        self.nodes.extend(tree.nodes().iter().map(|n| node(n, first)));
        root
    }
}

fn reach_bits(reach: f64) -> u32 {
    (reach as f32).to_bits()
}

/// Returns a solid as triangles; a convex stone's facets are triangulated.
fn mesh_of(solid: &SolidRef) -> Result<Arc<TriangleMesh>, GpuError> {
    let flat = Some(solid).filter(|solid| !matches!(solid, SolidRef::Smooth(_)));
    flat.and_then(|solid| solid.mesh()).ok_or(GpuError::MixedKinds)
}

fn triangle(mesh: &TriangleMesh, k: usize) -> Triangle {
    let corners = mesh.surface().triangles[k].map(|v| mesh.vertices()[v as usize]);
    let normal = mesh.planes()[mesh.facets()[k] as usize].normal;
    packed(corners, normal)
}

fn shaded_triangle(mesh: &ShadedMesh, k: u32) -> Triangle {
    packed(mesh.surface().triangle(k as usize), mesh.corner_normals(k).0)
}

/// Packs three corners, and the normal of their facet.
fn packed([a, b, c]: [DVec3; 3], normal: DVec3) -> Triangle {
    let [normal_x, normal_y, normal_z] = three(normal);
    Triangle { a: three(a), normal_x, b: three(b), normal_y, c: three(c), normal_z }
}

fn smooth_normals(mesh: &ShadedMesh, k: u32) -> Triangle {
    packed(mesh.corner_normals(k).1, DVec3::ZERO)
}

fn node(node: &brillianteer_math::BvhNode, first_triangle: usize) -> BvhNode {
    let start = node.start as usize + if node.count > 0 { first_triangle } else { 0 };
    // A box's corners are rounded like the corners of its triangles, so that no triangle lies outside.
    BvhNode { low: three(node.low), start: start as u32, high: three(node.high), count: node.count }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solids::{heart, star};
    use brillianteer_math::{Pose, Surface};

    #[test]
    fn every_triangle_is_within_its_boxes_and_each_stone_has_its_own() {
        let meshes = [heart(), star()].map(|(vertices, triangles)| {
            let mesh = TriangleMesh::new(Surface::new(vertices, triangles)).unwrap();
            let (at, turn) = (glam::DVec3::new(0.3, 1.1, -0.2), glam::DQuat::from_rotation_x(0.7));
            Arc::new(mesh.reframed(&Pose { at, turn, ..Pose::STILL }))
        });
        let solids = meshes.each_ref().map(SolidRef::from);
        let all = GpuTriangles::new(&solids, &[]).unwrap();
        let roots = [0, meshes[0].bvh().nodes().len() as u32];
        assert_eq!(all.of_solids.iter().map(|range| range[0]).collect::<Vec<_>>(), roots);
        let mut next = 0;
        for node in all.nodes.iter().filter(|n| n.count > 0) {
            let [first, count] = [node.start as usize, node.count as usize];
            assert_eq!(first, next);
            next += count;
            for corner in all.triangles[first..next].iter().flat_map(|t| [t.a, t.b, t.c]) {
                assert!((0..3).all(|i| node.low[i] <= corner[i] && corner[i] <= node.high[i]));
            }
        }
        assert_eq!(next, all.triangles.len());
    }
}
