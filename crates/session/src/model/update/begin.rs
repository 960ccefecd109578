//! Begins documents: opened files, files read again, and cuts and scenes of the program's library.

use super::{safe, searching};
use crate::model::Model;
use crate::model::audit::SessionAudit;
use crate::model::document::Document;
use crate::model::preset::Preset;
use crate::model::recovery::{KeptCompanions, KeptScene, RecoveredWork};
use crate::model::session::RingMaking;
use crate::model::task::Task;
use crate::model::view_history::{ViewHistory, ViewState};
use crate::shows::Shows;
use crate::studio::Which;
use brillianteer_scene::Companions;

/// How a document takes the place of the one before.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Begun {
    /// With a history of its own.
    Anew,
    /// As a step of undo, which leads back to the document before.
    AsStep,
}

/// Begins to work on another document.
pub fn begin(model: &mut Model, tasks: &mut Vec<Task>, document: Document, begun: Begun) {
    searching::begin(model, tasks);
    let before = std::mem::replace(&mut model.document, document);
    if begun == Begun::AsStep {
        model.document.go_on_from(before, ViewState::of(&model.workspace));
    }
    renew(model);
    model.workspace.begin_views();
    model.session.views = ViewHistory::new(&model.workspace);
    safe::note(model, tasks);
}

/// Ends what the session knows of the document before.
fn renew(model: &mut Model) {
    let Model { document, session, .. } = model;
    session.framing.renew(document);
    session.motion.rest();
    session.held = None;
    session.tier = None;
    session.picking = None;
    session.meet_faults.clear();
    session.ring = RingMaking::default();
    session.audit = SessionAudit::default();
    session.map.begin();
    session.liquid_light = None;
    session.flowing = Default::default();
    session.safe.restoring = None;
    // The figures in the session are those of the stone before.
    session.measured.figures.retain(|which, _| *which != Which::Present);
    session.measured.tilts = None;
    session.begun += 1;
    session.awaited.opening.retain(|opening| opening.request.is_beside());
    session.on_disk = None;
    // The action waited for the document before to be saved.
    session.after_save = None;
    session.notes.clear();
    if session.compared.as_ref().is_some_and(|c| c.is_saved) {
        compare_no_more(model);
    }
}

/// Goes on with a design to which undo or redo has led from that of another origin, in the views that it had.
pub fn come_back(model: &mut Model, tasks: &mut Vec<Task>, left: usize) {
    let views = ViewState::of(&model.workspace);
    if let Some(views) = model.document.exchange_views(left, views) {
        views.lay(&mut model.workspace);
    }
    renew(model);
    model.session.views = ViewHistory::new(&model.workspace);
    safe::note(model, tasks);
}

/// Begins a document that has been read again from the file of the present one; no view moves.
pub fn begin_again(model: &mut Model, tasks: &mut Vec<Task>, mut document: Document) {
    searching::begin(model, tasks);
    let framing = model.session.framing.clone();
    document.take_scene(&model.document);
    model.document = document;
    renew(model);
    model.session.framing = framing;
    safe::note(model, tasks);
    model.session.notes.say("The file was changed by another program and has been read again.");
}

/// Begins a design that was read from a file. A shape of glass begins in the scene that shows it best.
pub fn begin_design(model: &mut Model, tasks: &mut Vec<Task>, mut document: Document) {
    match Preset::of_glass(&document.work.design.cut) {
        Some(preset) => {
            document.begin_with(preset.copies.clone(), Companions::default(), preset.settings());
            begin(model, tasks, document, Begun::Anew);
            show_scene(model, &preset);
        }
        None => begin(model, tasks, document, Begun::Anew),
    }
}

/// Begins a design from a cut that comes with the program; a shape of glass begins as its preset.
pub fn begin_library(model: &mut Model, tasks: &mut Vec<Task>, name: &str, begun: Begun) {
    let document = Document::of_library(name);
    let Some(document) = model.session.notes.ok_or_report(document) else { return };
    if let Some(preset) = Preset::of_glass(&document.work.design.cut) {
        return begin_scene(model, tasks, preset, begun);
    }
    model.workspace.last = None;
    begin(model, tasks, document, begun);
    // A block of rough can be shaped only by its tiers.
    model.workspace.shows_tiers |= model.has_tiers();
}

/// Begins a scene that comes with the program.
pub fn begin_preset(model: &mut Model, tasks: &mut Vec<Task>, name: &str, begun: Begun) {
    let preset = Preset::of_library(name);
    let Some(preset) = model.session.notes.ok_or_report(preset) else { return };
    begin_scene(model, tasks, preset, begun);
}

/// Begins a document with the scene, the settings and the views that were kept of it.
pub fn begin_restored(
    model: &mut Model,
    tasks: &mut Vec<Task>,
    mut document: Document,
    found: RecoveredWork,
) {
    let KeptScene { copies, companions, laid, settings, views } = found.around;
    let mut built =
        |companions: KeptCompanions| model.session.notes.ok_or_report(companions.built()).unwrap_or_default();
    document.begin_with(copies, built(companions), settings);
    if let Some((copies, companions)) = laid {
        document.begin_laid(copies, built(companions));
    }
    begin(model, tasks, document, Begun::Anew);
    match views {
        Some(views) => views.lay(&mut model.workspace),
        None if model.is_scene() => model.workspace.show_scene(None),
        None => {}
    }
    model.session.views = ViewHistory::new(&model.workspace);
}

/// Begins to work on a scene: its design, which is not saved anywhere yet, its copies, its light and its background.
pub fn begin_scene(model: &mut Model, tasks: &mut Vec<Task>, preset: Preset, begun: Begun) {
    let document = Document::new(preset.design.clone(), None);
    let Some(mut document) = model.session.notes.ok_or_report(document) else { return };
    let Preset { copies, companions, .. } = &preset;
    let laid = copies.poses(document.specimen().solid().vertices(), None);
    let is_laid = !companions.is_empty() || laid == copies.poses;
    let layers = if is_laid { "" } else { ", some of them farther back so that none overlap" };
    let shown = if companions.is_empty() {
        format!("renders show all copies{layers}; other views show one")
    } else {
        "renders show the whole scene; other views show the stone that is edited".to_owned()
    };
    document.work.remarks = preset.remarks.clone().into();
    document.begin_with(copies.clone(), companions.clone(), preset.settings());
    document.call_scene(&preset.scene.name);
    model.workspace.last = None;
    begin(model, tasks, document, begun);
    show_scene(model, &preset);
    model.session.notes.say(&format!("{}: {shown}", preset.scene.name));
}

/// Shows a render of the present scene alone, as its file states it: in perspective or not, and moving or not.
fn show_scene(model: &mut Model, preset: &Preset) {
    let reach = model.reach(Shows::Render);
    let distance = preset.scene.angle_of_view.map(|angle| reach / (0.5 * angle).to_radians().tan());
    model.workspace.show_scene(distance);
    model.session.views = ViewHistory::new(&model.workspace);
    model.session.motion.is_on = preset.moves();
}

/// Ends the comparison and drops the other design with its figures.
pub fn compare_no_more(model: &mut Model) {
    model.session.compared = None;
    model.session.measured.figures.retain(|which, _| *which == Which::Present);
}
