//! Rows of panels: a name, a control and a number, in columns that all rows of a panel share.
//!
//! From left to right: the name, [`NAME`] wide; the control, a slider for one, as wide as the panel leaves it
//! ([`control_width`]); the number, [`NUMBER`] wide; and room for a small button such as a padlock, which rows without one
//! leave empty. Fields without a slider fill the columns of control and number ([`field_width`]).

use egui::{DragValue, Label, Slider, SliderClamping, Ui, vec2};
use std::ops::RangeInclusive;

/// Widths of the columns of names and numbers, points.
const NAME: f32 = 104.0;
pub const NUMBER: f32 = 92.0;

/// The least width of a control, points: the panel scrolls sideways rather than let a slider vanish.
const LEAST_CONTROL: f32 = 40.0;

/// Width of the last column of a row, with the gap before it, points: that of a padlock.
fn end_width(ui: &Ui) -> f32 {
    ui.spacing().interact_size.y + ui.spacing().item_spacing.x
}

/// Width of the control in a row whose name has been drawn and whose number has not, points.
pub fn control_width(ui: &Ui) -> f32 {
    let gap = ui.spacing().item_spacing.x;
    (ui.available_width() - NUMBER - gap - end_width(ui)).max(LEAST_CONTROL)
}

/// Width of a field that fills the columns of control and number, in a row whose name has been drawn, points.
pub fn field_width(ui: &Ui) -> f32 {
    control_width(ui) + ui.spacing().item_spacing.x + NUMBER
}

/// Leaves the column of names empty.
pub fn skip_name(ui: &mut Ui) {
    ui.add_space(NAME + ui.spacing().item_spacing.x);
}

/// Leaves the column of the control empty, but for so much room of its right end as further fields need, points.
pub fn skip_control(ui: &mut Ui, needed: f32) {
    // The gap to what follows is added by the layout.
    ui.add_space((control_width(ui) - needed).max(0.0));
}

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
            ui.spacing_mut().slider_width = control_width(ui);
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
        let field = field.custom_formatter(|number, places| match number.is_nan() {
            true => UNKNOWN.to_owned(),
            false => egui::emath::format_with_decimals_in_range(number, places),
        });
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

/// What a field shows in place of a number that is not known, which is NaN.
pub const UNKNOWN: &str = "–";

/// A number without a slider: its name, nothing, and the field in the column of numbers.
pub fn number_row(ui: &mut Ui, (name, meaning): (&str, &str), number: Number, value: &mut f64) {
    ui.horizontal(|ui| {
        let label = named(ui, name, meaning);
        skip_control(ui, 0.0);
        number.show(ui, (NUMBER, label.id), value);
    });
}

/// What a row is called, with its meaning; as wide in all rows, and shortened where it is wider.
pub fn named(ui: &mut Ui, name: &str, meaning: &str) -> egui::Response {
    let height = ui.spacing().interact_size.y;
    ui.allocate_ui_with_layout(vec2(NAME, height), egui::Layout::left_to_right(egui::Align::Center), |ui| {
        ui.set_min_width(NAME);
        ui.add(Label::new(name).truncate()).on_hover_text(meaning)
    })
    .inner
}
