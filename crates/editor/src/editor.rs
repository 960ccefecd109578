//! The editor's window: it draws the model, turns what a person does into actions, and carries out tasks.

use super::hands::Hands;
use super::panels::{audit_panel, map_window, row_focus, rows, search_window, side_panels, tier_table};
use super::setup::{PaintedBy, Setup};
use super::state_file::StateFile;
use super::views::gallery::{Shown, hang, texture_image};
use super::views::look_ups::look_ups;
use super::views::{ViewTools, bench_mode, clock, light_path_window, stage};
use super::{dialogs, drops, menus, theme};
use brillianteer_base::Failure;
use brillianteer_files::library;
use brillianteer_session::model::{
    Action, Model, Task,
    action::{Actions, Computed, FileAction, FrameEnd, NoteAction, ViewAction},
    opening::{FileRequest, Opening, OpeningPurpose},
    ordering::Seen,
    task::WindowTask,
    update,
    workspace::Workspace,
};
use brillianteer_session::pixels::Pixels;
use brillianteer_session::shows::Shows;
use brillianteer_session::studio::{self, Slot, Studio, Which};
use brillianteer_session::tasks::{Outside, TaskAnswer, autosave::Autosave};
use brillianteer_trace::gpu::Gpu;
use eframe::{CreationContext, Storage};
use egui::{Context, PanelState, TextureHandle, Ui, ViewportCommand};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The window of the editor.
pub struct Editor {
    pub(super) model: Model,
    /// The actions of this frame.
    pub(super) actions: Actions,
    pub(super) outside: Outside,
    ctx: Context,
    pub(super) studio: Studio,
    /// The caches and states that drawing the views needs.
    pub(super) views: ViewTools,
    /// The small pictures of the export dialog.
    pub(super) thumbnails: HashMap<Shows, TextureHandle>,
    title: String,
    state_file: Option<StateFile>,
    /// The painter of the window: the graphics card or the processor.
    pub(super) painted_by: PaintedBy,
    /// True until the file with which the editor was opened has been read; nobody asked for the design that the model holds
    /// until then.
    pub(super) is_starting: bool,
}

/// The key under which the workspace is kept between starts.
const DESK: &str = "desk";

impl Editor {
    /// Opens the editor in a window of eframe's; see [`within`](Self::within).
    ///
    /// # Errors
    /// Fails where [`within`](Self::within) does.
    pub fn new(context: &CreationContext<'_>, setup: Setup) -> Result<Self, Failure> {
        Self::within(&context.egui_ctx, context.storage, shared(context), setup)
    }

    /// Opens the editor with the workspace that `storage` holds; `gpu` is a card that pictures may be computed on.
    ///
    /// # Errors
    /// Fails only where the program itself is broken: it comes with the cut and the light that it starts with.
    pub fn within(
        context: &Context,
        storage: Option<&dyn Storage>,
        gpu: Option<Arc<Gpu>>,
        setup: Setup,
    ) -> Result<Self, Failure> {
        theme::apply(context);
        context.add_plugin(Hands::default());
        let kept = storage.and_then(|s| s.get_string(DESK));
        // A workspace of a later program that this one cannot read is ignored.
        let workspace: Workspace =
            kept.and_then(|text| serde_json::from_str(&text).ok()).unwrap_or(setup.workspace);
        let mut model = Model::new(workspace)?;
        model.session.safe.is_on = setup.safe.is_some();
        let wake = waker(context);
        let safe = setup.safe.map(Autosave::new);
        let mut editor = Self {
            actions: Actions::default(),
            outside: Outside::new(setup.chooser, setup.opener, safe, wake.clone()),
            ctx: context.clone(),
            studio: Studio::open(gpu, wake),
            views: ViewTools::default(),
            thumbnails: HashMap::new(),
            title: String::new(),
            state_file: setup.state_file,
            painted_by: setup.painted_by,
            is_starting: false,
            model,
        };
        let is_there = |path: &PathBuf| path.exists();
        let last = editor.outside.last().filter(|found| found.path.as_ref().is_none_or(is_there));
        let last_file = editor.model.workspace.last.clone().filter(is_there);
        match (setup.file, last, last_file) {
            (Some(path), ..) => {
                editor.act(first(path, setup.mesh));
                editor.is_starting = true;
            }
            (None, Some(found), _) => editor.act(FileAction::Restore(Box::new(found))),
            (None, None, Some(path)) => {
                editor.act(first(path, setup.mesh));
                editor.is_starting = true;
            }
            (None, None, None) => {}
        }
        editor.act(editor.outside.found());
        Ok(editor)
    }

