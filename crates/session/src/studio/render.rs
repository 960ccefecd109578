//! Traces renders: a body or its copies under a light, in front of a background.

use super::develop::{developed, manner};
use super::effort::{Effort, FINE, Grain};
use super::jobs::coarser;
use super::motion::Moment;
use super::order::{Shot, Slot, TakenPicture};
use super::take::ShotTracer;
use super::undeveloped::TracedLight;
use crate::pixels::Pixels;
use crate::shows::Shows;
use brillianteer_base::{Failure, Watch, unwatched};
use brillianteer_files::WriteError;
use brillianteer_paper::{Finish, StoredLight};
use brillianteer_render::{Job, Partial, Quality, RenderError, Steps};
use brillianteer_scene::{BackgroundRef, Mipmap, Smoothing};
use brillianteer_trace::places::place_in_pixel;
use glam::DVec2;
use std::path::Path;
use std::sync::Arc;

impl ShotTracer {
    pub(super) fn render(
        &mut self,
        (slot, shot): (Slot, &Shot),
        effort: &Effort,
        watch: Watch,
        each: &mut dyn FnMut(TakenPicture),
    ) -> Result<(), Failure> {
        let moving = match shot.look.smoothing {
            Smoothing::Temporal { newest } if !effort.is_refined() => Some(newest),
            _ => None,
        };
        let first = moving.and_then(|_| self.trails.get(&slot)).map_or(0, |(trail, _)| trail.count);
        let mut job = self.light_job(shot, (effort, first), watch)?;
        let (mut grain, mut by_rays) = (effort.grain, false);
        if self.renderer.plan(&job).map_err(RenderError::from)?.backend.is_slow() {
            job = self.light_job(shot, (&effort.by_rays(), first), watch)?;
            (grain, by_rays) = (effort.grain_of_rays, true);
        }
        job.film = coarser(&shot.film, grain.coarser);
        // Rough pixels of glass are less conspicuous where outlines and the backplate are fine.
        let is_enlarged = by_rays && !effort.is_refined() && job.film.size != shot.film.size;
        let fine = is_enlarged.then(|| Job { film: shot.film, ..job.clone() });
        // A blend of several pictures stands for whole pixels; a single picture stands for the places of its rays.
        let shift = if moving.is_some() { DVec2::splat(0.5) } else { place_in_pixel(first, 1) };
        let Self { renderer, trails, kept, notes, .. } = self;
        renderer.run(&job, watch, &mut |part| {
            let (picture, unresolved, tracer) = match part {
                Partial::Picture { picture, rest, backend } => (picture, rest.unresolved, backend.kind()),
                Partial::Note(why) => {
                    notes.push(why.to_owned());
                    return Ok(());
                }
                Partial::Begun { .. } | Partial::Rows { .. } | Partial::LightRow { .. } => return Ok(()),
            };
            let laid = moving.zip(job.lit()).map(|(newest, lit_scene)| {
                Moment::of(shot, job.film).lay(trails, (slot, picture), &lit_scene, newest).clone()
            });
            let picture = laid.as_ref().unwrap_or(picture);
            let large = fine.as_ref().and_then(|fine| fine.enlarged(picture, (&job.film, shift)));
            let picture = large.as_ref().unwrap_or(picture);
            if effort.is_refined() {
                let light = TracedLight::Render { picture: picture.clone(), unresolved, tracer };
                kept.insert(slot, (shot.clone(), light));
            }
            let coarser = f64::from(picture.width) / f64::from(job.film.size[0]);
            let taken = developed(shot, (picture, effort.is_refined()), (unresolved, tracer), watch)?;
            each(TakenPicture { coarser, ..taken });
            Ok::<_, Failure>(())
        })?;
        Ok(())
    }

    fn light_job(
        &mut self,
        shot: &Shot,
        (effort, first): (&Effort, u32),
        watch: Watch,
    ) -> Result<Job, Failure> {
        let refinement = effort.refinement;
        let behind = self.picture_behind(shot.look.background.as_ref(), effort, watch)?;
        let mut quality = Quality::of_pictures(true);
        quality.beams.unresolved = refinement.map_or(effort.unresolved, |r| r.unresolved);
        quality.samples = refinement.map(|r| r.samples);
        let steps = match refinement {
            None => {
                // Rough pictures by rays leave as much light unresolved as those by beams.
                quality.rays.least_weight = effort.unresolved;
                Steps::Glance { first }
            }
            Some(refinement) => Steps::Passes { first, hidden: refinement.after },
        };
        Ok(shot.light_job(behind, effort.grain.bands, steps, quality))
    }

