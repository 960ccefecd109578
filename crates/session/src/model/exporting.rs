//! The state of the export dialog: the selection, and the progress of the files.

use super::export::ExportPlan;
use brillianteer_base::Failure;
use std::path::PathBuf;
use std::time::Duration;

/// The state of the export dialog.
#[derive(Debug, Clone)]
pub struct ExportForm {
    /// What is being exported.
    pub plan: ExportPlan,
    /// The export that is under way or has ended.
    pub run: Option<ExportRun>,
}

/// An export that is under way or has ended.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ExportRun {
    /// The files, in the order in which they are written.
    pub files: Vec<PathBuf>,
    /// The files written, the notes and the warnings, in words.
    pub messages: Vec<String>,
    /// The number of files written.
    pub written: usize,
    /// True once the user has asked the export to stop.
    pub is_stopped: bool,
    /// The result of the export, once it has ended.
    pub end: Option<Result<(), Failure>>,
    part: f64,
    elapsed: Duration,
}

/// The progress of an export.
#[derive(Debug)]
pub enum ExportEvent {
    /// The part done, 0 to 1, and the time since the start.
    Done(f64, Duration),
    /// A file has been written.
    Written(PathBuf),
    /// A note or a warning.
    Said(String),
    /// The export has ended.
    Ended(Result<(), Failure>),
}

impl ExportForm {
    /// Returns whether files are being written.
    pub fn is_busy(&self) -> bool {
        self.run.as_ref().is_some_and(|run| run.end.is_none())
    }
}

impl ExportRun {
    /// Begins with the files of a plan. Where they cannot be listed, the export itself reports the reason.
    pub fn of(plan: &ExportPlan) -> Self {
        Self { files: plan.files().unwrap_or_default(), ..Self::default() }
    }

    /// Updates the state by an event.
    pub fn hear(&mut self, event: ExportEvent) {
        match event {
            ExportEvent::Done(part, elapsed) => (self.part, self.elapsed) = (part, elapsed),
            ExportEvent::Written(path) => {
                self.written += 1;
                self.messages.push(format!("wrote {}", path.display()));
            }
            ExportEvent::Said(text) => self.messages.push(text),
            ExportEvent::Ended(end) => self.end = Some(end),
        }
    }

    /// Returns the part done, 0 to 1; for stopped work, the part that it reached.
    pub fn done(&self) -> f32 {
        if self.end == Some(Ok(())) { 1.0 } else { self.part as f32 }
    }

    /// Returns the name of the file that is being written and about how long the rest takes; once the export has
    /// ended, how far it came.
    pub fn standing(&self) -> String {
        let (written, all) = (self.written, self.files.len());
        match (&self.end, self.files.get(written)) {
            (Some(Ok(())), _) => format!("{written} of {all} files written"),
            (Some(Err(_)), _) => {
                let how = if self.is_stopped { "Stopped" } else { "Ended" };
                format!("{how} at {:.0} %, {written} of {all} files written", 100.0 * self.done())
            }
            (None, _) if self.is_stopped => "stopping…".to_owned(),
            (None, file) => {
                let name =
                    file.and_then(|f| f.file_name()).unwrap_or_default().to_string_lossy().into_owned();
                let left = left(self.elapsed, self.part);
                let left = left.map_or(String::new(), |left| format!(", about {} left", spoken(left)));
                format!("{name}, file {} of {all}{left}", (written + 1).min(all))
            }
        }
    }
}

/// The time that passes before the dialog shows the time left.
const FIRST_SECOND: Duration = Duration::from_secs(1);
/// The part of the work, 0 to 1, that is done before the dialog shows the time left.
const FIRST_PART: f64 = 0.02;

/// Returns how long the rest takes if work goes on as it did until its part `done`, 0 to 1; `None` where it is too
/// early for an estimate.
fn left(passed: Duration, done: f64) -> Option<Duration> {
    (passed >= FIRST_SECOND && done >= FIRST_PART).then(|| passed.mul_f64((1.0 - done).max(0.0) / done))
}

/// Returns a time in words: in minutes from two minutes on.
fn spoken(time: Duration) -> String {
    match time.as_secs() {
        seconds @ 0..120 => format!("{} s", seconds + 1),
        seconds => format!("{} min", seconds.div_ceil(60)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_time_left_is_told_once_enough_is_done() {
        let seconds = Duration::from_secs;
        assert_eq!(left(seconds(30), 0.01), None);
        assert_eq!(left(Duration::from_millis(300), 0.5), None);
        assert_eq!(left(seconds(30), 0.25), Some(seconds(90)));
        assert_eq!([seconds(0), seconds(90), seconds(150)].map(spoken), ["1 s", "91 s", "3 min"]);
    }
}
