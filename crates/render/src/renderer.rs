//! The renderer: does jobs, by the tracer that is planned for each.
//!
//! Where an attempt ends in `RenderError::Card`, the renderer plans again without a card, sends a `Partial::Note`,
//! by which callers know that all parts so far are made anew, and attempts the whole job on the processor. What
//! happens to the jobs that follow depends on the error:
//!
//! - `OutOfMemory`: `Gpu::check` reports it once and forgets it, so the next job tries the card again.
//! - Errors for which `GpuError::is_lost` is true (no card, too limited, failed): no later job of this renderer
//!   tries the card.
//! - All others say that the job is beyond the card (its bands, triangles, metal, mixed kinds): the next job may
//!   use it.
//!
//! Refraction maps and traced panes never use a card.

use super::beam_cache::BeamCache;
use super::card::{Backend, Card};
use super::contrast::TakenContrast;
use super::job::{Job, Product, Reading, Steps};
use super::plan::{Demands, Plan, Unfit, plan};
use brillianteer_base::{Failure, Stopped, Watch};
use brillianteer_measure::{LATTICE, LightMeasures, MeasureDerivatives, Measured};
use brillianteer_picture::liquid_glass::{Cost, PaneError};
use brillianteer_picture::spectral::Remainder;
use brillianteer_picture::{Carried, Linear, RefractionMap, Rows};
use brillianteer_trace::beam::Beams;
#[cfg(feature = "gpu")]
use brillianteer_trace::gpu::GpuError;
use std::sync::Arc;

/// Does jobs. It keeps the beams of the last ones, and no longer uses a card that was lost.
#[derive(Default)]
pub struct Renderer {
    card: Card,
    pub(super) beams: BeamCache,
    /// True once the caller was notified that no card is used.
    is_noted: bool,
}

/// A part of a product, handed out while the work goes on.
#[derive(Debug)]
pub enum Partial<'a> {
    /// The processor does the work of a card that is missing or failed; the text says why. All parts that were handed
    /// out before are made anew.
    Note(&'a str),
    /// The rows of a picture in a scope follow.
    Begun {
        /// The reading that the picture shows.
        reading: Reading,
        /// The tracer.
        backend: &'a Backend,
        /// The share of the light that the picture does not show; rays do not know it.
        unresolved: Option<f64>,
    },
    /// Rows of a picture in a scope.
    Rows {
        /// The reading that the picture shows.
        reading: Reading,
        /// Some rows of the picture, which say where they belong.
        rows: &'a Rows,
        /// The first of the channels that hold the scope's bands.
        first_channel: usize,
    },
    /// A finished row of a picture under light that is made in [`Steps::Strips`]; rows come from top to bottom.
    LightRow {
        /// The number of the row.
        y: u32,
        /// The linear light of its pixels, as in [`Linear`].
        pixels: &'a [[f32; 4]],
    },
    /// The present state of a picture under light.
    Picture {
        /// The linear light of all pixels.
        picture: &'a Linear,
        /// The light that it does not show.
        rest: Remainder,
        /// The tracer.
        backend: &'a Backend,
    },
}

/// The result of a job.
#[derive(Debug)]
pub enum Output {
    /// A picture under light, and the light that it does not show.
    Light(Linear, Remainder),
    /// The light that a picture does not show whose rows were handed out.
    LightRows(Remainder),
    /// A picture in a scope, whose rows were handed out; holds the beams where exact beams traced it.
    Scope(Option<Arc<Beams>>),
    /// A refraction map, and the share of the light that it carries.
    RefractionMap(RefractionMap, Carried),
    /// A traced pane and, where the job compares, the difference of a drawn one.
    LiquidGlass(Linear, Option<Cost>),
    /// The measured figures of a stone.
    Figures(Box<Measured>),
    /// The measures of a stone's light.
    Measures(Box<TakenMeasures>),
    /// The contrast of a stone's face.
    Contrast(Box<TakenContrast>),
}

/// The measures of a stone's light, with the requested derivatives.
#[derive(Debug, Clone, PartialEq)]
pub struct TakenMeasures {
    /// The measures.
    pub measures: LightMeasures,
    /// The derivatives, in the order of the request; `None` for a measure that has none.
    pub derivatives: Vec<Option<MeasureDerivatives>>,
}

/// The result of a job, with its tracer and its samples.
pub struct Rendered {
    /// The result.
    pub output: Output,
    /// The tracer that made it.
    pub backend: Backend,
    /// The number of its samples; see [`Quality`](super::Quality).
    pub samples: u32,
}

