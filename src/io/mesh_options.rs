//! The options by which a mesh is read, since its file states neither which way its table faces nor whether its
//! triangles stand for flat facets.

use crate::cut::from_mesh::Up;
use serde::{Deserialize, Serialize};

/// The options by which a mesh is read as a stone. By default both are found from its shape.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MeshOptions {
    /// The direction in which the table faces, in the mesh's own frame.
    pub up: Up,
    /// The form of the stone: between planes, or within triangles.
    pub form: MeshForm,
}

/// The form in which the triangles of a mesh are read. clap prints these comments as the option's help.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum MeshForm {
    /// The shape decides: facets where the mesh means a convex stone, else triangles.
    #[default]
    #[cfg_attr(feature = "cli", value(skip))]
    Found,
    /// The flat facets of a convex stone, which exact beams, scopes and drawings need.
    Faceted,
    /// The triangles themselves, which rays trace.
    Triangles,
}
