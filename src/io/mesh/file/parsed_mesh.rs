//! A mesh as the reader of its format returns it.

use super::hint::MaterialHint;
use crate::math::Surface;

/// What the reader of a format returns, which does not yet have its file's name.
#[derive(Default)]
pub(super) struct ParsedMesh {
    pub surface: Surface,
    pub hint: Option<MaterialHint>,
    pub warnings: Vec<String>,
    pub name: Option<String>,
    /// The text of the statement that this program writes into meshes.
    pub said: Option<String>,
}
