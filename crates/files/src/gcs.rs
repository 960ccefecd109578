//! Designs of Gem Cut Studio, `.gcs`: XML, read by `read`, written by `write`. The format is published nowhere;
//! docs/formats.md collects what is known of it.
//!
//! Angles in a file are polar: 0 the table, 90 the girdle, 180 the culet. A stone reaches 1 across and is centred in
//! z. Statements of a file that are not about the stone are kept as remarks under the names of their attributes.

use super::encoding;

mod facets;
mod guard;
mod read;
mod write;

#[cfg(test)]
mod tests;

pub use read::read;
pub use write::write;

/// The size of the largest file that is read, in bytes: ten thousand facets take half of it.
pub const MAX_BYTES: usize = 16 << 20;

/// The name of the root element.
const ROOT: &str = "GemCutStudio";

/// The version of the format that the reader knows.
const VERSION: &str = "1000";

/// The attributes of `<render>` besides the index, with the values that Gem Cut Studio writes by default. A default
/// is not kept as a remark.
const RENDER: [(&str, Option<&str>); 5] = [
    ("material", None),
    ("dispersion", Some("0")),
    ("clarity", Some("100")),
    ("density", Some("1")),
    ("lighting_model", Some("Random")),
];

/// The key of the remark about `<color>`, as "r g b", and the value for white.
const COLOUR: (&str, &str) = ("color", "1 1 1");

/// The number of bytes at the start of a file in which its root element is sought.
const ROOT_WITHIN: usize = 4096;

/// Returns whether a file is a design of Gem Cut Studio, by its root element.
pub fn looks_like(bytes: &[u8]) -> bool {
    encoding::decoded(&bytes[..bytes.len().min(ROOT_WITHIN)], None).text.contains("<GemCutStudio")
}
