//! Writes PNG pictures row by row, so that they may be larger than memory.

use super::atomic::{WriteError, write};
use std::io::Write;
use std::path::Path;

/// The largest side of a picture, in pixels.
pub const MOST_PIXELS: u32 = 16_384;

/// Writes the rows of a picture, in eight-bit red, green and blue; see [`write_png`].
pub struct PngRows<'a> {
    path: &'a Path,
    stream: &'a mut dyn Write,
}

impl PngRows<'_> {
    /// Adds pixels, from left to right and top to bottom.
    ///
    /// # Errors
    /// When the file system refuses.
    pub fn push(&mut self, pixels: &[u8]) -> Result<(), WriteError> {
        self.stream.write_all(pixels).map_err(|e| WriteError::io(self.path, e))
    }
}

/// Writes an sRGB picture as PNG; `fill` pushes its rows. `description` goes into the file as text: which tracer made
/// the picture, and what it left unresolved.
///
/// # Errors
/// When the file system refuses, or `fill` returns an error.
pub fn write_png<E: From<WriteError>>(
    path: &Path,
    size: (u32, u32),
    description: &str,
    fill: impl FnOnce(&mut PngRows) -> Result<(), E>,
) -> Result<(), E> {
    write(path, |file| -> Result<(), E> {
        let failed = |e: png::EncodingError| WriteError::io(path, e);
        let encoder = encoder(file, size, png::ColorType::Rgb, description).map_err(failed)?;
        let mut writer = encoder.write_header().map_err(failed)?;
        let mut stream = writer.stream_writer().map_err(failed)?;
        fill(&mut PngRows { path, stream: &mut stream })?;
        stream.finish().map_err(failed)?;
        Ok(writer.finish().map_err(failed)?)
    })
}

/// Makes an encoder of eight-bit sRGB with the texts that every picture carries.
pub(super) fn encoder<W: Write>(
    file: W,
    (width, height): (u32, u32),
    colour: png::ColorType,
    description: &str,
) -> Result<png::Encoder<'static, W>, png::EncodingError> {
    let mut encoder = png::Encoder::new(file, width, height);
    encoder.set_color(colour);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Fast);
    encoder.set_source_srgb(png::SrgbRenderingIntent::RelativeColorimetric);
    encoder.add_text_chunk("Software".into(), "Brillianteer".into())?;
    encoder.add_itxt_chunk("Description".into(), description.into())?;
    Ok(encoder)
}
