//! The editor: everything that the window shows and does.

use super::command::Command;
use super::compare::Compared;
use super::desk::{Desk, Layout};
use super::dialogs::{Dialog, Then};
use super::document::Document;
use super::files::{Chooser, Choosing, Purpose, Question, Safe, Watching, by_dialog};
use super::following::{self, Following};
use super::notes::Notes;
use super::probe::Probe;
use super::profile_view::ProfileView;
use super::shows::Shows;
use super::studio::{Answer, Ask, Grade, Order, Shot, Slot, Studio, Taken, Tilts, Which};
use super::{design_panel, dialogs, figures_panel, menus, stage, theme};
use crate::io::lighting::Lighting;
use crate::measure::Figures;
use crate::scene::{Side, Specimen};
use crate::trace::gpu::Gpu;
use eframe::CreationContext;
use egui::{Context, TextureHandle, Ui, ViewportCommand};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// What an editor starts with.
pub struct Setup {
    /// A file to open.
    pub file: Option<PathBuf>,
    /// Where unsaved work is kept; none to keep none.
    pub safe: Option<PathBuf>,
    /// Who is asked for files.
    pub chooser: Chooser,
    /// How the window is arranged where nothing was kept.
    pub desk: Desk,
    /// Whether the card may compute, where there is one.
    pub may_compute: bool,
}

impl Default for Setup {
    fn default() -> Self {
        Self {
            file: None,
            safe: None,
            desk: Desk::default(),
            chooser: Arc::new(by_dialog),
            may_compute: true,
        }
    }
}

/// A picture as it is shown.
pub struct Shown {
    pub(super) texture: TextureHandle,
    pub(super) shot: Shot,
    pub(super) grade: Grade,
    pub(super) taken: Taken,
}

/// Figures as they are shown.
pub struct Measured {
    pub(super) ask: Ask,
    pub(super) grade: Grade,
    pub(super) figures: Figures,
}

/// The window.
pub struct Editor {
    pub(super) document: Document,
    pub(super) desk: Desk,
    pub(super) studio: Studio,
    pub(super) pictures: HashMap<Slot, Shown>,
    pub(super) figures: HashMap<Which, Measured>,
    pub(super) tilts: Option<(Ask, Tilts)>,
    pub(super) compared: Option<Compared>,
    pub(super) probe: Option<Probe>,
    pub(super) profiles: [ProfileView; 4],
    pub(super) following: Following,
    /// What is said in the line at the bottom while the pointer is over a picture.
    pub(super) told: String,
    pub(super) notes: Notes,
    pub(super) dialog: Option<Dialog>,
    /// The pane under the pointer, or the last that was.
    pub(super) hovered: usize,
    light: (String, Arc<Lighting>),
    posed: (Arc<Specimen>, f64, Arc<Specimen>),
    chooser: Chooser,
    choosing: Option<Choosing>,
    watching: Watching,
    safe: Option<Safe>,
    /// Whether the window may close without another question.
    may_close: bool,
    title: String,
}

/// Where a desk is kept between starts.
const DESK: &str = "desk";

impl Editor {
    /// Opens the window's content.
    ///
    /// # Errors
    /// Only where the program itself is broken: it comes with the cut and the light that it starts with.
    pub fn new(context: &CreationContext<'_>, setup: Setup) -> Result<Self, String> {
        theme::apply(&context.egui_ctx);
        let kept = context.storage.and_then(|s| s.get_string(DESK));
        // A desk of a later program that this one cannot read is left aside.
        let mut desk: Desk = kept.and_then(|text| serde_json::from_str(&text).ok()).unwrap_or(setup.desk);
        let wake = waker(&context.egui_ctx);
        let gpu = if setup.may_compute { shared(context) } else { None };
        let mut notes = Notes::default();
        let mut document = Document::first()?;
        let lighting = Lighting::load(&desk.light).or_else(|_| {
            desk.light = super::document::FIRST_LIGHT.to_owned();
            Lighting::load(&desk.light)
        });
        let light = (desk.light.clone(), Arc::new(lighting.map_err(|e| e.to_string())?));
        if let Some(path) = setup.file.clone().or_else(|| desk.last.clone().filter(|p| p.exists())) {
            match Document::open(&path) {
                Ok(opened) => {
                    document = opened;
                    desk.remember(&path);
                }
                Err(why) => notes.trouble(why),
            }
        }
        document.begin(&desk.light, desk.exposure);
        let specimen = Arc::clone(document.specimen());
        let watch = wake.clone();
        let mut editor = Self {
            studio: Studio::open(gpu, wake),
            document,
            desk,
            pictures: HashMap::new(),
            figures: HashMap::new(),
            tilts: None,
            compared: None,
            probe: None,
            profiles: Default::default(),
            following: Following::default(),
            told: String::new(),
            notes,
            dialog: None,
            hovered: 0,
            light,
            posed: (Arc::clone(&specimen), 0.0, specimen),
            chooser: setup.chooser,
            choosing: None,
            watching: Watching::begin(move || watch()),
            safe: setup.safe.map(Safe::new),
            may_close: false,
            title: String::new(),
        };
        editor.offer_recovery();
        Ok(editor)
    }

