//! Rows of panels: a name, a control and a number, in columns that all rows of a panel share.
//!
//! From left to right: the name, [`NAME`] wide; the control, such as a slider, as wide as the panel leaves it
//! ([`control_width`]); the number, [`NUMBER`] wide; and room for a small button such as a padlock, which rows without one
//! leave empty. Fields without a slider fill the columns of control and number ([`field_width`]).

use super::row_default;
pub use super::row_default::may_follow as may_be_reset;
use super::row_focus;
use crate::theme;
use brillianteer_base::NumberRow;
use brillianteer_math::fixed;
use brillianteer_optics::{encoded_from_linear, linear_from_encoded};
use brillianteer_session::model::action::{Action, Actions};
use egui::emath::format_with_decimals_in_range;
use egui::{
    Color32, ComboBox, DragValue, Id, Label, Rect, RectAlign, Response, RichText, Sense, Slider,
    SliderClamping, TextStyle, Tooltip, Ui, vec2,
};
use std::ops::RangeInclusive;

/// The width of the column of names, points.
const NAME: f32 = 104.0;
/// The width of the column of numbers, points.
pub const NUMBER: f32 = 92.0;

/// The least width of a control, points: the panel scrolls sideways rather than let a slider vanish.
const LEAST_CONTROL: f32 = 40.0;

/// Returns the width of the last column of a row, that of a padlock, with the gap before it, points.
fn end_width(ui: &Ui) -> f32 {
    ui.spacing().interact_size.y + ui.spacing().item_spacing.x
}

/// Returns the width of the control in a row whose name has been drawn and whose number has not, points.
pub fn control_width(ui: &Ui) -> f32 {
    let gap = ui.spacing().item_spacing.x;
    (ui.available_width() - NUMBER - gap - end_width(ui)).max(LEAST_CONTROL)
}

/// Returns the width of a field that fills the columns of control and number, in a row whose name has been drawn, points.
pub fn field_width(ui: &Ui) -> f32 {
    control_width(ui) + ui.spacing().item_spacing.x + NUMBER
}

/// Leaves the column of names empty.
pub fn skip_name(ui: &mut Ui) {
    ui.add_space(NAME + ui.spacing().item_spacing.x);
}

/// Leaves the column of the control empty, but for `needed` points at its right end that further fields take.
pub fn skip_control(ui: &mut Ui, needed: f32) {
    ui.add_space((control_width(ui) + ui.spacing().item_spacing.x - needed).max(0.0));
}

/// A row of name, slider and number.
pub struct Row<'a> {
    pub name: &'a str,
    pub meaning: &'a str,
    /// The range of the slider.
    pub range: RangeInclusive<f64>,
    /// The range of the numbers that can be typed.
    pub limits: RangeInclusive<f64>,
    /// The step of the slider; 0 for none.
    pub step: f64,
    pub decimals: usize,
    /// The change for each point that the number is dragged by.
    pub speed: f64,
    pub unit: &'a str,
    /// True where the slider runs evenly over the number's logarithm.
    pub logarithmic: bool,
    /// The number that a double click sets; `None` where there is none.
    pub default: Option<f64>,
}

