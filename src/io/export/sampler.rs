//! Pictures by point rays, on a graphics card or on the processor, which also takes over where the card fails.

use super::event::Reporter;
use crate::io::{Failure, WriteError};
use crate::picture::Rows;
use crate::picture::by_rays::{self, ScopeSampling};
use crate::scene::Film;
use crate::trace::{RayTracer, Subject, Watch};

impl RayTracer<'_> {
    /// Does work, and does it again on the processor where the card fails, with a note of the reason.
    ///
    /// # Errors
    /// An error of `work` that is not the card's, or an error of `tell`.
    pub fn or_rays<T>(
        self,
        #[cfg_attr(not(feature = "gpu"), expect(unused_variables, reason = "only a card can fail"))]
        tell: Reporter,
        mut work: impl FnMut(Self) -> Result<T, Failure>,
    ) -> Result<T, Failure> {
        match work(self) {
            #[cfg(feature = "gpu")]
            Err(Failure::Card(error)) => {
                tell(super::Event::Note(&format!("{error}: tracing by rays on the processor")))?;
                work(Self::Rays)
            }
            done => done,
        }
    }

    /// Traces a picture row by row, in the channels of [`by_rays::trace`], and passes the rows to `each`.
    ///
    /// # Errors
    /// An error of `each`, that of a card that fails, or [`Failure::Stopped`] when `watch` asks to stop.
    pub fn rows(
        self,
        look: Subject,
        film: &Film,
        manner: &ScopeSampling,
        watch: Watch,
        mut each: impl FnMut(&Rows) -> Result<(), WriteError>,
    ) -> Result<(), Failure> {
        let Subject { specimen, medium, view, scope } = look;
        let solid = specimen.solid();
        let each = |rows: &Rows| each(rows).map_err(Failure::from);
        match self {
            Self::Rays => by_rays::trace(solid, medium, view, scope, film, manner, watch, each),
            #[cfg(feature = "gpu")]
            Self::Card(gpu) => {
                crate::picture::by_gpu::trace(gpu, solid, medium, view, scope, film, manner, watch, each)
            }
        }
    }
}
