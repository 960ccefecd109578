//! Files that are being opened.

use super::document::Document;
use super::preset::Preset;
use super::work::Work;
use crate::io::mesh_options::MeshOptions;
use std::path::PathBuf;

/// What a file is opened for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OpeningPurpose {
    /// To work on the file.
    Anew,
    /// To read the open file again, without moving any view.
    Again,
    /// To compare with the file.
    Beside,
    /// To read the open mesh in another way.
    Otherwise,
}

/// A file that is to be read.
#[derive(Debug, Clone, PartialEq)]
pub struct FileRequest {
    pub purpose: OpeningPurpose,
    pub path: PathBuf,
    /// How the file is read where it is a mesh.
    pub mesh: MeshOptions,
}

impl FileRequest {
    /// Whether the file is opened beside the present document, which stays.
    pub fn is_beside(&self) -> bool {
        self.purpose == OpeningPurpose::Beside
    }
}

/// A file that is being opened.
#[derive(Debug, Clone)]
pub struct Opening {
    pub request: FileRequest,
    /// The work as it was when the file was requested.
    pub work: Work,
    /// The content of the file, once it has been read.
    pub read: Option<OpenedFile>,
}

impl Opening {
    /// Says which file is being opened.
    pub fn message(&self) -> String {
        format!("opening {}…", self.request.path.file_name().unwrap_or_default().to_string_lossy())
    }
}

/// The content of a file.
#[derive(Debug, Clone)]
pub enum OpenedFile {
    Design(Box<Document>),
    Scene(Box<Preset>),
}
