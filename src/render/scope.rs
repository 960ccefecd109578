//! Pictures and figures in a scope.

use super::card::Backend;
use super::job::{FiguresProduct, Job, Reading, ScopeProduct};
use super::plan::Unfit;
use super::renderer::{EachPart, Halt, Output, Partial, RenderError, Renderer};
use crate::math::{Polytope, SolidRef};
use crate::measure::{self, Figures, measured};
use crate::picture::{Layer, Rows, by_rays, paint};
use crate::scene::{Body, Scope};
use crate::trace::{ScopeShot, Watch, beam};
use glam::DVec2;
use std::sync::Arc;

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
            Backend::Card(gpu) => crate::picture::by_gpu::trace(gpu, &shot, *glare, watch, hand_out)?,
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
            Backend::Beams => match job.quality.standard_error {
                Some(standard_error) => Ok(job.estimated(product, scope, standard_error, watch)?),
                None => {
                    let beams = self.beams.of(job.convex()?, *medium, view, &job.quality.beams, watch)?;
                    Ok(measure::by_beams(&beams, scope))
                }
            },
            Backend::Rays => Ok(measure::by_rays(solid, *medium, view, scope, manner, watch)?),
            #[cfg(feature = "gpu")]
            Backend::Card(gpu) => measure::by_gpu::<Halt<E>>(gpu, solid, *medium, view, scope, manner, watch),
        })?;
        Ok(Output::Figures(Box::new(measured)))
    }
}

impl Job {
    /// Returns the stone that scopes and figures are of.
    pub(super) fn stone(&self) -> Result<SolidRef<'_>, Unfit> {
        self.scene.instances.first().map(|stone| stone.body.solid()).ok_or(Unfit::NoStone)
    }

    /// Measures figures by beams, and by rays what these leave, each as far as the other makes it worth its time.
    fn estimated(
        &self,
        product: &FiguresProduct,
        scope: &Scope,
        standard_error: f64,
        watch: Watch,
    ) -> Result<Figures, RenderError> {
        let (_, polytope) = self.convex()?;
        let half = |part: f64| move |done: f64| watch((part + done) / 2.0);
        let to = Some(standard_error);
        let grown = beam::grow(polytope, product.medium, &self.view, &self.quality.beams, to, &half(0.0))?;
        Ok(measure::by_beams_and_rays(polytope, &grown, scope, standard_error, &half(1.0))?)
    }

    /// Returns the body that exact beams trace, with its polytope.
    fn convex(&self) -> Result<(&Arc<Body>, &Polytope), RenderError> {
        let stone = self.scene.instances.first().ok_or(Unfit::NoStone)?;
        let polytope = &stone.body.stone().map_err(Unfit::from)?.polytope;
        Ok((&stone.body, polytope))
    }
}
