//! A picture in linear light, before it is developed.

/// The share of each linear sRGB primary in luminance (ITU-R BT.709-6, §3: the second row of its RGB to XYZ).
pub const LUMINANCE: [f32; 3] = [0.2126, 0.7152, 0.0722];

/// Linear sRGB light, premultiplied by cover, and cover; row by row from the top, each from the left.
#[derive(Debug, Clone, PartialEq)]
pub struct Linear {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Red, green and blue, white at 1 and open above; below 0 where a colour is out of sRGB's reach; and cover,
    /// 0 beside the stones, 1 on them. `width * height` of them; what is lacking counts as dark and uncovered.
    pub pixels: Vec<[f32; 4]>,
}

impl Linear {
    /// A picture without light or cover.
    pub fn new(width: u32, height: u32) -> Self {
        Self { width, height, pixels: vec![[0.0; 4]; width as usize * height as usize] }
    }

    /// A picture of as many pixels as its sides ask for: cut, or filled up with nothing.
    pub(super) fn whole(mut self) -> Self {
        self.pixels.resize(self.width as usize * self.height as usize, [0.0; 4]);
        self
    }
}

/// The luminance of linear sRGB light; that of white is 1.
pub fn luminance(light: [f32; 3]) -> f32 {
    light.iter().zip(LUMINANCE).map(|(part, share)| part * share).sum()
}
