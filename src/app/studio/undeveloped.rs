//! The light of renders and maps as it was traced, kept so that another exposure or overlay needs no new tracing.

use super::order::{Shot, Slot, TakenPicture};
use super::refracted::codes;
use super::render::developed;
use super::take::{ShotTracer, TakeError};
use crate::app::shows::Shows;
use crate::picture::{Develop, Linear, RefractionMap};
use crate::trace::Watch;
use std::collections::HashMap;
use std::sync::Arc;

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
    /// Whether the light of this shot is that of another: the two may differ in exposure and overlay alone.
    pub fn has_light_of(&self, other: &Self) -> bool {
        let is_kept = matches!(self.shows, Shows::Render | Shows::Refraction);
        is_kept && Self { exposure: other.exposure, overlay: other.overlay, ..self.clone() } == *other
    }
}

impl ShotTracer {
    /// Makes the picture of a shot from light that was traced for another shot; `None` where no such light is kept.
    ///
    /// # Errors
    /// [`TakeError::Stopped`] when `watch` asks to stop, which only overlays do.
    pub fn develop_again(
        &self,
        slot: Slot,
        shot: &Shot,
        watch: Watch,
    ) -> Option<Result<TakenPicture, TakeError>> {
        let (_, light) = self.kept.get(&slot).filter(|(kept, _)| kept.has_light_of(shot))?;
        Some(match light {
            TracedLight::Render { picture, unresolved, tracer } => {
                developed(shot, (picture, true), (*unresolved, tracer), watch).map_err(TakeError::from)
            }
            TracedLight::Map(map) => Ok(map_taken(shot, map.clone())),
        })
    }
}

/// Returns a map as a view receives it: developed, with a picture of the codes of its places.
pub fn map_taken(shot: &Shot, map: RefractionMap) -> TakenPicture {
    let map = map.developed(&Develop { exposure: shot.exposure, bloom: None, ..Develop::default() });
    TakenPicture { image: codes(&map), unresolved: None, tracer: "point rays", map: Some(Arc::new(map)) }
}
