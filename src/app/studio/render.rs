//! Traces renders: a body or its copies under a light, in front of a background.

use super::motion::Moment;
use super::order::{Shot, Slot, Smoothing, TakenPicture};
use super::pace::Effort;
use super::take::{LEAST_WEIGHT, MOST_BOUNCES, RAYS_COARSER, ShotTracer, TakeError, coarser, overlaid};
use super::undeveloped::TracedLight;
use crate::app::shows::Shows;
use crate::io::background::BackgroundRef;
use crate::optics::strata;
use crate::picture::{Background, Bloom, ByBeams, Develop, Linear, develop, fxaa, spectral};
use crate::render::{CardUse, Demands, LightQuality, RenderError, Unfit, Wanted, grow, plan};
use crate::scene::{Film, Instance, Panorama, Pose, Scene};
use crate::trace::beam::BeamOptions;
use crate::trace::environment::{Backplate, Environment};
use crate::trace::gpu::{ByCard, Gpu};
use crate::trace::ray;
use crate::trace::sampling::{LitScene, Sampling};
use crate::trace::{RayTracer, Tracer, Watch};
use egui::ColorImage;
use std::sync::Arc;

/// The most beams of one wavelength of a render. In a stone without symmetry it would take many times as long to reach the
/// bound.
const MOST_BEAMS: usize = 100_000;

/// How well a render that grows clearer is traced.
pub struct Growing {
    /// The bands of wavelengths of each pass, at most.
    pub bands: u32,
    /// The number of passes.
    pub looks: u32,
    /// The number of passes of which nothing is shown, because the picture in sight is as good.
    pub after: u32,
    /// The share of the light that may stay unresolved.
    pub unresolved: f64,
}

impl ShotTracer {
    pub(super) fn render(
        &mut self,
        (slot, shot): (Slot, &Shot),
        effort: &Effort,
        growing: Option<&Growing>,
        watch: Watch,
        each: &mut dyn FnMut(TakenPicture),
    ) -> Result<(), TakeError> {
        let scene = scene_of(shot);
        let behind = self.picture_behind(shot.behind.as_ref())?;
        let card = self.gpu.clone();
        // A card is set up anew for each picture, which takes longer than a rough picture by beams.
        let demands = Demands { favours_card: growing.is_some(), ..demands(shot) };
        let tracer = planned(&demands, card.as_deref())?;
        let is_slow = matches!(tracer, Tracer::Rays(RayTracer::Rays)) && growing.is_none();
        let slower = if is_slow { RAYS_COARSER } else { 1.0 };
        let mut film = coarser(&shot.film, effort.coarser * slower);
        if matches!(tracer, Tracer::Rays(RayTracer::Card(_)))
            && film.size[1] > ByCard::most_rows(film.size[0])
        {
            film = coarser(&film, 2.0);
        }
        let lit_scene = lit_scene(shot, &scene, film, behind.as_deref());
        let bands = growing.map_or(effort.bands, |g| g.bands).min(shot.bands);
        let strata = strata(bands, &shot.light.light.spectrum, true);
        let moving = match shot.smoothing {
            Smoothing::Temporal { newest } if growing.is_none() => Some(newest),
            _ => None,
        };
        let first = moving.and_then(|_| self.trails.get(&slot)).map_or(0, |(trail, _)| trail.count);
        let mut develop = |picture: &Linear, unresolved, tracer| {
            let laid = moving.map(|newest| {
                Moment::of(shot, film).lay(&mut self.trails, (slot, picture), &lit_scene, newest).clone()
            });
            let picture = laid.as_ref().unwrap_or(picture);
            if growing.is_some() {
                let light = TracedLight::Render { picture: picture.clone(), unresolved, tracer };
                self.kept.insert(slot, (shot.clone(), light));
            }
            developed(shot, (picture, growing.is_some()), (unresolved, tracer), watch)
        };
        let beams = BeamOptions {
            unresolved: growing.map_or(effort.unresolved, |g| g.unresolved),
            most_beams: MOST_BEAMS,
            ..BeamOptions::default()
        };
        if let (Tracer::Beams, None) = (tracer, growing) {
            let mut image = ByBeams::new(lit_scene, beams).ok_or(RenderError::NotForBeams)?;
            image.glance(&strata, watch)?;
            let (picture, rest) = spectral::seen::<RenderError, _>(&lit_scene, &image)?;
            each(develop(&picture, rest.unresolved, name(tracer))?);
            return Ok(());
        }
        let sampling =
            Sampling { count: growing.map_or(1, |g| g.looks), jitter: shot.jitter, strength: shot.strength };
        let quality = LightQuality { strata: &strata, sampling, beams };
        let passes = (first, growing.map_or(0, |g| g.after));
        grow(&lit_scene, tracer, quality, passes, watch, &mut |picture, rest| {
            each(develop(picture, rest.unresolved, name(tracer))?);
            Ok(())
        })
    }

