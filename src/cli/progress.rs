//! Progress bars on long work, and ending it by Ctrl-C or SIGTERM.

use super::{Failure, report, say};
use crate::io::abandon_writes;
use crate::io::export::Event;
use indicatif::{ProgressBar, ProgressStyle};
#[cfg(unix)]
use signal_hook::{
    consts::{SIGINT, SIGTERM},
    iterator::Signals,
};
use std::ops::ControlFlow;
use std::sync::{Mutex, PoisonError, mpsc};
use std::time::Duration;

/// The bar that is shown, to be cleared when a signal ends the program.
static SHOWN: Mutex<Option<ProgressBar>> = Mutex::new(None);

/// How long the end waits for the bar to be cleared: whoever prints past the bar holds its lock, for as long as nobody reads.
const CLEARING: Duration = Duration::from_millis(200);

/// Ends the program at once when it is interrupted (Ctrl-C) or asked to terminate, whatever it is doing: temporary files are
/// removed, finished files stay, and the exit code is 128 and the signal's number. A second signal ends it as if nothing
/// had been asked for, should the first be kept waiting.
pub fn end_on_signals() {
    // Without this a signal still ends the program, only less tidily: no reason to fail.
    #[cfg(unix)]
    if let Ok(mut signals) = Signals::new([SIGINT, SIGTERM]) {
        std::thread::spawn(move || {
            let mut signals = signals.forever();
            if let Some(first) = signals.next() {
                std::thread::spawn(move || end(first));
            }
            for again in signals {
                let _ = signal_hook::low_level::emulate_default_handler(again);
            }
        });
    }
    #[cfg(not(unix))]
    let _ = ctrlc::set_handler(|| end(SIGINT));
}

/// The number of an interruption where the system has no signals.
#[cfg(not(unix))]
const SIGINT: i32 = 2;

/// Ends the program as a signal asks to.
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
    // Other threads are still at work: what they use must not be torn down under them.
    #[cfg(unix)]
    signal_hook::low_level::exit(128 + signal);
    #[cfg(not(unix))]
    std::process::exit(128 + signal)
}

/// A bar for one piece of work; it shows itself after a moment, and only on a terminal.
pub struct WorkProgress(ProgressBar);

impl WorkProgress {
    pub fn new(what: &str) -> Self {
        let bar = ProgressBar::new(1000).with_message(what.to_string());
        if let Ok(style) = ProgressStyle::with_template("{msg:40!} {bar:30} {percent:>3} % {eta:>4}") {
            bar.set_style(style);
        }
        bar.enable_steady_tick(Duration::from_millis(200));
        *SHOWN.lock().unwrap_or_else(PoisonError::into_inner) = Some(bar.clone());
        Self(bar)
    }

    /// The bar as a [`crate::trace::Watch`].
    pub fn watch(&self) -> impl Fn(f64) -> ControlFlow<()> + Sync + '_ {
        |done| {
            self.0.set_position((done * 1000.0) as u64);
            ControlFlow::Continue(())
        }
    }

    /// Shows what is being made, and passes other things on past the bar.
    pub fn report(&self, told: Event) -> Result<(), Failure> {
        if let Event::Begun(what) = told {
            self.0.set_message(what.to_string());
        }
        self.0.suspend(|| report(told))
    }
}

impl Drop for WorkProgress {
    fn drop(&mut self) {
        *SHOWN.lock().unwrap_or_else(PoisonError::into_inner) = None;
        self.0.finish_and_clear();
    }
}
