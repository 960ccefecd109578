//! Glare: light that an eye or a lens spreads from the brightest points, as a glow and as the streaks of a star.
//!
//! The glow is a sum of Gaussians, in the manner of G. Spencer, P. Shirley, K. Zimmerman and D. P. Greenberg,
//! "Physically-Based Glare Effects for Digital Images", SIGGRAPH 1995. The streaks are exponentials along a direction,
//! after the light streaks of M. Kawase, "Frame Buffer Postprocessing Effects in DOUBLE-S.T.E.A.L.", GDC 2003.
//!
//! Light that is spread is taken away from its own pixel, so that the picture's total light stays the same except for
//! what spreads beyond the border.

mod grid;
mod star;

use super::Linear;
use super::linear::luminance;
use glam::Vec4;
use grid::LightGrid;
use rayon::prelude::*;

/// The settings by which bright light is spread.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bloom {
    /// The part of the light above the threshold that is spread, 0 to 1.
    pub strength: f64,
    /// The standard deviation of the widest glow, as a part of the picture's width, 0 to 0.5.
    pub radius: f64,
    /// The number of streaks of a star, 0 (none) to [`MOST_STREAKS`](Self::MOST_STREAKS).
    pub streaks: u32,
    /// The length in which a streak fades to 1/e, as a part of the picture's width, 0 to 1.
    pub streak_length: f64,
    /// The luminance above which light is spread. A soft knee spreads a little from half of it on.
    pub threshold: f64,
}

impl Default for Bloom {
    /// Returns settings tuned by eye on stones whose sparkles are 2 to 50 times as bright as white.
    fn default() -> Self {
        Self { strength: 0.16, radius: 0.03, streaks: 6, streak_length: 0.018, threshold: 1.0 }
    }
}

/// The Gaussians of the glow: the standard deviation as a part of the widest one's, and the share of the light.
const GLOW: [(f64, f32); 4] = [(1.0 / 27.0, 0.4), (1.0 / 9.0, 0.3), (1.0 / 3.0, 0.2), (1.0, 0.1)];

/// The part of a sparkle's light that goes into the streaks; where the surroundings are bright, less does.
const IN_STREAKS: f32 = 0.4;

/// The standard deviation of a streak's width, as a part of the picture's width.
const STREAK_WIDTH: f64 = 0.0007;

/// The standard deviation over which a sparkle's surroundings are averaged, as a part of the picture's width.
const SPARKLE: f64 = 0.008;

/// How far below the threshold spreading begins, as a part of the threshold.
const KNEE: f32 = 0.5;

/// The least standard deviation, in cells, that the finest detail may have on a halved grid to be shown well.
const COARSEST: f64 = 1.3;

impl Bloom {
    /// The most streaks that a star may have.
    pub const MOST_STREAKS: u32 = 32;

    /// Spreads the brightest light of a picture, in place. Cover stays as it is. A setting out of its range counts as
    /// the nearer end of the range, NaN as 0.
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
        // The last doubling would be as large as the picture, so each of its rows is made only when it is added.
        picture.pixels.par_chunks_mut(picture.width as usize).enumerate().for_each(|(y, row)| {
            let light = glare.doubled_row(y);
            row.iter_mut().enumerate().for_each(|(x, pixel)| spread(pixel, taken(pixel), light(x)));
        });
    }

    /// Returns the light to be spread, on a grid halved as often as the finest detail of glare allows, and the number of
    /// halvings.
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

    /// Returns the glow and the streaks of a grid's light, where the whole picture is `width` cells wide.
    fn spread(&self, source: &LightGrid, width: f64) -> LightGrid {
        let streaks = self.streaks.min(Self::MOST_STREAKS);
        let radius = within(self.radius, 0.5) * width;
        let glow = GLOW.map(|(part, weight)| (radius * part, weight));
        if streaks == 0 {
            return source.glow(&glow);
        }
        // Light as bright as its surroundings is not a sparkle: streaks from a wide patch would be curtains with hard
        // edges.
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

/// Returns the part of a pixel's light above the threshold, with a soft knee: a parabola that joins both straight lines.
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
    // The comparison also rejects the NaN that a luminance of zero, infinity or NaN gives.
    let part = excess / y;
    if part > 0.0 { Vec4::new(r, g, b, 0.0) * part } else { Vec4::ZERO }
}

/// Returns a setting clamped to 0 to `most`; NaN becomes 0.
fn within(value: f64, most: f64) -> f64 {
    value.max(0.0).min(most)
}

/// Returns the length of a side after `times` halvings, each rounded up.
fn halved(side: u32, times: u32) -> u32 {
    (0..times).fold(side, |side, _| side.div_ceil(2))
}

#[cfg(test)]
mod tests;
