//! Unsaved work that is kept on disk, and work that a crash left there.

use super::work::{ReadMesh, Work};
use crate::cut::Design;
use crate::scene::Copies;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use std::time::SystemTime;

/// The part of the scene that an autosave keeps.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct KeptScene {
    // Autosaves of earlier versions name the copies so.
    #[serde(alias = "company")]
    pub copies: Copies,
    /// The backplate: `light`, the name of a pattern, or the file of a picture.
    #[serde(default)]
    pub behind: Option<String>,
    /// How far behind the middle the backplate hangs, mm, if that was set.
    pub behind_mm: Option<f64>,
    /// The strength of refraction, 0 to 1.
    #[serde(default)]
    pub strength: Option<f64>,
}

/// The content of an autosave.
#[derive(Debug, Clone, PartialEq)]
pub struct UnsavedWork {
    pub work: Work,
    /// The scene around the stone.
    pub around: KeptScene,
    /// The file that the design was opened from.
    pub path: Option<PathBuf>,
    /// The autosave file of a crash that this work went on from, which is removed once the work is kept.
    pub replaces: Option<PathBuf>,
}

/// Work that a crash left behind.
#[derive(Debug, Clone, PartialEq)]
pub struct RecoveredWork {
    pub design: Design,
    /// The part of the scene that was kept.
    pub around: KeptScene,
    /// The file that the design was opened from.
    pub path: Option<PathBuf>,
    /// The design in that file, where it can be read.
    pub on_disk: Option<Design>,
    /// The mesh file that the stone was read from, if it was one.
    pub mesh: Option<ReadMesh>,
    /// When the work was last kept.
    pub when: SystemTime,
    /// The autosave file.
    pub file: PathBuf,
}
