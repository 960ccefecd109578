//! The solid that a design describes: a stone between planes, or a solid of another kind.

use super::Stone;
use crate::math::{NotConvex, SmoothSolid, Solid, SolidRef, TriangleMesh};
use glam::{DQuat, DVec3};
use std::sync::Arc;

/// A solid in the stone's frame: lengths in girdle radii, +z out of the table.
#[derive(Debug, Clone, PartialEq)]
pub enum Body {
    /// A convex solid between planes that have names.
    Stone(Stone),
    /// A solid within triangles that is not convex.
    Mesh(Arc<TriangleMesh>),
    /// A solid within a smooth surface.
    Glass(SmoothSolid),
}

impl Body {
    /// Returns the shape, as tracers take it.
    pub fn solid(&self) -> SolidRef<'_> {
        match self {
            Self::Stone(stone) => SolidRef::Convex(&stone.polytope),
            Self::Mesh(shell) => SolidRef::Triangles(shell),
            Self::Glass(smooth) => SolidRef::Smooth(smooth),
        }
    }

    /// Returns the stone, where facets are needed.
    ///
    /// # Errors
    /// The solid is not a stone between planes.
    pub fn stone(&self) -> Result<&Stone, NotConvex> {
        match self {
            Self::Stone(stone) => Ok(stone),
            Self::Mesh(_) | Self::Glass(_) => Err(NotConvex),
        }
    }

    /// Returns the names of the facets, in their order; empty where they have none.
    pub fn names(&self) -> Vec<String> {
        match self {
            Self::Stone(stone) => stone.names().to_vec(),
            Self::Mesh(_) => vec![],
            Self::Glass(smooth) => smooth.field().facets().iter().map(|name| (*name).to_owned()).collect(),
        }
    }

    /// Returns the name of a facet, by its place, as people read it: with spaces for underscores, or numbered from 1 where
    /// facets have no names.
    pub fn name(&self, facet: u32) -> String {
        match self {
            Self::Stone(stone) => stone.name(facet).replace('_', " "),
            Self::Mesh(_) => format!("facet {}", facet + 1),
            Self::Glass(smooth) => smooth.field().facets()[facet as usize].to_owned(),
        }
    }

    /// Returns the same solid turned about its axis by an angle in radians, counter-clockwise from above.
    pub fn turned(&self, angle: f64) -> Self {
        match self {
            Self::Stone(stone) => Self::Stone(stone.turned(angle)),
            Self::Mesh(shell) => {
                Self::Mesh(Arc::new(shell.moved(1.0, DQuat::from_rotation_z(angle), DVec3::ZERO)))
            }
            Self::Glass(smooth) => Self::Glass(smooth.moved(1.0, DQuat::from_rotation_z(angle), DVec3::ZERO)),
        }
    }
}

impl From<&Body> for Solid {
    fn from(body: &Body) -> Self {
        body.solid().owned()
    }
}
