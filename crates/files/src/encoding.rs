//! Decodes text in the encoding that its bytes or its own words give away: a byte order mark, the zero bytes of UTF-16,
//! a declaration, else UTF-8 or the encoding that old programs for Windows write. Brings the ends of its lines into one form.

#[cfg(feature = "interchange")]
use encoding_rs::{Encoding, UTF_8, WINDOWS_1252};
use std::borrow::Cow;

/// The byte order mark of UTF-8.
const MARK: &[u8] = b"\xef\xbb\xbf";

/// The number of 16-bit units at the start of a file by which UTF-16 without a mark is told from numbers.
const UNITS: usize = 32;

/// Text that was decoded.
#[cfg(feature = "interchange")]
pub(super) struct Decoded<'b> {
    /// The text, without its byte order mark.
    pub text: Cow<'b, str>,
    /// The name of the encoding by which it was read.
    pub encoding: &'static str,
    /// True where some bytes are no text in this encoding; each stands in the text as U+FFFD.
    pub is_damaged: bool,
}

/// An encoding whose units have several bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Wide {
    Utf16Little,
    Utf16Big,
    Utf32Little,
    Utf32Big,
}

impl Wide {
    /// Returns the encoding that a byte order mark names, or UTF-16 where the first characters have the zero bytes of Latin
    /// letters in UTF-16 (as in Extensible Markup Language 1.0, appendix F), and no unit near them is no text.
    fn of(bytes: &[u8]) -> Option<Self> {
        match bytes {
            [0xff, 0xfe, 0, 0, ..] => return Some(Self::Utf32Little),
            [0, 0, 0xfe, 0xff, ..] => return Some(Self::Utf32Big),
            [0xff, 0xfe, ..] => return Some(Self::Utf16Little),
            [0xfe, 0xff, ..] => return Some(Self::Utf16Big),
            _ => {}
        }
        let beginning = &bytes[..bytes.len().min(2 * UNITS)];
        let begins = |wide: &Self| begins_text(&wide.units(beginning).collect::<Vec<u32>>());
        [Self::Utf16Little, Self::Utf16Big].into_iter().find(begins)
    }

    #[cfg(feature = "interchange")]
    fn name(self) -> &'static str {
        match self {
            Self::Utf16Little => "UTF-16LE",
            Self::Utf16Big => "UTF-16BE",
            Self::Utf32Little => "UTF-32LE",
            Self::Utf32Big => "UTF-32BE",
        }
    }

    /// Returns the whole units of bytes.
    fn units(self, bytes: &[u8]) -> impl Iterator<Item = u32> {
        let length = if matches!(self, Self::Utf16Little | Self::Utf16Big) { 2 } else { 4 };
        let is_big = matches!(self, Self::Utf16Big | Self::Utf32Big);
        bytes.chunks_exact(length).map(move |unit| {
            let joined = |unit: u32, byte: &u8| (unit << 8) | u32::from(*byte);
            if is_big { unit.iter().fold(0, joined) } else { unit.iter().rev().fold(0, joined) }
        })
    }

    /// Decodes text; a unit that is no part of a character becomes U+FFFD. The mark is left out.
    fn decode(self, bytes: &[u8]) -> String {
        let units = self.units(bytes);
        let character = |unit: Option<char>| unit.unwrap_or(char::REPLACEMENT_CHARACTER);
        let text: String = match self {
            Self::Utf16Little | Self::Utf16Big => {
                char::decode_utf16(units.map(|unit| unit as u16)).map(|unit| character(unit.ok())).collect()
            }
            Self::Utf32Little | Self::Utf32Big => units.map(|unit| character(char::from_u32(unit))).collect(),
        };
        text.strip_prefix('\u{feff}').map(str::to_owned).unwrap_or(text)
    }
}

/// Returns whether the first units of UTF-16 begin a text in ASCII. Numbers would have control characters among them.
fn begins_text(units: &[u32]) -> bool {
    let is_break = |unit: &u32| matches!(unit, 9 | 10 | 13);
    let is_ascii = |unit: &u32| matches!(unit, 0x20..0x7f) || is_break(unit);
    let is_text = |unit: &u32| *unit >= 0x20 || is_break(unit);
    units.len() > 1 && units[..2].iter().all(is_ascii) && units.iter().all(is_text)
}

/// Decodes text by its mark, else in the encoding that it declares, else as UTF-8, else as Windows-1252, in which every
/// byte is a character.
#[cfg(feature = "interchange")]
pub(super) fn decoded<'b>(bytes: &'b [u8], declared: Option<&'static Encoding>) -> Decoded<'b> {
    if let Some(wide) = Wide::of(bytes) {
        let text = wide.decode(bytes);
        let is_damaged = text.contains(char::REPLACEMENT_CHARACTER);
        return Decoded { text: Cow::Owned(text), encoding: wide.name(), is_damaged };
    }
    let (bytes, encoding) = match bytes.strip_prefix(MARK) {
        Some(rest) => (rest, UTF_8),
        None => {
            // A text that declares UTF-16 in bytes that can be read one by one does not tell the truth.
            let declared = declared.filter(|encoding| encoding.is_ascii_compatible());
            let otherwise = || if std::str::from_utf8(bytes).is_ok() { UTF_8 } else { WINDOWS_1252 };
            (bytes, declared.unwrap_or_else(otherwise))
        }
    };
    let (text, is_damaged) = encoding.decode_without_bom_handling(bytes);
    Decoded { text, encoding: encoding.name(), is_damaged }
}

/// Returns text that says its encoding by its bytes in UTF-8 without a mark, and any other bytes as they are: of formats
/// that declare no encoding, or whose files may go on in numbers.
pub(super) fn in_utf8(bytes: &[u8]) -> Cow<'_, [u8]> {
    match Wide::of(bytes) {
        Some(wide) => Cow::Owned(wide.decode(bytes).into_bytes()),
        None => Cow::Borrowed(bytes.strip_prefix(MARK).unwrap_or(bytes)),
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

/// Returns whether a character only fills up a file or a block of it.
#[cfg(feature = "interchange")]
pub(super) fn is_padding(c: char) -> bool {
    matches!(c, '\0' | '\u{1a}' | '\u{feff}')
}

#[cfg(all(test, feature = "interchange"))]
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
        for mark in [b"\xff\xfe\0\0", b"\0\0\xfe\xff"] {
            let order = if mark[0] == 0 { u32::to_be_bytes } else { u32::to_le_bytes };
            all.push(mark.iter().copied().chain(text.chars().flat_map(|c| order(c as u32))).collect());
        }
        for bytes in all {
            let read = decoded(&bytes, None);
            assert_eq!((read.text.as_ref(), read.is_damaged), (text, false), "{:?}", &bytes[..4]);
            assert_eq!(in_utf8(&bytes), text.as_bytes(), "{:?}", &bytes[..4]);
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
        let numbers: Vec<u8> = (0x41_u32..0x61).flat_map(u32::to_le_bytes).collect();
        for bytes in [
            &b"\0\0\0\0"[..],
            b"ab\0\0",
            b"a\0",
            b"a",
            b"",
            b"\0a\0\0",
            b"\0\0\0\0\0\0",
            b"glTF\x02\0\0\0",
            b"a\0b\0\0\0c\0",
            &numbers,
        ] {
            assert_eq!(Wide::of(bytes), None, "{bytes:?}");
            assert_eq!(in_utf8(bytes), bytes);
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
