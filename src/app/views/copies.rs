//! Copies in a render: which one is under the pointer, and moving it by hand.

use super::pane_context::PaneContext;
use super::pane_view::PaneView;
use crate::app::model::action::{Edit, ViewAction};
use crate::app::shows::Shows;
use crate::app::studio::{Shot, Which};
use crate::scene::Pose;
use crate::trace::ray::Camera;
use egui::{CursorIcon, PointerButton, Pos2, Response, Ui};
use glam::DVec2;

/// Moves the copy that the pointer drags; returns whether it drags one.
pub fn carried(cx: &mut PaneContext, ui: &Ui, response: &Response, sight: &PaneView) -> bool {
    let (poses, before) = (&cx.model.document.work.copies.poses, cx.model.session.held);
    let is_start = response.drag_started_by(PointerButton::Primary);
    let can_hold = poses.len() > 1 && cx.shows == Shows::Render;
    let held = match is_start && can_hold && !ui.input(|i| i.modifiers.shift) {
        true => {
            let from = ui.input(|i| i.pointer.press_origin());
            from.and_then(|at| found(cx, sight, at)).map(|(_, copy, _)| (cx.pane, copy))
        }
        false => before,
    };
    let own = held.filter(|(pane, _)| *pane == cx.pane);
    // Undo during a drag may leave fewer copies.
    let pose = own.and_then(|(_, copy)| poses.get(copy)).filter(|_| poses.len() > 1);
    if let (Some((_, copy)), Some(pose)) = (own, pose) {
        let moved = moved(ui, *pose, response, sight);
        cx.actions.push_changed(pose, moved, |pose| Edit::Copy(copy, pose));
        ui.ctx().set_cursor_icon(CursorIcon::Grabbing);
    }
    let ends = own.is_some() && (pose.is_none() || !response.dragged());
    let held = held.filter(|_| !ends);
    cx.actions.push_changed(&before, held, ViewAction::Hold);
    pose.is_some()
}

/// Returns the pose of a copy after a drag.
fn moved(ui: &Ui, pose: Pose, response: &Response, sight: &PaneView) -> Pose {
    let is_start = response.drag_started_by(PointerButton::Primary);
    let way = match (is_start, ui.input(|i| i.pointer.press_origin()), response.interact_pointer_pos()) {
        // The pointer moves some way before that counts as a drag.
        (true, Some(from), Some(at)) => at - from,
        _ => response.drag_delta(),
    };
    let by = way * sight.scale;
    // In perspective, a pixel of the film has another length at the copy's distance.
    let seen = Camera::reaching(&sight.view, 1.0).project(pose.at);
    let larger = seen.map_or(1.0, |(_, larger)| larger);
    let by = DVec2::new(f64::from(by.x), -f64::from(by.y)) * sight.film.pixel / larger;
    Pose { at: pose.at + sight.view.basis().lift(by), ..pose }
}

/// Names the copy and the facet under the pointer in the status line, and outlines the facet.
pub fn hover(cx: &mut PaneContext, ui: &Ui, response: &Response, sight: &PaneView) {
    let Some(at) = response.hover_pos().filter(|_| response.hovered() && !response.dragged()) else { return };
    if cx.model.session.motion.is_on {
        return;
    }
    let Some((shot, copy, facet)) = found(cx, sight, at) else { return };
    sight.outline(ui, shot.specimen.solid(), facet, |corner| shot.copies[copy].place(corner));
    cx.tools.attention.message =
        format!("copy {} of {}: {}", copy + 1, shot.copies.len(), shot.specimen.body.name(facet));
}

/// Returns what a view was last ordered to show, and which copy and facet of it lie at a point of the window.
fn found<'a>(cx: &mut PaneContext<'a>, sight: &PaneView, at: Pos2) -> Option<(&'a Shot, usize, u32)> {
    let own = (cx.pane, Which::Present);
    let (_, shot) = cx.model.session.ordered.shots.iter().find(|(slot, _)| *slot == own)?;
    let probe = cx.tools.probe.of(&shot.specimen);
    let (copy, facet) = probe.among(&shot.copies, &sight.view, &sight.film, sight.pixel(at))?;
    Some((shot, copy, facet))
}
