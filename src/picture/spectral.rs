//! Pictures of stones under light: adds up the sample passes that a picture is made from.

use super::Linear;
use crate::optics::Stratum;
use crate::trace::sampling::{LitScene, ProgressiveImage, RadiancePixel, Sampling};
use crate::trace::{Stopped, Watch};
use std::ops::Range;

/// The light that a picture does not show, as means over what it covers.
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
    (strata, sampling): (&[Stratum], Sampling),
    most_rows: u32,
    prepare: impl Fn(Range<u32>) -> Result<X, E>,
    watch: Watch,
) -> Result<(Linear, Remainder), E> {
    let [width, height] = lit_scene.film.size;
    let mut sum = Sum::of(width, height);
    for first in (0..height).step_by(most_rows as usize) {
        let rows = first..(first + most_rows).min(height);
        let mut exposure = prepare(rows.clone())?;
        for number in 0..sampling.count {
            let done = |part: f64| {
                let rows_done = f64::from(rows.start)
                    + rows.len() as f64 * (f64::from(number) + part) / f64::from(sampling.count);
                watch(rows_done / f64::from(height))
            };
            exposure.add_pass(&sampling.pass(lit_scene.scene, strata, number), &done)?;
        }
        exposure.each_pixel(&mut |lit| sum.add(lit))?;
    }
    Ok(sum.finish(width, height))
}

/// Returns what an exposure of a whole picture has seen so far.
///
/// # Errors
/// The errors of the exposure.
pub fn seen<E: From<Stopped>, X: ProgressiveImage<E>>(
    lit_scene: &LitScene,
    exposure: &X,
) -> Result<(Linear, Remainder), E> {
    let [width, height] = lit_scene.film.size;
    let mut sum = Sum::of(width, height);
    exposure.each_pixel(&mut |lit| sum.add(lit))?;
    Ok(sum.finish(width, height))
}

/// The pixels added so far, with sums over them.
struct Sum {
    pixels: Vec<[f32; 4]>,
    rest: Remainder,
    cover: f64,
}

impl Sum {
    fn of(width: u32, height: u32) -> Self {
        let pixels = Vec::with_capacity(width as usize * height as usize);
        Self { pixels, rest: Remainder::default(), cover: 0.0 }
    }

    fn add(&mut self, lit: &RadiancePixel) {
        self.rest.unresolved += lit.unresolved;
        self.rest.absorbed += lit.absorbed;
        self.cover += lit.cover;
        let [red, green, blue] = lit.colour.as_vec3().to_array();
        self.pixels.push([red, green, blue, lit.cover as f32]);
    }

    fn finish(self, width: u32, height: u32) -> (Linear, Remainder) {
        let share = if self.cover > 0.0 { 1.0 / self.cover } else { 0.0 };
        let Remainder { unresolved, absorbed } = self.rest;
        let rest = Remainder { unresolved: unresolved * share, absorbed: absorbed * share };
        (Linear { width, height, pixels: self.pixels }, rest)
    }
}