    /// Carries out an action at once, and starts the tasks that it causes.
    pub(super) fn act(&mut self, action: impl Into<Action>) {
        for task in update(&mut self.model, action.into()) {
            match task {
                Task::Window(task) => self.in_window(task),
                Task::Trace(order) => self.studio.order(*order),
                task => {
                    if let Task::Thumbnails(_) = task {
                        self.thumbnails.clear();
                    }
                    self.outside.start(task);
                }
            }
        }
    }

    /// Carries out the actions that were pushed since the last call.
    pub(super) fn run(&mut self) {
        for action in self.actions.take() {
            self.act(action);
        }
        self.views.gallery.tidy(&self.model);
    }

    /// Carries out a task that only the window can do.
    fn in_window(&mut self, task: WindowTask) {
        match task {
            WindowTask::Close => self.ctx.send_viewport_cmd(ViewportCommand::Close),
            WindowTask::StayOpen => self.ctx.send_viewport_cmd(ViewportCommand::CancelClose),
            WindowTask::FullScreen => {
                let is_full = self.ctx.input(|i| i.viewport().fullscreen == Some(true));
                self.ctx.send_viewport_cmd(ViewportCommand::Fullscreen(!is_full));
            }
            // Panels keep the widths that the user gave them until egui forgets these.
            WindowTask::ForgetPanelWidths => {
                self.ctx.data_mut(|data| data.remove_by_type::<PanelState>());
            }
            WindowTask::CopyShown(pane) => self.copy_shown(pane),
        }
    }

    fn copy_shown(&mut self, pane: usize) {
        let is_other = self.model.session.keys.other && self.model.session.compared.is_some();
        let which = if is_other { Which::Other } else { Which::Present };
        let shows = self.model.workspace.panes[pane].shows;
        let text = match self.shown((pane, which)).filter(|picture| picture.shot.shows == shows) {
            Some(picture) if picture.shot.waits_for_light() => {
                "The light is still being drawn; copy the view when it is done.".to_owned()
            }
            Some(picture) => {
                self.ctx.copy_image(texture_image(&picture.taken.image));
                format!("{} copied", shows.name())
            }
            None => "This view has no picture to copy.".to_owned(),
        };
        self.actions.push(NoteAction::Say(text));
    }

    /// Returns the picture of a view.
    pub(super) fn shown(&self, slot: Slot) -> Option<&Shown> {
        self.views.gallery.shown(&self.model, slot)
    }

    /// Takes the answers of the studio and of tasks.
    fn take_in(&mut self) {
        let answers: Vec<studio::Answer> = self.studio.answers().collect();
        for answer in answers {
            match answer {
                studio::Answer::Picture(slot, shot, grade, taken) => {
                    hang(&self.ctx, &mut self.views.gallery.traced, slot, (*shot, grade, taken));
                }
                studio::Answer::Figures(which, order, grade, figures) => {
                    self.actions.push(Computed::Figures(which, order, grade, figures));
                }
                studio::Answer::Swept(number, points) => {
                    self.actions.push(Computed::Swept(number, points));
                }
                studio::Answer::Tilts(order, tilts) => self.actions.push(Computed::Tilts(order, tilts)),
                studio::Answer::Trouble(why) => self.actions.push(NoteAction::Trouble(why)),
            }
        }
        for answer in self.outside.answers() {
            match answer {
                TaskAnswer::Act(action) => self.actions.push(*action),
                TaskAnswer::Copied(made) => self.copied(made),
                TaskAnswer::Looked(slot, request, Ok(taken)) => {
                    let picture = (request.shot.clone(), request.grade, taken);
                    hang(&self.ctx, &mut self.views.gallery.looked, slot, picture);
                }
                TaskAnswer::Looked(_, _, Err(why)) => self.actions.push(NoteAction::Trouble(why.to_string())),
                TaskAnswer::Thumbnail(shows, image) => {
                    let name = format!("thumbnail {shows:?}");
                    let texture =
                        self.ctx.load_texture(name, texture_image(&image), egui::TextureOptions::LINEAR);
                    self.thumbnails.insert(shows, texture);
                }
            }
        }
    }

