//! Pictures under light, by whichever tracer is planned. The passes of a picture are added up in strips of rows, so that no
//! more of the picture is held than a tracer needs.

use crate::optics::Stratum;
use crate::picture::spectral::{Remainder, expose_in, seen};
use crate::picture::{ByBeams, Linear};
use crate::trace::beam::BeamOptions;
#[cfg(feature = "gpu")]
use crate::trace::gpu::{ByCard, GpuEnvironment, GpuError};
use crate::trace::ray::ByRays;
use crate::trace::sampling::{LitScene, ProgressiveImage, Sampling};
use crate::trace::{RayTracer, Stopped, Tracer, Watch};

/// How many rows point rays trace at once: the sums of their passes are held in memory.
const ROWS_OF_RAYS: u32 = 256;

/// The usual number of passes of a picture: rays need many for smooth edges, beams only for the wavelengths.
const PASSES_OF_BEAMS: u32 = 4;
const PASSES_OF_RAYS: u32 = 64;

/// How well a picture under light is traced.
#[derive(Clone, Copy)]
pub struct LightQuality<'a> {
    /// The bands of wavelengths.
    pub strata: &'a [Stratum],
    /// How many passes there are, and how each samples.
    pub sampling: Sampling,
    /// How far exact beams are followed.
    pub beams: BeamOptions,
}

/// Why a picture was not traced.
#[derive(Debug, Clone, thiserror::Error)]
pub enum RenderError {
    /// The watch asked to stop.
    #[error(transparent)]
    Stopped(#[from] Stopped),
    /// The graphics card failed; point rays on the processor can do the work.
    #[cfg(feature = "gpu")]
    #[error(transparent)]
    Card(#[from] GpuError),
    /// Exact beams were planned for what they cannot trace.
    #[error("exact beams do not apply here: trace by rays")]
    NotForBeams,
}

/// Returns the number of passes that a picture by this tracer has where no number is requested.
pub fn usual_passes(tracer: Tracer) -> u32 {
    match tracer {
        Tracer::Beams => PASSES_OF_BEAMS,
        Tracer::Rays(_) => PASSES_OF_RAYS,
    }
}

/// Traces a picture under light, strip by strip.
///
/// # Errors
/// [`RenderError::Stopped`] when `watch` asks to stop, [`RenderError::NotForBeams`] where exact beams cannot trace the
/// scene, or the error of a card that fails.
pub fn light(
    lit_scene: &LitScene,
    tracer: Tracer,
    quality: LightQuality,
    watch: Watch,
) -> Result<(Linear, Remainder), RenderError> {
    let width = lit_scene.film.size[0];
    let sampled = (quality.strata, quality.sampling);
    match tracer {
        Tracer::Beams => {
            let prepare =
                |rows| ByBeams::of_rows(*lit_scene, quality.beams, rows).ok_or(RenderError::NotForBeams);
            expose_in(lit_scene, sampled, ByBeams::most_rows(width), prepare, watch)
        }
        Tracer::Rays(RayTracer::Rays) => {
            let prepare = |rows| Ok(ByRays::new(*lit_scene, rows));
            expose_in(lit_scene, sampled, ROWS_OF_RAYS, prepare, watch)
        }
        #[cfg(feature = "gpu")]
        Tracer::Rays(RayTracer::Card(gpu)) => {
            let environment = GpuEnvironment::new(gpu, &lit_scene.environment);
            let bands = quality.strata.len();
            let prepare = |rows| Ok(ByCard::new(gpu, lit_scene, &environment, rows, bands)?);
            expose_in(lit_scene, sampled, ByCard::most_rows(width), prepare, watch)
        }
    }
}

/// Traces a picture under light as a whole and shows it while it grows clearer.
///
/// Calls `each` with the picture so far, and the light that it does not show, after the first, the second, the fourth pass
/// and so on, and after the last. `first` is the number of the first pass; nothing is shown of the first `hidden` passes.
///
/// # Errors
/// Those of [`light`], and an error of `each`.
pub fn grow<E: From<RenderError>>(
    lit_scene: &LitScene,
    tracer: Tracer,
    quality: LightQuality,
    (first, hidden): (u32, u32),
    watch: Watch,
    each: &mut dyn FnMut(&Linear, Remainder) -> Result<(), E>,
) -> Result<(), E> {
    let rows = 0..lit_scene.film.size[1];
    let passes = Passes { lit_scene, quality, first, hidden, watch };
    match tracer {
        Tracer::Beams => {
            let image = ByBeams::new(*lit_scene, quality.beams).ok_or(RenderError::NotForBeams)?;
            passes.add_up(image, each)
        }
        Tracer::Rays(RayTracer::Rays) => passes.add_up(ByRays::new(*lit_scene, rows), each),
        #[cfg(feature = "gpu")]
        Tracer::Rays(RayTracer::Card(gpu)) => {
            let environment = GpuEnvironment::new(gpu, &lit_scene.environment);
            let image = ByCard::new(gpu, lit_scene, &environment, rows, quality.strata.len());
            passes.add_up(image.map_err(RenderError::from)?, each)
        }
    }
}

/// The passes of a picture, which are added up.
struct Passes<'a> {
    lit_scene: &'a LitScene<'a>,
    quality: LightQuality<'a>,
    first: u32,
    hidden: u32,
    watch: Watch<'a>,
}

impl Passes<'_> {
    fn add_up<E: From<RenderError>>(
        &self,
        mut image: impl ProgressiveImage<RenderError>,
        each: &mut dyn FnMut(&Linear, Remainder) -> Result<(), E>,
    ) -> Result<(), E> {
        let LightQuality { strata, sampling, .. } = self.quality;
        for number in 0..sampling.count {
            let done = |part: f64| (self.watch)((f64::from(number) + part) / f64::from(sampling.count));
            let pass = sampling.pass(self.lit_scene.scene, strata, self.first.wrapping_add(number));
            image.add_pass(&pass, &done)?;
            let taken = number + 1;
            if taken > self.hidden && (taken.is_power_of_two() || taken == sampling.count) {
                let (picture, rest) = seen(self.lit_scene, &image)?;
                each(&picture, rest)?;
            }
        }
        Ok(())
    }
}
