//! A glass shape for tracing and drawing: its function, and triangles for the code that needs corners and edges.

use super::{Edge, ImplicitSurface, Surface};
use glam::DVec3;

/// The number of steps into which a quarter turn is divided; lines drawn over a picture need no more.
const FINENESS: usize = 8;

/// A solid with a smooth surface.
///
/// Rays meet the surface of its function. Its triangles only show its extent, and serve for drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct SmoothSolid {
    field: ImplicitSurface,
    surface: Surface,
    corners: Vec<DVec3>,
}

impl SmoothSolid {
    /// Makes the solid, and divides its surface into triangles.
    pub fn new(field: ImplicitSurface) -> Self {
        let surface = field.surface(FINENESS);
        let corners = around(&field, &surface);
        Self { field, surface, corners }
    }

    /// Returns the function of the surface.
    pub fn field(&self) -> &ImplicitSurface {
        &self.field
    }

    /// Returns triangles with corners on the surface, grouped by facet.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// Returns points whose convex hull contains the whole solid.
    pub fn corners(&self) -> &[DVec3] {
        &self.corners
    }

    /// Returns the lines between the triangles, each once, with the normals of the surface at both ends.
    pub fn edges(&self) -> Vec<Edge> {
        let Surface { vertices, triangles, .. } = &self.surface;
        let normals: Vec<DVec3> = vertices.iter().map(|v| self.field.normal(*v)).collect();
        let sides = triangles.iter().flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]);
        // Each line has a triangle on either side, and the two triangles run along it in opposite directions.
        let edge = |[a, b]: [&u32; 2]| {
            let [a, b] = [*a as usize, *b as usize];
            (a < b).then(|| Edge { ends: [vertices[a], vertices[b]], normals: [normals[a], normals[b]] })
        };
        sides.filter_map(edge).collect()
    }
}

/// Returns the corners of the triangles, moved outward by the greatest depth of the triangles below the surface.
fn around(field: &ImplicitSurface, surface: &Surface) -> Vec<DVec3> {
    let off = field.deviation(FINENESS);
    surface.vertices.iter().map(|v| *v + field.normal(*v) * off).collect()
}