    fn copied(&mut self, made: Result<Pixels, Failure>) {
        let made = made.map(|image| {
            let size = image.size;
            self.ctx.copy_image(texture_image(&image));
            size
        });
        self.actions.push(Computed::Copied(made));
    }

    /// Takes dropped files, requests to close the window, and held keys.
    fn take_in_input(&mut self) {
        let (dropped, is_to_close): (Vec<PathBuf>, bool) = self.ctx.input(|i| {
            let dropped = i.raw.dropped_files.iter().map(|file| file.path().to_owned());
            (dropped.collect(), i.viewport().close_requested())
        });
        if !dropped.is_empty() {
            self.actions.push(FileAction::Dropped(dropped));
        }
        self.actions.push_if(is_to_close, FileAction::Close);
        let keys = menus::held_keys(&self.ctx);
        self.actions.push_changed(&self.model.session.keys, keys, ViewAction::Keys);
    }

    fn name_window(&mut self) {
        let document = &self.model.document;
        let mark = if document.is_changed() { " •" } else { "" };
        let title = format!("{}{mark} — Brillianteer", document.title());
        if title != self.title {
            self.ctx.send_viewport_cmd(ViewportCommand::Title(title.clone()));
            self.title = title;
        }
    }

    /// Draws the panels and the views of the design, or the file that is read in their place; returns the views in sight.
    fn show_design(&mut self, ui: &mut Ui) -> Vec<Seen> {
        let is_anew = |opening: &&Opening| opening.request.purpose == OpeningPurpose::Anew;
        let first = self.model.session.awaited.opening.iter().find(is_anew);
        self.is_starting &= first.is_some();
        if let Some(first) = first.filter(|_| self.is_starting) {
            stage::show_reading(&first.request.path, ui);
            return vec![];
        }
        if !self.model.workspace.hides_panels && !self.model.is_at_bench() {
            side_panels::show(&self.model, &mut self.actions, ui);
            self.run();
        }
        tier_table::show(&self.model, &mut self.actions, ui);
        audit_panel::show(&self.model, &mut self.actions, ui);
        self.run();
        if self.model.is_at_bench() {
            bench_mode::show(&self.model, &mut self.actions, ui);
            return vec![];
        }
        stage::show(&self.model, &mut self.views, &mut self.actions, ui)
    }

    /// Returns whether all pictures and figures have their final quality and no task is running.
    pub(super) fn is_idle(&self) -> bool {
        let session = &self.model.session;
        let awaited = &session.awaited;
        self.studio.is_idle()
            && !self.outside.is_looking_up()
            && session.search.running().is_none()
            && session.light.loading.is_none()
            && session.ring.asked.is_none()
            && awaited.choosing.is_none()
            && awaited.opening.is_empty()
            && awaited.saving.is_none()
            && !awaited.dropped
    }

    /// Draws the window and carries out the user's actions.
    pub(super) fn show(&mut self, ui: &mut Ui) {
        let ctx = ui.ctx().clone();
        row_focus::begin(&ctx);
        if self.model.session.dialog.is_some() {
            // Nothing below a dialog answers the hand, and no tooltip of it stays over the dialog.
            ui.visuals_mut().disabled_alpha = 1.0;
            ui.disable();
        }
        self.take_in();
        self.take_in_input();
        self.run();
        menus::keys(&self.model, &mut self.actions, &ctx, self.views.attention.is_picture_focused);
        self.run();
        self.views.paper = theme::paper(&ctx);
        menus::bar(&self.model, &mut self.actions, ui);
        let state = self.state();
        let painters = (self.studio.device_name(), self.painted_by);
        menus::status(&self.model.session, &state, painters, ui);
        self.run();
        let seen = self.show_design(ui);
        self.run();
        light_path_window::show(&self.model, &mut self.views, &mut self.actions, &ctx);
        map_window::show(&self.model, &mut self.actions, &ctx);
        search_window::show(&self.model, &mut self.actions, &ctx);
        dialogs::show(&self.model, &self.thumbnails, &mut self.actions, &ctx);
        drops::invite(&ctx);
        let moves = |pane: usize| self.model.workspace.panes[pane].shows.has_copies();
        if self.model.session.motion.is_on && seen.iter().any(|(pane, _)| moves(*pane)) {
            self.actions.push(ViewAction::Advance(clock::step(&ctx)));
        }
        self.end_frame();
        self.order(&seen);
        self.name_window();
        self.publish_state();
        if self.state() != state {
            // The status line of this frame was drawn before the new order.
            ctx.request_repaint();
        }
    }

