//! Traces refraction maps of what a view shows.

use super::order::Shot;
use super::render::{hung, lit_scene, scene_of};
use super::take::TakeError;
use crate::optics::strata;
use crate::picture::{Backdrop, Carried, Develop, RefractionMap, Survey};
use crate::scene::Film;
use crate::trace::Watch;
use glam::DVec2;

/// How many times as wide as the picture the background is; also the default of the command line.
pub const SPAN: f64 = 2.0;

/// How finely a map is traced.
pub struct MapDetail {
    /// The number of bands of wavelengths in which places are mapped.
    pub bands: u32,
    /// The number of places of a pixel in each band.
    pub places: u32,
    /// The number of wavelengths of the diffuse layer.
    pub shades: u32,
    /// The number of passes of the diffuse layer.
    pub looks: u32,
}

/// Traces the map of a shot as it is exported, with the given numbers of bands and of places of a pixel in each.
pub fn survey(
    shot: &Shot,
    [bands, places]: [u32; 2],
    watch: Watch,
) -> Result<(RefractionMap, Carried), TakeError> {
    let detail = MapDetail { bands, places, shades: 16, looks: 4 };
    let (map, carried) = traced(shot, shot.film, &detail, watch)?;
    Ok((map.developed(&Develop { exposure: shot.exposure, bloom: None, ..Develop::default() }), carried))
}

/// Traces the map of a shot on another film; its diffuse layer is not developed.
pub fn traced(
    shot: &Shot,
    film: Film,
    detail: &MapDetail,
    watch: Watch,
) -> Result<(RefractionMap, Carried), TakeError> {
    let scene = scene_of(shot);
    let distance = hung(shot);
    let whole = DVec2::from(shot.whole.size.map(f64::from)) * shot.whole.pixel;
    let size = whole * SPAN * shot.view.widening(distance);
    let plane = Backdrop { distance, size, both_sides: false };
    let bands = |count| strata(count, &shot.light.light.spectrum, true);
    let survey = Survey {
        bands: &bands(detail.bands),
        places: detail.places,
        shades: &bands(detail.shades),
        looks: detail.looks,
    };
    Ok(RefractionMap::trace(&lit_scene(shot, &scene, film, None), &plane, &survey, watch)?)
}
