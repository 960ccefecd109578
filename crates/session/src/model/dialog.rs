//! Dialogs, which ask or state something, and the data that each holds while it is open.

use super::choosing::Purpose;
use super::exporting::ExportForm;
use super::fitting::{RetargetForm, YieldForm};
use super::recovery::RecoveredWork;
use brillianteer_files::mesh_options::MeshOptions;
use std::path::{Path, PathBuf};

/// An action that waits for the answer to a question.
#[derive(Debug, Clone, PartialEq)]
pub enum Then {
    /// Open this file; the options apply to meshes.
    Open(PathBuf, MeshOptions),
    /// Begin from a cut that comes with the program.
    Library(String),
    /// Begin a scene of glass that comes with the program.
    Preset(String),
    /// Close the window.
    Close,
}

impl Then {
    /// Opens a file; a mesh is read with the default options.
    pub fn open(path: PathBuf) -> Self {
        Self::Open(path, MeshOptions::default())
    }
}

/// A dialog that is open.
#[derive(Debug, Clone)]
pub enum Dialog {
    /// Asks whether to save work that would be lost; holds the action that waits for the answer.
    Unsaved(Then),
    /// Offers work that a crash left behind.
    Recover(Box<RecoveredWork>),
    /// Says that both the file and the design have changed.
    ChangedOutside,
    /// Asks what to export.
    Export(Box<ExportForm>),
    /// Asks before moved copies are lost, which no cut file holds; holds the action that waits for the answer.
    Moved(Then),
    /// Asks for a path, where the system has no file dialog.
    Path(PathForm),
    /// Fits the design to another material.
    Retarget(Box<RetargetForm>),
    /// Finds the size of the stone and its yield.
    Yield(Box<YieldForm>),
    /// Offers the cuts that come with the program.
    Cuts,
    /// Lists keys and terms.
    Keys,
    /// Shows the program's version, licences and crates.
    About(AboutForm),
}

impl Dialog {
    /// Returns whether the dialog is about the open document, so that no other may take its place until it is
    /// answered.
    pub fn is_about_document(&self) -> bool {
        match self {
            Self::Unsaved(_)
            | Self::ChangedOutside
            | Self::Export(_)
            | Self::Moved(_)
            | Self::Path(_)
            | Self::Retarget(_)
            | Self::Yield(_) => true,
            Self::Recover(_) | Self::Cuts | Self::Keys | Self::About(_) => false,
        }
    }

    /// Returns whether the dialog stays until it is answered, even if the user clicks beside it.
    ///
    /// Escape is an answer: the one that changes nothing.
    pub fn insists(&self) -> bool {
        match self {
            Self::Recover(_) | Self::ChangedOutside => true,
            Self::Export(export) => export.is_busy(),
            Self::Unsaved(_)
            | Self::Moved(_)
            | Self::Path(_)
            | Self::Retarget(_)
            | Self::Yield(_)
            | Self::Cuts
            | Self::Keys
            | Self::About(_) => false,
        }
    }
}

/// A path that the user types.
#[derive(Debug, Clone, PartialEq)]
pub struct PathForm {
    /// What the text is for.
    pub purpose: Purpose,
    /// The number of the document that the path is for.
    pub document: u64,
    /// The text so far.
    pub text: String,
    /// True once anyone has typed: Return does not accept a path that was only suggested.
    pub is_typed: bool,
}

impl PathForm {
    /// Asks for a path; the field first holds `begin`, a folder or a file.
    pub fn new(purpose: Purpose, document: u64, begin: &Path) -> Self {
        Self { purpose, document, text: begin.display().to_string(), is_typed: false }
    }

    /// Returns the path in the field.
    pub fn path(&self) -> PathBuf {
        PathBuf::from(self.text.trim())
    }
}

/// The page in the lower part of the About dialog.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum AboutPage {
    /// The crates that the program is built of.
    #[default]
    Crates,
    /// One of the program's licences, by its number.
    Licence(usize),
}

/// The state of the About dialog.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct AboutForm {
    /// The page in sight.
    pub page: AboutPage,
    /// The search text: the list shows the crates whose name or licence contains it.
    pub sought: String,
}
