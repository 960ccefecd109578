//! Writes refraction maps: tiled 8-bit PNG, 16-bit PNG, OpenEXR, the diffuse layer beside them, and a page that shows them.
//! Writes the template from which another renderer makes a map, and reads such maps and the program's own.
//!
//! No map is antialiased, filtered or coded as colour: a look-up takes the nearest pixel, and no program may change
//! the numbers of a map as if they were light. The diffuse layer is colour: sRGB, not premultiplied, composited in
//! linear light.

mod codes;
mod foreign;
mod mending;
mod packing;
mod page;
mod read;
mod template;
#[cfg(test)]
mod tests;
mod tiles;

pub use page::{MOST_MEGABYTES, Page, takes, write_page};
pub use read::{LoadedMap, read};
pub use template::{Template, write_template};
pub use tiles::code_of;

use super::exr::ExrImage;
use super::png_bytes::png;
use ::png::{BitDepth, ColorType, EncodingError};
use brillianteer_files::{WriteError, write};
use brillianteer_optics::SrgbEncoder;
use brillianteer_picture::{Linear, MapBand, RefractionMap, SourcePlace};
use glam::DMat3;
use serde::{Deserialize, Serialize};
use std::io;
use std::path::{Path, PathBuf};

/// The largest side of a map, in pixels.
pub const MOST_MAP_PIXELS: u32 = 4096;

/// The most bands of one map, each counted as often as pixels have places.
pub const MOST_MAP_BANDS: u32 = 16;

/// The most places that a pixel has in one band.
pub const MOST_PLACES: u32 = 8;

/// The keyword of the text, or attribute, in which a map describes its bands.
const ABOUT: &str = "Refraction";

/// The coding of places in files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Coding {
    /// One PNG for each band: 8 bits, 16 by 16 tiles. The single band of a map for all light has no weights of its
    /// own: they are what the alpha of the diffuse layer leaves. Of several bands, each has its weights, in grey,
    /// below its places, so that the picture is twice as high.
    Tiles,
    /// One PNG for each band, whose red, green and blue of 16 bits are u, v and weight.
    Sixteen,
    /// One OpenEXR for all bands, with u, v and weight of each in 32 bits.
    Float,
}

/// The text in a file about its band: the wavelength in nm, and the columns of the response. A file of one band also
/// states its place among the files of its map; older files do not.
#[derive(Serialize, Deserialize)]
struct About {
    nm: f64,
    response: [[f64; 3]; 3],
    /// The number of files of the map, one for each band.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    files: Option<usize>,
    /// True where the weights lie below the places.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    weights_below: Option<bool>,
}

impl About {
    fn of(band: &MapBand) -> Self {
        Self { nm: band.nm, response: band.response.to_cols_array_2d(), files: None, weights_below: None }
    }

    /// Makes the band of these places.
    fn band(&self, places: Vec<SourcePlace>) -> MapBand {
        MapBand { nm: self.nm, response: DMat3::from_cols_array_2d(&self.response), places }
    }
}

/// Returns the paths of a map's files in a coding, in the order of its bands.
pub fn paths(folder: &Path, stem: &str, bands: usize, coding: Coding) -> Vec<PathBuf> {
    let kind = match coding {
        Coding::Tiles => "",
        Coding::Sixteen => "-16bit",
        Coding::Float => return vec![folder.join(format!("{stem}-refraction.exr"))],
    };
    let name = |band: usize| match bands {
        1 => format!("{stem}-refraction{kind}.png"),
        _ => format!("{stem}-refraction{kind}-{band:02}.png"),
    };
    (1..=bands).map(|band| folder.join(name(band))).collect()
}

/// Returns the path of a map's diffuse layer.
pub fn diffuse_path(folder: &Path, stem: &str) -> PathBuf {
    folder.join(format!("{stem}-refraction-diffuse.png"))
}

/// Writes the places of a map to its [`paths`]. `description` goes into the files as text.
///
/// # Errors
/// Fails where the file system refuses, or the map is empty or lacks pixels.
pub fn write_places(
    paths: &[PathBuf],
    map: &RefractionMap,
    coding: Coding,
    description: &str,
) -> Result<(), WriteError> {
    if coding == Coding::Float {
        return paths.iter().try_for_each(|path| write_float(path, map, description));
    }
    for (path, band) in paths.iter().zip(0..map.bands.len()) {
        let bytes = places_png(map, band, coding, description);
        write_bytes(path, &bytes.map_err(|e| WriteError::io(path, e))?)?;
    }
    Ok(())
}

