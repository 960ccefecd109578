//! The rows that describe a better cut: measures with weights and limits, and the numbers that may change.

use super::rows::{ANY, NOT_KNOWN, Number, UNKNOWN, spoken};
use brillianteer_measure::measure_words;
use brillianteer_search::GoalMeasure;
use brillianteer_session::model::goal_form::{GoalForm, NumberChoice, SearchEffort};
use egui::{ComboBox, DragValue, Grid, Id, Label, RichText, Ui, vec2};

/// The widths of the fields of a measure, of its direction, and of its numbers, points.
const WIDTHS: [f32; 3] = [212.0, 92.0, 62.0];

/// The width of the fields for the ends of a range, points.
const END: f32 = 84.0;

/// The weights that can be typed.
const WEIGHTS: std::ops::RangeInclusive<f64> = 0.01..=1000.0;

/// The heads of the measures and their meanings.
const HEADS: [(&str, &str); 5] = [
    ("Measure", "A measure of the cut's light, face up and in the design's own material."),
    ("Wanted", "More or less of the measure is better; or it only has to keep its limits."),
    ("Weight", "The weight of the measure in the sum of all measures."),
    ("At least %", "The least value that is allowed. Leave it empty for none."),
    ("At most %", "The greatest value that is allowed. Leave it empty for none."),
];

/// The directions of a measure: more, less, or limits only; each has the sign of its weight.
const WANTED: [(&str, f64); 3] = [("more", 1.0), ("less", -1.0), ("limits only", 0.0)];

/// Draws all rows.
pub fn show(form: &mut GoalForm, ui: &mut Ui) {
    ui.label(RichText::new("What is wanted").strong());
    measures(form, ui);
    if ui.button("Add measure").clicked() {
        form.add_measure();
    }
    limits(form, ui);
    ui.add_space(8.0);
    ui.label(RichText::new("What may change").strong());
    numbers(&mut form.numbers, ui);
}

/// The steps of angles that are offered, degrees.
const ANGLE_STEPS: [Option<f64>; 5] = [None, Some(0.05), Some(0.1), Some(0.25), Some(0.5)];

/// Draws the choice of the step of angles.
pub fn angle_step(form: &mut GoalForm, ui: &mut Ui) {
    let name = |step: Option<f64>| step.map_or("any".to_owned(), |step| format!("{step}°"));
    let meaning = "Angles that change become multiples of this step, like those on the scale of a machine.";
    let label = ui.label("Angle step").on_hover_text(meaning);
    let combo =
        ComboBox::from_id_salt("angle step").width(END - 24.0).selected_text(name(form.angle_step_deg));
    let shown = combo.show_ui(ui, |ui| {
        for offered in ANGLE_STEPS {
            ui.selectable_value(&mut form.angle_step_deg, offered, name(offered));
        }
    });
    shown.response.labelled_by(label.id);
}

/// Draws the choice of the effort.
pub fn effort(form: &mut GoalForm, ui: &mut Ui) {
    let label = ui
        .label("Effort")
        .on_hover_text("The number of designs that are tried, and the accuracy of their measures.");
    let combo = ComboBox::from_id_salt("effort").width(WIDTHS[1]).selected_text(form.effort.name());
    let shown = combo.show_ui(ui, |ui| {
        for offered in SearchEffort::ALL {
            let entry = ui.selectable_value(&mut form.effort, offered, offered.name());
            entry.on_hover_text(offered.meaning());
        }
    });
    shown.response.labelled_by(label.id);
}

fn measures(form: &mut GoalForm, ui: &mut Ui) {
    let is_last = form.goal.measure.len() == 1;
    let mut removed = None;
    Grid::new("measures of the goal").num_columns(6).spacing([8.0, 4.0]).show(ui, |ui| {
        let heads =
            HEADS.map(|(name, meaning)| ui.label(RichText::new(name).weak()).on_hover_text(meaning).id);
        ui.end_row();
        for (place, measure) in form.goal.measure.iter_mut().enumerate() {
            let row = place + 1;
            of(measure, row, ui);
            wanted(measure, row, ui);
            weight(measure, (row, heads[2]), ui);
            limit(&mut measure.at_least, &format!("At least {row}"), ui);
            limit(&mut measure.at_most, &format!("At most {row}"), ui);
            let remove = ui.add_enabled(!is_last, egui::Button::new("×").frame(false));
            spoken(&remove, &format!("Remove measure {row}"));
            if remove.on_hover_text("Takes the measure out of the goal.").clicked() {
                removed = Some(place);
            }
            ui.end_row();
            let taken = taken_in(measure);
            if !taken.is_empty() {
                ui.add(Label::new(RichText::new(&taken).weak().small()).truncate()).on_hover_text(&taken);
                ui.end_row();
            }
        }
    });
    if let Some(place) = removed {
        form.goal.measure.remove(place);
    }
}

/// Describes what a goal file states of a measure beyond the row: materials, views and the loss that is allowed.
fn taken_in(measure: &GoalMeasure) -> String {
    let mut said = vec![];
    if let Some(materials) = &measure.material {
        said.push(format!("in {}", joined(materials.all())));
    }
    if let Some(tilts) = &measure.tilt {
        said.push(format!("tilted by {}°", joined(tilts.all())));
    }
    if let Some(azimuths) = &measure.azimuth {
        said.push(format!("toward {}°", joined(azimuths.all())));
    }
    if let Some(lost) = measure.may_lose {
        said.push(format!("may lose {} %", 100.0 * lost));
    }
    said.join("; ")
}

