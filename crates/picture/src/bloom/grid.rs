//! Light of one colour on a grid of cells, and its blurring by Gaussians: narrow ones are summed up tap by tap, wide ones
//! on halved grids (P. J. Burt, "Fast Filter Transforms for Image Processing", CGIP 16, 1981).
//!
//! All weights are positive, so that no sum cancels however bright a point is, and they add up to 1. There is no light
//! beyond the border.

use rayon::prelude::*;
use std::ops::Range;

/// A grid with the mean light of each cell, in one colour.
#[derive(Debug, Clone)]
pub(super) struct LightGrid {
    pub width: usize,
    pub height: usize,
    pub cells: Vec<f32>,
}

/// The greatest standard deviation, in cells, that is summed up tap by tap.
const WIDEST: f64 = 3.0;

/// The reach of the taps, in standard deviations: the weights beyond it add up to 1e-6 of the whole.
const REACH: f64 = 5.0;

/// The variance that halving and then doubling a grid adds, in square cells: 3/4 each.
pub(super) const SOFTENED: f64 = 1.5;

/// The shares that a cell of the halved grid takes of the four nearest cells along an axis: the transpose of linear
/// interpolation, scaled to a sum of 1.
const SHARED: [f32; 4] = [0.125, 0.375, 0.375, 0.125];

/// The number of columns that are transposed as one piece of work: as many cells as processors load at once.
const TURNED: usize = 16;

impl LightGrid {
    /// Builds a grid without light.
    pub fn dark(width: usize, height: usize) -> Self {
        Self { width, height, cells: vec![0.0; width * height] }
    }

    /// Returns the cells of a row.
    pub fn row(&self, y: usize) -> &[f32] {
        &self.cells[y * self.width..(y + 1) * self.width]
    }

    /// Returns the grid with cells twice as wide.
    pub fn halved(&self) -> Self {
        self.halved_rows(0, self.height, 0..self.height.div_ceil(2))
    }

    /// Returns some rows of a grid with cells twice as wide, where this grid holds the rows from `first` on of one that is
    /// `height` cells high. [`finer_rows`] says which of them it must hold.
    ///
    /// Each fine cell's light is shared between the two nearest coarse cells of each axis, so that its centre of mass
    /// stays in place.
    pub fn halved_rows(&self, first: usize, height: usize, rows: Range<usize>) -> Self {
        let (across, down) = (self.width.div_ceil(2), height.div_ceil(2));
        let mut out = Self::dark(across, rows.len());
        out.cells.par_chunks_mut(across.max(1)).zip(rows).for_each_init(
            || vec![0.0; 2 * across + 2],
            |padded, (cells, y)| {
                let own = 2 * y;
                let four = [own.saturating_sub(1), own, own + 1, (own + 2).min(2 * down - 1)];
                for (y, share) in four.into_iter().zip(SHARED).filter(|&(y, _)| y < height) {
                    add_halved(self.row(y - first), padded, share, cells);
                }
            },
        );
        out
    }

    fn add_doubled(&self, sum: &mut Self) {
        let width = sum.width;
        sum.cells.par_chunks_mut(width.max(1)).enumerate().for_each(|(y, row)| {
            let [own, beside] = coarser_rows(y, self.height).map(|y| self.row(y));
            let doubled = doubled_row(own, beside, width);
            row.iter_mut().zip(doubled).for_each(|(cell, light)| *cell += light);
        });
    }

    /// Returns the grid with rows and columns exchanged.
    pub fn transposed(&self) -> Self {
        let mut out = Self::dark(self.height, self.width);
        let bands = out.cells.par_chunks_mut((TURNED * self.height).max(1)).enumerate();
        bands.for_each(|(band, rows)| {
            for y in 0..self.height {
                let columns = self.row(y).iter().skip(TURNED * band).take(TURNED);
                columns.enumerate().for_each(|(k, &light)| rows[k * self.height + y] = light);
            }
        });
        out
    }

    /// Returns whether the grid holds no light at all.
    pub fn is_dark(&self) -> bool {
        self.cells.par_iter().all(|&cell| cell == 0.0)
    }

    /// Adds `share` times another grid of the same size.
    pub fn add(&mut self, other: &Self, share: f32) {
        self.cells.par_iter_mut().zip(&other.cells).for_each(|(cell, &light)| *cell += light * share);
    }

    /// Returns the product of two grids of the same size, cell by cell.
    pub fn times(&self, other: &Self) -> Self {
        let cells = self.cells.par_iter().zip(&other.cells).map(|(a, b)| a * b).collect();
        Self { cells, ..*self }
    }

