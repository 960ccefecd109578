//! Recognises the mesh format of a file by its first bytes.

use super::number::number;
use crate::encoding::{in_utf8, with_line_feeds};
use crate::numbers::{NumberReader, Token};
use std::path::Path;

/// The mesh formats that are read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeshFormat {
    /// Binary glTF 2.0.
    Glb,
    /// glTF 2.0 as JSON.
    Gltf,
    /// Wavefront OBJ.
    Obj,
    /// Binary STL.
    StlBinary,
    /// STL as text.
    StlText,
    /// PLY, text or binary.
    Ply,
}

/// The size of a binary STL's header, in bytes.
pub(in crate::mesh) const STL_HEADER: usize = 80;

/// The place of a binary STL's first triangle, behind the header and the count, in bytes.
pub(super) const STL_START: usize = STL_HEADER + 4;

/// The size of a triangle in a binary STL, in bytes.
pub(super) const STL_TRIANGLE: u64 = 50;

/// The number of bytes of a text that are examined: OBJ files may begin with long comments.
const LOOKED_AT: usize = 64 << 10;

/// The number of bytes at the start of a text that hold no zero. A binary STL has zeros sooner.
const TEXT: usize = 1 << 10;

/// Returns the format that bytes look like, if it is one of those that are read. The more of the file they hold, the surer
/// the answer. A text may be in UTF-8 or UTF-16, with a mark or without.
pub fn looks_like(bytes: &[u8]) -> Option<MeshFormat> {
    if bytes.starts_with(b"glTF") {
        return Some(MeshFormat::Glb);
    }
    // Checked before text: many binary STL files begin with the word `solid` by which text ones are recognised.
    if stl_triangles(bytes).is_some_and(|count| bytes.len() as u64 == STL_START as u64 + STL_TRIANGLE * count)
    {
        return Some(MeshFormat::StlBinary);
    }
    let beginning = &bytes[..bytes.len().min(LOOKED_AT)];
    let text = with_line_feeds(&in_utf8(beginning)).into_owned();
    let first = text.trim_ascii_start();
    if first.starts_with(b"ply") && first.get(3).is_none_or(u8::is_ascii_whitespace) {
        return Some(MeshFormat::Ply);
    }
    // Zeros may pad the end of a text.
    let end = text.iter().rposition(|byte| *byte != 0).map_or(0, |last| last + 1);
    let is_text = !text[..end.min(TEXT)].contains(&0);
    let text = String::from_utf8_lossy(&text);
    let start = text.trim_start();
    if start.starts_with('{') {
        return text.contains("\"asset\"").then_some(MeshFormat::Gltf);
    }
    if is_text && start.get(..5).is_some_and(|word| word.eq_ignore_ascii_case("solid")) {
        let lower = text.to_ascii_lowercase();
        // A solid without facets ends at once; the reader reports that it has none.
        if lower.contains("facet") || lower.contains("endsolid") {
            return Some(MeshFormat::StlText);
        }
    }
    if is_obj(&text) {
        return Some(MeshFormat::Obj);
    }
    // A binary file that begins so is an STL whose length does not agree with its count, which its reader reports.
    let is_binary = bytes.len() > STL_START && beginning.contains(&0);
    (is_binary && bytes.starts_with(b"solid")).then_some(MeshFormat::StlBinary)
}

/// Returns the format of bytes that do not look like one, by the ending of their file's name and a sign in them. Its reader
/// says what is wrong: a binary STL that was cut off or whose count is wrong, an STL without its first line, a text whose
/// corners are not numbers, and JSON that is broken.
pub(super) fn by_name(bytes: &[u8], path: &Path) -> Option<MeshFormat> {
    let ending = path.extension()?.to_string_lossy().to_ascii_lowercase();
    let text = in_utf8(&bytes[..bytes.len().min(LOOKED_AT)]);
    let text = String::from_utf8_lossy(&with_line_feeds(&text)).to_ascii_lowercase();
    let begins_a_line = |word: &str| text.lines().any(|line| line.split_whitespace().next() == Some(word));
    match ending.as_str() {
        "stl" if begins_a_line("vertex") => Some(MeshFormat::StlText),
        "stl" if bytes.len() >= STL_START && bytes.contains(&0) => Some(MeshFormat::StlBinary),
        "obj" if begins_a_line("v") || has_corner(bytes) => Some(MeshFormat::Obj),
        "gltf" if !text.trim().is_empty() => Some(MeshFormat::Gltf),
        _ => None,
    }
}

/// Returns whether some line is one of a corner, however long the comments above it are.
fn has_corner(bytes: &[u8]) -> bool {
    bytes.split(|byte| *byte == b'\n').any(|line| line.trim_ascii_start().starts_with(b"v "))
}

/// Returns the number of triangles that a binary STL states.
pub(super) fn stl_triangles(bytes: &[u8]) -> Option<u64> {
    let count = bytes.get(STL_HEADER..STL_START)?;
    Some(u64::from(u32::from_le_bytes(count.try_into().ok()?)))
}

/// Returns whether the first line that is no comment is one of OBJ's, and there is a line of a corner.
fn is_obj(text: &str) -> bool {
    const FIRST: [&str; 14] =
        ["v", "vn", "vt", "vp", "f", "o", "g", "s", "mg", "mtllib", "usemtl", "l", "p", "cstype"];
    let word = |line: &'_ str| line.split_whitespace().next().unwrap_or_default().to_ascii_lowercase();
    let mut words = text.lines().map(word).filter(|w| !w.is_empty() && !w.starts_with('#')).peekable();
    let begins = words.peek().is_some_and(|first| FIRST.contains(&first.as_str()));
    let is_number =
        |text: &str| Token::of(text).is_numeric() || number(&mut NumberReader::default(), text, 0).is_ok();
    let numbers = |line: &str| line.split_whitespace().skip(1).take(3).all(is_number);
    begins
        && text.lines().any(|line| word(line) == "v" && line.split_whitespace().count() >= 4 && numbers(line))
}
