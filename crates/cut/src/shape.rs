//! The cut of a stone: the shape that a file gives it.

use super::family_cut::FamilyCut;
use super::glass::Glass;
use super::mesh_shape::MeshShape;
use super::round_brilliant::RoundBrilliant;
use super::tiers::Tiers;
use brillianteer_math::Plane;
use serde::{Deserialize, Serialize};

/// The shape of a stone: a family with its proportions, tiers, planes, a mesh, or a glass shape.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Cut {
    /// A round brilliant, by its proportions.
    RoundBrilliant(RoundBrilliant),
    /// A cut of another family, by the numbers of its table.
    Family(FamilyCut),
    /// Facets by angle, distance and index, as cutters write them.
    Tiers(#[serde(with = "super::tiers::whole")] Tiers),
    /// Planes with their names, as written: 1 to [`MAX_PLANES`](super::MAX_PLANES) planes, normals of any length but
    /// zero. Names may repeat.
    Planes(Vec<(String, Plane)>),
    /// Triangles that enclose a solid that is not convex.
    Mesh(MeshShape),
    /// A shape of glass that is no gem: pill, prism, cube or wavy plate, by its dimensions.
    Glass(Glass),
}

impl Cut {
    /// Returns the proportions if the cut is a round brilliant.
    pub fn brilliant(&self) -> Option<&RoundBrilliant> {
        match self {
            Self::RoundBrilliant(brilliant) => Some(brilliant),
            Self::Family(_) | Self::Tiers(_) | Self::Planes(_) | Self::Mesh(_) | Self::Glass(_) => None,
        }
    }
}
