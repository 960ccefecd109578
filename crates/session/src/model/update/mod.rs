//! Applies actions to a model; this is the only place that changes a [`Model`].

mod begin;
mod commands;
mod companions;
mod dialogs;
mod edits;
mod files;
mod fitting;
mod safe;
mod scene_ring;
mod searching;
#[cfg(test)]
mod tests;
mod views;

use super::Model;
use super::action::{Action, Computed, FrameEnd, NoteAction};
use super::figures::ShownFigures;
use super::session::Session;
use super::task::Task;
use crate::studio::{ShotLight, Which};
use brillianteer_base::Failure;
use std::sync::Arc;

/// Changes a model by an action; returns the tasks that follow from it.
pub fn update(model: &mut Model, action: Action) -> Vec<Task> {
    let mut tasks = vec![];
    let before = scene_unit(model);
    perform(model, &mut tasks, action);
    keep_eyes(model, before);
    searching::follow(model, &mut tasks);
    scene_ring::follow(model, &mut tasks);
    files::wanted(model, &mut tasks);
    want_audit(model, &mut tasks);
    want_sweeps(model);
    tasks
}

/// Returns the number of the document and the unit of its lengths in views, in mm, where it is a scene of several
/// designs; `None` where it is not.
fn scene_unit(model: &Model) -> Option<(u64, f64)> {
    let is_scene = !model.document.work.companions.is_empty();
    is_scene.then(|| (model.session.begun, model.document.specimen().unit_mm()))
}

/// Leaves the eyes where they are in a scene, in mm, where the design has another size now or another stone of the
/// scene is edited.
fn keep_eyes(model: &mut Model, before: Option<(u64, f64)>) {
    if let (Some((document, was)), Some((present, is))) = (before, scene_unit(model))
        && document == present
        && was != is
    {
        model.workspace.eyes_in_unit(was / is);
        model.session.views.in_unit(was / is);
    }
}

fn perform(model: &mut Model, tasks: &mut Vec<Task>, action: Action) {
    match action {
        Action::Do(command) => commands::run(model, tasks, command),
        Action::Edit(edit) => edits::edit(model, edit),
        Action::View(change) => views::change(model, tasks, change),
        Action::File(change) => files::change(model, tasks, change),
        Action::Search(change) => searching::change(model, tasks, change),
        Action::Dialog(answer) => dialogs::answer(model, tasks, answer),
        Action::Note(note) => noted(model, note),
        Action::Computed(computed) => computed_is(model, tasks, computed),
        Action::Frame(end) => end_frame(model, tasks, end),
    }
}

/// Requests the audit of the present stone where the list of the audit is open.
fn want_audit(model: &mut Model, tasks: &mut Vec<Task>) {
    let specimen = model.document.specimen();
    if model.shows_audit() && specimen.stone().is_ok() && model.session.audit.want(specimen) {
        tasks.push(Task::Audit(Arc::clone(specimen)));
    }
}

/// Lets the map and the plot against tilt follow the present stone, where they are in sight.
fn want_sweeps(model: &mut Model) {
    let shows_map = model.shows_map();
    let Model { document, session, .. } = model;
    let specimen = document.specimen();
    if shows_map && specimen.stone().is_ok() {
        session.map.follow(&document.work.design, &mut session.sweeps);
    }
    session.tilt.follow(specimen, &mut session.sweeps);
}

fn noted(model: &mut Model, note: NoteAction) {
    let notes = &mut model.session.notes;
    match note {
        NoteAction::Say(text) => notes.say(&text),
        NoteAction::Trouble(text) => notes.trouble(text),
        NoteAction::Dismiss(which) => notes.dismiss(which),
        NoteAction::DismissAll => (0..notes.troubles().len()).rev().for_each(|which| notes.dismiss(which)),
        NoteAction::List(is_open) => notes.is_open = is_open,
    }
}

fn computed_is(model: &mut Model, tasks: &mut Vec<Task>, computed: Computed) {
    let Model { session, .. } = model;
    match computed {
        Computed::Light(name, loaded) => take_light(session, name, loaded),
        Computed::Figures(which, order, grade, figures) => {
            // The document or the comparison may have ended after the figures were ordered.
            let is_shown = match which {
                Which::Present => order.document == session.begun,
                Which::Other => session.compared.is_some(),
            };
            if is_shown {
                session.measured.figures.insert(which, ShownFigures { order, grade, figures: *figures });
            }
        }
        Computed::Tilts(order, tilts) if order.document == session.begun => {
            session.measured.tilts = Some((order, tilts));
        }
        Computed::Tilts(..) => {}
        Computed::Swept(number, points) => {
            session.map.sweep.take(number, &points);
            session.tilt.sweep.take(number, &points);
        }
        Computed::Audit(specimen, Ok(found)) => session.audit.take(&specimen, found),
        Computed::RingMetal(document, plan, made) => scene_ring::take(model, document, *plan, made),
        Computed::StoneLight(number, light) => fitting::take_light(model, number, light),
        Computed::Goal(path, Ok(goal)) => searching::take_goal(model, &path, *goal),
        Computed::GoalSaved(path, Ok(())) => session.notes.say(&format!("{} saved", path.display())),
        Computed::Goal(_, Err(why)) | Computed::GoalSaved(_, Err(why)) => session.notes.trouble(why),
        Computed::Search(number, event) => searching::take(model, number, event),
        Computed::Audit(_, Err(why)) => session.notes.trouble(why),
        Computed::Copied(made) => {
            let name = session.awaited.copying.take().unwrap_or("The picture");
            match made {
                Ok([width, height]) => {
                    session.notes.say(&format!("{name} copied, {width} × {height} pixels"))
                }
                Err(why) => session.notes.trouble(format!("{name} could not be copied: {why}")),
            }
        }
        Computed::Order(order) => {
            session.ordered = (*order).clone();
            tasks.push(Task::Trace(order));
        }
    }
}

/// Takes a light that has been loaded, or the reason why it could not be. A coarse one is shown until the whole one comes.
fn take_light(session: &mut Session, name: String, loaded: Result<ShotLight, Failure>) {
    let is_coarse = loaded.as_ref().is_ok_and(ShotLight::is_coarse);
    match loaded {
        Ok(light) => {
            light.warnings().iter().for_each(|warning| session.notes.say(warning));
            (session.light.name, session.light.at_hand) = (name.clone(), light);
        }
        Err(why) => session.notes.trouble(format!("{why}; the light stays as it was")),
    }
    if !is_coarse {
        (session.light.tried, session.light.loading) = (name, None);
    }
}

/// Builds the stone of a changed design; where no gesture is going on, the changes become a step of undo.
fn end_frame(model: &mut Model, tasks: &mut Vec<Task>, end: FrameEnd) {
    model.document.update();
    if end.is_gesture {
        return;
    }
    model.session.framing.settle(&model.document);
    model.workspace.eye.settle();
    model.workspace.panes.iter_mut().filter_map(|p| p.own.as_mut()).for_each(super::eye::Eye::settle);
    model.session.views.note(&model.workspace, end.now);
    let has_changed = match model.session.search.running() {
        // All changes by a search become one step when it ends.
        Some(running) => model.document.settle_with(running.before()),
        None => model.document.settle(),
    };
    model.session.notes.settle(has_changed);
    if model.session.safe.noted != model.document.work {
        safe::note(model, tasks);
    }
}
