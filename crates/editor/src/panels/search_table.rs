//! The report of a search: each measure before and after, whether it rose or fell, and the numbers of the design that
//! changed.

use crate::theme;
use brillianteer_math::{fixed, signed};
use brillianteer_measure::{Interval, measure_words};
use brillianteer_search::MeasureChange;
use brillianteer_session::model::{Model, cut_search::SearchReport, goal_form::NumberChoice};
use egui::{Color32, Grid, Response, RichText, Ui, vec2};
use std::cmp::Ordering;

/// The width of a column of numbers, points.
const COLUMN: f32 = 104.0;

/// Draws the measures in groups, and the numbers.
pub fn show(model: &Model, report: &SearchReport, ui: &mut Ui) {
    let [good, bad] = [theme::good(ui.visuals()), theme::bad(ui.visuals())];
    let plain = ui.visuals().text_color();
    let groups = MeasureChange::grouped(&report.start, &report.outcome, &report.others);
    Grid::new("outcome of the search").num_columns(4).striped(true).spacing([14.0, 3.0]).show(ui, |ui| {
        heads(ui);
        for (found, changes) in &groups {
            let colour = match found.gain() {
                Ordering::Greater => good,
                Ordering::Less => bad,
                Ordering::Equal => plain,
            };
            group(ui, (found.title(), colour), changes);
        }
        if let Some([before, after]) = report.classes {
            let name = ui.label("Estimate after GIA's ranges");
            name.on_hover_text("The class that the proportions would have after what GIA publishes of round brilliants of diamond. \
                It is not a grade, and no part of the goal.");
            [before, after].into_iter().for_each(|class| drop(right(ui, class.to_string().into())));
            ui.end_row();
        }
        numbers(model, report, ui);
    });
    if !report.held.is_empty() {
        let held: Vec<String> = report.held.iter().map(|number| number.key.to_string()).collect();
        let text = format!("Held, because a change of it alone breaks a meet: {}.", held.join(", "));
        ui.label(RichText::new(text).weak());
    }
}

fn heads(ui: &mut Ui) {
    ui.label("");
    for name in ["before", "after", "change"] {
        right(ui, RichText::new(name).weak());
    }
    ui.end_row();
}

/// Draws the measures of a group under its name.
fn group(ui: &mut Ui, (name, colour): (&str, Color32), changes: &[MeasureChange]) {
    ui.label(RichText::new(name).strong().color(colour));
    ui.end_row();
    for change in changes {
        ui.label(format!("{}{}", measure_words::name(change.of), change.conditions()));
        for value in [change.before, change.after] {
            right(ui, part(value).into()).on_hover_text(measure_words::value(value));
        }
        right(ui, RichText::new(signed(100.0 * change.by(), 2)).color(colour));
        ui.end_row();
    }
}

/// Writes a value with its error.
fn part(value: Interval) -> String {
    if value.most.is_finite() {
        format!("{:.2} ± {:.2} %", 100.0 * value.middle(), 100.0 * value.error())
    } else {
        format!("at least {:.2} %", 100.0 * value.least)
    }
}

/// Draws the numbers that changed, and the limits on the geometry.
fn numbers(model: &Model, report: &SearchReport, ui: &mut Ui) {
    ui.label(RichText::new("Numbers").strong());
    ui.end_row();
    for (number, &after) in report.numbers.iter().zip(&report.outcome.values) {
        let known = model.session.search.form.numbers.iter().find(|known| known.key == number.key);
        let written =
            |value: f64| known.map_or_else(|| fixed(value, 2), |known: &NumberChoice| known.written(value));
        let name = known.map_or_else(|| number.key.to_string(), |known| known.name.clone());
        let name = format!("{name}{}", number.end_of_range(after));
        line(ui, &name, [written(number.start), written(after), signed(after - number.start, 2)]);
    }
    for ((name, before), (_, after)) in report.start.figures.iter().zip(&report.outcome.best.figures) {
        let texts = [fixed(*before, 4), fixed(*after, 4), signed(after - before, 4)];
        line(ui, name, texts);
    }
    let [before, after] = report.outcome.audits.each_ref().map(|audit| audit.findings.len());
    let by = after as i64 - before as i64;
    line(ui, "findings of the audit", [before.to_string(), after.to_string(), signed(by as f64, 0)]);
}

fn line(ui: &mut Ui, name: &str, texts: [String; 3]) {
    ui.label(name);
    for text in texts {
        right(ui, text.into());
    }
    ui.end_row();
}

/// Draws a text at the right end of its column.
fn right(ui: &mut Ui, text: RichText) -> Response {
    let layout = egui::Layout::right_to_left(egui::Align::Center);
    let size = vec2(COLUMN, ui.spacing().interact_size.y);
    ui.allocate_ui_with_layout(size, layout, |ui| {
        ui.set_min_width(COLUMN);
        ui.label(text)
    })
    .inner
}
