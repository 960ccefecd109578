//! A closed convex solid bounded by planes, and its measures. `polytope_build` builds it.

use super::{Calipers, Plane, Pose, bounds, hull, polytope_build};
use glam::{DVec2, DVec3};

/// A facet of a [`Polytope`].
#[derive(Debug, Clone, PartialEq)]
pub struct Facet {
    /// The plane of the facet, with a unit normal that points outward.
    pub plane: Plane,
    /// The corners, as indices into [`Polytope::vertices`], counter-clockwise seen from outside.
    pub outline: Vec<u32>,
    /// The facet across each edge; edge `i` runs from corner `i` to the next.
    pub neighbours: Vec<u32>,
    /// The place of the facet's plane among the planes that the polytope was built from.
    pub source: usize,
    /// The frosting of the facet: 0 polished, 1 as rough as possible. It does not change the shape.
    pub frosting: f64,
}

/// A closed, bounded, convex solid, in which each edge is shared by exactly two facets.
///
/// Facets are in the order of the given planes. Lengths are in the unit of the planes. Tolerances are proportional to
/// the largest offset, so the origin should lie in or near the solid.
#[derive(Debug, Clone, PartialEq)]
pub struct Polytope {
    pub(super) facets: Vec<Facet>,
    pub(super) vertices: Vec<DVec3>,
    pub(super) redundant: Vec<usize>,
    pub(super) merged: Vec<(usize, usize)>,
}

impl Polytope {
    /// Makes the intersection of half-spaces.
    ///
    /// Planes that coincide to 1e-7 are merged ([`merged`](Self::merged)); planes that bound no area are left
    /// out ([`redundant`](Self::redundant)).
    ///
    /// # Errors
    /// Returns an error that names the planes at fault where the half-spaces enclose no solid: see [`super::PolytopeError`].
    pub fn from_planes(planes: &[Plane]) -> Result<Self, super::PolytopeError> {
        polytope_build::build(planes)
    }

    /// Builds the same solid in the frame to which a pose carries it. Facets and corners keep their order.
    ///
    /// This is for a stone that is brought into the frame of all stones; scenes carry their stones by a pose instead.
    pub fn reframed(&self, pose: &Pose) -> Self {
        let mut reframed = self.clone();
        reframed.vertices.iter_mut().for_each(|corner| *corner = pose.place(*corner));
        reframed.facets.iter_mut().for_each(|facet| facet.plane = facet.plane.placed(pose));
        reframed
    }

    /// Returns the same solid with frosted facets. `of_plane` gives the frosting of the facet of each plane, by the
    /// place of the plane among those that the polytope was built from: 0 polished, 1 as rough as possible.
    pub fn frosted(mut self, of_plane: impl Fn(usize) -> f64) -> Self {
        self.facets.iter_mut().for_each(|facet| facet.frosting = of_plane(facet.source));
        self
    }

    /// Returns whether a facet is frosted, so that light that meets it cannot be followed exactly.
    pub fn is_frosted(&self) -> bool {
        self.facets.iter().any(|facet| facet.frosting > 0.0)
    }

    /// Returns the facets, in the order of the given planes.
    pub fn facets(&self) -> &[Facet] {
        &self.facets
    }

    /// Returns the corners, to which the outlines of the facets refer.
    pub fn vertices(&self) -> &[DVec3] {
        &self.vertices
    }

    /// Returns the places of given planes that bound no area and were left out.
    pub fn redundant(&self) -> &[usize] {
        &self.redundant
    }

    /// Returns the places of given planes that coincide with an earlier one, as pairs (dropped, kept).
    pub fn merged(&self) -> &[(usize, usize)] {
        &self.merged
    }

    /// Returns the number of edges.
    pub fn edge_count(&self) -> usize {
        self.facets.iter().map(|f| f.outline.len()).sum::<usize>() / 2
    }

    /// Returns the corners of a facet in space, counter-clockwise seen from outside.
    pub fn corners(&self, facet: &Facet) -> impl Iterator<Item = DVec3> {
        facet.outline.iter().map(|&v| self.vertices[v as usize])
    }

    /// Returns half the sum of cross products around the outline, which is the outward normal times the area.
    fn vector_area(&self, facet: &Facet) -> DVec3 {
        let first = self.vertices[facet.outline[0] as usize];
        let fan = facet.outline[1..].windows(2);
        let cross =
            |w: &[u32]| (self.vertices[w[0] as usize] - first).cross(self.vertices[w[1] as usize] - first);
        fan.map(cross).sum::<DVec3>() / 2.0
    }

    /// Returns the area of one facet.
    pub fn facet_area(&self, facet: &Facet) -> f64 {
        self.vector_area(facet).dot(facet.plane.normal)
    }

    /// Returns the width of a facet: the least distance between two parallel lines in its plane that hold it.
    pub fn facet_width(&self, facet: &Facet) -> f64 {
        let (u, v) = facet.plane.normal.any_orthonormal_pair();
        let flat = |corner: DVec3| DVec2::new(corner.dot(u), corner.dot(v));
        Calipers::of(&hull(self.corners(facet).map(flat).collect())).map_or(0.0, |found| found.width)
    }

    /// Returns the total area of all facets.
    pub fn surface_area(&self) -> f64 {
        self.facets.iter().map(|f| self.facet_area(f)).sum()
    }

    /// Returns the enclosed volume.
    pub fn volume(&self) -> f64 {
        // The volume is measured from one of the solid's own corners, so that a solid far from the origin keeps its
        // digits.
        let apex = self.vertices[0];
        self.facets.iter().map(|f| -f.plane.distance(apex) * self.facet_area(f)).sum::<f64>() / 3.0
    }

    /// Returns the area of the silhouette along the unit vector `direction`, which is the same from either side.
    pub fn silhouette_area(&self, direction: DVec3) -> f64 {
        self.facets.iter().map(|f| self.facet_area(f) * f.plane.normal.dot(direction).max(0.0)).sum()
    }

    /// Returns the smallest box with sides along the axes that holds the solid, as (least, greatest) coordinates.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        bounds(self.vertices.iter().copied())
    }

    /// Returns the planes of the facets.
    pub fn planes(&self) -> impl Iterator<Item = Plane> + Clone {
        self.facets.iter().map(|f| f.plane)
    }
}
