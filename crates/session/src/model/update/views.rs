//! Changes the views, and the panels beside them.

use crate::model::Model;
use crate::model::action::ViewAction;
use crate::model::task::{CopyOriginal, CopyRequest, Task};
use crate::shows::Shows;
use crate::studio::{Paper, Shot, Which};
use brillianteer_scene::Film;

/// Carries out a change of the views.
pub fn change(model: &mut Model, tasks: &mut Vec<Task>, change: ViewAction) {
    let Model { workspace, session, .. } = model;
    match change {
        ViewAction::Show(pane, shows) => workspace.show(pane, shows),
        ViewAction::Eye(pane, eye) => *workspace.eye_mut(pane) = eye,
        ViewAction::Link(pane, is_linked) => {
            workspace.panes[pane].own = (!is_linked).then_some(workspace.eye);
        }
        ViewAction::Enlarge(pane) => {
            workspace.large = if workspace.large == Some(pane) { None } else { Some(pane) };
        }
        ViewAction::EndPerspective(pane) => workspace.panes[pane].is_near = false,
        ViewAction::Overlay(name) => workspace.overlay = name,
        ViewAction::EndStep => session.views.settle(),
        ViewAction::Distance(distance) => workspace.distance = distance,
        ViewAction::Cutting(progress) => workspace.cutting = progress,
        ViewAction::ByArea(by_area) => workspace.by_area = by_area,
        ViewAction::Panel { side, has_room_for_both, is_open } => {
            workspace.panels.set(side, has_room_for_both, is_open);
        }
        ViewAction::CopyAt(pane, side) => copy_at(model, tasks, pane, side),
        passing => pass(model, passing),
    }
}

/// Changes state that is not kept between starts: pointer, keys, motion and the followed ray.
fn pass(model: &mut Model, change: ViewAction) {
    let session = &mut model.session;
    match change {
        ViewAction::Hover(pane) => session.hovered = pane,
        ViewAction::Tier(place) => session.tier = place,
        ViewAction::PickMeet(pick) => {
            session.tier = pick.as_ref().map(|pick| pick.place).or(session.tier);
            session.picking = pick;
        }
        ViewAction::Finding(place) => session.audit.selected = place,
        ViewAction::Map(options) => session.map.choose(options),
        ViewAction::Tilt(options) => session.tilt.options = options,
        ViewAction::Message(text) => session.message = text,
        ViewAction::Keys(keys) => session.keys = keys,
        ViewAction::Flowing(pane, flowing) => session.flowing[pane] = flowing,
        ViewAction::Advance(seconds) => session.motion.seconds += seconds,
        ViewAction::LiquidLight(from) => session.liquid_light = Some(from),
        ViewAction::Rest => session.motion.rest(),
        ViewAction::Hold(held) => session.held = held,
        ViewAction::Follow(pane, at) => {
            (session.followed.at, session.followed.is_open) = (Some((pane, at)), true);
        }
        ViewAction::LightPath(is_open) => session.followed.is_open = is_open,
        _ => {}
    }
}

/// Orders the picture of a view with `side` pixels along its longer side.
fn copy_at(model: &mut Model, tasks: &mut Vec<Task>, pane: usize, side: u32) {
    let shows = model.workspace.panes[pane].shows;
    let own = (pane, Which::Present);
    let shot =
        model.session.ordered.shots.iter().find(|(slot, _)| *slot == own).map(|(_, shot)| shot.clone());
    let original = match (shows, shot) {
        (Shows::Profile, _) => CopyOriginal::Profile(model.document.named(model.document.specimen())),
        (_, Some(shot)) => CopyOriginal::Shot(Box::new(scaled(shot, side))),
        (_, None) => {
            model.session.notes.say("This view has no picture to copy.");
            return;
        }
    };
    model.session.awaited.copying = Some(shows.name());
    model.session.notes.say(&format!("Making a picture of {side} pixels…"));
    tasks.push(Task::MakeCopy(CopyRequest { original, side }));
}

/// Returns the same shot with `side` pixels along its longer side.
fn scaled(shot: Shot, side: u32) -> Shot {
    let factor = f64::from(side) / f64::from(shot.film.size[0].max(shot.film.size[1]).max(1));
    let film = |film: Film| {
        let size = film.size.map(|n| ((f64::from(n) * factor).round() as u32).max(1));
        Film { size, pixel: film.pixel / factor, ..film }
    };
    Shot { film: film(shot.film), whole: film(shot.whole), paper: Paper::default(), ..shot }
}
