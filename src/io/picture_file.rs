//! Writes finished pictures: developed as PNG, in linear light as OpenEXR.

use super::atomic::{WriteError, write};
#[cfg(feature = "exr")]
use super::exr;
use super::png::encoder;
#[cfg(feature = "exr")]
use crate::picture::Linear;
#[cfg(feature = "exr")]
use ::exr::{math::Vec2, meta::attribute::Chromaticities, prelude::SpecificChannels};
use std::path::Path;

/// The primaries and the white of sRGB, as CIE x and y (ITU-R BT.709-6, §1).
#[cfg(feature = "exr")]
pub(super) const SRGB: Chromaticities = Chromaticities {
    red: Vec2(0.64, 0.33),
    green: Vec2(0.30, 0.60),
    blue: Vec2(0.15, 0.06),
    white: Vec2(0.3127, 0.3290),
};

/// Writes a developed picture as PNG: red, green, blue and cover (alpha) of each pixel, not premultiplied. Where cover is
/// 255 everywhere, the file holds none. `description` goes into the file as text.
///
/// # Errors
/// When the file system refuses, or the number of pixels does not fit the size.
pub fn write_rgba_png(
    path: &Path,
    rgba: &[u8],
    size: (u32, u32),
    description: &str,
) -> Result<(), WriteError> {
    let failed = |e: png::EncodingError| WriteError::io(path, e);
    let opaque = rgba.chunks_exact(4).all(|pixel| pixel[3] == 255);
    let colour = if opaque { png::ColorType::Rgb } else { png::ColorType::Rgba };
    write(path, |file| {
        let mut writer =
            encoder(file, size, colour, description).and_then(png::Encoder::write_header).map_err(failed)?;
        if opaque {
            writer.write_image_data(&without_cover(rgba)).map_err(failed)?;
        } else {
            writer.write_image_data(rgba).map_err(failed)?;
        }
        writer.finish().map_err(failed)
    })
}

/// Returns the colours of pixels without their cover.
pub(super) fn without_cover(rgba: &[u8]) -> Vec<u8> {
    rgba.chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect()
}

/// Writes a picture as OpenEXR, as it is: premultiplied linear sRGB, in the channels R, G, B and A of 32 bits.
///
/// # Errors
/// When the file system refuses, or the number of pixels does not fit the size.
#[cfg(feature = "exr")]
pub fn write_linear_exr(path: &Path, picture: &Linear, description: &str) -> Result<(), WriteError> {
    let size = (picture.width as usize, picture.height as usize);
    if size.0 * size.1 != picture.pixels.len() || picture.pixels.is_empty() {
        return Err(WriteError::io(path, unfit(picture.pixels.len(), (picture.width, picture.height))));
    }
    // The writer asks for pixels one by one: a list for each channel would take as much memory again.
    let pixel = |at: Vec2<usize>| -> (f32, f32, f32, f32) { picture.pixels[at.y() * size.0 + at.x()].into() };
    let channels = SpecificChannels::rgba(pixel);
    exr::write_image(path, &exr::image(size, channels, (description, None), Some(SRGB)))
}

/// Makes the error of a number of pixels that does not fit the size.
pub(super) fn unfit(pixels: usize, (width, height): (u32, u32)) -> std::io::Error {
    std::io::Error::other(format!("{pixels} pixels are not a picture of {width} by {height}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use ::exr::prelude::{MetaData, read_first_rgba_layer_from_file};

    fn picture() -> Linear {
        let pixel = |k: u32| [k as f32 * 0.37 - 1.0, 1e4 / (k + 1) as f32, 1e-7 * k as f32, (k % 2) as f32];
        Linear { width: 17, height: 5, pixels: (0..85).map(pixel).collect() }
    }

    #[test]
    fn a_linear_picture_reads_back_to_the_bit() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.exr");
        write_linear_exr(&path, &picture(), "a test").unwrap();
        let image = read_first_rgba_layer_from_file(
            &path,
            |size, _| vec![[0.0_f32; 4]; size.area()],
            |pixels, at, (r, g, b, a): (f32, f32, f32, f32)| pixels[at.y() * 17 + at.x()] = [r, g, b, a],
        );
        assert_eq!(image.unwrap().layer_data.channel_data.pixels, picture().pixels);
        let header = MetaData::read_from_file(&path, true).unwrap().headers.remove(0);
        assert_eq!(header.shared_attributes.chromaticities, Some(SRGB));
        assert_eq!(header.own_attributes.comments.unwrap().to_string(), "a test");
    }

    #[test]
    fn cover_is_written_where_there_is_some() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        for (cover, colour) in [(255, png::ColorType::Rgb), (254, png::ColorType::Rgba)] {
            let rgba: Vec<u8> = (0..6).flat_map(|k| [k, 2 * k, 3 * k, cover.max(250 + k)]).collect();
            write_rgba_png(&path, &rgba, (3, 2), "Zirkon, geschliffen – α").unwrap();
            let mut reader = png::Decoder::new(std::io::BufReader::new(std::fs::File::open(&path).unwrap()))
                .read_info()
                .unwrap();
            let mut out = vec![0; reader.output_buffer_size().unwrap()];
            assert_eq!(reader.next_frame(&mut out).unwrap().color_type, colour);
            let expected = if cover == 255 { without_cover(&rgba) } else { rgba };
            assert_eq!(out, expected);
            assert_eq!(reader.info().utf8_text[0].get_text().unwrap(), "Zirkon, geschliffen – α");
        }
    }

    #[test]
    fn pixels_that_do_not_fit_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        assert!(write_rgba_png(&path, &[0; 12], (2, 2), "").is_err());
        let broken = Linear { width: 3, height: 2, pixels: vec![[0.0; 4]; 5] };
        assert!(write_linear_exr(&path, &broken, "").unwrap_err().to_string().contains("3 by 2"));
        assert!(write_linear_exr(&path, &Linear::new(0, 4), "").is_err());
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
