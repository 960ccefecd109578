//! A picture as a screen shows it.

use brillianteer_picture::{Develop, Linear, develop};
use brillianteer_scene::Tone;

/// A picture as a screen shows it, in sRGB codes; the cover is not multiplied into the colours.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Pixels {
    /// Width and height.
    pub size: [usize; 2],
    /// Red, green, blue and cover of each pixel, row by row.
    pub rgba: Vec<u8>,
}

impl Pixels {
    /// Returns an opaque picture of red, green and blue.
    pub fn opaque(size: [usize; 2], rgb: &[u8]) -> Self {
        let rgba = rgb.as_chunks::<3>().0.iter().flat_map(|[r, g, b]| [*r, *g, *b, u8::MAX]).collect();
        Self { size, rgba }
    }

    /// Returns light that is encoded as it is, without exposure, bloom or tone mapping.
    pub fn encoded(light: &Linear) -> Self {
        let manner = Develop { bloom: None, tone: Tone::Linear, ..Develop::default() };
        let size = [light.width as usize, light.height as usize];
        Self { size, rgba: develop(light, &manner) }
    }
}
