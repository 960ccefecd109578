//! What is to be done outside a model. Most tasks are carried out in the background and answer with an action.

use super::choosing::Question;
use super::cut_search::SearchRequest;
use super::export::ExportPlan;
use super::fitting::LightRequest;
use super::opening::FileRequest;
use super::recovery::UnsavedWork;
use super::saving::{SaveRequest, Stamp};
use crate::app::studio::{Order, Shot};
use crate::scene::Specimen;
use crate::search::Goal;
use std::path::PathBuf;
use std::sync::Arc;

/// Work to be done outside the model.
#[derive(Debug)]
pub enum Task {
    /// Load a light by its name or file.
    LoadLight(String),
    Read(FileRequest),
    Save(Box<SaveRequest>),
    /// Ask the user for a file by the system's dialog.
    ChooseFile(Question),
    /// Write unsaved work to the autosave.
    Keep(Box<UnsavedWork>),
    /// Remove the autosave.
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
    /// Stop making small pictures.
    StopThumbnails,
    /// Write the files of an export.
    Export(Box<ExportPlan>),
    /// Stop the export after the files that are whole.
    StopExport,
    /// Make a picture for the clipboard.
    MakeCopy(CopyRequest),
    /// Look for what may not be meant in a stone, for the list of the audit.
    Audit(Arc<Specimen>),
    /// Measure the light of stones that are compared.
    MeasureLight(Box<LightRequest>),
    /// Stop measuring.
    StopLight,
    /// Search for a better cut.
    Search(Box<SearchRequest>),
    /// Read a goal for the search.
    ReadGoal(PathBuf),
    /// Write the goal of the search to a file.
    WriteGoal(PathBuf, Box<Goal>),
    /// Stop the search, which then answers with the best so far.
    StopSearch,
    /// Trace the pictures and figures of all views in sight.
    Trace(Box<Order>),
    Window(WindowTask),
}

/// Something that only the window can do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WindowTask {
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
