//! Traces a picture with the planned tracer, and describes how it was made.

use super::{Failure, PictureSetup, RenderedPicture};
use crate::optics::{Stratum, strata};
use crate::picture::Linear;
use crate::picture::spectral::Remainder;
use crate::render::{self, LightQuality, usual_passes};
use crate::trace::beam::BeamOptions;
use crate::trace::sampling::{LitScene, Sampling};
use crate::trace::{Tracer, Watch};

/// The share of the light that exact beams leave unresolved.
const UNRESOLVED: f64 = 2e-3;

/// The most beams of one wavelength. Without symmetry, reaching the bound [`UNRESOLVED`] would take many times as long as
/// the rest of the work.
const MOST_BEAMS: usize = 100_000;

/// The share of unresolved light above which a warning is printed.
const MUCH_UNRESOLVED: f64 = 0.02;

impl PictureSetup<'_> {
    pub(super) fn traced(
        &self,
        tracer: Tracer,
        lit_scene: &LitScene,
        watch: Watch,
    ) -> Result<RenderedPicture, Failure> {
        let sampling = Sampling {
            count: self.options.samples.unwrap_or(usual_passes(tracer)),
            jitter: !self.finish.no_jitter,
            strength: self.strength,
        };
        let beams = BeamOptions {
            unresolved: UNRESOLVED,
            polarised: !self.options.unpolarised,
            most_beams: MOST_BEAMS,
            ..BeamOptions::default()
        };
        let quality = LightQuality { strata: &self.strata(), sampling, beams };
        let traced = render::light(lit_scene, tracer, quality, watch)?;
        Ok(self.described(traced, sampling, &tracer.description()))
    }

    fn strata(&self) -> Vec<Stratum> {
        strata(self.options.wavelengths, &self.lighting.light.spectrum, !self.options.unadapted)
    }

    fn described(
        &self,
        (picture, rest): (Linear, Remainder),
        taken: Sampling,
        tracer: &str,
    ) -> RenderedPicture {
        if rest.unresolved > MUCH_UNRESOLVED {
            let percent = 100.0 * rest.unresolved;
            crate::cli::say(&format!(
                "warning: {}: {percent:.1} % of the light is unresolved by {tracer} and missing in the picture; \
                 --tracer beam or ray may follow it farther",
                self.assembly.path
            ));
        }
        let light = &self.lighting.light.name;
        let looks = if taken.count == 1 { "1 sample".to_owned() } else { format!("{} samples", taken.count) };
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

    /// Returns the note of a picture with a strength of refraction below 1, which is not physics; empty at full strength.
    pub(super) fn mixture(&self) -> String {
        let strength = self.strength;
        let told = || format!("; strength {strength}: a mixture for its looks, not physics");
        (strength < 1.0).then(told).unwrap_or_default()
    }
}
