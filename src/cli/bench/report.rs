//! The times of `bench` as a table and as plain data that programs read.

use brillianteer_base::ByName;
use brillianteer_paper::table::{Column, Table};
use serde::Serialize;

/// The times of all tasks.
#[derive(Serialize)]
pub struct BenchReport {
    /// The number of threads of the processor.
    pub threads: usize,
    /// The graphics card in words.
    pub card: String,
    pub tasks: Vec<BenchTask>,
}

/// A picture, and the time that each tracer took for it.
#[derive(Serialize)]
pub struct BenchTask {
    /// The picture in words.
    #[serde(rename = "task")]
    pub what: String,
    /// The number of planes tested for the picture, if each ray tests all planes at each bounce.
    pub plane_tests: f64,
    #[serde(rename = "results")]
    pub rows: Vec<BenchRow>,
}

/// The time that one tracer took for a task.
#[derive(Serialize)]
pub struct BenchRow {
    /// The tracer's short name.
    pub tracer: &'static str,
    /// The tracer in words.
    pub by: String,
    /// The time, ms.
    #[serde(rename = "ms")]
    pub milliseconds: f64,
    /// `None` for beams, which test no planes.
    pub plane_tests_per_second: Option<f64>,
    /// The description of a graphics card's time; `None` for other tracers.
    pub card: Option<CardLine>,
}

/// The parts of a graphics card's time.
#[derive(Serialize)]
pub struct CardLine {
    /// The lines for the table.
    #[serde(skip)]
    pub text: String,
    /// The part of the measured peak of arithmetic that plane tests alone reach.
    pub of_peak: f64,
    /// The name of the largest part.
    pub bound: &'static str,
    /// The time of the longest dispatch, ms.
    pub longest_dispatch_ms: f64,
    /// The parts of the time by name; they add up to 1.
    pub parts: ByName<f64>,
}

impl BenchRow {
    /// Makes the row of a tracer, whose rate a [`BenchTask`] adds.
    pub fn new(tracer: &'static str, by: String, milliseconds: f64, card: Option<CardLine>) -> Self {
        Self { tracer, by, milliseconds, plane_tests_per_second: None, card }
    }
}

impl BenchTask {
    /// Makes a task of the times that tracers took for it.
    pub fn new(what: String, plane_tests: f64, mut rows: Vec<BenchRow>) -> Self {
        for row in rows.iter_mut().filter(|row| row.tracer != "beam") {
            row.plane_tests_per_second = Some(plane_tests / row.milliseconds * 1e3);
        }
        Self { what, plane_tests, rows }
    }

    /// Formats the times as a table.
    pub fn table(&self) -> String {
        let columns =
            [Column::right("time", 13), Column::right("plane tests", 12).after(1), Column::text("").after(2)];
        let mut table = Table::headed(columns);
        for row in &self.rows {
            let rate = row.plane_tests_per_second.map(|rate| format!("{:.1} G/s", rate / 1e9));
            let card = row.card.as_ref().map_or("", |card| &card.text);
            let time = format!("{:.2} ms", row.milliseconds);
            table.row([time.into(), rate.unwrap_or_default().into(), format!("{}{card}", row.by).into()]);
        }
        format!("{}\n{table}", self.what)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_times_have_the_keys_that_programs_read() {
        let card = CardLine {
            text: "\nof the peak".to_owned(),
            of_peak: 0.5,
            bound: "a",
            longest_dispatch_ms: 1.0,
            parts: [("a", 1.0)].into_iter().collect(),
        };
        let row = |tracer, card| BenchRow::new(tracer, "b".to_owned(), 2.0, card);
        let task = BenchTask::new("c".to_owned(), 4e8, vec![row("gpu", Some(card)), row("beam", None)]);
        assert_eq!(
            task.table(),
            "c\n         time  plane tests\n      2.00 ms    200.0 G/s  b\nof the peak\n      2.00 ms               b"
        );
        let report = BenchReport { threads: 1, card: "d".to_owned(), tasks: vec![task] };
        assert_eq!(
            serde_json::to_string(&report).unwrap(),
            concat!(
                r#"{"threads":1,"card":"d","tasks":[{"task":"c","plane_tests":400000000.0,"results":["#,
                r#"{"tracer":"gpu","by":"b","ms":2.0,"plane_tests_per_second":200000000000.0,"#,
                r#""card":{"of_peak":0.5,"bound":"a","longest_dispatch_ms":1.0,"parts":{"a":1.0}}},"#,
                r#"{"tracer":"beam","by":"b","ms":2.0,"plane_tests_per_second":null,"card":null}]}]}"#
            )
        );
    }
}
