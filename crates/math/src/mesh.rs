//! Divides a polytope's facets into triangles, for files and graphics cards.

use super::outline::{delaunay, fan};
use super::{Basis, Facet, Polytope};
use glam::{DVec2, DVec3};

/// A mesh of triangles that share corners.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    /// The corners of the polytope, in its order.
    pub vertices: Vec<DVec3>,
    /// The corners of each triangle, as indices into `vertices`, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// The facet that each triangle belongs to.
    pub facets: Vec<u32>,
}

/// Divides every facet into triangles between its own corners, by Delaunay's rule.
///
/// Of all such divisions, this one has the largest smallest angle, so that the only slivers are those that the
/// outline forces.
pub fn triangulate(polytope: &Polytope) -> Mesh {
    let mut mesh = Mesh { vertices: polytope.vertices().to_vec(), triangles: vec![], facets: vec![] };
    for (i, facet) in polytope.facets().iter().enumerate() {
        let before = mesh.triangles.len();
        mesh.triangles.extend(facet_triangles(polytope, facet));
        mesh.facets.extend(std::iter::repeat_n(i as u32, mesh.triangles.len() - before));
    }
    mesh
}

fn facet_triangles(polytope: &Polytope, facet: &Facet) -> Vec<[u32; 3]> {
    let frame = Basis::FACE_UP.aimed(facet.plane.normal);
    let flat: Vec<DVec2> = polytope.corners(facet).map(|c| frame.project(c)).collect();
    // Triangles that leave out a corner would leave a gap to the neighbour that has it.
    delaunay(&flat)
        .filter(|triangles| triangles.len() + 2 == flat.len())
        .unwrap_or_else(|| fan(flat.len()))
        .into_iter()
        .map(|t| t.map(|i| facet.outline[i]))
        .collect()
}
