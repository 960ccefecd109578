//! The requests that save designs, and the stamps by which changes of their files are noticed.

use brillianteer_cut::Design;
use brillianteer_scene::Specimen;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::SystemTime;

/// The time of change and the length of a file when it was last read or written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Stamp(Option<(SystemTime, u64)>);

impl Stamp {
    /// Returns the stamp of the file as it is now; it is empty where there is no such file.
    pub fn of(path: &Path) -> Self {
        let read = std::fs::metadata(path).and_then(|m| Ok((m.modified()?, m.len())));
        Self(read.ok())
    }

    /// Returns whether the file existed.
    pub fn is_there(self) -> bool {
        self.0.is_some()
    }
}

/// A design that is to be saved.
#[derive(Debug)]
pub struct SaveRequest {
    /// The number of the design's document.
    pub document: u64,
    /// The file.
    pub path: PathBuf,
    /// The design.
    pub design: Design,
    /// A stone of the design; its name may be out of date.
    pub specimen: Arc<Specimen>,
}

/// A design that has been saved.
#[derive(Debug)]
pub struct SavedDesign {
    /// The file.
    pub path: PathBuf,
    /// The design that was written.
    pub design: Design,
    /// The file as it is now.
    pub stamp: Stamp,
    /// The properties that the file's format could not hold, in words.
    pub lost: Vec<String>,
}
