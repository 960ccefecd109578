//! Progress bars on long work, and stopping it by Ctrl-C.

use super::{Failure, tell};
use crate::io::export::Told;
use indicatif::{ProgressBar, ProgressStyle};
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

static STOP: AtomicBool = AtomicBool::new(false);

/// Lets Ctrl-C stop the work in hand, so that no temporary file stays behind. A second one ends the program at once.
pub fn stop_on_interrupt() {
    // Without a handler Ctrl-C still ends the program, only less tidily: no reason to fail.
    let _ = ctrlc::set_handler(|| {
        if STOP.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
    });
}

/// A bar for one piece of work; it shows itself after a moment, and only on a terminal.
pub struct Progress(ProgressBar);

impl Progress {
    pub fn new(what: &str) -> Self {
        let bar = ProgressBar::new(1000).with_message(what.to_string());
        if let Ok(style) = ProgressStyle::with_template("{msg:40!} {bar:30} {percent:>3} % {eta:>4}") {
            bar.set_style(style);
        }
        bar.enable_steady_tick(Duration::from_millis(200));
        Self(bar)
    }

    /// The bar as a [`crate::trace::Watch`].
    pub fn watch(&self) -> impl Fn(f64) -> ControlFlow<()> + Sync + '_ {
        |done| {
            self.0.set_position((done * 1000.0) as u64);
            if STOP.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        }
    }

    /// Shows what is being made, and passes other things on past the bar.
    pub fn tell(&self, told: Told) -> Result<(), Failure> {
        if let Told::Begun(what) = told {
            self.0.set_message(what.to_string());
        }
        self.0.suspend(|| tell(told))
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
