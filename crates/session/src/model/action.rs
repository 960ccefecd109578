//! Actions: everything that a person, or a task that has ended, can do to a model.

use super::choosing::{Choice, Purpose, Question};
use super::command::Command;
use super::cut_search::SearchEvent;
use super::cutting::CuttingProgress;
use super::dialog::{AboutPage, Then};
use super::export::Selection;
use super::exporting::ExportEvent;
use super::eye::Eye;
use super::fitting::{FitOptions, StoneLight, YieldOptions};
use super::goal_form::GoalForm;
use super::measure_map::MapOptions;
use super::measure_tilt::TiltOptions;
use super::meet_pick::MeetPick;
use super::opening::{FileRequest, OpenedFile, OpeningPurpose};
use super::recovery::RecoveredWork;
use super::saving::{SavedDesign, Stamp};
use super::session::{Flowing, HeldKeys};
use super::workspace::PanelSide;
use crate::liquid::Liquid;
use crate::shows::Shows;
use crate::studio::{FiguresOrder, Grade, Order, ShotLight, SweptPoint, Tilts, Which};
use brillianteer_base::Failure;
use brillianteer_cut::{Audit, Cut, Design, MaterialRef, ScaledSide, TierChange};
use brillianteer_files::mesh_options::MeshOptions;
use brillianteer_measure::Figures;
use brillianteer_optics::Metal;
use brillianteer_picture::liquid_glass::LightFrom;
use brillianteer_scene::{Look, Movement, Pose, Ring, RingMetal, RingPlan, Specimen};
use brillianteer_search::Goal;
use glam::DVec2;
use std::path::PathBuf;
use std::sync::Arc;

/// One thing that is done to a model.
#[derive(Debug)]
pub enum Action {
    /// A command of a menu or a key.
    Do(Command),
    /// Changes the work; part of a step of undo.
    Edit(Edit),
    /// Changes how the views look, and the panels beside them.
    View(ViewAction),
    /// Opens or saves a file, or reports the result.
    File(FileAction),
    /// Answers the open dialog, or opens one.
    Dialog(DialogAction),
    /// Controls the search for a better cut.
    Search(SearchAction),
    /// Adds a message that the window shows, or removes one.
    Note(NoteAction),
    /// Hands in a result of the studio or of a task.
    Computed(Computed),
    /// Ends a frame. Without a gesture, the edits since the last such frame become one step of undo.
    Frame(FrameEnd),
}

