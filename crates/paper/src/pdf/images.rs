//! The pictures of a PDF (8.9).

use super::deflate::deflated;
use crate::DrawingError;
use pdf_writer::{Filter, Finish, Pdf, Ref};
use png::{BitDepth, ColorType, Decoder};
use resvg::usvg::ImageKind;
use std::io::Cursor;
use std::sync::Arc;

/// The pictures of a file, in the order in which they were first used.
#[derive(Default)]
pub(super) struct PdfImages {
    pictures: Vec<PdfPicture>,
}

/// A picture, and the file that it was read from.
struct PdfPicture {
    png: Arc<Vec<u8>>,
    size: [u32; 2],
    /// Red, green and blue of each pixel, rows from the top.
    pixels: Vec<u8>,
}

impl PdfImages {
    /// Returns the place of a picture among those of the file.
    ///
    /// # Errors
    /// Fails with [`DrawingError::NotForPdf`] for another picture than a PNG of eight-bit red, green and blue.
    pub fn place(&mut self, kind: &ImageKind) -> Result<usize, DrawingError> {
        let ImageKind::PNG(png) = kind else { return Err(REFUSED) };
        if let Some(known) = self.pictures.iter().position(|picture| picture.png == *png) {
            return Ok(known);
        }
        let (size, pixels) = decoded(png).ok_or(REFUSED)?;
        self.pictures.push(PdfPicture { png: Arc::clone(png), size, pixels });
        Ok(self.pictures.len() - 1)
    }

    /// Writes all pictures. Returns the names by which pages call them.
    pub fn write(self, pdf: &mut Pdf, next: &mut impl FnMut() -> Ref) -> Vec<(String, Ref)> {
        let numbered = self.pictures.into_iter().enumerate();
        let written = numbered.map(|(k, picture)| {
            let id = next();
            let data = deflated(&picture.pixels);
            let mut image = pdf.image_xobject(id, &data);
            let [width, height] = picture.size.map(|side| i32::try_from(side).unwrap_or(i32::MAX));
            image.filter(Filter::FlateDecode);
            image.width(width).height(height);
            image.bits_per_component(8).interpolate(true).color_space().device_rgb();
            image.finish();
            (picture_name(k), id)
        });
        written.collect()
    }
}

/// The error about a picture that cannot be written.
const REFUSED: DrawingError =
    DrawingError::NotForPdf { what: "a picture that is no PNG of eight-bit red, green and blue" };

/// Returns the name by which pages call a picture.
pub(super) fn picture_name(place: usize) -> String {
    format!("P{place}")
}

/// Returns the size and the pixels of a PNG of eight-bit red, green and blue; `None` of any other.
fn decoded(png: &[u8]) -> Option<([u32; 2], Vec<u8>)> {
    let mut reader = Decoder::new(Cursor::new(png)).read_info().ok()?;
    let mut pixels = vec![0; reader.output_buffer_size()?];
    let info = reader.next_frame(&mut pixels).ok()?;
    let is_plain = (info.color_type, info.bit_depth) == (ColorType::Rgb, BitDepth::Eight);
    is_plain.then_some(([info.width, info.height], pixels))
}
