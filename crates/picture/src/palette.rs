//! Palettes turn the light in a scope's bands into the colours of pixels.

use super::Rows;
use brillianteer_optics::{LinearRgb, SrgbEncoder};
use brillianteer_scene::Scope;

/// The colours of a scope's bands. Bands are mixed in linear light, and only the sum is encoded as sRGB.
pub struct Palette {
    colours: Vec<LinearRgb>,
    encoder: SrgbEncoder,
}

impl Palette {
    /// Builds the palette of the scope's own colours.
    pub fn of(scope: &Scope) -> Self {
        Self { colours: scope.colours(), encoder: SrgbEncoder::new() }
    }

    /// Appends the encoded pixels of row `y` to `out`, as red, green and blue.
    ///
    /// The bands are the rows' channels from `first` on, and the stone's cover is the last channel. Where the stone does
    /// not cover a pixel, the backing shows, in the colour of the lowest band.
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
