//! Tasks: the work to be done outside a model. Most are carried out in the background and answer with an action.

use super::choosing::Question;
use super::cut_search::SearchRequest;
use super::export::ExportPlan;
use super::fitting::LightRequest;
use super::opening::FileRequest;
use super::recovery::UnsavedWork;
use super::saving::{SaveRequest, Stamp};
use crate::studio::{Order, Shot};
use brillianteer_scene::{RingPlan, Specimen};
use brillianteer_search::Goal;
use std::path::PathBuf;
use std::sync::Arc;

/// A piece of work to be done outside the model.
#[derive(Debug)]
pub enum Task {
    /// Load a light by its name or file.
    LoadLight(String),
    /// Reads a file.
    Read(FileRequest),
    /// Writes a design.
    Save(Box<SaveRequest>),
    /// Ask the user for a file by the system's dialog.
    ChooseFile(Question),
    /// Write unsaved work to the autosave.
    Keep(Box<UnsavedWork>),
    /// Keep the present work for the next start.
    KeepLast(Box<UnsavedWork>),
    /// Remove the autosave.
    EmptySafe,
    /// Remove an autosave file that a crash left behind.
    Forget(PathBuf),
    /// Watch a file for changes by other programs since it had this stamp; `None` watches no file.
    Watch(Option<(PathBuf, Stamp)>),
    /// Find out the purposes of dropped files.
    LookInto(Vec<PathBuf>),
    /// Open a folder or a page by the system's programs.
    OpenOutside(String),
    /// Make small pictures of all views that can be exported.
    Thumbnails(Box<ExportPlan>),
    /// Stop making small pictures.
    StopThumbnails,
    /// Write the files of an export.
    Export(Box<ExportPlan>),
    /// Stop the export; files that are complete stay.
    StopExport,
    /// Make a picture for the clipboard.
    MakeCopy(CopyRequest),
    /// Make the audit of a stone, for the list of findings.
    Audit(Arc<Specimen>),
    /// Make the metal of the ring in the document of this number.
    MakeRing(u64, Box<RingPlan>),
    /// Measure the light of stones that are compared.
    MeasureLight(Box<LightRequest>),
    /// Stop measuring that light.
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
    /// What the window alone can do.
    Window(WindowTask),
}

/// A piece of work that only the window can do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WindowTask {
    /// Closes the window.
    Close,
    /// Stay open, though the system asks the window to close.
    StayOpen,
    /// Fill the screen, or leave the full screen.
    FullScreen,
    /// Reset the widths of the panels.
    ForgetPanelWidths,
    /// Copy the picture that a view shows to the clipboard.
    CopyShown(usize),
}

/// The request for a picture for the clipboard.
#[derive(Debug)]
pub struct CopyRequest {
    /// The original that the picture is made from.
    pub original: CopyOriginal,
    /// The number of pixels along the longer side.
    pub side: u32,
}

/// The original from which a picture for the clipboard is made.
#[derive(Debug)]
pub enum CopyOriginal {
    /// A picture that is traced.
    Shot(Box<Shot>),
    /// The drawing of a stone from the side.
    Profile(Arc<Specimen>),
}
