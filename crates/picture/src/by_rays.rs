//! Pictures in a scope by point rays: for perspective views, where beams do not apply, and as a check on beams.

use super::Rows;
use brillianteer_base::{Stopped, Watch};
use brillianteer_scene::Glare;
use brillianteer_trace::ScopeShot;
use brillianteer_trace::ray::{Camera, Exit, StoneTracer};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// The number of rows handed on at once.
const PIECE: u32 = 16;

/// Traces a picture row by row, each pixel by a regular grid of rays, and calls `each` as [`paint()`](super::paint())
/// does.
///
/// The channels are the energy of each band of the scope, with or without glare, then the share of each band in the strongest exits, and last
/// the stone's cover.
///
/// # Errors
/// The errors of `each`, and [`Stopped`], converted into `E`, when `watch` stops the work.
pub fn trace<E: From<Stopped>>(
    shot: &ScopeShot,
    glare: Glare,
    watch: Watch,
    mut each: impl FnMut(&Rows) -> Result<(), E>,
) -> Result<(), E> {
    let ScopeShot { solid, medium, view, scope, film, per_side: grid, shift, options } = *shot;
    let tracer = StoneTracer::new(solid, medium, options);
    let camera = Camera::new(view, solid);
    let zenith = view.zenith();
    let channels = 2 * scope.bands.len() + 1;
    let pixel = |x: u32, y: u32| {
        let mut values = vec![0.0; channels];
        for k in 0..grid * grid {
            let step = DVec2::new(f64::from(k % grid), f64::from(k / grid)) + shift;
            let at = DVec2::new(f64::from(x), f64::from(y)) + step / f64::from(grid);
            let ray = camera.ray(film.image_from_pixels(at));
            put_down(&tracer, ray, |exit| scope.band(exit.direction, zenith), glare, &mut values);
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

/// Adds the exits of one ray to the channels of a pixel.
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
