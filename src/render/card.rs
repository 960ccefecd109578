//! The graphics card that tracing may use.

use crate::trace::RayTracer;
#[cfg(feature = "gpu")]
use crate::trace::gpu::{Gpu, GpuError};
#[cfg(feature = "gpu")]
use std::sync::OnceLock;

/// The graphics card that tracing may use.
#[derive(Clone, Copy)]
pub enum CardUse<'a> {
    /// The machine's card, which is opened when it is first needed and stays open until the program ends.
    Machine,
    /// A card that is open already and quicker than the processor; or the processor, where there is none.
    Open(RayTracer<'a>),
}

/// The machine's card, opened once.
#[cfg(feature = "gpu")]
fn machine() -> Result<&'static Gpu, GpuError> {
    static CARD: OnceLock<Result<Gpu, GpuError>> = OnceLock::new();
    CARD.get_or_init(Gpu::open).as_ref().map_err(Clone::clone)
}

impl<'a> CardUse<'a> {
    /// Returns the card, even one that is slower than the processor; where there is none, the processor and why there is no
    /// card.
    pub fn any(self) -> (RayTracer<'a>, Option<String>) {
        match self {
            Self::Open(tracer) => (tracer, None),
            #[cfg(feature = "gpu")]
            Self::Machine => match machine() {
                Ok(gpu) => (RayTracer::Card(gpu), None),
                Err(error) => (RayTracer::Rays, Some(error.to_string())),
            },
            #[cfg(not(feature = "gpu"))]
            Self::Machine => {
                (RayTracer::Rays, Some("this program was built without its feature `gpu`".to_owned()))
            }
        }
    }

    /// Returns the card where it is a real one, and otherwise the processor, because a card in software is slower.
    pub fn quickest(self) -> RayTracer<'a> {
        match (self, self.any().0) {
            (Self::Open(tracer), _) => tracer,
            (Self::Machine, tracer) if tracer.is_quick() => tracer,
            (Self::Machine, _) => RayTracer::Rays,
        }
    }
}
