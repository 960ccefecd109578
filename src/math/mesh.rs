//! Triangles of a polytope's facets, for files and graphics cards.

use super::{Basis, Facet, Polytope, polygon};
use glam::{DVec2, DVec3};
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

/// Triangles whose areas differ from the outline's by less than this part cover it; the rest is rounding.
const CLOSED: f64 = 1e-9;

/// Triangles over shared corners.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    /// Corners, those of the polytope in its order.
    pub vertices: Vec<DVec3>,
    /// Corners of each triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// The facet that each triangle is part of.
    pub facets: Vec<u32>,
}

/// Cuts every facet into triangles between its own corners, by Delaunay's rule: of all such cuts the one whose
/// smallest angle is largest, so that there are no slivers but those that the outline itself forces.
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

/// `None` where rounding keeps the triangles from covering the outline, as corners in one line can do.
fn delaunay(flat: &[DVec2]) -> Option<Vec<[usize; 3]>> {
    let points = flat.iter().map(|p| Point2::new(p.x, p.y)).collect();
    let edges = (0..flat.len()).map(|i| [i, (i + 1) % flat.len()]).collect();
    // Corners that fall together leave edges that begin where they end.
    let mut is_sound = true;
    let unfit = |_| is_sound = false;
    let cdt =
        ConstrainedDelaunayTriangulation::<Point2<f64>>::try_bulk_load_cdt(points, edges, unfit).ok()?;
    is_sound.then_some(())?;
    // Loading merges equal points and so may renumber: then the outline is degenerate.
    (cdt.num_vertices() == flat.len()).then_some(())?;
    let triangles: Vec<[usize; 3]> = cdt
        .inner_faces()
        .map(|f| f.vertices().map(|v| v.index()))
        // Outside a chain of corners nearly in line, spade's hull adds slivers: they run round the wrong way.
        .filter(runs_upward)
        .collect();
    (triangles.len() == flat.len() - 2 && same_area(flat, &triangles)).then_some(triangles)
}

/// Whether three places on an outline follow one another in its sense, from whichever one starts.
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
