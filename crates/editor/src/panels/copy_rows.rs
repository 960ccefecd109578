//! Rows for presets, copies, their motion, and the smoothing of moving edges. They are shown for glass shapes; gems
//! can have them too.

use crate::panels::rows::{ANY, ChoiceRow, NUMBER, Row, control_width, field_width, named, skip_name};
use brillianteer_scene::{MOST_COPIES, Movement, Smoothing, has_wave};
use brillianteer_session::model::{
    Model,
    action::{Actions, Edit, FileAction, ViewAction},
    command::Command,
    dialog::Then,
    document::Document,
    motion::Motion,
    preset::{Known, PRESETS},
    workspace::Workspace,
};
use brillianteer_session::shows::Shows;
use egui::{Button, Ui, vec2};
use std::ops::RangeInclusive;

/// The range of the angle of view, degrees; an eye that is nearer than the greatest angle may be inside the glass.
const ANGLES: RangeInclusive<f64> = 1.0..=75.0;

/// Draws a button for each scene of glass that comes with the program; a click begins that scene.
pub fn presets(actions: &mut Actions, ui: &mut Ui) {
    ui.horizontal_wrapped(|ui| {
        for Known { name, title, .. } in &PRESETS {
            let meaning = "Starts this scene with its own shape, material, copies, light and background.";
            if ui.small_button(*title).on_hover_text(meaning).clicked() {
                actions.push(FileAction::Ask(Then::Preset((*name).to_owned())));
            }
        }
    });
}

/// Draws the rows for copies, motion, smoothing and the angle of view.
pub fn show(model: &Model, actions: &mut Actions, ui: &mut Ui) {
    if model.can_move() {
        let count = model.document.work.copies.poses.len();
        copies(model, actions, ui);
        motion(model.session.motion, actions, ui);
        if has_wave(&model.document.work.design.cut) {
            movement(&model.document, actions, ui);
        }
        scatter(count, actions, ui);
    }
    smoothing(model, actions, ui);
    view_angle(model, actions, ui);
}

fn scatter(count: usize, actions: &mut Actions, ui: &mut Ui) {
    ui.horizontal(|ui| {
        skip_name(ui);
        let size = vec2(field_width(ui), ui.spacing().interact_size.y);
        let again = Button::new("Scatter").min_size(size);
        let again = ui.add_enabled(count > 1, again);
        if again.on_hover_text("Scatters the copies anew; Space does the same.").clicked() {
            actions.push(Edit::LayOut(count));
        }
    });
}

fn motion(motion: Motion, actions: &mut Actions, ui: &mut Ui) {
    ui.horizontal(|ui| {
        named(
            ui,
            "Motion",
            "In renders, copies tumble, and plates also wave. M starts and stops the motion.",
        );
        let (name, meaning) = if motion.is_on {
            ("Pause", "Stops the motion; the picture then becomes sharper.")
        } else {
            ("Play", "Starts the motion.")
        };
        let size = vec2(control_width(ui), ui.spacing().interact_size.y);
        if ui.add_sized(size, Button::new(name)).on_hover_text(meaning).clicked() {
            actions.push(Command::Play);
        }
        let rest = Button::new("Reset pose").min_size(vec2(NUMBER, size.y));
        let rest = ui.add_enabled(motion.seconds != 0.0, rest);
        if rest.on_hover_text("Goes back to the pose of the design.").clicked() {
            actions.push(ViewAction::Rest);
        }
    });
}

/// Draws the row for how plates with a wave move.
fn movement(document: &Document, actions: &mut Actions, ui: &mut Ui) {
    let (before, first) = (document.work.copies.movement, document.laid().0.movement);
    let mut movement = before;
    let meaning =
        "How plates move in renders: they tumble while their waves run, tumble alone, or wave alone.";
    let all = [(Movement::Both, "tumble and wave"), (Movement::Tumble, "tumble"), (Movement::Wave, "wave")];
    let name = |movement| all.iter().find(|(each, _)| *each == movement).map_or("", |(_, name)| name);
    let is_reset = ChoiceRow::new("Movement", meaning, name(before)).by_default(name(first)).show(ui, |ui| {
        all.into_iter().for_each(|(each, name)| drop(ui.selectable_value(&mut movement, each, name)));
    });
    if is_reset {
        movement = first;
    }
    actions.push_changed(&before, movement, Edit::Movement);
}

