//! A body as plain data, from which it is built again: planes, triangles, or the dimensions of a glass shape.

use super::{Body, Stone};
use crate::math::{
    ImplicitForm, ImplicitSurface, ImplicitSurfaceError, Plane, PolytopeError, Surface, TriangleMesh,
    TriangleMeshError,
};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// A body as plain data.
#[derive(Serialize, Deserialize)]
pub(super) enum BodyData {
    /// The planes of a stone's facets, each with its name; the names are missing where the facets have none.
    Stone { planes: Vec<Plane>, names: Vec<String> },
    /// Triangles that enclose a solid.
    Mesh(Surface),
    /// The dimensions of a glass shape.
    Glass(ImplicitForm),
}

/// Why data make no body.
#[derive(Debug, thiserror::Error)]
pub(super) enum BodyDataError {
    #[error("{} planes have {} names: give one for each, or none", .planes, .names)]
    Names { planes: usize, names: usize },
    #[error("planes enclose no stone: {}", .0.message(|plane| format!("plane {}", plane + 1)))]
    Stone(PolytopeError),
    #[error(transparent)]
    Mesh(#[from] TriangleMeshError),
    #[error(transparent)]
    Glass(#[from] ImplicitSurfaceError),
}

impl From<Body> for BodyData {
    fn from(body: Body) -> Self {
        match body {
            Body::Stone(stone) => Self::Stone {
                planes: stone.polytope.facets().iter().map(|facet| facet.plane).collect(),
                names: stone.names().to_vec(),
            },
            Body::Mesh(mesh) => Self::Mesh(mesh.surface().clone()),
            Body::Glass(smooth) => Self::Glass(smooth.field().form()),
        }
    }
}

impl TryFrom<BodyData> for Body {
    type Error = BodyDataError;

    fn try_from(data: BodyData) -> Result<Self, BodyDataError> {
        match data {
            BodyData::Stone { planes, names } if names.is_empty() => {
                let polytope = crate::math::Polytope::from_planes(&planes).map_err(BodyDataError::Stone)?;
                Ok(polytope.into())
            }
            BodyData::Stone { planes, names } if names.len() == planes.len() => {
                let facets: Vec<(String, Plane)> = names.into_iter().zip(planes).collect();
                Stone::new(&facets).map(Self::Stone).map_err(BodyDataError::Stone)
            }
            BodyData::Stone { planes, names } => {
                Err(BodyDataError::Names { planes: planes.len(), names: names.len() })
            }
            BodyData::Mesh(surface) => Ok(Arc::new(TriangleMesh::new(surface)?).into()),
            BodyData::Glass(form) => Ok(ImplicitSurface::new(form)?.into()),
        }
    }
}
