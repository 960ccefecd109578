//! Where the designs of a document come from.

use super::render_settings::RenderSettings;
use super::saving::Stamp;
use super::view_history::ViewState;
use brillianteer_cut::Design;
use brillianteer_scene::{Companions, Copies};
use std::path::PathBuf;

/// Where a design comes from, and what it was when it was opened or last saved.
///
/// A preset that takes the place of a design is a step of undo, so a document may have several.
#[derive(Debug, Clone)]
pub struct DocumentOrigin {
    /// The design as it is saved.
    pub saved: Design,
    /// The copies and their companions as they were opened, or as they were last written as a scene.
    pub laid: (Copies, Companions),
    /// The settings of pictures with which the design was opened.
    pub first: RenderSettings,
    /// The file; `None` before the design is saved for the first time.
    pub path: Option<PathBuf>,
    /// The name of the scene whose stone is edited.
    pub scene: Option<String>,
    /// The state of the file when it was read or written.
    pub stamp: Stamp,
    /// True where the file no longer exists.
    pub is_lost: bool,
    /// The views when another design took the place of this one.
    pub views: Option<ViewState>,
    /// The number of the origin with which the scene of this design began: the same for all stones of a scene.
    pub scene_from: usize,
}

impl DocumentOrigin {
    /// Makes the origin of a design that has just been opened, with or without a file.
    pub fn new(saved: Design, path: Option<PathBuf>) -> Self {
        let stamp = path.as_deref().map_or_else(Stamp::default, Stamp::of);
        Self {
            saved,
            laid: Default::default(),
            first: RenderSettings::default(),
            path,
            scene: None,
            stamp,
            is_lost: false,
            views: None,
            scene_from: 0,
        }
    }
}
