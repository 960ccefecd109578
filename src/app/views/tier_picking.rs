//! Picking the corner that a tier meets: the corners are dots in the views, and a click on one makes it the meet.

use super::known_corners::MEETING;
use super::pane_context::PaneContext;
use super::pane_view::PaneView;
use crate::app::model::action::{Edit, NoteAction};
use crate::cut::{Meet, TierChange};
use egui::{Color32, Pos2, Response, Ui};

/// The farthest that the pointer may be from a corner that it picks, points.
const REACH: f32 = 14.0;

/// Lets the pointer pick a corner where the meet of a tier is being picked; returns whether it is.
pub fn picked(cx: &mut PaneContext, ui: &Ui, response: &Response, sight: &PaneView) -> bool {
    let model = cx.model;
    let Some(place) = model.picked_tier() else { return false };
    let Some(known) = cx.tools.tiers.known.of(model.document.specimen(), place) else { return false };
    let seen = known.seen(sight);
    let painter = ui.painter().with_clip_rect(sight.body);
    for (_, at) in &seen {
        painter.circle(*at, 3.0, MEETING, egui::Stroke::new(1.0, Color32::from_black_alpha(200)));
    }
    let pointer = response.hover_pos().filter(|_| response.hovered() && !response.dragged());
    // A click comes with the place where it was made.
    let pointer = response.interact_pointer_pos().filter(|_| response.clicked()).or(pointer);
    let apart = |at: Pos2| pointer.map_or(f32::INFINITY, |pointer| pointer.distance(at));
    let nearest = seen.iter().min_by(|a, b| apart(a.1).total_cmp(&apart(b.1)));
    let Some(&(number, _)) = nearest.filter(|(_, at)| apart(*at) <= REACH) else {
        if pointer.is_some() {
            cx.tools.attention.message = "Click a corner to cut the tier there; Escape ends this.".to_owned();
        }
        return true;
    };
    let (at, meet) = (known.at(&known.corners[number].0), known.meet(number));
    sight.mark_corner(ui, at, MEETING);
    let said = meet.as_ref().map_or("No meet leads the tier to this corner.".to_owned(), Meet::to_string);
    cx.tools.attention.message.clone_from(&said);
    match meet {
        _ if !response.clicked() => {}
        Some(meet) => cx.actions.push(Edit::Tiers(TierChange::Meet(place, Some(meet)))),
        None => cx.actions.push(NoteAction::Say(said)),
    }
    true
}
