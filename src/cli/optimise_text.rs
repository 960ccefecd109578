//! The output of `optimise`: the measures that rose, those that fell, and the numbers that changed.

use super::sweep_plot::label;
use brillianteer_cut::Cut;
use brillianteer_math::{rounded, signed};
use brillianteer_measure::Interval;
use brillianteer_search::{
    DesignSearch, Goal, GoalValue, MeasureChange, OtherMeasure, SearchOutcome, VariedNumber,
    estimated_classes,
};
use serde_json::{Value, json};
use std::fmt::Write;

/// Formats the outcome of a search.
pub fn text(goal: &Goal, search: &DesignSearch, outcome: &SearchOutcome, others: &[OtherMeasure]) -> String {
    let start = search.objective().start();
    let mut text = String::new();
    let name = goal.name.as_deref().unwrap_or("goal");
    let total = |value: Interval| format!("{:.5} ± {:.5}", value.middle(), value.error());
    let by = outcome.best.total.middle() - start.total.middle();
    let _ = writeln!(
        text,
        "{name}: {} before, {} after, {}",
        total(start.total),
        total(outcome.best.total),
        signed(by, 5)
    );
    let _ = writeln!(text, "{} designs appraised\n", outcome.appraised);
    let _ = writeln!(text, "  {:<38}{:>18}{:>18}{:>9}", "", "before", "after", "change");
    for (group, changes) in MeasureChange::grouped(start, outcome, others) {
        let _ = writeln!(text, "{}", group.title());
        changes.iter().for_each(|change| text.push_str(&line(change)));
    }
    if let Some([before, after]) = estimated_classes(search, outcome) {
        let _ = writeln!(
            text,
            "Class, estimated after GIA's published ranges; not a grade, and no part of the goal"
        );
        let _ = writeln!(text, "  {:<38}{before:>12}{after:>18}", "");
    }
    let _ = writeln!(text, "Numbers");
    for (number, value) in search.objective().numbers().iter().zip(&outcome.values) {
        let VariedNumber { key, least, most, start } = number;
        let range =
            format!("from {} to {}{}", rounded(*least, 4), rounded(*most, 4), number.end_of_range(*value));
        let label = label(key, &search.objective().design().cut);
        let _ = writeln!(
            text,
            "  {label:<38}{start:>12.4}{value:>18.4}{:>15}   {range}",
            signed(value - start, 4)
        );
    }
    text.push_str(&limits(search, outcome));
    let [before, after] = outcome.audits.each_ref().map(|audit| audit.findings.len());
    let _ = writeln!(text, "Audit");
    let mut count = |name: &str, [before, after]: [usize; 2]| {
        let by = after as i64 - before as i64;
        let _ = writeln!(text, "  {name:<38}{before:>12}{after:>18}{:>15}", signed(by as f64, 0));
    };
    count("findings", [before, after]);
    outcome.findings().into_iter().for_each(|(kind, counts)| count(kind.name(), counts));
    let corners = search.objective().kept_corners();
    if let (Cut::Tiers(_), true) = (&outcome.design.cut, corners > 0) {
        let miss = |design| search.objective().miss_of_meets(design);
        let (before, after) = (miss(search.objective().design()), miss(&outcome.design));
        let _ = writeln!(
            text,
            "Meets: all {corners} corners of four facets or more are kept; planes miss them by at most {after:.0e} girdle \
             radii, before by {before:.0e}"
        );
    }
    text
}

/// Formats the figures that are limited, as rows of the table.
fn limits(search: &DesignSearch, outcome: &SearchOutcome) -> String {
    let start = search.objective().start();
    let mut text = String::new();
    if !start.figures.is_empty() {
        let _ = writeln!(text, "Limits");
    }
    for ((name, before), (_, after)) in start.figures.iter().zip(&outcome.best.figures) {
        let (low, high) = search.objective().ends_of(name);
        let [least, most] = [low, high].map(|end| rounded(end, 6));
        let ends = match (low.is_finite(), high.is_finite()) {
            (true, true) => format!("from {least} to {most}"),
            (true, false) => format!("at least {least}"),
            _ => format!("at most {most}"),
        };
        let _ = writeln!(
            text,
            "  {name:<38}{before:>12.4}{after:>18.4}{:>15}   {ends}",
            signed(after - before, 4)
        );
    }
    text
}

/// Formats one change as a row of the table.
fn line(change: &MeasureChange) -> String {
    let part = |value: Interval| match value.most.is_finite() {
        true => format!("{:7.2} ± {:.2} %", 100.0 * value.middle(), 100.0 * value.error()),
        false => format!("at least {:.2} %", 100.0 * value.least),
    };
    format!(
        "  {:<38}{:>18}{:>18}{:>9}\n",
        format!("{}{}", change.of, change.conditions()),
        part(change.before),
        part(change.after),
        signed(100.0 * change.by(), 2)
    )
}

/// Returns the outcome of a search as docs/formats.md describes it.
pub fn json_value(
    file: &str,
    search: &DesignSearch,
    outcome: &SearchOutcome,
    others: &[OtherMeasure],
) -> Value {
    let start = search.objective().start();
    let value = |(before, after): (&GoalValue, &GoalValue)| {
        json!({
            "of": before.of.to_string(),
            "material": before.material.as_ref().map(ToString::to_string),
            "tilt": before.tilt_deg,
            "azimuth": before.azimuth_deg,
            "weight": before.weight,
            "before": before.value,
            "after": after.value,
        })
    };
    let values: Vec<Value> = start.values.iter().zip(&outcome.best.values).map(value).collect();
    let number = |(number, value): (&VariedNumber, &f64)| {
        json!({
            "key": number.key.to_string(),
            "least": number.least,
            "most": number.most,
            "before": number.start,
            "after": value,
        })
    };
    let numbers: Vec<Value> = search.objective().numbers().iter().zip(&outcome.values).map(number).collect();
    let limit = |((name, before), (_, after)): (&(String, f64), &(String, f64))| json!({ "name": name, "before": before, "after": after });
    let limits: Vec<Value> = start.figures.iter().zip(&outcome.best.figures).map(limit).collect();
    let other = |other: &OtherMeasure| json!({ "of": other.name.to_string(), "before": other.before, "after": other.after });
    json!({
        "file": file,
        "total": { "before": start.total, "after": outcome.best.total },
        "measures": values,
        "estimate_after_gia": estimated_classes(search, outcome).map(|[before, after]| json!({ "before": before, "after": after })),
        "others": others.iter().map(other).collect::<Vec<Value>>(),
        "numbers": numbers,
        "held": search.objective().held().iter().map(|number| number.key.to_string()).collect::<Vec<String>>(),
        "limits": limits,
        "keeps_limits": outcome.keeps_limits,
        "audit": json!({
            "before": outcome.audits[0].findings.len(),
            "after": outcome.audits[1].findings.len(),
            "kinds": outcome.findings().into_iter().map(|(kind, [before, after])| json!({
                "kind": kind,
                "before": before,
                "after": after,
            })).collect::<Vec<Value>>(),
        }),
        "kept_corners": search.objective().kept_corners(),
        "miss_of_meets": search.objective().miss_of_meets(&outcome.design),
        "appraised": outcome.appraised,
        "stopped": outcome.was_stopped,
        "curve": outcome.curve.iter().map(|point| json!([point.appraised, point.total])).collect::<Vec<Value>>(),
    })
}