/// The reason why a job was not done.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// The watch asked to stop.
    #[error(transparent)]
    Stopped(#[from] Stopped),
    /// No tracer can do the job in the requested way.
    #[error(transparent)]
    Unfit(#[from] Unfit),
    /// A pane of liquid glass cannot be traced.
    #[error(transparent)]
    Pane(PaneError),
    /// A job made another product than its caller expected; this is a fault of the program.
    #[error("the job makes another product")]
    OtherProduct,
    /// The graphics card failed; the renderer does the work on the processor.
    #[cfg(feature = "gpu")]
    #[error(transparent)]
    Card(#[from] GpuError),
}

/// A callback that receives the parts of a product; its error ends the work.
pub type EachPart<'a, E> = &'a mut dyn FnMut(Partial) -> Result<(), E>;

/// The reason why work ended early: its own error, or an error of the callback.
pub(super) enum Halt<E> {
    Render(RenderError),
    Each(E),
}

impl<E: From<RenderError>> Halt<E> {
    fn joined(self) -> E {
        match self {
            Self::Render(error) => error.into(),
            Self::Each(error) => error,
        }
    }
}

impl<E> From<RenderError> for Halt<E> {
    fn from(error: RenderError) -> Self {
        Self::Render(error)
    }
}

impl<E> From<Stopped> for Halt<E> {
    fn from(stopped: Stopped) -> Self {
        Self::Render(stopped.into())
    }
}

#[cfg(feature = "gpu")]
impl<E> From<GpuError> for Halt<E> {
    fn from(error: GpuError) -> Self {
        Self::Render(error.into())
    }
}

impl From<PaneError> for RenderError {
    fn from(error: PaneError) -> Self {
        match error {
            PaneError::Stopped(stopped) => Self::Stopped(stopped),
            other => Self::Pane(other),
        }
    }
}

impl Renderer {
    /// Makes a renderer that may use a card.
    pub fn new(card: Card) -> Self {
        Self { card, ..Self::default() }
    }

    /// Returns the card that may be used.
    pub fn card(&self) -> &Card {
        &self.card
    }

    /// Decides which tracer does a job.
    ///
    /// # Errors
    /// Fails with [`Unfit`] where the job is impossible, the stone cannot be seen, or the requested tracer does not
    /// fit.
    pub fn plan(&self, job: &Job) -> Result<Plan, Unfit> {
        job.check()?;
        plan(&Demands::of(job)?, job.quality.tracer, &self.card)
    }

    /// Begins a round of jobs: beams that no job of the last round used are dropped.
    pub fn begin_round(&mut self) {
        self.beams.begin_round();
    }

    /// Drops all beams, so that work without this renderer has their memory.
    pub fn drop_beams(&mut self) {
        self.beams.clear();
    }

    /// Does a job. Where a card fails, the processor does all of it again.
    ///
    /// # Errors
    /// Fails with a [`RenderError`] or an error of `each`.
    pub fn run<E: From<RenderError>>(
        &mut self,
        job: &Job,
        watch: Watch,
        each: EachPart<E>,
    ) -> Result<Rendered, E> {
        let Plan { backend, no_card } = self.plan(job).map_err(RenderError::from)?;
        let replaced = no_card.map(|why| format!("{why}: tracing by rays on the processor"));
        if let Some(note) = replaced.or_else(|| backend.note_of_software()).filter(|_| !self.is_noted) {
            self.is_noted = true;
            each(Partial::Note(&note))?;
        }
        match self.attempt(job, &backend, watch, each) {
            #[cfg(feature = "gpu")]
            Err(Halt::Render(RenderError::Card(error))) => {
                if error.is_lost() {
                    self.card = Card::None;
                }
                let demands = Demands::of(job).map_err(RenderError::from)?;
                let rest =
                    plan(&demands, job.quality.tracer, &Card::None).map_err(RenderError::from)?.backend;
                let by = if rest.is_beams() { "exact beams" } else { "rays" };
                each(Partial::Note(&format!("{error}: tracing by {by} on the processor")))?;
                self.attempt(job, &rest, watch, each).map_err(Halt::joined)
            }
            done => done.map_err(Halt::joined),
        }
    }

    fn attempt<E: From<RenderError>>(
        &mut self,
        job: &Job,
        backend: &Backend,
        watch: Watch,
        each: EachPart<E>,
    ) -> Result<Rendered, Halt<E>> {
        let samples = job.quality.samples.unwrap_or_else(|| usual_samples(&job.product, backend));
        let output = match &job.product {
            Product::Light(light) => light.render(job, (backend, samples), watch, each)?,
            Product::Scope(scope) => self.scope(job, scope, (backend, samples), watch, each)?,
            Product::Figures(figures) => self.figures(job, figures, (backend, samples), watch)?,
            Product::Measures(measures) => self.light_measures(job, measures, watch)?,
            Product::Contrast(contrast) => self.contrast(job, contrast, watch)?,
            Product::RefractionMap(map) => map.render(job, samples, watch)?,
            Product::LiquidGlass(pane) => pane.render(samples, watch)?,
        };
        Ok(Rendered { output, backend: backend.clone(), samples })
    }
}

/// The usual number of passes of a picture under light: rays need many for smooth edges, beams only for the wavelengths.
const PASSES_OF_BEAMS: u32 = 4;
const PASSES_OF_RAYS: u32 = 64;

/// The usual number of rays along each side of a pixel of a picture in a scope.
const RAYS_PER_SIDE: u32 = 4;

/// The usual number of passes of a refraction map's diffuse layer.
const PASSES_OF_MAPS: u32 = 4;

/// The usual number of passes of a pane of liquid glass.
const PASSES_OF_PANES: u32 = 16;

/// Returns the number of samples that a product has where no number is requested.
fn usual_samples(product: &Product, backend: &Backend) -> u32 {
    match product {
        Product::Light(light) if matches!(light.steps, Steps::Glance { .. }) => 1,
        Product::Light(_) if backend.is_beams() => PASSES_OF_BEAMS,
        Product::Light(_) => PASSES_OF_RAYS,
        Product::Scope(_) => RAYS_PER_SIDE,
        Product::RefractionMap(_) => PASSES_OF_MAPS,
        Product::LiquidGlass(_) => PASSES_OF_PANES,
        Product::Figures(_) | Product::Measures(_) | Product::Contrast(_) => LATTICE,
    }
}

impl Rendered {
    /// Returns the picture under light, and the light that it does not show.
    ///
    /// # Errors
    /// Fails with [`RenderError::OtherProduct`] for another product.
    pub fn light(self) -> Result<(Linear, Remainder), RenderError> {
        match self.output {
            Output::Light(picture, rest) => Ok((picture, rest)),
            _ => Err(RenderError::OtherProduct),
        }
    }

    /// Returns the light that a picture under light does not show, whose rows were handed out.
    ///
    /// # Errors
    /// Fails with [`RenderError::OtherProduct`] for another product.
    pub fn remainder(self) -> Result<Remainder, RenderError> {
        match self.output {
            Output::LightRows(rest) => Ok(rest),
            _ => Err(RenderError::OtherProduct),
        }
    }

    /// Returns the beams of a picture in a scope; `None` where it was traced by rays.
    pub fn beams(self) -> Option<Arc<Beams>> {
        match self.output {
            Output::Scope(beams) => beams,
            _ => None,
        }
    }

    /// Returns the refraction map, and the share of the light that it carries.
    ///
    /// # Errors
    /// Fails with [`RenderError::OtherProduct`] for another product.
    pub fn map(self) -> Result<(RefractionMap, Carried), RenderError> {
        match self.output {
            Output::RefractionMap(map, carried) => Ok((map, carried)),
            _ => Err(RenderError::OtherProduct),
        }
    }

    /// Returns the traced pane and, where the job compares, the difference of a drawn one.
    ///
    /// # Errors
    /// Fails with [`RenderError::OtherProduct`] for another product.
    pub fn pane(self) -> Result<(Linear, Option<Cost>), RenderError> {
        match self.output {
            Output::LiquidGlass(picture, cost) => Ok((picture, cost)),
            _ => Err(RenderError::OtherProduct),
        }
    }

    /// Returns the figures.
    ///
    /// # Errors
    /// Fails with [`RenderError::OtherProduct`] for another product.
    pub fn figures(self) -> Result<Measured, RenderError> {
        match self.output {
            Output::Figures(measured) => Ok(*measured),
            _ => Err(RenderError::OtherProduct),
        }
    }

    /// Returns the measures of light.
    ///
    /// # Errors
    /// Fails with [`RenderError::OtherProduct`] for another product.
    pub fn measures(self) -> Result<TakenMeasures, RenderError> {
        match self.output {
            Output::Measures(measures) => Ok(*measures),
            _ => Err(RenderError::OtherProduct),
        }
    }

    /// Returns the contrast of the face.
    ///
    /// # Errors
    /// Fails with [`RenderError::OtherProduct`] for another product.
    pub fn contrast(self) -> Result<TakenContrast, RenderError> {
        match self.output {
            Output::Contrast(contrast) => Ok(*contrast),
            _ => Err(RenderError::OtherProduct),
        }
    }
}

impl From<RenderError> for Failure {
    fn from(error: RenderError) -> Self {
        match error {
            RenderError::Stopped(stopped) => stopped.into(),
            #[cfg(feature = "gpu")]
            RenderError::Card(error) => Self::Output(error.to_string()),
            RenderError::Unfit(_) | RenderError::Pane(_) | RenderError::OtherProduct => {
                Self::Usage(error.to_string())
            }
        }
    }
}
