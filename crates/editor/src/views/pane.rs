//! One view: its head, and below it the stone under light or a drawing.

use super::pane_context::PaneContext;
use super::view_menu::attend;
use super::{liquid_view, pane_head, scene_view};
use brillianteer_session::model::action::{Edit, ViewAction};
use brillianteer_session::shows::Shows;
use brillianteer_session::studio::Which;
use egui::{
    Align, Align2, Color32, FontId, Layout, Rect, Role, Sense, StrokeKind, Ui, UiBuilder, WidgetInfo, vec2,
};

/// The height of the row over a picture, points.
const HEAD: f32 = 28.0;

/// Draws a view; returns the size of its picture in pixels.
pub fn show(cx: &mut PaneContext, ui: &mut Ui, rect: Rect) -> [u32; 2] {
    let (head, body) = rect.split_top_bottom_at_y(rect.top() + HEAD);
    let row = UiBuilder::new().max_rect(head).layout(Layout::left_to_right(Align::Center));
    pane_head::show(cx, &mut ui.new_child(row));
    let size = [body.width(), body.height()].map(|n| (n * ui.pixels_per_point()).round().max(1.0) as u32);
    match cx.shows {
        Shows::Profile => profile(cx, ui, body),
        Shows::Diagram => drawing(cx, ui, body),
        Shows::Contrast if cx.model.document.specimen().stone().is_err() => no_contrast(cx, ui, body),
        shows if shows.is_pane() => liquid_view::show(cx, ui, body),
        _ => scene_view::show(cx, ui, body, size),
    }
    let flow = |flowing| ViewAction::Flowing(cx.pane, flowing);
    cx.actions.push_changed(&cx.model.session.flowing[cx.pane], cx.flowing, flow);
    let edge = ui.visuals().widgets.noninteractive.bg_stroke;
    ui.painter().rect_stroke(body, 4.0, edge, StrokeKind::Inside);
    size
}

/// Draws the stone from the side, whose handles change the cut.
fn profile(cx: &mut PaneContext, ui: &mut Ui, body: Rect) {
    let cut = &cx.model.document.work.design.cut;
    let mut changed = cut.clone();
    ui.painter().rect_filled(body, 4.0, ui.visuals().extreme_bg_color);
    let under = ui.interact(body, ui.scope_id().with("profile"), Sense::click());
    under.widget_info(|| WidgetInfo::labeled(Role::Image, true, "Profile view"));
    match cx.model.document.specimen().stone() {
        Ok(stone) => {
            cx.tools.profiles[cx.pane].show(ui, body, (stone, &cx.model.found_marks()), &mut changed)
        }
        Err(_) => absent(ui, body, "A profile"),
    }
    cx.actions.push_changed(cut, changed, Edit::Cut);
    attend(cx, &under, under.contains_pointer());
}

/// Draws the facet diagram.
fn drawing(cx: &mut PaneContext, ui: &Ui, body: Rect) {
    let response = ui.interact(body, ui.scope_id().with("drawing"), Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, "Facet diagram"));
    let [red, green, blue] = cx.tools.paper.inks.paper;
    ui.painter().rect_filled(body, 4.0, Color32::from_rgb(red, green, blue));
    if cx.model.document.specimen().stone().is_err() {
        absent(ui, body, "A diagram");
    } else if let Some(shown) = cx.shown(Which::Present) {
        let [w, h] = shown.taken.image.size.map(|n| n as f32);
        let scale = (body.width() / w).min(body.height() / h);
        shown.paint(ui.painter(), Rect::from_center_size(body.center(), vec2(w, h) * scale));
    }
    attend(cx, &response, response.hovered());
}

/// Says that the stone has no contrast map.
fn no_contrast(cx: &mut PaneContext, ui: &Ui, body: Rect) {
    let response = ui.interact(body, ui.scope_id().with("picture"), Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, "Contrast map picture"));
    absent(ui, body, "A contrast map");
    attend(cx, &response, response.hovered());
}

/// Draws a text in the place of a picture that only convex stones have.
fn absent(ui: &Ui, body: Rect, what: &str) {
    ui.painter().rect_filled(body, 4.0, ui.visuals().extreme_bg_color);
    let text = format!("{what} can be drawn only of convex stones with flat facets.");
    let (font, colour) = (FontId::proportional(14.0), ui.visuals().weak_text_color());
    ui.painter().text(body.center(), Align2::CENTER_CENTER, text, font, colour);
}
