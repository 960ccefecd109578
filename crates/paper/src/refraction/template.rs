//! Writes the template: a gradient whose colours state their place on it. Another renderer shows it through its own
//! glass, and its picture is a map in the template's coding.

use super::{MOST_MAP_PIXELS, tiles, write_bytes};
use crate::png_bytes::png;
use ::png::{BitDepth, ColorType};
use brillianteer_files::WriteError;
use glam::DVec2;
use std::io;
use std::path::Path;

/// The gradient from which another renderer makes a map.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Template {
    /// 8 bits, 16 by 16 tiles: for pictures of 8 bits, without filtering, and through glass that takes no light away.
    Tiles,
    /// 16 bits: red and green are u and v, blue is white. A loss of light that is equal in all three leaves the place
    /// unchanged, and the blue is the weight.
    Gradient,
}

impl Template {
    /// Returns the template's name in texts.
    pub fn name(self) -> &'static str {
        match self {
            Self::Tiles => "tiled",
            Self::Gradient => "gradient",
        }
    }
}

/// Writes a square template of `side` pixels each way as PNG. Each pixel has the colour of its middle.
///
/// # Errors
/// Fails where the file system refuses, or `side` is 0 or more than [`MOST_MAP_PIXELS`].
pub fn write_template(path: &Path, template: Template, side: u32) -> Result<(), WriteError> {
    if side == 0 || side > MOST_MAP_PIXELS {
        let message = format!("a template has 1 to {MOST_MAP_PIXELS} pixels each way");
        return Err(WriteError::io(path, io::Error::other(message)));
    }
    let middle = |k: u32| (f64::from(k) + 0.5) / f64::from(side);
    let places = (0..side).flat_map(|y| (0..side).map(move |x| DVec2::new(middle(x), middle(y))));
    let code = |part: f64| ((part * 65_535.0).round() as u16).to_be_bytes();
    let (depth, data): (_, Vec<u8>) = match template {
        Template::Tiles => (BitDepth::Eight, places.flat_map(tiles::code).collect()),
        Template::Gradient => {
            (BitDepth::Sixteen, places.flat_map(|at| [code(at.x), code(at.y), code(1.0)]).flatten().collect())
        }
    };
    let description = format!(
        "Template of a refraction map, coding {}: numbers, not colours. Show it unlit and unfiltered behind the glass",
        template.name()
    );
    let bytes = png([side; 2], (ColorType::Rgb, depth), &data, &[("Description", &description)]);
    write_bytes(path, &bytes.map_err(|e| WriteError::io(path, e))?)
}
