//! The search for a better cut: begins and ends it, and lets the document show the best so far.

use super::edits;
use crate::model::Model;
use crate::model::action::SearchAction;
use crate::model::cut_search::{SearchEvent, SearchState};
use crate::model::task::Task;
use brillianteer_cut::Design;
use brillianteer_search::Goal;
use std::path::{Path, PathBuf};

/// Changes the search as the user asks.
pub fn change(model: &mut Model, tasks: &mut Vec<Task>, action: SearchAction) {
    let search = &mut model.session.search;
    match action {
        SearchAction::Form(form) => search.form = *form,
        SearchAction::Start => start(model, tasks),
        SearchAction::Stop => stop(model, tasks),
        SearchAction::Discard => {
            if let Some(before) = search.discard() {
                tasks.push(Task::StopSearch);
                show(model, before);
            }
        }
        SearchAction::Keep => {
            if search.running().is_none() {
                search.state = SearchState::Choosing;
            }
        }
        SearchAction::Undo => undo(model),
    }
}

/// Opens or closes the window of the search. Closing it stops the search, which keeps the best design.
pub fn toggle(model: &mut Model, tasks: &mut Vec<Task>) {
    let search = &mut model.session.search;
    search.is_open = !search.is_open;
    if !search.is_open && search.running().is_some() {
        stop(model, tasks);
    }
}

/// Takes a message of the search of this number; messages of a search that has ended are dropped.
pub fn take(model: &mut Model, number: u64, event: SearchEvent) {
    if let Some(design) = model.session.search.take(number, event) {
        show(model, design);
    }
}

/// Takes the goal of a file into the form.
pub fn take_goal(model: &mut Model, path: &Path, goal: Goal) {
    let missing = model.session.search.form.take(goal, &model.document.work.design.cut);
    if !missing.is_empty() {
        let (file, missing) = (path.display(), missing.join(", "));
        model.session.notes.say(&format!("{file}: the design has no {missing}; the rest is taken"));
    }
}

/// Writes the goal of the form to a file, or reports what the form lacks.
pub fn save_goal(model: &mut Model, tasks: &mut Vec<Task>, path: PathBuf) {
    match model.session.search.form.wanted() {
        Ok(goal) => tasks.push(Task::WriteGoal(path, Box::new(goal))),
        Err(why) => model.session.notes.trouble(format!("{}: the goal was not saved: {why}", path.display())),
    }
}

/// Ends the search where another edit has changed the design, and lets the form follow the design.
pub fn follow(model: &mut Model, tasks: &mut Vec<Task>) {
    let Model { document, session, .. } = model;
    if session.search.running().is_some_and(|running| *running.shown() != document.work.design)
        && let Some(shown) = session.search.interrupt()
    {
        // The changes by the search are a step of their own, before that of the edit.
        document.settle_with(&shown);
        tasks.push(Task::StopSearch);
    }
    if model.shows_search() && model.session.search.running().is_none() {
        model.session.search.follow(&model.document.work.design.cut);
    }
}

/// Ends the search before a step is undone: its changes so far are that step.
pub fn interrupt(model: &mut Model, tasks: &mut Vec<Task>) {
    if model.session.search.interrupt().is_some() {
        tasks.push(Task::StopSearch);
    }
}

/// Forgets the search, because another document begins.
pub fn begin(model: &mut Model, tasks: &mut Vec<Task>) {
    if model.session.search.running().is_some() {
        tasks.push(Task::StopSearch);
    }
    model.session.search.begin();
}

fn start(model: &mut Model, tasks: &mut Vec<Task>) {
    let Model { document, session, .. } = model;
    if session.search.running().is_some()
        || document.specimen().stone().is_err()
        || document.fault().is_some()
    {
        return;
    }
    // Edits before the search are a step of their own.
    document.settle();
    if let Ok(request) = session.search.start(&document.work.design) {
        tasks.push(Task::Search(Box::new(request)));
    }
}

fn stop(model: &mut Model, tasks: &mut Vec<Task>) {
    model.session.search.stop();
    tasks.push(Task::StopSearch);
}

/// Takes back the changes by the search: undoes the last step, or, where the document was edited since, adds a step.
fn undo(model: &mut Model) {
    let SearchState::Ended(ended) = &model.session.search.state else { return };
    let (before, after) = (ended.before.clone(), ended.after.clone());
    model.session.search.state = SearchState::Choosing;
    let document = &mut model.document;
    document.settle();
    if document.work.design != after {
        return;
    }
    if document.step_before().is_some_and(|work| work.design == before) {
        document.undo();
    } else {
        document.work.design = before;
    }
    document.update();
    edits::note_meet_faults(model);
}

/// Replaces the design of the document and updates the views.
fn show(model: &mut Model, design: Design) {
    model.document.work.design = design;
    model.document.update();
    edits::note_meet_faults(model);
}
