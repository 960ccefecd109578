//! Reads panoramas and photographs as linear light: OpenEXR, Radiance HDR, PNG, JPEG, recognised by their content.
//!
//! Headers may lie: sides are limited, and a file must be large enough to hold the pixels that its header promises.

#[cfg(feature = "exr")]
mod exr;
#[cfg(feature = "exr")]
mod exr_layer;
mod radiance;
mod raster;

use super::file_error::{Fault, FileError};
use super::text::unreadable;
use crate::scene::Panorama;
use std::fs::File;
use std::io::{BufReader, Read, Seek};
use std::path::Path;

/// The width and the height of the largest picture that is read, in pixels.
pub const LARGEST: (u32, u32) = (16_384, 8192);

/// The most pixels that a byte of a file can stand for: deflate packs 1032 bytes into one, run lengths and JPEG fewer.
const PIXELS_A_BYTE: u64 = 1100;

/// The number of pixels, 48 MiB of light, that any header may promise, however small the file.
const FREE_PIXELS: u64 = 1 << 22;

/// The largest number of 16 bits, the brightest that most OpenEXR files can hold.
const LARGEST_HALF: f32 = 65_504.0;

/// The primaries and the white of sRGB, as CIE x and y (ITU-R BT.709-6, §1).
const SRGB_PLACES: [[f32; 2]; 4] = [[0.64, 0.33], [0.30, 0.60], [0.15, 0.06], [0.3127, 0.3290]];

/// Primaries whose coordinates differ by less than this count as the same.
const SAME_PLACE: f32 = 0.002;

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

/// The light of a file, and warnings about the file.
type Raw = (Panorama, Vec<String>);

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

/// Refuses sides out of bounds, and more pixels than `bytes` bytes can hold.
pub(super) fn check_size(width: u64, height: u64, bytes: u64) -> Result<(), Fault> {
    if width == 0 || height == 0 {
        return Err(format!("{width} by {height} pixels: there is no picture in it").into());
    }
    if width > u64::from(LARGEST.0) || height > u64::from(LARGEST.1) {
        let (most_wide, most_high) = LARGEST;
        return Err(format!(
            "{width} by {height} pixels are too many; scale it down to {most_wide} by {most_high} at most"
        )
        .into());
    }
    if width * height > FREE_PIXELS.max(bytes.saturating_mul(PIXELS_A_BYTE)) {
        return Err(format!(
            "{bytes} bytes cannot hold {width} by {height} pixels: the file is damaged; get it again"
        )
        .into());
    }
    Ok(())
}

/// Makes a fault of a file that a decoder gave up on.
fn damaged(error: impl std::fmt::Display) -> Fault {
    Fault::whole(format!(
        "cannot be decoded ({error}); get the file again, or save it again as OpenEXR, Radiance HDR, PNG or JPEG"
    ))
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

/// Returns a warning where primaries and white, as CIE x and y of red, green, blue and white, are not those of sRGB.
fn warn_of_primaries(given: [[f32; 2]; 4]) -> Option<String> {
    let pairs = given.as_flattened().iter().zip(SRGB_PLACES.as_flattened());
    let is_srgb = pairs.into_iter().all(|(a, b)| (a - b).abs() < SAME_PLACE);
    (!is_srgb).then(|| {
        "its primaries are not those of sRGB, but are read as such, so colours will be wrong".to_owned()
    })
}

#[cfg(test)]
mod tests;