impl<'a> Row<'a> {
    /// Makes a row without a unit, whose slider runs over all that can be typed.
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
            default: None,
        }
    }

    /// Makes the row of a number that things of the type `T` have.
    pub fn of<T>(row: &NumberRow<T>) -> Self {
        let [least, most] = row.range;
        let NumberRow { step, decimals, .. } = *row;
        let unit = row.unit.suffix();
        let whole = Self::new(row.name, row.meaning, row.span[0]..=row.span[1]);
        Self { limits: least..=most, step, decimals, unit, ..whole }
    }

    /// Gives the row a default, which a double click sets.
    pub fn by_default(self, default: f64) -> Self {
        Self { default: Some(default), ..self }
    }

    /// Draws the row. A number that is not touched keeps all its decimals.
    pub fn show(self, ui: &mut Ui, value: &mut f64) {
        ui.horizontal(|ui| self.fill(ui, value));
    }

    /// Draws the name, the slider and the number into a row that has begun.
    pub fn fill(self, ui: &mut Ui, value: &mut f64) -> FilledRow {
        let Self { name, meaning, range, limits, step, decimals, speed, unit, logarithmic, default } = self;
        let number = Number { decimals, speed, range: limits, unit, default };
        let meaning = number.about(meaning);
        let label = row_name(ui, name, &meaning, default.is_some());
        ui.spacing_mut().slider_width = control_width(ui);
        let slider = Slider::new(value, range).show_value(false).clamping(SliderClamping::Edits);
        let slider = slider.step_by(step).logarithmic(logarithmic).smart_aim(false);
        let slider = ui.add(slider).labelled_by(label.id);
        row_focus::slider(ui, &slider);
        let slider = explain(ui, slider, &meaning);
        if row_default::is_wanted(ui, &label, Some(&slider)) {
            *value = default.unwrap_or(*value);
        }
        let field = number.show(ui, (NUMBER, label.id), value);
        let number = explain(ui, field, &meaning).id;
        FilledRow { slider: slider.rect, number }
    }

    /// Draws the row for a number of the model, and pushes the action that sets it if the user has changed it.
    pub fn edit<A: Into<Action>>(
        self,
        ui: &mut Ui,
        actions: &mut Actions,
        before: f64,
        set: impl FnOnce(f64) -> A,
    ) {
        let mut now = before;
        self.show(ui, &mut now);
        actions.push_changed(&before, now, set);
    }
}

/// What a drawn row consists of.
pub struct FilledRow {
    /// The place of the slider.
    pub slider: Rect,
    /// The field of the number.
    pub number: Id,
}

/// A field for a number.
pub struct Number<'a> {
    pub decimals: usize,
    /// The change for each point that the field is dragged by.
    pub speed: f64,
    pub range: RangeInclusive<f64>,
    pub unit: &'a str,
    /// The number that a double click on the name sets; `None` where there is none.
    pub default: Option<f64>,
}

/// The range of a number whose own limits are checked and explained elsewhere.
pub const ANY: RangeInclusive<f64> = f64::NEG_INFINITY..=f64::INFINITY;

impl Number<'_> {
    /// Returns a meaning with the default at its end, if there is one.
    fn about(&self, meaning: &str) -> String {
        let Self { decimals, unit, default, .. } = *self;
        let Some(default) = default.filter(|default| default.is_finite()) else { return meaning.to_owned() };
        let default = format_with_decimals_in_range(default, decimals.min(1)..=decimals);
        format!("{meaning} A double click sets {default}{unit}.")
    }

    /// Draws the field.
    ///
    /// A number outside the range stays as it is until the user sets it. A field that the user does not touch leaves
    /// the number as it is, even where it has more decimals than the field shows.
    pub fn show(self, ui: &mut Ui, (width, label): (f32, egui::Id), value: &mut f64) -> egui::Response {
        let before = *value;
        let Self { decimals, speed, range, unit, .. } = self;
        let field = DragValue::new(value).range(range).clamp_existing_to_range(false).speed(speed);
        let field = field.suffix(unit).update_while_editing(false);
        let field = field.min_decimals(decimals.min(1)).max_decimals(decimals);
        let room = width - 2.0 * ui.spacing().button_padding.x;
        let (painter, font) = (ui.painter().clone(), TextStyle::Button.resolve(ui.style()));
        let fits = |text: &str| {
            let text = painter.layout_no_wrap(format!("{text}{unit}"), font.clone(), Color32::WHITE);
            text.size().x <= room
        };
        let field = field.custom_formatter(|number, places| written(number, places, &fits));
        let shown = written(before, decimals.min(1)..=decimals, &fits);
        // About half the world writes a decimal comma.
        let field = field.custom_parser(|text| {
            let text = text.trim().trim_end_matches(unit.trim()).trim();
            text.replace(',', ".").replace('−', "-").parse().ok()
        });
        let response = ui.add_sized(vec2(width, ui.spacing().interact_size.y), field).labelled_by(label);
        if row_focus::number(ui, &response) {
            *value = before;
        }
        let is_as_shown = |text: String| text.parse() == Ok(*value);
        if is_as_shown(format!("{before:.decimals$}")) || is_as_shown(shown) {
            *value = before;
        }
        if response.dragged() && *value != before {
            // The field was drawn before it was dragged. A second pass shows its new number in this image, not the next.
            ui.ctx().request_discard("a number is dragged");
        }
        response
    }
}

