//! Develops the light that was traced for a shot, and draws its overlay over it.

use super::order::{Shot, TakenPicture};
use crate::pixels::Pixels;
use brillianteer_base::{Stopped, Watch};
use brillianteer_paper::refraction::code_of;
use brillianteer_picture::{Bloom, Develop, Linear, RefractionMap, develop, fxaa, lay};
use brillianteer_scene::{Background, BackgroundRef, Film, Look, Smoothing};
use std::sync::Arc;

/// Returns the settings by which the render of a shot is developed; `fine` where there is time for glow.
pub(super) fn manner(shot: &Shot, fine: bool) -> Develop {
    // Glow would stand out around an overlay, and it takes longer than the rest of a rough picture.
    let has_glow = fine && shot.overlay.is_none() && shot.look.glow > 0.0;
    let bloom = has_glow.then(|| Bloom { strength: shot.look.glow, ..Bloom::default() });
    let background = match &shot.look.background {
        Some(BackgroundRef::Plain(background)) => *background,
        _ => Background::Transparent,
    };
    let Look { exposure, tone, .. } = shot.look;
    Develop { exposure, tone, bloom, background, ..Develop::default() }
}

/// Develops the picture of a shot from its light; `fine` where the picture is refined and not rough. `unresolved` is
/// the share of the light that was not followed to its end.
pub(super) fn developed(
    shot: &Shot,
    (picture, fine): (&Linear, bool),
    (unresolved, tracer): (f64, &'static str),
    watch: Watch,
) -> Result<TakenPicture, Stopped> {
    let mut rgba = develop(picture, &manner(shot, fine));
    // A refined picture has smooth edges, which FXAA would only blur.
    if shot.look.smoothing == Smoothing::Fxaa && !fine {
        fxaa(&mut rgba, picture.width);
    }
    let size = [picture.width, picture.height];
    overlaid(shot, &mut rgba, size, watch)?;
    let image = Pixels { size: size.map(|n| n as usize), rgba };
    Ok(TakenPicture { image, unresolved: Some(unresolved), tracer, coarser: 1.0, map: None })
}

/// Returns the picture of a map for a view: a picture of the codes of its places, with the map and its developed
/// diffuse layer.
pub(super) fn map_taken(shot: &Shot, map: RefractionMap) -> TakenPicture {
    let Look { exposure, tone, .. } = shot.look;
    let map = map.developed(&Develop { exposure, tone, bloom: None, ..Develop::default() });
    TakenPicture {
        image: codes(&map),
        unresolved: None,
        tracer: "point rays",
        coarser: 1.0,
        map: Some(Arc::new(map)),
    }
}

/// Returns a picture of the codes of a map's middle band.
fn codes(map: &RefractionMap) -> Pixels {
    let places = map.bands.get(map.bands.len() / 2).map_or(&[][..], |band| &band.places);
    let rgb: Vec<u8> = places.iter().flat_map(code_of).collect();
    Pixels::opaque(map.size.map(|n| n as usize), &rgb)
}

/// Draws the overlay of a shot, if it has one, over its picture of `size` pixels.
pub(super) fn overlaid(
    shot: &Shot,
    rgba: &mut [u8],
    [across, down]: [u32; 2],
    watch: Watch,
) -> Result<(), Stopped> {
    let Some(overlay) = shot.overlay else { return Ok(()) };
    let pixel = shot.film.pixel * f64::from(shot.film.size[0]) / f64::from(across);
    let job = shot.overlay_job(Film { size: [across, down], pixel, ..shot.film });
    job.lit().map_or(Ok(()), |lit_scene| lay(overlay, &lit_scene, rgba, watch))
}
