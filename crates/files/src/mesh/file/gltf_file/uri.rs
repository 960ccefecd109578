//! Reads what the address of a buffer or an image stands for: bytes that are written in it, or a file beside the glTF file.

use super::super::limits;
use base64::Engine as _;
use base64::alphabet::{STANDARD, URL_SAFE};
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use brillianteer_base::Fault;
use std::borrow::Cow;
use std::path::{Path, PathBuf};

/// Browsers read base64 without its padding.
const TOLERANT: GeneralPurposeConfig = GeneralPurposeConfig::new()
    .with_decode_padding_mode(DecodePaddingMode::Indifferent)
    .with_decode_allow_trailing_bits(true);

/// The beginning of an address that holds its bytes itself.
const DATA: &str = "data:";

/// Returns the bytes that an address stands for; `folder` is that of the glTF file.
pub(super) fn read(uri: &str, folder: Option<&Path>) -> Result<Vec<u8>, Fault> {
    let scheme = uri.trim_start().split_at_checked(DATA.len());
    if let Some((_, rest)) = scheme.filter(|(scheme, _)| scheme.eq_ignore_ascii_case(DATA)) {
        return written_out(rest);
    }
    let decoded = |uri| percent_encoding::percent_decode_str(uri).decode_utf8_lossy();
    let name = decoded(uri);
    // Some programs write names as they are, though they hold a percent sign; some add a query for a server.
    let bare = uri.split(['?', '#']).next().unwrap_or_default();
    let paths = [name.clone(), uri.into(), decoded(bare)];
    // A percent sign hides no way out of the folder.
    let folder = folder.filter(|folder| within(folder, &paths[2]).is_some());
    let paths: Vec<PathBuf> = paths.iter().filter_map(|name| within(folder?, name)).collect();
    let Some(path) = paths.iter().find(|path| path.exists()).or(paths.first()) else {
        return Err(format!(
            "`{name:.80}` is not a file beside this one or below; put it there, or embed it"
        )
        .into());
    };
    limits::bytes(path).map_err(|fault| Fault::whole(format!("{name}: {fault}")))
}

/// Returns the file of a relative path within a folder, whose parts `.` and `..` are taken out as in addresses (RFC 3986,
/// section 5.2.4), whatever lies on the disk. Only files within the folder are read: an untrusted mesh must not make the
/// program read others.
fn within(folder: &Path, name: &str) -> Option<PathBuf> {
    let is_absolute = name.starts_with(['/', '\\']) || name.contains([':', '\0']);
    let mut parts = vec![];
    for part in name.split(['/', '\\']) {
        match part {
            "" | "." => {}
            ".." => drop(parts.pop()?),
            part => parts.push(part),
        }
    }
    (!parts.is_empty() && !is_absolute).then(|| folder.join(parts.iter().collect::<PathBuf>()))
}

/// Returns the bytes of an address that holds them itself, behind `data:`.
fn written_out(rest: &str) -> Result<Vec<u8>, Fault> {
    let (kind, text) =
        rest.split_once(',').ok_or("a comma is expected in an address that begins with `data:`")?;
    let bytes: Cow<'_, [u8]> = percent_encoding::percent_decode_str(text).into();
    if !kind.trim_end().to_ascii_lowercase().ends_with(";base64") {
        return Ok(bytes.into_owned());
    }
    let digits: Vec<u8> = bytes.iter().copied().filter(|byte| !byte.is_ascii_whitespace()).collect();
    let is_safe = digits.iter().any(|byte| matches!(byte, b'-' | b'_'));
    let alphabet = if is_safe { &URL_SAFE } else { &STANDARD };
    let decoded = GeneralPurpose::new(alphabet, TOLERANT).decode(digits);
    let problem =
        "the bytes that stand in it are not base64; save the file again, or with a buffer beside it";
    decoded.map_err(|_| problem.into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_in_an_address_are_read_in_every_writing() {
        let bytes = [0xfb_u8, 0xef, 0xbe, 0xff];
        for uri in [
            "data:application/octet-stream;base64,++++/w==",
            "data:application/octet-stream;base64,++++/w",
            "data:;charset=x;BASE64,%2B%2B%2B%2B%2Fw%3D%3D",
            "data:application/gltf-buffer;base64,----_w",
            "data:;base64, ++++\n /w==",
            "data:application/octet-stream,%FB%EF%BE%FF",
            "DATA:;BASE64,++++/w==",
        ] {
            assert_eq!(read(uri, None).unwrap(), bytes, "{uri}");
        }
        for broken in ["data:", "data:;base64,###", "data:;base64,A"] {
            assert!(read(broken, None).is_err(), "{broken}");
        }
    }

    #[test]
    fn only_files_within_the_folder_are_read() {
        let folder = Path::new("/a/b");
        for (name, path) in [
            ("c.bin", "/a/b/c.bin"),
            ("./d/c.bin", "/a/b/d/c.bin"),
            ("d\\c.bin", "/a/b/d/c.bin"),
            ("d/../c.bin", "/a/b/c.bin"),
            ("d/./e/../../f/c.bin", "/a/b/f/c.bin"),
        ] {
            assert_eq!(within(folder, name).as_deref(), Some(Path::new(path)), "{name}");
        }
        for outside in [
            "../c",
            "d/../../c",
            "d/../../b/c",
            "d/..",
            "/c",
            "\\c",
            "C:\\c",
            "file:///c",
            "",
            ".",
            "./",
            "..",
            "a\0b",
        ] {
            assert_eq!(within(folder, outside), None, "{outside}");
        }
    }

    #[test]
    fn a_query_behind_the_name_of_a_file_is_no_part_of_it() {
        let folder = tempfile::tempdir().unwrap();
        for (name, byte) in [("c.bin", 1), ("d#1.bin", 2), ("e f%.bin", 3)] {
            std::fs::write(folder.path().join(name), [byte]).unwrap();
        }
        for (uri, byte) in [
            ("c.bin", 1),
            ("c.bin?v=2", 1),
            ("./d/../c.bin#x", 1),
            ("%63.bin?a:b", 1),
            ("d#1.bin", 2),
            ("d%231.bin", 2),
            ("e%20f%.bin", 3),
        ] {
            assert_eq!(read(uri, Some(folder.path())).unwrap(), [byte], "{uri}");
        }
        let missing = read("g.bin?v=2", Some(folder.path())).unwrap_err().to_string();
        assert_eq!(missing, "g.bin?v=2: there is no such file");
    }
}
