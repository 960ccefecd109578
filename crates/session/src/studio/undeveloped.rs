//! The traced light of renders and maps before it is developed, which is kept so that another exposure or overlay
//! needs no new tracing.

use super::order::{Shot, Slot};
use crate::shows::Shows;
use brillianteer_picture::{Linear, RefractionMap};
use brillianteer_scene::Look;
use std::collections::HashMap;

/// The last shot of each slot, with its light before it was developed.
pub type Kept = HashMap<Slot, (Shot, TracedLight)>;

/// Light that was traced for a view.
pub enum TracedLight {
    /// The light of a render.
    Render {
        /// The light of each pixel.
        picture: Linear,
        /// The share of the light that was not followed to its end, 0 to 1.
        unresolved: f64,
        /// The name of the tracer.
        tracer: &'static str,
    },
    /// A refraction map whose diffuse layer has no exposure yet.
    Map(RefractionMap),
}

impl Shot {
    /// Returns whether this shot has the light of another: the two may differ only in exposure, tone, overlay and glow.
    pub fn has_light_of(&self, other: &Self) -> bool {
        let is_kept = matches!(self.shows, Shows::Render | Shows::Refraction);
        let Look { exposure, glow, tone, .. } = other.look;
        let look = Look { exposure, glow, tone, ..self.look.clone() };
        is_kept && Self { look, overlay: other.overlay, ..self.clone() } == *other
    }
}
