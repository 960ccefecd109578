//! A polytope whose facets have names.

use crate::math::{Plane, Polytope, PolytopeError};

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

    /// All names, in the order of the facets.
    pub fn names(&self) -> &[String] {
        &self.names
    }
}
