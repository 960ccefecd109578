//! The light of shots: as it is at hand, and whole.
//!
//! Whatever is refined, exported or copied is made under the whole light.

use brillianteer_base::{Failure, Watch};
use brillianteer_trace::environment::{EnvironmentMap, Lighting};
use std::sync::Arc;

/// The light of a shot. While the map of a world is drawn, a coarse one is at hand for rough pictures; all others wait for
/// the whole one.
#[derive(Debug, Clone)]
pub struct ShotLight {
    at_hand: Arc<Lighting>,
    is_coarse: bool,
}

impl PartialEq for ShotLight {
    /// Returns whether both are the same light. Lights are compared by pointer, because they are replaced and never changed.
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.at_hand, &other.at_hand)
    }
}

impl ShotLight {
    /// Makes the light of shots of a light whose map is whole.
    pub fn whole(lighting: Lighting) -> Self {
        Self { at_hand: Arc::new(lighting), is_coarse: false }
    }

    /// Makes the light of rough shots of a light whose whole map is still being drawn.
    pub fn coarse(lighting: Lighting) -> Self {
        Self { at_hand: Arc::new(lighting), is_coarse: true }
    }

    /// Returns whether only a coarse map is at hand.
    pub fn is_coarse(&self) -> bool {
        self.is_coarse
    }

    /// Returns the name of the light.
    pub fn name(&self) -> &str {
        &self.at_hand.light.name
    }

    /// Returns warnings about the light's panorama.
    pub fn warnings(&self) -> &[String] {
        &self.at_hand.warnings
    }

    /// Returns the light with the map that is at hand.
    pub(super) fn at_hand(&self) -> &Arc<Lighting> {
        &self.at_hand
    }

    /// Returns the light with its whole map, which is drawn where only a coarse one is at hand.
    ///
    /// # Errors
    /// Fails where `watch` asks to stop.
    pub(super) fn finished(&self, watch: Watch) -> Result<Self, Failure> {
        if !self.is_coarse {
            return Ok(self.clone());
        }
        // Only lights without a panorama have a coarse map.
        let light = self.at_hand.light.clone();
        let map = EnvironmentMap::watched(&light, None, watch)?;
        Ok(Self::whole(Lighting { light, map, warnings: vec![] }))
    }
}