    /// Returns the picture behind a render, which is read or drawn only when it changes.
    pub(super) fn picture_behind(
        &mut self,
        asked: Option<&BackgroundRef>,
    ) -> Result<Option<Arc<Panorama>>, TakeError> {
        let Some(asked) = asked else { return Ok(None) };
        if let Some((_, picture)) = self.behind.as_ref().filter(|(last, _)| last == asked) {
            return Ok(Some(Arc::clone(picture)));
        }
        let read = asked.picture().map_err(TakeError::Other)?;
        let picture = read.map(|reading| Arc::new(reading.panorama));
        self.behind = picture.clone().map(|picture| (asked.clone(), picture));
        Ok(picture)
    }
}

/// Whether exact beams can trace a shot: of one convex stone by parallel rays, and of a render with no picture behind it.
pub fn is_for_beams(shot: &Shot) -> bool {
    demands(shot).fit_beams()
}

/// Returns the demands that decide which tracer traces a shot.
pub fn demands(shot: &Shot) -> Demands {
    let alone = Demands::of_scope(&shot.specimen, &shot.view);
    let is_more = shot.shows == Shows::Render
        && (shot.behind.as_ref().is_some_and(BackgroundRef::is_picture) || shot.company.len() > 1);
    let more = is_more.then_some(Unfit::NotAlone);
    Demands { against_beams: alone.against_beams.or(more), favours_card: false }
}

/// Plans the tracer; rays run on the window's card where there is one.
pub fn planned<'a>(demands: &Demands, card: Option<&'a Gpu>) -> Result<Tracer<'a>, TakeError> {
    let card = CardUse::Open(card.map_or(RayTracer::Rays, RayTracer::Card));
    let plan = plan(demands, Wanted::Quickest, card).map_err(|unfit| TakeError::Other(unfit.to_string()))?;
    Ok(plan.tracer)
}

/// The editor's name for a tracer.
pub fn name(tracer: Tracer) -> &'static str {
    match tracer {
        Tracer::Beams => "exact beams",
        Tracer::Rays(RayTracer::Rays) => "point rays",
        Tracer::Rays(RayTracer::Card(_)) => "rays on the graphics card",
    }
}

/// The default distance of a backplate behind the middle, in girdle radii.
pub const BEHIND: f64 = 3.0;

/// Returns the distance of the backplate behind the middle, in girdle radii: that of the shot, but behind all bodies however
/// they are turned.
pub fn hung(shot: &Shot) -> f64 {
    let farthest = shot.company.iter().map(|pose| pose.at.length()).fold(0.0, f64::max);
    shot.distance.max(farthest + shot.specimen.radius)
}

/// Returns the scene that a shot shows.
pub fn scene_of(shot: &Shot) -> Scene {
    let placed =
        |pose: &Pose| Instance::of(&shot.specimen.body, shot.specimen.material.clone(), "").moved(pose);
    Scene { instances: shot.company.iter().map(placed).collect(), unit_mm: shot.specimen.unit_mm() }
}

/// Returns the scene of a shot under its light, with the backplate, the view and the film.
pub fn lit_scene<'a>(
    shot: &'a Shot,
    scene: &'a Scene,
    film: Film,
    picture: Option<&'a Panorama>,
) -> LitScene<'a> {
    let span = shot.behind.as_ref().map_or(1.0, BackgroundRef::span);
    let behind =
        picture.map(|picture| Backplate::filling(picture, span, hung(shot), &shot.view, &shot.whole));
    LitScene {
        scene,
        environment: Environment {
            map: &shot.light.map,
            basis: shot.view.light_basis(),
            eye: shot.view.basis(),
            head: shot.light.light.head.to_radians(),
            backplate: behind,
            backdrop: behind.is_some() || shot.behind == Some(BackgroundRef::Light),
        },
        view: &shot.view,
        film,
        options: ray::RayOptions { polarised: true, most_bounces: MOST_BOUNCES, least_weight: LEAST_WEIGHT },
    }
}

/// Develops the picture of a shot from its light; `fine` where there is time for glow. `unresolved` is the share of the
/// light that was not followed to its end.
pub(super) fn developed(
    shot: &Shot,
    (picture, fine): (&Linear, bool),
    (unresolved, tracer): (f64, &'static str),
    watch: Watch,
) -> Result<TakenPicture, TakeError> {
    // Glow would stand out around an overlay, and it takes longer than the rest of a rough picture.
    let bloom = (fine && shot.overlay.is_none()).then(Bloom::default);
    let background = match &shot.behind {
        Some(BackgroundRef::Plain(background)) => *background,
        _ => Background::Transparent,
    };
    let manner = Develop { exposure: shot.exposure, bloom, background, ..Develop::default() };
    let mut rgba = develop(picture, &manner);
    if shot.smoothing == Smoothing::Fxaa {
        fxaa(&mut rgba, picture.width);
    }
    let size = [picture.width as usize, picture.height as usize];
    let mut image = ColorImage::from_rgba_unmultiplied(size, &rgba);
    if let Some(overlay) = shot.overlay {
        overlaid(shot, overlay, &mut image, watch)?;
    }
    Ok(TakenPicture { image, unresolved: Some(unresolved), tracer, map: None })
}
