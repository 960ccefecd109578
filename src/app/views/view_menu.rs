//! The menu of a view, which the right mouse button opens.

use crate::app::editor::Editor;
use crate::app::menus::entry;
use crate::app::model::action::{DialogAction, ViewAction};
use crate::app::model::command::Command;
use crate::app::shows::Shows;
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

/// The sizes at which a picture can be copied: pixels along the longer side.
pub const SIZES: [u32; 4] = [512, 1024, 2048, 4096];

/// Whether a view can be copied at a chosen size; a picture that is looked up is only as large as its view.
fn can_copy(editor: &Editor, pane: usize) -> bool {
    let shows = editor.model.workspace.panes[pane].shows;
    let needs_facets = matches!(shows, Shows::Profile | Shows::Diagram);
    Shows::EXPORTED.contains(&shows) && (!needs_facets || editor.model.document.specimen().stone().is_ok())
}

/// Opens the menu of a view at a click with the right button; a drag with that button turns the stone.
pub fn attach(editor: &mut Editor, response: &Response, pane: usize) {
    response.context_menu(|ui| {
        // The commands act on the view whose menu this is.
        editor.model.session.hovered = pane;
        contents(editor, ui, pane);
    });
}

fn contents(editor: &mut Editor, ui: &mut Ui, pane: usize) {
    let shows = editor.model.workspace.panes[pane].shows;
    ui.menu_button("Show", |ui| {
        for other in Shows::ALL {
            let choice = ui.selectable_label(shows == other, other.name());
            if choice.on_hover_text(other.meaning()).clicked() {
                editor.model.workspace.show(pane, other);
                ui.close();
            }
        }
    });
    if shows.takes_overlay() {
        ui.menu_button("Draw over it", |ui| {
            OVERLAYS.iter().for_each(|&command| entry(&editor.model, &mut editor.actions, ui, command))
        });
    }
    ui.separator();
    entry(&editor.model, &mut editor.actions, ui, Command::CopyPicture);
    if can_copy(editor, pane) {
        ui.menu_button("Copy picture at size", |ui| {
            for side in SIZES {
                let about =
                    "Pixels of the longer side; the picture is made anew, and copied once it is done.";
                if ui.button(format!("{side} pixels")).on_hover_text(about).clicked() {
                    editor.actions.push(ViewAction::CopyAt(pane, side));
                    ui.close();
                }
            }
        });
    }
    if Shows::EXPORTED.contains(&shows) && ui.button("Export this view…").clicked() {
        editor.actions.push(DialogAction::Export(Some(shows)));
        ui.close();
    }
    ui.separator();
    entry(&editor.model, &mut editor.actions, ui, Command::ResetView);
    if editor.model.workspace.layout.panes() > 1 {
        let name = if editor.model.workspace.large == Some(pane) { "Show all views" } else { "Show alone" };
        if ui.button(name).clicked() {
            enlarge(editor, pane);
            ui.close();
        }
    }
}
