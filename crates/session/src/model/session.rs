//! The part of the state that ends with the window.

use super::audit::SessionAudit;
use super::choosing::Purpose;
use super::compare::Compared;
use super::cut_search::CutSearch;
use super::dialog::{Dialog, Then};
use super::document::Document;
use super::export::Selection;
use super::figures::SessionFigures;
use super::framing::Framing;
use super::measure_map::MeasureMap;
use super::measure_tilt::MeasureTilt;
use super::meet_pick::MeetPick;
use super::motion::Motion;
use super::notes::Notes;
use super::opening::Opening;
use super::recovery::RecoveredWork;
use super::saving::Stamp;
use super::view_history::ViewHistory;
use super::work::Work;
use super::workspace::Workspace;
use crate::studio::{Order, ShotLight};
use brillianteer_base::Failure;
use brillianteer_paper::lighting;
use brillianteer_picture::liquid_glass::LightFrom;
use brillianteer_scene::RingPlan;
use brillianteer_scene::USUAL_LIGHT;
use glam::DVec2;
use std::path::PathBuf;

/// The light of renders, and the light that is being loaded.
#[derive(Debug, Clone)]
pub struct LoadedLight {
    /// The name of the light that renders show, or its file.
    pub name: String,
    /// The light that pictures are made under.
    pub at_hand: ShotLight,
    /// The light that the program last tried to load. Where loading failed, `name` is still the one before.
    pub tried: String,
    /// The name of the light that is being loaded.
    pub loading: Option<String>,
}

/// The ray that is followed through the stone.
#[derive(Debug, Clone, Copy, Default)]
pub struct FollowedRay {
    /// True while the window of the light path is open.
    pub is_open: bool,
    /// The view that was clicked, and the point of its image, girdle radii.
    pub at: Option<(usize, DVec2)>,
}

/// The state of the background in a view of a refraction map.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Flowing {
    /// The distance by which the background has been moved to the right and down, in parts of the map's plane.
    pub moved: DVec2,
    /// True while the background moves by itself.
    pub flows: bool,
    /// True where the view shows the map itself.
    pub is_map: bool,
}

/// The keys that change what views show while they are held.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct HeldKeys {
    /// True while the other design of a comparison is shown in place of the present one.
    pub other: bool,
    /// True while renders show only three bands of wavelengths.
    pub three: bool,
}

/// The answers of tasks that the session waits for.
#[derive(Debug, Clone, Default)]
pub struct Awaited {
    /// The purpose of the file that the user is choosing.
    pub choosing: Option<Purpose>,
    /// The files that are being opened.
    pub opening: Vec<Opening>,
    /// The number of the document that is being saved.
    pub saving: Option<u64>,
    /// True while the purposes of dropped files are being found out.
    pub dropped: bool,
    /// The key of the view whose picture is being made for the clipboard.
    pub copying: Option<&'static str>,
}

/// The state of the metal of the scene's ring.
#[derive(Debug, Clone, Default)]
pub struct RingMaking {
    /// The plan by which metal is being made.
    pub asked: Option<RingPlan>,
    /// The last plan by which no metal could be made, and the reason.
    pub refused: Option<(RingPlan, String)>,
}

/// The state of the autosave.
#[derive(Debug, Clone)]
pub struct SafeWork {
    /// True where the editor keeps an autosave at all.
    pub is_on: bool,
    /// True if an autosave file was ordered since the work was last saved.
    pub is_kept: bool,
    /// The work of the last comparison for the autosave.
    pub noted: Work,
    /// The autosave file of a crash that this work went on from; it is removed once the work is kept, saved or discarded.
    pub replaces: Option<PathBuf>,
    /// The work that was last kept for the next start, with its saved design.
    pub last: Option<Work>,
    /// The work of the last run, whose file is being opened.
    pub restoring: Option<Box<RecoveredWork>>,
}

