//! The view of a pane of liquid glass, drawn as screens draw it or traced: the pane is moved by hand, its light by
//! the pointer or by time.

use super::clock::step;
use super::pane_context::{PaneContext, focus};
use super::view_menu::attend;
use crate::arrows;
use brillianteer_session::liquid::{LightMotion, Liquid};
use brillianteer_session::model::action::{Edit, ViewAction};
use brillianteer_session::shows::Shows;
use brillianteer_session::studio::Which;
use egui::{Modifiers, PointerButton, Rect, Response, Role, Sense, StrokeKind, Ui, WidgetInfo};
use glam::DVec2;

/// The distance by which an arrow key moves the pane, in parts of the view.
const STEP: f64 = 0.01;

/// Draws the view, and moves the pane by drags and arrow keys.
pub fn show(cx: &mut PaneContext, ui: &Ui, body: Rect) {
    let response = ui.interact(body, ui.scope_id().with("picture"), Sense::click_and_drag());
    let name = format!("{} picture", cx.shows.name());
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, &name));
    let before = cx.model.liquid();
    let mut liquid = before;
    if response.dragged_by(PointerButton::Primary) {
        let by = response.drag_delta() / body.size();
        liquid.drag(DVec2::new(by.x.into(), by.y.into()));
    }
    if response.has_focus() {
        arrows::keep(ui, response.id);
        let way = arrows::way(ui, Modifiers::NONE);
        if way != DVec2::ZERO {
            liquid.drag(DVec2::new(way.x, -way.y) * STEP);
        }
    }
    let own = cx.model.document.work.settings.liquid;
    let moved = Liquid { light_from: own.light_from, ..liquid };
    cx.actions.push_changed(&own, moved, |liquid| Edit::Liquid(Box::new(liquid)));
    // Where the light follows the pointer or time, it moves without steps of undo.
    move_light(cx, ui, &response, &mut liquid);
    cx.actions.push_changed(&before.light_from, liquid.light_from, ViewAction::LiquidLight);
    ui.painter().rect_filled(body, 4.0, ui.visuals().extreme_bg_color);
    if let Some(shown) = cx.shown(Which::Present).filter(|shown| shown.shot.shows == cx.shows) {
        shown.paint(ui.painter(), body);
    }
    ui.painter().rect_stroke(body, 4.0, focus(ui, &response), StrokeKind::Inside);
    attend(cx, &response, response.hovered() || response.has_focus());
}

/// Moves the light of the pane to the pointer, or as time runs. In the second case, only one of all views of the pane
/// requests the frames.
fn move_light(cx: &PaneContext, ui: &Ui, response: &Response, liquid: &mut Liquid) {
    let workspace = &cx.model.workspace;
    match liquid.light_motion {
        LightMotion::Fixed => {}
        LightMotion::Pointer => {
            let Some(pointer) = response.hover_pos() else { return };
            let [at, size] = [pointer - response.rect.min, response.rect.size()]
                .map(|v| DVec2::new(f64::from(v.x), f64::from(v.y)));
            liquid.light_at(at / size, size);
        }
        LightMotion::Time => {
            let first =
                workspace.shown().iter().copied().find(|&k| workspace.panes[k].shows == Shows::LiquidGlass);
            if first == Some(cx.pane) {
                liquid.turn_light(step(ui.ctx()));
            }
        }
    }
}
