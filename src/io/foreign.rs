//! Names files of other programs that hold shapes and are not read, and says what to do with them.

use super::encoding::in_utf8;

/// The number of bytes of a file that are examined.
const LOOKED_AT: usize = 16 << 10;

/// The place in a line of IGES where the letter of its section stands.
const IGES_SECTION: usize = 72;

/// Formats by the bytes that their files begin with.
const BEGINNINGS: [(&[u8], &str); 23] = [
    (b"ISO-10303-21", "STEP"),
    (b"3D Geometry File Format", "3DM, of Rhino"),
    (b"AutoCAD Binary DXF", "DXF"),
    (b"AC10", "DWG, of AutoCAD"),
    (b"OFF", "OFF"),
    (b"COFF", "OFF"),
    (b"NOFF", "OFF"),
    (b"STOFF", "OFF"),
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
];

/// Formats of XML by their root elements.
const ROOTS: [(&str, &str); 5] =
    [("<COLLADA", "COLLADA"), ("<X3D", "X3D"), ("<amf", "AMF"), ("<svg", "SVG"), ("<model", "3MF")];

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
    let by_start =
        || BEGINNINGS.iter().find(|(magic, _)| beginning.starts_with(magic) || start.starts_with(magic));
    let by_root = || {
        let text = String::from_utf8_lossy(&text);
        ROOTS
            .iter()
            .find(|(root, _)| start.starts_with(b"<") && text.contains(root))
            .map(|(_, format)| *format)
    };
    let found = by_start().map(|(_, format)| *format).or_else(by_root).or_else(|| by_lines(&text));
    found.map(message)
}

fn message(format: &str) -> String {
    format!(
        "this is {format}; designs as .toml, .asc, .gem and .gcs, and meshes as glTF, OBJ, STL and PLY are read: save it \
         as one of them"
    )
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
    // DXF is made of pairs of lines, a number and a value; 999 is a comment.
    let pairs: Vec<&[u8]> = std::iter::once(first).chain(lines).take(64).map(<[u8]>::trim_ascii).collect();
    let mut pairs = pairs.as_chunks::<2>().0.iter().skip_while(|[code, _]| *code == b"999");
    pairs.next().filter(|pair| **pair == [b"0".as_slice(), b"SECTION"]).map(|_| "DXF")
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
        ] {
            assert_eq!(refusal(own.as_bytes()), None, "{own}");
        }
        assert_eq!(refusal(&[0; 100]), None);
    }
}
