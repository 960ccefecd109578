//! What follows rays: a graphics card where that is asked for or quicker, else the processor.

use super::say;
use crate::trace::RayTracer;

#[cfg(feature = "gpu")]
mod card {
    use super::{RayTracer, say};
    use crate::trace::gpu::{Gpu, GpuError};
    use std::sync::OnceLock;

    /// The card, opened once.
    fn card() -> Result<&'static Gpu, GpuError> {
        static CARD: OnceLock<Result<Gpu, GpuError>> = OnceLock::new();
        CARD.get_or_init(Gpu::open).as_ref().map_err(Clone::clone)
    }

    /// The card, or the processor and a word on why.
    pub fn on_card() -> RayTracer<'static> {
        card().map_or_else(
            |error| {
                say(&format!("note: {error}: tracing by rays on the processor"));
                RayTracer::Rays
            },
            RayTracer::Card,
        )
    }

    /// The card where there is a real one: in software it is slower than the processor's own way.
    pub fn quickest() -> RayTracer<'static> {
        card().ok().filter(|gpu| !gpu.is_software()).map_or(RayTracer::Rays, RayTracer::Card)
    }
}

#[cfg(not(feature = "gpu"))]
mod card {
    use super::{RayTracer, say};

    /// The processor: this build knows no cards.
    pub fn on_card() -> RayTracer<'static> {
        say("note: this program was built without its feature `gpu`: tracing by rays on the processor");
        RayTracer::Rays
    }

    /// The processor.
    pub fn quickest() -> RayTracer<'static> {
        RayTracer::Rays
    }
}

pub use card::{on_card, quickest};
