//! The editor: everything that the window shows and does.

use crate::app::dialogs;
use crate::app::dialogs::{Dialog, Then};
use crate::app::drops;
use crate::app::hands::Hands;
use crate::app::lookup::LookupWorker;
use crate::app::menus;
use crate::app::model::command::Command;
use crate::app::model::compare::Compared;
use crate::app::model::document::{Document, FIRST_LIGHT, Work};
use crate::app::model::framing::Framing;
use crate::app::model::moving::Moving;
use crate::app::model::notes::Notes;
use crate::app::model::opening::{Opening, OpeningPurpose};
use crate::app::model::pose_cache::PoseCache;
use crate::app::model::view_history::ViewHistory;
use crate::app::model::workspace::{PaneLayout, Workspace};
use crate::app::panels::side_panels;
use crate::app::profile_view::ProfileView;
use crate::app::shows::Shows;
use crate::app::state_file::StateFile;
use crate::app::studio::{
    Answer, FiguresOrder, Grade, Order, Paper, Shot, Slot, Studio, TakenPicture, Tilts, Which,
};
use crate::app::tasks::autosave::Autosave;
use crate::app::tasks::copying::Copying;
use crate::app::tasks::export_job::Selection;
use crate::app::tasks::files::{Choice, Chooser, Choosing, Watching, by_dialog};
use crate::app::tasks::opener::{Opener, by_system};
use crate::app::theme;
use crate::app::views::following::{self, Following};
use crate::app::views::probe::Probe;
use crate::app::views::refraction_view::Flowing;
use crate::app::views::stage;
use crate::app::window::PaintedBy;
use crate::io::library;
use crate::io::lighting::{Lighting, LightingError};
use crate::io::mesh_options::MeshOptions;
use crate::measure::Figures;
use crate::scene::Specimen;
use crate::trace::gpu::Gpu;
use eframe::{CreationContext, Storage};
use egui::{Context, TextureHandle, Ui, ViewportCommand};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};

/// What an editor starts with.
pub struct Setup {
    /// A file to open.
    pub file: Option<PathBuf>,
    /// How the file is read where it is a mesh.
    pub mesh: MeshOptions,
    /// The folder of the autosave; `None` for no autosave.
    pub safe: Option<PathBuf>,
    /// What asks the user for files.
    pub chooser: Chooser,
    /// The workspace to begin with where none was kept.
    pub desk: Workspace,
    /// The file that says whether the window is at rest; `None` for no such file.
    pub state_file: Option<StateFile>,
    /// What opens folders and pages outside the program.
    pub opener: Opener,
    /// What paints the window.
    pub painted_by: PaintedBy,
}

impl Default for Setup {
    fn default() -> Self {
        Self {
            file: None,
            mesh: MeshOptions::default(),
            safe: None,
            desk: Workspace::default(),
            chooser: Arc::new(by_dialog),
            opener: Arc::new(by_system),
            painted_by: PaintedBy::default(),
            state_file: None,
        }
    }
}

/// A picture as it is shown, with the shot and the grade that it answers.
pub struct Shown {
    pub(super) texture: TextureHandle,
    pub(super) shot: Shot,
    pub(super) grade: Grade,
    pub(super) taken: TakenPicture,
}

/// Figures as they are shown, with the order and the grade that they answer.
pub struct ShownFigures {
    pub(super) ask: FiguresOrder,
    pub(super) grade: Grade,
    pub(super) figures: Figures,
}

