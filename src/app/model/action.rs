//! Everything that a person, or a task that has ended, can do to a model.

use super::choosing::{Choice, Purpose, Question};
use super::command::Command;
use super::dialog::{AboutPage, Then};
use super::export::Selection;
use super::exporting::ExportEvent;
use super::eye::Eye;
use super::opening::{FileRequest, OpenedFile, OpeningPurpose};
use super::recovery::RecoveredWork;
use super::saving::{SavedDesign, Stamp};
use super::session::{Flowing, HeldKeys};
use super::workspace::PanelSide;
use crate::app::liquid::Liquid;
use crate::app::shows::Shows;
use crate::app::studio::{FiguresOrder, Grade, Order, Smoothing, Tilts, Which};
use crate::cut::{Cut, MaterialRef};
use crate::io::Failure;
use crate::io::lighting::Lighting;
use crate::io::mesh_options::MeshOptions;
use crate::measure::Figures;
use crate::scene::Pose;
use glam::DVec2;
use std::path::PathBuf;
use std::sync::Arc;

/// Something that is done to a model.
#[derive(Debug)]
pub enum Action {
    /// A command of a menu or a key.
    Do(Command),
    /// A change of the work, which can be undone.
    Edit(Edit),
    /// A change of how the views look, and of what is beside them.
    View(ViewAction),
    /// Something done with files, and what has come of it.
    File(FileAction),
    /// An answer to the dialog that is open, or a dialog that opens.
    Dialog(DialogAction),
    /// Something done with messages.
    Note(NoteAction),
    /// What has been computed.
    Computed(Computed),
    /// The end of a frame: a moment between two things that a person does, or in the middle of one.
    Frame(FrameEnd),
}

