//! The dialog that asks for a file by its path, where the system has no file dialog.

use crate::app::dialogs::buttons_alone;
use crate::app::editor::Editor;
use crate::app::tasks::files::Purpose;
use crate::app::theme;
use egui::{Key, RichText, TextEdit, Ui};
use std::path::{Path, PathBuf};

/// A path that the user types.
pub struct AskedPath {
    purpose: Purpose,
    /// The number of the document that the path is for.
    document: u64,
    text: String,
    /// Whether the field has been given the focus.
    has_begun: bool,
    /// Whether anyone has typed: Return does not accept a path that was only suggested.
    is_typed: bool,
}

impl AskedPath {
    /// Asks for a path; the field first holds `begin`, a folder or a file.
    pub fn new(purpose: Purpose, document: u64, begin: &Path) -> Self {
        Self { purpose, document, text: begin.display().to_string(), has_begun: false, is_typed: false }
    }
}

/// Returns the heading of the dialog, and the name of the button that accepts the path.
fn words(purpose: Purpose) -> (&'static str, &'static str) {
    match purpose {
        Purpose::Open => ("Open a cut", "Open"),
        Purpose::SaveAs => ("Save the cut as", "Save"),
        Purpose::Compare => ("Compare with a cut", "Open"),
        Purpose::Light => ("A light or a panorama", "Open"),
        Purpose::Behind => ("A picture behind the stone", "Open"),
        Purpose::Folder => ("A folder for the pictures", "Choose"),
    }
}

/// Draws the dialog; returns whether it stays open.
pub fn show(editor: &mut Editor, ui: &mut Ui, asked: &mut AskedPath) -> bool {
    ui.set_width(460.0);
    let (heading, verb) = words(asked.purpose);
    ui.heading(heading);
    let why = "The system opened no file dialog, which takes a desktop portal such as xdg-desktop-portal: type the path.";
    ui.label(RichText::new(why).weak());
    ui.add_space(6.0);
    let label = ui.label("Path");
    let field = ui.add(TextEdit::singleline(&mut asked.text).desired_width(440.0)).labelled_by(label.id);
    let is_entered = field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
    asked.is_typed |= field.changed();
    if !asked.has_begun || (is_entered && !asked.is_typed) {
        asked.has_begun = true;
        field.request_focus();
    }
    let path = PathBuf::from(asked.text.trim());
    if asked.purpose == Purpose::SaveAs && path.is_file() {
        ui.label(
            RichText::new("It is there already and will be replaced.").color(theme::caution(ui.visuals())),
        );
    } else if asked.purpose != Purpose::SaveAs && !path.exists() {
        ui.label(RichText::new("There is no such file.").weak());
    }
    match buttons_alone(ui, &[verb, "Cancel"]) {
        None if is_entered && asked.is_typed => editor.chosen(asked.purpose, asked.document, path),
        Some(0) => editor.chosen(asked.purpose, asked.document, path),
        Some(_) => editor.after_save = None,
        None => return true,
    }
    false
}
