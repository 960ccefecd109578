//! Point rays: on a graphics card where that is asked for or quicker, else, and where the card fails, on the processor.

use super::specimen::Specimen;
use super::{Failure, say};
use crate::io::WriteError;
use crate::measure::{self, Figures};
use crate::picture::Rows;
use crate::picture::by_rays::{self, Manner};
use crate::scene::{Film, Medium, Scope, View};
use crate::trace::Watch;
use crate::trace::ray::Options;

/// What follows rays.
#[derive(Clone, Copy)]
pub enum Sampler {
    /// The processor, in f64.
    Rays,
    /// A graphics card, in f32.
    #[cfg(feature = "gpu")]
    Card(&'static crate::trace::gpu::Gpu),
}

/// What is looked at, by which light.
#[derive(Clone, Copy)]
pub struct Subject<'a> {
    pub specimen: &'a Specimen,
    pub medium: Medium,
    pub view: &'a View,
    pub scope: &'a Scope,
}

#[cfg(feature = "gpu")]
mod card {
    use super::{Sampler, say};
    use crate::trace::gpu::{Gpu, GpuError};
    use std::sync::OnceLock;

    /// The card, opened once.
    fn card() -> Result<&'static Gpu, GpuError> {
        static CARD: OnceLock<Result<Gpu, GpuError>> = OnceLock::new();
        CARD.get_or_init(Gpu::open).as_ref().map_err(Clone::clone)
    }

    impl Sampler {
        /// The card, or the processor and a word on why.
        pub fn on_card() -> Self {
            card().map_or_else(
                |error| {
                    say(&format!("note: {error}: tracing by rays on the processor"));
                    Self::Rays
                },
                Self::Card,
            )
        }

        /// The card where there is a real one: in software it is slower than the processor's own way.
        pub fn quickest() -> Self {
            card().ok().filter(|gpu| !gpu.is_software()).map_or(Self::Rays, Self::Card)
        }
    }
}

#[cfg(not(feature = "gpu"))]
impl Sampler {
    /// The processor: this build knows no cards.
    pub fn on_card() -> Self {
        say("note: this program was built without its feature `gpu`: tracing by rays on the processor");
        Self::Rays
    }

    /// The processor.
    pub fn quickest() -> Self {
        Self::Rays
    }
}

impl Sampler {
    /// What figures call it.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Rays => "ray",
            #[cfg(feature = "gpu")]
            Self::Card(_) => "gpu",
        }
    }

    /// Whether it is a real card.
    pub fn is_quick(&self) -> bool {
        match self {
            Self::Rays => false,
            #[cfg(feature = "gpu")]
            Self::Card(gpu) => !gpu.is_software(),
        }
    }

    /// In words.
    pub fn told(&self) -> String {
        match self {
            Self::Rays => "point rays".into(),
            #[cfg(feature = "gpu")]
            Self::Card(gpu) => format!("point rays in f32 on {}", gpu.name()),
        }
    }

    /// Does work, and again on the processor where the card fails.
    pub fn or_rays<T>(self, mut work: impl FnMut(Self) -> Result<T, Failure>) -> Result<T, Failure> {
        match work(self) {
            #[cfg(feature = "gpu")]
            Err(Failure::Card(error)) => {
                say(&format!("note: {error}: tracing by rays on the processor"));
                work(Self::Rays)
            }
            done => done,
        }
    }

    /// A picture, row by row.
    pub fn rows(
        self,
        look: Subject,
        film: &Film,
        manner: &Manner,
        watch: Watch,
        mut each: impl FnMut(&Rows) -> Result<(), WriteError>,
    ) -> Result<(), Failure> {
        let Subject { specimen, medium, view, scope } = look;
        let polytope = &specimen.stone.polytope;
        let each = |rows: &Rows| each(rows).map_err(Failure::from);
        match self {
            Self::Rays => by_rays::trace(polytope, medium, view, scope, film, manner, watch, each),
            #[cfg(feature = "gpu")]
            Self::Card(gpu) => {
                crate::picture::by_gpu::trace(gpu, polytope, medium, view, scope, film, manner, watch, each)
            }
        }
    }

    /// The figures of a view, by lattices of `side` squared rays.
    pub fn figures(
        self,
        look: Subject,
        options: Options,
        side: u32,
        watch: Watch,
    ) -> Result<Figures, Failure> {
        let Subject { specimen, medium, view, scope } = look;
        let polytope = &specimen.stone.polytope;
        match self {
            Self::Rays => Ok(measure::by_rays(polytope, medium, view, scope, (options, side), watch)?),
            #[cfg(feature = "gpu")]
            Self::Card(gpu) => measure::by_gpu(gpu, polytope, medium, view, scope, (options, side), watch),
        }
    }
}
