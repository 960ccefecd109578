//! The contrast of a stone's face: its job, and its pictures.

use super::job::{ContrastProduct, Job};
use super::renderer::{Halt, Output, Renderer};
use brillianteer_base::{Stopped, Watch};
use brillianteer_measure::ContrastMap;
use brillianteer_optics::SrgbEncoder;
use brillianteer_picture::{Layer, encode_contrast, paint};
use brillianteer_scene::Film;
use brillianteer_trace::beam::Beams;
use std::sync::Arc;

/// The part of the time that tracing the beams takes, roughly.
const BEAMS_SHARE: f64 = 0.8;

/// The contrast of a stone's face, with the beams that it was computed from.
#[derive(Debug, Clone)]
pub struct TakenContrast {
    /// The contrast of each square.
    pub map: ContrastMap,
    /// The beams.
    pub beams: Arc<Beams>,
}

impl Renderer {
    /// Maps the contrast of a stone's face.
    pub(super) fn contrast<E>(
        &mut self,
        job: &Job,
        product: &ContrastProduct,
        watch: Watch,
    ) -> Result<Output, Halt<E>> {
        let ContrastProduct { head_deg, pattern, medium } = product;
        let share = |done: f64| watch(BEAMS_SHARE * done);
        let beams = self.beams.of(job.convex()?, *medium, &job.view, &job.quality.beams, &share)?;
        let rest = |done: f64| watch(BEAMS_SHARE + (1.0 - BEAMS_SHARE) * done);
        let map = ContrastMap::of(&beams, *head_deg, pattern, &rest)?;
        Ok(Output::Contrast(Box::new(TakenContrast { map, beams })))
    }
}

impl TakenContrast {
    /// Paints the map from top to bottom, and calls `each` with the red, green and blue of some rows, sRGB, in order.
    ///
    /// # Errors
    /// The errors of `each`, and [`Stopped`], converted into `E`, when `watch` stops the work.
    pub fn paint<E: From<Stopped>>(
        &self,
        film: &Film,
        watch: Watch,
        mut each: impl FnMut(&[u8]) -> Result<(), E>,
    ) -> Result<(), E> {
        let (encoder, mut pixels) = (SrgbEncoder::new(), vec![]);
        paint(&self.known(), film, watch, |rows| {
            pixels.clear();
            (rows.first..rows.first + rows.count)
                .for_each(|y| encode_contrast(rows, &encoder, y, &mut pixels));
            each(&pixels)
        })
    }

    /// Returns the layer of the contrast of each square.
    fn known(&self) -> Layer {
        let parts = self.map.parts().map(|(outline, of)| (outline, [of.known]));
        Layer::of_values(["contrast"], parts, self.map.unresolved)
    }

    /// Returns the layer of all that is known: the contrast of each square and, in a clear stone whose face cannot be all dark, its
    /// bounds.
    pub fn values(&self) -> Layer {
        if !self.map.whole.most.is_finite() || !self.beams.medium.is_clear() {
            return self.known();
        }
        let bounded =
            self.map.parts().map(|(outline, of)| (outline, [of.known, of.bounds.least, of.bounds.most]));
        Layer::of_values(["contrast", "least", "most"], bounded, self.map.unresolved)
    }
}
