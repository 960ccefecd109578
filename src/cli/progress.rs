//! Progress bars of long work, and the end of the program by Ctrl-C or SIGTERM.

use super::console::{report, say};
use super::progress_lines::ProgressLines;
use brillianteer_base::Failure;
use brillianteer_files::abandon_writes;
use brillianteer_paper::export::Event;
use indicatif::{ProgressBar, ProgressStyle};
#[cfg(unix)]
use signal_hook::{
    consts::{SIGINT, SIGTERM, SIGXFSZ},
    iterator::Signals,
};
use std::io::IsTerminal;
use std::ops::ControlFlow;
use std::path::Path;
#[cfg(unix)]
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError, mpsc};
use std::time::{Duration, Instant};

/// The progress bar on the screen, which is cleared when a signal ends the program.
static SHOWN: Mutex<Option<ProgressBar>> = Mutex::new(None);

/// The longest time that the program waits at its end for the bar to be cleared. A thread that prints past the bar
/// holds the bar's lock, and keeps it as long as nobody reads the output.
const CLEARING: Duration = Duration::from_millis(200);

/// The first flag is true where the first signal asks the work to finish early; the second once that signal has come.
static FINISHES: AtomicBool = AtomicBool::new(false);
static IS_ASKED: AtomicBool = AtomicBool::new(false);

/// Lets the first signal from here on ask the work to finish early instead of ending the program: [`is_asked_to_finish`] is
/// true then. The second signal ends the program.
pub fn finish_on_signals() {
    FINISHES.store(true, Ordering::Relaxed);
}

/// Returns whether a signal has asked the work to finish early.
pub fn is_asked_to_finish() -> bool {
    IS_ASKED.load(Ordering::Relaxed)
}

/// Takes a signal as the request to finish early; returns whether it did, which only the first signal can.
fn ask_to_finish() -> bool {
    let is_first = FINISHES.load(Ordering::Relaxed) && !IS_ASKED.swap(true, Ordering::Relaxed);
    if is_first {
        say("stopping; what was found so far follows");
    }
    is_first
}

/// Makes an interruption (Ctrl-C) or a request to terminate (SIGTERM) end the program at once, whatever it is doing.
///
/// Temporary files are removed, finished files stay, and the exit code is 128 plus the signal's number. A second signal has
/// the system's default effect, in case the first one is kept waiting.
pub fn end_on_signals() {
    // An error here is ignored: without the handler a signal still ends the program, but leaves temporary files
    // behind.
    // A file beyond the limit of `ulimit -f` is then an error of its writing, which leaves nothing behind, and not the end of
    // the program.
    #[cfg(unix)]
    let _ = signal_hook::flag::register(SIGXFSZ, Arc::new(AtomicBool::new(false)));
    #[cfg(unix)]
    if let Ok(mut signals) = Signals::new([SIGINT, SIGTERM]) {
        std::thread::spawn(move || {
            let mut signals = signals.forever().skip_while(|_| ask_to_finish());
            if let Some(first) = signals.next() {
                std::thread::spawn(move || end(first));
            }
            for again in signals {
                let _ = signal_hook::low_level::emulate_default_handler(again);
            }
        });
    }
    #[cfg(not(unix))]
    let _ = ctrlc::set_handler(|| {
        if !ask_to_finish() {
            end(SIGINT);
        }
    });
}

/// The number that stands for Ctrl-C where the system has no signals.
#[cfg(not(unix))]
const SIGINT: i32 = 2;

/// Removes temporary files, clears the bar and ends the program with the exit code of a signal.
fn end(signal: i32) -> ! {
    let _until_the_end = abandon_writes();
    let (cleared, is_cleared) = mpsc::channel();
    std::thread::spawn(move || {
        if let Some(bar) = SHOWN.lock().unwrap_or_else(PoisonError::into_inner).take() {
            bar.finish_and_clear();
        }
        let _ = cleared.send(());
    });
    let _ = is_cleared.recv_timeout(CLEARING);
    say("error: stopped");
    // Other threads are still at work, so the memory that they use must not be torn down.
    #[cfg(unix)]
    signal_hook::low_level::exit(128 + signal);
    #[cfg(not(unix))]
    std::process::exit(128 + signal)
}

/// The time after which a sign says that a file is still being read.
const MOMENT: Duration = Duration::from_millis(500);

