//! The panels beside the views: the design on the left, the figures on the right.
//!
//! Each panel can be folded to a strip. A window with room for one panel alone opens one and folds the other.

use crate::panels::design_panel;
use crate::panels::figures_panel;
use brillianteer_session::model::{
    Model,
    action::{Actions, ViewAction},
    workspace::PanelSide,
};
use egui::{
    Align, Layout, Panel, Rect, Response, RichText, Sense, Stroke, StrokeKind, Ui, Vec2, WidgetInfo, pos2,
    vec2,
};

/// The least and the greatest width of the design panel, points.
const DESIGN: [f32; 2] = [320.0, 460.0];
/// The least and the greatest width of the figures panel, points.
const FIGURES: [f32; 2] = [250.0, 420.0];

/// The width that views keep in any window that has both panels open, points.
const VIEWS: f32 = 320.0;

/// The width of a folded panel, points.
const STRIP: f32 = 30.0;

/// The side of the button that folds a panel, points.
const BUTTON: f32 = 20.0;

/// Draws both panels, each open or folded.
pub fn show(model: &Model, actions: &mut Actions, ui: &mut Ui) {
    let both = has_room_for_both(ui);
    let spare = ui.ctx().content_rect().width() - VIEWS;
    for (side, [least, most], other) in
        [(PanelSide::Design, DESIGN, FIGURES[0]), (PanelSide::Figures, FIGURES, DESIGN[0])]
    {
        if !model.workspace.panels.is_open(side, both) {
            strip(actions, ui, side);
            continue;
        }
        let other = if both { other } else { STRIP };
        let widths = least..=most.min(spare - other).max(least);
        match side {
            PanelSide::Design => design_panel::show(model, actions, ui, widths),
            PanelSide::Figures => figures_panel::show(model, actions, ui, widths),
        }
    }
}

fn has_room_for_both(ui: &Ui) -> bool {
    ui.ctx().content_rect().width() >= DESIGN[0] + FIGURES[0] + VIEWS
}

fn open_or_fold(ui: &Ui, side: PanelSide, is_open: bool) -> ViewAction {
    ViewAction::Panel { side, has_room_for_both: has_room_for_both(ui), is_open }
}

fn name(side: PanelSide) -> &'static str {
    match side {
        PanelSide::Design => "Design",
        PanelSide::Figures => "Figures",
    }
}

/// Draws the first line of an open panel: its name, and the button that folds it.
pub fn head(actions: &mut Actions, ui: &mut Ui, side: PanelSide) {
    ui.add_space(4.0);
    ui.horizontal(|ui| {
        ui.label(RichText::new(format!("{} panel", name(side))).weak().small());
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let response = arrow(ui, side == PanelSide::Design);
            let label = format!("Fold {}", name(side).to_lowercase());
            if named(response, &label, "Folds this panel to a strip; H hides both.").clicked() {
                actions.push(open_or_fold(ui, side, false));
            }
        });
    });
}

/// Draws a folded panel; a click anywhere on it opens it.
fn strip(actions: &mut Actions, ui: &mut Ui, side: PanelSide) {
    let panel = match side {
        PanelSide::Design => Panel::left("design-strip"),
        PanelSide::Figures => Panel::right("figures-strip"),
    };
    panel.resizable(false).exact_size(STRIP).show(ui, |ui| {
        let whole = ui.interact(ui.max_rect(), ui.scope_id().with("strip"), Sense::click());
        let (rect, _) = ui.allocate_exact_size(Vec2::splat(BUTTON), Sense::hover());
        chevron(ui, rect, side == PanelSide::Figures, &whole);
        upright(ui, rect, name(side));
        let label = format!("Open {}", name(side).to_lowercase());
        if named(whole, &label, &format!("Opens the {} panel.", name(side).to_lowercase())).clicked() {
            actions.push(open_or_fold(ui, side, true));
        }
    });
}

fn named(response: Response, label: &str, meaning: &str) -> Response {
    response.widget_info(|| WidgetInfo::labeled(egui::Role::Button, true, label));
    response.on_hover_text(meaning)
}

/// Draws a name that is read from the right, below a button.
fn upright(ui: &Ui, button: Rect, name: &str) {
    let font = egui::TextStyle::Body.resolve(ui.style());
    let galley = ui.painter().layout_no_wrap(name.to_owned(), font, ui.visuals().weak_text_color());
    let at = pos2(button.center().x - galley.size().y / 2.0, button.bottom() + 10.0 + galley.size().x);
    let text = egui::epaint::TextShape::new(at, galley, ui.visuals().weak_text_color());
    ui.painter().add(text.with_angle(-std::f32::consts::FRAC_PI_2));
}

/// Draws a button with an arrow.
fn arrow(ui: &mut Ui, points_left: bool) -> Response {
    let (rect, response) = ui.allocate_exact_size(Vec2::splat(BUTTON), Sense::click());
    chevron(ui, rect, points_left, &response);
    response
}

fn chevron(ui: &Ui, rect: Rect, points_left: bool, response: &Response) {
    let visuals = ui.style().interact(response);
    if response.hovered() {
        ui.painter().rect_filled(rect, 4.0, visuals.weak_bg_fill);
    }
    if response.has_focus() {
        ui.painter().rect_stroke(rect, 4.0, ui.visuals().selection.stroke, StrokeKind::Inside);
    }
    let tip = if points_left { -3.0 } else { 3.0 };
    let points = [vec2(-tip, -5.0), vec2(tip, 0.0), vec2(-tip, 5.0)].map(|by| rect.center() + by);
    ui.painter().line(points.to_vec(), Stroke::new(1.8, visuals.fg_stroke.color));
}