/// The value that stands for an unknown number.
///
/// Unlike NaN it equals itself: an edited field compares it with itself.
pub const NOT_KNOWN: f64 = f64::NEG_INFINITY;
/// The text that a field shows for an unknown number.
pub const UNKNOWN: &str = "–";

/// Draws a number without a slider: its name, an empty column, and the field in the column of numbers.
pub fn number_row(ui: &mut Ui, (name, meaning): (&str, &str), number: Number, value: &mut f64) {
    ui.horizontal(|ui| {
        let (default, meaning) = (number.default, number.about(meaning));
        let label = row_name(ui, name, &meaning, default.is_some());
        if row_default::is_wanted(ui, &label, None) {
            *value = default.unwrap_or(*value);
        }
        skip_control(ui, 0.0);
        let field = number.show(ui, (NUMBER, label.id), value);
        explain(ui, field, &meaning);
    });
}

/// Draws a message about what is wrong in the rows above it.
pub fn wrong(ui: &mut Ui, fault: &str) {
    ui.label(RichText::new(fault).color(theme::bad(ui.visuals())));
}

/// Draws a row with a picker for a colour in linear light, from 0 to 1; returns the colour if another is picked, or if a double
/// click on the name sets the default.
///
/// The picker shows and sets codes of 8 bits, so a colour that is not picked keeps all its decimals.
pub fn colour_row(
    ui: &mut Ui,
    (name, meaning): (&str, &str),
    linear: [f64; 3],
    default: Option<[f64; 3]>,
) -> Option<[f64; 3]> {
    let before = linear.map(|part| (encoded_from_linear(part).clamp(0.0, 1.0) * 255.0).round() as u8);
    let mut picked = before;
    let mut is_reset = false;
    ui.horizontal(|ui| {
        let label = row_name(ui, name, meaning, default.is_some());
        is_reset = row_default::is_wanted(ui, &label, None);
        skip_control(ui, 0.0);
        let button = ui.color_edit_button_srgb(&mut picked).on_hover_text(meaning);
        row_focus::part(&button);
        spoken(&button, name);
    });
    let picked = (picked != before).then(|| picked.map(|code| linear_from_encoded(f64::from(code) / 255.0)));
    default.filter(|default| is_reset && *default != linear).or(picked)
}

/// The greatest height of a list that opens, points.
const LIST_HEIGHT: f32 = 470.0;

/// A row in which one of several entries is chosen.
pub struct ChoiceRow<'a> {
    name: &'a str,
    meaning: &'a str,
    chosen: &'a str,
    default: Option<&'a str>,
}

impl<'a> ChoiceRow<'a> {
    /// Makes a row with a name, its meaning, and the name of the chosen entry.
    pub fn new(name: &'a str, meaning: &'a str, chosen: &'a str) -> Self {
        Self { name, meaning, chosen, default: None }
    }

    /// Gives the row a default, by its name, which a double click asks for.
    pub fn by_default(self, default: &'a str) -> Self {
        Self { default: Some(default), ..self }
    }