/// A change of the work, which undo takes back. Each variant holds the new value.
#[derive(Debug)]
pub enum Edit {
    /// The design's name.
    Name(String),
    /// The cut.
    Cut(Cut),
    /// The key of the row that was edited, and the cut with the new proportion.
    Proportion(&'static str, Cut),
    /// Moves the design to these values of the map's axes, across and up, if there is a stone.
    Along([f64; 2]),
    /// Changes one tier of the cut. All others keep their distance in mm.
    Tier {
        /// The place of the tier in [`Cut::settings`].
        place: usize,
        /// The new angle, degrees from the girdle plane.
        angle: f64,
        /// The new distance from the origin, in the unit of the design.
        distance: f64,
    },
    /// A change of the list of tiers.
    Tiers(TierChange),
    /// Scales a side of a cut along the axis, and takes the resulting cut if it makes a stone.
    Scale {
        /// The side.
        side: ScaledSide,
        /// The height of the side afterwards, percent of its height before.
        percent: f64,
        /// The cut before the drag began.
        of: Box<Cut>,
    },
    /// Lists the facets of a cut as tiers.
    IntoTiers,
    /// Cuts the tier at a place to the next corner that it reaches, deeper or farther out, if a meet leads there.
    NextMeet {
        /// The place of the tier in the design's list.
        place: usize,
        /// True to cut the tier deeper; false to move it outward.
        is_deeper: bool,
    },
    /// Adds a tier after the one at a place, beside the stone.
    AddTier(Option<usize>),
    /// The stone's material.
    Material(MaterialRef),
    /// Takes cut, material and notes of a design that was fitted to another material.
    Fitted(Box<Design>),
    /// Sets the diameter by which the design is scaled, in mm.
    Diameter(f64),
    /// What renders are made with.
    Look(Box<Look>),
    /// The pane of liquid glass.
    Liquid(Box<Liquid>),
    /// Sets light, background and head as they were when the document began.
    ResetLight,
    /// Replaces the copies by so many that are scattered anew.
    LayOut(usize),
    /// Sets how plates move in renders.
    Movement(Movement),
    /// Sets the metal and the roughness of bodies, which are given by their places in the scene's list of metal.
    Finish {
        /// The places of the bodies in the file.
        bodies: Vec<usize>,
        /// The metal that they become.
        metal: Metal,
        /// The roughness of the metal, 0 to 1.
        roughness: f64,
    },
    /// Sets the numbers of the scene's ring; its metal and the places of its stones follow.
    Ring(Box<Ring>),
    /// Moves the copy of this number to a pose.
    Copy(usize, Pose),
    /// Moves a stone of another design that stands beside the copies, by its number, to a pose in mm.
    Companion(usize, Pose),
    /// Opens the design of the companion of this number: all stones of its kind become the copies, and the copies
    /// become companions.
    TakeUp(usize),
}

/// A change of how the views look, or of the panels beside them. A `usize` that begins a variant is the number of a
/// view.
///
/// Undo does not touch these. Changes of tilt, zoom, layout and overlay are steps of
/// [`ViewHistory`](super::view_history::ViewHistory).
#[derive(Debug)]
pub enum ViewAction {
    /// What a view shows from now on.
    Show(usize, Shows),
    /// Moves the eye of a view: its own, or that of all linked views.
    Eye(usize, Eye),
    /// Links a view to the eye of the linked views, or gives it a copy of that eye for its own.
    Link(usize, bool),
    /// Shows a view alone, or all views again if it is alone.
    Enlarge(usize),
    /// A view is seen from afar again.
    EndPerspective(usize),
    /// Sets the overlay over all pictures by its name; `None` for none.
    Overlay(Option<String>),
    /// Ends a step of the view history; the next change begins another.
    EndStep,
    /// Sets the progress at the faceting machine.
    Cutting(CuttingProgress),
    /// Selects the tier at a place of the design's list, or none.
    Tier(Option<usize>),
    /// Begins a pick of corners that a tier is cut to, of which some may be picked already; `None` ends the pick.
    PickMeet(Option<MeetPick>),
    /// Selects the finding at a place of the audit's list, or none.
    Finding(Option<usize>),
    /// Sets the choices of the map of a measure.
    Map(MapOptions),
    /// Sets the curves that are plotted against tilt.
    Tilt(TiltOptions),
    /// Says that the pointer is over this view, on which commands act then.
    Hover(usize),
    /// Sets the text of the status line about the thing under the pointer.
    Message(String),
    /// The keys that are held down.
    Keys(HeldKeys),
    /// Sets the distance of the eye in perspective from the origin, girdle radii.
    Distance(f64),
    /// Moves the light of panes of liquid glass, which follows the pointer or time.
    LiquidLight(LightFrom),
    /// Sets the state of the flowing background in a view of a refraction map.
    Flowing(usize, Flowing),
    /// Sets whether zones count the areas of the strongest exits (true) or energy (false).
    ByArea(bool),
    /// Opens or folds a panel; where there is room for only one, the other folds.
    Panel {
        /// The panel.
        side: PanelSide,
        /// Whether the window has room for both panels.
        has_room_for_both: bool,
        /// Whether the panel is open now.
        is_open: bool,
    },
    /// Lets time run for copies and plates by so many seconds.
    Advance(f64),
    /// Stops the motion and returns copies to the pose of the design.
    Rest,
    /// Sets the view in which a copy is dragged and the number of that copy; `None` ends the drag.
    Hold(Option<(usize, usize)>),
    /// Follows the ray through a point of a view's image, girdle radii, and opens the window of the light path.
    Follow(usize, DVec2),
    /// Opens or closes the window of the light path.
    LightPath(bool),
    /// Makes a picture of a view for the clipboard, with so many pixels along its longer side.
    CopyAt(usize, u32),
}

/// Opens or saves a file, or reports the result.
#[derive(Debug)]
pub enum FileAction {
    /// Does something that would lose unsaved work; asks first where there is any.
    Ask(Then),
    /// Opens a file dialog.
    Choose(Purpose),
    /// Hands in the answer of a file dialog.
    Chosen(Question, Choice),
    /// Opens a file; a mesh that is read again is read as before.
    Open(PathBuf, OpeningPurpose),
    /// Does at the start of the program what it was started with; no step of undo leads before it.
    Begin(Then),
    /// Opens the work that was open when the program last ended.
    Restore(Box<RecoveredWork>),
    /// Opens a file with these options for meshes.
    OpenWith(FileRequest),
    /// Hands in a file that has been read.
    Opened(FileRequest, Result<OpenedFile, Failure>),
    /// Reads the open mesh with other options.
    ReadMesh(MeshOptions),
    /// Reports that the design of the document of this number has been saved, or could not be.
    Saved(u64, Result<SavedDesign, Failure>),
    /// Reports that the open file has changed on disk, or is gone.
    OnDisk(PathBuf, Stamp),
    /// Takes the files that were dropped on the window.
    Dropped(Vec<PathBuf>),
    /// Hands in the purpose of each dropped file, found out by its name and content.
    DroppedFor(Vec<(PathBuf, Purpose)>),
    /// Reports that the autosave failed, with the reason.
    NotKept(String),
    /// Offers the autosave files that a crash has left; the newest comes first.
    Found(Vec<RecoveredWork>),
    /// Answers the system's request to close the window.
    Close,
    /// Writes what is still unwritten, because the window is gone.
    Ended,
    /// Opens a folder or a web page by the system.
    OpenOutside(String),
}

/// An answer to the open dialog, or the opening of one.
#[derive(Debug)]
pub enum DialogAction {
    /// Opens the export dialog; with a view, that one alone is selected.
    Export(Option<Shows>),
    /// Closes the dialog without an answer and drops the action that waited for it.
    Leave,
    /// Saves the design, or exports the copies, before going on.
    Keep,
    /// Discards what would be lost, and goes on.
    GiveUp,
    /// Opens the work of the found autosave.
    Recover,
    /// Removes the found autosave.
    Forget,
    /// Reads the file again that another program has changed.
    ReadAgain,
    /// The text of the dialog.
    Type(String),
    /// Takes the typed path as the answer.
    Accept,
    /// The page of the dialog about the program.
    AboutPage(AboutPage),
    /// The text that is searched for among the licences.
    AboutSearch(String),
    /// What is to be exported.
    Select(Selection),
    /// Sets the folder that an export writes to.
    Folder(PathBuf),
    /// Starts the export.
    Write,
    /// Stops the export; complete files stay.
    Stop,
    /// Hands in the progress of the export, or its end.
    Exported(ExportEvent),
    /// Sets the choices of the dialog that fits the design to another material.
    Fit(FitOptions),
    /// Sets the numbers of the dialog of size and yield.
    Size(YieldOptions),
    /// Changes the design as the dialog says.
    Apply,
}

/// An action in the window of the search for a better cut.
#[derive(Debug)]
pub enum SearchAction {
    /// Sets the form with goal, ranges and effort of the search.
    Form(Box<GoalForm>),
    /// Begins the search.
    Start,
    /// Stops the search; the best so far stays.
    Stop,
    /// Stops the search and brings the design back as it was before.
    Discard,
    /// Keeps the design that the search has found, and closes the report.
    Keep,
    /// Restores the design from before the search, and closes the report.
    Undo,
}

/// An action on the messages of the window.
#[derive(Debug)]
pub enum NoteAction {
    /// Shows a note in the status line.
    Say(String),
    /// Adds an error to the bar of messages.
    Trouble(String),
    /// Removes the error or warning of this number.
    Dismiss(usize),
    /// Removes all errors and warnings.
    DismissAll,
    /// Shows (true) or folds (false) the list of all errors and warnings.
    List(bool),
}

/// A result of the studio or of a task.
#[derive(Debug)]
pub enum Computed {
    /// The light of this name or file: first a coarse one where the whole one takes long.
    Light(String, Result<ShotLight, Failure>),
    /// Figures of the present or of the other design, with the order that they answer.
    Figures(Which, FiguresOrder, Grade, Box<Figures>),
    /// Figures against tilt, and the order that they answer.
    Tilts(FiguresOrder, Tilts),
    /// Points of the sweep of this number.
    Swept(u64, Vec<SweptPoint>),
    /// The audit of a stone.
    Audit(Arc<Specimen>, Result<Audit, Failure>),
    /// The light of the stones of this question, in the dialog that fits the design to another material.
    StoneLight(u64, Result<Vec<StoneLight>, Failure>),
    /// The metal of the ring in the document of this number, made by this plan.
    RingMetal(u64, Box<RingPlan>, Result<RingMetal, Failure>),
    /// A goal has been read from a file.
    Goal(PathBuf, Result<Box<Goal>, Failure>),
    /// The goal has been written to a file.
    GoalSaved(PathBuf, Result<(), Failure>),
    /// Progress or the end of the search for a better cut of this number.
    Search(u64, SearchEvent),
    /// The width and height of a picture that is in the clipboard now, pixels.
    Copied(Result<[usize; 2], Failure>),
    /// The order of all that is in sight, which the studio then traces.
    Order(Box<Order>),
}

/// The state of the hands at the end of a frame.
#[derive(Debug, Clone, Copy)]
pub struct FrameEnd {
    /// Seconds since the start of the window.
    pub now: f64,
    /// True while a gesture, such as a drag, is going on.
    pub is_gesture: bool,
}

/// The actions of a frame, in the order in which they are carried out.
#[derive(Debug, Default)]
pub struct Actions(Vec<Action>);

impl Actions {
    /// Adds an action behind those that are there.
    pub fn push(&mut self, action: impl Into<Action>) {
        self.0.push(action.into());
    }

    /// Adds an action if its button was clicked, or its other condition is true.
    pub fn push_if(&mut self, has_happened: bool, action: impl Into<Action>) {
        if has_happened {
            self.push(action);
        }
    }

    /// Adds the action that sets a value, if the value has changed.
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

/// Implements `From` for `Action`, so that actions of each kind become actions by `into`.
macro_rules! into_action {
    ($($kind:ident => $variant:ident),*) => {
        $(impl From<$kind> for Action {
            fn from(action: $kind) -> Self {
                Self::$variant(action)
            }
        })*
    };
}

into_action!(
    Command => Do,
    Edit => Edit,
    ViewAction => View,
    FileAction => File,
    DialogAction => Dialog,
    SearchAction => Search,
    NoteAction => Note,
    Computed => Computed
);
