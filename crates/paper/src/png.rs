//! Writes PNG pictures row by row, so that they may be larger than memory.

use brillianteer_files::{WholeFile, WriteError};
use std::cell::RefCell;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::rc::Rc;

/// The largest side of a picture, in pixels.
pub const MOST_PIXELS: u32 = 16_384;

/// An sRGB picture that is written as PNG, row by row, whole or not at all; see [`WholeFile`].
pub struct PngFile {
    path: PathBuf,
    stream: png::StreamWriter<'static, SharedFile>,
    file: SharedFile,
}

/// The file of a PNG, which its encoder writes to and does not give back.
#[derive(Clone)]
struct SharedFile(Rc<RefCell<WholeFile>>);

impl Write for SharedFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.borrow_mut().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.borrow_mut().flush()
    }
}

impl PngFile {
    /// Begins a picture of eight-bit red, green and blue. `description` goes into the file as text: the tracer of the
    /// picture, and the light that it left unresolved.
    ///
    /// # Errors
    /// Fails where the file cannot be written.
    pub fn begin(path: &Path, size: (u32, u32), description: &str) -> Result<Self, WriteError> {
        Self::of_colour(path, size, png::ColorType::Rgb, description)
    }

    /// Begins a picture of eight-bit colours of this kind.
    pub(super) fn of_colour(
        path: &Path,
        size: (u32, u32),
        colour: png::ColorType,
        description: &str,
    ) -> Result<Self, WriteError> {
        let failed = |e: png::EncodingError| WriteError::io(path, e);
        let file = SharedFile(Rc::new(RefCell::new(WholeFile::begin(path)?)));
        let encoder = encoder(file.clone(), size, colour, description).map_err(failed)?;
        let writer = encoder.write_header().map_err(failed)?;
        let stream = writer.into_stream_writer().map_err(failed)?;
        Ok(Self { path: path.to_path_buf(), stream, file })
    }

    /// Adds pixels, from left to right and top to bottom.
    ///
    /// # Errors
    /// Fails where the file system refuses.
    pub fn push(&mut self, pixels: &[u8]) -> Result<(), WriteError> {
        self.stream.write_all(pixels).map_err(|e| WriteError::io(&self.path, e))
    }

    /// Moves the finished picture to its path.
    ///
    /// # Errors
    /// Fails where the file system refuses, or pixels are missing.
    pub fn finish(self) -> Result<(), WriteError> {
        let Self { path, stream, file } = self;
        stream.finish().map_err(|e| WriteError::io(&path, e))?;
        // The encoder has let go of the file.
        match Rc::try_unwrap(file.0) {
            Ok(file) => file.into_inner().finish(),
            Err(_) => Err(WriteError::io(&path, io::Error::other("the encoder still holds the file"))),
        }
    }
}

/// Writes an sRGB picture as PNG; `fill` pushes its rows. See [`PngFile`].
///
/// # Errors
/// Fails where the file system refuses, or `fill` returns an error.
pub fn write_png<E: From<WriteError>>(
    path: &Path,
    size: (u32, u32),
    description: &str,
    fill: impl FnOnce(&mut PngFile) -> Result<(), E>,
) -> Result<(), E> {
    let mut png = PngFile::begin(path, size, description)?;
    fill(&mut png)?;
    Ok(png.finish()?)
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
