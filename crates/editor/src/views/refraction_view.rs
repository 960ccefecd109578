//! The view of a refraction map: a background that moves behind the stone. The studio traces the map; each move of
//! the background looks up another picture in it.

use super::clock::step;
use super::pane_context::{PaneContext, has_room};
use brillianteer_session::model::session::Flowing;
use brillianteer_session::studio::SPAN;
use egui::{PointerButton, Response, Ui};
use glam::DVec2;

/// The speed at which the background flows, in parts of the map's plane per second.
const FLOW: DVec2 = DVec2::new(0.06, 0.02);

/// Draws the choices over the picture, from the right.
pub fn choices(flowing: &mut Flowing, ui: &mut Ui) {
    if has_room(ui, 64.0) {
        ui.checkbox(&mut flowing.flows, "Flow").on_hover_text(
            "Lets the background move by itself. You can also drag it; drag with Ctrl to tilt the \
                stone.",
        );
    }
    if has_room(ui, 64.0) {
        ui.checkbox(&mut flowing.is_map, "Map").on_hover_text(
            "Shows the map itself, which says where on the background the light of each pixel comes from. Blue is \
                the number of one of 16 by 16 tiles, red and green are the place in that tile.",
        );
    }
}

/// Returns whether a drag moves the background, and not the stone.
pub fn is_held(ui: &Ui) -> bool {
    ui.input(|i| !i.modifiers.shift && !i.modifiers.command)
}

/// Moves the background of a view by a drag or by itself.
pub fn moved(cx: &mut PaneContext, ui: &Ui, response: &Response) {
    if response.dragged_by(PointerButton::Primary) && is_held(ui) {
        let by = response.drag_delta() / response.rect.size();
        cx.flowing.moved += DVec2::new(by.x.into(), by.y.into()) / (SPAN * cx.eye().zoom);
    }
    if cx.flowing.flows && !cx.flowing.is_map {
        cx.flowing.moved += FLOW * step(ui.ctx());
    }
}