/// Draws the row for the angle of view, which sets the distance of the eye in perspective.
///
/// Draws nothing where no view in sight is in perspective.
fn view_angle(model: &Model, actions: &mut Actions, ui: &mut Ui) {
    let (reach, workspace) = (model.reach(Shows::Render), &model.workspace);
    if !workspace.shown().iter().any(|&pane| workspace.is_near(pane)) {
        return;
    }
    let degrees = 2.0 * (reach / workspace.distance).atan().to_degrees();
    let meaning =
        "The angle of view in perspective. P switches to parallel rays, and Backspace undoes a change of it.";
    let row = Row::new("View angle", meaning, ANGLES);
    let distance = |degrees: f64| ViewAction::Distance(reach / (0.5 * degrees).to_radians().tan());
    let first = 2.0 * (reach / Workspace::default().distance).atan().to_degrees();
    let row = Row { decimals: 1, speed: 0.2, unit: "°", ..row }.by_default(first);
    row.edit(ui, actions, degrees, distance);
}

fn copies(model: &Model, actions: &mut Actions, ui: &mut Ui) {
    let before = model.document.work.copies.poses.len();
    let first = model.document.laid().0.poses.len();
    let (mut count, most) = (before as f64, MOST_COPIES as f64);
    let meaning = "The number of copies in renders. Light that leaves one copy can enter another. Drag a copy in a \
        render to move it; Space scatters all of them anew.";
    let row = Row::new("Copies", meaning, 1.0..=most);
    let row = Row { limits: ANY, step: 1.0, decimals: 0, speed: 0.05, ..row }.by_default(first as f64);
    row.show(ui, &mut count);
    actions.push_changed(&before, count.round().clamp(1.0, most) as usize, Edit::LayOut);
}

fn smoothing(model: &Model, actions: &mut Actions, ui: &mut Ui) {
    let document = &model.document;
    let (before, first) = (document.work.settings.look.smoothing, document.first_settings().look.smoothing);
    let mut smoothing = before;
    let meaning = "How the edges of renders are smoothed while anything moves: not at all, in each picture (FXAA), or \
        over time (temporal). A still picture is smoothed by its many samples of each pixel.";
    let newest = match before {
        Smoothing::Temporal { newest } => newest,
        _ => Smoothing::USUAL_NEWEST,
    };
    let all =
        [(Smoothing::None, "none"), (Smoothing::Fxaa, "FXAA"), (Smoothing::Temporal { newest }, "temporal")];
    let is_kind = |a: Smoothing, b: Smoothing| std::mem::discriminant(&a) == std::mem::discriminant(&b);
    let name = |wanted| all.iter().find(|(each, _)| is_kind(*each, wanted)).map_or("", |(_, name)| name);
    let is_reset =
        ChoiceRow::new("Smoothing", meaning, name(before)).by_default(name(first)).show(ui, |ui| {
            all.into_iter().for_each(|(each, name)| drop(ui.selectable_value(&mut smoothing, each, name)));
        });
    if is_reset {
        smoothing = first;
    }
    if let Smoothing::Temporal { newest } = &mut smoothing {
        let meaning = "The share of the newest picture. A smaller share is smoother, but follows a change more \
            slowly.";
        let row = Row { speed: 0.01, ..Row::new("Newest part", meaning, Smoothing::NEWEST) };
        row.by_default(Smoothing::USUAL_NEWEST).show(ui, newest);
    }
    let set = |smoothing| model.look_with(|look| look.smoothing = smoothing);
    actions.push_changed(&before, smoothing, set);
}
