//! The output of `optimise`: the measures that rose, those that fell, and the numbers that changed.

use super::sweep_plot::label;
use brillianteer_cut::Cut;
use brillianteer_math::{rounded, signed};
use brillianteer_measure::Interval;
use brillianteer_paper::table::{Column, Table, TableCell};
use brillianteer_search::{
    DesignSearch, Goal, MeasureChange, OtherMeasure, SearchOutcome, VariedNumber, estimated_classes,
};
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
    let _ = writeln!(text, "{}", measures(search, outcome, others));
    if let Some([before, after]) = estimated_classes(search, outcome) {
        let _ = writeln!(
            text,
            "Class, estimated after GIA's published ranges; not a grade, and no part of the goal"
        );
        let mut classes = numbers_table();
        classes.row(["".into(), before.to_string().into(), after.to_string().into()]);
        let _ = writeln!(text, "{classes}");
    }
    let _ = writeln!(text, "{}", numbers(search, outcome));
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

/// Returns a table of the measures that changed, group by group.
fn measures(search: &DesignSearch, outcome: &SearchOutcome, others: &[OtherMeasure]) -> Table {
    let columns = [
        Column::left("", 38),
        Column::right("before", 18),
        Column::right("after", 18),
        Column::right("change", 9),
    ];
    let mut table = Table::headed(columns).indented(2);
    for (group, changes) in MeasureChange::grouped(search.objective().start(), outcome, others) {
        table.line(group.title());
        changes.iter().for_each(|change| table.row(cells(change)));
    }
    table
}

/// Begins a table of numbers before and after, which stand under those of the measures without their errors.
fn numbers_table() -> Table {
    let number = |width| Column::right("", width).digits(4);
    let range = Column::text("").after(3);
    Table::new([Column::left("", 38), number(12), number(18), number(15), range]).indented(2)
}

/// Returns the table of the numbers that changed, of the figures that are limited, and of the counts of the audits.
fn numbers(search: &DesignSearch, outcome: &SearchOutcome) -> Table {
    let mut table = numbers_table();
    table.line("Numbers");
    for (number, value) in search.objective().numbers().iter().zip(&outcome.values) {
        let VariedNumber { key, least, most, start } = number;
        let range =
            format!("from {} to {}{}", rounded(*least, 4), rounded(*most, 4), number.end_of_range(*value));
        let label = label(key, &search.objective().design().cut);
        let by = signed(value - start, 4);
        table.row([
            label.into(),
            TableCell::Number(*start),
            TableCell::Number(*value),
            by.into(),
            range.into(),
        ]);
    }
    limits(search, outcome, &mut table);
    table.line("Audit");
    let mut count = |name: &str, [before, after]: [usize; 2]| {
        let by = after as i64 - before as i64;
        table.row([name.into(), before.into(), after.into(), signed(by as f64, 0).into()]);
    };
    count("findings", outcome.audits.each_ref().map(|audit| audit.findings.len()));
    outcome.findings().into_iter().for_each(|(kind, counts)| count(kind.name(), counts));
    table
}

/// Adds the figures that are limited.
fn limits(search: &DesignSearch, outcome: &SearchOutcome, table: &mut Table) {
    let start = search.objective().start();
    if !start.figures.is_empty() {
        table.line("Limits");
    }
    for ((name, before), (_, after)) in start.figures.iter().zip(&outcome.best.figures) {
        let (low, high) = search.objective().ends_of(name);
        let [least, most] = [low, high].map(|end| rounded(end, 6));
        let ends = match (low.is_finite(), high.is_finite()) {
            (true, true) => format!("from {least} to {most}"),
            (true, false) => format!("at least {least}"),
            _ => format!("at most {most}"),
        };
        let (values, by) =
            ([before, after].map(|value| TableCell::Number(*value)), signed(after - before, 4));
        let [before, after] = values;
        table.row([name.as_str().into(), before, after, by.into(), ends.into()]);
    }
}

/// Returns the cells of one change.
fn cells(change: &MeasureChange) -> [TableCell; 4] {
    let part = |value: Interval| {
        if value.most.is_finite() {
            format!("{:7.2} ± {:.2} %", 100.0 * value.middle(), 100.0 * value.error())
        } else {
            format!("at least {:.2} %", 100.0 * value.least)
        }
    };
    [
        format!("{}{}", change.of, change.conditions()).into(),
        part(change.before).into(),
        part(change.after).into(),
        signed(100.0 * change.by(), 2).into(),
    ]
}
