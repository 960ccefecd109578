//! Light on a grid of cells, and its blurring by Gaussians: narrow ones are summed up tap by tap, wide ones on halved
//! grids (P. J. Burt, "Fast Filter Transforms for Image Processing", CGIP 16, 1981).
//!
//! All weights are positive, so that no sum cancels however bright a point is, and they add up to 1. There is no light
//! beyond the border.

use glam::Vec4;
use rayon::prelude::*;

/// A grid with the mean light of each cell; the fourth component is unused.
#[derive(Debug, Clone)]
pub(super) struct LightGrid {
    pub width: usize,
    pub height: usize,
    pub cells: Vec<Vec4>,
}

/// The greatest standard deviation, in cells, that is summed up tap by tap.
const WIDEST: f64 = 3.0;

/// The reach of the taps, in standard deviations: what lies beyond is 1e-6 of the whole.
const REACH: f64 = 5.0;

/// The variance that halving and then doubling a grid adds, in square cells: 3/4 each.
const SOFTENED: f64 = 1.5;

/// The shares that a cell of the halved grid takes of the four nearest cells along an axis: the transpose of linear
/// interpolation, scaled to a sum of 1.
const SHARED: [f32; 4] = [0.125, 0.375, 0.375, 0.125];

impl LightGrid {
    /// Builds a grid from a function of column and row.
    pub fn filled(width: usize, height: usize, at: impl Fn(usize, usize) -> Vec4 + Sync) -> Self {
        let mut cells = vec![Vec4::ZERO; width * height];
        let rows = cells.par_chunks_mut(width.max(1)).enumerate();
        rows.for_each(|(y, row)| row.iter_mut().enumerate().for_each(|(x, cell)| *cell = at(x, y)));
        Self { width, height, cells }
    }

    /// Builds a grid without light.
    pub fn dark(width: usize, height: usize) -> Self {
        Self { width, height, cells: vec![Vec4::ZERO; width * height] }
    }

    /// Builds a grid of half the given size, where `at` gives the light of the finer one. Each fine cell's light is
    /// shared between the two nearest coarse cells of each axis, so that its centre of mass stays in place.
    pub fn halved_from(width: usize, height: usize, at: impl Fn(usize, usize) -> Vec4 + Sync) -> Self {
        let part = |x, y| if x < width && y < height { at(x, y) } else { Vec4::ZERO };
        let four = |cell: usize, count: usize| {
            let own = 2 * cell;
            [own.saturating_sub(1), own, own + 1, (own + 2).min(2 * count - 1)]
        };
        let (across, down) = (width.div_ceil(2), height.div_ceil(2));
        Self::filled(across, down, |x, y| {
            let columns = four(x, across);
            let line =
                |y: usize| columns.iter().zip(SHARED).map(|(&x, share)| part(x, y) * share).sum::<Vec4>();
            four(y, down).into_iter().zip(SHARED).map(|(y, share)| line(y) * share).sum()
        })
    }

    /// Returns the grid with cells twice as wide.
    pub fn halved(&self) -> Self {
        Self::halved_from(self.width, self.height, |x, y| self.cells[y * self.width + x])
    }

    /// Returns the grid with cells half as wide, interpolated linearly between the cells' middles.
    pub fn doubled(&self, width: usize, height: usize) -> Self {
        let mut out = Self::dark(width, height);
        self.add_doubled(&mut out);
        out
    }

    fn add_doubled(&self, sum: &mut Self) {
        sum.cells.par_chunks_mut(sum.width.max(1)).enumerate().for_each(|(y, row)| {
            let doubled = self.doubled_row(y);
            row.iter_mut().enumerate().for_each(|(x, cell)| *cell += doubled(x));
        });
    }

    /// Returns the cells of row `y` of the doubled grid, as a function of the column.
    pub fn doubled_row(&self, y: usize) -> impl Fn(usize) -> Vec4 + '_ {
        let near = |fine: usize, count: usize| {
            let own = (fine / 2).min(count - 1);
            let other = if fine.is_multiple_of(2) { own.saturating_sub(1) } else { (own + 1).min(count - 1) };
            (own, other)
        };
        let (y, above) = near(y, self.height);
        let own = &self.cells[y * self.width..(y + 1) * self.width];
        let above = &self.cells[above * self.width..(above + 1) * self.width];
        let line = |x: usize| own[x] * 0.75 + above[x] * 0.25;
        move |x| {
            let (x, beside) = near(x, self.width);
            line(x) * 0.75 + line(beside) * 0.25
        }
    }

    /// Returns the grid with rows and columns exchanged.
    pub fn transposed(&self) -> Self {
        Self::filled(self.height, self.width, |x, y| self.cells[x * self.width + y])
    }

    /// Returns whether the grid holds no light at all.
    pub fn is_dark(&self) -> bool {
        self.cells.par_iter().all(|&cell| cell == Vec4::ZERO)
    }

    /// Adds `share` times another grid of the same size.
    pub fn add(&mut self, other: &Self, share: f32) {
        self.cells.par_iter_mut().zip(&other.cells).for_each(|(cell, &light)| *cell += light * share);
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
        let mut cells = vec![Vec4::ZERO; self.cells.len()];
        cells.par_chunks_mut(width).zip(self.cells.par_chunks(width)).for_each_init(
            || vec![Vec4::ZERO; width + 2 * reach],
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
                let source = &self.cells[from * self.width..(from + 1) * self.width];
                row.iter_mut().zip(source).for_each(|(cell, &light)| *cell += light * (tap * share));
            }
        });
    }
}

/// Returns the weights of a Gaussian at whole cells: an odd number of them, which add up to 1.
fn taps(sigma: f64) -> Vec<f32> {
    let reach = (REACH * sigma).ceil() as i32;
    let weight = |k: i32| (-0.5 * (f64::from(k) / sigma.max(0.05)).powi(2)).exp();
    let sum: f64 = (-reach..=reach).map(weight).sum();
    (-reach..=reach).map(|k| (weight(k) / sum) as f32).collect()
}
