//! Faults of mesh files name their place and what was expected, and no damage makes reading panic.

use super::*;
use proptest::prelude::*;

fn message(bytes: impl Into<Vec<u8>>) -> String {
    parse(bytes.into(), "f", None).unwrap_err().to_string()
}

#[test]
fn faults_are_told_with_their_place_and_what_was_expected() {
    let obj = obj_text();
    let cases = [
        (obj.replace("v 1 0 0", "v 1 zero 0"), "f:4: 'zero' is not a number"),
        (obj.replace("f 1/1 3/1 2/1", "f 1 x 2"), "f:8: three or more numbers of corners"),
        (obj.replace("f -3 -2 -1", "f 1 2 7"), "f:10: the face refers to corner 7, and the file has 4"),
        (
            obj.replace("f 1/1 3/1 2/1", "f 0 1 2"),
            "f:8: the face refers to corner 0; numbers of corners count from 1",
        ),
        (obj.replace("f -3 -2 -1", "f -3 -2 -9"), "f:10: the face refers to corner -9, and 4 are above it"),
        (
            obj.replace("v 1 0 0", "v 1, 0, 0"),
            "f:4: '1,' is not a number; write a decimal point, and blanks between",
        ),
        (obj.replace("v ", "v nan "), "f: corner 1: [NaN, "),
        ("v 0 0 0\n".to_owned(), "f: this holds no triangles"),
        (stl_text().replacen("vertex 1 0 0", "vertex 1 o 0", 1), "f:6: 'o' is not a number"),
        (
            stl_text().replacen("vertex 1 0 0", "vertex 1 0", 1),
            "f:6: three numbers are expected after `vertex`",
        ),
        (
            stl_text().replace("vertex 0 0", "vertex inf 0"),
            "f: corner 1: [inf, 0, 0] is not a finite position",
        ),
        (gltf().replace("\"2.0\"", "\"2.0"), "f:1: this glTF 2.0 cannot be read"),
        (
            gltf().replace("\"count\":4", "\"count\":5"),
            "f: mesh 0, primitive 0, accessor 0: 5 values of 12 bytes from 0",
        ),
        (
            gltf().replace("\"count\":9", "\"count\":0"),
            "f: mesh 0, primitive 0, accessor 1: it has no values",
        ),
        (gltf().replace("\"count\":9", "\"count\":18446744073709551615"), "f:"),
        (gltf().replace("\"byteLength\":24", "\"byteLength\":9024"), "f: mesh 0, primitive 0, accessor 1: "),
        (
            gltf().replace("\"byteLength\":72", "\"byteLength\":73"),
            "f: buffer 0: 73 bytes are announced, and 72",
        ),
        (gltf().replace("\"mesh\":0,", "\"mesh\":7,"), "f: this glTF 2.0 cannot be read: nodes[1].mesh"),
        (gltf().replace("[1,2],\"scale\"", "[1,2,0],\"scale\""), "f: node "),
        (gltf().replace("\"POSITION\"", "\"NORMAL\""), "f:"),
        (
            gltf().replace("\"POSITION\":0", "\"POSITION\":8"),
            "f: mesh 0: POSITION refers to accessor 8, and there are 3",
        ),
        (
            gltf().replacen("5126", "5125", 1),
            "f: mesh 0, primitive 0, accessor 0: its values are Vec3 of UNSIGNED_INT; Vec3 of FLOAT, BYTE, ",
        ),
        (
            gltf().replace("[\"KHR_materials_dispersion\"]", "[\"KHR_meshopt_compression\"]").replacen(
                "\"byteLength\":24",
                "\"byteLength\":24,\"extensions\":{\"KHR_meshopt_compression\":{}}",
                1,
            ),
            "f: extensionsRequired: the shape is written with KHR_meshopt_compression, which is not read",
        ),
    ];
    for (text, expected) in cases {
        let error = message(text);
        assert!(error.starts_with(expected), "{error}\nexpected {expected}");
    }
    let ascii = String::from_utf8(ply("ascii")).unwrap();
    let cases = [
        (ascii.replace("vertex 4", "vertex 9999999999"), "f: element vertex: 9999999999 rows"),
        (ascii.replace("1 0 0 255", "1 x 0 255"), "f:13: 'x' is not a number"),
        (
            ascii.replace("1 0 0 255", "1 0 0"),
            "f:13: row 2 of element `vertex`: it has 3 numbers, and 4 or more are announced",
        ),
        (ascii.replace("element face 4", "element face 0"), "f: this is a cloud of points without faces"),
        (
            ascii.replace("3 1 2 3", "3 1 2 4"),
            "f: face 3: it refers to corner 4, counted from 0, and there are 4",
        ),
        (ascii.replace("3 1 2 3", "3 1 2 -3"), "f: face 3: it refers to corner -3"),
        (ascii.replace("property float z\n", ""), "f: header: `z` of element `vertex` is expected"),
        (ascii.replace("end_header", "end_heade"), "f: the header has no end"),
        (ascii.replace("3 0 3 2\n", ""), "f:"),
    ];
    for (text, expected) in cases {
        let error = message(text);
        assert!(error.starts_with(expected), "{error}\nexpected {expected}");
    }
    let glb = write_glb(&body(16), "x", 1.0, (&MaterialHint::default(), None)).unwrap();
    assert!(message(&glb[..2000]).starts_with("f: offset 8: the header says "));
    let mut short = glb.clone();
    short[8..12].copy_from_slice(&3_u32.to_le_bytes());
    assert!(message(short).starts_with("f: offset 8: the header says 3 bytes"));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    #[test]
    fn no_file_makes_it_panic(
        kind in 0_usize..8,
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..8),
        cut in any::<prop::sample::Index>(),
        whole in any::<bool>(),
    ) {
        let mut bytes = match kind {
            0 => ply("ascii"),
            1 => ply("binary_little_endian"),
            2 => stl_text().into_bytes(),
            3 => obj_text().into_bytes(),
            4 => gltf().into_bytes(),
            5 => write_glb(&body(16), "x", 1.0, (&MaterialHint::default(), None)).unwrap(),
            6 => write_stl(&body(16), 1.0, None).unwrap(),
            _ => ply("binary_big_endian"),
        };
        for (place, value) in changes {
            let at = place.index(bytes.len());
            bytes[at] = value;
        }
        if !whole {
            bytes.truncate(cut.index(bytes.len() + 1));
        }
        let mended = parse(bytes, "f", None).ok().and_then(|file| file.surface.mend().ok());
        if let Some(SurfaceKind::Convex(found)) = mended.map(|mended| facets(mended.surface)) {
            let _ = from_mesh(&found, Up::Found, Evening::default());
        }
    }

    #[test]
    fn no_text_makes_it_panic(text in "(v|f|o|g|solid|facet|vertex|ply|[ \\n0-9./-]|\\{|\"asset\"|[a-z]){0,60}") {
        let _ = parse(text.into_bytes(), "f", None);
    }
}
