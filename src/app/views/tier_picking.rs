//! Picking the corners that a tier meets: the corners are dots in the views. A click on one makes it the meet, or, where two or
//! three are wanted, one of its points.

use super::known_corners::{CornersOfTier, MEETING};
use super::pane_context::PaneContext;
use super::pane_view::PaneView;
use crate::app::model::action::{Edit, NoteAction, ViewAction};
use crate::app::model::meet_pick::MeetPick;
use crate::cut::{Meet, TierChange};
use egui::{Align2, Color32, FontId, Pos2, Response, Stroke, Ui};

/// The farthest that the pointer may be from a corner that it picks, points.
const REACH: f32 = 14.0;

/// The radius of the mark of a corner that has been picked, points.
const PICKED: f32 = 9.0;

/// Lets the pointer pick corners where the meet of a tier is being picked; returns whether it is.
pub fn picked(cx: &mut PaneContext, ui: &Ui, response: &Response, sight: &PaneView) -> bool {
    let model = cx.model;
    let Some(pick) = model.meet_pick() else { return false };
    let Some(known) = cx.tools.tiers.known.of(model.document.specimen(), pick) else { return false };
    let seen = known.seen(sight);
    draw(known, &seen, ui, sight);
    let pointer = response.hover_pos().filter(|_| response.hovered() && !response.dragged());
    // A click comes with the place where it was made.
    let pointer = response.interact_pointer_pos().filter(|_| response.clicked()).or(pointer);
    let apart = |at: Pos2| pointer.map_or(f32::INFINITY, |pointer| pointer.distance(at));
    let nearest = seen.iter().min_by(|a, b| apart(a.1).total_cmp(&apart(b.1)));
    let Some(&(number, _)) = nearest.filter(|(_, at)| apart(*at) <= REACH) else {
        if pointer.is_some() {
            cx.tools.attention.message = pick.words();
        }
        return true;
    };
    let corner = known.corners[number].0.at;
    sight.mark_corner(ui, known.at(&known.corners[number].0), MEETING);
    if !pick.is_last() || pick.corners.contains(&corner) {
        cx.tools.attention.message = pick.words();
        cx.actions.push_if(response.clicked(), ViewAction::PickMeet(Some(pick.toggled(corner))));
        return true;
    }
    let meet = known.meet(number);
    let said = meet.as_ref().map_or_else(|| no_meet(pick), Meet::to_string);
    cx.tools.attention.message.clone_from(&said);
    match meet {
        _ if !response.clicked() => {}
        Some(meet) => {
            cx.actions.push(Edit::Tiers(TierChange::Meet(pick.place, Some(meet))));
            // It takes the place of what was said about earlier clicks.
            cx.actions.push(NoteAction::Say(format!("The tier follows {said}.")));
        }
        None => cx.actions.push(NoteAction::Say(said)),
    }
    true
}

/// Draws a dot for each corner in sight, and numbers those that have been picked.
fn draw(known: &CornersOfTier, seen: &[(usize, Pos2)], ui: &Ui, sight: &PaneView) {
    let (painter, picked) = (ui.painter().with_clip_rect(sight.body), known.picked());
    let rim = Stroke::new(1.0, Color32::from_black_alpha(200));
    for (_, at) in seen.iter().filter(|(number, _)| !picked.contains(number)) {
        painter.circle(*at, 3.0, MEETING, rim);
    }
    for (place, number) in (1..).zip(&picked) {
        let Some((_, at)) = seen.iter().find(|(seen, _)| seen == number) else { continue };
        painter.circle(*at, PICKED, MEETING, rim);
        painter.text(*at, Align2::CENTER_CENTER, place, FontId::proportional(13.0), Color32::BLACK);
    }
}

fn no_meet(pick: &MeetPick) -> String {
    match pick.wanted {
        ..=1 => "No meet leads the tier to this corner.".to_owned(),
        _ => "No meet leads the tier through these corners; choose another, or click a picked one to take it back.".to_owned(),
    }
}