    fn offer_recovery(&mut self) {
        let found = self.safe.as_ref().map_or_else(Vec::new, Safe::found);
        if let Some(first) = found.into_iter().next() {
            self.dialog = Some(Dialog::Recover(first));
        }
    }

    /// The stone that is worked on, turned as it is seen.
    pub(super) fn posed(&mut self, turn: f64) -> Arc<Specimen> {
        let specimen = self.document.specimen();
        let (of, at, posed) = &self.posed;
        if Arc::ptr_eq(of, specimen) && *at == turn {
            return Arc::clone(posed);
        }
        let posed = turned(specimen, turn);
        self.posed = (Arc::clone(specimen), turn, Arc::clone(&posed));
        posed
    }

    /// What answers questions about a stone.
    pub(super) fn probe(&mut self, specimen: &Arc<Specimen>) -> &Probe {
        let known = self.probe.take().filter(|p| p.is_about(specimen));
        self.probe.insert(known.unwrap_or_else(|| Probe::new(Arc::clone(specimen))))
    }

    /// The light that is chosen; the last one where that cannot be had, with a word on why.
    pub(super) fn light(&mut self) -> Arc<Lighting> {
        let wanted = self.document.work.light.clone();
        if self.light.0 != wanted {
            let lighting = match Lighting::load(&wanted) {
                Ok(lighting) => {
                    lighting.warnings.iter().for_each(|w| self.notes.say(w));
                    Arc::new(lighting)
                }
                Err(why) => {
                    self.notes.trouble(why.to_string());
                    Arc::clone(&self.light.1)
                }
            };
            self.light = (wanted, lighting);
        }
        Arc::clone(&self.light.1)
    }

    /// What takes note of what has come in from elsewhere.
    fn take_in(&mut self, ctx: &Context) {
        let answers: Vec<Answer> = self.studio.answers().collect();
        for answer in answers {
            match answer {
                Answer::Picture(slot, shot, grade, taken) => {
                    self.show_picture(ctx, slot, *shot, grade, taken)
                }
                Answer::Figures(which, ask, grade, figures) => {
                    self.figures.insert(which, Measured { ask, grade, figures: *figures });
                }
                Answer::Tilts(ask, tilts) => self.tilts = Some((ask, tilts)),
                Answer::Trouble(why) => self.notes.trouble(why),
            }
        }
        if let Some((purpose, answer)) = self.choosing.as_ref().and_then(|c| Some((c.purpose, c.answer()?))) {
            self.choosing = None;
            if let Some(path) = answer {
                self.chosen(purpose, path);
            }
        }
        self.watching.watch(self.document.path());
        if self.document.is_changed_outside() && self.dialog.is_none() {
            self.changed_outside();
        }
        let dropped = ctx.input(|i| i.raw.dropped_files.clone());
        if let Some(file) = dropped.first() {
            self.ask_before(Then::Open(file.path().to_owned()));
        }
    }

    fn show_picture(&mut self, ctx: &Context, slot: Slot, shot: Shot, grade: Grade, taken: Taken) {
        let image = taken.image.clone();
        let options = egui::TextureOptions::LINEAR;
        let texture = match self.pictures.remove(&slot) {
            Some(mut shown) => {
                shown.texture.set(image, options);
                shown.texture
            }
            None => ctx.load_texture(format!("{slot:?}"), image, options),
        };
        self.pictures.insert(slot, Shown { texture, shot, grade, taken });
    }

    fn changed_outside(&mut self) {
        self.document.accept_outside();
        if self.document.is_changed() {
            self.dialog = Some(Dialog::ChangedOutside);
        } else if let Some(path) = self.document.path().map(Path::to_owned).filter(|p| p.exists()) {
            // Nothing of one's own is lost: the new file is what is wanted.
            self.open(&path);
            self.notes.say("The file was changed by another program and has been read again.");
        } else {
            self.notes.trouble("The file is no longer there; save the design to keep it.".into());
        }
    }

    /// Opens a file in place of what is open.
    pub(super) fn open(&mut self, path: &Path) {
        match Document::open(path) {
            Ok(document) => {
                self.desk.remember(path);
                self.begin(document);
            }
            Err(why) => self.notes.trouble(why),
        }
    }

