//! Applies actions to a model; this is the only place that changes a [`Model`].

mod begin;
mod commands;
mod dialogs;
mod edits;
mod files;
mod safe;
#[cfg(test)]
mod tests;
mod views;

use super::Model;
use super::action::{Action, Computed, FrameEnd, NoteAction};
use super::figures::ShownFigures;
use super::task::Task;

/// Changes a model by an action; returns what is to be done outside because of it.
pub fn update(model: &mut Model, action: Action) -> Vec<Task> {
    let mut tasks = match action {
        Action::Do(command) => commands::run(model, command),
        Action::Edit(edit) => edits::edit(model, edit),
        Action::View(change) => views::change(model, change),
        Action::File(change) => files::change(model, change),
        Action::Dialog(answer) => dialogs::answer(model, answer),
        Action::Note(note) => noted(model, note),
        Action::Computed(computed) => computed_is(model, computed),
        Action::Frame(end) => end_frame(model, end),
    };
    tasks.extend(files::wanted(model));
    tasks
}

fn noted(model: &mut Model, note: NoteAction) -> Vec<Task> {
    let notes = &mut model.session.notes;
    match note {
        NoteAction::Say(text) => notes.say(&text),
        NoteAction::Trouble(text) => notes.trouble(text),
        NoteAction::Dismiss(which) => notes.dismiss(which),
        NoteAction::DismissAll => (0..notes.troubles().len()).rev().for_each(|which| notes.dismiss(which)),
        NoteAction::List(is_open) => notes.is_open = is_open,
    }
    vec![]
}

fn computed_is(model: &mut Model, computed: Computed) -> Vec<Task> {
    let session = &mut model.session;
    match computed {
        Computed::Light(name, loaded) => {
            match loaded {
                Ok(lighting) => {
                    lighting.warnings.iter().for_each(|warning| session.notes.say(warning));
                    session.light.lighting = lighting;
                }
                Err(why) => session.notes.trouble(format!("{why}; the light stays as it was")),
            }
            (session.light.name, session.light.loading) = (name, None);
        }
        Computed::Figures(which, order, grade, figures) => {
            session.measured.figures.insert(which, ShownFigures { order, grade, figures: *figures });
        }
        Computed::Tilts(order, tilts) => session.measured.tilts = Some((order, tilts)),
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
            return vec![Task::Trace(order)];
        }
    }
    vec![]
}

/// Builds the stone of a design that was changed; between two gestures, what was changed becomes a step.
fn end_frame(model: &mut Model, end: FrameEnd) -> Vec<Task> {
    model.document.update();
    if end.is_gesture {
        return vec![];
    }
    model.session.framing.settle(model.document.specimen());
    model.workspace.eye.settle();
    model.workspace.panes.iter_mut().filter_map(|p| p.own.as_mut()).for_each(super::eye::Eye::settle);
    model.session.views.note(&model.workspace, end.now);
    model.document.settle();
    match model.session.safe.noted == model.document.work {
        true => vec![],
        false => safe::note(model),
    }
}
