//! The pictures of [`by_rays`](super::by_rays), traced on a graphics card.

use super::Rows;
use super::by_rays::ScopeSampling;
use crate::math::SolidRef;
use crate::scene::{Film, Glare, Medium, Scope, View};
use crate::trace::gpu::{Gpu, GpuError, ScopePixel, ScopeShot};
use crate::trace::{Stopped, Watch};
use glam::DVec2;

/// Traces a picture on a graphics card, each pixel by a regular grid of rays. It calls `each` as
/// [`by_rays::trace`](super::by_rays::trace()) does, with the same channels.
///
/// # Errors
/// The errors of `each`, [`Stopped`] when `watch` stops the work, and [`GpuError`], the last two converted into `E`.
#[expect(
    clippy::too_many_arguments,
    reason = "a card, a stone, a view, a light, a film and a manner: none derives from another"
)]
pub fn trace<'a, E: From<Stopped> + From<GpuError>>(
    gpu: &Gpu,
    solid: impl Into<SolidRef<'a>>,
    medium: Medium,
    view: &View,
    scope: &Scope,
    film: &Film,
    manner: &ScopeSampling,
    watch: Watch,
    mut each: impl FnMut(&Rows) -> Result<(), E>,
) -> Result<(), E> {
    let ScopeSampling { options, per_side, glare } = *manner;
    let (film, shift, size) = (*film, DVec2::splat(0.5), film.size[0]);
    let shot = ScopeShot { solid: solid.into(), medium, view, scope, film, per_side, shift, options };
    let bands = scope.bands.len();
    let share = if glare == Glare::Included { 1.0 } else { 0.0 };
    gpu.scope(&shot, watch, |first, pixels| {
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
