//! Moves the eye of a view by pointer, wheel and keys.

use super::pane_view::PaneView;
use crate::arrows;
use brillianteer_scene::Side;
use brillianteer_session::model::eye::Eye;
use egui::{Key, Modifiers, PointerButton, Response, Ui};
use glam::DVec2;

/// The angles by which an arrow key tilts the stone, alone and with Shift, radians.
const STEP: (f64, f64) = (0.017_453_292_519_943_295, 0.087_266_462_599_716_48);

/// The distance by which Alt and an arrow key move the picture, girdle radii of a stone that fits its view.
const ASIDE: f64 = 0.1;

/// The logarithm of the zoom for each point that the wheel scrolls by.
const WHEEL: f64 = 0.004;

/// Returns the eye after the input by pointer, wheel and keys; `is_held` says that a drag moves the background
/// instead.
pub fn moved(mut eye: Eye, ui: &Ui, response: &Response, sight: &PaneView, is_held: bool) -> Eye {
    let unit = sight.film.pixel * f64::from(sight.scale);
    let by = response.drag_delta();
    let by = DVec2::new(f64::from(by.x), -f64::from(by.y)) * unit;
    let spins = response.dragged_by(PointerButton::Secondary) || ui.input(|i| i.modifiers.shift);
    if response.dragged_by(PointerButton::Middle) {
        eye.centre -= by;
    } else if spins && response.dragged() {
        eye.spin(sight.view.side, by.x);
    } else if response.dragged_by(PointerButton::Primary) && !is_held {
        eye.drag(sight.view.side, by);
    }
    if let Some(at) = response.hover_pos().filter(|_| response.hovered()) {
        let (wheel, pinch) = ui.input(|i| (i.smooth_scroll_delta().y, i.zoom_delta()));
        let factor = (f64::from(wheel) * WHEEL).exp() * f64::from(pinch);
        if factor != 1.0 {
            eye.zoom_at(factor, sight.image(at) - sight.middle);
        }
    }
    if response.has_focus() {
        arrows::keep(ui, response.id);
        by_keys(&mut eye, ui, sight.view.side);
    }
    eye
}

fn by_keys(eye: &mut Eye, ui: &Ui, side: Side) {
    eye.centre += arrows::way(ui, Modifiers::ALT) * (ASIDE / eye.zoom);
    for (modifiers, step) in [(Modifiers::SHIFT, STEP.1), (Modifiers::NONE, STEP.0)] {
        eye.drag(side, arrows::way(ui, modifiers) * step);
    }
    let pressed = |key| arrows::pressed(ui, Modifiers::NONE, key);
    eye.spin(side, (pressed(Key::Period) - pressed(Key::Comma)) * STEP.1);
    let zoom = pressed(Key::Plus) + pressed(Key::Equals) - pressed(Key::Minus);
    eye.zoom_at(1.2_f64.powf(zoom), eye.centre);
}