    /// Returns whether a shot is a render that rays on the processor trace, which takes long.
    pub fn is_slow_render(&mut self, shot: &Shot) -> bool {
        if shot.shows != Shows::Render {
            return false;
        }
        let effort = Effort::rough(1.0, Grain { coarser: 1.0, bands: 1 });
        let job = self.light_job(shot, (&effort, 0), &unwatched);
        job.is_ok_and(|job| self.renderer.plan(&job).is_ok_and(|plan| plan.backend.is_slow()))
    }

    /// Traces the render of a shot as it is exported, with as many passes as the command line takes.
    ///
    /// # Errors
    /// Fails where the backplate cannot be read, where the renderer refuses the job, where no temporary file holds
    /// the light of a large picture, or where `watch` asks to stop.
    pub fn export(&mut self, shot: &Shot, watch: Watch) -> Result<ExportedRender, Failure> {
        let shot = &*shot.under_whole_light(watch)?;
        let behind = self.picture_behind(shot.look.background.as_ref(), &FINE, watch)?;
        let job = shot.light_job(behind, shot.look.wavelengths, Steps::Strips, Quality::of_pictures(true));
        let mut light = StoredLight::new(job.film.size)?;
        let rendered = self.renderer.run(&job, watch, &mut |part| match part {
            Partial::LightRow { y, pixels } => light.push(y, pixels).map_err(Failure::from),
            _ => Ok(()),
        })?;
        let tracer = rendered.backend.kind();
        let unresolved = rendered.remainder()?.unresolved;
        Ok(ExportedRender { light, tracer, unresolved })
    }

    /// Returns the picture of a render's backplate, which is read or drawn only when it changes. A rough picture takes
    /// what is at hand, and a refined one waits until the backplate is made.
    pub(super) fn picture_behind(
        &mut self,
        asked: Option<&BackgroundRef>,
        effort: &Effort,
        watch: Watch,
    ) -> Result<Option<Arc<Mipmap>>, Failure> {
        let Some(asked) = asked else { return Ok(None) };
        if effort.is_refined() {
            self.backgrounds.fine(asked, watch)
        } else {
            self.backgrounds.at_hand(asked)
        }
    }
}

/// A render that was traced to be exported.
pub struct ExportedRender {
    light: StoredLight,
    /// The name of the tracer.
    pub tracer: &'static str,
    /// The share of the light that was not followed to its end.
    pub unresolved: f64,
}

impl ExportedRender {
    /// Writes the render of a shot as PNG, developed and with its overlay.
    ///
    /// # Errors
    /// Fails where the file cannot be written, or where `watch` asks to stop.
    pub fn write(
        &mut self,
        shot: &Shot,
        path: &Path,
        description: &str,
        watch: Watch,
    ) -> Result<(), Failure> {
        self.finished(shot, |finish, light| finish.write_png(path, light, description, watch))
    }

    /// Returns the render of a shot, developed and with its overlay, as an image.
    ///
    /// # Errors
    /// Fails where the stored light cannot be read, or where `watch` asks to stop.
    pub fn image(&mut self, shot: &Shot, watch: Watch) -> Result<Pixels, Failure> {
        let size = shot.film.size.map(|side| side as usize);
        let rgba = self.finished(shot, |finish, light| finish.pixels(light, watch))?;
        Ok(Pixels { size, rgba })
    }

    fn finished<T>(
        &mut self,
        shot: &Shot,
        work: impl FnOnce(&Finish, &mut StoredLight) -> Result<T, WriteError>,
    ) -> Result<T, Failure> {
        let job = shot.overlay_job(shot.film);
        let overlays = shot.overlay.as_slice();
        let finish = Finish { develop: manner(shot, true), fxaa: false, overlays, lit_scene: job.lit() };
        Ok(work(&finish, &mut self.light)?)
    }
}