    /// Works on another document, under the light that was chosen.
    pub(super) fn begin(&mut self, mut document: Document) {
        let work = &self.document.work;
        document.begin(&work.light, work.exposure);
        self.document = document;
        self.notes.clear();
        let warnings = self.document.specimen().warnings.clone();
        warnings.iter().for_each(|w| self.notes.say(w));
        self.forget_unsaved();
    }

    /// Does something that would lose unsaved work, after a question where there is any.
    pub(super) fn ask_before(&mut self, then: Then) {
        if self.document.is_changed() {
            self.dialog = Some(Dialog::Unsaved(then));
        } else {
            self.then(then);
        }
    }

    /// Does what was put off by a question.
    pub(super) fn then(&mut self, then: Then) {
        match then {
            Then::Open(path) => self.open(&path),
            Then::OpenAsked => self.choose(Purpose::Open),
            Then::Library(name) => match Document::of_library(&name) {
                Ok(document) => {
                    self.desk.last = None;
                    self.begin(document);
                }
                Err(why) => self.notes.trouble(why),
            },
            Then::Close => self.may_close = true,
        }
    }

    /// Asks for a file.
    pub(super) fn choose(&mut self, purpose: Purpose) {
        let name = self.document.path().and_then(Path::file_name).map_or_else(
            || format!("{}.toml", self.document.work.design.name.to_lowercase().replace([' ', '/'], "-")),
            |n| n.to_string_lossy().into_owned(),
        );
        let wake = self.studio.wake();
        self.choosing = Some(Choosing::ask(Question { purpose, name }, &self.chooser, move || wake()));
    }

    fn chosen(&mut self, purpose: Purpose, path: PathBuf) {
        match purpose {
            Purpose::Open => self.ask_before(Then::Open(path)),
            Purpose::SaveAs => {
                self.save_as(path);
            }
            Purpose::Compare => match Compared::of_file(&path) {
                Ok(compared) => self.compared = Some(compared),
                Err(why) => self.notes.trouble(why),
            },
            Purpose::Light => self.document.work.light = path.display().to_string(),
            Purpose::Folder => {
                if let Some(Dialog::Export(export)) = &mut self.dialog {
                    export.folder = path;
                }
            }
        }
    }

    /// Saves; asks where if that is not known yet. Whether it is saved.
    pub(super) fn save(&mut self) -> bool {
        match self.document.path().map(Path::to_owned) {
            Some(path) => self.save_as(path),
            None => {
                self.choose(Purpose::SaveAs);
                false
            }
        }
    }

    fn save_as(&mut self, path: PathBuf) -> bool {
        let path = if path.extension().is_some() { path } else { path.with_extension("toml") };
        match self.document.save(path.clone()) {
            Ok(()) => {
                self.desk.remember(&path);
                self.notes.clear();
                self.notes.say(&format!("Saved {}", path.display()));
                self.forget_unsaved();
                if let Some(Compared { is_saved: true, .. }) = self.compared {
                    self.compared = Compared::of_saved(&self.document).ok();
                }
                true
            }
            Err(why) => {
                self.notes.trouble(why);
                false
            }
        }
    }

    fn forget_unsaved(&mut self) {
        if let Some(safe) = &mut self.safe {
            safe.empty();
        }
    }

    /// Ends a gesture: what it changed is one step, and is kept safe.
    fn settle(&mut self) {
        self.desk.eye.settle();
        if !self.document.settle() {
            return;
        }
        (self.desk.light, self.desk.exposure) =
            (self.document.work.light.clone(), self.document.work.exposure);
        let Some(safe) = &mut self.safe else { return };
        if !self.document.is_changed() {
            safe.empty();
        } else if let Err(why) = safe.keep(&self.document.work.design, self.document.path()) {
            self.notes.trouble(format!("unsaved work is not kept safe: {why}"));
        }
    }

    /// Does a command.
    pub(super) fn does(&mut self, command: Command, ctx: &Context) {
        menus::does(self, command, ctx);
    }

    /// Whether something is chosen already, as menus show it.
    pub(super) fn is_chosen(&self, command: Command) -> bool {
        let overlay = |name| self.desk.overlay.as_deref() == Some(name);
        match command {
            Command::One => self.desk.layout == Layout::One,
            Command::Two => self.desk.layout == Layout::Two,
            Command::Four => self.desk.layout == Layout::Four,
            Command::Perspective => self.desk.eye.distance.is_some(),
            Command::EyeLeans => self.desk.eye.eye_leans,
            Command::Wireframe => overlay("wireframe"),
            Command::Facets => overlay("facets"),
            Command::Bounces => overlay("bounces"),
            Command::Unresolved => overlay("unresolved"),
            Command::Total => overlay("total"),
            Command::Strongest => self.desk.strongest,
            Command::Split => self.desk.is_split,
            Command::LightPath => self.following.is_open,
            _ => false,
        }
    }

