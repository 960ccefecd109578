//! Rows for the dimensions of a glass shape: a slider and a number each.

use crate::app::panels::rows::{ANY, Row};
use crate::cut::Glass;
use egui::Ui;

/// Draws the rows, and sets the dimensions that the user changes.
pub fn show(glass: &mut Glass, ui: &mut Ui) {
    for (dimension, value) in glass.dimensions() {
        let mut name = dimension.key.to_owned();
        name[..1].make_ascii_uppercase();
        let [first, last] = dimension.range;
        let mut new = *value;
        let row = Row::new(&name, dimension.meaning, first..=last);
        Row { limits: ANY, speed: 0.05, unit: dimension.unit, ..row }.show(ui, &mut new);
        if new.is_finite() {
            *value = new;
        }
    }
}
