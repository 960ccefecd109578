//! Content that programs rarely write is read, or refused with its place and what to do.

use super::*;
use serde_json::{Value, json};

fn message(bytes: impl Into<Vec<u8>>) -> String {
    parse(bytes.into(), "f", None).unwrap_err().to_string()
}

fn ascii() -> String {
    String::from_utf8(ply("ascii")).unwrap()
}

fn root() -> Value {
    serde_json::from_str(&gltf()).unwrap()
}

fn opened(root: &Value) -> Result<MeshFile, FileError> {
    parse(root.to_string().into_bytes(), "f", None)
}

#[test]
fn headers_and_rows_of_ply_that_are_wrong_are_told_with_their_line_and_what_to_do() {
    let second = "element face 4";
    for (from, to, expected) in [
        (
            "format ascii",
            "format text",
            "f:2: the format `text` is not known; save the file with one of ascii",
        ),
        ("format ascii 1.0\n", "", "f:10: the header has no line of its format"),
        ("vertex 4", "vertex -4", "f:4: element `vertex`: `-4` is not a number of rows"),
        ("vertex 4", "vertex many", "f:4: element `vertex`: `many` is not a number of rows"),
        ("float z", "half z", "f:7: property `z`: the type `half` is not read; char, uchar"),
        ("float z", "list uchar z", "f:7: a type and a name are expected after `property`"),
        ("float z", "float x", "f:7: property `x`: it is announced a second time"),
        (second, "element vertex 4", "f:9: element `vertex` is announced a second time"),
        ("comment made here", "property float q", "f:3: property `q`: a line of the element"),
        (
            "1 0 0 255",
            "1 0 0 256",
            "f:13: row 2 of element `vertex`: `256` is no number of the type of `red`, uchar",
        ),
        (
            "1 0 0 255",
            "1 0 0 2.5",
            "f:13: row 2 of element `vertex`: `2.5` is no number of the type of `red`, uchar",
        ),
        ("3 0 1 3", "-3 0 1 3", "f:17: row 2 of element `face`: `-3` is not the length of a list"),
        (
            "3 0 1 3",
            "4 0 1 3",
            "f:17: row 2 of element `face`: it has 4 numbers, and 5 or more are announced",
        ),
        (second, "element face 6", "f: 6 rows of element `face` are announced, and 4 are there"),
        ("list uchar int", "int", "f: header: `vertex_indices` of element `face` must be a list of numbers"),
        ("float x", "list uchar float x", "f: header: `x` of element `vertex` must be a number"),
    ] {
        let text = ascii();
        assert!(text.contains(from), "{from}");
        let error = message(text.replacen(from, to, 1));
        assert!(error.starts_with(expected), "{error}\nexpected {expected}");
        assert!(!error.contains("Error") && !error.contains("String:"), "{error}");
    }
    let binary = ply("binary_little_endian");
    let cut = message(&binary[..binary.len() - 5]);
    assert!(
        cut.starts_with("f: element face: the file ends before its 4 rows: it has been cut off"),
        "{cut}"
    );
}

#[test]
fn what_a_ply_holds_beside_its_rows_is_left_out_with_a_warning() {
    let binary = ply("binary_big_endian");
    let behind = [binary.as_slice(), &[7; 40]].concat();
    for (bytes, warning) in [
        (ascii().replace("float x", "float X").replace("element vertex", "ELEMENT Vertex").into_bytes(), ""),
        (ascii().replace("property", "PROPERTY").into_bytes(), ""),
        (
            ascii().replace(" 255", " 255 9 9").into_bytes(),
            "line 12: 4 rows have more numbers than the header",
        ),
        ((ascii() + "\n3 0 1 2\n").into_bytes(), "1 lines behind the last row are left out"),
        (behind, "40 bytes behind the last row are left out"),
        ([binary.as_slice(), b"\r\n"].concat(), ""),
    ] {
        let file = open(bytes);
        assert!((volume(&file) - 1.0 / 6.0).abs() < 1e-9);
        let told = file.warnings.join("; ");
        assert!(
            told.contains(warning) && told.is_empty() == warning.is_empty(),
            "{told}\nexpected {warning}"
        );
    }
    // The mark of the end and the zeros of older systems are not lines.
    for end in ["\u{1a}", "\0\0\0\0", "\n \n\u{1a}\n"] {
        let file = open((ascii() + end).into_bytes());
        assert_eq!(file.warnings, [""; 0], "{end:?}");
    }
}

