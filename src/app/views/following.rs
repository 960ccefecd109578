//! The ray that is followed through the stone, and the window that shows its path.

use super::light_path::LightPath;
use super::scene_view::zones;
use super::tools::ViewTools;
use crate::app::model::Model;
use crate::app::model::action::{Actions, ViewAction};
use egui::{Context, Key, Modifiers, Popup, Pos2, Rect, RichText, Ui, Vec2, Window, pos2, vec2};
use glam::DVec2;

/// How long a click waits to become a double click, seconds.
const PATIENCE: f64 = 0.32;

/// The size of the window at first, points.
const SIZE: Vec2 = vec2(560.0, 620.0);

/// Where the window opens at first, unless a view there is clicked: over the views, beside the design panel.
const PLACE: Pos2 = pos2(372.0, 220.0);

/// The window of the light path, and the click that may open it.
#[derive(Debug, Default)]
pub struct Following {
    /// A click that may become a double click: the view, the point of its image, and the time in seconds.
    waiting: Option<(usize, DVec2, f64)>,
    /// Whether Escape was meant for something else in the last frame.
    waits: bool,
    /// The rectangle on the screen of the view that was clicked.
    clicked: Option<Rect>,
    view: LightPath,
}

impl Following {
    /// Takes a click on a point of a view; the ray there is followed unless the click becomes a double click.
    pub fn click(&mut self, pane: usize, at: DVec2, body: Rect, ctx: &Context) {
        self.clicked = Some(body);
        self.waiting = Some((pane, at, ctx.input(|i| i.time)));
        ctx.request_repaint_after_secs(PATIENCE as f32 + 0.02);
    }

    /// Forgets the click that waits: it was half of a double click.
    pub fn unclick(&mut self) {
        self.waiting = None;
    }

    /// Returns where the window opens: not over the view that was clicked.
    fn place(&self) -> Pos2 {
        let covered = self.clicked.filter(|body| body.left() <= PLACE.x);
        covered.map_or(PLACE, |body| pos2(body.right(), PLACE.y))
    }

    /// Returns the click that became no double click, once that is certain.
    fn ripe(&mut self, ctx: &Context) -> Option<ViewAction> {
        let now = ctx.input(|i| i.time);
        let Some((pane, at, _)) = self.waiting.filter(|(.., since)| now - since > PATIENCE) else {
            self.waiting.iter().for_each(|_| ctx.request_repaint_after_secs(0.05));
            return None;
        };
        self.waiting = None;
        Some(ViewAction::Follow(pane, at))
    }
}

/// Whether Escape ends something else before it closes the window: a dialog, a drag, typing, or an open menu.
fn comes_first(model: &Model, tools: &ViewTools, ctx: &Context) -> bool {
    model.session.dialog.is_some()
        || tools.is_handle_dragged()
        || ctx.text_edit_focused()
        || Popup::is_any_open(ctx)
}

/// Draws the window of the light path, if it is open.
pub fn show(model: &Model, tools: &mut ViewTools, actions: &mut Actions, ctx: &Context) {
    if let Some(follow) = tools.following.ripe(ctx) {
        actions.push(follow);
        // The window opens in the next frame.
        ctx.request_repaint();
    }
    // In this frame Escape has already ended what comes first, so the state of the frame before counts.
    let waits = comes_first(model, tools, ctx);
    let is_free = !std::mem::replace(&mut tools.following.waits, waits);
    if !model.session.followed.is_open {
        return;
    }
    let mut is_open = !(is_free && ctx.input_mut(|i| i.consume_key(Modifiers::NONE, Key::Escape)));
    let window =
        Window::new("Light path").open(&mut is_open).default_size(SIZE).default_pos(tools.following.place());
    window.min_size(vec2(400.0, 360.0)).show(ctx, |ui| contents(model, tools, ui));
    if !is_open {
        actions.push(ViewAction::LightPath(false));
    }
}

/// Draws the path of the ray that is followed, or says why there is none.
fn contents(model: &Model, tools: &mut ViewTools, ui: &mut Ui) {
    let Some((pane, at)) = model.session.followed.at else {
        ui.label("Click a point of the stone in any view: its light is followed from there.");
        return;
    };
    let shows = model.workspace.panes[pane].shows;
    if shows.has_company() && !model.is_alone() {
        ui.label(
            "A ray is followed through one stone at rest: show a single copy, at rest, or click a scope.",
        );
        return;
    }
    let view = model.workspace.view(pane);
    let specimen = tools.stones.posed(model, model.workspace.eye(pane).turn);
    match tools.probe.of(&specimen).path(&view, at) {
        Some(path) => {
            let scope = zones(shows, model.document.work.head);
            tools.following.view.show(ui, &specimen.body, &path, &scope, &view.light_basis());
        }
        None => {
            ui.label(RichText::new("The point lies beside the stone; click one that lies on it.").weak());
        }
    }
}
