//! Floor 3: where light goes. Exact beams and point rays, which share nothing but Fresnel's equations.

pub mod beam;
pub mod environment;
#[cfg(feature = "gpu")]
pub mod gpu;
pub mod ray;
mod sampler;
pub mod sampling;

pub use sampler::{CannotTrace, RayTracer, Subject, Tracer};

use std::ops::ControlFlow;

/// Called now and then during long work with the part done, 0 to 1; answering `Break` stops the work.
pub type Watch<'a> = &'a (dyn Fn(f64) -> ControlFlow<()> + Sync);

/// The [`Watch`] that lets everything run.
pub fn unwatched(_done: f64) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// The work was stopped by its [`Watch`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("stopped before it was done")]
pub struct Stopped;
