//! Dialogs, which ask or say something.

pub mod about;
pub mod asked_path;
pub mod export_dialog;

use self::about::About;
use self::asked_path::AskedPath;
use self::export_dialog::ExportDialog;
use crate::app::editor::Editor;
use crate::app::model::command::MENUS;
use crate::app::model::document::Document;
use crate::app::model::opening::OpeningPurpose;
use crate::app::panels::proportions::PROPORTIONS;
use crate::app::shows::Shows;
use crate::app::tasks::autosave::{KeptScene, RecoveredWork};
use crate::io::mesh_options::MeshOptions;
use egui::{Context, Grid, Id, Key, Modal, RichText, ScrollArea, Ui};
use std::path::PathBuf;
use std::time::Duration;

/// An action that waits for the answer to a question.
#[derive(Debug, Clone, PartialEq)]
pub enum Then {
    /// Open this file; the options count where it is a mesh.
    Open(PathBuf, MeshOptions),
    /// Begin from a cut that comes with the program.
    Library(String),
    /// Begin a scene of glass that comes with the program.
    Preset(String),
    /// Close the window.
    Close,
}

impl Then {
    /// Opens a file; a mesh is read with the default options.
    pub fn open(path: PathBuf) -> Self {
        Self::Open(path, MeshOptions::default())
    }
}

/// A dialog that is open.
pub enum Dialog {
    /// Asks whether to save work that would be lost; holds the action that waits for the answer.
    Unsaved(Then),
    /// Offers work that a crash left behind.
    Recover(Box<RecoveredWork>),
    /// Says that both the file and the design have changed.
    ChangedOutside,
    /// Asks what to export.
    Export(Box<ExportDialog>),
    /// Asks before copies are lost that were moved and that no cut file holds; holds the action that waits for the answer.
    Moved(Then),
    /// Asks for a path, where the system does not.
    Path(AskedPath),
    /// Lists keys and terms.
    Keys,
    /// Shows what the program is.
    About(Box<About>),
}

impl Dialog {
    /// Returns the export dialog for the open document.
    pub fn export(editor: &mut Editor) -> Self {
        Self::Export(Box::new(ExportDialog::new(editor)))
    }

    /// Returns the export dialog with one view alone selected.
    pub fn export_of(editor: &mut Editor, shows: Shows) -> Self {
        let mut export = ExportDialog::new(editor);
        export.plan.selection.views = vec![shows];
        Self::Export(Box::new(export))
    }

    /// Whether the dialog stays until it is answered, whatever is clicked beside it.
    ///
    /// Escape is an answer: the one that changes nothing.
    pub fn insists(&self) -> bool {
        match self {
            Self::Recover(_) | Self::ChangedOutside => true,
            Self::Export(export) => export.is_busy(),
            Self::Unsaved(_) | Self::Moved(_) | Self::Path(_) | Self::Keys | Self::About(_) => false,
        }
    }
}

/// The space that dialogs leave free above and below, their own margins included, points.
const AROUND_DIALOG: f32 = 48.0;

/// Draws the open dialog, if any.
pub fn show(editor: &mut Editor, ctx: &Context) {
    let Some(mut dialog) = editor.dialog.take() else { return };
    let mut is_open = true;
    let modal = Modal::new(Id::unique("dialog")).show(ctx, |ui| {
        // In a window lower than the dialog, the dialog scrolls.
        let room = ctx.content_rect().height() - AROUND_DIALOG;
        ui.set_max_height(room);
        ScrollArea::vertical().id_salt("dialog").max_height(room).show(ui, |ui| match &mut dialog {
            Dialog::Unsaved(then) => is_open = unsaved(editor, ui, then),
            Dialog::Moved(then) => is_open = moved(editor, ui, then),
            Dialog::Recover(found) => is_open = recover(editor, ui, found),
            Dialog::ChangedOutside => is_open = changed_outside(editor, ui),
            Dialog::Export(export) => is_open = export_dialog::show(editor, ui, export),
            Dialog::Path(asked) => is_open = asked_path::show(editor, ui, asked),
            Dialog::Keys => is_open = keys(ui),
            Dialog::About(about) => is_open = about::show(editor, ui, about),
        });
    });
    let is_escaped = !modal.any_popup_open && ctx.input(|i| i.key_pressed(Key::Escape));
    let is_left = modal.should_close() && !dialog.insists();
    if let Dialog::Export(export) = &dialog
        && is_escaped
        && export.stop()
    {
        // The dialog stays, to say how far the export came.
        editor.dialog = Some(dialog);
    } else if is_open && !is_escaped && !is_left {
        // No other dialog takes its place until this one is answered.
        editor.dialog = Some(dialog);
    } else if is_open && matches!(dialog, Dialog::Path(_)) {
        editor.after_save = None;
    }
}

/// Draws buttons in a row; returns the one that was chosen.
///
/// The first is the one that is meant most often; Return presses it as well.
pub(crate) fn buttons(ui: &mut Ui, names: &[&str]) -> Option<usize> {
    let is_answered = ui.memory(|m| m.focused().is_none()) && ui.input(|i| i.key_pressed(Key::Enter));
    buttons_alone(ui, names).or(is_answered.then_some(0))
}

/// Draws buttons in a row; returns the one that was chosen.
pub(crate) fn buttons_alone(ui: &mut Ui, names: &[&str]) -> Option<usize> {
    ui.add_space(10.0);
    ui.horizontal(|ui| {
        let mut chosen = None;
        for (k, name) in names.iter().enumerate() {
            if ui.button(*name).clicked() {
                chosen = Some(k);
            }
        }
        chosen
    })
    .inner
}