/// Everything that ends with the window.
#[derive(Debug, Clone)]
pub struct Session {
    /// The stone that views are fitted to.
    pub framing: Framing,
    /// The history of tilts, zooms, layouts and overlays.
    pub views: ViewHistory,
    /// The light, and the one that is being loaded.
    pub light: LoadedLight,
    /// The design that the present one is compared with.
    pub compared: Option<Compared>,
    /// The figures that have been measured.
    pub measured: SessionFigures,
    /// The pictures and figures that were last ordered.
    pub ordered: Order,
    /// The ray that is followed.
    pub followed: FollowedRay,
    /// The motion of copies and plates in time.
    pub motion: Motion,
    /// The motion of the background in each view of a refraction map.
    pub flowing: [Flowing; 4],
    /// The direction of the light of a pane of liquid glass, where it follows the pointer or time.
    pub liquid_light: Option<LightFrom>,
    /// The view in which a copy is dragged, and the number of that copy.
    pub held: Option<(usize, usize)>,
    /// The key of the proportion that was last edited in the panel.
    pub edited: Option<&'static str>,
    /// The place of the tier that is selected in the design's list.
    pub tier: Option<usize>,
    /// The tier whose meet is being picked in a view, and the corners that have been picked.
    pub picking: Option<MeetPick>,
    /// The reason why the meet of each tier could not be followed after the last change; `None` where it was.
    pub meet_faults: Vec<Option<String>>,
    /// The metal of a ring that is being made.
    pub ring: RingMaking,
    /// The audit of the stone, while its list is open.
    pub audit: SessionAudit,
    /// The map of a measure, while it is open.
    pub map: MeasureMap,
    /// The measure that is plotted against tilt.
    pub tilt: MeasureTilt,
    /// The search for a better cut.
    pub search: CutSearch,
    /// The number of sweeps begun so far; each takes the next as its own number.
    pub sweeps: u64,
    /// The number of layouts of copies so far; it seeds the next layout.
    pub layings: u64,
    /// The number of lights chosen at random so far; it seeds the next choice.
    pub lights_drawn: u64,
    /// The text of the status line while the pointer is over a picture.
    pub message: String,
    /// What the status line says.
    pub notes: Notes,
    /// The dialog in sight.
    pub dialog: Option<Dialog>,
    /// The last selection in the export dialog.
    pub selection: Selection,
    /// The view under the pointer, or the one that was under it last.
    pub hovered: usize,
    /// The keys that are held down.
    pub keys: HeldKeys,
    /// What tasks have been asked for and not answered.
    pub awaited: Awaited,
    /// The number of documents begun so far. The present document has it as its number, so that no answer for another
    /// is taken for it.
    pub begun: u64,
    /// The action that waits until the design is saved.
    pub after_save: Option<Then>,
    /// What is known of unsaved work that is kept.
    pub safe: SafeWork,
    /// The stamp of the open file as last seen on disk, where it differs from that of the document.
    pub on_disk: Option<Stamp>,
    /// The file that is watched for changes by other programs.
    pub watched: Option<PathBuf>,
    /// True once the window may close without another question.
    pub may_close: bool,
}

impl Session {
    /// Begins with a document and a workspace.
    ///
    /// # Errors
    /// Fails only where the program itself is broken: it comes with the light that it starts with.
    pub fn new(document: &Document, workspace: &Workspace) -> Result<Self, Failure> {
        let first = lighting::load(USUAL_LIGHT)?;
        Ok(Self {
            framing: Framing::of(document),
            views: ViewHistory::new(workspace),
            light: LoadedLight {
                name: USUAL_LIGHT.to_owned(),
                at_hand: ShotLight::whole(first),
                tried: USUAL_LIGHT.to_owned(),
                loading: None,
            },
            compared: None,
            measured: SessionFigures::default(),
            ordered: Order::default(),
            followed: FollowedRay::default(),
            motion: Motion::default(),
            flowing: Default::default(),
            liquid_light: None,
            held: None,
            edited: None,
            tier: None,
            picking: None,
            meet_faults: vec![],
            ring: RingMaking::default(),
            audit: SessionAudit::default(),
            map: MeasureMap::default(),
            tilt: MeasureTilt::default(),
            search: CutSearch::default(),
            sweeps: 0,
            layings: 0,
            lights_drawn: 0,
            message: String::new(),
            notes: Notes::default(),
            dialog: None,
            selection: Selection::default(),
            hovered: 0,
            keys: HeldKeys::default(),
            awaited: Awaited::default(),
            begun: 0,
            after_save: None,
            safe: SafeWork {
                is_on: false,
                is_kept: false,
                noted: document.work.clone(),
                replaces: None,
                last: None,
                restoring: None,
            },
            on_disk: None,
            watched: None,
            may_close: false,
        })
    }
}
