//! Keeps the autosave up to date, and the work with which the next start begins.

use crate::model::Model;
use crate::model::recovery::{KeptCompanions, KeptScene, UnsavedWork};
use crate::model::task::Task;
use crate::model::view_history::ViewState;
use crate::model::work::Work;

/// Writes the present work to the autosave, and keeps it for the next start.
///
/// A design that makes no stone does not replace the last design that made one.
pub fn note(model: &mut Model, tasks: &mut Vec<Task>) {
    model.session.safe.noted = model.document.work.clone();
    keep_last(model, tasks, false);
    let Model { document, session, .. } = &mut *model;
    // Copies that were moved are there at the next start in any case.
    if !document.is_changed() {
        return empty(model, tasks);
    }
    if !session.safe.is_on || document.fault().is_some() {
        return;
    }
    session.safe.is_kept = true;
    // Of several waiting autosaves only the newest is written, so each carries the order to remove the file of the crash.
    let replaces = session.safe.replaces.clone();
    let kept = kept(model, model.document.work.clone());
    tasks.push(Task::Keep(Box::new(UnsavedWork { replaces, ..kept })));
}

/// Keeps the document for the next start: its design as it was last saved or opened, and all around it as it is now. What was kept
/// already is not written again, unless the program ends, because views may have changed.
pub fn keep_last(model: &mut Model, tasks: &mut Vec<Task>, is_end: bool) {
    let Model { document, session, .. } = &mut *model;
    let work = Work { design: document.saved().clone(), ..document.work.clone() };
    if !session.safe.is_on || (!is_end && session.safe.last.as_ref() == Some(&work)) {
        return;
    }
    session.safe.last = Some(work.clone());
    tasks.push(Task::KeepLast(Box::new(kept(model, work))));
}

/// Returns work of the present document in the form in which it is kept.
fn kept(model: &Model, work: Work) -> UnsavedWork {
    let (copies, companions) = model.document.laid();
    let laid = model.document.has_moved_copies().then(|| (copies.clone(), KeptCompanions::of(companions)));
    let around = KeptScene {
        copies: work.copies.clone(),
        companions: KeptCompanions::of(&work.companions),
        laid,
        settings: work.settings.clone(),
        views: Some(ViewState::of(&model.workspace)),
    };
    let path = model.document.path().map(std::path::Path::to_owned);
    UnsavedWork { work, around, path, replaces: None }
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
