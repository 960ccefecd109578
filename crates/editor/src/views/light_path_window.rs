//! The window that shows the path of the followed ray through the stone.

use super::scene_view::zones;
use super::tools::ViewTools;
use brillianteer_session::model::{
    Model,
    action::{Actions, ViewAction},
};
use egui::{Context, Key, Modifiers, Popup, RichText, Ui, Vec2, Window, vec2};

/// The size of the window at first, points.
const SIZE: Vec2 = vec2(560.0, 620.0);

/// Returns whether Escape ends something else before it closes the window: a dialog, a drag, typing, or an open menu.
fn comes_first(model: &Model, tools: &ViewTools, ctx: &Context) -> bool {
    model.session.dialog.is_some()
        || model.meet_pick().is_some()
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
    // Escape has already ended those in this frame, so their state in the frame before counts.
    let waits = comes_first(model, tools, ctx);
    let is_free = !std::mem::replace(&mut tools.following.waits, waits);
    if !model.session.followed.is_open {
        return;
    }
    let mut is_open = !(is_free && ctx.input_mut(|i| i.consume_key(Modifiers::NONE, Key::Escape)));
    let window =
        Window::new("Light path").open(&mut is_open).default_size(SIZE).default_pos(tools.following.place());
    window.min_size(vec2(400.0, 360.0)).show(ctx, |ui| contents(model, tools, ui));
    actions.push_if(!is_open, ViewAction::LightPath(false));
}

/// Draws the path of the ray that is followed, or says why there is none.
fn contents(model: &Model, tools: &mut ViewTools, ui: &mut Ui) {
    let Some((pane, at)) = model.session.followed.at else {
        ui.label("Click a point of the stone in any view to follow the light of that point.");
        return;
    };
    let shows = model.workspace.panes[pane].shows;
    if shows.has_copies() && !model.is_alone() {
        ui.label(
            "A ray can be followed only through a single stone in its own pose. Show one copy and reset its pose, \
                or click a point in a scope.",
        );
        return;
    }
    let view = model.view(pane);
    let specimen = model.document.specimen();
    match tools.probe.of(specimen).path(&view, at) {
        Some(path) => {
            let scope = zones(shows, model.document.work.settings.look.head_of_scopes());
            tools.following.view.show(ui, &specimen.body, &path, &scope, &view);
        }
        None => {
            ui.label(RichText::new("The point is beside the stone; click a point of the stone.").weak());
        }
    }
}
