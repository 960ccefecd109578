//! Answers the dialogs that fit the design to another material, and to a piece of rough or a weight.

use super::edits::edit;
use crate::model::Model;
use crate::model::action::{DialogAction, Edit};
use crate::model::dialog::Dialog;
use crate::model::fitting::{RetargetForm, StoneLight, YieldForm};
use crate::model::task::Task;
use brillianteer_base::Failure;
use std::sync::Arc;

/// Opens the dialog that fits the design to another material.
pub fn open_retarget(model: &mut Model, tasks: &mut Vec<Task>) {
    let form = Box::new(RetargetForm::new(&model.document.work.design));
    ask_light(&form, tasks);
    model.session.dialog = Some(Dialog::Retarget(form));
}

/// Opens the dialog of size and yield.
pub fn open_yield(model: &mut Model) {
    let specimen = model.document.specimen();
    let Ok(stone) = specimen.stone() else { return };
    let form = Box::new(YieldForm::new(specimen, stone));
    model.session.dialog = Some(Dialog::Yield(form));
}

/// Takes the choices or numbers of one of the dialogs, or applies them; other actions change nothing.
pub fn answer(model: &mut Model, tasks: &mut Vec<Task>, answer: DialogAction) {
    let specimen = Arc::clone(model.document.specimen());
    match (&mut model.session.dialog, answer) {
        (Some(Dialog::Retarget(form)), DialogAction::Fit(options)) => {
            form.set(options);
            ask_light(form, tasks);
        }
        (Some(Dialog::Yield(form)), DialogAction::Size(options)) => {
            if let Ok(stone) = specimen.stone() {
                form.set(options, &specimen, stone);
            }
        }
        (_, DialogAction::Apply) => apply(model, tasks),
        _ => {}
    }
}

/// Hands the measured light to the dialog that requested it.
pub fn take_light(model: &mut Model, number: u64, light: Result<Vec<StoneLight>, Failure>) {
    if let Some(Dialog::Retarget(form)) = &mut model.session.dialog {
        form.take_light(number, light);
    }
}

/// Requests the light of the compared stones; where there are none, stops the measurement.
fn ask_light(form: &RetargetForm, tasks: &mut Vec<Task>) {
    tasks.push(form.light_request().map_or(Task::StopLight, |request| Task::MeasureLight(Box::new(request))));
}

/// Changes the design as the open dialog says, and closes it.
fn apply(model: &mut Model, tasks: &mut Vec<Task>) {
    match model.session.dialog.take() {
        Some(Dialog::Retarget(form)) => {
            tasks.push(Task::StopLight);
            if let Ok(found) = form.found {
                edit(model, Edit::Fitted(Box::new(found.design)));
            }
        }
        Some(Dialog::Yield(form)) => {
            if let Ok(found) = form.found {
                edit(model, Edit::Diameter(found.diameter_mm));
            }
        }
        other => model.session.dialog = other,
    }
}
