//! Point rays: on a graphics card or, and where the card fails, on the processor.

use super::told::Tell;
use crate::io::{Failure, WriteError};
use crate::measure::{self, Figures};
use crate::picture::Rows;
use crate::picture::by_rays::{self, Manner};
use crate::scene::{Film, Medium, Scope, Specimen, View};
use crate::trace::Watch;
use crate::trace::ray::Options;

/// What follows rays.
#[derive(Clone, Copy)]
pub enum Sampler<'a> {
    /// The processor, in f64.
    Rays,
    /// A graphics card, in f32.
    #[cfg(feature = "gpu")]
    Card(&'a crate::trace::gpu::Gpu),
    /// Never: this build knows no cards.
    #[cfg(not(feature = "gpu"))]
    Card(std::convert::Infallible, std::marker::PhantomData<&'a ()>),
}

/// What is looked at, by which light.
#[derive(Clone, Copy)]
pub struct Subject<'a> {
    /// The stone.
    pub specimen: &'a Specimen,
    /// What it is made of, at one wavelength.
    pub medium: Medium,
    /// From where; its eye is in front of the whole stone.
    pub view: &'a View,
    /// The structured light.
    pub scope: &'a Scope,
}

impl Sampler<'_> {
    /// What figures call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rays => "ray",
            #[cfg(feature = "gpu")]
            Self::Card(_) => "gpu",
        }
    }

    /// Whether it is a real card.
    pub fn is_quick(self) -> bool {
        match self {
            Self::Rays => false,
            #[cfg(feature = "gpu")]
            Self::Card(gpu) => !gpu.is_software(),
        }
    }

    /// In words.
    pub fn told(self) -> String {
        match self {
            Self::Rays => "point rays".into(),
            #[cfg(feature = "gpu")]
            Self::Card(gpu) => format!("point rays in f32 on {}", gpu.name()),
        }
    }

    /// Does work, and again on the processor where the card fails, with a note of why.
    ///
    /// # Errors
    /// What `work` or `tell` answers, but for the card's.
    pub fn or_rays<T>(
        self,
        #[cfg_attr(not(feature = "gpu"), expect(unused_variables, reason = "only a card can fail"))]
        tell: Tell,
        mut work: impl FnMut(Self) -> Result<T, Failure>,
    ) -> Result<T, Failure> {
        match work(self) {
            #[cfg(feature = "gpu")]
            Err(Failure::Card(error)) => {
                tell(super::Told::Note(&format!("{error}: tracing by rays on the processor")))?;
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
        manner: &Manner,
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

    /// The figures of a view, by lattices of `side` squared rays.
    ///
    /// # Errors
    /// A card that fails, or [`Failure::Stopped`] when `watch` asks to stop.
    pub fn figures(
        self,
        look: Subject,
        options: Options,
        side: u32,
        watch: Watch,
    ) -> Result<Figures, Failure> {
        let Subject { specimen, medium, view, scope } = look;
        let solid = specimen.solid();
        match self {
            Self::Rays => Ok(measure::by_rays(solid, medium, view, scope, (options, side), watch)?),
            #[cfg(feature = "gpu")]
            Self::Card(gpu) => measure::by_gpu(gpu, solid, medium, view, scope, (options, side), watch),
        }
    }
}