/// Asks before something is left behind: the user can keep it, which calls `keep`, leave it, or cancel.
///
/// Returns whether the dialog stays open.
fn parting(
    editor: &mut Editor,
    ui: &mut Ui,
    then: &Then,
    (heading, text, [kept, left]): (&str, &str, [&str; 2]),
    keep: impl FnOnce(&mut Editor),
) -> bool {
    ui.set_width(380.0);
    ui.heading(heading);
    ui.label(text);
    match buttons(ui, &[kept, left, "Cancel"]) {
        Some(0) => keep(editor),
        Some(1) => editor.then(then.clone()),
        Some(_) => {}
        None => return true,
    }
    false
}

fn unsaved(editor: &mut Editor, ui: &mut Ui, then: &Then) -> bool {
    let text = format!("{} has changes that are not saved yet.", editor.document.title());
    let words = ("Save the changes?", text.as_str(), ["Save", "Don't save"]);
    parting(editor, ui, then, words, |editor| editor.save_then(then.clone()))
}

fn moved(editor: &mut Editor, ui: &mut Ui, then: &Then) -> bool {
    let text =
        "They lie otherwise than they did at first. No cut's file holds them: Export writes them as a scene.";
    parting(editor, ui, then, ("Leave these copies?", text, ["Export…", "Leave them"]), |editor| {
        let mut export = ExportDialog::new(editor);
        export.plan.selection.scene = true;
        editor.dialog = Some(Dialog::Export(Box::new(export)));
    })
}

fn recover(editor: &mut Editor, ui: &mut Ui, found: &RecoveredWork) -> bool {
    ui.set_width(400.0);
    ui.heading("Go on with unsaved work?");
    let of = found.path.as_ref().map_or_else(|| "in no file yet".into(), |p| format!("from {}", p.display()));
    let (name, open) = (&found.design.name, editor.document.title());
    let when = ago(found.when.elapsed().unwrap_or_default());
    ui.label(format!(
        "The program ended before {name}, {of}, was saved. It was last changed {when}. Going on opens it in place of {open}."
    ));
    match buttons(ui, &["Go on", "Later", "Forget it"]) {
        Some(0) => {
            match Document::recovered(found.design.clone(), found.path.clone(), found.mesh.clone()) {
                // The work is autosaved anew before the file that the crash left is removed.
                Ok(mut document) => {
                    let KeptScene { company, behind, behind_mm, strength } = found.around.clone();
                    document.work.company = company;
                    editor.begin(document);
                    let desk = &mut editor.desk;
                    desk.behind = behind.or(desk.behind.take());
                    (desk.behind_mm, desk.strength) = (behind_mm, strength.unwrap_or(1.0));
                    editor.take_note();
                    RecoveredWork::clone(found).forget();
                }
                Err(why) => editor.notes.trouble(why),
            }
            false
        }
        Some(2) => {
            RecoveredWork::clone(found).forget();
            false
        }
        Some(_) => false,
        None => true,
    }
}

/// Says in words how long ago something was.
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

fn changed_outside(editor: &mut Editor, ui: &mut Ui) -> bool {
    ui.set_width(400.0);
    ui.heading("The file has changed");
    ui.label("Another program has changed the file, and here are changes that are not saved.");
    match buttons(ui, &["Keep mine", "Read the file again"]) {
        Some(1) => {
            if let Some(path) = editor.document.path().map(std::path::Path::to_owned) {
                editor.open(&path, OpeningPurpose::Again);
            }
            false
        }
        Some(_) => false,
        None => true,
    }
}

/// The width of the column that says what a key does or a term means, points.
const MEANING: f32 = 450.0;

fn keys(ui: &mut Ui) -> bool {
    ui.set_width(620.0);
    ui.heading("Keys and terms");
    let room = ui.ctx().content_rect().height() - AROUND_DIALOG - 90.0;
    ScrollArea::vertical().max_height(room.min(520.0)).show(ui, |ui| {
        let ctx = ui.ctx().clone();
        Grid::new("keys").num_columns(2).striped(true).max_col_width(MEANING).show(ui, |ui| {
            let mut line = |key: String, what: &str| {
                ui.label(RichText::new(key).monospace());
                ui.add(egui::Label::new(what).wrap());
                ui.end_row();
            };
            line("drag".into(), "Tilts the stone; with Shift or the right button turns it about its axis.");
            line("wheel".into(), "Zooms at the pointer; the middle button moves the picture.");
            line("double click".into(), "Shows one view alone.");
            line("arrows".into(), "Tilt the view that has the focus by 1°, with Shift by 5°; with Alt they move the picture; comma and full stop turn the stone, + and - zoom, Space follows the ray in the middle.");
            line("C held".into(), "Shows the design compared with.");
            line("Z held".into(), "Shows renders in three bands of wavelengths alone.");
            for command in MENUS.iter().flat_map(|m| m.groups.iter()).flat_map(|g| g.iter()) {
                let keys: Vec<String> = command.shortcuts().map(|keys| ctx.format_shortcut(&keys)).collect();
                if !keys.is_empty() {
                    line(keys.join(" or "), command.meaning());
                }
            }
        });
        ui.add_space(10.0);
        Grid::new("terms").num_columns(2).striped(true).max_col_width(MEANING).show(ui, |ui| {
            let shows = Shows::ALL.into_iter().map(|s| (s.name(), s.meaning()));
            for (name, meaning) in shows.chain(PROPORTIONS.iter().map(|p| (p.name, p.meaning))) {
                ui.label(RichText::new(name).strong());
                ui.add(egui::Label::new(meaning).wrap());
                ui.end_row();
            }
        });
    });
    buttons(ui, &["Close"]).is_none()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_told_in_the_largest_unit_that_has_passed() {
        let told = [0, 4, 20, 60, 119, 7200, 200_000].map(|seconds| ago(Duration::from_secs(seconds)));
        assert_eq!(
            told,
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
