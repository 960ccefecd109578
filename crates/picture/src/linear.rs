//! A picture in linear light, before it is developed.

use brillianteer_optics::LUMINANCE;
use std::borrow::Cow;
use std::convert::Infallible;
use std::ops::Range;

/// A picture in linear sRGB light, premultiplied by cover, and cover. Pixels run row by row from the top, each row from
/// the left.
#[derive(Debug, Clone, PartialEq)]
pub struct Linear {
    /// The number of pixels in a row.
    pub width: u32,
    /// The number of rows.
    pub height: u32,
    /// Red, green, blue and cover of each pixel, `width * height` of them; missing pixels count as dark and uncovered.
    ///
    /// White is 1, and brighter light is above it. A colour that sRGB cannot show has channels below 0. Cover is 0
    /// beside the stones and 1 on them.
    pub pixels: Vec<[f32; 4]>,
}

impl Linear {
    /// Returns a picture without light or cover.
    pub fn new(width: u32, height: u32) -> Self {
        Self { width, height, pixels: vec![[0.0; 4]; width as usize * height as usize] }
    }

    /// Returns the picture with exactly as many pixels as its sides need: cut, or filled up with dark, uncovered ones.
    pub(super) fn whole(mut self) -> Self {
        self.pixels.resize(self.width as usize * self.height as usize, [0.0; 4]);
        self
    }
}

/// The linear light of a picture as [`Linear`] holds it, read some rows at a time, so that it need not be in memory.
pub trait LightRows {
    /// The reason why rows cannot be read.
    type Error;

    /// Returns the number of pixels across and down.
    fn size(&self) -> [u32; 2];

    /// Returns the pixels of some rows, row by row.
    ///
    /// # Errors
    /// Fails where the light cannot be read.
    fn rows(&mut self, rows: Range<u32>) -> Result<Cow<'_, [[f32; 4]]>, Self::Error>;
}

impl LightRows for &Linear {
    type Error = Infallible;

    fn size(&self) -> [u32; 2] {
        [self.width, self.height]
    }

    fn rows(&mut self, rows: Range<u32>) -> Result<Cow<'_, [[f32; 4]]>, Infallible> {
        let [start, end] = [rows.start, rows.end].map(|y| y as usize * self.width as usize);
        let known = &self.pixels[start.min(self.pixels.len())..end.min(self.pixels.len())];
        if known.len() == end - start {
            return Ok(Cow::Borrowed(known));
        }
        let mut whole = known.to_vec();
        whole.resize(end - start, [0.0; 4]);
        Ok(Cow::Owned(whole))
    }
}

/// Returns the luminance of linear sRGB light; that of white is 1.
pub fn luminance(light: [f32; 3]) -> f32 {
    light.iter().zip(LUMINANCE).map(|(part, share)| part * share).sum()
}
