//! The pictures of [`by_rays`](super::by_rays), traced on a graphics card.

use super::Rows;
use crate::scene::Glare;
use crate::trace::gpu::{Gpu, GpuError, ScopePixel};
use crate::trace::{ScopeShot, Stopped, Watch};

/// Traces a picture on a graphics card, each pixel by a regular grid of rays. It calls `each` as
/// [`by_rays::trace`](super::by_rays::trace()) does, with the same channels.
///
/// # Errors
/// The errors of `each`, [`Stopped`] when `watch` stops the work, and [`GpuError`], the last two converted into `E`.
pub fn trace<E: From<Stopped> + From<GpuError>>(
    gpu: &Gpu,
    shot: &ScopeShot,
    glare: Glare,
    watch: Watch,
    mut each: impl FnMut(&Rows) -> Result<(), E>,
) -> Result<(), E> {
    let (size, bands) = (shot.film.size[0], shot.scope.bands.len());
    let share = if glare == Glare::Included { 1.0 } else { 0.0 };
    gpu.scope(shot, watch, |first, pixels| {
        let count = pixels.len() as u32 / size;
        let mut rows = Rows::new(first, count, size, 2 * bands + 1);
        for (y, line) in (first..).zip(pixels.chunks(size as usize)) {
            let mut fill = |channel, value: &dyn Fn(&ScopePixel) -> f32| {
                let to = rows.row_mut(y, channel).iter_mut();
                to.zip(line).for_each(|(to, seen)| *to = f64::from(value(seen)));
            };
            for band in 0..bands {
                fill(band, &|seen| seen.transmitted[band] + share * seen.surface[band]);
                fill(bands + band, &|seen| seen.strongest[band]);
            }
            fill(2 * bands, &ScopePixel::hit);
        }
        each(&rows)
    })
}
