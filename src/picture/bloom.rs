//! Glare: what an eye or a lens spreads of the brightest light, as a glow and as a star's rays.
//!
//! The glow is a sum of Gaussians, in the manner of G. Spencer, P. Shirley, K. Zimmerman and D. P. Greenberg,
//! "Physically-Based Glare Effects for Digital Images", SIGGRAPH 1995; the rays are exponentials along a direction,
//! after the light streaks of M. Kawase, "Frame Buffer Postprocessing Effects in DOUBLE-S.T.E.A.L.", GDC 2003.
//! What is spread is taken from where it was, so that the picture's light stays what it was but for what leaves it.

mod grid;
mod star;

use super::Linear;
use super::linear::luminance;
use glam::Vec4;
use grid::LightGrid;
use rayon::prelude::*;

/// How bright light is spread.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bloom {
    /// The part of the light above the threshold that is spread, 0 to 1.
    pub strength: f64,
    /// The standard deviation of the widest glow, as a part of the picture's width, 0 to 0.5.
    pub radius: f64,
    /// The star's rays, 0 (none) to [`MOST_STREAKS`](Self::MOST_STREAKS).
    pub streaks: u32,
    /// The length in which a ray falls to 1/e, as a part of the picture's width, 0 to 1.
    pub streak_length: f64,
    /// The luminance above which light is spread; from half of it on, a little is.
    pub threshold: f64,
}

impl Default for Bloom {
    /// Tuned by eye on stones whose sparkles are 2 to 50 times as bright as white.
    fn default() -> Self {
        Self { strength: 0.16, radius: 0.03, streaks: 6, streak_length: 0.018, threshold: 1.0 }
    }
}

/// The Gaussians of the glow: standard deviation as a part of the widest, and share.
const GLOW: [(f64, f32); 4] = [(1.0 / 27.0, 0.4), (1.0 / 9.0, 0.3), (1.0 / 3.0, 0.2), (1.0, 0.1)];

/// The part of a sparkle that goes into the rays.
const IN_STREAKS: f32 = 0.4;

/// The standard deviation of a ray's width, as a part of the picture's width.
const STREAK_WIDTH: f64 = 0.0007;

/// The standard deviation of what counts as a sparkle's surroundings, as a part of the picture's width.
const SPARKLE: f64 = 0.008;

/// The part of the threshold below it at which spreading begins.
const KNEE: f32 = 0.5;

/// A standard deviation in cells that a coarser grid still shows well.
const COARSEST: f64 = 1.3;

impl Bloom {
    /// The most rays of a star.
    pub const MOST_STREAKS: u32 = 32;

    /// Spreads a picture's brightest light. Cover stays as it is. Numbers out of their range count as its end.
    pub fn apply(&self, picture: &mut Linear) {
        let strength = within(self.strength, 1.0) as f32;
        let threshold = within(self.threshold, f64::from(f32::MAX)) as f32;
        if strength == 0.0 || picture.width == 0 || picture.pixels.is_empty() {
            return;
        }
        let taken = |pixel: &[f32; 4]| bright(pixel, threshold) * strength;
        let (source, halvings) = self.source(picture, taken);
        if source.is_dark() {
            return;
        }
        let mut glare = self.spread(&source, f64::from(picture.width) / f64::from(1_u32 << halvings));
        let spread = |pixel: &mut [f32; 4], own: Vec4, light: Vec4| {
            let sum = Vec4::from_array(*pixel) - own + light;
            *pixel = [sum.x, sum.y, sum.z, pixel[3]];
        };
        if halvings == 0 {
            let cells = source.cells.par_iter().zip(&glare.cells);
            picture
                .pixels
                .par_iter_mut()
                .zip(cells)
                .for_each(|(pixel, (&own, &light))| spread(pixel, own, light));
            return;
        }
        drop(source);
        for level in (1..halvings).rev() {
            let (width, height) = (halved(picture.width, level), halved(picture.height, level));
            glare = glare.doubled(width as usize, height as usize);
        }
        // The last doubling would be as large as the picture: each row is made when it is added.
        picture.pixels.par_chunks_mut(picture.width as usize).enumerate().for_each(|(y, row)| {
            let light = glare.doubled_row(y);
            row.iter_mut().enumerate().for_each(|(x, pixel)| spread(pixel, taken(pixel), light(x)));
        });
    }

    /// The light to be spread, on a grid halved as often as the finest detail of glare allows.
    fn source(&self, picture: &Linear, taken: impl Fn(&[f32; 4]) -> Vec4 + Sync) -> (LightGrid, u32) {
        let finest = STREAK_WIDTH * f64::from(picture.width);
        let halvings = (finest / COARSEST).log2().clamp(0.0, 16.0) as u32;
        let (width, height) = (picture.width as usize, picture.height as usize);
        let at = |x: usize, y: usize| picture.pixels.get(y * width + x).map_or(Vec4::ZERO, &taken);
        if halvings == 0 {
            return (LightGrid::filled(width, height, at), 0);
        }
        let mut grid = LightGrid::halved_from(width, height, at);
        (1..halvings).for_each(|_| grid = grid.halved());
        (grid, halvings)
    }

    /// The light of a grid, spread; the picture is `width` cells wide.
    fn spread(&self, source: &LightGrid, width: f64) -> LightGrid {
        let streaks = self.streaks.min(Self::MOST_STREAKS);
        let radius = within(self.radius, 0.5) * width;
        let glow = GLOW.map(|(part, weight)| (radius * part, weight));
        if streaks == 0 {
            return source.glow(&glow);
        }
        // What is as bright as its surroundings is no sparkle: rays of a wide patch would be curtains with hard edges.
        let around = source.glow(&[(SPARKLE * width, 1.0)]);
        let mut sparkle = source.clone();
        sparkle.cells.par_iter_mut().zip(&around.cells).for_each(|(cell, around)| {
            let (own, around) = (cell.truncate().element_sum(), around.truncate().element_sum());
            *cell *= if own > around { IN_STREAKS * (1.0 - around / own) } else { 0.0 };
        });
        let mut rest = source.clone();
        rest.add(&sparkle, -1.0);
        let mut sum = rest.glow(&glow);
        let fine = sparkle.gaussian(STREAK_WIDTH * width);
        sum.add(&star::star(&fine, streaks, within(self.streak_length, 1.0) * width), 1.0);
        sum
    }
}

/// The part of a pixel's light above the threshold, with a soft knee (a parabola that meets both lines).
fn bright(&[r, g, b, _]: &[f32; 4], threshold: f32) -> Vec4 {
    let y = luminance([r, g, b]);
    let knee = threshold * KNEE;
    let excess = if y >= threshold + knee {
        y - threshold
    } else if y > threshold - knee {
        (y - threshold + knee).powi(2) / (4.0 * knee)
    } else {
        return Vec4::ZERO;
    };
    // Also catches a luminance of nothing, infinity or NaN.
    let part = excess / y;
    if part > 0.0 { Vec4::new(r, g, b, 0.0) * part } else { Vec4::ZERO }
}

/// A setting between 0 and its greatest value; NaN is 0.
fn within(value: f64, most: f64) -> f64 {
    value.max(0.0).min(most)
}

/// A side after so many halvings.
fn halved(side: u32, times: u32) -> u32 {
    (0..times).fold(side, |side, _| side.div_ceil(2))
}

#[cfg(test)]
mod tests;
