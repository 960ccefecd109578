//! Lines about the progress of long work, where standard error is no terminal: a file, or the log of a batch job.

use std::time::Duration;

/// The shortest time between two lines, and before the first one.
const APART: Duration = Duration::from_secs(10);

/// The longest time without a line.
const SILENCE: Duration = Duration::from_secs(60);

/// The lines of one piece of work. There is one for each tenth of the work and at least one a minute, but no two within 10
/// seconds, and none within the first 10.
pub struct ProgressLines {
    what: String,
    /// The time when the last line was printed, counted from the beginning of the work.
    last: Duration,
    /// The tenths of the work that were done at the last line.
    tenths: u32,
}

impl ProgressLines {
    pub fn new(what: &str) -> Self {
        Self { what: what.to_owned(), last: Duration::ZERO, tenths: 0 }
    }

    /// Returns the line that is due once a part of the work, 0 to 1, is done after `elapsed`; `None` where none is
    /// due.
    pub fn line(&mut self, done: f64, elapsed: Duration) -> Option<String> {
        let (tenths, silent) = ((done * 10.0) as u32, elapsed.saturating_sub(self.last));
        let is_due = silent >= APART && (tenths > self.tenths || silent >= SILENCE);
        if !is_due || done >= 1.0 {
            return None;
        }
        (self.last, self.tenths) = (elapsed, tenths);
        // The estimate assumes that the rest takes as long for each part as the work so far. A duration of many ages
        // does not fit the type.
        let left = Duration::try_from_secs_f64(elapsed.as_secs_f64() * (1.0 - done) / done).ok();
        let left = left.map_or(String::new(), |left| format!(", about {} left", in_words(left)));
        Some(format!("{}: {} % done{left}", self.what, (done * 100.0) as u32))
    }
}

/// Returns a duration in words, rounded to the accuracy of an estimate.
fn in_words(time: Duration) -> String {
    let seconds = time.as_secs_f64();
    let minutes = (seconds / 60.0).round() as u64;
    if seconds < 9.5 {
        format!("{} s", seconds.ceil())
    } else if seconds < 95.0 {
        format!("{} s", 10.0 * (seconds / 10.0).round())
    } else if minutes < 60 {
        format!("{minutes} min")
    } else if minutes < 48 * 60 {
        format!("{} h {} min", minutes / 60, minutes % 60)
    } else {
        format!("{} days", (minutes as f64 / (24.0 * 60.0)).round())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the lines that are printed, with their times in seconds, for work that takes `whole` seconds and
    /// checks the clock `often` times.
    fn lines(whole: f64, often: u32) -> Vec<(f64, String)> {
        let mut lines = ProgressLines::new("sweeping x");
        let parts = (0..=often).map(|k| f64::from(k) / f64::from(often));
        let at = |part: f64| Duration::from_secs_f64(whole * part);
        parts.filter_map(|part| Some((whole * part, lines.line(part, at(part))?))).collect()
    }

    #[test]
    fn short_work_says_nothing() {
        for whole in [0.0, 1.0, 9.99, 10.0] {
            assert_eq!(lines(whole, 1000), [], "{whole}");
        }
    }

    #[test]
    fn each_tenth_is_told_where_tenths_take_long_enough() {
        let told = lines(200.0, 1000);
        let expected: Vec<f64> = (1..10).map(|k| 20.0 * f64::from(k)).collect();
        assert!(told.iter().map(|(at, _)| *at).eq(expected), "{told:?}");
        assert_eq!(told[0].1, "sweeping x: 10 % done, about 3 min left");
        assert_eq!(told[8].1, "sweeping x: 90 % done, about 20 s left");
    }

    #[test]
    fn no_two_lines_are_within_ten_seconds_and_none_is_more_than_a_minute_late() {
        for whole in [12.0, 30.0, 99.0, 700.0, 5000.0, 1e6] {
            let told = lines(whole, 1_000_000);
            assert!(!told.is_empty() && told[0].0 >= 10.0, "{whole}: {:?}", told.first());
            let ends = told.iter().map(|(at, _)| *at).chain([whole]);
            let gaps: Vec<f64> =
                std::iter::once(0.0).chain(ends.clone()).zip(ends).map(|(a, b)| b - a).collect();
            let tick = whole * 1e-6;
            assert!(gaps.iter().all(|gap| *gap <= 60.0 + tick), "{whole}");
            assert!(gaps.iter().rev().skip(1).all(|gap| *gap >= 10.0 - tick), "{whole}");
        }
    }

    #[test]
    fn estimates_follow_the_pace_and_work_without_any_progress_has_none() {
        let mut lines = ProgressLines::new("report");
        assert_eq!(lines.line(0.0, Duration::from_secs(59)), None);
        assert_eq!(lines.line(0.0, Duration::from_secs(61)).unwrap(), "report: 0 % done");
        assert_eq!(
            lines.line(0.01, Duration::from_secs(122)).unwrap(),
            "report: 1 % done, about 3 h 21 min left"
        );
        let slower = lines.line(0.5, Duration::from_secs(7200)).unwrap();
        assert_eq!(slower, "report: 50 % done, about 2 h 0 min left");
        // Work that is more than expected goes back, and prints nothing until it is further than before.
        assert_eq!(lines.line(0.4, Duration::from_secs(7220)), None);
        assert_eq!(lines.line(1.0, Duration::from_secs(9999)), None);
    }

    #[test]
    fn times_are_told_as_finely_as_they_are_known() {
        let words =
            [0.2, 9.0, 12.0, 94.0, 100.0, 3500.0, 5400.0, 1e6].map(|s| in_words(Duration::from_secs_f64(s)));
        assert_eq!(words, ["1 s", "9 s", "10 s", "90 s", "2 min", "58 min", "1 h 30 min", "12 days"]);
    }
}
