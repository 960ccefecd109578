//! Pictures and figures in a scope.

use super::card::Backend;
use super::job::{FiguresProduct, Job, MeasuresProduct, Quality, Reading, ScopeProduct};
use super::plan::Unfit;
use super::renderer::{EachPart, Halt, Output, Partial, RenderError, Renderer, TakenMeasures};
use brillianteer_base::{Stopped, Watch};
use brillianteer_math::{Polytope, SolidRef};
use brillianteer_measure::{Figures, LightMeasures, Scintillation, measured, rocked_views};
use brillianteer_picture::{Layer, Rows, by_rays, paint};
use brillianteer_scene::{Body, Medium, Scope};
use brillianteer_trace::ScopeShot;
use brillianteer_trace::beam::{self, BeamOptions, Beams, SumOptions};
use glam::DVec2;
use std::sync::Arc;

/// Each rocked view may fill one part in this many of the memory of beams. Views are traced one after the other, so that this
/// bounds the time of all twelve.
const ROCKED_PARTS: usize = 8;

/// The part of the time of a view's measures that tracing its beams takes, roughly.
const BEAMS_SHARE: f64 = 0.6;

/// The part of the time that the view itself takes where the stone rocks, roughly.
const OWN_SHARE: f64 = 0.2;

impl Renderer {
    /// Traces a picture in a scope, and hands out its rows.
    pub(super) fn scope<E: From<RenderError>>(
        &mut self,
        job: &Job,
        product: &ScopeProduct,
        (backend, per_side): (&Backend, u32),
        watch: Watch,
        each: EachPart<E>,
    ) -> Result<Output, Halt<E>> {
        if backend.is_beams() {
            return self.scope_by_beams(job, product, watch, each);
        }
        let ScopeProduct { scope, medium, glare, readings } = product;
        for &reading in readings {
            each(Partial::Begun { reading, backend, unresolved: None }).map_err(Halt::Each)?;
        }
        let solid = job.stone().map_err(RenderError::from)?;
        let (medium, film, options) = (*medium, job.film, job.quality.rays);
        let (view, shift) = (&job.view, DVec2::splat(0.5));
        let shot = ScopeShot { solid, medium, view, scope, film, per_side, shift, options };
        let hand_out = |rows: &Rows| {
            readings.iter().try_for_each(|&reading| {
                let first_channel = if reading == Reading::Strongest { scope.bands.len() } else { 0 };
                each(Partial::Rows { reading, rows, first_channel }).map_err(Halt::Each)
            })
        };
        match backend {
            #[cfg(feature = "gpu")]
            Backend::Card(gpu) => brillianteer_picture::by_gpu::trace(gpu, &shot, *glare, watch, hand_out)?,
            _ => by_rays::trace(&shot, *glare, watch, hand_out)?,
        }
        Ok(Output::Scope(None))
    }

    fn scope_by_beams<E: From<RenderError>>(
        &mut self,
        job: &Job,
        product: &ScopeProduct,
        watch: Watch,
        each: EachPart<E>,
    ) -> Result<Output, Halt<E>> {
        let ScopeProduct { scope, medium, glare, readings } = product;
        let parts = 1.0 + readings.len() as f64;
        let share = |number: u8| move |done: f64| watch((f64::from(number) + done) / parts);
        let beams = self.beams.of(job.convex()?, *medium, &job.view, &job.quality.beams, &share(0))?;
        for (number, &reading) in (1..).zip(readings) {
            let layer = match reading {
                Reading::Energy => Layer::energy(&beams, scope, *glare),
                Reading::Strongest => Layer::strongest(&beams, scope),
            };
            let unresolved = Some(layer.open);
            each(Partial::Begun { reading, backend: &Backend::Beams, unresolved }).map_err(Halt::Each)?;
            paint(&layer, &job.film, &share(number), |rows| {
                each(Partial::Rows { reading, rows, first_channel: 0 }).map_err(Halt::Each)
            })?;
        }
        Ok(Output::Scope(Some(beams)))
    }

    /// Takes the measures of a stone's light.
    pub(super) fn light_measures<E>(
        &mut self,
        job: &Job,
        product: &MeasuresProduct,
        watch: Watch,
    ) -> Result<Output, Halt<E>> {
        let MeasuresProduct { settings, medium, derivatives } = product;
        let (body, polytope) = job.convex()?;
        let rocking = settings.pattern.and_then(|pattern| Some((pattern, pattern.rock_deg?)));
        let own = |done: f64| watch(if rocking.is_some() { OWN_SHARE * done } else { done });
        let share = |done: f64| own(BEAMS_SHARE * done);
        // Derivatives take four times the memory of the beams and more, and each rocked view's beams stand beside these.
        let parts = 1 + 4 * usize::from(!derivatives.is_empty()) + usize::from(rocking.is_some());
        let options = job.quality.beams.with_part_of_memory(parts);
        let beams = self.beams.of((body, polytope), *medium, &job.view, &options, &share)?;
        // Each derivative takes about as long as the measures together.
        let rest = (1.0 - BEAMS_SHARE) / (derivatives.len() + 1) as f64;
        let after = |number: usize| move |done: f64| own(BEAMS_SHARE + rest * (number as f64 + done));
        let derivatives = derivatives.iter().enumerate();
        let derivatives = derivatives
            .map(|(number, name)| name.derivatives(&beams, polytope, settings, &after(number)))
            .collect::<Result<Vec<_>, _>>()?;
        let mut measures = LightMeasures::of(&beams, polytope, settings, &after(derivatives.len()))?;
        if let Some((pattern, rock_deg)) = rocking {
            let rocking_share = |done: f64| watch(OWN_SHARE + (1.0 - OWN_SHARE) * done);
            let mut is_cut_short = false;
            let rocked = job.rocked(polytope, *medium, rock_deg, &rocking_share);
            let rocked = rocked.inspect(|beams| is_cut_short |= beams.as_ref().is_ok_and(|b| b.is_cut_short));
            let found = Scintillation::of(&beams, rocked, settings.head_deg, &pattern, &rocking_share)?;
            measures.is_cut_short |= is_cut_short;
            measures.scintillation = Some(found);
        }
        Ok(Output::Measures(Box::new(TakenMeasures { measures, derivatives })))
    }

