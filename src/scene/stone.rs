//! A polytope whose facets have names.

use crate::math::{Plane, Polytope, PolytopeError};
use glam::{DQuat, DVec3};

/// A convex stone. Lengths in girdle radii, +z out of the table.
#[derive(Debug, Clone, PartialEq)]
pub struct Stone {
    /// Its shape.
    pub polytope: Polytope,
    names: Vec<String>,
}

impl Stone {
    /// The solid between named planes.
    ///
    /// # Errors
    /// Where they enclose none; [`PolytopeError`] refers to the planes by their place in the list.
    pub fn new(facets: &[(String, Plane)]) -> Result<Self, PolytopeError> {
        let planes: Vec<Plane> = facets.iter().map(|(_, plane)| *plane).collect();
        let polytope = Polytope::from_planes(&planes)?;
        let names = polytope.facets().iter().map(|f| facets[f.source].0.clone()).collect();
        Ok(Self { polytope, names })
    }

    /// The name of a facet of the polytope, by its place in [`Polytope::facets`].
    pub fn name(&self, facet: u32) -> &str {
        &self.names[facet as usize]
    }

    /// The same stone turned about its axis, counter-clockwise from above, radians.
    pub fn turned(&self, angle: f64) -> Self {
        let polytope = self.polytope.moved(1.0, DQuat::from_rotation_z(angle), DVec3::ZERO);
        Self { polytope, names: self.names.clone() }
    }

    /// All names, in the order of the facets.
    pub fn names(&self) -> &[String] {
        &self.names
    }
}
