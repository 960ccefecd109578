//! Reads PNG and JPEG.

use super::shared::{LARGEST, Raw, check_size, damaged};
use brillianteer_base::Fault;
use brillianteer_optics::linear_from_encoded;
use brillianteer_scene::Panorama;
use image::{DynamicImage, ImageDecoder, ImageReader, Limits};
use std::fs::File;
use std::io::BufReader;

/// The most bytes that a decoder may ask for: the largest picture in its widest form, and as much again to work with.
const MOST_BYTES: u64 = 32 * (LARGEST.0 as u64) * (LARGEST.1 as u64);

/// Reads a picture from a file of so many bytes.
pub(super) fn read(file: BufReader<File>, bytes: u64) -> Result<Raw, Fault> {
    let mut reader = ImageReader::new(file).with_guessed_format().map_err(damaged)?;
    if reader.format().is_none() {
        return Err("this is not a picture of a known format; give OpenEXR, Radiance HDR, PNG or JPEG".into());
    }
    reader.limits(decoder_limits());
    decoded(reader.into_decoder().map_err(damaged)?, bytes)
}

/// Returns the memory that a decoder may ask for.
pub(super) fn decoder_limits() -> Limits {
    let mut limits = Limits::default();
    limits.max_alloc = Some(MOST_BYTES);
    limits
}

fn decoded(mut decoder: impl ImageDecoder, bytes: u64) -> Result<Raw, Fault> {
    let (width, height) = decoder.dimensions();
    check_size(u64::from(width), u64::from(height), bytes)?;
    decoder.set_limits(decoder_limits()).map_err(damaged)?;
    // Photographs say which of their sides was the camera's top.
    let orientation = decoder.orientation().map_err(damaged)?;
    let mut image = DynamicImage::from_decoder(decoder).map_err(damaged)?;
    image.apply_orientation(orientation);
    let (width, height) = (image.width(), image.height());
    Ok((Panorama { width, height, pixels: light(image) }, vec![]))
}

/// Returns the picture's light; floating point is linear already.
pub(super) fn light(image: DynamicImage) -> Vec<[f32; 3]> {
    let decode = |code: f32| linear_from_encoded(f64::from(code)) as f32;
    match image {
        DynamicImage::ImageRgb32F(image) => image.pixels().map(|p| p.0).collect(),
        DynamicImage::ImageRgb8(image) => {
            let table: Vec<f32> = (0..=255_u8).map(|code| decode(f32::from(code) / 255.0)).collect();
            image.pixels().map(|p| p.0.map(|code| table[usize::from(code)])).collect()
        }
        image if image.color().has_alpha() => {
            let lit = |[r, g, b, cover]: [f32; 4]| [r, g, b].map(|code| decode(code) * cover);
            image.into_rgba32f().pixels().map(|p| lit(p.0)).collect()
        }
        image => image.into_rgb32f().pixels().map(|p| p.0.map(decode)).collect(),
    }
}
