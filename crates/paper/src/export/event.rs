//! The events and the progress that long work reports.

use brillianteer_base::{Failure, Watch};
use std::path::Path;

/// An event of long work, for the user.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Event<'a> {
    /// Work on this output begins.
    Begun(&'a str),
    /// This file is finished.
    Written(&'a Path),
    /// The work deviates from the request; the text says how.
    Note(&'a str),
    /// Something about the result is unusual. The text begins with the stone's file.
    Warning(&'a str),
}

/// A callback that receives each [`Event`]; an error from it ends the work.
pub type Reporter<'a> = &'a dyn Fn(Event) -> Result<(), Failure>;

/// The progress of one piece of work, divided among its steps: each step has a watch that runs from 0 to 1.
pub(crate) struct WorkShares<'a> {
    watch: Watch<'a>,
    parts: f64,
    done: f64,
}

impl<'a> WorkShares<'a> {
    /// Begins work of this many parts in all.
    pub fn new(watch: Watch<'a>, parts: f64) -> Self {
        Self { watch, parts, done: 0.0 }
    }

    /// Runs a step that counts as `parts` parts, unless the watch asks to stop first.
    pub fn step<T>(
        &mut self,
        parts: f64,
        work: impl FnOnce(Watch) -> Result<T, Failure>,
    ) -> Result<T, Failure> {
        let (watch, all, before) = (self.watch, self.parts, self.done);
        let watch = move |done: f64| watch((before + parts * done) / all);
        self.done += parts;
        if watch(0.0).is_break() {
            return Err(Failure::Stopped);
        }
        work(&watch)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::ops::ControlFlow;
    use std::sync::Mutex;

    #[test]
    fn parts_of_parts_are_told_as_parts_of_the_whole() {
        let parts = Mutex::new(vec![]);
        let watch = |done| {
            parts.lock().unwrap().push(done);
            if done > 0.9 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let mut pace = WorkShares::new(&watch, 4.0);
        let half = |watch: Watch| Ok(watch(0.5).is_continue());
        assert!(pace.step(2.0, |watch| WorkShares::new(watch, 2.0).step(1.0, half)).unwrap());
        pace.step(1.0, |_| Ok(())).unwrap();
        assert!(pace.step(1.0, half).unwrap());
        let stopped = pace.step(1.0, |_| -> Result<(), Failure> { unreachable!() });
        assert!(matches!(stopped, Err(Failure::Stopped)));
        assert_eq!(*parts.lock().unwrap(), [0.0, 0.0, 0.125, 0.5, 0.75, 0.875, 1.0]);
    }
}
