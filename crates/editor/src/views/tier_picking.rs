//! Picking the corners that a tier meets: the corners are dots in the views. A click on one makes it the meet, or, where two or
//! three are wanted, one of its points. Corners that the tier cannot be cut to are dim, and say why under the pointer.

use super::known_corners::{CornersOfTier, MEETING};
use super::pane_context::PaneContext;
use super::pane_view::PaneView;
use brillianteer_cut::{CornerFault, Meet, TierChange};
use brillianteer_session::model::{
    action::{Edit, NoteAction, ViewAction},
    meet_pick::MeetPick,
};
use egui::{Align2, Color32, FontId, Pos2, Response, Stroke, Ui};
use std::time::Duration;

/// The farthest that the pointer may be from a corner that it picks, points.
const REACH: f32 = 14.0;

/// The radius of the mark of a corner that has been picked, points.
const PICKED: f32 = 9.0;

/// The radius of the mark of a corner that can be picked, points.
const OFFERED: f32 = 3.0;

/// The radius of the mark of a corner that the tier cannot be cut to, points.
const REFUSED: f32 = 2.0;

/// The colour of corners that a tier cannot be cut to.
const DIMMED: Color32 = Color32::from_rgb(120, 120, 120);

/// By how much farther from the pointer a corner may be that is picked before one that the tier cannot be cut to, points.
const BEFORE_REFUSED: f32 = 3.0;

/// The time of a frame in which the meets of corners are sought.
const SEEKING: Duration = Duration::from_millis(6);

/// Lets the pointer pick corners where the meet of a tier is being picked; returns whether it is.
pub fn picked(cx: &mut PaneContext, ui: &Ui, response: &Response, sight: &PaneView) -> bool {
    let model = cx.model;
    let Some(pick) = model.meet_pick() else { return false };
    let Some(known) = cx.tools.tiers.known.of(model.document.specimen(), pick) else { return false };
    if known.seek(SEEKING) {
        ui.ctx().request_repaint();
    }
    let seen = known.seen(sight);
    draw(known, &seen, ui, sight);
    let pointer = response.hover_pos().filter(|_| response.hovered() && !response.dragged());
    // A click comes with the place where it was made.
    let pointer = response.interact_pointer_pos().filter(|_| response.clicked()).or(pointer);
    let Some(number) = pointer.and_then(|pointer| nearest(known, &seen, pointer)) else {
        if pointer.is_some() {
            let hopeless = known.is_hopeless().then_some(" No corner goes with those picked: take one back.");
            cx.tools.attention.message = pick.words() + hopeless.unwrap_or_default();
        }
        return true;
    };
    let fault = known.corners[number].fault().cloned();
    let corner = known.corners[number].corner.at;
    let is_taken_back = pick.corners.contains(&corner);
    sight.mark_corner(
        ui,
        known.at(&known.corners[number].corner),
        if fault.is_some() { DIMMED } else { MEETING },
    );
    if is_taken_back || (!pick.is_last() && fault.is_none()) {
        cx.tools.attention.message = pick.words();
        cx.actions.push_if(response.clicked(), ViewAction::PickMeet(Some(pick.toggled(corner))));
        return true;
    }
    let Some(found) = known.meet(number) else { return true };
    decided(cx, response, pick, found);
    true
}

/// Says where a corner that is pointed at leads the tier, or why it cannot be cut there; a click carries it out.
fn decided(cx: &mut PaneContext, response: &Response, pick: &MeetPick, found: Result<Meet, CornerFault>) {
    match found {
        Ok(meet) => {
            cx.tools.attention.message = meet.to_string();
            if response.clicked() {
                // It takes the place of what was said about earlier clicks.
                let said = NoteAction::Say(format!("The tier follows {meet}."));
                cx.actions.push(Edit::Tiers(TierChange::Meet(pick.place, Some(meet))));
                cx.actions.push(said);
            }
        }
        Err(fault) => {
            let said = format!("Not possible: {fault}.");
            cx.tools.attention.message.clone_from(&said);
            response.clone().on_hover_text_at_pointer(&said);
            cx.actions.push_if(response.clicked(), NoteAction::Say(said));
        }
    }
}

/// Returns the number of the corner that the pointer means: the nearest in reach, those that can be picked before others.
fn nearest(known: &CornersOfTier, seen: &[(usize, Pos2)], pointer: Pos2) -> Option<usize> {
    let apart = |&(number, at): &(usize, Pos2)| {
        let refused = known.corners[number].fault().map_or(0.0, |_| BEFORE_REFUSED);
        pointer.distance(at) + refused
    };
    let in_reach = seen.iter().filter(|(_, at)| pointer.distance(*at) <= REACH);
    in_reach.min_by(|a, b| apart(a).total_cmp(&apart(b))).map(|(number, _)| *number)
}

/// Draws a dot for each corner in sight, a dim one where the tier cannot be cut to it, and numbers those that have been picked.
fn draw(known: &CornersOfTier, seen: &[(usize, Pos2)], ui: &Ui, sight: &PaneView) {
    let (painter, picked) = (ui.painter().with_clip_rect(sight.body), known.picked());
    let rim = Stroke::new(1.0, Color32::from_black_alpha(200));
    let is_refused = |number: &usize| known.corners[*number].fault().is_some();
    for (_, at) in seen.iter().filter(|(number, _)| is_refused(number)) {
        painter.circle(*at, REFUSED, DIMMED, Stroke::new(1.0, Color32::from_black_alpha(120)));
    }
    for (_, at) in seen.iter().filter(|(number, _)| !picked.contains(number) && !is_refused(number)) {
        painter.circle(*at, OFFERED, MEETING, rim);
    }
    for (place, number) in (1..).zip(&picked) {
        let Some((_, at)) = seen.iter().find(|(seen, _)| seen == number) else { continue };
        painter.circle(*at, PICKED, MEETING, rim);
        painter.text(*at, Align2::CENTER_CENTER, place, FontId::proportional(13.0), Color32::BLACK);
    }
}
