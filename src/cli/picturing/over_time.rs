//! Takes pictures as the editor shows moving bodies: one sample after the other, each blended with the ones before.

use super::{PictureSetup, RenderedPicture};
use crate::cli::console::report;
use brillianteer_base::{Failure, Watch};
use brillianteer_paper::StoredLight;
use brillianteer_paper::export::Event;
use brillianteer_picture::{Linear, TemporalHistory, motion_of_view};
use brillianteer_render::{Job, LightProduct, Output, Partial, Product, Rendered, Steps};
use brillianteer_scene::View;

/// The default number of samples of a picture. Where the newest has a share of one half, the oldest samples then
/// count for less than a thousandth.
const USUAL_SAMPLES: u32 = 12;

/// The greatest number of pixels of such a picture, which is held in memory as a whole: those of 2048 by 2048.
const MOST_PIXELS: u64 = 1 << 22;

/// The history of earlier samples, and the view from which the last was taken.
pub(super) type Trail = Option<(TemporalHistory, View)>;

impl PictureSetup<'_> {
    /// Takes a picture whose samples are blended one after the other; `newest` is the share of each new one. The
    /// picture continues the history of the one before, whose bodies are found at their present places.
    pub(super) fn take_over_time(
        &self,
        job: &Job,
        newest: f64,
        watch: Watch,
    ) -> Result<RenderedPicture, Failure> {
        let [width, height] = job.film.size;
        if u64::from(width) * u64::from(height) > MOST_PIXELS {
            return Err(Failure::Usage(format!(
                "--smoothing temporal: {width} by {height} pixels are too many; give at most those of 2048 by 2048"
            )));
        }
        let count = self.options.samples.unwrap_or(USUAL_SAMPLES);
        let mut last = None;
        for number in 0..count {
            let done = |part: f64| watch((f64::from(number) + part) / f64::from(count));
            let trail = self.trail.borrow_mut().take();
            let first = trail.as_ref().map_or(0, |(history, _)| history.count);
            let job = of_one_sample(job, first);
            let rendered = self.renderer.borrow_mut().run(&job, &done, &mut |part| match part {
                Partial::Note(text) => report(Event::Note(text)),
                _ => Ok(()),
            })?;
            let backend = rendered.backend.clone();
            let (picture, rest) = rendered.light()?;
            *self.trail.borrow_mut() = Some((laid(trail, picture, &job, newest), job.view));
            last = Some(Rendered { output: Output::LightRows(rest), backend, samples: count });
        }
        let mut light = StoredLight::new(job.film.size)?;
        if let Some((history, _)) = &*self.trail.borrow() {
            let rows = history.picture.pixels.chunks(width as usize);
            (0..).zip(rows).try_for_each(|(y, row)| light.push(y, row))?;
        }
        let rendered = last.ok_or_else(|| Failure::Usage("--samples: give at least 1".into()))?;
        Ok(RenderedPicture { light, description: self.described(rendered)? })
    }
}

/// Returns a job that takes one sample, which has this number.
fn of_one_sample(job: &Job, first: u32) -> Job {
    let mut job = job.clone();
    job.quality.samples = Some(1);
    if let Product::Light(LightProduct { steps, .. }) = &mut job.product {
        *steps = Steps::Passes { first, hidden: 0 };
    }
    job
}

/// Blends a picture of a job with the history of samples.
fn laid(trail: Trail, picture: Linear, job: &Job, newest: f64) -> TemporalHistory {
    let before = trail.as_ref().map_or(job.view, |(_, view)| *view);
    let moved = job.lit().map_or(vec![], |lit_scene| motion_of_view(&lit_scene, &before));
    match trail {
        Some((mut history, _)) => {
            history.lay(picture, &moved, newest);
            history
        }
        None => TemporalHistory::begin(picture, &moved),
    }
}
