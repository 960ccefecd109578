//! The chooser of cuts: begins a design from a cut that comes with the program.

use super::answers::{answer, body, buttons_alone};
use crate::library_cuts::{LibraryCut, library_cuts};
use crate::theme;
use brillianteer_cut::GROUPS;
use brillianteer_session::model::{
    action::{Actions, DialogAction, FileAction},
    dialog::Then,
};
use egui::{Align2, Rect, RichText, Role, Sense, Stroke, StrokeKind, TextStyle, Ui, WidgetInfo, pos2, vec2};

/// The side of a drawing, points.
const DRAWING: f32 = 84.0;

/// The width of a cut with its name, points.
const CARD: f32 = 120.0;

/// Draws the dialog.
pub fn show(actions: &mut Actions, ui: &mut Ui) {
    body(ui, 784.0, |ui| groups(actions, ui));
    answer(actions, [DialogAction::Leave], buttons_alone(ui, &["Cancel"]));
}

/// Draws the cuts, group by group.
fn groups(actions: &mut Actions, ui: &mut Ui) {
    ui.heading("New from a cut");
    let cuts = library_cuts();
    for (group, (name, _)) in GROUPS.iter().enumerate() {
        let members = || cuts.iter().filter(|cut| cut.group == group);
        if members().next().is_none() {
            continue;
        }
        ui.add_space(6.0);
        ui.label(RichText::new(*name).strong());
        ui.horizontal_wrapped(|ui| {
            for cut in members() {
                if card(ui, cut) {
                    actions.push(DialogAction::Leave);
                    actions.push(FileAction::Ask(Then::Library(cut.key.to_owned())));
                }
            }
        });
    }
}

/// Draws a cut with its name; returns whether it was chosen.
fn card(ui: &mut Ui, cut: &LibraryCut) -> bool {
    let (rect, response) = ui.allocate_exact_size(vec2(CARD, DRAWING + 30.0), Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &cut.title));
    if ui.memory(|memory| memory.focused().is_none()) {
        // The first cut takes the focus, from which the keys go on.
        response.request_focus();
    }
    let visuals = ui.style().interact(&response);
    ui.painter().rect_filled(rect, 5.0, visuals.weak_bg_fill);
    let middle = pos2(rect.center().x, rect.top() + 6.0 + DRAWING / 2.0);
    let line = Stroke::new(1.0, ui.visuals().text_color());
    for ends in &cut.lines {
        let ends = ends.map(|end| middle + vec2(end.x as f32, -end.y as f32) * (DRAWING / 2.0));
        ui.painter().line_segment(ends, line);
    }
    name(ui, rect, &cut.title);
    if response.has_focus() {
        let stroke = Stroke::new(1.5, theme::accent(ui.visuals()));
        ui.painter().rect_stroke(rect, 5.0, stroke, StrokeKind::Inside);
    }
    response.on_hover_text(format!("{}\n{}", cut.title, cut.about)).clicked()
}

/// Writes the name of a cut under its drawing.
fn name(ui: &Ui, rect: Rect, title: &str) {
    let font = TextStyle::Small.resolve(ui.style());
    let at = pos2(rect.center().x, rect.bottom() - 11.0);
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    painter.text(at, Align2::CENTER_CENTER, title, font, ui.visuals().text_color());
}
