//! Surfaces of triangles with shared corners, closed or open.

use super::bounds;
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// Triangles with shared corners. Each triangle belongs to a group, which may have a name.
///
/// A surface from a file may be open and have gaps, copies or triangles that face inward. A surface that
/// [`Surface::mend`] returns has none of these faults.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Surface {
    /// The corners.
    pub vertices: Vec<DVec3>,
    /// The corners of each triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// The group of each triangle, by its place in `names`.
    pub groups: Vec<u32>,
    /// The names of the groups; a name may be empty.
    pub names: Vec<String>,
}

impl Surface {
    /// Makes a surface of triangles that form one group without a name.
    pub fn new(vertices: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Self {
        let groups = vec![0; triangles.len()];
        Self { vertices, triangles, groups, names: vec![String::new()] }
    }

    /// Returns the corners of a triangle.
    pub fn corners(&self, triangle: usize) -> [DVec3; 3] {
        self.triangles[triangle].map(|v| self.vertices[v as usize])
    }

    /// Returns the outward normal of a triangle times its area.
    pub fn area_vector(&self, triangle: usize) -> DVec3 {
        let [a, b, c] = self.corners(triangle);
        (b - a).cross(c - a) / 2.0
    }

    /// Returns the length of a triangle's longest edge.
    pub(super) fn longest_edge(&self, triangle: usize) -> f64 {
        let [a, b, c] = self.corners(triangle);
        a.distance(b).max(b.distance(c)).max(c.distance(a))
    }

    /// Returns the area of all triangles.
    pub fn area(&self) -> f64 {
        (0..self.triangles.len()).map(|t| self.area_vector(t).length()).sum()
    }

    /// Returns the enclosed volume. It is meaningful only for a closed surface, and negative for one that is turned
    /// inside out.
    pub fn volume(&self) -> f64 {
        let (low, high) = self.bounds();
        // The middle as apex keeps the digits of a surface far from the origin.
        self.volume_of(0..self.triangles.len(), (low + high) / 2.0)
    }

    /// Returns the volume of the pyramids between triangles and an apex.
    pub(super) fn volume_of(&self, triangles: impl Iterator<Item = usize>, apex: DVec3) -> f64 {
        let cone = |t: usize| {
            let [a, b, c] = self.corners(t).map(|v| v - apex);
            a.dot(b.cross(c)) / 6.0
        };
        triangles.map(cone).sum()
    }

    /// Returns the smallest box with sides along the axes that holds the corners of all triangles, as (least, greatest).
    pub fn bounds(&self) -> (DVec3, DVec3) {
        bounds(self.triangles.iter().flatten().map(|&v| self.vertices[v as usize]))
    }

    /// Returns half the diagonal of the bounding box; tolerances are parts of this size.
    pub fn size(&self) -> f64 {
        let (low, high) = self.bounds();
        (high - low).length() / 2.0
    }

    /// Returns the same surface moved by `shift`.
    pub fn moved(&self, shift: DVec3) -> Self {
        Self { vertices: self.vertices.iter().map(|&v| v + shift).collect(), ..self.clone() }
    }

    /// Adds another surface; its groups follow those of this one.
    pub fn append(&mut self, other: Self) {
        let (vertices, names) = (self.vertices.len() as u32, self.names.len() as u32);
        self.vertices.extend(other.vertices);
        self.triangles.extend(other.triangles.into_iter().map(|t| t.map(|v| v + vertices)));
        self.groups.extend(other.groups.into_iter().map(|g| g + names));
        self.names.extend(other.names);
    }
}
