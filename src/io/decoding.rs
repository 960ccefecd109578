//! Brings text that other programs wrote into one form: UTF-8 without a mark, lines that end in a line feed. Bytes that are in
//! this form already are not copied.

use encoding_rs::{Encoding, UTF_16BE, UTF_16LE};
use std::borrow::Cow;

/// The number of 16-bit units at the start of a file by which UTF-16 without a mark is recognised.
const UNITS: usize = 32;

/// Returns text in UTF-8 without its mark, and any other bytes as they are. UTF-16 is recognised by its mark, or without
/// one by its beginning in ASCII.
pub(super) fn in_utf8(bytes: &[u8]) -> Cow<'_, [u8]> {
    if let Some(rest) = bytes.strip_prefix(b"\xef\xbb\xbf") {
        return Cow::Borrowed(rest);
    }
    match utf16(bytes) {
        Some(encoding) => Cow::Owned(encoding.decode(bytes).0.into_owned().into_bytes()),
        None => Cow::Borrowed(bytes),
    }
}

/// Returns lines that end in a line feed, alone or behind a carriage return, where some end in a carriage return alone.
pub(super) fn with_line_feeds(text: &[u8]) -> Cow<'_, [u8]> {
    let is_lone = |at: usize| text[at] == b'\r' && text.get(at + 1) != Some(&b'\n');
    let Some(first) = (0..text.len()).find(|&at| is_lone(at)) else { return Cow::Borrowed(text) };
    let mut changed = text.to_vec();
    (first..text.len()).filter(|&at| is_lone(at)).for_each(|at| changed[at] = b'\n');
    Cow::Owned(changed)
}

/// Returns the byte order of text in UTF-16; `None` for any other bytes.
fn utf16(bytes: &[u8]) -> Option<&'static Encoding> {
    match bytes {
        // Four bytes of this kind are the mark of UTF-32, which nothing here reads.
        [0xff, 0xfe, 0, 0, ..] => None,
        [0xff, 0xfe, ..] => Some(UTF_16LE),
        [0xfe, 0xff, ..] => Some(UTF_16BE),
        _ => {
            let units = bytes.as_chunks::<2>().0;
            let units = &units[..units.len().min(UNITS)];
            let is_text = |byte: u8| matches!(byte, b'\t' | b'\n' | b'\r' | b' '..=b'~');
            let little = units.iter().all(|&[low, high]| high == 0 && is_text(low));
            let big = units.iter().all(|&[high, low]| high == 0 && is_text(low));
            match units.len() {
                0..2 => None,
                _ if little => Some(UTF_16LE),
                _ => big.then_some(UTF_16BE),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_of_every_encoding_becomes_the_same_text() {
        let text = "v 1 0 0\r\n# Brücke 字\n";
        let little: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
        let big: Vec<u8> = text.encode_utf16().flat_map(u16::to_be_bytes).collect();
        let marked = |mark: &[u8], text: &[u8]| [mark, text].concat();
        for bytes in [
            text.as_bytes().to_vec(),
            marked(b"\xef\xbb\xbf", text.as_bytes()),
            marked(b"\xff\xfe", &little),
            marked(b"\xfe\xff", &big),
            // Without a mark the beginning in ASCII decides.
            "v 1 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0".encode_utf16().flat_map(u16::to_le_bytes).collect(),
            "v 1 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0".encode_utf16().flat_map(u16::to_be_bytes).collect(),
        ] {
            let found = String::from_utf8(in_utf8(&bytes).into_owned()).unwrap();
            assert!(found == text || found.starts_with("v 1 0 0 0 0"), "{found}");
        }
        for other in [&b""[..], b"\0", b"a", b"\0\0\0\0\0\0", b"glTF\x02\0\0\0", b"\xff\xfe\0\0a\0\0\0"] {
            assert_eq!(in_utf8(other), other);
        }
    }

    #[test]
    fn every_kind_of_line_end_makes_the_same_lines() {
        let lines = |text: &[u8]| {
            let text = with_line_feeds(text).into_owned();
            String::from_utf8(text).unwrap().lines().map(str::to_owned).collect::<Vec<_>>()
        };
        for text in ["a\nb\n\nc", "a\r\nb\r\n\r\nc", "a\rb\r\rc", "a\rb\r\n\nc", "a\nb\r\rc\r"] {
            assert_eq!(lines(text.as_bytes()), ["a", "b", "", "c"], "{text:?}");
        }
        assert!(matches!(with_line_feeds(b"a\r\nb\n"), Cow::Borrowed(_)));
    }
}