    /// Draws the name, and a field with the chosen entry, which opens the list that `list` draws. Returns whether a double click on
    /// the name asks for the default.
    pub fn show(self, ui: &mut Ui, list: impl FnOnce(&mut Ui)) -> bool {
        let Self { name, meaning, chosen, default } = self;
        let about = default.map_or_else(
            || meaning.to_owned(),
            |default| format!("{meaning} A double click on the name chooses {default}."),
        );
        ui.horizontal(|ui| {
            let label = row_name(ui, name, &about, default.is_some());
            let is_reset = default.is_some() && row_default::is_wanted(ui, &label, None);
            let combo = ComboBox::from_id_salt(name).selected_text(chosen).width(field_width(ui)).truncate();
            let field = combo.height(LIST_HEIGHT).show_ui(ui, list).response.labelled_by(label.id);
            row_focus::part(&field);
            explain(ui, field, &about);
            is_reset
        })
        .inner
    }
}

/// Writes a number for its field.
///
/// The number gets fewer decimals where they do not fit: no number, however large, makes its row wider.
fn written(number: f64, places: RangeInclusive<usize>, fits: &dyn Fn(&str) -> bool) -> String {
    if !number.is_finite() {
        return UNKNOWN.to_owned();
    }
    let most = *places.end();
    // A number that shows as 0 has no sign.
    let number = if fixed(number, most).starts_with('-') { number } else { number.abs() };
    let usual = format_with_decimals_in_range(number, places);
    let shorter = (0..most).rev().map(|places| fixed(number, places));
    std::iter::once(usual).chain(shorter).find(|text| fits(text)).unwrap_or_else(|| format!("{number:.0e}"))
}

/// Explains a part of a row while the pointer rests on it.
///
/// The explanation stands beside the panel, so that no row is covered; there is none while something is typed.
pub fn explain(ui: &Ui, response: Response, meaning: &str) -> Response {
    if ui.ctx().text_edit_focused() {
        return response;
    }
    let panel = ui.clip_rect();
    let row = Rect::from_x_y_ranges(panel.x_range(), response.rect.y_range());
    let is_left = panel.center().x < ui.ctx().content_rect().center().x;
    let sides = [RectAlign::RIGHT_START, RectAlign::LEFT_START];
    let (first, other) = if is_left { (sides[0], &sides[1..]) } else { (sides[1], &sides[..1]) };
    let mut tooltip = Tooltip::for_enabled(&response);
    tooltip.popup = tooltip.popup.anchor(row).align(first).align_alternatives(other);
    tooltip.show(|ui| ui.add(Label::new(RichText::new(meaning)).wrap()));
    response
}

/// Gives a widget the name by which screen readers and tests find it.
pub fn spoken(widget: &Response, name: &str) {
    let name = name.to_owned();
    widget.ctx.accesskit_node_builder(widget.id, |node| node.set_label(name));
}

/// Draws the name of a row, with its meaning; it is as wide in all rows, and shortened where it is wider.
pub fn named(ui: &mut Ui, name: &str, meaning: &str) -> egui::Response {
    row_name(ui, name, meaning, false)
}

/// Draws the name of a row as [`named`] does; returns also whether a double click on it asks for the default of the row.
pub fn named_with_reset(ui: &mut Ui, name: &str, meaning: &str) -> (Response, bool) {
    let label = row_name(ui, name, &format!("{meaning} A double click on the name resets it."), true);
    let is_reset = row_default::is_wanted(ui, &label, None);
    (label, is_reset)
}

/// Draws the name of a row as [`named`] does; where the row has a default, the name can be clicked.
fn row_name(ui: &mut Ui, name: &str, meaning: &str, has_default: bool) -> egui::Response {
    let height = ui.spacing().interact_size.y;
    ui.allocate_ui_with_layout(vec2(NAME, height), egui::Layout::left_to_right(egui::Align::Center), |ui| {
        ui.set_min_width(NAME);
        let label = Label::new(name).truncate();
        let label = if has_default { label.selectable(false).sense(Sense::CLICK) } else { label };
        let label = ui.add(label);
        explain(ui, label, meaning)
    })
    .inner
}