fn joined(all: &[impl std::fmt::Display]) -> String {
    all.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")
}

/// Lists the limits on the geometry that a goal file gave, with a button that lifts them; nothing where there are none.
fn limits(form: &mut GoalForm, ui: &mut Ui) {
    if form.goal.limit.is_empty() {
        return;
    }
    let mut are_lifted = false;
    ui.horizontal_wrapped(|ui| {
        for (name, limit) in &form.goal.limit {
            let least = limit.at_least.map(|least| format!(" at least {least}")).unwrap_or_default();
            let most = limit.at_most.map(|most| format!(" at most {most}")).unwrap_or_default();
            ui.label(format!("{name}{least}{most};"));
        }
        are_lifted = ui.small_button("Lift limits").clicked();
    });
    if are_lifted {
        form.goal.limit.clear();
    }
}

/// Draws the choice of a measure.
fn of(measure: &mut GoalMeasure, row: usize, ui: &mut Ui) {
    let combo = ComboBox::from_id_salt(("measure", row)).width(WIDTHS[0]).truncate();
    let shown = combo.selected_text(measure_words::name(measure.of)).show_ui(ui, |ui| {
        for offered in measure_words::all() {
            let entry = ui.selectable_value(&mut measure.of, offered, measure_words::name(offered));
            entry.on_hover_text(measure_words::meaning(offered));
        }
    });
    spoken(&shown.response, &format!("Measure {row}"));
}

/// Draws the choice of a measure's direction: more, less, or limits only.
fn wanted(measure: &mut GoalMeasure, row: usize, ui: &mut Ui) {
    let sign = |weight: f64| if weight == 0.0 { 0.0 } else { weight.signum() };
    let now = sign(measure.weight);
    let name = WANTED.iter().find(|(_, wanted)| *wanted == now).map_or("", |(name, _)| name);
    let combo = ComboBox::from_id_salt(("wanted", row)).width(WIDTHS[1]).selected_text(name);
    let shown = combo.show_ui(ui, |ui| {
        for (name, wanted) in WANTED {
            if ui.selectable_label(wanted == now, name).clicked() && wanted != now {
                let size = if now == 0.0 { 1.0 } else { measure.weight.abs() };
                measure.weight = wanted * size;
            }
        }
    });
    spoken(&shown.response, &format!("Wanted {row}"));
}

/// Draws the weight of a measure, without its sign; `head` is the head of its column.
fn weight(measure: &mut GoalMeasure, (row, head): (usize, Id), ui: &mut Ui) {
    let mut size = measure.weight.abs();
    ui.add_enabled_ui(measure.weight != 0.0, |ui| {
        let range = if measure.weight == 0.0 { ANY } else { WEIGHTS };
        let number = Number { decimals: 2, speed: 0.01, range, unit: "", default: None };
        let shown = number.show(ui, (WIDTHS[2], head), &mut size);
        spoken(&shown, &format!("Weight {row}"));
    });
    if size != measure.weight.abs() {
        measure.weight = size.copysign(measure.weight);
    }
}

/// Draws a field for a limit, in percent; an empty field means no limit.
fn limit(limit: &mut Option<f64>, name: &str, ui: &mut Ui) {
    let before = limit.map_or(NOT_KNOWN, |part| 100.0 * part);
    let mut percent = before;
    let field = DragValue::new(&mut percent).speed(0.1).max_decimals(2).update_while_editing(false);
    let field = field.custom_formatter(|percent, _| {
        if percent.is_finite() {
            format!("{}", (100.0 * percent).round() / 100.0)
        } else {
            UNKNOWN.to_owned()
        }
    });
    let field = field.custom_parser(|text| match text.trim().trim_end_matches('%').trim() {
        "" | UNKNOWN => Some(NOT_KNOWN),
        text => text.replace(',', ".").parse().ok(),
    });
    let shown = ui.add_sized(vec2(WIDTHS[2], ui.spacing().interact_size.y), field);
    spoken(&shown, name);
    if percent != before {
        *limit = percent.is_finite().then_some(percent / 100.0);
    }
}

fn numbers(numbers: &mut [NumberChoice], ui: &mut Ui) {
    ui.horizontal(|ui| {
        for (name, is_varied) in [("All", true), ("None", false)] {
            if ui.small_button(name).clicked() {
                numbers.iter_mut().for_each(|number| number.is_varied = is_varied);
            }
        }
    });
    Grid::new("numbers of the goal").num_columns(4).spacing([12.0, 4.0]).striped(true).show(ui, |ui| {
        let heads =
            ["Number", "Now", "Least", "Greatest"].map(|name| ui.label(RichText::new(name).weak()).id);
        ui.end_row();
        for number in numbers {
            let tick = ui.checkbox(&mut number.is_varied, &number.name);
            spoken(&tick, &format!("Vary {}", number.name));
            ui.label(number.written(number.value));
            for (end, name, head) in [(0, "Least", heads[2]), (1, "Greatest", heads[3])] {
                ui.add_enabled_ui(number.is_varied, |ui| {
                    let field =
                        Number { decimals: 2, speed: 0.05, range: ANY, unit: number.unit, default: None };
                    let shown = field.show(ui, (END, head), &mut number.ends[end]);
                    spoken(&shown, &format!("{name} {}", number.name));
                });
            }
            ui.end_row();
        }
    });
}
