//! Traces pictures in scopes on a graphics card.

use super::device::{Gpu, GpuError};
use super::gpu_types::{Bands, Medium, ScopePixel, with};
use super::limits::MOST_CARD_BANDS;
use super::solids::Solids;
use super::stage::{GpuCamera, Stage};
use crate::math::{Pose, PosedSolid};
use crate::trace::{ScopeShot, Stopped, Watch};

impl Gpu {
    /// Takes a picture, some rows at a time, from the top: calls `each` with the first row's number and the pixels of whole
    /// rows.
    ///
    /// # Errors
    /// The error of `each`; [`Stopped`] or a [`GpuError`], turned into the same kind of error.
    pub fn scope<E: From<Stopped> + From<GpuError>>(
        &self,
        shot: &ScopeShot,
        watch: Watch,
        mut each: impl FnMut(u32, &[ScopePixel]) -> Result<(), E>,
    ) -> Result<(), E> {
        let rows = Stage::rows(self, shot.film.size);
        let stage = stage(self, shot, rows)?;
        let turns = shot.per_side * shot.per_side;
        let shift = shot.shift + shot.film.shift() * f64::from(shot.per_side);
        let down = shot.film.size[1];
        for first in (0..down).step_by(rows as usize) {
            let count = rows.min(down - first);
            for turn in 0..turns {
                let part = f64::from(turn) / f64::from(turns);
                if watch((f64::from(first) + part * f64::from(count)) / f64::from(down)).is_break() {
                    return Err(Stopped.into());
                }
                stage.look((first, count), (shift, 0.0), [turn, shot.per_side, 0, 1])?;
            }
            each(first, &stage.read::<ScopePixel>(count)?)?;
        }
        Ok(())
    }
}

fn stage<'a>(gpu: &'a Gpu, shot: &ScopeShot, rows: u32) -> Result<Stage<'a>, GpuError> {
    let count = shot.scope.bands.len();
    if count > MOST_CARD_BANDS {
        return Err(GpuError::TooManyBands { count, most: MOST_CARD_BANDS });
    }
    let reach = shot.solid.reach();
    let solids = Solids::new(gpu, &[PosedSolid { solid: shot.solid, pose: Pose::STILL }])?;
    let bands = gpu.buffer("bands", bytemuck::bytes_of(&bands(shot)), wgpu::BufferUsages::UNIFORM);
    let medium = Medium::new(&shot.medium, solids.units[0]);
    let media = gpu.buffer("media", bytemuck::bytes_of(&medium), wgpu::BufferUsages::STORAGE);
    let mut entries = solids.entries(&media);
    entries.push(wgpu::BindGroupEntry { binding: 6, resource: bands.as_entire_binding() });
    let eye = GpuCamera { view: shot.view, film: shot.film, reach, options: shot.options };
    let frame = eye.frame(gpu, &solids, 1);
    solids.enough(gpu, frame.counts[2], shot.options.most_bounces)?;
    Stage::new::<ScopePixel>(
        gpu,
        gpu.scopes.pipeline(&gpu.device, solids.surfaces.facets),
        frame,
        rows,
        entries,
    )
}

fn bands(shot: &ScopeShot) -> Bands {
    let mut borders = [2.0_f32; MOST_CARD_BANDS];
    for (border, band) in borders.iter_mut().zip(shot.scope.bands.iter().skip(1)) {
        *border = band.from.to_radians().sin() as f32;
    }
    let [a, b, c, d, e, f, g, h] = borders;
    Bands { zenith: with(shot.view.zenith(), 0.0), borders_low: [a, b, c, d], borders_high: [e, f, g, h] }
}