    /// Measures figures in a scope.
    pub(super) fn figures<E>(
        &mut self,
        job: &Job,
        product: &FiguresProduct,
        (backend, lattice): (&Backend, u32),
        watch: Watch,
    ) -> Result<Output, Halt<E>> {
        let FiguresProduct { scope, medium } = product;
        let solid = job.stone().map_err(RenderError::from)?;
        let (view, manner) = (&job.view, (job.quality.rays, lattice));
        let measured = measured::<Halt<E>>(scope, medium.index, backend.name(), |scope| match backend {
            Backend::Beams => {
                let (body, polytope) = job.convex()?;
                let Quality { standard_error, beams: options, .. } = &job.quality;
                // The beams may exist already, made for pictures.
                let kept = match standard_error {
                    None => self.beams.kept(body, *medium, view, options),
                    Some(_) => None,
                };
                match kept {
                    Some(beams) => Ok(brillianteer_measure::by_beams(&beams, scope)),
                    None => Ok(job.summed(polytope, *medium, scope, watch)?),
                }
            }
            Backend::Rays => Ok(brillianteer_measure::by_rays(solid, *medium, view, scope, manner, watch)?),
            #[cfg(feature = "gpu")]
            Backend::Card(gpu) => {
                brillianteer_measure::by_gpu::<Halt<E>>(gpu, solid, *medium, view, scope, manner, watch)
            }
        })?;
        Ok(Output::Figures(Box::new(measured)))
    }
}

impl Job {
    /// Returns the stone of scopes and figures.
    pub(super) fn stone(&self) -> Result<SolidRef<'_>, Unfit> {
        self.scene.instances.first().map(|stone| stone.body.solid()).ok_or(Unfit::NoStone)
    }

    /// Measures figures by beams that are not kept. With a standard error, rays measure the light that the beams
    /// leave; beams and rays share the work so that it takes the least time.
    fn summed(
        &self,
        polytope: &Polytope,
        medium: Medium,
        scope: &Scope,
        watch: Watch,
    ) -> Result<Figures, RenderError> {
        let Quality { standard_error, beams, .. } = self.quality;
        let parts = if standard_error.is_some() { 2.0 } else { 1.0 };
        let share = |part: f64| move |done: f64| watch((part + done) / parts);
        let of = SumOptions { scope, standard_error };
        let summed = beam::sum_up(polytope, medium, &self.view, &beams, of, &share(0.0))?;
        match standard_error {
            Some(error) => {
                Ok(brillianteer_measure::by_beams_and_rays(polytope, &summed, error, &share(1.0))?)
            }
            None => Ok(brillianteer_measure::by_summed_beams(&summed)),
        }
    }

    /// Traces the stone rocked into each direction, one after the other.
    ///
    /// Rocked stones are seen without most of their symmetry, so ten times as much of their light may stay unresolved as in
    /// the view itself: the bounds of scintillation stay below its own range of a few percent, at a bearable time. For the
    /// same reason each has an eighth of the memory.
    fn rocked<'a>(
        &'a self,
        polytope: &'a Polytope,
        medium: Medium,
        rock_deg: f64,
        watch: Watch<'a>,
    ) -> impl Iterator<Item = Result<Beams, Stopped>> + 'a {
        let unresolved = (10.0 * self.quality.beams.unresolved).min(0.1).max(self.quality.beams.unresolved);
        let options = BeamOptions { unresolved, ..self.quality.beams }.with_part_of_memory(ROCKED_PARTS);
        let views = rocked_views(&self.view, rock_deg);
        let count = views.len() as f64;
        views.into_iter().enumerate().map(move |(number, view)| {
            let share = |done: f64| watch((number as f64 + done) / count);
            beam::trace(polytope, medium, &view, &options, &share)
        })
    }

    /// Returns the body that exact beams trace, with its polytope.
    ///
    /// # Errors
    /// Fails where the scene has no stone, or one that is not convex.
    pub(super) fn convex(&self) -> Result<(&Arc<Body>, &Polytope), RenderError> {
        let stone = self.scene.instances.first().ok_or(Unfit::NoStone)?;
        let polytope = &stone.body.stone().map_err(Unfit::from)?.polytope;
        Ok((&stone.body, polytope))
    }
}
