//! The settings that an editor starts with.

use super::state_file::StateFile;
use brillianteer_files::mesh_options::MeshOptions;
use brillianteer_session::model::workspace::Workspace;
use brillianteer_session::tasks::{
    Opener,
    files::{Chooser, by_dialog},
};
use std::path::PathBuf;
use std::sync::Arc;

/// The settings that an editor starts with.
pub struct Setup {
    /// A file to open.
    pub file: Option<PathBuf>,
    /// The options by which the file is read where it is a mesh.
    pub mesh: MeshOptions,
    /// The folder of the autosave; `None` for no autosave.
    pub safe: Option<PathBuf>,
    /// The function that asks the user for files.
    pub chooser: Chooser,
    /// The workspace to begin with where none was kept.
    pub workspace: Workspace,
    /// The file that says whether the window is at rest; `None` for no such file.
    pub state_file: Option<StateFile>,
    /// The function that opens folders and pages outside the program.
    pub opener: Opener,
    /// The painter of the window.
    pub painted_by: PaintedBy,
}

impl Default for Setup {
    fn default() -> Self {
        Self {
            file: None,
            mesh: MeshOptions::default(),
            safe: None,
            workspace: Workspace::default(),
            chooser: Arc::new(by_dialog),
            opener: Arc::new(|what| open::that_detached(what)),
            painted_by: PaintedBy::default(),
            state_file: None,
        }
    }
}

/// The device that paints the window.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PaintedBy {
    /// A graphics card.
    #[default]
    Card,
    /// The processor.
    Processor,
}

impl PaintedBy {
    /// Returns the painter's name in the status line and in the environment variable.
    pub fn name(self) -> &'static str {
        match self {
            Self::Card => "card",
            Self::Processor => "processor",
        }
    }
}
