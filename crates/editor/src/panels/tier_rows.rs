//! Rows for a cut that lists its facets: one row for each tier, with angle and distance.
//!
//! Distances are shown in mm; the design has them in a unit of its own.

use crate::panels::rows::{ANY, NUMBER, Number, explain, named, named_with_reset, skip_control};
use brillianteer_cut::{Cut, TierChange};
use brillianteer_session::model::{
    action::{Actions, Edit},
    command::Command,
    document::Document,
};
use egui::{Align, Layout, RichText, Ui, vec2};

const MEANING: &str = "A tier: all facets that are cut at one angle and one distance. A change moves this tier \
    alone; the edges where facets meet follow.";

/// Draws the tiers of the cut.
pub fn show(document: &Document, actions: &mut Actions, ui: &mut Ui) {
    let unit_mm = document.specimen().design_unit_mm();
    let about = format!(
        "The distance from the origin to the facets, in mm at the stone's present size. 1 in the file is \
            {unit_mm:.3} mm."
    );
    if let Cut::Tiers(_) = document.work.design.cut {
        let button = ui.button("Edit tiers…");
        let meaning = "Opens the table below the views, in which tiers are added, ordered, named and cut at other indices.";
        if explain(ui, button, meaning).clicked() {
            actions.push(Command::Tiers);
        }
    }
    let heads = ui.horizontal(|ui| {
        named(ui, "Tier", MEANING);
        skip_angle(ui);
        [
            ("Angle", "The angle from the girdle plane, in degrees; negative in the pavilion."),
            ("Distance", about.as_str()),
        ]
        .map(|(head, meaning)| head_of_column(ui, head, meaning))
    });
    let saved = document.saved().cut.settings();
    for (place, setting) in document.work.design.cut.settings().into_iter().enumerate() {
        ui.horizontal(|ui| {
            let name = format!("{} · {}", setting.name, setting.facets);
            // No two tiers of a design have the same name.
            let first = saved.iter().find(|first| first.name == setting.name);
            let (label, is_reset) = match first {
                Some(_) => named_with_reset(ui, &name, MEANING),
                None => (named(ui, &name, MEANING), false),
            };
            skip_angle(ui);
            let (mut angle, mut distance_mm) = (setting.angle, setting.distance * unit_mm);
            let before_mm = distance_mm;
            let fields = [(&mut angle, 2, 0.02, "°"), (&mut distance_mm, 3, 0.002, " mm")];
            for ((value, decimals, speed, unit), head) in fields.into_iter().zip(heads.inner) {
                let number = Number { decimals, speed, range: ANY, unit, default: None };
                number.show(ui, (NUMBER, label.id), value).labelled_by(head);
            }
            // A distance that the user does not touch keeps all its digits.
            let distance = if distance_mm == before_mm { setting.distance } else { distance_mm / unit_mm };
            // A user who leaves out the sign means the same side: a tier never changes from crown to pavilion or back.
            let angle = angle.abs().copysign(setting.angle);
            let (angle, distance) = match first.filter(|_| is_reset) {
                Some(first) => (first.angle, first.distance),
                None => (angle, distance),
            };
            let is_changed = (angle, distance) != (setting.angle, setting.distance);
            if is_changed && angle.is_finite() && distance.is_finite() {
                actions.push(match &document.work.design.cut {
                    // Meets of other tiers are solved anew.
                    Cut::Tiers(tiers) => {
                        let listed = tiers.place_of_cut(place);
                        Edit::Tiers(TierChange::Setting(listed, angle, distance))
                    }
                    _ => Edit::Tier { place, angle, distance },
                });
            }
        });
    }
}

/// Leaves a space so that the angle stands left of the column of numbers, which holds the distance.
fn skip_angle(ui: &mut Ui) {
    skip_control(ui, NUMBER + ui.spacing().item_spacing.x);
}

fn head_of_column(ui: &mut Ui, head: &str, meaning: &str) -> egui::Id {
    let size = vec2(NUMBER, ui.spacing().interact_size.y);
    let layout = Layout::left_to_right(Align::Center);
    let shown = ui.allocate_ui_with_layout(size, layout, |ui| {
        ui.set_min_width(NUMBER);
        let label = ui.label(RichText::new(head).weak());
        explain(ui, label, meaning).id
    });
    shown.inner
}
