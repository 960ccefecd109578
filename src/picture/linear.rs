//! A picture in linear light, before it is developed.

/// The share of each linear sRGB primary in luminance (ITU-R BT.709-6, §3: the second row of its matrix from RGB to
/// XYZ).
pub const LUMINANCE: [f32; 3] = [0.2126, 0.7152, 0.0722];

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

/// Returns the luminance of linear sRGB light; that of white is 1.
pub fn luminance(light: [f32; 3]) -> f32 {
    light.iter().zip(LUMINANCE).map(|(part, share)| part * share).sum()
}
