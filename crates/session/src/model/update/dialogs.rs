//! Answers to dialogs.

use super::begin::begin_restored;
use super::{files, fitting, safe};
use crate::model::Model;
use crate::model::action::{DialogAction, FileAction};
use crate::model::dialog::Dialog;
use crate::model::document::Document;
use crate::model::export::Selection;
use crate::model::exporting::{ExportEvent, ExportForm, ExportRun};
use crate::model::opening::OpeningPurpose;
use crate::model::plan::export_plan;
use crate::model::recovery::RecoveredWork;
use crate::model::task::Task;

/// Takes an answer to the dialog that is open, or opens one.
pub fn answer(model: &mut Model, tasks: &mut Vec<Task>, answer: DialogAction) {
    match answer {
        DialogAction::Export(view) => {
            export(model, tasks, |selection| {
                if let Some(view) = view {
                    selection.views = vec![view];
                }
            });
        }
        DialogAction::Leave => leave(model, tasks),
        DialogAction::Keep => keep(model, tasks),
        DialogAction::GiveUp => {
            if let Some(Dialog::Unsaved(then) | Dialog::Moved(then)) = model.session.dialog.take() {
                files::then(model, tasks, then);
            }
        }
        DialogAction::Recover => {
            if let Some(Dialog::Recover(found)) = model.session.dialog.take() {
                recover(model, tasks, &found);
            }
        }
        DialogAction::Forget => {
            if let Some(Dialog::Recover(found)) = model.session.dialog.take() {
                tasks.push(Task::Forget(found.file));
            }
        }
        DialogAction::ReadAgain => {
            model.session.dialog = None;
            if let Some(path) = model.document.path().map(std::path::Path::to_owned) {
                files::change(model, tasks, FileAction::Open(path, OpeningPurpose::Again));
            }
        }
        DialogAction::Accept => {
            if let Some(Dialog::Path(form)) = model.session.dialog.take() {
                files::chosen(model, tasks, form.purpose, form.document, form.path());
            }
        }
        DialogAction::Write => write(model, tasks),
        DialogAction::Stop => stop(model, tasks),
        DialogAction::Exported(event) => exported(model, event),
        DialogAction::Fit(_) | DialogAction::Size(_) | DialogAction::Apply => {
            fitting::answer(model, tasks, answer);
        }
        typed => fill_in(model, typed),
    }
}

/// Stores the input of the user in the form of the open dialog.
fn fill_in(model: &mut Model, typed: DialogAction) {
    let session = &mut model.session;
    match (&mut session.dialog, typed) {
        (Some(Dialog::Path(form)), DialogAction::Type(text)) => (form.text, form.is_typed) = (text, true),
        (Some(Dialog::About(about)), DialogAction::AboutPage(page)) => about.page = page,
        (Some(Dialog::About(about)), DialogAction::AboutSearch(text)) => about.sought = text,
        (Some(Dialog::Export(export)), DialogAction::Select(selection)) => {
            session.selection = Selection { scene: false, ..selection.clone() };
            let has_changed = export.plan.selection.sheet != selection.sheet;
            export.plan.selection = selection;
            if has_changed {
                export.plan.list_sheet();
            }
        }
        (Some(Dialog::Export(export)), DialogAction::Folder(folder)) => {
            export.plan.folder = folder;
            export.plan.list_sheet();
        }
        _ => {}
    }
}

/// Closes the dialog without an answer. If the dialog asked for a path, the design is not saved and the action that
/// waited for that is dropped.
fn leave(model: &mut Model, tasks: &mut Vec<Task>) {
    match model.session.dialog.take() {
        Some(Dialog::Path(_)) => model.session.after_save = None,
        Some(Dialog::Export(_)) => tasks.push(Task::StopThumbnails),
        Some(Dialog::Retarget(_)) => tasks.push(Task::StopLight),
        _ => {}
    }
}

fn keep(model: &mut Model, tasks: &mut Vec<Task>) {
    match model.session.dialog.take() {
        Some(Dialog::Unsaved(then)) => files::save_then(model, tasks, then),
        Some(Dialog::Moved(_)) => export(model, tasks, |selection| selection.scene = true),
        other => model.session.dialog = other,
    }
}

fn recover(model: &mut Model, tasks: &mut Vec<Task>, found: &RecoveredWork) {
    let document = Document::recovered(found);
    let Some(document) = model.session.notes.ok_or_report(document) else { return };
    // The work is kept anew before the autosave file of the crash is removed.
    model.session.safe.replaces = Some(found.file.clone());
    begin_restored(model, tasks, document, found.clone());
    safe::note(model, tasks);
}

fn export(model: &mut Model, tasks: &mut Vec<Task>, select: impl FnOnce(&mut Selection)) {
    let mut form = ExportForm { plan: export_plan(model), run: None };
    select(&mut form.plan.selection);
    let plan = Box::new(form.plan.clone());
    model.session.dialog = Some(Dialog::Export(Box::new(form)));
    tasks.push(Task::Thumbnails(plan));
}

fn write(model: &mut Model, tasks: &mut Vec<Task>) {
    let Some(Dialog::Export(export)) = &mut model.session.dialog else { return };
    export.run = Some(ExportRun::of(&export.plan));
    tasks.push(Task::Export(Box::new(export.plan.clone())));
}

fn stop(model: &mut Model, tasks: &mut Vec<Task>) {
    let Some(Dialog::Export(export)) = &mut model.session.dialog else { return };
    let Some(run) = export.run.as_mut().filter(|run| run.end.is_none()) else { return };
    run.is_stopped = true;
    tasks.push(Task::StopExport);
}

fn exported(model: &mut Model, event: ExportEvent) {
    let Some(Dialog::Export(export)) = &mut model.session.dialog else { return };
    if export.plan.selection.scene && matches!(event, ExportEvent::Ended(Ok(()))) {
        model.document.keep_copies();
    }
    if let Some(run) = &mut export.run {
        run.hear(event);
    }
}
