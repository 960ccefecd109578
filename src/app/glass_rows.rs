//! The dimensions of a glass shape: a slider and a number each.

use super::design_panel::{ANY, NUMBER, Number, named};
use crate::cut::Glass;
use egui::{Slider, SliderClamping, Ui};

/// Draws them, and takes what is set.
pub fn show(glass: &mut Glass, ui: &mut Ui) {
    for (dimension, value) in glass.dimensions() {
        ui.horizontal(|ui| {
            let mut key = dimension.key.to_owned();
            key[..1].make_ascii_uppercase();
            let label = named(ui, &key, dimension.meaning);
            ui.spacing_mut().slider_width = (ui.available_width() - NUMBER - 24.0).max(40.0);
            let [first, last] = dimension.range;
            let before = *value;
            let mut new = before;
            let slider = Slider::new(&mut new, first..=last).show_value(false).smart_aim(false);
            ui.add(slider.clamping(SliderClamping::Never)).labelled_by(label.id);
            let number = Number { decimals: 2, speed: 0.05, range: ANY, unit: dimension.unit };
            number.show(ui, (NUMBER, label.id), &mut new);
            if new != before && new.is_finite() {
                *value = new;
            }
        });
    }
}
