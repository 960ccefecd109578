//! Pictures under light: adds up their passes, in strips of rows or as a whole that is refined.
//!
//! In strips, one strip at a time is held, so lower strips take less memory. A picture that is refined as a whole
//! holds all of its strips, each with copies of the solids, so lower strips would save nothing.

use super::card::Backend;
use super::job::{Job, LightProduct, Steps};
use super::plan::Unfit;
use super::renderer::{EachPart, Halt, Output, Partial, RenderError};
use brillianteer_base::Watch;
use brillianteer_optics::Strata;
use brillianteer_picture::spectral::{EachRow, Remainder, expose_rows, seen};
use brillianteer_picture::{ByBeams, Linear};
#[cfg(feature = "gpu")]
use brillianteer_trace::gpu::{ByCard, Gpu, GpuEnvironment, GpuError};
use brillianteer_trace::ray::ByRays;
use brillianteer_trace::sampling::{LitScene, ProgressiveImage, Sampling};
#[cfg(feature = "gpu")]
use brillianteer_trace::sampling::{RadiancePixel, SamplePass};
use std::ops::Range;

/// The share of a ray's light below which Russian roulette decides whether the ray goes on, in a picture of one pass and one
/// wavelength: so little that the noise is hardly visible.
const CHANCE_OF_ONE_RAY: f64 = 0.0125;

/// The greatest such share, for pictures of many passes and wavelengths, which average the noise.
const MOST_CHANCE: f64 = 0.4;

/// A picture under light that is being traced.
struct Exposure<'a> {
    job: &'a Job,
    lit_scene: LitScene<'a>,
    strata: Strata,
    sampling: Sampling,
    watch: Watch<'a>,
}

impl LightProduct {
    pub(super) fn render<E: From<RenderError>>(
        &self,
        job: &Job,
        (backend, count): (&Backend, u32),
        watch: Watch,
        each: EachPart<E>,
    ) -> Result<Output, Halt<E>> {
        let rays = f64::from(count) * f64::from(self.wavelengths);
        let by_chance = (CHANCE_OF_ONE_RAY * rays.sqrt()).min(MOST_CHANCE);
        let sampling = Sampling { strength: self.strength, by_chance, ..Sampling::of(count) };
        let (lit_scene, strata) = (job.lit_scene(&self.surroundings), self.strata(count));
        let exposure = Exposure { job, lit_scene, strata, sampling, watch };
        let (picture, rest) = match self.steps {
            Steps::Strips => return Ok(Output::LightRows(exposure.in_strips(backend, each)?)),
            Steps::Glance { .. } if backend.is_beams() => {
                let (picture, rest) = exposure.at_a_glance()?;
                each(Partial::Picture { picture: &picture, rest, backend }).map_err(Halt::Each)?;
                (picture, rest)
            }
            Steps::Glance { first } => exposure.growing(backend, first, 0, each)?,
            Steps::Passes { first, hidden } => exposure.growing(backend, first, hidden, each)?,
        };
        Ok(Output::Light(picture, rest))
    }
}

