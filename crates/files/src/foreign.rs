//! Names files of other programs that hold shapes and are not read, and says what to do with them.

use super::encoding::{in_utf8, with_line_feeds};

/// The number of bytes of a file that are examined.
const LOOKED_AT: usize = 16 << 10;

/// The place in a line of IGES where the letter of its section stands.
const IGES_SECTION: usize = 72;

/// Formats by the bytes that their files begin with.
const BEGINNINGS: [(&[u8], &str); 28] = [
    (b"ISO-10303-21", "STEP"),
    (b"3D Geometry File Format", "3DM, of Rhino"),
    (b"AutoCAD Binary DXF", "DXF"),
    (b"AC10", "DWG, of AutoCAD"),
    (b"Kaydara FBX", "FBX"),
    (b"; FBX", "FBX"),
    (b"BLENDER", "a scene of Blender"),
    (b"#VRML", "VRML"),
    (b"#Inventor", "Open Inventor"),
    (b"PXR-USDC", "USD"),
    (b"#usda", "USD"),
    (b"//Maya", "a scene of Maya"),
    (b"**ABCDEFGHIJKLMNOPQRSTUVWXYZ", "Parasolid"),
    (b"ACIS", "ACIS"),
    (b"DRACO", "Draco"),
    (b"newmtl", "MTL, the materials of an OBJ"),
    (b"\xff\xfe\xff\x0eS\0k\0e\0t\0c\0h\0U\0p\0", "a model of SketchUp"),
    (b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1", "a compound file, as of SolidWorks"),
    (b"xof ", "X, of DirectX"),
    (b"# vtk DataFile", "VTK"),
    (b"# .PCD", "PCD, a cloud of points"),
    (b"$MeshFormat", "MSH, of Gmsh"),
    (b"OCTM", "OpenCTM"),
    (b"DBRep_DrawableShape", "BREP, of Open CASCADE"),
    (b"\x89PNG", "PNG, a picture"),
    (b"\xff\xd8\xff", "JPEG, a picture"),
    (b"GIF8", "GIF, a picture"),
    (b"%PDF", "PDF"),
];

/// Formats of XML by their root elements, in small letters.
const ROOTS: [(&str, &str); 5] =
    [("<collada", "COLLADA"), ("<x3d", "X3D"), ("<amf", "AMF"), ("<svg", "SVG"), ("<model", "3MF")];

/// Messages about files that stand for another, by their beginnings in small letters.
const STAND_INS: [(&[u8], &str); 3] = [
    (b"<!doctype html", "this is a web page; download the file that it is about"),
    (b"<html", "this is a web page; download the file that it is about"),
    (b"version https://git-lfs", "this is a pointer of Git LFS; fetch the file that it stands for"),
];

/// The words that begin a file of OFF, in small letters.
const OFF: [&[u8]; 5] = [b"off", b"coff", b"noff", b"cnoff", b"stoff"];

/// The formats that are read.
const READ: &str = "designs as .toml, .asc, .gem and .gcs, and meshes as glTF, OBJ, STL and PLY are read";

/// Archives and packed files by the bytes that they begin with.
const PACKED: [(&[u8], &str); 7] = [
    (b"\x1f\x8b", "gzip"),
    (b"PK\x03\x04", "ZIP"),
    (b"7z\xbc\xaf\x27\x1c", "7-Zip"),
    (b"Rar!\x1a\x07", "RAR"),
    (b"\xfd7zXZ\0", "xz"),
    (b"BZh", "bzip2"),
    (b"\x28\xb5\x2f\xfd", "Zstandard"),
];

/// Files within a ZIP archive by which its format is known.
const WITHIN: [(&[u8], &str); 3] = [(b"3D/3dmodel.model", "3MF"), (b".usdc", "USDZ"), (b".usda", "USDZ")];

/// Returns the message about a file that is of a known format and not read; `None` for any other file.
pub(super) fn refusal(bytes: &[u8]) -> Option<String> {
    let beginning = &bytes[..bytes.len().min(LOOKED_AT)];
    let lower = beginning.to_ascii_lowercase();
    let holds = |name: &[u8]| lower.windows(name.len()).any(|part| part == name.to_ascii_lowercase());
    if let Some((_, packer)) = PACKED.iter().find(|(magic, _)| beginning.starts_with(magic)) {
        return Some(match WITHIN.iter().find(|(name, _)| *packer == "ZIP" && holds(name)) {
            Some((_, format)) => message(format),
            None => format!("this is a file packed by {packer}; unpack it, and open what it holds"),
        });
    }
    let text = in_utf8(beginning);
    let start = text.trim_ascii_start();
    let small = start.to_ascii_lowercase();
    if let Some((_, message)) = STAND_INS.iter().find(|(start, _)| small.starts_with(start)) {
        return Some((*message).to_owned());
    }
    if is_3ds(bytes) {
        return Some(message("3DS, of 3D Studio"));
    }
    let by_start =
        || BEGINNINGS.iter().find(|(magic, _)| beginning.starts_with(magic) || start.starts_with(magic));
    let by_root = || {
        let text = String::from_utf8_lossy(&small);
        ROOTS.iter().find(|(root, _)| text.starts_with('<') && text.contains(root)).map(|(_, format)| *format)
    };
    let found = by_start().map(|(_, format)| *format).or_else(by_root).or_else(|| by_lines(&text));
    found.map(message)
}

fn message(format: &str) -> String {
    format!("this is {format}; {READ}: save it as one of them")
}

/// Returns the message about a file that is of no known format, by its content or by its name.
pub(super) fn unknown() -> String {
    format!("this is not a design: {READ}")
}

/// Returns whether bytes may be a text of keys and values, as TOML is: its first line that is neither empty nor a remark has a
/// key with a value, or a table's name.
pub(super) fn has_keys(bytes: &[u8]) -> bool {
    let text = with_line_feeds(&in_utf8(&bytes[..bytes.len().min(LOOKED_AT)])).into_owned();
    let is_key = |c: char| c.is_alphanumeric() || "_-.\"' ".contains(c);
    let has_key = |line: &str| match line.split_once('=') {
        Some((key, _)) => !key.trim().is_empty() && key.trim().chars().all(is_key),
        None => {
            line.starts_with('[') && line.split('#').next().is_some_and(|name| name.trim_end().ends_with(']'))
        }
    };
    let text = String::from_utf8_lossy(&text);
    let mut lines = text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'));
    !text.contains('\0') && lines.next().is_some_and(has_key)
}

/// Returns whether bytes are one chunk of 3D Studio that is as long as it says.
fn is_3ds(bytes: &[u8]) -> bool {
    let length = bytes.get(2..6).and_then(|length| length.try_into().ok()).map(u32::from_le_bytes);
    bytes.starts_with(b"MM") && length.is_some_and(|length| length as usize == bytes.len())
}

/// Returns the format of a text that is known by its first lines.
fn by_lines(text: &[u8]) -> Option<&'static str> {
    let mut lines = text.split(|byte| *byte == b'\n');
    let first = lines.next()?;
    let is_iges =
        first.len() > IGES_SECTION && first[IGES_SECTION] == b'S' && first.trim_ascii_end().ends_with(b"1");
    if is_iges {
        return Some("IGES");
    }
    if is_off(text) {
        return Some("OFF");
    }
    // DXF is made of pairs of lines, a number and a value; 999 is a comment.
    let pairs: Vec<&[u8]> = std::iter::once(first).chain(lines).take(64).map(<[u8]>::trim_ascii).collect();
    let mut pairs = pairs.as_chunks::<2>().0.iter().skip_while(|[code, _]| *code == b"999");
    pairs.next().filter(|pair| **pair == [b"0".as_slice(), b"SECTION"]).map(|_| "DXF")
}