/// The state of the editor's window.
pub struct Editor {
    pub(super) document: Document,
    /// The stone that views are fitted to.
    pub(super) framing: Framing,
    pub(super) desk: Workspace,
    /// What drawings are drawn on: their colours, light or dark as the window is.
    pub(super) paper: Paper,
    pub(super) looks: ViewHistory,
    pub(super) studio: Studio,
    pub(super) pictures: HashMap<Slot, Shown>,
    /// The worker that looks pictures up.
    pub(super) looker: LookupWorker,
    /// The pictures that were looked up.
    pub(super) looked: HashMap<Slot, Shown>,
    /// How the background moves in each view of a refraction map.
    pub(super) flowing: [Flowing; 4],
    pub(super) figures: HashMap<Which, ShownFigures>,
    pub(super) tilts: Option<(FiguresOrder, Tilts)>,
    pub(super) compared: Option<Compared>,
    pub(super) probe: Option<Probe>,
    pub(super) profiles: [ProfileView; 4],
    pub(super) following: Following,
    /// The motion of copies and plates in time.
    pub(super) moving: Moving,
    /// The view in which a copy is dragged, and the number of that copy.
    pub(super) held: Option<(usize, usize)>,
    /// Whether a picture has the focus, so that Space lays out the copies in it.
    pub(super) is_picture_focused: bool,
    /// The key of the proportion that was last edited in the panel.
    pub(super) edited: Option<&'static str>,
    /// How often copies were laid out; this seeds the next layout.
    pub(super) layings: u64,
    /// The text of the status line while the pointer is over a picture.
    pub(super) message: String,
    pub(super) notes: Notes,
    pub(super) dialog: Option<Dialog>,
    /// What was last selected for export.
    pub(super) selection: Selection,
    /// The view under the pointer, or the last one that was.
    pub(super) hovered: usize,
    /// The last order, to know whether what is shown is what was ordered.
    pub(super) asked: Order,
    pub(super) light: (String, Arc<Lighting>),
    pub(super) loading: Option<(String, Receiver<Result<Lighting, LightingError>>)>,
    pub(super) posed: PoseCache,
    pub(super) chooser: Chooser,
    pub(super) opener: Opener,
    /// A picture for the clipboard that is being made.
    pub(super) copying: Option<Copying>,
    pub(super) choosing: Option<Choosing>,
    pub(super) opening: Vec<Opening>,
    /// How many documents were begun. It numbers the present one, so that no answer for another is taken for it.
    pub(super) begun: u64,
    /// The action that waits until the design is saved.
    pub(super) after_save: Option<Then>,
    /// The work as it was when [`take_note`](Self::take_note) was last called.
    pub(super) kept: Work,
    watching: Watching,
    pub(super) safe: Option<Autosave>,
    /// Whether the window may close without another question.
    pub(super) may_close: bool,
    /// Whether renders show three bands of wavelengths alone, as long as a key is down.
    pub(super) shows_three: bool,
    title: String,
    state_file: Option<StateFile>,
    /// What paints the window.
    pub(super) painted_by: PaintedBy,
}

/// The key under which the workspace is kept between starts.
const DESK: &str = "desk";

impl Editor {
    /// Opens the editor in a window of eframe's; see [`within`](Self::within).
    ///
    /// # Errors
    /// As for [`within`](Self::within).
    pub fn new(context: &CreationContext<'_>, setup: Setup) -> Result<Self, String> {
        Self::within(&context.egui_ctx, context.storage, shared(context), setup)
    }

