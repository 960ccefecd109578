//! Decodes text in the encoding that its bytes or its own words give away: a byte order mark, the zero bytes of UTF-16,
//! a declaration, else UTF-8 or the encoding that old programs for Windows write.

use encoding_rs::{Encoding, UTF_8, UTF_16BE, UTF_16LE, WINDOWS_1252};
use std::borrow::Cow;

/// Text that was decoded.
pub(super) struct Decoded<'b> {
    /// The text, without its byte order mark.
    pub text: Cow<'b, str>,
    /// The encoding by which it was read.
    pub encoding: &'static Encoding,
    /// True where some bytes are no text in this encoding; each stands in the text as U+FFFD.
    pub is_damaged: bool,
}

/// Returns the encoding that a byte order mark names, or UTF-16 where the first characters have the zero bytes of Latin
/// letters in UTF-16 (as in Extensible Markup Language 1.0, appendix F).
pub(super) fn marked(bytes: &[u8]) -> Option<&'static Encoding> {
    if let Some((encoding, _)) = Encoding::for_bom(bytes) {
        return Some(encoding);
    }
    match bytes {
        [1..=255, 0, 1..=255, 0, ..] => Some(UTF_16LE),
        [0, 1..=255, 0, 1..=255, ..] => Some(UTF_16BE),
        _ => None,
    }
}

/// Decodes text by its mark, else in the encoding that it declares, else as UTF-8, else as Windows-1252, in which every
/// byte is a character.
pub(super) fn decoded<'b>(bytes: &'b [u8], declared: Option<&'static Encoding>) -> Decoded<'b> {
    // A text that declares UTF-16 in bytes that can be read one by one does not tell the truth.
    let declared = declared.filter(|encoding| encoding.is_ascii_compatible());
    let otherwise = || if std::str::from_utf8(bytes).is_ok() { UTF_8 } else { WINDOWS_1252 };
    let encoding = marked(bytes).or(declared).unwrap_or_else(otherwise);
    let (text, is_damaged) = encoding.decode_with_bom_removal(bytes);
    Decoded { text, encoding, is_damaged }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Encodes a text in UTF-16, behind a mark where one is wanted.
    fn wide(text: &str, order: fn(u16) -> [u8; 2], mark: bool) -> Vec<u8> {
        let mark = mark.then_some('\u{feff}');
        mark.into_iter().chain(text.chars()).flat_map(|c| order(c as u16)).collect()
    }

    #[test]
    fn text_is_read_in_every_encoding_that_gives_itself_away() {
        let text = "GemCad 5.0\nH Алмаз Brücke −41.5\n";
        let mut all = vec![text.as_bytes().to_vec(), format!("\u{feff}{text}").into_bytes()];
        for mark in [true, false] {
            all.extend([u16::to_le_bytes, u16::to_be_bytes].map(|order| wide(text, order, mark)));
        }
        for bytes in all {
            let read = decoded(&bytes, None);
            assert_eq!((read.text.as_ref(), read.is_damaged), (text, false), "{:?}", &bytes[..4]);
        }
    }

    #[test]
    fn a_declaration_holds_where_no_mark_says_otherwise() {
        let latin = b"Br\xfccke";
        assert_eq!(decoded(latin, None).text, "Brücke");
        assert_eq!(decoded(latin, Encoding::for_label(b"windows-1251")).text, "Brьcke");
        assert_eq!(decoded(latin, Encoding::for_label(b"utf-16")).text, "Brücke");
        assert!(decoded(latin, Some(UTF_8)).is_damaged);
        let marked = "\u{feff}Brücke".as_bytes();
        assert_eq!(decoded(marked, Encoding::for_label(b"latin1")).text, "Brücke");
    }

    #[test]
    fn zero_bytes_elsewhere_are_no_sign_of_an_encoding() {
        for bytes in [&b"\0\0\0\0"[..], b"ab\0\0", b"a\0", b"", b"\0a\0\0"] {
            assert_eq!(marked(bytes), None, "{bytes:?}");
        }
    }
}
