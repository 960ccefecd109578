//! Rows for a scene of several designs: its stones, of which one is edited, and its metal.

use crate::app::model::Model;
use crate::app::model::action::{Actions, Edit};
use crate::app::model::export::kinds;
use crate::app::panels::rows::{field_width, named};
use crate::cut::{Design, MaterialRef};
use crate::scene::MetalInstance;
use egui::{Align, Button, Label, Layout, Role, Ui, WidgetInfo, vec2};
use std::collections::BTreeMap;
use std::sync::Arc;

/// The width of the buttons that edit a stone, points.
const EDIT: f32 = 44.0;

/// Draws a row for each kind of stone, the one that is edited first, and for each metal.
pub fn show(model: &Model, actions: &mut Actions, ui: &mut Ui) {
    let work = &model.document.work;
    let meaning = "The stone whose proportions, material and size stand in this panel.";
    row(ui, "Edited", meaning, &counted(work.copies.poses.len(), &work.design), |_| {});
    let stones = &work.companions.stones;
    for kind in kinds(&work.companions) {
        let is_of_kind = |place: &usize| Arc::ptr_eq(&stones[*place].specimen, kind);
        let places: Vec<usize> = (0..stones.len()).filter(is_of_kind).collect();
        let meaning = "A stone of the scene. Drag it in a render to move it; it stops before others.";
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
    let mut metals: BTreeMap<(&str, &str), usize> = BTreeMap::new();
    for MetalInstance { metal, label, .. } in &work.companions.metals {
        *metals.entry((label, metal.name())).or_default() += 1;
    }
    for ((label, metal), count) in metals {
        let text = format!("{}{label}, {metal}", times(count));
        row(ui, "Metal", "A body of metal, which renders show.", &text, |_| {});
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
