//! Reads text that people wrote: of a sane size, in UTF-8, or with an error that says what is wrong.

use super::encoding::{in_utf8, with_line_feeds};
use super::file_error::Fault;
use super::standard::{self, is_standard};
use std::borrow::Cow;
use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::Path;

/// Reads the text of a file of up to `limit` bytes.
pub(super) fn read(path: &Path, limit: u64) -> Result<String, Fault> {
    utf8(read_bytes(path, limit)?)
}

/// Reads a file of up to `limit` bytes. The limit also binds files that grow or have no size of their own. The path `-` is
/// standard input.
pub(super) fn read_bytes(path: &Path, limit: u64) -> Result<Vec<u8>, Fault> {
    if is_standard(path) {
        return within(standard::input().map_err(unreadable)?.to_vec(), limit);
    }
    within(content(path, limit)?, limit)
}

/// Reads a file up to one byte beyond a limit; that byte shows a reader that the file is longer.
pub(super) fn content(path: &Path, limit: u64) -> Result<Vec<u8>, Fault> {
    if path.metadata().map_err(unreadable)?.is_dir() {
        return Err("this is a directory; a file is expected".into());
    }
    let mut bytes = Vec::new();
    File::open(path).and_then(|file| file.take(limit + 1).read_to_end(&mut bytes)).map_err(unreadable)?;
    Ok(bytes)
}

/// Makes the fault of a file that the file system cannot read.
pub(super) fn unreadable(error: std::io::Error) -> Fault {
    match error.kind() {
        ErrorKind::NotFound => "there is no such file".into(),
        _ => format!("cannot be read: {error}").into(),
    }
}

/// Returns bytes if there are some, and no more than a limit.
fn within(bytes: Vec<u8>, limit: u64) -> Result<Vec<u8>, Fault> {
    check_size(bytes.len(), limit)?;
    if bytes.is_empty() { Err("the file is empty".into()) } else { Ok(bytes) }
}

/// Checks that a file of so many bytes is no larger than a limit.
pub(super) fn check_size(bytes: usize, limit: u64) -> Result<(), Fault> {
    if bytes as u64 <= limit {
        return Ok(());
    }
    Err(format!("this is larger than {} MiB, too large for a file of this kind", limit >> 20).into())
}

/// Converts bytes in UTF-8, UTF-16 or UTF-32 to text whose lines end in line feeds; the error names a picture's format or the
/// line that is no UTF-8.
pub(super) fn utf8(bytes: Vec<u8>) -> Result<String, Fault> {
    let decoded = match in_utf8(&bytes) {
        Cow::Borrowed(text) if text.len() == bytes.len() => None,
        text => Some(text.into_owned()),
    };
    let text = decoded.unwrap_or(bytes);
    let tidied = match with_line_feeds(&text) {
        Cow::Borrowed(_) => None,
        Cow::Owned(tidied) => Some(tidied),
    };
    String::from_utf8(tidied.unwrap_or(text)).map_err(|error| {
        let kinds: [(&[u8], &str); 4] =
            [(b"\x89PNG", "PNG"), (b"\xff\xd8\xff", "JPEG"), (b"GIF8", "GIF"), (b"%PDF", "PDF")];
        if let Some((_, kind)) = kinds.iter().find(|(start, _)| error.as_bytes().starts_with(start)) {
            return format!("this is a {kind}, where text is expected").into();
        }
        let valid = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        Fault::line(line_after(valid), "this is not UTF-8 text; save the file as UTF-8")
    })
}

/// Returns the number, from 1, of the line that follows this text.
pub(super) fn line_after(text: &[u8]) -> usize {
    1 + text.iter().filter(|byte| **byte == b'\n').count()
}

/// Returns the known name that is most like an unknown one, if a few slips of typing make the one from the other.
pub(crate) fn nearest<'k>(asked: &str, known: &[&'k str]) -> Option<&'k str> {
    // One slip in three letters is still a slip; with more, it is another word.
    let letters = asked.chars().count();
    let most = (letters / 3).min(3);
    let slips = |name: &&str| strsim::damerau_levenshtein(asked, name);
    // Names of very different lengths are not compared, since the unknown name may be as long as a file.
    let alike = known.iter().copied().filter(|name| name.chars().count().abs_diff(letters) <= most);
    alike.min_by_key(slips).filter(|name| slips(name) <= most)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_of_editors_is_read_in_every_encoding_and_with_every_end_of_lines() {
        let text = "name = \"Brücke 字\"\nangle = 40.75\n";
        let wide = |mark: &[u8], order: fn(u16) -> [u8; 2]| -> Vec<u8> {
            mark.iter().copied().chain(text.encode_utf16().flat_map(order)).collect()
        };
        for bytes in [
            text.as_bytes().to_vec(),
            format!("\u{feff}{text}").into_bytes(),
            wide(b"\xff\xfe", u16::to_le_bytes),
            wide(b"\xfe\xff", u16::to_be_bytes),
            wide(b"", u16::to_le_bytes),
            text.replace('\n', "\r").into_bytes(),
        ] {
            assert_eq!(utf8(bytes.clone()), Ok(text.to_owned()), "{bytes:?}");
        }
        assert_eq!(utf8(b"a\nb \xfc".to_vec()).unwrap_err().line, Some(2));
    }

    #[test]
    fn the_nearest_name_is_one_that_a_few_slips_make_of_what_was_asked() {
        let known = ["row", "ring", "parcel", "round_brilliant"];
        let pairs = [("rig", Some("ring")), ("raw", Some("row")), ("prcael", Some("parcel"))];
        for (asked, near) in pairs.into_iter().chain([
            ("round_brlint", Some("round_brilliant")),
            ("pin", None),
            ("ro", None),
            ("rain", None),
        ]) {
            assert_eq!(nearest(asked, &known), near, "{asked}");
        }
        assert_eq!((nearest("round", &known), nearest("", &known), nearest("row", &[])), (None, None, None));
    }
}
