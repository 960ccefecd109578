//! A glass shape, ready to be traced and drawn: its function, and triangles for what needs corners and edges.

use super::{Edge, ImplicitSurface, Surface};
use glam::{DQuat, DVec3};
use std::sync::Arc;

/// Steps that a quarter of a turn is cut into: what is drawn over a picture needs no more.
const FINENESS: usize = 8;

/// A solid with a smooth surface. Rays meet its function; its triangles only say how far it reaches and how it is drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct SmoothSolid {
    field: ImplicitSurface,
    surface: Arc<Surface>,
    corners: Vec<DVec3>,
}

impl SmoothSolid {
    /// Cuts the surface into triangles.
    pub fn new(field: ImplicitSurface) -> Self {
        let surface = field.surface(FINENESS);
        let corners = around(&field, &surface);
        Self { field, surface: Arc::new(surface), corners }
    }

    /// The same elsewhere: scaled by a factor above 0, turned, then shifted.
    pub fn moved(&self, scale: f64, turn: DQuat, shift: DVec3) -> Self {
        let place = |v: &DVec3| turn * *v * scale + shift;
        let surface = Surface {
            vertices: self.surface.vertices.iter().map(place).collect(),
            ..(*self.surface).clone()
        };
        Self {
            field: self.field.moved(scale, turn, shift),
            surface: Arc::new(surface),
            corners: self.corners.iter().map(place).collect(),
        }
    }

    /// Its function.
    pub fn field(&self) -> &ImplicitSurface {
        &self.field
    }

    /// Triangles with corners on its surface, grouped by facet.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// Points that the whole solid lies between.
    pub fn corners(&self) -> &[DVec3] {
        &self.corners
    }

    /// The lines between its triangles, each once, with the surface's normals at both ends.
    pub fn edges(&self) -> Vec<Edge> {
        let Surface { vertices, triangles, .. } = &*self.surface;
        let normals: Vec<DVec3> = vertices.iter().map(|v| self.field.normal(*v)).collect();
        let sides = triangles.iter().flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]);
        // Every line has a triangle on either side, which runs along it the other way.
        let edge = |[a, b]: [&u32; 2]| {
            let [a, b] = [*a as usize, *b as usize];
            (a < b).then(|| Edge { ends: [vertices[a], vertices[b]], normals: [normals[a], normals[b]] })
        };
        sides.filter_map(edge).collect()
    }

    /// The triangles of a facet, by their corners' places.
    pub fn triangles_of(&self, facet: u32) -> impl Iterator<Item = [u32; 3]> + '_ {
        let all = self.surface.triangles.iter().zip(&self.surface.groups);
        all.filter(move |(_, group)| **group == facet).map(|(t, _)| *t)
    }
}

/// The corners of the triangles, as far outside as their edges may run inside the surface.
fn around(field: &ImplicitSurface, surface: &Surface) -> Vec<DVec3> {
    let off = field.deviation(FINENESS);
    surface.vertices.iter().map(|v| *v + field.normal(*v) * off).collect()
}
