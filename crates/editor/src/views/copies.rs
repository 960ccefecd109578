//! The stones in a render: finds the one under the pointer and moves it by drags.

use super::pane_context::PaneContext;
use super::pane_view::PaneView;
use brillianteer_scene::{Companion, Pose, Specimen};
use brillianteer_session::model::{
    Model,
    action::{Edit, ViewAction},
};
use brillianteer_session::shows::Shows;
use brillianteer_session::studio::{Shot, Which};
use brillianteer_trace::ray::Camera;
use egui::{CursorIcon, PointerButton, Pos2, Response, Ui};
use glam::DVec2;
use std::sync::Arc;

/// A stone under the pointer. The copies have the first numbers, and the stones of other designs follow.
struct FoundStone {
    number: usize,
    specimen: Arc<Specimen>,
    pose: Pose,
    facet: u32,
}

/// Moves the stone that the pointer drags; returns whether it drags one.
pub fn carried(cx: &mut PaneContext, ui: &Ui, response: &Response, sight: &PaneView) -> bool {
    let before = cx.model.session.held;
    let is_start = response.drag_started_by(PointerButton::Primary);
    let can_hold = can_hold(cx.model) && cx.shows == Shows::Render;
    let held = if is_start && can_hold && !ui.input(|i| i.modifiers.shift) {
        let from = ui.input(|i| i.pointer.press_origin());
        let found = from.and_then(|at| found(cx, sight, at));
        // A ring holds its stones, so that a drag there turns the view.
        let found = found.filter(|found| cx.model.companions().seat_at(found.pose.at).is_none());
        found.map(|found| (cx.pane, found.number))
    } else {
        before
    };
    let own = held.filter(|(pane, _)| *pane == cx.pane);
    // Undo during a drag may leave fewer stones.
    let pose = own.and_then(|(_, number)| pose(cx.model, number)).filter(|_| can_hold);
    if let (Some((_, number)), Some(pose)) = (own, pose) {
        let moved = moved(ui, pose, response, sight);
        cx.actions.push_changed(&pose, moved, |pose| placed(cx.model, number, pose));
        ui.ctx().set_cursor_icon(CursorIcon::Grabbing);
    }
    let ends = own.is_some() && (pose.is_none() || !response.dragged());
    let held = held.filter(|_| !ends);
    cx.actions.push_changed(&before, held, ViewAction::Hold);
    pose.is_some()
}

/// Returns whether the user can drag stones: only where there is more than one body.
fn can_hold(model: &Model) -> bool {
    let work = &model.document.work;
    work.copies.poses.len() > 1 || !work.companions.is_empty()
}

/// Returns the pose of a stone in renders, in girdle radii of the design.
fn pose(model: &Model, number: usize) -> Option<Pose> {
    let poses = &model.document.work.copies.poses;
    let beside = || model.companions().stones.get(number - poses.len()).map(|stone| stone.pose);
    poses.get(number).map(|pose| model.in_render().after(pose)).or_else(beside)
}

/// Returns the edit that moves a stone to a pose in renders, which is in girdle radii of the design.
fn placed(model: &Model, number: usize, pose: Pose) -> Edit {
    let copies = model.document.work.copies.poses.len();
    let pose = Pose { at: pose.at - model.in_render().at, ..pose };
    match number.checked_sub(copies) {
        None => Edit::Copy(number, pose),
        Some(companion) => {
            let in_mm = Pose { scale: model.document.specimen().unit_mm(), ..Pose::STILL };
            Edit::Companion(companion, in_mm.after(&pose))
        }
    }
}

/// Returns the pose of a stone after a drag.
fn moved(ui: &Ui, pose: Pose, response: &Response, sight: &PaneView) -> Pose {
    let is_start = response.drag_started_by(PointerButton::Primary);
    let way = match (is_start, ui.input(|i| i.pointer.press_origin()), response.interact_pointer_pos()) {
        // The pointer moves some way before that counts as a drag.
        (true, Some(from), Some(at)) => at - from,
        _ => response.drag_delta(),
    };
    let by = way * sight.scale;
    // In perspective, a pixel of the film has another length at the stone's distance.
    let seen = Camera::reaching(&sight.view, 1.0).project(pose.at);
    let larger = seen.map_or(1.0, |(_, larger)| larger);
    let by = DVec2::new(f64::from(by.x), -f64::from(by.y)) * sight.film.pixel / larger;
    Pose { at: pose.at + sight.view.basis().lift(by), ..pose }
}

/// Names the stone and the facet under the pointer in the status line, and outlines the facet.
pub fn hover(cx: &mut PaneContext, ui: &Ui, response: &Response, sight: &PaneView) {
    let Some(at) = response.hover_pos().filter(|_| response.hovered() && !response.dragged()) else { return };
    if cx.model.session.motion.is_on {
        return;
    }
    let Some(FoundStone { number, specimen, pose, facet }) = found(cx, sight, at) else { return };
    sight.outline_face(ui, &specimen.body, facet, |corner| pose.place(corner));
    let (copies, facet) = (cx.model.document.work.copies.poses.len(), specimen.body.name(facet));
    cx.tools.attention.message = if number < copies {
        format!("copy {} of {copies}: {facet}", number + 1)
    } else {
        format!("{}, {}: {facet}", specimen.design.name, specimen.material.name)
    };
}

/// Returns the stone that a view was last ordered to show at a point of the window. Metal hides nothing here.
fn found(cx: &mut PaneContext, sight: &PaneView, at: Pos2) -> Option<FoundStone> {
    let own = (cx.pane, Which::Present);
    let (_, shot) = cx.model.session.ordered.shots.iter().find(|(slot, _)| *slot == own)?;
    let Shot { copies, companions, specimen, .. } = shot;
    let farthest = copies.iter().map(|pose| pose.at.length()).fold(0.0, f64::max);
    let reach = (farthest + specimen.radius).max(companions.reach());
    let ray = Camera::reaching(&sight.view, reach).ray(sight.film.image_from_pixels(sight.pixel(at)));
    let of_copies = cx.tools.probe.of(specimen).among(copies, ray);
    let of_copies = of_copies.map(|(number, facet, distance)| {
        let specimen = Arc::clone(specimen);
        (FoundStone { number, specimen, pose: copies[number], facet }, distance)
    });
    let mut first = of_copies;
    for (place, Companion { specimen, pose }) in companions.stones.iter().enumerate() {
        let hit = cx.tools.probe.of(specimen).among(&[*pose], ray);
        if let Some((_, facet, distance)) = hit
            && first.as_ref().is_none_or(|(_, nearest)| distance < *nearest)
        {
            let number = copies.len() + place;
            first =
                Some((FoundStone { number, specimen: Arc::clone(specimen), pose: *pose, facet }, distance));
        }
    }
    first.map(|(found, _)| found)
}
