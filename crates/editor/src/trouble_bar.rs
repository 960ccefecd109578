//! The bar of errors and warnings: one line over the lower edge of the views, which keep their size. It opens to a list.

use crate::theme;
use brillianteer_session::model::{
    Model,
    action::{Actions, NoteAction},
    notes::{Notes, Problem},
};
use egui::{
    Align, Align2, Area, Color32, Context, Frame, Id, Label, Layout, Order, Rect, RichText, ScrollArea, Ui,
};

/// The greatest part of the views' height that the list of all messages takes.
const MOST_OF_HEIGHT: f32 = 0.6;

/// Draws the bar over the views, if there are errors or warnings.
pub fn show(model: &Model, actions: &mut Actions, ctx: &Context, stage: Rect) {
    let notes = &model.session.notes;
    if notes.troubles().is_empty() {
        return;
    }
    let area = Area::new(Id::unique("troubles")).order(Order::Middle).fixed_pos(stage.left_bottom());
    area.pivot(Align2::LEFT_BOTTOM).constrain(true).show(ctx, |ui| {
        let frame = Frame::popup(ui.style()).inner_margin(6.0);
        frame.show(ui, |ui| {
            ui.set_width(stage.width() - 14.0);
            ui.set_max_height(stage.height());
            if notes.is_open {
                list(notes, actions, ui, stage.height() * MOST_OF_HEIGHT)
            } else {
                last(notes, actions, ui)
            }
        });
    });
}

fn coloured(ui: &Ui, trouble: &Problem) -> RichText {
    let colour: fn(&egui::Visuals) -> Color32 = if trouble.is_error { theme::bad } else { theme::caution };
    RichText::new(&trouble.text).color(colour(ui.visuals()))
}

/// Draws the last message alone, on one line; a button lists all messages, each in full.
fn last(notes: &Notes, actions: &mut Actions, ui: &mut Ui) {
    let (count, Some(trouble)) = (notes.troubles().len(), notes.troubles().last()) else { return };
    ui.horizontal(|ui| {
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if ui.button("Dismiss").on_hover_text("Removes this message.").clicked() {
                actions.push(NoteAction::Dismiss(count - 1));
            }
            let open =
                if count > 1 { format!("Show all {count}") } else { "Show the whole message".to_owned() };
            if ui.button(open).on_hover_text("Lists every message in full.").clicked() {
                actions.push(NoteAction::List(true));
            }
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                ui.add(Label::new(coloured(ui, trouble)).truncate());
            });
        })
    });
}

fn list(notes: &Notes, actions: &mut Actions, ui: &mut Ui, height: f32) {
    ScrollArea::vertical().max_height(height).show(ui, |ui| {
        for (k, trouble) in notes.troubles().iter().enumerate().rev() {
            ui.horizontal_top(|ui| {
                actions.push_if(ui.small_button("Dismiss").clicked(), NoteAction::Dismiss(k));
                ui.add(Label::new(coloured(ui, trouble)).wrap().selectable(true));
            });
        }
    });
    ui.horizontal(|ui| {
        actions.push_if(ui.button("Dismiss all").clicked(), NoteAction::DismissAll);
        actions.push_if(ui.button("Show one line").clicked(), NoteAction::List(false));
    });
}
