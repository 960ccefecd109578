//! Keeps the autosave up to date.

use crate::app::model::Model;
use crate::app::model::recovery::{KeptCompanions, KeptScene, UnsavedWork};
use crate::app::model::task::Task;

/// Writes the present work to the autosave, and stores its exposure and head in the workspace.
///
/// A design that makes no stone does not replace the last design that made one.
pub fn note(model: &mut Model, tasks: &mut Vec<Task>) {
    let Model { document, workspace, session } = model;
    session.safe.noted = document.work.clone();
    (workspace.exposure, workspace.head) = (document.work.exposure, document.work.head);
    if !document.is_changed() && !document.has_moved_copies() {
        return empty(model, tasks);
    }
    if !session.safe.is_on || document.fault().is_some() {
        return;
    }
    session.safe.is_kept = true;
    let around = KeptScene {
        copies: document.work.copies.clone(),
        companions: KeptCompanions::of(&document.work.companions),
        behind: workspace.behind.clone(),
        behind_mm: workspace.behind_mm,
        strength: Some(workspace.strength),
    };
    let path = document.path().map(std::path::Path::to_owned);
    tasks.push(Task::Keep(Box::new(UnsavedWork {
        work: document.work.clone(),
        around,
        path,
        // Of several waiting autosaves only the newest is written, so each carries the order to remove the file of
        // the crash.
        replaces: session.safe.replaces.clone(),
    })));
}

/// Removes the autosave, because the work is saved or discarded, and the autosave of the crash that the work
/// continued.
pub fn empty(model: &mut Model, tasks: &mut Vec<Task>) {
    let safe = &mut model.session.safe;
    if std::mem::take(&mut safe.is_kept) {
        tasks.push(Task::EmptySafe);
    }
    tasks.extend(safe.replaces.take().map(Task::Forget));
}
