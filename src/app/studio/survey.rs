//! Refraction maps of what a view shows.

use super::order::Shot;
use super::render::{hung, nearness, setting, sitting};
use super::take::Trouble;
use crate::optics::strata;
use crate::picture::{Backdrop, Carried, Develop, RefractionMap, Survey};
use crate::trace::Watch;
use glam::DVec2;

/// How many times as wide as the picture the background is: as on the command line where nothing else is asked for.
pub const SPAN: f64 = 2.0;

/// Wavelengths and looks of the diffuse layer.
const SHADES: u32 = 16;
const LOOKS: u32 = 4;

/// Traces the map of a shot, on its film.
pub fn survey(shot: &Shot, watch: Watch) -> Result<(RefractionMap, Carried), Trouble> {
    let setting = setting(shot);
    let distance = hung(shot);
    let size =
        DVec2::from(shot.film.size.map(f64::from)) * shot.film.pixel * SPAN * nearness(&shot.view, distance);
    let plane = Backdrop { distance, size, both_sides: false };
    let spectrum = &shot.light.light.spectrum;
    let survey =
        Survey { bands: &strata(1, spectrum, true), shades: &strata(SHADES, spectrum, true), looks: LOOKS };
    let (map, carried) =
        RefractionMap::trace(&sitting(shot, &setting, shot.film, None), &plane, &survey, watch)?;
    let manner = Develop { exposure: shot.exposure, bloom: None, ..Develop::default() };
    Ok((map.developed(&manner), carried))
}
