//! A mesh in the form that the readers of all formats return.

use super::hint::MaterialHint;
use brillianteer_math::Surface;
use glam::DVec3;

/// The result of a format's reader, which does not yet have its file's name.
#[derive(Default)]
pub(super) struct ParsedMesh {
    pub surface: Surface,
    /// The normals of the surface's corners, 0 where the file gives none; empty where it gives none at all.
    pub normals: Vec<DVec3>,
    pub hint: Option<MaterialHint>,
    pub notes: Vec<String>,
    pub warnings: Vec<String>,
    pub name: Option<String>,
    /// The text of the statement that this program writes into meshes.
    pub said: Option<String>,
}