    /// Returns in a word or two what the window waits for.
    fn state(&self) -> String {
        let session = &self.model.session;
        let opening = session.awaited.opening.last().map(Opening::message);
        let lighting = || {
            let loading = session.light.loading.as_ref()?;
            // While the map is drawn, views show a coarse one.
            let is_drawn = session.light.at_hand.is_coarse() && session.light.name == *loading;
            Some(if is_drawn { "drawing the light…" } else { "loading the light…" }.to_owned())
        };
        opening.or_else(|| self.studio.preparing()).or_else(lighting).unwrap_or_else(|| {
            let is_busy = !self.studio.is_idle() || self.outside.is_looking_up();
            let state = match (is_busy, self.studio.sharpens()) {
                (true, _) => "tracing…",
                (false, true) => "sharpening…",
                (false, false) => "done",
            };
            state.to_owned()
        })
    }

    fn end_frame(&mut self) {
        let fits = self.model.session.framing.fits();
        let is_gesture = self.views.is_handle_dragged()
            || self.ctx.egui_is_using_pointer()
            || self.ctx.text_edit_focused()
            || rows::may_be_reset(&self.ctx);
        let now = self.ctx.input(|i| i.time);
        self.run();
        self.act(Action::Frame(FrameEnd { now, is_gesture }));
        if fits != self.model.session.framing.fits() {
            // The views of this frame were laid out for the stone as it was fitted before.
            self.ctx.request_repaint();
        }
    }

    /// Orders the pictures and figures of all views in sight.
    fn order(&mut self, seen: &[Seen]) {
        for (slot, request) in look_ups(&self.model, &mut self.views, seen) {
            self.outside.look_up(slot, request);
        }
        let order = self.views.orders(&self.model).all(seen);
        self.act(Computed::Order(Box::new(order)));
    }

    /// Writes to the state file whether the window is at rest, for a test that waits for that.
    fn publish_state(&mut self) {
        let is_quiet = self.is_idle() && !self.studio.sharpens();
        let layout = self.model.workspace.layout;
        let blocks = self.views.gallery.blocks();
        if self.state_file.as_mut().is_some_and(|file| file.note(is_quiet, layout, blocks)) {
            self.ctx.request_repaint();
        }
    }
}

/// Returns the action that opens a file, or the cut or scene of that name that comes with the program.
fn first(path: PathBuf, mesh: brillianteer_files::mesh_options::MeshOptions) -> FileAction {
    use brillianteer_session::model::dialog::Then;
    let name = path.to_string_lossy().into_owned();
    let is_file = Path::is_file(&path);
    if !is_file && library::scene(&name).is_some() {
        FileAction::Begin(Then::Preset(name.to_lowercase()))
    } else if !is_file && library::cut(&name).is_some() {
        FileAction::Begin(Then::Library(name))
    } else {
        FileAction::OpenWith(FileRequest { purpose: OpeningPurpose::Anew, path, mesh })
    }
}

fn waker(ctx: &Context) -> studio::Wake {
    let ctx = ctx.clone();
    Arc::new(move || ctx.request_repaint())
}

/// Returns the card that draws the window, if it can compute.
fn shared(context: &CreationContext<'_>) -> Option<Arc<Gpu>> {
    let state = context.wgpu_render_state.as_ref()?;
    Gpu::of(state.device.clone(), state.queue.clone(), &state.adapter.get_info()).ok().map(Arc::new)
}

impl eframe::App for Editor {
    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        self.show(ui);
    }

    fn save(&mut self, storage: &mut dyn eframe::Storage) {
        if let Ok(text) = serde_json::to_string(&self.model.workspace) {
            storage.set_string(DESK, text);
        }
    }

    fn on_exit(&mut self) {
        self.act(FileAction::Ended);
        self.outside.finish();
    }
}