#[test]
fn a_second_stl_behind_a_first_is_left_out_with_a_warning() {
    let stl = write_stl(&body(16), 1.0, None).unwrap();
    let both = parse([stl.as_slice(), &stl].concat(), "stone.stl", None).unwrap();
    assert_eq!(both.surface.triangles.len(), open(stl.clone()).surface.triangles.len());
    assert!(
        both.warnings[0].contains(&format!("{} bytes behind them are left out", stl.len())),
        "{:?}",
        both.warnings
    );
}

#[test]
fn copies_of_a_mesh_are_read_where_they_are_placed() {
    let mut root = root();
    let places = [[9.0_f32, 0.0, 0.0], [0.0, 9.0, 0.0]];
    let turns = [[0_i16, 0, 0, 32767], [0, 0, 32767, 0]];
    let bytes: Vec<u8> = places.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect();
    let bytes: Vec<u8> =
        bytes.into_iter().chain(turns.as_flattened().iter().flat_map(|x| x.to_le_bytes())).collect();
    let uri = format!("data:;base64,{}", {
        use base64::Engine as _;
        base64::engine::general_purpose::STANDARD.encode(&bytes)
    });
    root["buffers"].as_array_mut().unwrap().push(json!({ "byteLength": bytes.len(), "uri": uri }));
    root["bufferViews"].as_array_mut().unwrap().extend([
        json!({ "buffer": 1, "byteLength": 24 }),
        json!({ "buffer": 1, "byteOffset": 24, "byteLength": 16 }),
    ]);
    root["accessors"].as_array_mut().unwrap().extend([
        json!({ "bufferView": 2, "componentType": 5126, "count": 2, "type": "VEC3" }),
        json!({ "bufferView": 3, "componentType": 5122, "normalized": true, "count": 2, "type": "VEC4" }),
    ]);
    let copies = json!({ "EXT_mesh_gpu_instancing": { "attributes": { "TRANSLATION": 3, "ROTATION": 4 } } });
    (1..3).for_each(|node| root["nodes"][node]["extensions"] = copies.clone());
    root["extensionsRequired"] = json!(["EXT_mesh_gpu_instancing"]);
    for breaks_material in [false, true] {
        if breaks_material {
            root["materials"][0]["doubleSided"] = json!("x");
        }
        let file = opened(&root).unwrap();
        assert_eq!((file.surface.triangles.len(), file.warnings.len()), (8, usize::from(breaks_material)));
        let mended = file.surface.mend().unwrap();
        assert_eq!(mended.mending.shells, 2);
        assert!((mended.surface.volume() - 2.0 * 8.0 / 6.0).abs() < 1e-5);
        // The second copy is turned by half about z.
        let (low, high) = mended.surface.bounds();
        assert!(
            (low - DVec3::new(0.0, 4.0, 6.0)).length() < 1e-5
                && (high - DVec3::new(22.0, 22.0, 8.0)).length() < 1e-5
        );
    }
    root["accessors"][4]["count"] = 1.into();
    let told = opened(&root).unwrap_err().to_string();
    assert!(told.contains("node 1") && told.contains("[2, 1] places, turns and sizes"), "{told}");
    // A file that requires the extension and has no copies is read.
    let mut unused = self::root();
    unused["extensionsRequired"] = json!(["EXT_mesh_gpu_instancing", "KHR_meshopt_compression"]);
    assert_eq!(opened(&unused).unwrap().surface.triangles.len(), 4);
}

