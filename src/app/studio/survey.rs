//! Refraction maps of what a view shows.

use super::order::Shot;
use super::take::{Trouble, setting, sitting};
use crate::optics::strata;
use crate::picture::{Backdrop, Carried, Develop, RefractionMap, Survey};
use crate::scene::Projection;
use crate::trace::Watch;
use glam::DVec2;

/// How far behind the stone the background is, girdle radii, and how many times as wide as the picture: as on the command
/// line where nothing else is asked for.
const DISTANCE: f64 = 3.0;
pub const SPAN: f64 = 2.0;

/// Wavelengths and looks of the diffuse layer.
const SHADES: u32 = 16;
const LOOKS: u32 = 4;

/// Traces the map of a shot, on its film.
pub fn survey(shot: &Shot, watch: Watch) -> Result<(RefractionMap, Carried), Trouble> {
    let setting = setting(shot);
    let nearness = match shot.view.projection {
        Projection::Orthographic => 1.0,
        Projection::Perspective { distance } => (distance + DISTANCE) / distance,
    };
    let size = DVec2::from(shot.film.size.map(f64::from)) * shot.film.pixel * SPAN * nearness;
    let plane = Backdrop { distance: DISTANCE, size, both_sides: false };
    let spectrum = &shot.light.light.spectrum;
    let survey =
        Survey { bands: &strata(1, spectrum, true), shades: &strata(SHADES, spectrum, true), looks: LOOKS };
    let (map, carried) = RefractionMap::trace(&sitting(shot, &setting, shot.film), &plane, &survey, watch)?;
    let manner = Develop { exposure: shot.exposure, bloom: None, ..Develop::default() };
    Ok((map.developed(&manner), carried))
}
