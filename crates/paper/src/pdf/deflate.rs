//! Compression of the streams of a PDF.

use flate2::Compression;
use flate2::write::ZlibEncoder;
use std::io::Write;

/// Compresses bytes in the form that `FlateDecode` reads (7.4.4).
pub(super) fn deflated(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::best());
    // Writing to memory cannot fail.
    let _ = encoder.write_all(bytes);
    encoder.finish().unwrap_or_default()
}
