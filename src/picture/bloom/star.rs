//! A star's rays: from every cell light runs out along straight lines and fades exponentially.
//!
//! Along one ray each row is the row before it, faded, and its own light: one multiplication a cell however long
//! the ray is. A slanting ray moves on by parts of a cell; so that it stays sharp, the running row is kept where
//! it is and the picture is read, and written, beside it (W. J. Paeth's shear, "A Fast Algorithm for General
//! Raster Rotation", Graphics Interface 1986), which softens a ray once instead of at every step.

use super::grid::LightGrid;
use glam::Vec4;
use std::f64::consts::TAU;

/// How long a ray is in red, green and blue: diffraction goes with the wavelength, here 610, 550 and 465 nm.
const TINT: [f64; 3] = [1.11, 1.0, 0.845];

/// The least fading length, in cells.
const SHORTEST: f64 = 1e-3;

/// Light far below this is rounded away, lest it fade into numbers so small that processors are slow at them.
const FADED: Vec4 = Vec4::splat(1e-18);

/// One ray, in a grid whose rows it crosses.
struct Ray {
    /// Whether it runs toward the last row.
    down: bool,
    /// Cells to the right for each row.
    slope: f64,
    /// Cells of its own length for each row.
    step: f64,
}

/// The light of a grid in `rays` rays of this length in cells, the first of them upright.
pub(super) fn star(source: &LightGrid, rays: u32, length: f64) -> LightGrid {
    let angles = (0..rays).map(|k| TAU * f64::from(k) / f64::from(rays));
    let (steep, flat): (Vec<_>, Vec<_>) =
        angles.map(|a| (a.sin(), -a.cos())).partition(|(x, y)| y.abs() >= x.abs());
    let flat: Vec<_> = flat.into_iter().map(|(x, y)| (y, x)).collect();
    let share = 1.0 / rays as f32;
    // Two lists in a fixed order each: the same bytes on any number of threads.
    let (mut upright, lying) = rayon::join(
        || rows_of(source, &steep, length, share),
        || (!flat.is_empty()).then(|| rows_of(&source.transposed(), &flat, length, share).transposed()),
    );
    if let Some(lying) = lying {
        upright.add(&lying, 1.0);
    }
    upright
}

/// The rays of these directions, each with its share of the light.
fn rows_of(source: &LightGrid, directions: &[(f64, f64)], length: f64, share: f32) -> LightGrid {
    let mut sum = LightGrid::dark(source.width, source.height);
    for &(x, y) in directions {
        let ray = Ray { down: y > 0.0, slope: x / y.abs(), step: 1.0 / y.abs() };
        ray.add(source, length, share, &mut sum);
    }
    sum
}

impl Ray {
    fn add(&self, source: &LightGrid, length: f64, share: f32, sum: &mut LightGrid) {
        let width = source.width;
        let kept = TINT.map(|tint| (-self.step / (length * tint).max(SHORTEST)).exp() as f32);
        let kept = Vec4::new(kept[0], kept[1], kept[2], 0.0);
        let given = (Vec4::ONE - kept) * share;
        let reach = (self.slope.abs() * source.height as f64) as usize + 2;
        let mut running = vec![Vec4::ZERO; width + 2 * reach];
        let mut padded = vec![Vec4::ZERO; width + 2];
        for step in 0..source.height {
            let y = if self.down { step } else { source.height - 1 - step };
            padded[1..=width].copy_from_slice(&source.cells[y * width..(y + 1) * width]);
            let moved = self.slope * step as f64;
            let part = (moved - moved.floor()) as f32;
            // The running cell that lies by `part` to the left of the row's column -1.
            let first = (reach as f64 - moved.floor()) as usize - 1;
            let window = &mut running[first..=first + width];
            for (cell, pair) in window.iter_mut().zip(padded.windows(2)) {
                let lit = *cell * kept + pair[0] * (1.0 - part) + pair[1] * part;
                *cell = (lit + FADED) - FADED;
            }
            let row = &mut sum.cells[y * width..(y + 1) * width];
            for (cell, pair) in row.iter_mut().zip(window.windows(2)) {
                *cell += (pair[1] * (1.0 - part) + pair[0] * part) * given;
            }
        }
    }
}
