//! The tiers of a cut that lists its facets: a row each, with angle and distance.

use super::rows::{ANY, NUMBER, Number, named};
use crate::cut::Cut;
use egui::{Align, Layout, RichText, Ui, vec2};

const MEANING: &str = "A tier: facets of one angle and one distance, as a faceting machine is set for them. Each tier \
    is set by itself; where facets meet follows.";

/// Draws them, and takes what is set.
pub fn show(cut: &mut Cut, ui: &mut Ui) {
    let heads = ui.horizontal(|ui| {
        named(ui, "Tier", MEANING);
        [
            ("Angle", "From the girdle plane; below 0 for the pavilion."),
            ("Distance", "From the origin to the facets."),
        ]
        .map(|(head, meaning)| head_of_column(ui, head, meaning))
    });
    for (place, setting) in cut.settings().into_iter().enumerate() {
        ui.horizontal(|ui| {
            let label = named(ui, &format!("{} · {}", setting.name, setting.facets), MEANING);
            let (mut angle, mut distance) = (setting.angle, setting.distance);
            let fields = [(&mut angle, 2, 0.02, "°"), (&mut distance, 4, 0.0005, "")];
            for ((value, decimals, speed, unit), head) in fields.into_iter().zip(heads.inner) {
                let number = Number { decimals, speed, range: ANY, unit };
                number.show(ui, (NUMBER, label.id), value).labelled_by(head);
            }
            let is_changed = (angle, distance) != (setting.angle, setting.distance);
            if is_changed && angle.is_finite() && distance.is_finite() {
                // Whoever leaves out the sign means the same side: a tier never changes over to the other.
                cut.set(place, angle.abs().copysign(setting.angle), distance);
            }
        });
    }
}

fn head_of_column(ui: &mut Ui, head: &str, meaning: &str) -> egui::Id {
    let size = vec2(NUMBER, ui.spacing().interact_size.y);
    let layout = Layout::left_to_right(Align::Center);
    let shown = ui.allocate_ui_with_layout(size, layout, |ui| {
        ui.set_min_width(NUMBER);
        ui.label(RichText::new(head).weak()).on_hover_text(meaning).id
    });
    shown.inner
}
