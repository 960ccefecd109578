//! Glare of a picture that is read and written some rows at a time: the bright light is gathered on a grid that fits into
//! memory, spread there, and added to each row.

use super::grid::{LightGrid, coarser_rows, doubled_row, finer_rows};
use crate::linear::{LightRows, luminance};
use rayon::prelude::*;
use std::borrow::Cow;
use std::ops::Range;

/// The number of pixels whose light is gathered at once.
const AT_ONCE: usize = 1 << 20;

/// The part of the threshold by which spreading begins below it.
const KNEE: f32 = 0.5;

/// The settings that decide the light of a pixel to be spread.
#[derive(Clone, Copy)]
pub(super) struct BrightPass {
    /// The part of the light above the threshold that is spread, 0 to 1.
    pub strength: f32,
    /// The luminance above which light is spread.
    pub threshold: f32,
}

/// The glare of a picture, ready to be added to its rows.
pub(crate) struct GatheredGlare {
    pub(super) bright: BrightPass,
    /// The number of pixels across and down.
    pub(super) size: [u32; 2],
    /// The number of halvings from the picture's grid to the one on which light was spread.
    pub(super) halvings: u32,
    /// The light that was spread, in each colour.
    pub(super) spread: [LightGrid; 3],
}

impl BrightPass {
    /// Returns the light of a pixel that is spread: the part above the threshold, with a soft knee, which is a parabola that
    /// joins both straight lines.
    fn of(&self, &[r, g, b, _]: &[f32; 4]) -> [f32; 3] {
        let Self { strength, threshold } = *self;
        let y = luminance([r, g, b]);
        let knee = threshold * KNEE;
        let excess = if y >= threshold + knee {
            y - threshold
        } else if y > threshold - knee {
            (y - threshold + knee).powi(2) / (4.0 * knee)
        } else {
            return [0.0; 3];
        };
        // The comparison also rejects the NaN that a luminance of zero, infinity or NaN gives.
        let part = excess / y;
        if part > 0.0 { [r, g, b].map(|c| c * part * strength) } else { [0.0; 3] }
    }

    /// Returns the light of a picture that is spread, in each colour, on its grid halved this often.
    pub fn source<L: LightRows>(
        &self,
        light: &mut L,
        exposed: impl Fn(&[f32; 4]) -> [f32; 4] + Sync,
        halvings: u32,
    ) -> Result<[LightGrid; 3], L::Error> {
        let size = light.size();
        let [width, height] = size.map(|side| halved(side, halvings) as usize);
        let mut out = [(); 3].map(|()| LightGrid::dark(width, height));
        let step = ((AT_ONCE / size[0] as usize) >> halvings).max(1);
        for first in (0..height).step_by(step) {
            let rows = first..(first + step).min(height);
            let found = self.rows(light, &exposed, (halvings, rows.clone()))?;
            for (colour, found) in out.iter_mut().zip(found) {
                colour.cells[rows.start * width..rows.end * width].copy_from_slice(&found.cells);
            }
        }
        Ok(out)
    }

    /// Returns some rows of the light that is spread, on the picture's grid halved this often.
    fn rows<L: LightRows>(
        &self,
        light: &mut L,
        exposed: &(impl Fn(&[f32; 4]) -> [f32; 4] + Sync),
        (halvings, rows): (u32, Range<usize>),
    ) -> Result<[LightGrid; 3], L::Error> {
        let [width, height] = light.size();
        let Some(finer) = halvings.checked_sub(1) else {
            let pixels = light.rows(rows.start as u32..rows.end as u32)?;
            let spread = |pixel: &[f32; 4]| self.of(&exposed(pixel));
            let mut out = [(); 3].map(|()| LightGrid::dark(width as usize, rows.len()));
            let [red, green, blue] = out.each_mut().map(|colour| colour.cells.par_iter_mut());
            red.zip(green).zip(blue).zip(pixels.par_iter()).for_each(|(((red, green), blue), pixel)| {
                [*red, *green, *blue] = spread(pixel);
            });
            return Ok(out);
        };
        let height = halved(height, finer) as usize;
        let needed = finer_rows(&rows, height);
        let first = needed.start;
        let fine = self.rows(light, exposed, (finer, needed))?;
        Ok(fine.map(|colour| colour.halved_rows(first, height, rows.clone())))
    }
}

impl GatheredGlare {
    /// Adds the glare to row `y` of the picture, and takes away the light of its pixels that is spread. Cover stays as it is.
    pub fn add(&self, y: usize, row: &mut [[f32; 4]]) {
        let light = self.spread.each_ref().map(|colour| self.row(colour, 0, y));
        for (x, pixel) in row.iter_mut().enumerate() {
            let own = self.bright.of(pixel);
            (0..3).for_each(|c| pixel[c] = pixel[c] - own[c] + light[c][x]);
        }
    }

    /// Returns a row of the light that was spread in a colour, on the picture's grid halved `times` times.
    fn row<'a>(&self, colour: &'a LightGrid, times: u32, y: usize) -> Cow<'a, [f32]> {
        if times == self.halvings {
            return Cow::Borrowed(colour.row(y));
        }
        let [width, height] =
            [(0, times), (1, times + 1)].map(|(k, times)| halved(self.size[k], times) as usize);
        let [own, beside] = coarser_rows(y, height).map(|y| self.row(colour, times + 1, y));
        Cow::Owned(doubled_row(&own, &beside, width))
    }
}

/// Returns the length of a side after `times` halvings, each rounded up.
pub(super) fn halved(side: u32, times: u32) -> u32 {
    (0..times).fold(side, |side, _| side.div_ceil(2))
}
