//! What long work says of itself, and how much of it is done.

use crate::io::Failure;
use crate::trace::Watch;
use std::path::Path;

/// Something to pass on to a person.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Event<'a> {
    /// What is being made from now on.
    Begun(&'a str),
    /// A file that is finished.
    Written(&'a Path),
    /// What is done otherwise than asked.
    Note(&'a str),
    /// What is odd about the result; begins with the stone's file.
    Warning(&'a str),
}

/// Takes what is told; an error ends the work.
pub type Reporter<'a> = &'a dyn Fn(Event) -> Result<(), Failure>;

/// Parts of one work, each of which has a watch of its own.
pub(super) struct WorkShares<'a> {
    watch: Watch<'a>,
    parts: f64,
    done: f64,
}

impl<'a> WorkShares<'a> {
    /// Work of so many parts.
    pub fn new(watch: Watch<'a>, parts: f64) -> Self {
        Self { watch, parts, done: 0.0 }
    }

    /// Does the next so many parts, unless the watch asks to stop first.
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
        let told = Mutex::new(vec![]);
        let watch = |done| {
            told.lock().unwrap().push(done);
            if done > 0.9 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let mut pace = WorkShares::new(&watch, 4.0);
        let half = |watch: Watch| Ok(watch(0.5).is_continue());
        assert!(pace.step(2.0, |watch| WorkShares::new(watch, 2.0).step(1.0, half)).unwrap());
        pace.step(1.0, |_| Ok(())).unwrap();
        assert!(pace.step(1.0, half).unwrap());
        let stopped = pace.step(1.0, |_| -> Result<(), Failure> { unreachable!() });
        assert!(matches!(stopped, Err(Failure::Stopped)));
        assert_eq!(*told.lock().unwrap(), [0.0, 0.0, 0.125, 0.5, 0.75, 0.875, 1.0]);
    }
}
