//! Opens a window that the processor paints: winit opens it, egui-winit translates its events, and this program's painter
//! fills it.

use super::pacer::FramePacer;
use super::storage::FileStorage;
use super::surface::WindowSurface;
use super::{ID, LEAST, WindowError, viewport, without_place};
use crate::editor::Editor;
use crate::setup::Setup;
use brillianteer_painter::Painter;
use eframe::{App, Storage};
use egui::{
    Context, Event, FullOutput, ViewportBuilder, ViewportCommand, ViewportEvent, ViewportId, ViewportInfo,
    vec2,
};
use egui_winit::winit::application::ApplicationHandler;
use egui_winit::winit::event::{StartCause, WindowEvent};
use egui_winit::winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop, EventLoopProxy};
use egui_winit::winit::raw_window_handle::{HasDisplayHandle, RawDisplayHandle};
use egui_winit::winit::window::{Window, WindowId};
use egui_winit::{ActionRequested, State, WindowSettings, accesskit_winit};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// The keys by which eframe keeps the window's geometry and egui's memory.
const WINDOW: &str = "window";
const MEMORY: &str = "egui";

/// The height of a window's title and of the bars of a screen, approximately, in points: at its first start the window leaves
/// them free.
const AROUND: f32 = 40.0;

/// The largest side of a texture, in pixels. The processor sets no limit; egui wants one for its fonts.
const LARGEST: usize = 1 << 14;

/// An event that other threads send to the window's thread.
#[derive(Debug)]
enum UserEvent {
    /// egui requests an image at the time `when`; `pass` is the number of its passes at the time of the request.
    Repaint { when: Instant, pass: u64 },
    /// A screen reader requests something.
    Access(accesskit_winit::Event),
}

impl From<accesskit_winit::Event> for UserEvent {
    fn from(event: accesskit_winit::Event) -> Self {
        Self::Access(event)
    }
}

/// Opens the window and waits until it is closed.
pub fn run(setup: Setup) -> Result<(), WindowError> {
    let events = EventLoop::<UserEvent>::with_user_event()
        .build()
        .map_err(|why| WindowError::NoDisplay(without_place(&why.to_string())))?;
    let proxy = events.create_proxy();
    let mut runner = Runner { proxy, setup: Some(setup), open: None, has_shown: false, failure: None };
    let ended = events.run_app(&mut runner);
    // The window system may have ended the event loop while the window was open.
    runner.close();
    let why = runner.failure.or_else(|| ended.err().map(|why| why.to_string()));
    why.map_or(Ok(()), |why| Err(WindowError::of_ended(&why, runner.has_shown)))
}

/// Runs the window. `setup` is present until the window is open, and `open` while it is.
struct Runner {
    proxy: EventLoopProxy<UserEvent>,
    setup: Option<Setup>,
    open: Option<OpenWindow>,
    /// True once the window has shown its first image.
    has_shown: bool,
    failure: Option<String>,
}

impl Runner {
    /// Calls a method of the open window, and closes the window if that fails or the editor has ended.
    fn with(&mut self, events: &ActiveEventLoop, act: impl FnOnce(&mut OpenWindow) -> Result<(), String>) {
        let Some(open) = &mut self.open else { return };
        let acted = act(open);
        self.has_shown = open.is_shown;
        let is_over = open.is_over || acted.is_err();
        self.failure = acted.err();
        if is_over {
            self.close();
            events.exit();
        }
    }

    fn close(&mut self) {
        if let Some(mut open) = self.open.take() {
            open.context.on_exit();
            open.save();
            open.editor.on_exit();
        }
    }
}

impl ApplicationHandler<UserEvent> for Runner {
    fn resumed(&mut self, events: &ActiveEventLoop) {
        let Some(setup) = self.setup.take() else { return };
        match OpenWindow::new(events, &self.proxy, setup) {
            Ok(open) => self.open = Some(open),
            Err(why) => {
                self.failure = Some(why);
                events.exit();
            }
        }
    }

    fn new_events(&mut self, _: &ActiveEventLoop, _: StartCause) {}

