//! The solid that a design describes: a stone between planes, or a solid of another kind.

use super::Stone;
use super::body_data::BodyData;
use brillianteer_math::{ImplicitSurface, NotConvex, Polytope, SmoothSolid, SolidRef, TriangleMesh};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// A solid in the stone's frame: lengths in girdle radii, +z out of the table.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "BodyData", into = "BodyData")]
pub enum Body {
    /// A convex solid between planes, which may have names.
    Stone(Stone),
    /// A solid within triangles, which need not be convex.
    Mesh(Arc<TriangleMesh>),
    /// A solid within a smooth surface.
    Glass(SmoothSolid),
}

impl Body {
    /// Returns the shape in the form that tracers take.
    pub fn solid(&self) -> SolidRef<'_> {
        match self {
            Self::Stone(stone) => SolidRef::Convex(&stone.polytope),
            Self::Mesh(mesh) => SolidRef::Triangles(mesh),
            Self::Glass(smooth) => SolidRef::Smooth(smooth),
        }
    }

    /// Returns the stone, where facets are needed.
    ///
    /// # Errors
    /// Fails where the solid is not a stone between planes.
    pub fn stone(&self) -> Result<&Stone, NotConvex> {
        match self {
            Self::Stone(stone) => Ok(stone),
            Self::Mesh(_) | Self::Glass(_) => Err(NotConvex),
        }
    }

    /// Returns whether the body has frosted facets, whose light only rays in pictures under light follow.
    pub fn is_frosted(&self) -> bool {
        matches!(self, Self::Stone(stone) if stone.polytope.is_frosted())
    }

    /// Returns the names of the facets, in their order; empty where they have none.
    pub fn names(&self) -> Vec<String> {
        match self {
            Self::Stone(stone) => stone.names().to_vec(),
            Self::Mesh(mesh) => mesh.facet_names().into_iter().map(str::to_owned).collect(),
            Self::Glass(smooth) => smooth.field().facets().iter().map(|name| (*name).to_owned()).collect(),
        }
    }

    /// Returns the name of a facet, by its place, for people: with spaces for underscores, or numbered from 1 where
    /// facets have no names.
    pub fn name(&self, facet: u32) -> String {
        match self {
            Self::Stone(stone) => stone.name(facet).replace('_', " "),
            Self::Glass(smooth) => smooth.field().facets()[facet as usize].to_owned(),
            Self::Mesh(mesh) => match mesh.facet_names().get(facet as usize) {
                Some(name) => name.replace('_', " "),
                None => format!("facet {}", facet + 1),
            },
        }
    }
}

impl<'a> From<&'a Body> for SolidRef<'a> {
    fn from(body: &'a Body) -> Self {
        body.solid()
    }
}

impl From<Polytope> for Body {
    fn from(polytope: Polytope) -> Self {
        Self::Stone(Stone::nameless(polytope))
    }
}

impl From<Arc<TriangleMesh>> for Body {
    fn from(mesh: Arc<TriangleMesh>) -> Self {
        Self::Mesh(mesh)
    }
}

impl From<ImplicitSurface> for Body {
    fn from(field: ImplicitSurface) -> Self {
        Self::Glass(SmoothSolid::new(field))
    }
}
