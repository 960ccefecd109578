//! Designs of Gem Cut Studio, `.gcs`: XML, read by `read`, written by `write`. The format is published nowhere; what is
//! known of it stands in docs/formats.md.
//!
//! Angles in a file are polar: 0 the table, 90 the girdle, 180 the culet. A stone reaches 1 across and is centred in z.
//! What a file says besides the stone is kept as remarks under the names of its attributes.

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

/// The version of the format that is known.
const VERSION: &str = "1000";

/// The attributes of `<render>` besides the index, and what Gem Cut Studio writes there if nobody has chosen. Such a value
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

/// How far into a file its root element is looked for, in bytes.
const ROOT_WITHIN: usize = 4096;

/// Returns whether a file is a design of Gem Cut Studio, by its root element.
pub fn looks_like(bytes: &[u8]) -> bool {
    let start = encoding_rs::UTF_8.decode(&bytes[..bytes.len().min(ROOT_WITHIN)]).0;
    start.contains("<GemCutStudio")
}