/// Returns whether the first line that is no comment begins with a word of OFF; a key of TOML may be called so too.
fn is_off(text: &[u8]) -> bool {
    let mut lines = text.split(|byte| *byte == b'\n').map(<[u8]>::trim_ascii);
    let Some(line) = lines.find(|line| !line.is_empty() && !line.starts_with(b"#")) else { return false };
    let end = line.iter().position(u8::is_ascii_whitespace).unwrap_or(line.len());
    let (word, rest) = line.split_at(end);
    OFF.contains(&&*word.to_ascii_lowercase()) && !rest.trim_ascii_start().starts_with(b"=")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_other_programs_are_named_with_what_is_read() {
        let iges = format!("{:72}S      1\n", "made here");
        let utf16: Vec<u8> = "ISO-10303-21;\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
        let zip = |name: &str| [b"PK\x03\x04".as_slice(), &[0; 26], name.as_bytes()].concat();
        for (bytes, format) in [
            (b"ISO-10303-21;\nHEADER;".to_vec(), "this is STEP; "),
            (b"\n  ISO-10303-21;".to_vec(), "this is STEP; "),
            (utf16, "this is STEP; "),
            (b"  0\r\nSECTION\r\n  2\r\n".to_vec(), "this is DXF; "),
            (b"999\nmade\n0\nSECTION\n".to_vec(), "this is DXF; "),
            (b"3D Geometry File Format        4".to_vec(), "this is 3DM, of Rhino; "),
            (b"OFF\n4 4 6\n".to_vec(), "this is OFF; "),
            (b"# made here\r\n\r\ncoff\r\n4 4 6\r\n".to_vec(), "this is OFF; "),
            (b"OFF 8 6 0\n".to_vec(), "this is OFF; "),
            (b"MM\x08\0\0\0\0\0".to_vec(), "this is 3DS, of 3D Studio; "),
            (b"\n<!DOCTYPE HTML>\n<html>".to_vec(), "this is a web page; download"),
            (b"version https://git-lfs.github.com/spec/v1\n".to_vec(), "this is a pointer of Git LFS; fetch"),
            (b"\x89PNG\r\n".to_vec(), "this is PNG, a picture; "),
            (iges.into_bytes(), "this is IGES; "),
            (b"<?xml version='1.0'?>\n<COLLADA>".to_vec(), "this is COLLADA; "),
            (zip("3D/3dmodel.model"), "this is 3MF; "),
            (zip("stone.obj"), "this is a file packed by ZIP; unpack it"),
            (b"\x1f\x8b\x08\0".to_vec(), "this is a file packed by gzip; unpack it"),
        ] {
            let found = refusal(&bytes).unwrap_or_default();
            assert!(found.starts_with(format), "{format}: {found}");
        }
        for own in [
            "",
            "format = 1",
            "GemCad 5.0\n",
            "v 1 2 3\n",
            "solid a\n",
            "{\"asset\"",
            "ply\n",
            "name = \"OFF\"",
            "off = 1",
            "OFFSET = 3",
        ] {
            assert_eq!(refusal(own.as_bytes()), None, "{own}");
        }
        assert_eq!(refusal(&[0; 100]), None);
    }

    #[test]
    fn a_text_of_keys_is_told_from_other_files() {
        for keyed in [
            "format = 1\n",
            "\n# x\n[round_brilliant]\n",
            "\u{feff}name=\"a\"",
            "# a title\n\ntier.angle = 3",
            "a = 1\rb = 2",
        ] {
            assert!(has_keys(keyed.as_bytes()), "{keyed}");
        }
        for other in [
            "",
            "8 6 0\n0 0 0\n",
            "polyhedron(points=[",
            "<a b=\"c\"/>",
            "a = 1\0",
            "hello",
            "= 3",
            "# Title\n\nProse.\n\n[a]\nb = 1\n",
        ] {
            assert!(!has_keys(other.as_bytes()), "{other}");
        }
    }
}