    /// Opens the editor as it was left, by what `storage` holds; `gpu` is a card that pictures may be computed on.
    ///
    /// # Errors
    /// Fails only where the program itself is broken: it comes with the cut and the light that it starts with.
    pub fn within(
        context: &Context,
        storage: Option<&dyn Storage>,
        gpu: Option<Arc<Gpu>>,
        setup: Setup,
    ) -> Result<Self, String> {
        theme::apply(context);
        context.add_plugin(Hands::default());
        let kept = storage.and_then(|s| s.get_string(DESK));
        // A workspace of a later program that this one cannot read is ignored.
        let mut desk: Workspace =
            kept.and_then(|text| serde_json::from_str(&text).ok()).unwrap_or(setup.desk);
        let wake = waker(context);
        let mut document = Document::first()?;
        let first = Lighting::load(FIRST_LIGHT).map_err(|e| e.to_string())?;
        let light = (FIRST_LIGHT.to_owned(), Arc::new(first));
        desk.face_up();
        desk.rest();
        document.begin(&desk.light, desk.exposure, desk.head);
        let kept = document.work.clone();
        let watch = wake.clone();
        let mut editor = Self {
            looker: LookupWorker::open(wake.clone()),
            looked: HashMap::new(),
            flowing: Default::default(),
            studio: Studio::open(gpu, wake),
            framing: Framing::new(document.specimen()),
            document,
            looks: ViewHistory::new(&desk),
            paper: Paper::default(),
            desk,
            pictures: HashMap::new(),
            figures: HashMap::new(),
            tilts: None,
            compared: None,
            probe: None,
            profiles: Default::default(),
            following: Following::default(),
            moving: Moving::default(),
            held: None,
            is_picture_focused: false,
            edited: None,
            layings: 0,
            message: String::new(),
            notes: Notes::default(),
            dialog: None,
            selection: Selection::default(),
            hovered: 0,
            light,
            asked: Order::default(),
            loading: None,
            posed: PoseCache::default(),
            chooser: setup.chooser,
            opener: setup.opener,
            copying: None,
            choosing: None,
            begun: 0,
            opening: vec![],
            after_save: None,
            kept,
            watching: Watching::begin(move || watch()),
            safe: setup.safe.map(Autosave::new),
            may_close: false,
            shows_three: false,
            title: String::new(),
            state_file: setup.state_file,
            painted_by: setup.painted_by,
        };
        let named = |path: &Path| library::cut(&path.to_string_lossy()).filter(|_| !path.is_file()).is_some();
        match setup.file.or_else(|| editor.desk.last.clone().filter(|p| p.exists())) {
            Some(path) if !path.is_file() && library::scene(&path.to_string_lossy()).is_some() => {
                editor.begin_preset(&path.to_string_lossy().to_lowercase());
            }
            Some(path) if named(&path) => editor.begin_from_library(&path.to_string_lossy()),
            Some(path) => editor.open_with(&path, OpeningPurpose::Anew, setup.mesh),
            None => {}
        }
        editor.offer_recovery();
        Ok(editor)
    }

    fn offer_recovery(&mut self) {
        let found = self.safe.as_ref().map_or_else(Vec::new, Autosave::found);
        if let Some(first) = found.into_iter().next() {
            self.dialog = Some(Dialog::Recover(Box::new(first)));
        }
    }

    /// Returns the present stone, turned about its axis by `turn`, radians.
    pub(super) fn posed(&mut self, turn: f64) -> Arc<Specimen> {
        self.posed.of(self.document.specimen(), turn)
    }

    /// Returns the probe that answers questions about a stone.
    pub(super) fn probe(&mut self, specimen: &Arc<Specimen>) -> &Probe {
        let known = self.probe.take().filter(|p| p.is_about(specimen));
        self.probe.insert(known.unwrap_or_else(|| Probe::new(Arc::clone(specimen))))
    }

    /// Returns the chosen light; the last one until that is loaded, and where it cannot be loaded.
    pub(super) fn light(&mut self) -> Arc<Lighting> {
        let wanted = &self.document.work.light;
        let is_loading = self.loading.as_ref().is_some_and(|(name, _)| name == wanted);
        if self.light.0 != *wanted && !is_loading {
            let (sender, answer) = channel();
            let (name, wake) = (wanted.clone(), self.studio.wake());
            std::thread::spawn(move || {
                // Nobody waits for the answer any more where another light was chosen.
                let _ = sender.send(Lighting::load(&name));
                wake();
            });
            self.loading = Some((wanted.clone(), answer));
        }
        Arc::clone(&self.light.1)
    }

    fn take_in_light(&mut self) {
        let Some((name, Ok(loaded))) = self.loading.as_ref().map(|(n, a)| (n.clone(), a.try_recv())) else {
            return;
        };
        self.loading = None;
        let lighting = match loaded {
            Ok(lighting) => {
                lighting.warnings.iter().for_each(|w| self.notes.say(w));
                Arc::new(lighting)
            }
            Err(why) => {
                self.notes.trouble(format!("{why}; the light stays as it was"));
                Arc::clone(&self.light.1)
            }
        };
        self.light = (name, lighting);
    }

