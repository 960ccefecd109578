//! Reads panoramas and photographs as linear light: OpenEXR, Radiance HDR, PNG, JPEG, recognised by their content.
//!
//! Headers may lie: sides are limited, and a file must be large enough to hold the pixels that its header promises.

#[cfg(feature = "exr")]
mod exr;
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
    let bad = mend(&mut panorama.pixels);
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
        other => raster::read(file, about.len(), other),
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

/// Replaces values that are not finite or are below 0 by darkness; returns the number of pixels that held such
/// values.
fn mend(pixels: &mut [[f32; 3]]) -> usize {
    let mut count = 0;
    for pixel in pixels {
        let bad = pixel.iter().any(|c| !c.is_finite() || *c < 0.0);
        if bad {
            count += 1;
            *pixel = pixel.map(|c| if c.is_finite() { c.max(0.0) } else { 0.0 });
        }
    }
    count
}

#[cfg(test)]
mod tests;