    fn user_event(&mut self, events: &ActiveEventLoop, event: UserEvent) {
        self.with(events, |open| {
            open.handle_user_event(event);
            Ok(())
        });
    }

    fn window_event(&mut self, events: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        self.with(events, |open| open.handle_window_event(events, &event));
    }

    fn about_to_wait(&mut self, events: &ActiveEventLoop) {
        self.with(events, |open| open.paint_if_due(events));
        let next = self.open.as_ref().and_then(|open| open.pacer.next().filter(|_| !open.is_promised));
        events.set_control_flow(next.map_or(ControlFlow::Wait, ControlFlow::WaitUntil));
    }

    fn exiting(&mut self, _: &ActiveEventLoop) {
        self.close();
    }
}

/// An open window.
struct OpenWindow {
    context: Context,
    editor: Editor,
    window: Arc<Window>,
    input: State,
    info: ViewportInfo,
    /// True where the window's size, place or state may have changed since `info` was filled in. Filling it in takes
    /// several round trips to the window system.
    is_info_stale: bool,
    actions: Vec<ActionRequested>,
    painter: Painter,
    surface: WindowSurface,
    kept: Option<FileStorage>,
    settings: Option<WindowSettings>,
    pacer: FramePacer,
    /// The window system decides when to paint, as Wayland does; `is_promised` is true once it has been asked to.
    is_paced_by_system: bool,
    is_promised: bool,
    is_shown: bool,
    is_over: bool,
    begun: Instant,
    saved: Instant,
}

impl OpenWindow {
    fn new(
        events: &ActiveEventLoop,
        proxy: &EventLoopProxy<UserEvent>,
        setup: Setup,
    ) -> Result<Self, String> {
        let kept = eframe::storage_dir(ID).map(|folder| FileStorage::read(&folder));
        let storage = kept.as_ref().map(|kept| kept as &dyn Storage);
        let context = context(storage);
        let settings = storage.and_then(|kept| eframe::get_value::<WindowSettings>(kept, WINDOW));
        let builder = placed(settings, &context, events);
        let window = egui_winit::create_window(&context, events, &builder).map_err(|e| e.to_string())?;
        let window = Arc::new(window);
        if let Some(settings) = settings {
            settings.initialize_window(&window);
        }
        let surface = WindowSurface::of(&window).map_err(|e| e.to_string())?;
        let mut info = ViewportInfo::default();
        egui_winit::update_viewport_info(&mut info, &context, &window, true);
        let scale = window.scale_factor() as f32;
        let theme = events.system_theme();
        let mut input =
            State::new(context.clone(), ViewportId::ROOT, events, Some(scale), theme, Some(LARGEST));
        input.init_accesskit(events, &window, proxy.clone());
        connect_repaint(&context, proxy);
        let editor = Editor::within(&context, storage, None, setup).map_err(|e| e.to_string())?;
        let is_paced_by_system = events
            .display_handle()
            .is_ok_and(|handle| matches!(handle.as_raw(), RawDisplayHandle::Wayland(_)));
        let now = Instant::now();
        let cores = std::thread::available_parallelism().map_or(1, std::num::NonZeroUsize::get);
        let mut pacer = FramePacer::new(cores);
        pacer.request(now);
        Ok(Self {
            context,
            editor,
            window,
            input,
            info,
            is_info_stale: false,
            actions: vec![],
            painter: Painter::default(),
            surface,
            kept,
            settings,
            pacer,
            is_paced_by_system,
            is_promised: false,
            is_shown: false,
            is_over: false,
            begun: now,
            saved: now,
        })
    }

    fn handle_user_event(&mut self, event: UserEvent) {
        use accesskit_winit::WindowEvent as Access;
        match event {
            UserEvent::Repaint { when, pass } => {
                let current = self.context.cumulative_pass_nr_for(ViewportId::ROOT);
                // An older request has been fulfilled by a later pass.
                if current <= pass + 1 {
                    self.pacer.request(when);
                }
            }
            UserEvent::Access(event) => {
                match event.window_event {
                    Access::InitialTreeRequested => self.context.enable_accesskit(),
                    Access::ActionRequested(request) => self.input.on_accesskit_action_request(request),
                    Access::AccessibilityDeactivated => self.context.disable_accesskit(),
                }
                self.pacer.request(Instant::now());
            }
        }
    }

