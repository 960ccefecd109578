//! The pictures of [`by_rays`](super::by_rays), traced on a graphics card.

use super::Rows;
use brillianteer_base::{Stopped, Watch};
use brillianteer_scene::Glare;
use brillianteer_trace::ScopeShot;
use brillianteer_trace::gpu::{Gpu, GpuError, ScopePixel};

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
        let mut rows = Rows::new(first, pixels.len() as u32 / size, size, 2 * bands + 1);
        rows.fill_rows(|row, values| {
            let line = &pixels[row * size as usize..][..size as usize];
            for (channel, to) in values.chunks_mut(size as usize + 1).enumerate() {
                let value = |seen: &ScopePixel| match channel.checked_sub(bands) {
                    None => seen.transmitted[channel] + share * seen.surface[channel],
                    Some(band) if band < bands => seen.strongest[band],
                    Some(_) => seen.hit,
                };
                to.iter_mut().zip(line).for_each(|(to, seen)| *to = f64::from(value(seen)));
            }
        });
        each(&rows)
    })
}
