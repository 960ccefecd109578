//! Long work that shows how much of it is done, and that can be stopped.

use std::ops::ControlFlow;

/// A callback of long work. It is called from time to time with the part that is done, 0 to 1, and stops the work by
/// returning `Break`.
pub type Watch<'a> = &'a (dyn Fn(f64) -> ControlFlow<()> + Sync);

/// The [`Watch`] that never stops the work.
pub fn unwatched(_done: f64) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// Calls a watch with the part that is done, 0 to 1.
///
/// # Errors
/// Fails where the watch asks to stop.
pub fn go_on(watch: Watch, done: f64) -> Result<(), Stopped> {
    if watch(done).is_break() { Err(Stopped) } else { Ok(()) }
}

/// The error of work that its [`Watch`] has stopped.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("stopped before it was done")]
pub struct Stopped;
