//! A closed convex solid bounded by planes. It is built in `polytope_build`; here is what can be asked of it.

use super::{Plane, polytope_build};
use glam::{DQuat, DVec3};

/// One face of a [`Polytope`].
#[derive(Debug, Clone, PartialEq)]
pub struct Facet {
    /// Its plane, with a unit normal that points outward.
    pub plane: Plane,
    /// Corners, as indices into [`Polytope::vertices`], counter-clockwise seen from outside.
    pub outline: Vec<u32>,
    /// The facet on the other side of each edge, edge `i` running from corner `i` to the next.
    pub neighbours: Vec<u32>,
    /// Which of the planes that the polytope was built from this is.
    pub source: usize,
}

/// A closed, bounded, convex solid: closed by construction, each edge shared by exactly two facets.
///
/// Facets stand in the order of the planes given. Lengths are in whatever unit the planes use; tolerances scale
/// with the largest offset, so the origin belongs in or near the solid.
#[derive(Debug, Clone, PartialEq)]
pub struct Polytope {
    pub(super) facets: Vec<Facet>,
    pub(super) vertices: Vec<DVec3>,
    pub(super) redundant: Vec<usize>,
    pub(super) merged: Vec<(usize, usize)>,
}

impl Polytope {
    /// The intersection of half-spaces.
    ///
    /// Planes that coincide to 1e-7 are merged ([`merged`](Self::merged)); planes that bound no area are left
    /// out ([`redundant`](Self::redundant)).
    ///
    /// # Errors
    /// Where the half-spaces enclose no solid, naming the planes at fault: see [`super::PolytopeError`].
    pub fn from_planes(planes: &[Plane]) -> Result<Self, super::PolytopeError> {
        polytope_build::build(planes)
    }

    /// The same solid elsewhere: scaled by a factor above 0, turned, then shifted. Facets and corners keep their order.
    pub fn moved(&self, scale: f64, turn: DQuat, shift: DVec3) -> Self {
        let mut moved = self.clone();
        for corner in &mut moved.vertices {
            *corner = turn * *corner * scale + shift;
        }
        for Facet { plane, .. } in &mut moved.facets {
            plane.normal = turn * plane.normal;
            plane.offset = plane.offset * scale + plane.normal.dot(shift);
        }
        moved
    }

    /// The faces, in the order of the planes given.
    pub fn facets(&self) -> &[Facet] {
        &self.facets
    }

    /// The corners; every facet's outline refers to them.
    pub fn vertices(&self) -> &[DVec3] {
        &self.vertices
    }

    /// Planes given that bound no area and were left out.
    pub fn redundant(&self) -> &[usize] {
        &self.redundant
    }

    /// Planes given that coincide with an earlier one: (dropped, kept).
    pub fn merged(&self) -> &[(usize, usize)] {
        &self.merged
    }

    /// Number of edges.
    pub fn edge_count(&self) -> usize {
        self.facets.iter().map(|f| f.outline.len()).sum::<usize>() / 2
    }

    /// The corners of a facet in space, counter-clockwise seen from outside.
    pub fn corners(&self, facet: &Facet) -> impl Iterator<Item = DVec3> {
        facet.outline.iter().map(|&v| self.vertices[v as usize])
    }

    /// Half the sum of cross products around the outline: the outward normal times the area.
    fn vector_area(&self, facet: &Facet) -> DVec3 {
        let first = self.vertices[facet.outline[0] as usize];
        let fan = facet.outline[1..].windows(2);
        let cross =
            |w: &[u32]| (self.vertices[w[0] as usize] - first).cross(self.vertices[w[1] as usize] - first);
        fan.map(cross).sum::<DVec3>() / 2.0
    }

    /// Area of one facet.
    pub fn facet_area(&self, facet: &Facet) -> f64 {
        self.vector_area(facet).dot(facet.plane.normal)
    }

    /// Area of all facets.
    pub fn surface_area(&self) -> f64 {
        self.facets.iter().map(|f| self.facet_area(f)).sum()
    }

    /// Enclosed volume.
    pub fn volume(&self) -> f64 {
        // Measured from one of its own corners, so that a solid far from the origin keeps its digits.
        let apex = self.vertices[0];
        self.facets.iter().map(|f| -f.plane.distance(apex) * self.facet_area(f)).sum::<f64>() / 3.0
    }

    /// Area of the outline seen along the unit vector `direction`, from either side.
    pub fn silhouette_area(&self, direction: DVec3) -> f64 {
        self.facets.iter().map(|f| self.facet_area(f) * f.plane.normal.dot(direction).max(0.0)).sum()
    }

    /// The smallest box with sides along the axes that holds it: (least, greatest) coordinates.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        self.vertices.iter().fold(start, |(low, high), &v| (low.min(v), high.max(v)))
    }

    /// The planes of its facets.
    pub fn planes(&self) -> impl Iterator<Item = Plane> + Clone {
        self.facets.iter().map(|f| f.plane)
    }
}
