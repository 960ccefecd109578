//! What rows of panels are made of: a name, a slider, a number.

use egui::{DragValue, Slider, SliderClamping, Ui, vec2};
use std::ops::RangeInclusive;

/// Widths of a row's parts, points: its name, its number.
const NAME: f32 = 104.0;
pub const NUMBER: f32 = 66.0;

/// What else is in a row, points.
const SPACES: f32 = 24.0;

/// A row of name, slider and number.
pub struct Row<'a> {
    pub name: &'a str,
    pub meaning: &'a str,
    /// What the slider runs over.
    pub range: RangeInclusive<f64>,
    /// What can be typed.
    pub limits: RangeInclusive<f64>,
    /// The slider's steps; 0 for none.
    pub step: f64,
    pub decimals: usize,
    /// Change for a point that the number is dragged by.
    pub speed: f64,
    pub unit: &'a str,
    /// Whether the slider runs evenly over the number's logarithm.
    pub logarithmic: bool,
}

impl<'a> Row<'a> {
    /// A row whose slider runs over all that can be typed, without a unit.
    pub fn new(name: &'a str, meaning: &'a str, range: RangeInclusive<f64>) -> Self {
        let limits = range.clone();
        Self {
            name,
            meaning,
            range,
            limits,
            step: 0.0,
            decimals: 2,
            speed: 0.02,
            unit: "",
            logarithmic: false,
        }
    }

    /// Draws it. What is not touched stays as it is, with all its decimals.
    pub fn show(self, ui: &mut Ui, value: &mut f64) {
        let Self { name, meaning, range, limits, step, decimals, speed, unit, logarithmic } = self;
        ui.horizontal(|ui| {
            let label = named(ui, name, meaning);
            ui.spacing_mut().slider_width = (ui.available_width() - NUMBER - SPACES).max(40.0);
            let slider = Slider::new(value, range).show_value(false).clamping(SliderClamping::Edits);
            let slider = slider.step_by(step).logarithmic(logarithmic).smart_aim(false);
            ui.add(slider).labelled_by(label.id).on_hover_text(meaning);
            Number { decimals, speed, range: limits, unit }.show(ui, (NUMBER, label.id), value);
        });
    }
}

/// A field for a number.
pub struct Number<'a> {
    pub decimals: usize,
    /// Change for a point that it is dragged by.
    pub speed: f64,
    pub range: RangeInclusive<f64>,
    pub unit: &'a str,
}

/// Numbers that have limits of their own, which are told.
pub const ANY: RangeInclusive<f64> = f64::NEG_INFINITY..=f64::INFINITY;

impl Number<'_> {
    /// Draws it. What is out of its range stays until it is set; leaving it untouched leaves
    /// the number as it is, though more decimals belong to it than are shown.
    pub fn show(self, ui: &mut Ui, (width, label): (f32, egui::Id), value: &mut f64) -> egui::Response {
        let before = *value;
        let Self { decimals, speed, range, unit } = self;
        let field = DragValue::new(value).range(range).clamp_existing_to_range(false).speed(speed);
        let field = field.suffix(unit).update_while_editing(false);
        let field = field.min_decimals(decimals.min(1)).max_decimals(decimals);
        // Half the world writes a comma.
        let field = field.custom_parser(|text| {
            text.trim().trim_end_matches(unit.trim()).trim().replace(',', ".").parse().ok()
        });
        let response = ui.add_sized(vec2(width, ui.spacing().interact_size.y), field).labelled_by(label);
        if format!("{before:.decimals$}").parse() == Ok(*value) {
            *value = before;
        }
        response
    }
}

/// What a row is called, with its meaning; as wide in all rows.
pub fn named(ui: &mut Ui, name: &str, meaning: &str) -> egui::Response {
    let height = ui.spacing().interact_size.y;
    ui.allocate_ui_with_layout(vec2(NAME, height), egui::Layout::left_to_right(egui::Align::Center), |ui| {
        ui.set_min_width(NAME);
        ui.label(name).on_hover_text(meaning)
    })
    .inner
}
