//! Designs of Gem Cut Studio, `.gcs`: XML, read by `read`, written by `write`. The format is published nowhere; what is
//! known of it is told in docs/formats.md.
//!
//! Angles there are polar: 0 the table, 90 the girdle, 180 the culet. A stone reaches 1 across and is centred in z.
//! What a file says besides the stone is kept as remarks under the names of its attributes.

mod facets;
mod guard;
mod read;
mod write;

#[cfg(test)]
mod tests;

pub use read::read;
pub use write::write;

/// The largest file taken, bytes: ten thousand facets take half of it.
pub const MAX_BYTES: usize = 16 << 20;

/// The element around all.
const ROOT: &str = "GemCutStudio";

/// The version that is known.
const VERSION: &str = "1000";

/// What `<render>` says besides the index, and what the program says there if nobody has chosen. That is no remark.
const RENDER: [(&str, Option<&str>); 5] = [
    ("material", None),
    ("dispersion", Some("0")),
    ("clarity", Some("100")),
    ("density", Some("1")),
    ("lighting_model", Some("Random")),
];

/// The key of `<color>`, as "r g b", and white.
const COLOUR: (&str, &str) = ("color", "1 1 1");

/// How far into a file its root is looked for, bytes.
const ROOT_WITHIN: usize = 4096;

/// Whether this is a design: by the element around all.
pub fn looks_like(bytes: &[u8]) -> bool {
    let start = encoding_rs::UTF_8.decode(&bytes[..bytes.len().min(ROOT_WITHIN)]).0;
    start.contains("<GemCutStudio")
}