impl Exposure<'_> {
    /// Takes the picture some rows after the other, and hands out its rows.
    fn in_strips<E: From<RenderError>>(
        &self,
        backend: &Backend,
        each: EachPart<E>,
    ) -> Result<Remainder, Halt<E>> {
        let (lit_scene, width) = (&self.lit_scene, self.lit_scene.film.size[0]);
        let sampled = (&self.strata, self.sampling);
        let hand_out: EachRow<Halt<E>> =
            &mut |y, pixels| each(Partial::LightRow { y, pixels }).map_err(Halt::Each);
        match backend {
            Backend::Beams => {
                let prepare = |rows| Ok(self.beams(rows)?);
                expose_rows(lit_scene, sampled, ByBeams::most_rows(width), prepare, self.watch, hand_out)
            }
            Backend::Rays => {
                let prepare = |rows| Ok(ByRays::new(*lit_scene, rows));
                expose_rows(lit_scene, sampled, ByRays::MOST_ROWS, prepare, self.watch, hand_out)
            }
            #[cfg(feature = "gpu")]
            Backend::Card(gpu) => {
                let environment = GpuEnvironment::new(gpu, &lit_scene.environment)?;
                let prepare =
                    |rows| Ok(ByCard::new(gpu, lit_scene, &environment, rows, self.strata.whole().len())?);
                expose_rows(lit_scene, sampled, ByCard::most_rows(width), prepare, self.watch, hand_out)
            }
        }
    }

    fn beams(&self, rows: Range<u32>) -> Result<ByBeams<'_>, RenderError> {
        let image = ByBeams::of_rows(self.lit_scene, self.job.quality.beams, rows);
        image.ok_or_else(|| Unfit::NotAlone.into())
    }

    /// Takes the picture by the beams of one wavelength.
    fn at_a_glance(&self) -> Result<(Linear, Remainder), RenderError> {
        let mut image = self.beams(0..self.lit_scene.film.size[1])?;
        image.glance(self.strata.whole(), self.watch)?;
        seen(&self.lit_scene, &image)
    }

    /// Takes the picture as a whole, and hands it out after some of its passes.
    fn growing<E: From<RenderError>>(
        &self,
        backend: &Backend,
        first: u32,
        hidden: u32,
        each: EachPart<E>,
    ) -> Result<(Linear, Remainder), Halt<E>> {
        let rows = 0..self.lit_scene.film.size[1];
        match backend {
            Backend::Beams => self.add_up(self.beams(rows)?, (backend, first, hidden), each),
            Backend::Rays => self.add_up(ByRays::new(self.lit_scene, rows), (backend, first, hidden), each),
            #[cfg(feature = "gpu")]
            Backend::Card(gpu) => {
                let environment = GpuEnvironment::new(gpu, &self.lit_scene.environment)?;
                let strips = Strips::new(gpu, &self.lit_scene, &environment, self.strata.whole().len())?;
                self.add_up(strips, (backend, first, hidden), each)
            }
        }
    }

    fn add_up<E: From<RenderError>>(
        &self,
        mut image: impl ProgressiveImage<RenderError>,
        (backend, first, hidden): (&Backend, u32, u32),
        each: EachPart<E>,
    ) -> Result<(Linear, Remainder), Halt<E>> {
        let count = self.sampling.count;
        let mut last = (Linear { width: 0, height: 0, pixels: vec![] }, Remainder::default());
        let mut taken = 0;
        while taken < count {
            // The picture is shown after 1, 2, 4, 8 and so on passes; those between are taken together.
            let next = (taken.max(hidden.min(count)) + 1).next_power_of_two().min(count);
            let done = |part: f64| {
                (self.watch)((f64::from(taken) + f64::from(next - taken) * part) / f64::from(count))
            };
            let pass = |number: u32| {
                self.sampling.pass(self.lit_scene.scene, &self.strata, first.wrapping_add(number))
            };
            image.add_passes(taken..next, &pass, &done)?;
            taken = next;
            let is_white = self.strata.is_white_after(taken);
            if taken == count || taken > hidden && is_white {
                last = seen(&self.lit_scene, &image)?;
                let (picture, rest) = (&last.0, last.1);
                each(Partial::Picture { picture, rest, backend }).map_err(Halt::Each)?;
            }
        }
        Ok(last)
    }
}

/// A whole picture on a graphics card, in strips that fit into its buffers.
#[cfg(feature = "gpu")]
struct Strips<'a>(Vec<ByCard<'a>>);

#[cfg(feature = "gpu")]
impl<'a> Strips<'a> {
    fn new(
        gpu: &'a Gpu,
        lit_scene: &LitScene,
        environment: &GpuEnvironment,
        wavelengths: usize,
    ) -> Result<Self, GpuError> {
        let [width, height] = lit_scene.film.size;
        let most = ByCard::most_rows(width);
        let strip = |first: u32| {
            let rows = first..(first + most).min(height);
            ByCard::new(gpu, lit_scene, environment, rows, wavelengths)
        };
        (0..height).step_by(most as usize).map(strip).collect::<Result<_, _>>().map(Self)
    }
}

#[cfg(feature = "gpu")]
impl ProgressiveImage<RenderError> for Strips<'_> {
    fn add_pass(&mut self, pass: &SamplePass, watch: Watch) -> Result<(), RenderError> {
        let all = self.0.len() as f64;
        for (k, strip) in self.0.iter_mut().enumerate() {
            let watch = |part| watch((k as f64 + part) / all);
            ProgressiveImage::<RenderError>::add_pass(strip, pass, &watch)?;
        }
        Ok(())
    }

    fn each_pixel(&self, each: &mut dyn FnMut(&RadiancePixel)) -> Result<(), RenderError> {
        self.0.iter().try_for_each(|strip| strip.each_pixel(each))
    }
}
