//! Files that are being opened.

use super::document::Document;
use super::preset::Preset;
use super::work::Work;
use brillianteer_files::mesh_options::MeshOptions;
use std::path::PathBuf;

/// The purpose for which a file is opened.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OpeningPurpose {
    /// Opens the file for work in the place of the present document.
    Anew,
    /// Reads the open file again, and moves no view.
    Again,
    /// Opens the file as the other design of a comparison.
    Beside,
    /// Reads the open mesh with other options.
    Otherwise,
}

/// A file that is to be read.
#[derive(Debug, Clone, PartialEq)]
pub struct FileRequest {
    /// What the file is read for.
    pub purpose: OpeningPurpose,
    /// The file.
    pub path: PathBuf,
    /// The options by which a mesh is read.
    pub mesh: MeshOptions,
}

impl FileRequest {
    /// Returns whether the file is opened for a comparison, so that the present document stays.
    pub fn is_beside(&self) -> bool {
        self.purpose == OpeningPurpose::Beside
    }
}

/// A file that is being opened.
#[derive(Debug, Clone)]
pub struct Opening {
    /// The request that is answered.
    pub request: FileRequest,
    /// The work as it was when the file was requested.
    pub work: Work,
    /// The content of the file, once it has been read.
    pub read: Option<OpenedFile>,
}

impl Opening {
    /// Returns a message that says which file is being opened.
    pub fn message(&self) -> String {
        format!("opening {}…", self.request.path.file_name().unwrap_or_default().to_string_lossy())
    }
}

/// The content of a file.
#[derive(Debug, Clone)]
pub enum OpenedFile {
    /// A design as a document.
    Design(Box<Document>),
    /// A scene.
    Scene(Box<Preset>),
}
