//! The dialog that writes files.
use super::editor::Editor;
use egui::Ui;
use std::path::PathBuf;

pub struct ExportDialog {
    pub folder: PathBuf,
}

impl ExportDialog {
    pub fn new(_editor: &Editor) -> Self {
        Self { folder: PathBuf::from("out") }
    }
}

pub fn show(_editor: &mut Editor, _ui: &mut Ui, _export: &mut ExportDialog) -> bool {
    false
}