    /// Takes in what has arrived from other threads and from outside: pictures, figures, lights, files, changes on disk.
    fn take_in(&mut self, ctx: &Context) {
        let answers: Vec<Answer> = self.studio.answers().collect();
        for answer in answers {
            match answer {
                Answer::Picture(slot, shot, grade, taken) => {
                    hang(ctx, &mut self.pictures, slot, (*shot, grade, taken));
                }
                Answer::Figures(which, ask, grade, figures) => {
                    self.figures.insert(which, ShownFigures { ask, grade, figures: *figures });
                }
                Answer::Tilts(ask, tilts) => self.tilts = Some((ask, tilts)),
                Answer::Trouble(why) => self.notes.trouble(why),
            }
        }
        self.take_in_looked(ctx);
        self.take_in_light();
        self.take_in_files();
        if let Some((purpose, document, answer)) =
            self.choosing.as_ref().and_then(|c| Some((c.purpose, c.document, c.answer()?)))
        {
            self.choosing = None;
            match answer {
                Choice::File(path) => self.chosen(purpose, document, path),
                // The export dialog has its own field for the folder.
                Choice::NoDialog if self.dialog.is_none() => self.ask_path(purpose),
                Choice::NoDialog | Choice::GivenUp => self.after_save = None,
            }
        }
        self.watching.watch(self.document.path());
        if self.dialog.is_none() && self.watching.has_changed() && self.document.is_changed_outside() {
            self.changed_outside();
        }
        let dropped: Vec<PathBuf> =
            ctx.input(|i| i.raw.dropped_files.iter().map(|file| file.path().to_owned()).collect());
        if !dropped.is_empty() {
            self.dropped(&dropped);
        }
        self.take_in_copy(ctx);
    }

    fn take_in_looked(&mut self, ctx: &Context) {
        let answers: Vec<_> = self.looker.answers().collect();
        for (slot, ask, taken) in answers {
            match taken {
                Ok(taken) => hang(ctx, &mut self.looked, slot, (ask.shot, ask.grade, taken)),
                Err(why) => self.notes.trouble(why),
            }
        }
    }

    /// Returns the picture of a view: looked up where the view shows such a picture, else traced.
    pub(super) fn shown(&self, slot: Slot) -> Option<&Shown> {
        let shows = self.desk.panes[slot.0].shows;
        let is_looked_up =
            shows == Shows::LiquidGlass || (shows == Shows::Refraction && !self.flowing[slot.0].is_map);
        if is_looked_up {
            return self.looked.get(&slot).filter(|shown| shown.shot.shows == shows);
        }
        self.pictures.get(&slot)
    }

    /// Returns the view that keys act on: the one under the pointer or with the focus, or else the first.
    pub(super) fn active(&self) -> usize {
        let shown = self.desk.shown();
        if shown.contains(&self.hovered) { self.hovered } else { shown[0] }
    }

    /// Whether a command is switched on, as menus show it.
    pub(super) fn is_chosen(&self, command: Command) -> bool {
        let overlay = |name| self.desk.overlay.as_deref() == Some(name);
        let eye = self.desk.eye(self.active());
        match command {
            Command::One => self.desk.layout == PaneLayout::One,
            Command::Two => self.desk.layout == PaneLayout::Two,
            Command::Four => self.desk.layout == PaneLayout::Four,
            Command::Perspective => self.desk.panes[self.active()].is_near,
            Command::EyeLeans => eye.eye_leans,
            Command::Wireframe => overlay("wireframe"),
            Command::Facets => overlay("facets"),
            Command::Bounces => overlay("bounces"),
            Command::Unresolved => overlay("unresolved"),
            Command::Total => overlay("total"),
            Command::Strongest => self.desk.strongest,
            Command::Glare => self.desk.glare,
            Command::Split => self.desk.is_split,
            Command::LightPath => self.following.is_open,
            Command::Play => self.moving.is_on,
            Command::Panels => self.desk.hides_panels,
            _ => false,
        }
    }

    /// Opens a folder or a page outside the program.
    pub(super) fn open_outside(&mut self, what: &str) {
        if let Err(why) = (self.opener)(what) {
            self.notes.trouble(why);
        }
    }

    fn close(&mut self, ctx: &Context) {
        if !ctx.input(|i| i.viewport().close_requested()) {
            if self.may_close {
                ctx.send_viewport_cmd(ViewportCommand::Close);
            }
        } else if self.dialog.as_ref().is_some_and(Dialog::insists) {
            ctx.send_viewport_cmd(ViewportCommand::CancelClose);
            self.notes.say("Answer what is asked first, or stop the export.");
        } else if !self.may_close && self.document.is_changed() {
            ctx.send_viewport_cmd(ViewportCommand::CancelClose);
            self.dialog = Some(Dialog::Unsaved(Then::Close));
        } else if !self.may_close && self.document.has_moved_copies() {
            ctx.send_viewport_cmd(ViewportCommand::CancelClose);
            self.dialog = Some(Dialog::Moved(Then::Close));
        }
    }