#[test]
fn meshes_that_no_scene_or_node_shows_are_read_with_a_note() {
    let mut empty = root();
    empty["scenes"] = json!([{}]);
    let file = opened(&empty).unwrap();
    assert!((volume(&file) - 8.0 / 6.0).abs() < 1e-9);
    assert_eq!(file.notes, ["no scene of the file has triangles; all its nodes are read"]);
    for without in [&["nodes"][..], &["nodes", "scenes", "scene"]] {
        let mut bare = root();
        bare["scenes"] = json!([{}]);
        without.iter().for_each(|key| drop(bare.as_object_mut().unwrap().remove(*key)));
        let file = opened(&bare).unwrap();
        assert!((volume(&file) - 1.0 / 6.0).abs() < 1e-9);
        assert_eq!(
            file.notes,
            ["no node places the meshes of the file; they are read as they were modelled"]
        );
    }
    let mut hidden = root();
    hidden["nodes"][0]["extensions"] = json!({ "KHR_node_visibility": { "visible": false } });
    assert!(opened(&hidden).unwrap_err().to_string().contains("no triangles"));
}

#[test]
fn parts_of_a_gltf_that_contradict_it_are_told() {
    let placed = |matrix: &[f64]| json!({ "mesh": 0, "translation": [1, 2, 3], "matrix": matrix });
    let straight = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 2.0, 3.0, 1.0];
    let slanted: Vec<f64> = straight.iter().enumerate().map(|(k, x)| if k == 3 { 0.2 } else { *x }).collect();
    for (matrix, warning) in [
        (straight.as_slice(), "1 nodes state their places twice; those of their matrices are read"),
        (&slanted, "the matrices of 1 nodes do more than place; their last rows are left out"),
    ] {
        let mut root = root();
        root["nodes"][1] = placed(matrix);
        let told = opened(&root).unwrap().warnings.join("; ");
        assert!(told.contains(warning), "{told}");
    }
    let mut uneven = root();
    uneven["accessors"][1]["count"] = 8.into();
    let told = opened(&uneven).unwrap().warnings.join("; ");
    assert!(told.contains("the last corners of 1 parts make no whole triangle"), "{told}");
    for (place, value, expected) in [
        ("/nodes/1/matrix", json!([1, 0, 0]), "nodes/1/matrix: invalid length 3"),
        (
            "/accessors/0/count",
            json!(-3),
            "accessors/0/count: invalid value: integer `-3`, expected a whole number",
        ),
        (
            "/nodes/1/mesh",
            json!(5),
            "nodes[1].mesh refers to a part that is not in the file; save the file again",
        ),
        (
            "/accessors/0/sparse",
            json!({ "count": 1, "indices": { "bufferView": 1, "componentType": 5123, "byteOffset": 4 },
                    "values": { "bufferView": 0 } }),
            "",
        ),
        (
            "/accessors/0/sparse",
            json!({ "count": 2, "indices": { "bufferView": 1, "componentType": 5123, "byteOffset": 4 },
                    "values": { "bufferView": 0 } }),
            "accessor 0: it has a sparse value at place 1, where rising places below 4 are expected",
        ),
        (
            "/accessors/0/sparse",
            json!({ "count": 1, "indices": { "bufferView": 0, "componentType": 5125, "byteOffset": 12 },
                    "values": { "bufferView": 0 } }),
            "accessor 0: it has a sparse value at place 1065353216",
        ),
    ] {
        let mut root = root();
        let (object, key) = place.rsplit_once('/').unwrap();
        root.pointer_mut(object).unwrap()[key] = value;
        let told = opened(&root).map_or_else(|error| error.to_string(), |_| String::new());
        assert!(
            told.contains(expected) && told.is_empty() == expected.is_empty(),
            "{told}\nexpected {expected}"
        );
    }
}

#[test]
fn an_obj_behind_a_long_comment_is_read() {
    let text = format!("# {}\n{}", "x".repeat(200_000), obj_text());
    let file = parse(text.into_bytes(), "a.obj", None).unwrap();
    assert!((volume(&file) - 1.0 / 6.0).abs() < 1e-9);
}
