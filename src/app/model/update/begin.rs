//! Begins documents: opened files, files read again, and cuts and scenes of the program's library.

use super::{safe, searching};
use crate::app::model::Model;
use crate::app::model::audit::SessionAudit;
use crate::app::model::document::Document;
use crate::app::model::preset::{PRESETS, Preset};
use crate::app::model::session::RingMaking;
use crate::app::model::task::Task;
use crate::app::shows::Shows;
use crate::app::studio::Which;

/// Begins to work on another document, under the present light.
pub fn begin(model: &mut Model, tasks: &mut Vec<Task>, mut document: Document) {
    searching::begin(model, tasks);
    let work = &model.document.work;
    let (light, exposure) = model.workspace.light_after_scene((work.light.clone(), work.exposure));
    document.begin(&light, exposure, work.head);
    model.document = document;
    let Model { document, workspace, session } = model;
    session.framing.renew(document);
    session.motion.rest();
    workspace.rest();
    session.held = None;
    session.tier = None;
    session.picking = None;
    session.meet_faults.clear();
    session.ring = RingMaking::default();
    session.audit = SessionAudit::default();
    session.map.begin();
    // The figures in the session are those of the stone before.
    session.measured.figures.retain(|which, _| *which != Which::Present);
    session.measured.tilts = None;
    session.begun += 1;
    session.awaited.opening.retain(|opening| opening.request.is_beside());
    session.on_disk = None;
    // The action waited for the document before to be saved.
    session.after_save = None;
    // A new stone is first seen face up.
    workspace.face_up();
    session.notes.clear();
    if session.compared.as_ref().is_some_and(|c| c.is_saved) {
        compare_no_more(model);
    }
    safe::note(model, tasks);
}

/// Begins a document that has been read again from the file of the present one; no view moves.
pub fn begin_again(model: &mut Model, tasks: &mut Vec<Task>, mut document: Document) {
    let (workspace, framing) = (model.workspace.clone(), model.session.framing.clone());
    document.take_copies(&model.document);
    begin(model, tasks, document);
    (model.workspace, model.session.framing) = (workspace, framing);
    model.session.notes.say("The file was changed by another program and has been read again.");
}

/// Begins a design from a cut that comes with the program.
pub fn begin_library(model: &mut Model, tasks: &mut Vec<Task>, name: &str) {
    let document = Document::of_library(name);
    let Some(document) = model.session.notes.ok_or_report(document) else { return };
    model.workspace.last = None;
    begin(model, tasks, document);
    // A block of rough can be shaped only by its tiers.
    model.workspace.shows_tiers |= model.has_tiers();
}

/// Begins a scene that comes with the program.
pub fn begin_preset(model: &mut Model, tasks: &mut Vec<Task>, name: &str) {
    let preset = Preset::of_library(name);
    let Some(preset) = model.session.notes.ok_or_report(preset) else { return };
    // The scene is made to be seen as a render.
    begin_scene(model, tasks, preset, Alone::Render);
    model.session.motion.is_on = PRESETS.iter().any(|known| known.name == name && known.moves);
}

/// The view that is shown alone where a scene begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Alone {
    /// The layout stays as it is.
    None,
    /// One view fills the window and shows a render, as long as the scene is open.
    Render,
}

/// Begins to work on a scene: its design, which is not saved anywhere yet, its copies, its light and its backplate.
pub fn begin_scene(model: &mut Model, tasks: &mut Vec<Task>, preset: Preset, alone: Alone) {
    let Preset { design, copies, companions, scene, wavelengths, remarks } = preset;
    let document = Document::new(design, None);
    let Some(mut document) = model.session.notes.ok_or_report(document) else { return };
    let laid = copies.poses(document.specimen().solid().vertices(), None);
    let is_laid = !companions.is_empty() || laid == copies.poses;
    let layers = if is_laid { "" } else { ", some of them farther back so that none overlap" };
    let shown = match companions.is_empty() {
        true => format!("renders show all copies{layers}; other views show one"),
        false => "renders show the whole scene; other views show the stone that is edited".to_owned(),
    };
    (document.work.copies, document.work.companions) = (copies, companions);
    document.work.remarks = remarks.into();
    document.keep_copies();
    document.call_scene(&scene.name);
    model.workspace.last = None;
    let work = &model.document.work;
    let before = model.workspace.light_after_scene((work.light.clone(), work.exposure));
    // The new scene brings a light of its own.
    model.workspace.forget_light();
    // These settings are part of the scene's beginning, and no step of undo.
    model.document.work.exposure = scene.exposure;
    if let Some(light) = scene.light {
        let light = if light.is_file() { std::path::absolute(&light).unwrap_or(light) } else { light };
        model.document.work.light = light.to_string_lossy().into_owned();
    }
    begin(model, tasks, document);
    let reach = model.reach(Shows::Render);
    let Model { workspace, session, document } = model;
    workspace.enter_scene(scene.background.as_ref().map(ToString::to_string), wavelengths);
    if alone == Alone::Render {
        workspace.enlarge_render();
    }
    workspace.light_scene((document.work.light.clone(), document.work.exposure), before);
    (workspace.light_turn, workspace.light_upright) = (scene.light_turn, scene.light_upright);
    workspace.see_under(scene.angle_of_view.map(|angle| reach / (0.5 * angle).to_radians().tan()));
    (workspace.behind_mm, workspace.strength) = (scene.background_distance_mm, scene.strength);
    session.notes.say(&format!("{}: {shown}", scene.name));
}

/// Ends the comparison and drops the other design with its figures.
pub fn compare_no_more(model: &mut Model) {
    model.session.compared = None;
    model.session.measured.figures.retain(|which, _| *which == Which::Present);
}
