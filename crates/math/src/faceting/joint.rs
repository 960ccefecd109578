//! Joins facets that noise has made of one.

use super::change::Change;
use super::deviation::{deviation, outermost};
use super::fit::fit;
use super::search::SAME;
use super::{Face, Faceted};
use crate::{Plane, Polytope};
use glam::DVec3;

impl Faceted {
    /// Returns the same solid with one facet in the place of some, given by their places. `None` where this solid would not
    /// reproduce the surface at the tolerance at which the facets were found, and for scans, whose facets the noise itself
    /// joins.
    pub fn joined(&self, group: &[usize]) -> Option<Self> {
        if self.faces.iter().any(|face| face.error.is_some()) {
            return None;
        }
        let planes: Vec<Plane> = self.polytope.planes().collect();
        let middle = |t: u32| self.surface.corners(t as usize).iter().sum::<DVec3>() / 3.0;
        let all = 0..self.surface.triangles.len() as u32;
        let members: Vec<u32> = all.filter(|&t| group.contains(&outermost(&planes, middle(t)).0)).collect();
        let whole = fit(&self.surface, &members)?;
        let one = Face {
            plane: whole.plane,
            area: group.iter().map(|&f| self.faces[f].area).sum(),
            name: None,
            error: None,
            is_bent: false,
        };
        let others = self.faces.iter().enumerate().filter(|(f, _)| !group.contains(f));
        let mut faces: Vec<Face> = others.map(|(_, face)| face.clone()).chain([one]).collect();
        faces.sort_by(|a, b| b.area.total_cmp(&a.area));
        let planes: Vec<Plane> = faces.iter().map(|face| face.plane).collect();
        let polytope = Polytope::from_planes(&planes).ok()?;
        let deviation = deviation(&polytope, &self.surface.vertices);
        let swelling = (polytope.volume() - self.polytope.volume()).abs();
        let limit = SAME * self.tolerance;
        if deviation > limit || swelling > limit * polytope.surface_area() {
            return None;
        }
        let faces = polytope.facets().iter().map(|facet| faces[facet.source].clone()).collect();
        let change = self.change.map(|_| Change::of(&self.surface, &polytope));
        Some(Self { faces, polytope, deviation, change, ..self.clone() })
    }
}
