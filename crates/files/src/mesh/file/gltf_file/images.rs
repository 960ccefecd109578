//! Checks that the images of a glTF file's textures are there. No image is used, so that a fault in one is only a warning.

use super::buffers::Data;
use super::uri;
use crate::undecoded::Undecoded;
use brillianteer_base::Fault;
use gltf::Document;
use gltf::json::Image;
use image::{ImageFormat, ImageReader, guess_format};
use std::borrow::Cow;
use std::io::Cursor;
use std::path::Path;

/// The first bytes of a KTX 2.0 file, which `image` does not know and glTF's KHR_texture_basisu uses.
const KTX2: &[u8] = b"\xABKTX 20\xBB\r\n\x1A\n";

/// Returns a warning that names the first image that is missing or is no picture, and says how many more there are. Only the
/// headers of images are read.
pub(super) fn warning(document: &Document, data: &Data, folder: Option<&Path>) -> Option<String> {
    let images = document.as_json().images.iter().enumerate();
    let mut faults = images.filter_map(|(number, image)| {
        let found = bytes(image, document, data, folder).and_then(|bytes| check(&bytes));
        found.err().map(|why| (number, why))
    });
    let (number, why) = faults.next()?;
    let others = match faults.count() {
        0 => String::new(),
        1 => "; one more image is broken".to_owned(),
        count => format!("; {count} more images are broken"),
    };
    Some(format!("image {number}, of a texture, is left out: {why}{others}"))
}

/// Returns the bytes of an image, wherever they lie.
fn bytes<'a>(
    image: &Image,
    document: &Document,
    data: &'a Data,
    folder: Option<&Path>,
) -> Result<Cow<'a, [u8]>, Fault> {
    if let Some(uri) = &image.uri {
        return uri::read(uri, folder).map(Cow::Owned);
    }
    let view = image.buffer_view.and_then(|index| document.views().nth(index.value()));
    let view = view.ok_or("it has neither a file nor a buffer view")?;
    let end = view.offset().checked_add(view.length());
    let buffer = &data[view.buffer().index()];
    let found = end.and_then(|end| buffer.get(view.offset()..end));
    let lacks = || Fault::whole(format!("buffer {} does not hold it", view.buffer().index()));
    found.map(Cow::Borrowed).ok_or_else(lacks)
}

/// Checks that bytes are a picture of a kind that glTF and its extensions have, as far as its header shows.
fn check(bytes: &[u8]) -> Result<(), Fault> {
    match guess_format(bytes) {
        Ok(format @ (ImageFormat::Png | ImageFormat::Jpeg)) => {
            let size = ImageReader::with_format(Cursor::new(bytes), format).into_dimensions();
            size.map(|_| ()).map_err(|error| Fault::whole(error.reason()))
        }
        // `image` is built here without the readers of these formats.
        Ok(ImageFormat::WebP | ImageFormat::Avif | ImageFormat::Dds) => Ok(()),
        _ if bytes.starts_with(KTX2) => Ok(()),
        _ => Err("its bytes are not a picture of a kind that glTF allows".into()),
    }
}
