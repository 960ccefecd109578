//! What is to be done outside a model. Most tasks are carried out in the background and answer with an action.

use super::choosing::Question;
use super::export::ExportPlan;
use super::opening::FileRequest;
use super::recovery::UnsavedWork;
use super::saving::{SaveRequest, Stamp};
use crate::app::studio::{Order, Shot};
use crate::scene::Specimen;
use std::path::PathBuf;
use std::sync::Arc;

/// Something to be done outside.
#[derive(Debug)]
pub enum Task {
    /// Load a light by its name or file.
    LoadLight(String),
    /// Read a file.
    Read(FileRequest),
    /// Save a design.
    Save(Box<SaveRequest>),
    /// Ask the user for a file by the system's dialog.
    ChooseFile(Question),
    /// Keep unsaved work safe.
    Keep(Box<UnsavedWork>),
    /// Remove what is kept of unsaved work.
    EmptySafe,
    /// Remove an autosave file that a crash left behind.
    Forget(PathBuf),
    /// Watch a file for changes by others, from how it was known last; `None` watches no file.
    Watch(Option<(PathBuf, Stamp)>),
    /// Find out what dropped files are for.
    LookInto(Vec<PathBuf>),
    /// Open a folder or a page by the system's programs.
    OpenOutside(String),
    /// Make small pictures of all that can be exported.
    Thumbnails(Box<ExportPlan>),
    /// Make no more of these small pictures.
    StopThumbnails,
    /// Write the files of an export.
    Export(Box<ExportPlan>),
    /// Stop the export after the files that are whole.
    StopExport,
    /// Make a picture for the clipboard.
    MakeCopy(CopyRequest),
    /// Trace all that is in sight.
    Trace(Box<Order>),
    /// Something that only the window can do.
    Window(WindowTask),
}

/// Something that only the window can do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WindowTask {
    /// Close.
    Close,
    /// Stay open, though the system asks the window to close.
    StayOpen,
    /// Fill the screen, or no longer fill it.
    FullScreen,
    /// Make the panels as wide as they were at first.
    ForgetPanelWidths,
    /// Copy the picture that a view shows to the clipboard.
    CopyShown(usize),
}

/// A picture for the clipboard that is to be made.
#[derive(Debug)]
pub struct CopyRequest {
    /// What the picture is made from.
    pub original: CopyOriginal,
    /// The number of pixels along the longer side.
    pub side: u32,
}

/// What a picture for the clipboard is made from.
#[derive(Debug)]
pub enum CopyOriginal {
    /// A picture that is traced.
    Shot(Box<Shot>),
    /// The drawing of a stone from the side.
    Profile(Arc<Specimen>),
}
