//! The user's work: everything that undo restores.

use super::render_settings::RenderSettings;
use brillianteer_cut::Design;
use brillianteer_files::mesh_options::MeshOptions;
use brillianteer_scene::{Companions, Copies};
use std::path::PathBuf;
use std::sync::Arc;

/// Everything that undo restores.
#[derive(Debug, Clone, PartialEq)]
pub struct Work {
    /// The design.
    pub design: Design,
    /// The copies of the stone in renders.
    pub copies: Copies,
    /// The stones of other designs and the metal in renders, in mm.
    pub companions: Companions,
    /// The light, the background, and all other settings of pictures.
    pub settings: RenderSettings,
    /// The mesh file that the stone was read from, if it was one.
    pub mesh: Option<ReadMesh>,
    /// The warnings and notes about the file, in words.
    pub remarks: Arc<[String]>,
    /// The number of the [`DocumentOrigin`](super::document_origin::DocumentOrigin) of the design in its document.
    pub origin: usize,
}

/// A mesh file, and the options by which it was read.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadMesh {
    /// The file.
    pub path: PathBuf,
    /// The options by which the file was read.
    pub options: MeshOptions,
    /// How each solid of the file is called, where it has several.
    pub parts: Vec<String>,
    /// True where the shape does not show clearly which way the table faces.
    pub is_doubtful: bool,
    /// The diameter of the stone when it was read, mm.
    pub diameter_mm: f64,
}
