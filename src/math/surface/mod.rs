//! Surfaces of triangles as files have them: mended into closed ones, and their facets found.
//!
//! [`Surface::mend`] welds, closes cracks and turns every triangle outward; [`facets`] finds the planes of what is
//! mended, and whether it is the convex solid between them. Lengths are in the file's own unit; tolerances are parts
//! of [`Surface::size`].

mod change;
mod edges;
mod fault;
mod fit;
mod hull;
mod mend;
mod noise;
mod orient;
mod regions;
mod seams;
mod settle;
mod shape;
mod weld;

#[cfg(test)]
mod tests;

use glam::DVec3;

pub use change::Change;
pub use fault::SurfaceError;
pub(crate) use fit::eigen;
pub use mend::{Mended, Mending};
pub use shape::{Face, Faceted, SurfaceKind, TooCurved, deviation, faceted_hull, facets};

/// Triangles over shared corners; each is part of a group, which may have a name.
///
/// What a file holds need not be closed, nor be free of gaps, copies or turned triangles; what [`Surface::mend`]
/// answers is.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Surface {
    /// Corners.
    pub vertices: Vec<DVec3>,
    /// Corners of each triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// The group of each triangle, by its place in `names`.
    pub groups: Vec<u32>,
    /// What the groups are called; a name may be empty.
    pub names: Vec<String>,
}

impl Surface {
    /// Triangles of one nameless group.
    pub fn new(vertices: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Self {
        let groups = vec![0; triangles.len()];
        Self { vertices, triangles, groups, names: vec![String::new()] }
    }

    /// The corners of a triangle.
    pub fn corners(&self, triangle: usize) -> [DVec3; 3] {
        self.triangles[triangle].map(|v| self.vertices[v as usize])
    }

    /// The outward normal of a triangle times its area.
    pub fn area_vector(&self, triangle: usize) -> DVec3 {
        let [a, b, c] = self.corners(triangle);
        (b - a).cross(c - a) / 2.0
    }

    /// Area of all triangles.
    pub fn area(&self) -> f64 {
        (0..self.triangles.len()).map(|t| self.area_vector(t).length()).sum()
    }

    /// Enclosed volume; it means something for a closed surface alone, and is negative where that is inside out.
    pub fn volume(&self) -> f64 {
        let (low, high) = self.bounds();
        // Measured from its middle, so that a surface far from the origin keeps its digits.
        self.volume_of(0..self.triangles.len(), (low + high) / 2.0)
    }

    fn volume_of(&self, triangles: impl Iterator<Item = usize>, apex: DVec3) -> f64 {
        let cone = |t: usize| {
            let [a, b, c] = self.corners(t).map(|v| v - apex);
            a.dot(b.cross(c)) / 6.0
        };
        triangles.map(cone).sum()
    }

    /// The smallest box with sides along the axes that holds the corners of all triangles: (least, greatest).
    pub fn bounds(&self) -> (DVec3, DVec3) {
        let used = self.triangles.iter().flatten().map(|&v| self.vertices[v as usize]);
        used.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)))
    }

    /// Half the diagonal of its bounding box: what tolerances are parts of.
    pub fn size(&self) -> f64 {
        let (low, high) = self.bounds();
        (high - low).length() / 2.0
    }

    /// The same surface elsewhere.
    pub fn moved(&self, shift: DVec3) -> Self {
        Self { vertices: self.vertices.iter().map(|&v| v + shift).collect(), ..self.clone() }
    }

    /// Adds another surface, its groups after those that are here.
    pub fn append(&mut self, other: Self) {
        let (vertices, names) = (self.vertices.len() as u32, self.names.len() as u32);
        self.vertices.extend(other.vertices);
        self.triangles.extend(other.triangles.into_iter().map(|t| t.map(|v| v + vertices)));
        self.groups.extend(other.groups.into_iter().map(|g| g + names));
        self.names.extend(other.names);
    }
}