    /// Handles an event of the window system.
    fn handle_window_event(&mut self, events: &ActiveEventLoop, event: &WindowEvent) -> Result<(), String> {
        match event {
            WindowEvent::RedrawRequested if std::mem::take(&mut self.is_promised) => {
                return self.paint(events);
            }
            // A part of the window has been uncovered.
            WindowEvent::RedrawRequested if self.is_shown => {
                return self.surface.show_again(self.painter.canvas()).map_err(|e| e.to_string());
            }
            WindowEvent::CloseRequested => {
                self.info.events.push(ViewportEvent::Close);
                // The system may never ask a hidden window to paint, but it must close all the same.
                self.is_promised = false;
                self.pacer.request(Instant::now());
            }
            WindowEvent::Occluded(is_occluded) => self.info.occluded = Some(*is_occluded),
            _ => {}
        }
        let is_of_pointer = matches!(
            event,
            WindowEvent::CursorMoved { .. } | WindowEvent::MouseInput { .. } | WindowEvent::MouseWheel { .. }
        );
        self.is_info_stale |= !is_of_pointer;
        if self.input.on_window_event(&self.window, event).repaint {
            self.pacer.request(Instant::now());
        }
        Ok(())
    }

    fn paint_if_due(&mut self, events: &ActiveEventLoop) -> Result<(), String> {
        if self.is_promised || !self.pacer.is_due(Instant::now()) {
            return Ok(());
        }
        if self.is_paced_by_system && self.is_shown && self.info.events.is_empty() {
            self.is_promised = true;
            self.window.request_redraw();
            return Ok(());
        }
        self.paint(events)
    }

    /// Runs one pass of the editor and shows the changes.
    fn paint(&mut self, events: &ActiveEventLoop) -> Result<(), String> {
        self.pacer.begin(Instant::now());
        if std::mem::take(&mut self.is_info_stale) {
            egui_winit::update_viewport_info(&mut self.info, &self.context, &self.window, false);
            self.pacer.is_hidden = self.info.minimized == Some(true);
        }
        let mut input = self.input.take_egui_input(&self.window);
        input.time = Some(self.begun.elapsed().as_secs_f64());
        input.viewports.insert(ViewportId::ROOT, self.info.clone());
        let is_asked_to_close = input.viewport().close_requested();
        let editor = &mut self.editor;
        let output = self.context.run_ui(input, |ui| editor.show(ui));
        self.info.events.clear();
        let FullOutput { platform_output, mut textures_delta, shapes, pixels_per_point, mut viewport_output } =
            output;
        let commands =
            viewport_output.remove(&ViewportId::ROOT).map_or_else(Vec::new, |output| output.commands);
        self.input.handle_platform_output_with_event_loop(&self.window, events, platform_output);
        let primitives = self.context.tessellate(shapes, pixels_per_point);
        let size = self.window.inner_size();
        let size = [size.width as usize, size.height as usize];
        let areas = self.painter.paint(size, pixels_per_point, &primitives, &mut textures_delta);
        let window = &self.window;
        let shown = self.surface.show(self.painter.canvas(), areas, || window.pre_present_notify());
        shown.map_err(|e| e.to_string())?;
        self.appear();
        self.is_over = is_asked_to_close && !commands.contains(&ViewportCommand::CancelClose);
        self.run_commands(commands);
        if self.saved.elapsed() > self.editor.auto_save_interval() {
            self.save();
        }
        self.pacer.end(Instant::now());
        Ok(())
    }

    /// Makes the window visible after its first image, so that it is never empty.
    fn appear(&mut self) {
        if std::mem::replace(&mut self.is_shown, true) {
            return;
        }
        if let Some(settings) = &self.settings {
            settings.before_first_show(&self.window);
        }
        self.window.set_visible(true);
        if let Some(settings) = &self.settings {
            settings.after_first_show(&self.window);
        }
    }

