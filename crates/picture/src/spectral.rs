//! Pictures of stones under light: adds up the sample passes that a picture is made from.

use super::Linear;
use brillianteer_base::{Stopped, Watch};
use brillianteer_optics::Strata;
use brillianteer_trace::sampling::{LitScene, ProgressiveImage, RadiancePixel, Sampling};
use std::ops::Range;

/// The light that a picture does not show, as means over the area that the stones cover.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Remainder {
    /// The share of the light that was not followed to its end.
    pub unresolved: f64,
    /// The share of the light that is absorbed.
    pub absorbed: f64,
}

/// Takes a picture with sample passes as `sampling` describes them, in these strata of wavelength. `prepare` builds the tracer for a range
/// of rows, which never has more than `most_rows`.
///
/// # Errors
/// The errors of `prepare` and of the tracer that it builds, and [`Stopped`] when `watch` stops the work.
pub fn expose<E: From<Stopped>, X: ProgressiveImage<E>>(
    lit_scene: &LitScene,
    sampled: (&Strata, Sampling),
    most_rows: u32,
    prepare: impl Fn(Range<u32>) -> Result<X, E>,
    watch: Watch,
) -> Result<(Linear, Remainder), E> {
    collected(lit_scene, |each| expose_rows(lit_scene, sampled, most_rows, prepare, watch, each))
}

/// Takes a picture as [`expose`] does, and calls `each` with every row as soon as it is finished, from top to bottom: with
/// its number and its pixels as in [`Linear`]. It never holds more than `most_rows` rows.
///
/// # Errors
/// The errors of [`expose`] and of `each`.
pub fn expose_rows<E: From<Stopped>, X: ProgressiveImage<E>>(
    lit_scene: &LitScene,
    (strata, sampling): (&Strata, Sampling),
    most_rows: u32,
    prepare: impl Fn(Range<u32>) -> Result<X, E>,
    watch: Watch,
    each: EachRow<E>,
) -> Result<Remainder, E> {
    let [width, height] = lit_scene.film.size;
    let mut sum = Sum::of(width, each);
    for first in (0..height).step_by(most_rows as usize) {
        let rows = first..(first + most_rows).min(height);
        let mut exposure = prepare(rows.clone())?;
        let pass = |number: u32| sampling.pass(lit_scene.scene, strata, number);
        let done = |part: f64| watch((f64::from(rows.start) + rows.len() as f64 * part) / f64::from(height));
        exposure.add_passes(0..sampling.count, &pass, &done)?;
        sum.add(&exposure)?;
    }
    Ok(sum.remainder())
}

/// Returns the state of a whole picture's exposure.
///
/// # Errors
/// The errors of the exposure.
pub fn seen<E: From<Stopped>, X: ProgressiveImage<E>>(
    lit_scene: &LitScene,
    exposure: &X,
) -> Result<(Linear, Remainder), E> {
    collected(lit_scene, |each| {
        let mut sum = Sum::of(lit_scene.film.size[0], each);
        sum.add(exposure)?;
        Ok(sum.remainder())
    })
}

/// A callback that receives the rows of a picture; its error ends the work.
pub type EachRow<'a, E> = &'a mut dyn FnMut(u32, &[[f32; 4]]) -> Result<(), E>;

/// Returns the picture of the rows that `work` hands out, and the result of `work`.
fn collected<E, T>(
    lit_scene: &LitScene,
    work: impl FnOnce(EachRow<E>) -> Result<T, E>,
) -> Result<(Linear, T), E> {
    let [width, height] = lit_scene.film.size;
    let mut pixels = Vec::with_capacity(width as usize * height as usize);
    let rest = work(&mut |_, row| {
        pixels.extend_from_slice(row);
        Ok(())
    })?;
    Ok((Linear { width, height, pixels }, rest))
}

/// Hands out the rows of the pixels that are added, and sums up the light that they do not show.
struct Sum<'a, E> {
    width: usize,
    /// The pixels of the row that is not whole yet, and its number.
    row: Vec<[f32; 4]>,
    y: u32,
    each: EachRow<'a, E>,
    rest: Remainder,
    cover: f64,
}

impl<'a, E: From<Stopped>> Sum<'a, E> {
    fn of(width: u32, each: EachRow<'a, E>) -> Self {
        let (width, row) = (width as usize, Vec::with_capacity(width as usize));
        Self { width, row, y: 0, each, rest: Remainder::default(), cover: 0.0 }
    }

    /// Adds the pixels of an exposure, which begin with a row.
    fn add<X: ProgressiveImage<E>>(&mut self, exposure: &X) -> Result<(), E> {
        // The tracer cannot be stopped between two pixels, so the first error waits until it has gone through all.
        let mut done = Ok(());
        exposure.each_pixel(&mut |lit| {
            if done.is_ok() {
                done = self.add_pixel(lit);
            }
        })?;
        done
    }

    fn add_pixel(&mut self, lit: &RadiancePixel) -> Result<(), E> {
        self.rest.unresolved += lit.unresolved;
        self.rest.absorbed += lit.absorbed;
        self.cover += lit.cover;
        let [red, green, blue] = lit.colour.as_vec3().to_array();
        self.row.push([red, green, blue, lit.cover as f32]);
        if self.row.len() < self.width {
            return Ok(());
        }
        (self.each)(self.y, &self.row)?;
        self.y += 1;
        self.row.clear();
        Ok(())
    }

    /// Returns the light that the pixels do not show, as means over the area that the stones cover.
    fn remainder(self) -> Remainder {
        let share = if self.cover > 0.0 { 1.0 / self.cover } else { 0.0 };
        let Remainder { unresolved, absorbed } = self.rest;
        Remainder { unresolved: unresolved * share, absorbed: absorbed * share }
    }
}