/// Reads a file. On a terminal a sign says so where this takes more than a moment, as a scan of many triangles does, unless other
/// progress is shown.
pub fn while_reading<T>(file: &Path, read: impl FnOnce() -> T) -> T {
    if !std::io::stderr().is_terminal() {
        return read();
    }
    let what = format!("reading {}", file.display());
    let (ended, is_ended) = mpsc::channel::<()>();
    // The scope owns the sender, so that the sign ends with the reading, however that ends.
    std::thread::scope(move |scope| {
        scope.spawn(move || sign(MOMENT, &is_ended, || show_sign(what)));
        let found = read();
        drop(ended);
        found
    })
}

/// Shows a sign after a moment, until the sender is gone; nothing where it is gone before.
fn sign(moment: Duration, is_ended: &mpsc::Receiver<()>, show: impl FnOnce() -> Option<ProgressBar>) {
    if is_ended.recv_timeout(moment) != Err(mpsc::RecvTimeoutError::Timeout) {
        return;
    }
    if let Some(bar) = show() {
        let _ = is_ended.recv();
        *SHOWN.lock().unwrap_or_else(PoisonError::into_inner) = None;
        bar.finish_and_clear();
    }
}

/// Shows a sign with the time that has passed; `None` where other progress is shown.
fn show_sign(what: String) -> Option<ProgressBar> {
    let mut shown = SHOWN.lock().unwrap_or_else(PoisonError::into_inner);
    if shown.is_some() {
        return None;
    }
    let bar = ProgressBar::new_spinner().with_message(what).with_elapsed(MOMENT);
    if let Ok(style) = ProgressStyle::with_template("{msg:40!} {spinner} {elapsed:>4}") {
        bar.set_style(style);
    }
    bar.enable_steady_tick(Duration::from_millis(200));
    *shown = Some(bar.clone());
    Some(bar)
}

/// The progress of one piece of work. On a terminal it is a bar, which appears after a moment; elsewhere it is lines of text now
/// and then.
pub struct WorkProgress {
    bar: ProgressBar,
    /// The lines, and the time when the work began; `None` on a terminal.
    lines: Option<(Instant, Mutex<ProgressLines>)>,
}

impl WorkProgress {
    pub fn new(what: &str) -> Self {
        let bar = ProgressBar::new(1000).with_message(what.to_string());
        if let Ok(style) = ProgressStyle::with_template("{msg:40!} {bar:30} {percent:>3} % {eta:>4}") {
            bar.set_style(style);
        }
        let lines = bar.is_hidden().then(|| (Instant::now(), Mutex::new(ProgressLines::new(what))));
        bar.enable_steady_tick(Duration::from_millis(200));
        *SHOWN.lock().unwrap_or_else(PoisonError::into_inner) = Some(bar.clone());
        Self { bar, lines }
    }

    /// Returns a [`brillianteer_base::Watch`] that shows the progress and never stops the work.
    pub fn watch(&self) -> impl Fn(f64) -> ControlFlow<()> + Sync + '_ {
        |done| {
            self.bar.set_position((done * 1000.0) as u64);
            // A thread that finds another one at the lines has no newer progress to report.
            if let Some((begun, lines)) = &self.lines
                && let Ok(mut lines) = lines.try_lock()
                && let Some(line) = lines.line(done, begun.elapsed())
            {
                say(&line);
            }
            ControlFlow::Continue(())
        }
    }

    /// Shows the present output beside the bar, and prints files, notes and warnings above it.
    pub fn report(&self, event: Event) -> Result<(), Failure> {
        if let Event::Begun(what) = event {
            self.bar.set_message(what.to_string());
        }
        self.bar.suspend(|| report(event))
    }
}

impl Drop for WorkProgress {
    fn drop(&mut self) {
        *SHOWN.lock().unwrap_or_else(PoisonError::into_inner) = None;
        self.bar.finish_and_clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sign_is_shown_for_what_takes_longer_than_a_moment_and_until_it_ends() {
        let (ended, is_ended) = mpsc::channel();
        drop(ended);
        sign(Duration::from_secs(600), &is_ended, || unreachable!("it has ended before"));
        let (ended, is_ended) = mpsc::channel();
        let bar = ProgressBar::hidden();
        let own = bar.clone();
        sign(Duration::ZERO, &is_ended, move || {
            assert!(!own.is_finished());
            drop(ended);
            Some(own)
        });
        assert!(bar.is_finished());
    }
}
