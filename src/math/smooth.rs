//! A glass shape ready to be traced and drawn: its function, and triangles for whatever needs corners and edges.

use super::{Edge, ImplicitSurface, Surface};
use glam::DVec3;

/// The steps that a quarter turn is cut into: lines drawn over a picture need no more.
const FINENESS: usize = 8;

/// A solid with a smooth surface.
///
/// Rays meet its function. Its triangles only say how far the solid reaches and how it is drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct SmoothSolid {
    field: ImplicitSurface,
    surface: Surface,
    corners: Vec<DVec3>,
}

impl SmoothSolid {
    /// Makes the solid and cuts its surface into triangles.
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

    /// Returns points between which the whole solid lies.
    pub fn corners(&self) -> &[DVec3] {
        &self.corners
    }

    /// Returns the lines between the triangles, each once, with the surface's normals at both ends.
    pub fn edges(&self) -> Vec<Edge> {
        let Surface { vertices, triangles, .. } = &self.surface;
        let normals: Vec<DVec3> = vertices.iter().map(|v| self.field.normal(*v)).collect();
        let sides = triangles.iter().flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]);
        // Each line has a triangle on either side, and the two run along it in opposite directions.
        let edge = |[a, b]: [&u32; 2]| {
            let [a, b] = [*a as usize, *b as usize];
            (a < b).then(|| Edge { ends: [vertices[a], vertices[b]], normals: [normals[a], normals[b]] })
        };
        sides.filter_map(edge).collect()
    }
}

/// Returns the corners of the triangles, moved outward by as much as the triangles may lie inside the surface.
fn around(field: &ImplicitSurface, surface: &Surface) -> Vec<DVec3> {
    let off = field.deviation(FINENESS);
    surface.vertices.iter().map(|v| *v + field.normal(*v) * off).collect()
}