    /// Returns the weighted sum of Gaussian blurs, given as pairs of standard deviation in cells and share.
    pub fn glow(&self, scales: &[(f64, f32)]) -> Self {
        let mut sum = Self::dark(self.width, self.height);
        let speck = self.width.max(self.height) <= 2;
        let (near, far): (Vec<_>, Vec<_>) = scales.iter().partition(|(sigma, _)| speck || *sigma < WIDEST);
        for (sigma, share) in near {
            self.add_gaussian(sigma, share, &mut sum);
        }
        if !far.is_empty() {
            let coarser = |(sigma, share): (f64, f32)| ((sigma * sigma - SOFTENED).sqrt() / 2.0, share);
            let far: Vec<_> = far.into_iter().map(coarser).collect();
            self.halved().glow(&far).add_doubled(&mut sum);
        }
        sum
    }

    /// Returns the grid blurred by one Gaussian tap by tap, first across, then down.
    pub fn gaussian(&self, sigma: f64) -> Self {
        let mut sum = Self::dark(self.width, self.height);
        self.add_gaussian(sigma, 1.0, &mut sum);
        sum
    }

    fn add_gaussian(&self, sigma: f64, share: f32, sum: &mut Self) {
        let taps = taps(sigma.min(WIDEST));
        if taps.len() == 1 {
            return sum.add(self, share);
        }
        self.across(&taps).add_down(&taps, share, sum);
    }

    fn across(&self, taps: &[f32]) -> Self {
        let reach = taps.len() / 2;
        let width = self.width.max(1);
        let mut cells = vec![0.0; self.cells.len()];
        cells.par_chunks_mut(width).zip(self.cells.par_chunks(width)).for_each_init(
            || vec![0.0; width + 2 * reach],
            |padded, (row, source)| {
                padded[reach..reach + width].copy_from_slice(source);
                for (k, &tap) in taps.iter().enumerate() {
                    row.iter_mut().zip(&padded[k..]).for_each(|(cell, &light)| *cell += light * tap);
                }
            },
        );
        Self { width: self.width, height: self.height, cells }
    }

    fn add_down(&self, taps: &[f32], share: f32, sum: &mut Self) {
        let reach = taps.len() / 2;
        sum.cells.par_chunks_mut(self.width.max(1)).enumerate().for_each(|(y, row)| {
            for (k, &tap) in taps.iter().enumerate() {
                let Some(from) = (y + k).checked_sub(reach).filter(|&from| from < self.height) else {
                    continue;
                };
                let source = self.row(from);
                row.iter_mut().zip(source).for_each(|(cell, &light)| *cell += light * (tap * share));
            }
        });
    }
}

/// Returns the rows of a grid of `height` rows that [`LightGrid::halved_rows`] needs for `rows` of the halved grid.
pub(super) fn finer_rows(rows: &Range<usize>, height: usize) -> Range<usize> {
    (2 * rows.start).saturating_sub(1)..(2 * rows.end + 1).min(height)
}

/// Adds `share` times a row, with cells twice as wide, to the row `out`. `padded` has two cells more than twice as many as
/// `out`.
fn add_halved(row: &[f32], padded: &mut [f32], share: f32, out: &mut [f32]) {
    let (Some(&first), Some(&last)) = (row.first(), row.last()) else { return };
    let width = row.len();
    padded[0] = first;
    padded[1..=width].copy_from_slice(row);
    // The last cell of a pair keeps its share of the light; a cell without a partner has darkness beside it.
    padded[width + 1] = if width.is_multiple_of(2) { last } else { 0.0 };
    for (cell, four) in out.iter_mut().zip(padded.windows(4).step_by(2)) {
        let light: f32 = four.iter().zip(SHARED).map(|(light, share)| light * share).sum();
        *cell += light * share;
    }
}

/// Returns the two rows of a grid of `height` rows from which row `y` of the grid with cells half as wide is
/// interpolated: the one that it lies in, and the one beside it.
pub(super) fn coarser_rows(y: usize, height: usize) -> [usize; 2] {
    let own = y / 2;
    [own, if y.is_multiple_of(2) { own.saturating_sub(1) } else { (own + 1).min(height - 1) }]
}

/// Returns a row of `width` cells half as wide, interpolated linearly between the middles of the cells of two rows.
pub(super) fn doubled_row(own: &[f32], beside: &[f32], width: usize) -> Vec<f32> {
    let line: Vec<f32> = own.iter().zip(beside).map(|(own, beside)| own * 0.75 + beside * 0.25).collect();
    let last = line.len().saturating_sub(1);
    let mut out = vec![0.0; 2 * line.len()];
    for (x, pair) in out.as_chunks_mut().0.iter_mut().enumerate() {
        let [before, after] = [line[x.saturating_sub(1)], line[(x + 1).min(last)]];
        *pair = [before, after].map(|beside| line[x] * 0.75 + beside * 0.25);
    }
    out.truncate(width);
    out
}

/// Returns the weights of a Gaussian at whole cells: an odd number of them, which add up to 1.
fn taps(sigma: f64) -> Vec<f32> {
    let reach = (REACH * sigma).ceil() as i32;
    let weight = |k: i32| (-0.5 * (f64::from(k) / sigma.max(0.05)).powi(2)).exp();
    let sum: f64 = (-reach..=reach).map(weight).sum();
    (-reach..=reach).map(|k| (weight(k) / sum) as f32).collect()
}
