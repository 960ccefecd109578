//! Glare: light that an eye or a lens spreads around the brightest points, as a glow and as the streaks of a star.
//!
//! The glow is a sum of Gaussians, in the manner of G. Spencer, P. Shirley, K. Zimmerman and D. P. Greenberg,
//! "Physically-Based Glare Effects for Digital Images", SIGGRAPH 1995. The streaks are exponentials along a direction,
//! after the light streaks of M. Kawase, "Frame Buffer Postprocessing Effects in DOUBLE-S.T.E.A.L.", GDC 2003.
//!
//! Light that is spread is taken away from its own pixel, so that the picture's total light stays the same except for
//! the part that spreads beyond the border.

mod glare;
mod grid;
mod star;

pub(super) use glare::GatheredGlare;

use super::linear::LightRows;
use brillianteer_scene::USUAL_GLOW;
use glare::{BrightPass, halved};
use grid::{LightGrid, SOFTENED};
use rayon::prelude::*;
use star::{TINT, star};

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
        Self { strength: USUAL_GLOW, radius: 0.03, streaks: 6, streak_length: 0.018, threshold: 1.0 }
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

/// The least standard deviation of the finest detail, in cells of a halved grid, at which it is still drawn well.
const COARSEST: f64 = 1.3;

/// The most cells of the grid on which glare is made, at some 32 bytes each. A grid that would have more is halved
/// more often than its detail demands; the finest detail is then at least a cell wide, except in pictures higher than
/// wide.
const MOST_CELLS: u64 = 8 << 20;

/// The variance that halving a grid again and again and doubling it back adds, in square cells of the coarsest grid, for
/// ever more halvings: each halving adds [`SOFTENED`] in cells half as wide as the next one's.
const ALL_SOFTENED: f64 = SOFTENED / 3.0;

impl Bloom {
    /// The most streaks that a star may have.
    pub const MOST_STREAKS: u32 = 32;

    /// Returns the glare of a picture, whose pixels `exposed` converts to exposed light; `None` where no pixel is
    /// bright enough. A setting out of its range counts as the nearer end of the range, NaN as 0.
    ///
    /// The light is read from top to bottom, some rows at a time; rows where two pieces touch are read twice.
    ///
    /// # Errors
    /// The errors of reading the light.
    pub(super) fn glare<L: LightRows>(
        &self,
        light: &mut L,
        exposed: impl Fn(&[f32; 4]) -> [f32; 4] + Sync,
    ) -> Result<Option<GatheredGlare>, L::Error> {
        let strength = within(self.strength, 1.0) as f32;
        let threshold = within(self.threshold, f64::from(f32::MAX)) as f32;
        let size = light.size();
        if strength == 0.0 || size.contains(&0) {
            return Ok(None);
        }
        let bright = BrightPass { strength, threshold };
        let halvings = halvings(size);
        let source = bright.source(light, exposed, halvings)?;
        if source.iter().all(LightGrid::is_dark) {
            return Ok(None);
        }
        let spread = self.spread(source, size[0], halvings);
        Ok(Some(GatheredGlare { bright, size, halvings, spread }))
    }

    /// Returns the glow and the streaks of a grid's light in each colour, for a picture `pixels` wide whose grid was halved
    /// this often.
    fn spread(&self, source: [LightGrid; 3], pixels: u32, halvings: u32) -> [LightGrid; 3] {
        let cell = f64::from(1_u32 << halvings);
        let width = f64::from(pixels) / cell;
        // The halvings already blur, so the Gaussians add only the remaining blur.
        let softened = ALL_SOFTENED * (1.0 - cell.powi(-2));
        let rest = |sigma: f64| (sigma * sigma - softened).max(0.0).sqrt();
        let streaks = self.streaks.min(Self::MOST_STREAKS);
        let radius = within(self.radius, 0.5) * width;
        let glow = GLOW.map(|(part, weight)| (rest(radius * part), weight));
        if streaks == 0 {
            return source.map(|colour| colour.glow(&glow));
        }
        let sparkling = sparkling(&source, SPARKLE * width);
        let length = within(self.streak_length, 1.0) * width;
        let [red, green, blue] = source;
        // The colours are spread one after the other, which takes less memory.
        [(red, TINT[0]), (green, TINT[1]), (blue, TINT[2])].map(|(mut steady, tint)| {
            let sparkle = steady.times(&sparkling);
            steady.add(&sparkle, -1.0);
            let fine = sparkle.gaussian(rest(STREAK_WIDTH * width));
            drop(sparkle);
            let star = star(fine, streaks, length * tint);
            let mut sum = steady.glow(&glow);
            sum.add(&star, 1.0);
            sum
        })
    }
}

/// Returns how often the light of a picture is halved for glare: as often as the finest detail allows, or more where there
/// would be too many cells.
fn halvings(size: [u32; 2]) -> u32 {
    let finest = STREAK_WIDTH * f64::from(size[0]);
    let fine_enough = (finest / COARSEST).log2().clamp(0.0, 16.0) as u32;
    let cells = |times| size.map(|side| u64::from(halved(side, times))).into_iter().product::<u64>();
    (fine_enough..).find(|&times| cells(times) <= MOST_CELLS).unwrap_or(fine_enough)
}

/// Returns the part of each cell's light that goes into the streaks; its surroundings are averaged over this standard
/// deviation, in cells.
///
/// Light as bright as its surroundings is not a sparkle: streaks from a wide patch would be curtains with hard edges.
fn sparkling(source: &[LightGrid; 3], sigma: f64) -> LightGrid {
    let [red, green, blue] = source;
    let mut own = red.clone();
    [green, blue].into_iter().for_each(|colour| own.add(colour, 1.0));
    let mut around = own.glow(&[(sigma, 1.0)]);
    around.cells.par_iter_mut().zip(&own.cells).for_each(|(cell, own)| {
        *cell = if own > cell { IN_STREAKS * (1.0 - *cell / own) } else { 0.0 };
    });
    around
}

/// Returns a setting clamped to 0 to `most`; NaN becomes 0.
fn within(value: f64, most: f64) -> f64 {
    value.max(0.0).min(most)
}

#[cfg(test)]
mod tests;
