//! The fields above the table of tiers that scale the crown or the pavilion: all tiers of the side move together, so that every meet
//! stays.

use crate::panels::rows::{Number, explain, spoken};
use brillianteer_cut::{Cut, ScaledSide, Tiers};
use brillianteer_session::model::{
    Model,
    action::{Actions, Edit},
};
use egui::{Align, Layout, Ui, vec2};
use std::ops::RangeInclusive;

/// The heights that a side can be scaled to at once, percent of its height before.
const PERCENT: RangeInclusive<f64> = 50.0..=200.0;

/// The percentage that a field shows while the user does not scale.
const AS_IT_IS: f64 = 100.0;

/// The widths of a field with its name and of the field alone, points.
const WIDTHS: [f32; 2] = [164.0, 66.0];

/// The names of the fields, their accessible names, and their meanings.
const FIELDS: [(ScaledSide, &str, &str, &str); 2] = [
    (
        ScaledSide::Crown,
        "Scale crown",
        "Scale of the crown",
        "Sets the height of the crown, in percent of what it is now: the tangents of all its angles are multiplied by one factor, \
         which keeps every meet, the plan view and the girdle.",
    ),
    (
        ScaledSide::Pavilion,
        "Scale pavilion",
        "Scale of the pavilion",
        "Sets the depth of the pavilion, in percent of what it is now: the tangents of all its angles are multiplied by one factor, \
         which keeps every meet, the plan view and the girdle.",
    ),
];

/// The tiers from before a drag of a field, and the percentage that it has reached.
#[derive(Clone, Default)]
struct DraggedScale {
    from: Tiers,
    percent: f64,
}

/// Draws the fields by which crown and pavilion are scaled in height.
pub fn show(model: &Model, tiers: &Tiers, actions: &mut Actions, ui: &mut Ui) {
    ui.separator();
    for (side, name, spoken_name, meaning) in FIELDS {
        // The name stays with its field where the line breaks.
        let size = vec2(WIDTHS[0], ui.spacing().interact_size.y);
        ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), |ui| {
            let label = ui.label(name);
            let label = explain(ui, label, meaning);
            // A drag belongs to the document in which it began.
            let id = ui.make_persistent_id(("scale", name, model.session.begun));
            let dragged = ui.data(|data| data.get_temp::<DraggedScale>(id));
            let before = dragged.as_ref().map_or(AS_IT_IS, |dragged| dragged.percent);
            let mut percent = before;
            let field = Number { decimals: 2, speed: 0.1, range: PERCENT, unit: " %", default: None };
            let field = field.show(ui, (WIDTHS[1], label.id), &mut percent);
            spoken(&field, spoken_name);
            let from = dragged.map_or_else(|| tiers.clone(), |dragged| dragged.from);
            if percent != before {
                let of = Box::new(Cut::Tiers(from.clone()));
                actions.push(Edit::Scale { side, percent, of });
            }
            // A typed percentage is applied at once and reset; a drag counts from its beginning.
            ui.data_mut(|data| {
                if field.dragged() {
                    data.insert_temp(id, DraggedScale { from, percent });
                } else {
                    data.remove_temp::<DraggedScale>(id);
                }
            });
            explain(ui, field, meaning);
        });
    }
}
