//! Pictures by point rays: on a graphics card or, and where the card fails, on the processor.

use super::event::Reporter;
use crate::io::{Failure, WriteError};
use crate::picture::Rows;
use crate::picture::by_rays::{self, ScopeSampling};
use crate::scene::Film;
use crate::trace::{RayTracer, Subject, Watch};

impl RayTracer<'_> {
    /// Does work, and again on the processor where the card fails, with a note of why.
    ///
    /// # Errors
    /// What `work` or `tell` answers, but for the card's.
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

    /// A picture, row by row: the channels of [`by_rays::trace`].
    ///
    /// # Errors
    /// What `each` answers, a card that fails, or [`Failure::Stopped`] when `watch` asks to stop.
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
