//! Traces pictures in scopes on a graphics card.

use super::device::{Gpu, GpuError};
use super::gpu_types::{Bands, Medium, ScopePixel, with};
use super::limits::MOST_CARD_BANDS;
use super::solids::Solids;
use super::stage::{GpuCamera, Stage, StripLayer};
use crate::ScopeShot;
use brillianteer_base::{Stopped, Watch};
use brillianteer_math::{Pose, PosedSolid};
use glam::DVec2;

/// The most pixels in a strip. They occupy any card fully, and memory for more of them takes longer to get than the card
/// takes to trace them.
const PIXELS_AT_ONCE: u32 = 1 << 18;

impl Gpu {
    /// Traces a picture some rows at a time, from the top, and calls `each` with the first row's number and the
    /// pixels of whole rows.
    ///
    /// # Errors
    /// Fails with the error of `each`, or with a [`Stopped`] or a [`GpuError`] converted to its type.
    pub fn scope<E: From<Stopped> + From<GpuError>>(
        &self,
        shot: &ScopeShot,
        watch: Watch,
        mut each: impl FnMut(u32, &[ScopePixel]) -> Result<(), E>,
    ) -> Result<(), E> {
        let [across, down] = shot.film.size;
        let rows = (PIXELS_AT_ONCE / across.max(1)).clamp(1, down.max(1));
        let stage = stage(self, shot, rows)?;
        let turns = shot.per_side * shot.per_side;
        let (shift, origin) = shifts(shot);
        for first in (0..down).step_by(rows as usize) {
            let strip = first..down.min(first + rows);
            for turn in 0..turns {
                let layer = StripLayer { shift, origin, cell: [turn, shot.per_side], bands: 1 };
                let part = |part: f64| {
                    let part = (f64::from(turn) + part) / f64::from(turns);
                    (f64::from(first) + part * strip.len() as f64) / f64::from(down)
                };
                stage.trace::<E>(&strip, &layer, &|done| watch(part(done)))?;
            }
            stage.read(strip.len() as u32, |pixels| each(first, pixels))??;
        }
        Ok(())
    }
}

/// Returns the place of a ray in its cell, shifted to the film's centre, and the shift of that centre in pixels.
fn shifts(shot: &ScopeShot) -> (DVec2, DVec2) {
    let origin = shot.film.shift();
    (shot.shift + origin * f64::from(shot.per_side), origin)
}

fn stage<'a>(gpu: &'a Gpu, shot: &ScopeShot, rows: u32) -> Result<Stage<'a>, GpuError> {
    let count = shot.scope.bands.len();
    if count > MOST_CARD_BANDS {
        return Err(GpuError::TooManyBands { count, most: MOST_CARD_BANDS });
    }
    let reach = shot.solid.reach();
    let solids = Solids::new(gpu, &[PosedSolid { solid: shot.solid, pose: Pose::STILL }], &[])?;
    let bands = gpu.buffer("bands", bytemuck::bytes_of(&bands(shot)), wgpu::BufferUsages::UNIFORM);
    let medium = Medium::new(&shot.medium, solids.units[0]);
    let media = gpu.buffer("media", bytemuck::bytes_of(&medium), wgpu::BufferUsages::STORAGE);
    let mut entries = solids.entries(&media);
    entries.push(wgpu::BindGroupEntry { binding: 6, resource: bands.as_entire_binding() });
    let eye = GpuCamera { view: shot.view, film: shot.film, reach, options: shot.options };
    let frame = eye.frame(gpu, &solids, 1);
    solids.enough(gpu, frame.most_bounces, shot.options.most_bounces)?;
    let kernel = gpu.scopes.kernel(&gpu.device, solids.surfaces.facets, false);
    Stage::new::<ScopePixel>(gpu, kernel, (frame, rows), (solids.cost(frame.most_bounces), 1), entries)
}

fn bands(shot: &ScopeShot) -> Bands {
    let mut borders = [2.0_f32; MOST_CARD_BANDS];
    for (border, band) in borders.iter_mut().zip(shot.scope.bands.iter().skip(1)) {
        *border = band.from.to_radians().sin() as f32;
    }
    let [a, b, c, d, e, f, g, h] = borders;
    Bands { zenith: with(shot.view.zenith(), 0.0), borders_low: [a, b, c, d], borders_high: [e, f, g, h] }
}
