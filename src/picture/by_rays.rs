//! Pictures in a scope by point rays: for perspective views, where beams do not apply, and as a check on beams.

use super::Rows;
use crate::math::SolidRef;
use crate::scene::{Film, Glare, Medium, Scope, View};
use crate::trace::ray::{Camera, Exit, RayOptions, StoneTracer};
use crate::trace::{Stopped, Watch};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// The settings by which a picture is traced.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ScopeSampling {
    /// How far each ray is followed.
    pub options: RayOptions,
    /// Rays along each side of a pixel, at least 1.
    pub per_side: u32,
    /// Whether glare is part of the energy that is shown.
    pub glare: Glare,
}

/// The number of rows handed on at once.
const PIECE: u32 = 16;

/// Traces a picture row by row, each pixel by a regular grid of rays, and calls `each` as [`paint()`](super::paint())
/// does.
///
/// The channels are the energy of each band of the scope, then the share of each band in the strongest exits, and last
/// the stone's cover.
///
/// # Errors
/// The errors of `each`, and [`Stopped`], converted into `E`, when `watch` stops the work.
#[expect(
    clippy::too_many_arguments,
    reason = "a stone, a view, a light, a film and a manner: none derives from another"
)]
pub fn trace<'a, E: From<Stopped>>(
    solid: impl Into<SolidRef<'a>>,
    medium: Medium,
    view: &View,
    scope: &Scope,
    film: &Film,
    manner: &ScopeSampling,
    watch: Watch,
    mut each: impl FnMut(&Rows) -> Result<(), E>,
) -> Result<(), E> {
    let solid = solid.into();
    let tracer = StoneTracer::new(solid, medium, manner.options);
    let camera = Camera::new(view, solid);
    let zenith = view.zenith();
    let channels = 2 * scope.bands.len() + 1;
    let grid = manner.per_side;
    let pixel = |x: u32, y: u32| {
        let mut values = vec![0.0; channels];
        for k in 0..grid * grid {
            let step = DVec2::new(f64::from(k % grid), f64::from(k / grid)) + 0.5;
            let at = DVec2::new(f64::from(x), f64::from(y)) + step / f64::from(grid);
            let ray = camera.ray(film.image_from_pixels(at));
            put_down(&tracer, ray, |exit| scope.band(exit.direction, zenith), manner.glare, &mut values);
        }
        values.iter_mut().for_each(|v| *v /= f64::from(grid * grid));
        values
    };
    let [across, down] = film.size;
    for first in (0..down).step_by(PIECE as usize) {
        if watch(f64::from(first) / f64::from(down)).is_break() {
            return Err(Stopped.into());
        }
        let count = PIECE.min(down - first);
        let line = |y: u32| (0..across).map(|x| pixel(x, y)).collect::<Vec<_>>();
        let lines: Vec<_> = (first..first + count).into_par_iter().map(line).collect();
        let mut rows = Rows::new(first, count, across, channels);
        for (y, line) in (first..).zip(lines) {
            for (x, values) in line.into_iter().enumerate() {
                values.into_iter().enumerate().for_each(|(c, v)| rows.row_mut(y, c)[x] = v);
            }
        }
        each(&rows)?;
    }
    Ok(())
}

/// Adds what one ray sees to the channels of a pixel.
fn put_down(
    tracer: &StoneTracer,
    (origin, direction): (DVec3, DVec3),
    band: impl Fn(&Exit) -> usize,
    glare: Glare,
    values: &mut [f64],
) {
    let cover = values.len() - 1;
    let mut strongest = (0.0, None);
    let hit = tracer.follow(origin, direction, |exit| {
        let band = band(&exit);
        if glare.shows(exit.surface) {
            values[band] += exit.weight;
        }
        if !exit.surface && exit.weight > strongest.0 {
            strongest = (exit.weight, Some(band));
        }
    });
    if let Some(band) = strongest.1 {
        values[cover / 2 + band] += 1.0;
    }
    if hit.is_some() {
        values[cover] += 1.0;
    }
}