    /// Carries out the editor's commands for its window.
    fn run_commands(&mut self, commands: Vec<ViewportCommand>) {
        self.is_info_stale |= !commands.is_empty();
        let Self { context, info, window, actions, .. } = self;
        egui_winit::process_viewport_commands(context, info, commands, window, actions);
        if !info.events.is_empty() {
            self.pacer.request(Instant::now());
        }
        for action in self.actions.drain(..) {
            let event = match action {
                ActionRequested::Cut => Some(Event::Cut),
                ActionRequested::Copy => Some(Event::Copy),
                ActionRequested::Paste => pasted(&mut self.input),
                // No part of this program sends these requests.
                ActionRequested::Screenshot(_) | ActionRequested::PaintWhileHidden => None,
            };
            if let Some(event) = event {
                self.input.egui_input_mut().events.push(event);
                self.pacer.request(Instant::now());
            }
        }
    }

    fn save(&mut self) {
        self.saved = Instant::now();
        let Some(kept) = &mut self.kept else { return };
        let last = self.settings.map(|settings| settings.normal_geometry());
        let settings = WindowSettings::from_window(self.context.zoom_factor(), &self.window, last);
        self.settings = Some(settings);
        eframe::set_value(kept, WINDOW, &settings);
        self.context.memory(|memory| eframe::set_value(kept, MEMORY, memory));
        App::save(&mut self.editor, kept);
        kept.flush();
    }
}

/// Returns an egui context with the memory of the last session.
fn context(kept: Option<&dyn Storage>) -> Context {
    let context = Context::default();
    if let Some(memory) = kept.and_then(|kept| eframe::get_value(kept, MEMORY)) {
        context.memory_mut(|kept| *kept = memory);
    }
    // A second pass hides the first one of a new layout, as in eframe's windows.
    context.options_mut(|options| options.max_passes = std::num::NonZeroUsize::MIN.saturating_add(1));
    context
}

/// The window's attributes, with its last place and size as far as today's screens allow them.
fn placed(settings: Option<WindowSettings>, context: &Context, events: &ActiveEventLoop) -> ViewportBuilder {
    let zoom = context.zoom_factor();
    let largest = events.available_monitors().fold(egui::Vec2::ZERO, |largest, monitor| {
        let size = monitor.size().to_logical::<f32>(f64::from(zoom) * monitor.scale_factor());
        largest.max(egui::vec2(size.width, size.height))
    });
    let largest = if largest == egui::Vec2::ZERO { egui::Vec2::INFINITY } else { largest };
    let builder = match settings {
        Some(mut settings) => {
            settings.clamp_size_to_sane_values(largest);
            settings.clamp_position_to_monitors(zoom, events);
            settings.initialize_viewport_builder(zoom, viewport())
        }
        None => {
            let first = viewport();
            let free = (largest - vec2(0.0, AROUND)).max(vec2(LEAST[0], LEAST[1]));
            let size = first.inner_size.map_or(largest, |size| size.min(free));
            first.with_inner_size(size)
        }
    };
    // The window becomes visible with its first image.
    builder.with_visible(false)
}

/// Passes egui's requests for images, which come from any thread, to the window's thread.
fn connect_repaint(context: &Context, proxy: &EventLoopProxy<UserEvent>) {
    let proxy = Mutex::new(proxy.clone());
    context.set_request_repaint_callback(move |asked| {
        let when = Instant::now()
            .checked_add(asked.delay)
            .unwrap_or_else(|| Instant::now() + Duration::from_secs(1 << 20));
        let event = UserEvent::Repaint { when, pass: asked.current_cumulative_pass_nr };
        // This fails once the window is closed and nothing can be painted.
        let _ = proxy.lock().unwrap_or_else(PoisonError::into_inner).send_event(event);
    });
}

/// Returns the clipboard's text or picture as an event.
fn pasted(input: &mut State) -> Option<Event> {
    if let Some(text) = input.clipboard_text() {
        let text = text.replace("\r\n", "\n");
        return (!text.is_empty()).then_some(Event::Paste(text));
    }
    input.clipboard_image().map(|image| Event::PasteImage(Arc::new(image)))
}
