//! The fields above the table of tiers for the gear of the machine and for the symmetry that the design states.

use crate::panels::rows::explain;
use brillianteer_cut::{TierChange, Tiers};
use brillianteer_session::model::action::{Actions, Edit};
use egui::{Align, DragValue, Layout, Ui, vec2};
use std::ops::RangeInclusive;

/// The range of teeth that can be set: machines have 32 to 120, and files name others.
const TEETH: RangeInclusive<i32> = 4..=3600;

/// The range of repeats around the axis that can be stated.
const REPEATS: RangeInclusive<u32> = 1..=96;

/// The width of a field with its name, points.
const FIELD: f32 = 124.0;

const GEAR: &str = "The teeth of the index gear. With another gear all facets stay where they are, and their indices change.";
const CLOCKWISE: &str =
    "Tick this for a gear that counts clockwise, seen from the table. Facets stay where they are.";
const SYMMETRY: &str = "The number of repeats of the design around its axis. The audit compares the facets with it; no facet changes.";
const MIRROR: &str = "Tick this if each repeat is its own mirror image. The audit compares the facets with it; no facet changes.";

/// Draws the fields.
pub fn show(tiers: &Tiers, actions: &mut Actions, ui: &mut Ui) {
    ui.separator();
    let (mut teeth, mut is_clockwise) = (tiers.gear.abs(), tiers.gear < 0);
    number(ui, "Gear", GEAR, DragValue::new(&mut teeth).range(TEETH));
    let box_of_hand = ui.checkbox(&mut is_clockwise, "Clockwise");
    explain(ui, box_of_hand, CLOCKWISE);
    let gear = if is_clockwise { -teeth } else { teeth };
    actions.push_changed(&tiers.gear, gear, |gear| Edit::Tiers(TierChange::Gear(gear)));
    let (mut symmetry, mut mirror) = (tiers.symmetry, tiers.mirror);
    number(ui, "Symmetry", SYMMETRY, DragValue::new(&mut symmetry).range(REPEATS).suffix("-fold"));
    let box_of_mirror = ui.checkbox(&mut mirror, "Mirror image");
    explain(ui, box_of_mirror, MIRROR);
    let stated = (symmetry, mirror);
    actions.push_changed(&(tiers.symmetry, tiers.mirror), stated, |(symmetry, mirror)| {
        Edit::Tiers(TierChange::Symmetry(symmetry, mirror))
    });
}

/// Draws the name and the field of a whole number. A number outside the range stays as it is until the user sets it.
fn number(ui: &mut Ui, name: &str, meaning: &str, field: DragValue<'_>) {
    // The name stays with its field where the line breaks.
    let size = vec2(FIELD, ui.spacing().interact_size.y);
    ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), |ui| {
        let label = ui.label(name);
        let label = explain(ui, label, meaning);
        let field = field.speed(0.1).clamp_existing_to_range(false).update_while_editing(false);
        let field = ui.add(field).labelled_by(label.id);
        explain(ui, field, meaning);
    });
}
