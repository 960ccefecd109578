//! The hand on a tier in a view: a facet of the selected tier is dragged, and the tier moves along its normal. It stops at
//! corners that it nearly passes through, which become its meet.

use super::known_corners::{CornersOfTier, MEETING};
use super::pane_context::PaneContext;
use super::pane_view::PaneView;
use super::tier_drag::TierDrag;
use brillianteer_cut::{Cut, Meet};
use brillianteer_session::model::{action::Edit, command::Command};
use brillianteer_session::shows::Shows;
use brillianteer_trace::ray::Camera;
use egui::{CursorIcon, Key, PointerButton, Pos2, Response, Ui, Vec2, vec2};
use glam::DVec3;

/// A facet whose normal looks shorter than this part of its length is dragged up and down: nearly all of the way along its
/// normal would be a way toward the eye.
const LEAST_LENGTH: f32 = 0.3;

/// The part of a normal whose ends are projected, girdle radii.
const STEP: f64 = 0.25;

/// Moves the selected tier by the facet that the pointer drags; returns whether the pointer holds one.
pub fn held(cx: &mut PaneContext, ui: &Ui, response: &Response, sight: &PaneView) -> bool {
    if cx.tools.tiers.drag.is_none() && response.drag_started_by(PointerButton::Primary) {
        cx.tools.tiers.drag = begun(cx, ui, sight);
    }
    let Some(mut drag) = cx.tools.tiers.drag.take_if(|drag| drag.pane == cx.pane) else { return false };
    if drag.document != cx.model.session.begun {
        return false;
    }
    let is_down = response.dragged();
    if !is_down && !response.drag_stopped() {
        // The button was released while the view was not shown.
        return false;
    }
    follow(cx, ui, &mut drag);
    draw(cx, ui, sight, &drag);
    cx.tools.tiers.drag = is_down.then_some(drag);
    true
}

/// Returns the facet of the selected tier at a point of the window, by the places of tier and facet, and the point on it.
fn selected_at(cx: &mut PaneContext, sight: &PaneView, at: Pos2) -> Option<((usize, usize), DVec3, DVec3)> {
    let model = cx.model;
    let Cut::Tiers(tiers) = &model.document.work.design.cut else { return None };
    let can_hold = model.shows_tiers()
        && cx.shows != Shows::Refraction
        && model.meet_pick().is_none()
        && !model.document.shows_last_possible();
    let selected = model.session.tier.filter(|_| can_hold)?;
    let specimen = model.document.specimen();
    let (facet, point) = cx.tools.probe.of(specimen).meet(&sight.view, sight.image(at))?;
    let source = specimen.stone().ok()?.polytope.facets()[facet].source;
    let found = tiers.facet_of_plane(source).filter(|(place, _)| *place == selected)?;
    Some((found, point, specimen.solid().normal(facet as u32, point)))
}

/// Begins a drag where the pointer was pressed on a facet of the selected tier, without keys that turn the stone.
fn begun(cx: &mut PaneContext, ui: &Ui, sight: &PaneView) -> Option<TierDrag> {
    let (pressed, modifiers) = ui.input(|i| (i.pointer.press_origin(), i.modifiers));
    if modifiers.shift || modifiers.alt {
        return None;
    }
    let pressed = pressed?;
    let (facet, point, normal) = selected_at(cx, sight, pressed)?;
    let Cut::Tiers(tiers) = &cx.model.document.work.design.cut else { return None };
    let (way, per_point) = way(sight, point, normal)?;
    let specimen = cx.model.document.specimen();
    let mut corners = CornersOfTier::of(specimen, facet.0)?;
    corners.corners.retain(|known| known.corner.facet == facet.1);
    let largest = tiers.tiers.iter().map(|tier| tier.distance.abs()).fold(0.0, f64::max);
    Some(TierDrag {
        pane: cx.pane,
        document: cx.model.session.begun,
        facet,
        pressed,
        way,
        per_point: per_point / specimen.frame.scale,
        start: [tiers.tiers[facet.0].distance.abs(), largest],
        corners,
        stopped: None,
        is_over: false,
    })
}

/// Returns the direction in the window that moves a point outward along a normal, and the length in girdle radii that one point
/// of the window stands for.
fn way(sight: &PaneView, point: DVec3, normal: DVec3) -> Option<(Vec2, f64)> {
    let camera = Camera::reaching(&sight.view, 1.0);
    let (from, larger) = camera.project(point)?;
    let (to, _) = camera.project(point + STEP * normal)?;
    let way = (sight.point(to) - sight.point(from)) / STEP as f32;
    let whole = larger as f32 / (sight.film.pixel as f32 * sight.scale);
    if !(way.length() > 0.0 || whole > 0.0) {
        return None;
    }
    Some(if way.length() < LEAST_LENGTH * whole {
        (vec2(0.0, -1.0), 1.0 / f64::from(whole))
    } else {
        (way.normalized(), 1.0 / f64::from(way.length()))
    })
}

/// Moves the tier to where the pointer is; Escape takes the whole drag back.
fn follow(cx: &mut PaneContext, ui: &Ui, drag: &mut TierDrag) {
    let (at, is_free, is_escaped) =
        ui.input(|i| (i.pointer.interact_pos(), i.modifiers.command, i.key_pressed(Key::Escape)));
    if is_escaped && !drag.is_over {
        cx.actions.push_if(cx.model.document.has_unsettled(), Command::Undo);
        drag.is_over = true;
    }
    let (Cut::Tiers(tiers), Some(at), false) = (&cx.model.document.work.design.cut, at, drag.is_over) else {
        return;
    };
    let Some(tier) = tiers.tiers.get(drag.facet.0) else { return };
    if let Some(change) = drag.change(tier, at, is_free) {
        cx.actions.push(Edit::Tiers(change));
    }
}

/// Rings the corner at which the facet has stopped, and says in the status line where the tier is.
fn draw(cx: &mut PaneContext, ui: &Ui, sight: &PaneView, drag: &TierDrag) {
    let document = &cx.model.document;
    ui.ctx().set_cursor_icon(CursorIcon::Grabbing);
    let Cut::Tiers(tiers) = &document.work.design.cut else { return };
    let Some(tier) = tiers.tiers.get(drag.facet.0) else { return };
    let mm = document.specimen().design_unit_mm() * tier.distance.abs();
    let stopped = drag.stopped.filter(|_| !drag.is_over).and_then(|k| drag.corners.corners.get(k));
    if let Some(known) = stopped {
        sight.mark_corner(ui, document.specimen().frame.place(known.corner.at), MEETING);
    }
    let there = match stopped {
        Some(_) => tier.meet.as_ref().map_or("at a corner that no meet names".to_owned(), Meet::to_string),
        None => "drag to a corner to meet it, with Ctrl past it".to_owned(),
    };
    cx.tools.attention.message =
        format!("{}: {mm:.3} mm from the origin · {there}", tiers.names()[drag.facet.0]);
}

/// Shows by the pointer that the facet under it can be dragged.
pub fn hint(cx: &mut PaneContext, ui: &Ui, sight: &PaneView, at: Pos2) {
    if selected_at(cx, sight, at).is_some() {
        ui.ctx().set_cursor_icon(CursorIcon::Grab);
    }
}
