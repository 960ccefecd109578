//! Divides a polytope's facets into triangles, for files and graphics cards.

use super::{Basis, Facet, Polytope, polygon};
use glam::{DVec2, DVec3};
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

/// Triangles cover an outline if their areas add up to its area within this part; a smaller difference is rounding.
const CLOSED: f64 = 1e-9;

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
    delaunay(&flat)
        .unwrap_or_else(|| fan(flat.len()))
        .into_iter()
        .map(|t| t.map(|i| facet.outline[i]))
        .collect()
}

/// Returns the Delaunay triangles of an outline; `None` where rounding keeps them from covering it, which can happen
/// with corners in one line.
fn delaunay(flat: &[DVec2]) -> Option<Vec<[usize; 3]>> {
    let points = flat.iter().map(|p| Point2::new(p.x, p.y)).collect();
    let edges = (0..flat.len()).map(|i| [i, (i + 1) % flat.len()]).collect();
    // Corners that coincide leave edges of zero length.
    let mut is_sound = true;
    let unfit = |_| is_sound = false;
    let cdt =
        ConstrainedDelaunayTriangulation::<Point2<f64>>::try_bulk_load_cdt(points, edges, unfit).ok()?;
    is_sound.then_some(())?;
    // Loading merges equal points and so may renumber the others: the outline is then degenerate.
    (cdt.num_vertices() == flat.len()).then_some(())?;
    let triangles: Vec<[usize; 3]> = cdt
        .inner_faces()
        .map(|f| f.vertices().map(|v| v.index()))
        // Along a chain of corners nearly in line, spade's hull adds slivers outside, which run in the other sense.
        .filter(runs_upward)
        .collect();
    (triangles.len() == flat.len() - 2 && same_area(flat, &triangles)).then_some(triangles)
}

/// Returns whether three places follow one another in the direction of the outline, starting from any of them.
fn runs_upward([a, b, c]: &[usize; 3]) -> bool {
    [a < b, b < c, c < a].iter().filter(|&&up| up).count() == 2
}

fn same_area(flat: &[DVec2], triangles: &[[usize; 3]]) -> bool {
    let whole = polygon::area(flat);
    let parts: f64 = triangles.iter().map(|t| polygon::area(&t.map(|i| flat[i]))).sum();
    (whole - parts).abs() <= CLOSED * whole
}

fn fan(corners: usize) -> Vec<[usize; 3]> {
    (1..corners - 1).map(|i| [0, i, i + 1]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_that_fall_together_are_no_reason_to_panic() {
        let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(DVec2::from);
        assert_eq!(delaunay(&square).map(|t| t.len()), Some(2));
        for twice in 0..4 {
            let mut corners = square.to_vec();
            corners.insert(twice, square[twice]);
            assert_eq!(delaunay(&corners), None);
        }
        assert_eq!(delaunay(&[DVec2::ZERO; 4]), None);
    }
}
