//! The streaks of a star: from every cell, light runs out along straight lines and fades exponentially.
//!
//! Along one streak, the light of each row is that of the row before, faded, plus the row's own light. That takes one
//! multiplication per cell, however long the streak is.
//!
//! A slanting streak moves sideways by parts of a cell per row. To keep it sharp, the running row stays in place, and
//! the picture is read and written with an offset (W. J. Paeth's shear, "A Fast Algorithm for General Raster Rotation",
//! Graphics Interface 1986). This softens a streak once instead of at every step.

use super::grid::LightGrid;
use std::f64::consts::TAU;

/// The relative length of a streak in red, green and blue: diffraction is proportional to the wavelength, here 610, 550
/// and 465 nm.
pub(super) const TINT: [f64; 3] = [1.11, 1.0, 0.845];

/// The least length, in cells, in which a streak fades to 1/e.
const SHORTEST: f64 = 1e-3;

/// Light far below this value is rounded away, so that it does not fade into subnormal numbers, which processors handle
/// slowly.
const FADED: f32 = 1e-18;

/// A streak, in a grid whose rows it crosses.
struct Streak {
    /// True where the streak runs toward the last row.
    down: bool,
    /// Cells that the streak moves to the right for each row.
    slope: f64,
    /// Length of the streak, in cells, for each row.
    step: f64,
}

/// Returns the light of a grid spread into `rays` streaks of this length in cells; the first points upward.
pub(super) fn star(source: LightGrid, rays: u32, length: f64) -> LightGrid {
    let angles = (0..rays).map(|k| TAU * f64::from(k) / f64::from(rays));
    let (steep, flat): (Vec<_>, Vec<_>) =
        angles.map(|a| (a.sin(), -a.cos())).partition(|(x, y)| y.abs() >= x.abs());
    let flat: Vec<_> = flat.into_iter().map(|(x, y)| (y, x)).collect();
    let share = 1.0 / rays as f32;
    // The lists are summed in a fixed order, so the bytes are the same on any number of threads.
    let (mut upright, lying) = rayon::join(
        || rows_of(&source, &steep, length, share),
        || (!flat.is_empty()).then(|| rows_of(&source.transposed(), &flat, length, share)),
    );
    drop(source);
    if let Some(lying) = lying {
        upright.add(&lying.transposed(), 1.0);
    }
    upright
}

/// Returns the streaks along these directions, each with `share` of the light.
fn rows_of(source: &LightGrid, directions: &[(f64, f64)], length: f64, share: f32) -> LightGrid {
    let mut sum = LightGrid::dark(source.width, source.height);
    for &(x, y) in directions {
        let streak = Streak { down: y > 0.0, slope: x / y.abs(), step: 1.0 / y.abs() };
        streak.add(source, length, share, &mut sum);
    }
    sum
}

impl Streak {
    fn add(&self, source: &LightGrid, length: f64, share: f32, sum: &mut LightGrid) {
        let width = source.width;
        let kept = (-self.step / length.max(SHORTEST)).exp() as f32;
        let given = (1.0 - kept) * share;
        let reach = (self.slope.abs() * source.height as f64) as usize + 2;
        let mut running = vec![0.0; width + 2 * reach];
        let mut padded = vec![0.0; width + 2];
        for step in 0..source.height {
            let y = if self.down { step } else { source.height - 1 - step };
            padded[1..=width].copy_from_slice(source.row(y));
            let moved = self.slope * step as f64;
            let part = (moved - moved.floor()) as f32;
            // The running cell that lies `part` of a cell to the left of the row's column -1.
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
