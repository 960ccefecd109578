//! A picture of all that surrounds a stone, or a photograph to be seen behind it.

/// Linear sRGB light by direction, equirectangular: the first row looks to the zenith, the last to the nadir, and
/// columns go round evenly, to the right as one turns to the right inside. A whole sphere is twice as wide as high.
#[derive(Debug, Clone, PartialEq)]
pub struct Panorama {
    /// Pixels in a row, at least 1.
    pub width: u32,
    /// Rows, at least 1.
    pub height: u32,
    /// Red, green and blue, finite and not below 0, row by row from the top; `width * height` of them.
    pub pixels: Vec<[f32; 3]>,
}

impl Panorama {
    /// Whether it is twice as wide as high, to one pixel, as a whole sphere is.
    pub fn is_whole_sphere(&self) -> bool {
        self.width.abs_diff(2 * self.height) <= 1
    }
}
