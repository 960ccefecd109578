//! The error of a stone that cannot be made from its facets.

use brillianteer_math::PolytopeError;
use glam::DVec3;

/// The reason why facets make no stone.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FromMeshError {
    /// A direction up that is zero or not finite.
    #[error(
        "the direction up, {0}, is not a direction; three finite numbers that are not all 0 are expected"
    )]
    Up(DVec3),
    /// The planes enclose nothing.
    #[error("the facets that were found make no stone: {0}")]
    Polytope(#[from] PolytopeError),
}
