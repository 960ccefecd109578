//! Rows for a scene of several designs: its stones, of which one is edited, its metal, and the numbers of its ring.

use crate::panels::ring_rows;
use crate::panels::rows::{ChoiceRow, Row, field_width, named};
use brillianteer_cut::{Design, MaterialRef};
use brillianteer_optics::Metal;
use brillianteer_scene::MetalInstance;
use brillianteer_session::model::{
    Model,
    action::{Actions, Edit},
    export::kinds,
};
use egui::{Align, Button, Label, Layout, Role, Ui, WidgetInfo, vec2};
use std::ops::RangeInclusive;
use std::sync::Arc;

/// The width of the buttons that edit a stone, points.
const EDIT: f32 = 44.0;

/// Draws a row for each kind of stone, the one that is edited first, and the rows for metal.
pub fn show(model: &Model, actions: &mut Actions, ui: &mut Ui) {
    let work = &model.document.work;
    let meaning = "The stone whose proportions, material and size stand in this panel.";
    row(ui, "Edited", meaning, &counted(work.copies.poses.len(), &work.design), |_| {});
    let stones = &work.companions.stones;
    for kind in kinds(&work.companions) {
        let is_of_kind = |place: &usize| Arc::ptr_eq(&stones[*place].specimen, kind);
        let places: Vec<usize> = (0..stones.len()).filter(is_of_kind).collect();
        let is_seated = work.companions.seat_at(stones[places[0]].pose.at).is_some();
        let meaning = if is_seated {
            "A stone of the scene's ring, which holds it in its seat."
        } else {
            "A stone of the scene. Drag it in a render to move it; it stops before others."
        };
        let text = counted(places.len(), &kind.design);
        row(ui, "Beside it", meaning, &text, |ui| {
            let size = vec2(EDIT, ui.spacing().interact_size.y);
            let button = ui.add_sized(size, Button::new("Edit"));
            button.widget_info(|| WidgetInfo::labeled(Role::Button, true, format!("Edit {text}")));
            let meaning = "Shows this stone in all views, and its numbers in this panel.";
            if button.on_hover_text(meaning).clicked() {
                actions.push(Edit::TakeUp(places[0]));
            }
        });
    }
    metal_rows(&work.companions.metals, &model.document.laid().1.metals, actions, ui);
    ring_rows::show(model, actions, ui);
}

/// The range of the roughness of metal.
const ROUGHNESSES: RangeInclusive<f64> = 0.0..=1.0;

/// Bodies of metal of one shape and finish.
struct MetalGroup<'a> {
    first: &'a MetalInstance,
    /// The places of all bodies of the group in the scene's list of metal.
    bodies: Vec<usize>,
}

/// Draws a list of metals and a row for the roughness for all bodies of one shape and finish. Where there are several such
/// groups, the names of their rows are numbered.
fn metal_rows(metals: &[MetalInstance], laid: &[MetalInstance], actions: &mut Actions, ui: &mut Ui) {
    let mut groups: Vec<MetalGroup> = vec![];
    for (number, body) in metals.iter().enumerate() {
        let is_alike = |first: &MetalInstance| {
            Arc::ptr_eq(&first.mesh, &body.mesh)
                && (first.metal, first.roughness) == (body.metal, body.roughness)
        };
        match groups.iter_mut().find(|group| is_alike(group.first)) {
            Some(group) => group.bodies.push(number),
            None => groups.push(MetalGroup { first: body, bodies: vec![number] }),
        }
    }
    let count = groups.len();
    for (place, MetalGroup { first, bodies }) in groups.into_iter().enumerate() {
        let name = |name: &str| if count > 1 { format!("{name} {}", place + 1) } else { name.to_owned() };
        let text = format!("{}{}", times(bodies.len()), first.label);
        row(ui, &name("Metal body"), "A body of metal, which renders show.", &text, |_| {});
        let (mut metal, mut roughness) = (first.metal, first.roughness);
        let usual = laid.get(bodies[0]).unwrap_or(first);
        let meaning = "The metal, by its measured colour. Jewellers' alloys look a little paler.";
        let row = name("Metal");
        let row = ChoiceRow::new(&row, meaning, metal.name()).by_default(usual.metal.name());
        let is_reset = row.show(ui, |ui| {
            Metal::NAMES
                .into_iter()
                .for_each(|(name, each)| drop(ui.selectable_value(&mut metal, each, name)));
        });
        if is_reset {
            metal = usual.metal;
        }
        let meaning =
            "The roughness of the metal's surface: 0 is a mirror, 0.1 polished, 0.4 brushed to satin.";
        let row = name("Roughness");
        let row = Row { step: 0.01, ..Row::new(&row, meaning, ROUGHNESSES) }.by_default(usual.roughness);
        row.show(ui, &mut roughness);
        let finish = |(metal, roughness)| Edit::Finish { bodies, metal, roughness };
        actions.push_changed(&(first.metal, first.roughness), (metal, roughness), finish);
    }
}

/// Draws a row of a name and a text that is shortened where it is too long, with what `end` adds at the right.
fn row(ui: &mut Ui, name: &str, meaning: &str, text: &str, end: impl FnOnce(&mut Ui)) {
    ui.horizontal(|ui| {
        named(ui, name, meaning);
        let size = vec2(field_width(ui), ui.spacing().interact_size.y);
        ui.allocate_ui_with_layout(size, Layout::right_to_left(Align::Center), |ui| {
            end(ui);
            let rest = Layout::left_to_right(Align::Center);
            ui.with_layout(rest, |ui| ui.add(Label::new(text).truncate()));
        });
    });
}

/// Returns a text with the number of stones of a design, their material, diameter and name.
fn counted(count: usize, design: &Design) -> String {
    let material = match &design.material {
        MaterialRef::Name(name) => name.clone(),
        other => other.material().map_or_else(|_| "own material".to_owned(), |material| material.name),
    };
    format!("{}{material}, {:.2} mm, {}", times(count), design.diameter_mm, design.name)
}

fn times(count: usize) -> String {
    if count > 1 { format!("{count} × ") } else { String::new() }
}
