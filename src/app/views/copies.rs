//! Copies in a render: which one is under the pointer, and moving it by hand.

use crate::app::editor::Editor;
use crate::app::shows::Shows;
use crate::app::studio::{Shot, Which};
use crate::app::views::pane::{PaneView, rim};
use crate::trace::ray::Camera;
use egui::{CursorIcon, PointerButton, Pos2, Response, Ui};
use glam::{DQuat, DVec2};

/// Moves the copy that the pointer drags; returns whether it drags one.
pub fn carried(editor: &mut Editor, ui: &Ui, pane: usize, response: &Response, sight: &PaneView) -> bool {
    let several = editor.model.document.work.company.poses.len() > 1;
    let is_render = editor.model.workspace.panes[pane].shows == Shows::Render;
    let is_start = response.drag_started_by(PointerButton::Primary);
    if is_start && several && is_render && !ui.input(|i| i.modifiers.shift) {
        let from = ui.input(|i| i.pointer.press_origin());
        let found = from.and_then(|at| found(editor, pane, sight, at));
        editor.model.session.held = found.map(|(_, copy, _)| (pane, copy));
    }
    let Some((_, copy)) = editor.model.session.held.filter(|(held, _)| *held == pane) else { return false };
    let turn = DQuat::from_rotation_z(editor.model.workspace.eye(pane).turn);
    // Undo during a drag may leave fewer copies.
    let Some(pose) = editor.model.document.work.company.poses.get_mut(copy).filter(|_| several) else {
        editor.model.session.held = None;
        return false;
    };
    let way = match (is_start, ui.input(|i| i.pointer.press_origin()), response.interact_pointer_pos()) {
        // The pointer moves some way before that counts as a drag.
        (true, Some(from), Some(at)) => at - from,
        _ => response.drag_delta(),
    };
    let by = way * ui.pixels_per_point();
    // In perspective, a pixel of the film has another length at the copy's distance.
    let seen = Camera::reaching(&sight.view, 1.0).project(turn * pose.at);
    let larger = seen.map_or(1.0, |(_, larger)| larger);
    let by = DVec2::new(f64::from(by.x), -f64::from(by.y)) * sight.film.pixel / larger;
    pose.at += turn.inverse() * sight.view.basis().lift(by);
    ui.ctx().set_cursor_icon(CursorIcon::Grabbing);
    if !response.dragged() {
        editor.model.session.held = None;
    }
    true
}

/// Names the copy and the facet under the pointer in the status line, and outlines the facet.
pub fn hover(editor: &mut Editor, ui: &Ui, pane: usize, response: &Response, sight: &PaneView) {
    let Some(at) = response.hover_pos().filter(|_| response.hovered() && !response.dragged()) else { return };
    if editor.model.session.motion.is_on {
        return;
    }
    let Some((shot, copy, facet)) = found(editor, pane, sight, at) else { return };
    rim(ui, (shot.specimen.solid(), facet), |corner| shot.company[copy].place(corner), sight);
    editor.model.session.message =
        format!("copy {} of {}: {}", copy + 1, shot.company.len(), shot.specimen.body.name(facet));
}

/// Returns what a view was last ordered to show, and which copy and facet of it lie at a point of the window.
fn found(editor: &mut Editor, pane: usize, sight: &PaneView, at: Pos2) -> Option<(Shot, usize, u32)> {
    let own = (pane, Which::Present);
    let shot = editor.model.session.ordered.shots.iter().find(|(slot, _)| *slot == own)?.1.clone();
    let probe = editor.probe.of(&shot.specimen);
    let (copy, facet) = probe.among(&shot.company, &sight.view, &sight.film, sight.pixel(at))?;
    Some((shot, copy, facet))
}
