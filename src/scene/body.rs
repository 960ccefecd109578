//! What a design makes: a stone between planes, or a solid of another kind.

use super::Stone;
use crate::math::{NotConvex, SmoothSolid, Solid, SolidRef, TriangleMesh};
use glam::{DQuat, DVec3};
use std::sync::Arc;

/// A solid in the stone's frame: lengths in girdle radii, +z out of the table.
#[derive(Debug, Clone, PartialEq)]
pub enum Body {
    /// Convex, between planes that have names.
    Stone(Stone),
    /// Within triangles; not convex.
    Mesh(Arc<TriangleMesh>),
    /// Within a smooth surface.
    Glass(SmoothSolid),
}

impl Body {
    /// Its shape, to be traced.
    pub fn solid(&self) -> SolidRef<'_> {
        match self {
            Self::Stone(stone) => SolidRef::Convex(&stone.polytope),
            Self::Mesh(shell) => SolidRef::Triangles(shell),
            Self::Glass(smooth) => SolidRef::Smooth(smooth),
        }
    }

    /// The stone, for what needs facets.
    ///
    /// # Errors
    /// Where it is none.
    pub fn stone(&self) -> Result<&Stone, NotConvex> {
        match self {
            Self::Stone(stone) => Ok(stone),
            Self::Mesh(_) | Self::Glass(_) => Err(NotConvex),
        }
    }

    /// The names of its facets, in their order; empty where they have none.
    pub fn names(&self) -> Vec<String> {
        match self {
            Self::Stone(stone) => stone.names().to_vec(),
            Self::Mesh(_) => vec![],
            Self::Glass(smooth) => smooth.field().facets().iter().map(|name| (*name).to_owned()).collect(),
        }
    }

    /// The name of a facet, by its place.
    pub fn name(&self, facet: u32) -> String {
        match self {
            Self::Stone(stone) => stone.name(facet).replace('_', " "),
            Self::Mesh(_) => format!("facet {}", facet + 1),
            Self::Glass(smooth) => smooth.field().facets()[facet as usize].to_owned(),
        }
    }

    /// The same turned about its axis, counter-clockwise from above, radians.
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