    /// Asks the studio for all that is in sight.
    fn order(&mut self, seen: &[(usize, [u32; 2])]) {
        let light = self.light();
        let mut order = Order::default();
        let compared = self.compared.is_some();
        let sides = if compared { vec![Which::Present, Which::Other] } else { vec![Which::Present] };
        for which in sides {
            for &(pane, size) in seen {
                if let Some(shot) = self.shot(pane, which, size, &light) {
                    order.shots.push(((pane, which), shot));
                }
            }
            let eye = self.desk.eye;
            let mut view = eye.view(Some(Side::Table));
            view.projection = crate::scene::Projection::Orthographic;
            if let Some(specimen) = self.specimen(which, eye.turn) {
                let ask = Ask { specimen, view, head: self.desk.head };
                if which == Which::Present {
                    order.tilts = Some(Ask { view: crate::scene::View { tilt: 0.0, ..view }, ..ask.clone() });
                }
                order.figures.push((which, ask));
            }
        }
        self.studio.order(order);
    }

    fn specimen(&mut self, which: Which, turn: f64) -> Option<Arc<Specimen>> {
        match which {
            Which::Present => Some(self.posed(turn)),
            Which::Other => self.compared.as_mut().map(|c| c.posed(turn)),
        }
    }

    fn shot(&mut self, pane: usize, which: Which, size: [u32; 2], light: &Arc<Lighting>) -> Option<Shot> {
        let shows = self.desk.panes[pane].shows;
        if shows == Shows::Profile || size[0] < 8 || size[1] < 8 {
            return None;
        }
        let eye = *self.desk.eye(pane);
        let specimen = self.specimen(which, eye.turn)?;
        // Both designs are shown on one scale, that of the present one.
        let reach = reach(self.document.specimen());
        let work = &self.document.work;
        Some(Shot {
            view: eye.view(shows.side()),
            film: eye.film(size, reach),
            shows,
            strongest: self.desk.strongest,
            light: Arc::clone(light),
            exposure: work.exposure,
            head: self.desk.head,
            overlay: self.desk.overlay().filter(|_| shows.is_seen()),
            specimen,
        })
    }

    /// What the linked views look at, whatever they show.
    pub(super) fn linked_shot(&mut self) -> Shot {
        let (light, eye) = (self.light(), self.desk.eye);
        Shot {
            specimen: self.posed(eye.turn),
            shows: Shows::Render,
            strongest: self.desk.strongest,
            view: eye.view(None),
            film: eye.film([1, 1], 1.0),
            light,
            exposure: self.document.work.exposure,
            head: self.desk.head,
            overlay: None,
        }
    }

    fn close(&mut self, ctx: &Context) {
        if !ctx.input(|i| i.viewport().close_requested()) {
            if self.may_close {
                ctx.send_viewport_cmd(ViewportCommand::Close);
            }
        } else if !self.may_close && self.document.is_changed() {
            ctx.send_viewport_cmd(ViewportCommand::CancelClose);
            self.dialog = Some(Dialog::Unsaved(Then::Close));
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
        self.studio.is_idle() && self.choosing.is_none()
    }

    /// Draws the window, and does what is asked for.
    pub(super) fn show(&mut self, ui: &mut Ui) {
        let ctx = ui.ctx().clone();
        self.take_in(&ctx);
        menus::keys(self, &ctx);
        menus::bar(self, ui);
        menus::status(self, ui);
        design_panel::show(self, ui);
        figures_panel::show(self, ui);
        let seen = stage::show(self, ui);
        following::show(self, &ctx);
        dialogs::show(self, &ctx);
        self.document.update();
        self.order(&seen);
        let pulled = self.profiles.iter().any(ProfileView::is_dragging);
        let gesture = pulled || ctx.egui_is_using_pointer() || ctx.text_edit_focused();
        if !gesture {
            self.settle();
        }
        self.name_window(&ctx);
        self.close(&ctx);
    }
}

/// A stone turned about its axis.
pub fn turned(specimen: &Arc<Specimen>, turn: f64) -> Arc<Specimen> {
    if turn == 0.0 {
        return Arc::clone(specimen);
    }
    let stone = specimen.stone.turned(turn);
    Arc::new(Specimen { stone, ..(**specimen).clone() })
}

/// How far a stone reaches from its origin, girdle radii.
pub fn reach(specimen: &Specimen) -> f64 {
    specimen.stone.polytope.vertices().iter().map(|v| v.length()).fold(0.0, f64::max)
}

fn waker(ctx: &Context) -> super::studio::Wake {
    let ctx = ctx.clone();
    Arc::new(move || ctx.request_repaint())
}

/// The card that draws the window, if it computes.
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
        // Whoever closes the window has saved, or said that nothing is to be kept.
        self.forget_unsaved();
    }
}
