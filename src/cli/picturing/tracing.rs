//! A picture by each tracer, and what it says of how it was made.

use super::{Failure, PictureSetup, RenderedPicture};
use crate::optics::{Stratum, strata};
use crate::picture::spectral::{Remainder, expose_in};
use crate::picture::{ByBeams, Linear};
use crate::trace::RayTracer;
use crate::trace::ray::ByRays;
use crate::trace::sampling::{LitScene, Sampling};
use crate::trace::{Watch, beam};

/// What exact beams leave unresolved.
const UNRESOLVED: f64 = 2e-3;

/// Beams of one wavelength: without symmetry 2e-3 would take many times as long as what else there is to do.
const MOST_BEAMS: usize = 100_000;

/// Rows that rays are traced for at once: what they have seen so far is held.
const ROWS_OF_RAYS: u32 = 256;

/// Where more of the light is unresolved than this, a person is told.
const MUCH_UNRESOLVED: f64 = 0.02;

/// Looks that a picture is made of when not told: rays need many for smooth edges, beams only for the wavelengths.
const LOOKS_OF_BEAMS: u32 = 4;
const LOOKS_OF_RAYS: u32 = 64;

impl PictureSetup<'_> {
    pub(super) fn by_beams(&self, lit_scene: &LitScene, watch: Watch) -> Result<RenderedPicture, Failure> {
        let looks = self.looks(LOOKS_OF_BEAMS);
        let options = beam::BeamOptions {
            unresolved: UNRESOLVED,
            polarised: !self.options.unpolarised,
            most_beams: MOST_BEAMS,
            ..beam::BeamOptions::default()
        };
        let unfit = || Failure::Usage("exact beams do not apply here: use --tracer ray".into());
        let prepare = |rows| ByBeams::of_rows(*lit_scene, options, rows).ok_or_else(unfit);
        let most_rows = ByBeams::most_rows(lit_scene.film.size[0]);
        let taken = expose_in(lit_scene, (&self.strata(), looks), most_rows, prepare, watch)?;
        Ok(self.taken(taken, looks, "exact beams"))
    }

    pub(super) fn by_rays(
        &self,
        sampler: RayTracer,
        lit_scene: &LitScene,
        watch: Watch,
    ) -> Result<RenderedPicture, Failure> {
        let (strata, looks) = (self.strata(), self.looks(LOOKS_OF_RAYS));
        let seen = (strata.as_slice(), looks);
        let taken = match sampler {
            RayTracer::Rays => {
                let prepare = |rows| Ok::<_, Failure>(ByRays::new(*lit_scene, rows));
                expose_in(lit_scene, seen, ROWS_OF_RAYS, prepare, watch)?
            }
            #[cfg(feature = "gpu")]
            RayTracer::Card(gpu) => {
                use crate::trace::gpu::{ByCard, GpuEnvironment};
                let around = GpuEnvironment::new(gpu, &lit_scene.environment);
                let prepare =
                    |rows| Ok::<_, Failure>(ByCard::new(gpu, lit_scene, &around, rows, strata.len())?);
                expose_in(lit_scene, seen, ByCard::most_rows(lit_scene.film.size[0]), prepare, watch)?
            }
        };
        Ok(self.taken(taken, looks, &sampler.description()))
    }

    fn strata(&self) -> Vec<Stratum> {
        strata(self.options.wavelengths, &self.lighting.light.spectrum, !self.options.unadapted)
    }

    fn looks(&self, usual: u32) -> Sampling {
        let count = self.options.samples.unwrap_or(usual);
        Sampling { count, jitter: !self.finish.no_jitter, strength: self.strength }
    }

    fn taken(&self, (picture, rest): (Linear, Remainder), taken: Sampling, tracer: &str) -> RenderedPicture {
        if rest.unresolved > MUCH_UNRESOLVED {
            let percent = 100.0 * rest.unresolved;
            crate::cli::say(&format!(
                "warning: {}: {percent:.1} % of the light is unresolved by {tracer} and missing in the picture; \
                 --tracer beam or ray may follow it farther",
                self.assembly.path
            ));
        }
        let light = &self.lighting.light.name;
        let looks = if taken.count == 1 { "1 look".to_owned() } else { format!("{} looks", taken.count) };
        let jitter = if taken.jitter { "" } else { ", without jitter" };
        let polarised = if self.options.unpolarised { "unpolarised" } else { "polarised" };
        let told = format!(
            "{}; light {light}; {} wavelengths in {looks}{jitter}, {polarised}; {tracer}, unresolved {:.2e}, absorbed \
             {:.3}{}",
            self.assembly.name,
            self.options.wavelengths,
            rest.unresolved,
            rest.absorbed,
            self.mixture()
        );
        RenderedPicture { picture, description: told }
    }

    /// What pictures say that are no physics; nothing of others.
    pub(super) fn mixture(&self) -> String {
        let strength = self.strength;
        let told = || format!("; strength {strength}: a mixture for its looks, not physics");
        (strength < 1.0).then(told).unwrap_or_default()
    }
}
