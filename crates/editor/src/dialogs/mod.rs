//! Draws the dialogs.

pub mod about;
mod answers;
pub mod asked_path;
mod cut_chooser;
pub mod export_dialog;
mod export_sheet;
mod retarget_dialog;
mod yield_dialog;

use super::shortcuts::shortcuts;
use answers::{answer, body, body_of, buttons};
use brillianteer_cut::FAMILIES;
use brillianteer_session::model::{
    Model,
    action::{Actions, DialogAction},
    command::Command,
    dialog::Dialog,
    recovery::RecoveredWork,
};
use brillianteer_session::shows::Shows;
use egui::{Context, Grid, Id, Key, Modal, RichText, TextureHandle, Ui};
use std::collections::HashMap;
use std::time::Duration;

/// Draws the open dialog, if any; `thumbnails` are the small pictures of the export dialog.
pub fn show(model: &Model, thumbnails: &HashMap<Shows, TextureHandle>, actions: &mut Actions, ctx: &Context) {
    let Some(dialog) = &model.session.dialog else { return };
    let modal = Modal::new(Id::unique("dialog")).show(ctx, |ui| match dialog {
        Dialog::Unsaved(_) => unsaved(model, actions, ui),
        Dialog::Moved(_) => moved(actions, ui),
        Dialog::Recover(found) => recover(model, actions, ui, found),
        Dialog::ChangedOutside => changed_outside(actions, ui),
        Dialog::Export(export) => export_dialog::show(export, thumbnails, actions, ui),
        Dialog::Path(form) => asked_path::show(actions, ui, form),
        Dialog::Retarget(form) => retarget_dialog::show(form, actions, ui),
        Dialog::Yield(form) => yield_dialog::show(model, form, actions, ui),
        Dialog::Cuts => cut_chooser::show(actions, ui),
        Dialog::Keys => keys(actions, ui),
        Dialog::About(about) => about::show(about, actions, ui),
    });
    let is_escaped = !modal.any_popup_open && ctx.input(|i| i.key_pressed(Key::Escape));
    let is_left = modal.should_close() && !dialog.insists();
    match dialog {
        // The dialog stays open, because it shows how far the export came.
        Dialog::Export(export) if is_escaped && export.is_busy() => actions.push(DialogAction::Stop),
        _ if is_escaped || is_left => actions.push(DialogAction::Leave),
        _ => {}
    }
}

/// Asks before something is lost: the user can keep it, discard it, or cancel.
fn parting(actions: &mut Actions, ui: &mut Ui, heading: &str, text: &str, [kept, left]: [&str; 2]) {
    body(ui, 380.0, |ui| {
        ui.heading(heading);
        ui.label(text);
    });
    let answers = [DialogAction::Keep, DialogAction::GiveUp, DialogAction::Leave];
    answer(actions, answers, buttons(ui, &[kept, left, "Cancel"]));
}

fn unsaved(model: &Model, actions: &mut Actions, ui: &mut Ui) {
    let text = format!("{} has changes that are not saved yet.", model.document.title());
    parting(actions, ui, "Save the changes?", &text, ["Save", "Don't save"]);
}

fn moved(actions: &mut Actions, ui: &mut Ui) {
    let text = "The copies have been moved, and a cut file cannot hold their places. Export them as a scene to keep them.";
    parting(actions, ui, "Discard the moved copies?", text, ["Export…", "Discard"]);
}

fn recover(model: &Model, actions: &mut Actions, ui: &mut Ui, found: &RecoveredWork) {
    let of =
        found.path.as_ref().map_or_else(|| "not in a file yet".into(), |p| format!("from {}", p.display()));
    let (name, open) = (&found.design.name, model.document.title());
    let when = ago(found.when.elapsed().unwrap_or_default());
    body(ui, 400.0, |ui| {
        ui.heading("Recover unsaved work?");
        ui.label(format!(
            "The program ended before {name} ({of}) was saved. It was last changed {when}. If you recover it, it opens \
                in place of {open}."
        ));
    });
    let answers = [DialogAction::Recover, DialogAction::Leave, DialogAction::Forget];
    answer(actions, answers, buttons(ui, &["Recover", "Later", "Discard"]));
}

