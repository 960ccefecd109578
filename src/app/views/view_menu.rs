//! The menu of a view, which the right mouse button opens.

use crate::app::dialogs::Dialog;
use crate::app::editor::Editor;
use crate::app::menus::entry;
use crate::app::model::command::Command;
use crate::app::shows::Shows;
use crate::app::tasks::copying;
use crate::app::views::pane::enlarge;
use egui::{Response, Ui};

/// The commands that draw something over a picture.
const OVERLAYS: [Command; 6] = [
    Command::Wireframe,
    Command::Facets,
    Command::Bounces,
    Command::Unresolved,
    Command::Total,
    Command::Strongest,
];

/// Opens the menu of a view at a click with the right button; a drag with that button turns the stone.
pub fn attach(editor: &mut Editor, response: &Response, pane: usize) {
    response.context_menu(|ui| {
        // The commands act on the view whose menu this is.
        editor.hovered = pane;
        contents(editor, ui, pane);
    });
}

fn contents(editor: &mut Editor, ui: &mut Ui, pane: usize) {
    let shows = editor.desk.panes[pane].shows;
    ui.menu_button("Show", |ui| {
        for other in Shows::ALL {
            let choice = ui.selectable_label(shows == other, other.name());
            if choice.on_hover_text(other.meaning()).clicked() {
                editor.desk.show(pane, other);
                ui.close();
            }
        }
    });
    if shows.takes_overlay() {
        ui.menu_button("Draw over it", |ui| OVERLAYS.iter().for_each(|&command| entry(editor, ui, command)));
    }
    ui.separator();
    entry(editor, ui, Command::CopyPicture);
    if copying::can_copy(editor, pane) {
        ui.menu_button("Copy picture at size", |ui| {
            for side in copying::SIZES {
                let about =
                    "Pixels of the longer side; the picture is made anew, and copied once it is done.";
                if ui.button(format!("{side} pixels")).on_hover_text(about).clicked() {
                    editor.copy_at(pane, side);
                    ui.close();
                }
            }
        });
    }
    if Shows::EXPORTED.contains(&shows) && ui.button("Export this view…").clicked() {
        editor.dialog = Some(Dialog::export_of(editor, shows));
        ui.close();
    }
    ui.separator();
    entry(editor, ui, Command::ResetView);
    if editor.desk.layout.panes() > 1 {
        let name = if editor.desk.large == Some(pane) { "Show all views" } else { "Show alone" };
        if ui.button(name).clicked() {
            enlarge(editor, pane);
            ui.close();
        }
    }
}
