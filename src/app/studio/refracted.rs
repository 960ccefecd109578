//! Traces pictures of backgrounds behind glass: refraction maps, in which the lookup worker looks backgrounds up, and liquid
//! glass.

use super::order::{Shot, Slot, TakenPicture};
use super::pace::Effort;
use super::render::Growing;
use super::survey::{MapDetail, traced};
use super::take::{RAYS_COARSER, ShotTracer, TakeError, coarser};
use super::undeveloped::{TracedLight, map_taken};
use super::worker::FINE_RENDER;
use crate::app::lookup::{as_screens, backdrop};
use crate::io::refraction::code_of;
use crate::optics::{Illuminant, strata};
use crate::picture::liquid_glass::{self, PaneError, PaneLighting, surroundings};
use crate::picture::{RefractionMap, filling};
use crate::trace::Watch;
use crate::trace::environment::EnvironmentMap;
use egui::ColorImage;

/// How finely maps are traced, by grade. A map of several bands takes as many times as long to look up.
const ROUGH: MapDetail = MapDetail { bands: 1, places: 1, shades: 3, looks: 1 };
const FAIR: MapDetail = MapDetail { bands: 1, places: 1, shades: 4, looks: 1 };
const FINE: MapDetail = MapDetail { bands: 3, places: 1, shades: 6, looks: 4 };

/// The bands of wavelengths of a traced pane: until the picture is fair, and at its finest.
const FEW: u32 = 3;
const MANY: u32 = 12;

impl From<PaneError> for TakeError {
    fn from(error: PaneError) -> Self {
        match error {
            PaneError::Stopped(stopped) => stopped.into(),
            other => Self::Other(other.to_string()),
        }
    }
}

impl ShotTracer {
    /// Traces the map of a shot; the picture shows the codes of the map's places.
    pub(super) fn mapped(
        &mut self,
        (slot, shot): (Slot, &Shot),
        effort: &Effort,
        growing: Option<&Growing>,
        watch: Watch,
    ) -> Result<TakenPicture, TakeError> {
        let (detail, factor) = match growing {
            None => (ROUGH, effort.coarser * RAYS_COARSER),
            Some(growing) if growing.looks == 1 => (FAIR, 1.0),
            Some(_) => (FINE, 1.0),
        };
        let (map, _) = traced(shot, coarser(&shot.film, factor), &detail, watch)?;
        if growing.is_some() {
            self.kept.insert(slot, (shot.clone(), TracedLight::Map(map.clone())));
        }
        Ok(map_taken(shot, map))
    }
}

/// Returns a picture of the codes of a map's middle band.
pub(super) fn codes(map: &RefractionMap) -> ColorImage {
    let places = map.bands.get(map.bands.len() / 2).map_or(&[][..], |band| &band.places);
    let rgb: Vec<u8> = places.iter().flat_map(code_of).collect();
    ColorImage::from_rgb(map.size.map(|n| n as usize), &rgb)
}

/// Traces the pane of liquid glass of a shot.
pub(super) fn glass(
    camera: &mut ShotTracer,
    shot: &Shot,
    effort: &Effort,
    growing: Option<&Growing>,
    watch: Watch,
) -> Result<TakenPicture, TakeError> {
    let factor = if growing.is_none() { effort.coarser * RAYS_COARSER } else { 1.0 };
    let size = coarser(&shot.film, factor).size;
    let Some(behind) = camera.picture_behind(Some(&backdrop(shot.behind.as_ref())))? else {
        return Err(TakeError::Other("nothing hangs behind the pane".into()));
    };
    let pane = shot.liquid.pane(size);
    let bands = if growing.is_none_or(|g| g.looks == 1) { FEW } else { MANY };
    let around = PaneLighting {
        sky: &EnvironmentMap::new(&surroundings(pane.effective().light), None),
        gap: shot.liquid.gap,
        strata: &strata(bands, &Illuminant::D65, true),
        // Panes are always traced by the processor, which takes no more passes than its fine renders have.
        looks: growing.map_or(1, |g| g.looks.min(FINE_RENDER.looks)),
    };
    let picture = liquid_glass::traced(&pane, &filling(&behind, size), &around, watch)?;
    Ok(TakenPicture { image: as_screens(&picture), unresolved: None, tracer: "point rays", map: None })
}
