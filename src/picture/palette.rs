//! From light in a scope's bands to the colour of a pixel.

use super::Rows;
use crate::optics::{LinearRgb, SrgbEncoder};
use crate::scene::Scope;

/// Mixes bands in linear light and encodes the sum as sRGB, once.
pub struct Palette {
    colours: Vec<LinearRgb>,
    encoder: SrgbEncoder,
}

impl Palette {
    /// The scope's own colours.
    pub fn of(scope: &Scope) -> Self {
        Self { colours: scope.colours(), encoder: SrgbEncoder::new() }
    }

    /// The encoded pixels of row `y`, appended to `out` as red, green, blue. The bands are the rows' channels from
    /// `first` on and the stone's cover the last; where it does not cover a pixel, the backing is seen: the colour
    /// of the band below.
    pub fn encode(&self, rows: &Rows, first: usize, y: u32, out: &mut Vec<u8>) {
        let bands: Vec<&[f64]> = (0..self.colours.len()).map(|c| rows.row(y, first + c)).collect();
        let cover = rows.row(y, rows.channels - 1);
        for (x, covered) in cover.iter().enumerate() {
            let backing = self.colours[0] * (1.0 - covered);
            let sum =
                bands.iter().zip(&self.colours).fold(backing, |sum, (band, colour)| sum + *colour * band[x]);
            out.extend(self.encoder.encode_rgb(sum));
        }
    }
}
