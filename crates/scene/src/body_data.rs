//! A body as plain data: planes, triangles, or the dimensions of a glass shape. The body is built again from them.

use super::{Body, Stone};
use brillianteer_cut::FROSTINGS;
use brillianteer_math::{
    ImplicitForm, ImplicitSurface, ImplicitSurfaceError, Plane, Polytope, PolytopeError, Surface,
    TriangleMesh, TriangleMeshError,
};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// A body as plain data.
#[derive(Serialize, Deserialize)]
pub(super) enum BodyData {
    /// The planes of a stone's facets, each with its name; the names are missing where the facets have none.
    Stone {
        planes: Vec<Plane>,
        names: Vec<String>,
        /// The frosting of each facet; missing where no facet is frosted.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        frosting: Vec<f64>,
    },
    /// Triangles that enclose a solid.
    Mesh(Surface),
    /// The dimensions of a glass shape.
    Glass(ImplicitForm),
}

/// The reason why data make no body.
#[derive(Debug, thiserror::Error)]
pub(super) enum BodyDataError {
    #[error("{} planes have {} names: give one for each, or none", .planes, .names)]
    Names { planes: usize, names: usize },
    #[error("frosting: give a number from 0 to 1 for each of the {} planes, or none", .planes)]
    Frosting { planes: usize },
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
                frosting: if stone.polytope.is_frosted() {
                    stone.polytope.facets().iter().map(|facet| facet.frosting).collect()
                } else {
                    vec![]
                },
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
            BodyData::Stone { planes, names, .. } if !names.is_empty() && names.len() != planes.len() => {
                Err(BodyDataError::Names { planes: planes.len(), names: names.len() })
            }
            BodyData::Stone { planes, frosting, .. }
                if !frosting.is_empty()
                    && (frosting.len() != planes.len()
                        || frosting.iter().any(|f| !FROSTINGS.contains(f))) =>
            {
                Err(BodyDataError::Frosting { planes: planes.len() })
            }
            BodyData::Stone { planes, names, frosting } => {
                let stone = if names.is_empty() {
                    Polytope::from_planes(&planes).map(Stone::nameless)
                } else {
                    Stone::new(&names.into_iter().zip(planes).collect::<Vec<(String, Plane)>>())
                };
                let of_plane = |plane: usize| frosting.get(plane).copied().unwrap_or(0.0);
                stone.map(|stone| Self::Stone(stone.frosted(of_plane))).map_err(BodyDataError::Stone)
            }
            BodyData::Mesh(surface) => Ok(Arc::new(TriangleMesh::new(surface)?).into()),
            BodyData::Glass(form) => Ok(ImplicitSurface::new(form)?.into()),
        }
    }
}