/// Returns in words how long ago something happened.
fn ago(since: Duration) -> String {
    let counted = |count: u64, unit: &str| format!("{count} {unit}{} ago", if count == 1 { "" } else { "s" });
    match since.as_secs() {
        0..5 => "just now".to_owned(),
        seconds @ 5..60 => counted(seconds, "second"),
        seconds @ 60..3600 => counted(seconds / 60, "minute"),
        seconds @ 3600..172_800 => counted(seconds / 3600, "hour"),
        seconds => counted(seconds / 86_400, "day"),
    }
}

fn changed_outside(actions: &mut Actions, ui: &mut Ui) {
    body(ui, 400.0, |ui| {
        ui.heading("The file has changed");
        ui.label("Another program has changed the file, and you have unsaved changes.");
    });
    let answers = [DialogAction::Leave, DialogAction::ReadAgain];
    answer(actions, answers, buttons(ui, &["Keep my changes", "Reload the file"]));
}

/// The width of the column with the meanings of keys and terms, points.
const MEANING: f32 = 430.0;

/// The greatest height of the list of keys and terms, points.
const KEYS: f32 = 560.0;

fn keys(actions: &mut Actions, ui: &mut Ui) {
    body_of(ui, 620.0, KEYS, |ui| {
        ui.heading("Keys and terms");
        let ctx = ui.ctx().clone();
        Grid::new("keys").num_columns(2).striped(true).max_col_width(MEANING).show(ui, |ui| {
            let mut line = |key: String, what: &str| {
                ui.label(RichText::new(key).monospace());
                ui.add(egui::Label::new(what).wrap());
                ui.end_row();
            };
            line("drag".into(), "Tilts the stone; with Shift or the right button turns it about its axis.");
            line("wheel".into(), "Zooms at the pointer; the middle button moves the picture.");
            line("double click".into(), "Shows one view alone. On the name or the slider of a row, it sets the row's default.");
            line("Tab".into(), "Goes from number to number. A digit over a slider begins its number, Return takes it, and \
                Escape restores the one before. Space holds a number that has a padlock.");
            line("arrows".into(), "Tilt the view that has the focus by 1°, with Shift by 5°. With Alt they move the \
                picture. Comma and full stop turn the stone, + and - zoom, and Space follows the ray in the middle.");
            line("C held".into(), "Shows the other design of a comparison.");
            line("Z held".into(), "Shows renders in only three bands of wavelengths.");
            for command in Command::ALL {
                let keys: Vec<String> = shortcuts(command).map(|keys| ctx.format_shortcut(&keys)).collect();
                if !keys.is_empty() {
                    line(keys.join(" or "), command.meaning());
                }
            }
        });
        ui.add_space(10.0);
        Grid::new("terms").num_columns(2).striped(true).max_col_width(MEANING).show(ui, |ui| {
            let shows = Shows::ALL.into_iter().map(|s| (s.name(), s.meaning()));
            let mut terms: Vec<_> = shows.collect();
            for row in FAMILIES.into_iter().flat_map(|family| family.proportions) {
                if !terms.contains(&(row.name, row.meaning)) {
                    terms.push((row.name, row.meaning));
                }
            }
            for (name, meaning) in terms {
                ui.label(RichText::new(name).strong());
                ui.add(egui::Label::new(meaning).wrap());
                ui.end_row();
            }
        });
    });
    answer(actions, [DialogAction::Leave], buttons(ui, &["Close"]));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_told_in_the_largest_unit_that_has_passed() {
        let texts = [0, 4, 20, 60, 119, 7200, 200_000].map(|seconds| ago(Duration::from_secs(seconds)));
        assert_eq!(
            texts,
            [
                "just now",
                "just now",
                "20 seconds ago",
                "1 minute ago",
                "1 minute ago",
                "2 hours ago",
                "2 days ago"
            ]
        );
    }
}