/// A change of the work. Each holds the new value.
#[derive(Debug)]
pub enum Edit {
    /// The name of the design.
    Name(String),
    /// The cut.
    Cut(Cut),
    /// A proportion of the cut: the key of the row that was edited, and the cut with it.
    Proportion(&'static str, Cut),
    /// One tier of the cut; all others stay where they are, in mm.
    Tier {
        /// The place of the tier in [`Cut::settings`].
        place: usize,
        /// The angle, degrees.
        angle: f64,
        /// The distance, in the unit of the design.
        distance: f64,
    },
    /// What the stone is made of.
    Material(MaterialRef),
    /// The diameter, mm.
    Diameter(f64),
    /// The name of the light, or its file.
    Light(String),
    /// The exposure of renders, in stops.
    Exposure(f64),
    /// The half angle of the observer's head, degrees.
    Head(f64),
    /// Lays out so many copies anew.
    LayOut(usize),
    /// The pose of one of the copies.
    Copy(usize, Pose),
}

/// A change of how the views look, and of what is beside them.
#[derive(Debug)]
pub enum ViewAction {
    /// What a view shows.
    Show(usize, Shows),
    /// The eye that a view looks by: its own, or that of the linked views.
    Eye(usize, Eye),
    /// Whether a view looks as the linked views do.
    Link(usize, bool),
    /// Shows a view alone, or among the others again.
    Enlarge(usize),
    /// Ends perspective in a view.
    EndPerspective(usize),
    /// The overlay over pictures, by its name.
    Overlay(Option<String>),
    /// Whether scopes show the strongest exits alone.
    Strongest(bool),
    /// Whether scopes include glare.
    Glare(bool),
    /// Ends a step of the views: the next change begins another.
    EndStep,
    /// The view under the pointer.
    Hover(usize),
    /// What the status line says of what is under the pointer.
    Message(String),
    /// The keys that are held.
    Keys(HeldKeys),
    /// The distance of the eye in perspective, girdle radii.
    Distance(f64),
    /// The number of bands of wavelengths.
    Wavelengths(u32),
    /// The backplate.
    Behind(Option<String>),
    /// The distance of the backplate, mm.
    BehindMm(f64),
    /// The strength of refraction.
    Strength(f64),
    /// How edges are smoothed.
    Smoothing(Smoothing),
    /// The pane of liquid glass.
    Liquid(Liquid),
    /// How the background moves in a view of a refraction map.
    Flowing(usize, Flowing),
    /// Whether figures count areas.
    ByArea(bool),
    /// Opens or folds a panel, in a window with room for both or for one.
    Panel {
        /// The panel.
        side: PanelSide,
        /// Whether the window has room for both panels.
        has_room_for_both: bool,
        /// Whether the panel is open from now on.
        is_open: bool,
    },
    /// Time goes on by so many seconds for what moves.
    Advance(f64),
    /// Stops time and goes back to rest.
    Rest,
    /// The copy that is dragged, with the view that it is dragged in.
    Hold(Option<(usize, usize)>),
    /// Follows the ray through a point of a view's image.
    Follow(usize, DVec2),
    /// Opens or closes the window of the light path.
    LightPath(bool),
    /// Makes a picture of a view for the clipboard, with so many pixels along its longer side.
    CopyAt(usize, u32),
}

/// Something done with files, and what has come of it.
#[derive(Debug)]
pub enum FileAction {
    /// Does something that would lose unsaved work, after a question where there is such work.
    Ask(Then),
    /// Asks the user for a file.
    Choose(Purpose),
    /// The user has answered which file.
    Chosen(Question, Choice),
    /// Opens a file; a mesh that is read again is read as before.
    Open(PathBuf, OpeningPurpose),
    /// Opens a file with these options for meshes.
    OpenWith(FileRequest),
    /// A file has been read.
    Opened(FileRequest, Result<OpenedFile, Failure>),
    /// Reads the open mesh with other options.
    ReadMesh(MeshOptions),
    /// The design has been saved.
    Saved(Result<SavedDesign, Failure>),
    /// The open file has changed on disk, or is gone.
    OnDisk(PathBuf, Stamp),
    /// Files were dropped on the window.
    Dropped(Vec<PathBuf>),
    /// What the dropped files are for.
    DroppedFor(Vec<(PathBuf, Purpose)>),
    /// The unsaved work could not be kept safe.
    NotKept(String),
    /// Work that a crash left behind was found.
    Found(Vec<RecoveredWork>),
    /// The system asks the window to close.
    Close,
    /// The window has ended.
    Ended,
    /// Opens a folder or a page outside the program.
    OpenOutside(String),
}

/// An answer to the dialog that is open, or a dialog that opens.
#[derive(Debug)]
pub enum DialogAction {
    /// Opens the export dialog; with a view, that one alone is selected.
    Export(Option<Shows>),
    /// Leaves the dialog, which changes nothing more.
    Leave,
    /// Keeps what would be lost: saves the design, or exports the copies.
    Keep,
    /// Gives up what would be lost.
    GiveUp,
    /// Goes on with the work that was found.
    Recover,
    /// Forgets the work that was found.
    Forget,
    /// Reads the file again that another program has changed.
    ReadAgain,
    /// The path that is typed.
    Type(String),
    /// Accepts the path that is typed.
    Accept,
    /// The page of the About dialog.
    AboutPage(AboutPage),
    /// The search text of the About dialog.
    AboutSearch(String),
    /// What is selected for export.
    Select(Selection),
    /// The folder of the export.
    Folder(PathBuf),
    /// Begins to write the files.
    Write,
    /// Stops writing.
    Stop,
    /// The export has come further, or to its end.
    Exported(ExportEvent),
}

/// Something done with messages.
#[derive(Debug)]
pub enum NoteAction {
    /// Shows a note that needs no answer.
    Say(String),
    /// Reports an error.
    Trouble(String),
    /// Removes one of the errors and warnings.
    Dismiss(usize),
    /// Removes all errors and warnings.
    DismissAll,
    /// Whether all errors and warnings are listed.
    List(bool),
}

/// What has been computed.
#[derive(Debug)]
pub enum Computed {
    /// A light has been loaded.
    Light(String, Result<Arc<Lighting>, Failure>),
    /// Figures have been measured.
    Figures(Which, FiguresOrder, Grade, Box<Figures>),
    /// Figures against tilt have been measured.
    Tilts(FiguresOrder, Tilts),
    /// A picture for the clipboard has been made; its width and height in pixels.
    Copied(Result<[usize; 2], Failure>),
    /// All that is in sight, to be traced.
    Order(Box<Order>),
}

/// The end of a frame.
#[derive(Debug, Clone, Copy)]
pub struct FrameEnd {
    /// The time, seconds.
    pub now: f64,
    /// Whether a gesture, such as a drag, is going on.
    pub is_gesture: bool,
}

/// The actions of a frame, in the order in which they are done.
#[derive(Debug, Default)]
pub struct Actions(Vec<Action>);

impl Actions {
    /// Adds an action.
    pub fn push(&mut self, action: impl Into<Action>) {
        self.0.push(action.into());
    }

    /// Adds the action that sets a value, where the value is another than before.
    pub fn push_changed<T: PartialEq, A: Into<Action>>(
        &mut self,
        before: &T,
        now: T,
        set: impl FnOnce(T) -> A,
    ) {
        if now != *before {
            self.push(set(now));
        }
    }

    /// Takes all actions, and leaves none.
    pub fn take(&mut self) -> Vec<Action> {
        std::mem::take(&mut self.0)
    }
}

impl From<Command> for Action {
    fn from(command: Command) -> Self {
        Self::Do(command)
    }
}

impl From<Edit> for Action {
    fn from(edit: Edit) -> Self {
        Self::Edit(edit)
    }
}

impl From<ViewAction> for Action {
    fn from(change: ViewAction) -> Self {
        Self::View(change)
    }
}

impl From<FileAction> for Action {
    fn from(change: FileAction) -> Self {
        Self::File(change)
    }
}

impl From<DialogAction> for Action {
    fn from(answer: DialogAction) -> Self {
        Self::Dialog(answer)
    }
}

impl From<NoteAction> for Action {
    fn from(note: NoteAction) -> Self {
        Self::Note(note)
    }
}

impl From<Computed> for Action {
    fn from(computed: Computed) -> Self {
        Self::Computed(computed)
    }
}
