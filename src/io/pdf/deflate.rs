//! Compression of what a PDF holds.

use flate2::Compression;
use flate2::write::ZlibEncoder;
use std::io::Write;

/// Compresses bytes as `FlateDecode` reads them (7.4.4).
pub(super) fn deflated(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::best());
    // Writing to memory cannot fail.
    let _ = encoder.write_all(bytes);
    encoder.finish().unwrap_or_default()
}