/// Writes the diffuse layer of a map.
///
/// # Errors
/// Fails where the file system refuses, or the layer is empty or lacks pixels.
pub fn write_diffuse(path: &Path, map: &RefractionMap, description: &str) -> Result<(), WriteError> {
    write_bytes(path, &diffuse_png(&map.diffuse, description).map_err(|e| WriteError::io(path, e))?)
}

/// Writes bytes to a file, whole or not at all.
fn write_bytes(path: &Path, bytes: &[u8]) -> Result<(), WriteError> {
    write(path, |file| io::Write::write_all(file, bytes).map_err(|e| WriteError::io(path, e)))
}

/// Encodes the places of one band of a map as PNG.
fn places_png(
    map: &RefractionMap,
    band: usize,
    coding: Coding,
    description: &str,
) -> Result<Vec<u8>, EncodingError> {
    let Some(band) = map.bands.get(band) else {
        return Err(io::Error::other("there is no such band").into());
    };
    let [width, mut height] = map.size;
    let code = |part: f32, most: f64| (f64::from(part.clamp(0.0, 1.0)) * most).round();
    let (depth, data): (_, Vec<u8>) = match coding {
        Coding::Tiles => {
            let mut data: Vec<u8> = band.places.iter().flat_map(tiles::code_of).collect();
            if map.bands.len() > 1 {
                height *= 2;
                data.extend(band.places.iter().flat_map(|place| [code(place.weight, 255.0) as u8; 3]));
            }
            (BitDepth::Eight, data)
        }
        Coding::Sixteen | Coding::Float => {
            let parts = band.places.iter().flat_map(|p| [p.u, p.v, p.weight]);
            (BitDepth::Sixteen, parts.flat_map(|part| (code(part, 65_535.0) as u16).to_be_bytes()).collect())
        }
    };
    let has_weights = coding == Coding::Tiles && map.bands.len() > 1;
    let about = About { files: Some(map.bands.len()), weights_below: Some(has_weights), ..About::of(band) };
    let about = serde_json::to_string(&about).map_err(io::Error::from)?;
    let texts = [("Description", description), (ABOUT, &about)];
    png([width, height], (ColorType::Rgb, depth), &data, &texts)
}

/// Encodes the diffuse layer as PNG. Light that is brighter than its cover allows gets more cover, and hides more.
fn diffuse_png(diffuse: &Linear, description: &str) -> Result<Vec<u8>, EncodingError> {
    let encoder = SrgbEncoder::new();
    let code = |&[r, g, b, cover]: &[f32; 4]| {
        let light = [r, g, b].map(|c| if c.is_finite() { c.clamp(0.0, 1.0) } else { 0.0 });
        let most = light.into_iter().fold(cover.clamp(0.0, 1.0), f32::max);
        // The alpha is rounded up where the light would not fit otherwise.
        let alpha = if most > cover { (most * 255.0).ceil() } else { (most * 255.0).round() };
        let straight = |c: f32| encoder.encode(f64::from(c * 255.0 / alpha.max(1.0)).min(1.0));
        let [r, g, b] = light.map(straight);
        [r, g, b, alpha as u8]
    };
    let data: Vec<u8> = diffuse.pixels.iter().flat_map(code).collect();
    let size = [diffuse.width, diffuse.height];
    png(size, (ColorType::Rgba, BitDepth::Eight), &data, &[("Description", description)])
}

fn write_float(path: &Path, map: &RefractionMap, description: &str) -> Result<(), WriteError> {
    let size = (map.size[0] as usize, map.size[1] as usize);
    let is_whole = |band: &MapBand| band.places.len() == size.0 * size.1;
    if size.0 * size.1 == 0 || map.bands.is_empty() || !map.bands.iter().all(is_whole) {
        return Err(WriteError::io(path, io::Error::other("the map lacks pixels")));
    }
    const PARTS: [&str; 3] = ["u", "v", "weight"];
    let bands = map.bands.len();
    let channels: Vec<String> =
        (0..bands).flat_map(|band| PARTS.map(|part| channel(bands, band, part))).collect();
    let about: Vec<About> = map.bands.iter().map(About::of).collect();
    let about = serde_json::to_string(&about).map_err(|e| WriteError::io(path, e))?;
    let more = Some((ABOUT, about.as_str()));
    ExrImage { size, channels: &channels, description, more, chromaticities: None }.write(path, |file| {
        (0..size.1).try_for_each(|y| {
            file.push(|channel, x| {
                let SourcePlace { u, v, weight } = map.bands[channel / PARTS.len()].places[y * size.0 + x];
                [u, v, weight][channel % PARTS.len()]
            })
        })
    })
}

/// Returns the name of a band's channel in OpenEXR.
fn channel(bands: usize, band: usize, part: &str) -> String {
    if bands == 1 { part.to_owned() } else { format!("{:02}.{part}", band + 1) }
}