    fn name_window(&mut self, ctx: &Context) {
        let mark = if self.document.is_changed() { " •" } else { "" };
        let title = format!("{}{mark} — Brillianteer", self.document.title());
        if title != self.title {
            ctx.send_viewport_cmd(ViewportCommand::Title(title.clone()));
            self.title = title;
        }
    }

    /// Whether all pictures and figures are as good as they get, and nothing is under way.
    pub(super) fn is_idle(&self) -> bool {
        self.studio.is_idle()
            && self.looker.is_idle()
            && self.choosing.is_none()
            && self.loading.is_none()
            && self.opening.is_empty()
    }

    /// Draws the window, and carries out what the user does in it.
    pub(super) fn show(&mut self, ui: &mut Ui) {
        let ctx = ui.ctx().clone();
        self.take_in(&ctx);
        menus::keys(self, &ctx);
        self.shows_three = menus::are_three_shown(&ctx);
        self.paper = theme::paper(&ctx);
        menus::bar(self, ui);
        menus::status(self, ui);
        if !self.desk.hides_panels {
            side_panels::show(self, ui);
        }
        self.is_picture_focused = false;
        let seen = stage::show(self, ui);
        following::show(self, &ctx);
        dialogs::show(self, &ctx);
        drops::invite(&ctx);
        self.document.update();
        if seen.iter().any(|(pane, _)| self.desk.panes[*pane].shows.has_company()) {
            self.moving.advance(&ctx);
        }
        let pulled = self.profiles.iter().any(ProfileView::is_dragging);
        let gesture = pulled || ctx.egui_is_using_pointer() || ctx.text_edit_focused();
        if !gesture && self.framing.settle(self.document.specimen()) {
            // The views of this frame were laid out for the stone as it was fitted before.
            ctx.request_repaint();
        }
        self.order(&seen);
        if !gesture {
            self.settle(ctx.input(|i| i.time));
        }
        self.name_window(&ctx);
        self.close(&ctx);
        self.publish_state(&ctx);
    }

    /// Writes to the state file whether the window is at rest, for a test that waits for that.
    fn publish_state(&mut self, ctx: &Context) {
        let is_quiet = self.is_idle() && !self.studio.sharpens();
        if self.state_file.as_mut().is_some_and(|file| file.note(is_quiet, self.desk.layout)) {
            ctx.request_repaint();
        }
    }
}

/// Replaces the picture in a slot.
fn hang(
    ctx: &Context,
    pictures: &mut HashMap<Slot, Shown>,
    slot: Slot,
    (shot, grade, taken): (Shot, Grade, TakenPicture),
) {
    let image = taken.image.clone();
    let options = egui::TextureOptions::LINEAR;
    let texture = match pictures.remove(&slot) {
        Some(mut shown) => {
            shown.texture.set(image, options);
            shown.texture
        }
        None => ctx.load_texture(format!("{slot:?}"), image, options),
    };
    pictures.insert(slot, Shown { texture, shot, grade, taken });
}

fn waker(ctx: &Context) -> crate::app::studio::Wake {
    let ctx = ctx.clone();
    Arc::new(move || ctx.request_repaint())
}

/// Returns the card that draws the window, if it computes.
fn shared(context: &CreationContext<'_>) -> Option<Arc<Gpu>> {
    let state = context.wgpu_render_state.as_ref()?;
    Gpu::of(state.device.clone(), state.queue.clone(), &state.adapter.get_info()).ok().map(Arc::new)
}

impl eframe::App for Editor {
    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        self.show(ui);
    }

    fn save(&mut self, storage: &mut dyn eframe::Storage) {
        if let Ok(text) = serde_json::to_string(&self.desk) {
            storage.set_string(DESK, text);
        }
    }

    fn on_exit(&mut self) {
        // Where the system took the window away without asking the user, the work is kept for the next start.
        let is_safe = !self.document.is_changed() && !self.document.has_moved_copies();
        if self.may_close || is_safe {
            self.forget_unsaved();
        }
    }
}
