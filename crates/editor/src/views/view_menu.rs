//! The menu of a view, which the right mouse button opens.

use super::pane_context::PaneContext;
use crate::menus::{choose, menu_button, within_window};
use brillianteer_session::model::{
    action::{DialogAction, ViewAction},
    command::Command,
};
use brillianteer_session::shows::Shows;
use egui::{Response, Ui};

/// The commands that draw an overlay over a picture.
const OVERLAYS: [Command; 6] = [
    Command::Wireframe,
    Command::Facets,
    Command::Bounces,
    Command::Unresolved,
    Command::Total,
    Command::Strongest,
];

/// The sizes at which a picture can be copied: pixels along the longer side.
const SIZES: [u32; 4] = [512, 1024, 2048, 4096];

/// Returns whether a view can be copied at a chosen size; a picture that is looked up is only as large as its view.
fn can_copy(cx: &PaneContext) -> bool {
    let has_facets = cx.model.document.specimen().stone().is_ok();
    Shows::EXPORTED.contains(&cx.shows) && (!cx.shows.needs_facets() || has_facets)
}

/// Handles input that all views share: a double click shows the view alone or among the others, the right button
/// opens its menu (a drag with it turns the stone), and commands act on the view under the pointer.
pub fn attend(cx: &mut PaneContext, response: &Response, is_hovered: bool) {
    response.context_menu(|ui| {
        cx.tools.attention.menu = Some(cx.pane);
        within_window(ui, |ui| contents(cx, ui));
    });
    cx.actions.push_if(response.double_clicked(), ViewAction::Enlarge(cx.pane));
    if is_hovered {
        cx.tools.attention.hovered = Some(cx.pane);
    }
}

fn contents(cx: &mut PaneContext, ui: &mut Ui) {
    let (shows, pane, workspace) = (cx.shows, cx.pane, &cx.model.workspace);
    menu_button(ui, "Show", |ui| {
        for other in Shows::ALL {
            let entry = ui.selectable_label(shows == other, other.name()).on_hover_text(other.meaning());
            choose(cx.actions, ui, &entry, ViewAction::Show(pane, other));
        }
    });
    if shows.takes_overlay() {
        menu_button(ui, "Overlays", |ui| OVERLAYS.iter().for_each(|&command| cx.entry(ui, command)));
    }
    ui.separator();
    cx.entry(ui, Command::CopyPicture);
    if can_copy(cx) {
        menu_button(ui, "Copy picture at size", |ui| sizes(cx, ui));
    }
    if Shows::EXPORTED.contains(&shows) {
        let entry = ui.button("Export this view…");
        choose(cx.actions, ui, &entry, DialogAction::Export(Some(shows)));
    }
    ui.separator();
    cx.entry(ui, Command::ResetView);
    if workspace.layout.panes() > 1 {
        let name = if workspace.large == Some(pane) { "Show all views" } else { "Show alone" };
        let entry = ui.button(name);
        choose(cx.actions, ui, &entry, ViewAction::Enlarge(pane));
    }
}

fn sizes(cx: &mut PaneContext, ui: &mut Ui) {
    for side in SIZES {
        let about = "Pixels of the longer side. The picture is made in this size and copied once it is done.";
        let entry = ui.button(format!("{side} pixels")).on_hover_text(about);
        choose(cx.actions, ui, &entry, ViewAction::CopyAt(cx.pane, side));
    }
}
