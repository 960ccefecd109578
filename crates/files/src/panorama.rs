//! Reads panoramas and photographs as linear light: OpenEXR, Radiance HDR, PNG, JPEG, recognised by their content.
//!
//! Headers may lie: sides are limited, and a file must be large enough to hold the pixels that its header promises.

#[cfg(feature = "exr")]
mod exr;
#[cfg(feature = "exr")]
mod exr_layer;
mod radiance;
mod raster;
mod shared;

use super::text::unreadable;
use brillianteer_base::{Fault, FileError};
use brillianteer_scene::Panorama;
use std::fs::File;
use std::io::{BufReader, Read, Seek};
use std::path::Path;

use shared::Raw;
pub use shared::{LARGEST, check_size};

/// The largest number of 16 bits, the brightest that most OpenEXR files can hold.
const LARGEST_HALF: f32 = 65_504.0;

/// The first bytes of an OpenEXR file.
const EXR: [u8; 4] = [0x76, 0x2f, 0x31, 0x01];

/// The endings of pictures' names.
const ENDINGS: [&str; 5] = ["exr", "hdr", "png", "jpg", "jpeg"];

/// A picture that was read from a file, with warnings.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadedPanorama {
    /// The light, finite and not below 0.
    pub panorama: Panorama,
    /// Warnings about unusual content of the file, each with its name.
    pub warnings: Vec<String>,
}

/// Returns whether a path holds a picture, by its first bytes or else by the ending of its name.
pub fn is_picture(path: &Path) -> bool {
    let mut start = Vec::new();
    let read = |file: File| file.take(4).read_to_end(&mut start);
    // The next reader of the path reports that it cannot be read. A pipe is not opened here, since that would keep
    // its writer waiting.
    let _ = path.is_file().then(|| File::open(path).and_then(read));
    let starts: [&[u8]; 4] = [&EXR, b"#?R", b"\x89PNG", b"\xff\xd8\xff"];
    let is_called_so =
        |ending: &std::ffi::OsStr| ENDINGS.iter().any(|known| ending.eq_ignore_ascii_case(known));
    starts.iter().any(|known| start.starts_with(known)) || path.extension().is_some_and(is_called_so)
}

/// Reads a panorama of all directions. One that is not twice as wide as high gives a warning.
///
/// # Errors
/// Fails where the file is no picture that can be read; the error names the file and what to do.
pub fn read(path: &Path) -> Result<LoadedPanorama, FileError> {
    let mut reading = read_photo(path)?;
    let Panorama { width, height, .. } = reading.panorama;
    if !reading.panorama.is_whole_sphere() {
        reading.warnings.push(format!(
            "{}: {width} by {height} pixels: a panorama of all directions is twice as wide as high, so this one \
             will look stretched",
            path.display()
        ));
    }
    Ok(reading)
}

/// Reads a picture of any shape as linear light. Files of eight and sixteen bits are taken as sRGB, with white at 1;
/// transparent pixels are dark.
///
/// # Errors
/// Fails where the file is no readable picture; the error names the file and what to do.
pub fn read_photo(path: &Path) -> Result<LoadedPanorama, FileError> {
    let label = path.display();
    let (mut panorama, mut warnings) = raw(path).map_err(|fault| fault.in_file(&label))?;
    let Mended { infinite, bad, largest } = mend(&mut panorama.pixels);
    if infinite > 0 {
        warnings.push(format!(
            "{infinite} pixels are too bright for the numbers of the file and hold infinite light; they are read as {largest}"
        ));
    }
    if bad > 0 {
        warnings.push(format!("{bad} pixels held negative light or no number, and are read as dark"));
    }
    let warnings = warnings.into_iter().map(|w| format!("{label}: {w}")).collect();
    Ok(LoadedPanorama { panorama, warnings })
}

fn raw(path: &Path) -> Result<Raw, Fault> {
    let about = path.metadata().map_err(unreadable)?;
    if !about.is_file() {
        return Err("this is not a file; give an OpenEXR, Radiance HDR, PNG or JPEG picture".into());
    }
    let mut file = BufReader::new(File::open(path).map_err(unreadable)?);
    let mut start = Vec::new();
    file.by_ref().take(4).read_to_end(&mut start).and_then(|_| file.rewind()).map_err(unreadable)?;
    match start.as_slice() {
        #[cfg(feature = "exr")]
        start if start == EXR => exr::read(file, about.len()),
        #[cfg(not(feature = "exr"))]
        start if start == EXR => {
            Err("this build reads no OpenEXR: build it with the feature `exr`, or save the picture as PNG"
                .into())
        }
        // Programs write `#?RADIANCE` or `#?RGBE`; their pixels are the same.
        start if start.starts_with(b"#?") => radiance::read(file, about.len()),
        _ => raster::read(file, about.len()),
    }
}

/// The values of pixels that were replaced.
struct Mended {
    /// The number of pixels with infinite light, and the light that they have now.
    infinite: usize,
    largest: f32,
    /// The number of pixels with light below 0 or that is no number.
    bad: usize,
}

/// Replaces light without end, as of a sun that overflowed the numbers of its file, by the largest of a number of 16 bits or
/// of the picture; and light below 0 or that is no number by darkness.
fn mend(pixels: &mut [[f32; 3]]) -> Mended {
    let finite = pixels.as_flattened().iter().copied().filter(|light| light.is_finite());
    let mut mended = Mended { infinite: 0, largest: finite.fold(LARGEST_HALF, f32::max), bad: 0 };
    for pixel in pixels {
        let is_infinite = |light: &f32| *light == f32::INFINITY;
        mended.infinite += usize::from(pixel.iter().any(is_infinite));
        mended.bad += usize::from(pixel.iter().any(|light| light.is_nan() || *light < 0.0));
        // NaN becomes 0.
        *pixel = pixel.map(|light| if is_infinite(&light) { mended.largest } else { light.max(0.0) });
    }
    mended
}

#[cfg(test)]
mod tests;
