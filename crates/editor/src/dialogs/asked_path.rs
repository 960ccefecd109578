//! The dialog that asks for a file by its path, where the system has no file dialog.

use super::answers::{body, buttons_alone};
use crate::theme;
use brillianteer_session::model::{
    action::{Actions, DialogAction},
    choosing::Purpose,
    dialog::PathForm,
};
use egui::{Key, RichText, TextEdit, Ui};

/// Returns the name of the button that accepts the path.
fn verb(purpose: Purpose) -> &'static str {
    match purpose {
        Purpose::SaveAs | Purpose::SaveGoal => "Save",
        Purpose::Folder => "Choose",
        _ => "Open",
    }
}

/// Draws the dialog.
pub fn show(actions: &mut Actions, ui: &mut Ui, form: &PathForm) {
    let is_entered = body(ui, 460.0, |ui| contents(actions, ui, form));
    match buttons_alone(ui, &[verb(form.purpose), "Cancel"]) {
        None if is_entered && form.is_typed => actions.push(DialogAction::Accept),
        Some(0) => actions.push(DialogAction::Accept),
        Some(_) => actions.push(DialogAction::Leave),
        None => {}
    }
}

/// Draws the field of the path and what is wrong with the path; returns whether the path was entered.
fn contents(actions: &mut Actions, ui: &mut Ui, form: &PathForm) -> bool {
    ui.heading(form.purpose.heading());
    let why = "The system could not open a file dialog. It needs a desktop portal such as xdg-desktop-portal. Type \
        the path instead.";
    ui.label(RichText::new(why).weak());
    ui.add_space(6.0);
    let label = ui.label("Path");
    let mut text = form.text.clone();
    let field = ui.add(TextEdit::singleline(&mut text).desired_width(440.0)).labelled_by(label.id);
    let is_entered = field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
    actions.push_if(field.changed(), DialogAction::Type(text));
    let has_focus = ui.memory(|m| m.focused().is_some());
    if !(has_focus || is_entered && form.is_typed) {
        field.request_focus();
    }
    let path = form.path();
    if form.purpose.is_new() && path.is_file() {
        ui.label(RichText::new("The file exists and will be replaced.").color(theme::caution(ui.visuals())));
    } else if !form.purpose.is_new() && !path.exists() {
        ui.label(RichText::new("This file does not exist.").weak());
    }
    is_entered
}
