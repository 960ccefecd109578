//! What a search has won and what it gave up for it: each measure before and after, and the numbers that did it.

use crate::app::model::Model;
use crate::app::model::cut_search::SearchReport;
use crate::app::model::goal_form::NumberChoice;
use crate::app::theme;
use crate::measure::Interval;
use crate::measure::measure_words;
use crate::search::GoalValue;
use egui::{Color32, Grid, Response, RichText, Ui, vec2};

/// Changes of a measure below this part of the face are none.
const SAME: f64 = 5e-5;

/// The width of a column of numbers, points.
const COLUMN: f32 = 76.0;

/// A measure before and after.
struct Change {
    name: String,
    before: Interval,
    after: Interval,
    /// Above 0 where more of it is better, below 0 where less is, and 0 where neither is.
    wanted: f64,
}

impl Change {
    fn by(&self) -> f64 {
        self.after.middle() - self.before.middle()
    }

    /// Returns 1 for a change for the better, -1 for one for the worse, and 0 for none or one that is neither.
    fn gain(&self) -> i8 {
        let gain = if self.by().abs() < SAME { 0.0 } else { self.wanted * self.by() };
        i8::from(gain > 0.0) - i8::from(gain < 0.0)
    }
}

/// Draws the measures in groups, and the numbers.
pub fn show(model: &Model, report: &SearchReport, ui: &mut Ui) {
    let weighed = report.start.values.iter().zip(&report.outcome.best.values).map(|(before, after)| Change {
        name: name_of(before),
        before: before.value,
        after: after.value,
        wanted: before.weight,
    });
    let other = report.others.iter().map(|other| Change {
        name: measure_words::name(other.name),
        before: other.before,
        after: other.after,
        wanted: other.wanted(),
    });
    let (weighed, other): (Vec<Change>, Vec<Change>) = (weighed.collect(), other.collect());
    let [good, bad] = [theme::good(ui.visuals()), theme::bad(ui.visuals())];
    let plain = ui.visuals().text_color();
    let is = |gain: i8| move |change: &&Change| change.gain() == gain;
    let taste = |change: &&Change| change.wanted == 0.0 && change.by().abs() >= SAME;
    Grid::new("outcome of the search").num_columns(4).striped(true).spacing([14.0, 3.0]).show(ui, |ui| {
        heads(ui);
        group(ui, ("Won", good), weighed.iter().filter(is(1)));
        group(ui, ("Given up", bad), weighed.iter().filter(is(-1)));
        group(ui, ("As it was", plain), weighed.iter().filter(is(0)));
        // What was lost is read first.
        group(ui, ("Not asked for, worse", bad), other.iter().filter(is(-1)));
        group(ui, ("Not asked for, better", good), other.iter().filter(is(1)));
        group(ui, ("Not asked for, a matter of taste", plain), other.iter().filter(taste));
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

/// Draws the measures of a group under its name; nothing where there are none.
fn group<'a>(ui: &mut Ui, (name, colour): (&str, Color32), changes: impl Iterator<Item = &'a Change>) {
    let mut changes = changes.peekable();
    if changes.peek().is_none() {
        return;
    }
    ui.label(RichText::new(name).strong().color(colour));
    ui.end_row();
    for change in changes {
        ui.label(&change.name);
        for value in [change.before, change.after] {
            right(ui, part(value).into()).on_hover_text(measure_words::value(value));
        }
        right(ui, RichText::new(format!("{:+.2}", 100.0 * change.by())).color(colour));
        ui.end_row();
    }
}

/// Writes a value without its interval.
fn part(value: Interval) -> String {
    match value.most.is_finite() {
        true => format!("{:.2} %", 100.0 * value.middle()),
        false => format!("at least {:.2} %", 100.0 * value.least),
    }
}

/// Draws the numbers that changed, and the limits on the geometry.
fn numbers(model: &Model, report: &SearchReport, ui: &mut Ui) {
    ui.label(RichText::new("Numbers").strong());
    ui.end_row();
    for (number, &after) in report.numbers.iter().zip(&report.outcome.values) {
        let known = model.session.search.form.numbers.iter().find(|known| known.key == number.key);
        let written = |value: f64| {
            known.map_or_else(|| format!("{value:.2}"), |known: &NumberChoice| known.written(value))
        };
        let name = known.map_or_else(|| number.key.to_string(), |known| known.name.clone());
        line(ui, &name, [written(number.start), written(after), format!("{:+.2}", after - number.start)]);
    }
    for ((name, before), (_, after)) in report.start.figures.iter().zip(&report.outcome.best.figures) {
        let texts = [format!("{before:.4}"), format!("{after:.4}"), format!("{:+.4}", after - before)];
        line(ui, name, texts);
    }
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

/// Returns the name of a measure with the material and the view in which it is taken.
pub fn name_of(value: &GoalValue) -> String {
    let material = value.material.as_ref().map_or(String::new(), |name| format!(", {name}"));
    let tilt = match (value.tilt_deg, value.azimuth_deg) {
        (0.0, _) => String::new(),
        (tilt, 0.0) => format!(", tilt {tilt}°"),
        (tilt, azimuth) => format!(", tilt {tilt}° toward {azimuth}°"),
    };
    format!("{}{material}{tilt}", measure_words::name(value.of))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_is_a_gain_by_what_is_wanted_and_none_within_rounding() {
        let change = |by: f64, wanted: f64| {
            let before = Interval::from(0.5, 0.5);
            let after = Interval::from(0.5 + by, 0.5 + by);
            Change { name: String::new(), before, after, wanted }.gain()
        };
        assert_eq!([change(0.1, 1.0), change(0.1, -1.0), change(-0.1, -2.0)], [1, -1, 1]);
        assert_eq!([change(1e-5, 1.0), change(0.1, 0.0)], [0, 0]);
    }
}
