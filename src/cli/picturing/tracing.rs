//! Describes how a picture was made.

use super::PictureSetup;
use crate::cli::console::say;
use brillianteer_base::Failure;
use brillianteer_render::{Rendered, mixture_note};
use brillianteer_scene::{Smoothing, USUAL_BOUNCES};

/// The share of unresolved light above which a warning is printed.
const MUCH_UNRESOLVED: f64 = 0.02;

impl PictureSetup<'_> {
    /// Returns a picture's description, and warns where much of its light is missing.
    pub(super) fn described(&self, rendered: Rendered) -> Result<String, Failure> {
        let (tracer, samples) = (rendered.backend.description(), rendered.samples);
        let rest = rendered.remainder()?;
        if rest.unresolved > MUCH_UNRESOLVED {
            let percent = 100.0 * rest.unresolved;
            say(&format!(
                "warning: {}: {percent:.1} % of the light is unresolved by {tracer} and missing in the picture; \
                 {} may follow it farther",
                self.assembly.path,
                if self.look.bounces < USUAL_BOUNCES { "more --bounces" } else { "--tracer beam or ray" }
            ));
        }
        let light = &self.lighting.light.name;
        let samples = if samples == 1 { "1 sample".to_owned() } else { format!("{samples} samples") };
        let smoothing = match self.look.smoothing {
            Smoothing::None => String::new(),
            how => format!(", smoothed by {how}"),
        };
        let jitter = if self.finish.no_jitter { ", without jitter" } else { "" };
        let bounces = match self.look.bounces {
            USUAL_BOUNCES => String::new(),
            1 => ", at most 1 bounce".to_owned(),
            few => format!(", at most {few} bounces"),
        };
        let polarised = if self.options.unpolarised { "unpolarised" } else { "polarised" };
        Ok(format!(
            "{}; light {light}; {} wavelengths in {samples}{jitter}{smoothing}{bounces}, {polarised}; {tracer}, unresolved {:.2e}, absorbed \
             {:.3}{}",
            self.assembly.name,
            self.look.wavelengths,
            rest.unresolved,
            rest.absorbed,
            mixture_note(self.look.strength)
        ))
    }
}
