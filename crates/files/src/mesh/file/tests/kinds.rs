//! The writings of each format that programs use, and that say the same.

use super::*;

/// Reads a file and returns the volume of its solid, and its warnings.
fn told(bytes: impl Into<Vec<u8>>) -> (f64, String) {
    let file = parse(bytes.into(), "f", None).unwrap();
    let mended = file.surface.mend().unwrap_or_else(|e| panic!("{}: {e}", file.warnings.join("; ")));
    (mended.surface.volume(), file.warnings.join("; "))
}

/// Asserts that every text makes the tetrahedron of the tests, with a warning that contains `warning`, or with none where that is
/// empty.
fn same(cases: &[(String, &str)]) {
    for (text, warning) in cases {
        let (volume, warnings) = told(text.as_bytes());
        assert!((volume - 1.0 / 6.0).abs() < 1e-9, "{volume}\n{text}");
        assert!(
            warnings.contains(warning) && warnings.is_empty() == warning.is_empty(),
            "{warnings}\n{text}"
        );
    }
}

#[test]
fn every_encoding_and_line_end_of_a_text_is_read() {
    for text in [obj_text(), stl_text(), String::from_utf8(ply("ascii")).unwrap()] {
        let blank_lines = text.replacen('\n', "\n \n\n", 3).replace("0 0 1", "0\t0  1 ");
        let blank_lines = blank_lines.replacen("ply\n \n\n", "ply\n", 1);
        let endless = text.trim_end().to_owned();
        for text in [text.replace('\n', "\r\n"), text.replace('\n', "\r"), blank_lines, endless] {
            let wide = |bytes: fn(u16) -> [u8; 2]| text.encode_utf16().flat_map(bytes).collect::<Vec<u8>>();
            let (little, big) = (wide(u16::to_le_bytes), wide(u16::to_be_bytes));
            let marked = |mark: &[u8], text: &[u8]| [mark, text].concat();
            for bytes in [
                text.as_bytes().to_vec(),
                marked(b"\xef\xbb\xbf", text.as_bytes()),
                marked(b"\xff\xfe", &little),
                marked(b"\xfe\xff", &big),
            ] {
                let (volume, warnings) = told(bytes);
                assert!(
                    (volume - 1.0 / 6.0).abs() < 1e-9 && warnings.is_empty(),
                    "{volume} {warnings}\n{text}"
                );
            }
        }
    }
}

#[test]
fn every_writing_of_obj_is_read() {
    let obj = obj_text();
    let comma = "has a decimal comma and is read as";
    same(&[
        (obj.replace("v ", "V ").replace("f ", "F "), ""),
        (obj.replace("v 1 0 0", "v １ \u{2212}0 +0"), ""),
        (obj.replace("v 1 0 0", "v 1.0D+00 0 0"), ""),
        (obj.replace("v 1 0 0", "v 1,0 0,0 0,0 # a corner"), comma),
        (obj.replace("v 1 0 0", "v 1.0e+00 .0 0. 0.5 0.5 0.5"), ""),
        (obj.clone() + "v nan nan nan\nl 1 2\np 1\nf 1 2\n", "1 faces of fewer than three corners"),
        (obj.replace("f -3 -2 -1", "f -3 -3 -2 -1 -1"), ""),
        (obj.clone() + "f 1 2 3\nf 3 2 1\nf 1 2 4\n", ""),
    ]);
}

#[test]
fn every_writing_of_stl_is_read() {
    let stl = stl_text();
    same(&[
        (stl.replace("facet normal 0 0 0", "facet normal nan inf -NaN"), ""),
        (stl.replace("facet normal 0 0 0", "facet normal"), ""),
        (stl.replace("facet normal 0 0 0", "facet normal -nan(ind) 1.#QNAN x"), ""),
        (stl.replace("outer loop", "outerloop"), ""),
        (stl.replace('\n', " "), ""),
        (stl.clone() + "\u{1a}\0\0", ""),
        (stl.replace("facet normal 0 0 0", "color 0.5 0.5 0.5\nfacet"), ""),
        (
            stl.replace("endloop", "end loop")
                .replace("endfacet", "end facet")
                .replace("endsolid", "end solid x"),
            "",
        ),
        (stl.replace("    endloop\n", ""), ""),
        (stl.replace("\n      vertex", " vertex"), ""),
        (stl.replace("vertex 1 0 0", "vertex 1,0 0,00 0,0"), "has a decimal comma"),
        (stl.replace("vertex 1 0 0", "VERTEX 1.0D+00 0 -0"), ""),
        (
            stl.replace("  endfacet", "  endfacet\n  remark: a\n  remark: b"),
            "line 9: `remark:` is not a word of STL",
        ),
        (
            stl.replace("endsolid", "facet outer loop vertex nan 0 0 vertex 0 0 0 vertex 1 0 0"),
            "1 triangle with",
        ),
        (
            stl.replace("endsolid", "facet outer loop vertex 0 0 0 vertex 1 0 0 endloop endfacet"),
            "1 facets of fewer",
        ),
    ]);
    let two = stl.replace("endsolid\n", "") + "endsolid\nsolid facet\nendsolid\n";
    assert!(told(two).1.contains("2 solids are in this file"));
}

#[test]
fn the_length_of_a_binary_stl_gives_the_number_of_its_triangles() {
    let stl = write_stl(&body(16), 1.0, None).unwrap();
    let count = u32::from_le_bytes(stl[80..84].try_into().unwrap());
    let with = |announced: u32, more: &[u8]| {
        let mut bytes = [stl.as_slice(), more].concat();
        bytes[..5].copy_from_slice(b"solid");
        bytes[80..84].copy_from_slice(&announced.to_le_bytes());
        told(bytes)
    };
    let (volume, warnings) = with(count, &[]);
    assert!(warnings.is_empty());
    for (announced, more, warns) in [
        (0, &[][..], true),
        (u32::MAX, &[], true),
        (count - 1, &[], true),
        (count + 1, &[], true),
        (count, b"made by someone", false),
        (u32::MAX, b"tail", true),
    ] {
        let (found, warnings) = with(announced, more);
        assert_eq!(found, volume, "{announced}");
        assert_eq!(
            warnings.contains(&format!("the file holds {count}, which are read")),
            warns,
            "{warnings}"
        );
    }
    // A file that was cut off says so, because the hole is the consequence.
    let path = Path::new("f.stl");
    let error = crate::mesh::read(stl[..stl.len() - 120].to_vec(), path, &Default::default()).unwrap_err();
    let text = error.to_string();
    assert!(text.contains("the last one has been cut off; the surface is open"), "{text}");
}

#[test]
fn every_writing_of_ply_is_read() {
    let ply = String::from_utf8(ply("ascii")).unwrap();
    let strips = ply
        .replace("element face 4", "element tristrips 1")
        .replace("3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n", "8 0 1 2 3 0 1 -1 0\n");
    same(&[
        (ply.replace("vertex_indices", "vertex_index"), ""),
        (ply.replace("list uchar int", "list int8 double"), ""),
        (ply.replace("list uchar int", "list int uint16"), ""),
        (
            ply.replace("property float z", "property double z").replace("1 0 0 255", "1,0 .0 0. 255"),
            "decimal comma",
        ),
        (ply.replace("element face", "comment end_header\nobj_info x\nTextureFile é\n\nelement face"), ""),
        (ply.replace("end_header\n", "element edge 1\nproperty int a\nend_header \n") + "5\n", ""),
        (ply.replace("uchar red", "float quality").replace("255", "nan"), ""),
        (strips, ""),
    ]);
}

#[test]
fn names_in_an_old_encoding_come_out_whole() {
    let latin = |text: String| text.chars().map(|c| c as u8).collect::<Vec<u8>>();
    let name = |bytes| parse(bytes, "f", None).unwrap().name;
    assert_eq!(name(latin(format!("o Brücke\n{}", obj_text()))), "Brücke");
    let stl = stl_text();
    let (first, rest) = stl.split_once('\n').unwrap();
    assert!(first.starts_with("solid"));
    assert_eq!(name(latin(format!("solid Brücke\n{rest}"))), "Brücke");
}

#[test]
fn what_a_text_lacks_is_read_by_the_name_of_its_file_or_said_with_its_line() {
    let stl = stl_text();
    let rest = stl.split_once('\n').unwrap().1.to_owned();
    for text in [rest.clone(), format!("# made by hand\n{stl}")] {
        assert!(parse(text.clone().into_bytes(), "f.stl", None).is_ok());
        let error = parse(text.into_bytes(), "f", None).unwrap_err().to_string();
        assert!(error.contains("this is not a mesh"), "{error}");
    }
    for (label, text, message) in [
        ("f.obj", "# a\nv 0;0;1\n", "f.obj:2: '0;0;1' is not a number"),
        ("f.gltf", "// a\n{\"asset\":{}}", "f.gltf:1: this glTF 2.0 cannot be read"),
        ("f.obj", "hello", "f.obj: this is not a mesh"),
        ("f.stl", "<!doctype html><p>vertex", "f.stl: this is a web page"),
    ] {
        let error = parse(text.as_bytes().to_vec(), label, None).unwrap_err().to_string();
        assert!(error.starts_with(message), "{error}");
    }
}

#[test]
fn polygons_of_every_format_are_cut_inside_their_outline() {
    // A prism on a star of four points, whose caps are concave.
    let ring = [(3, 0), (1, 1), (0, 3), (-1, 1), (-3, 0), (-1, -1), (0, -3), (1, -1)];
    let corners: Vec<[i32; 3]> = [0, 1].iter().flat_map(|&z| ring.map(|(x, y)| [x, y, z])).collect();
    let mut faces: Vec<Vec<usize>> = vec![(0..8).rev().collect(), (8..16).collect()];
    faces.extend((0..8).map(|k| vec![k, (k + 1) % 8, 8 + (k + 1) % 8, 8 + k]));
    let text = |c: &[i32; 3]| format!("{} {} {}", c[0], c[1], c[2]);
    let list =
        |face: &[usize], from: usize| face.iter().map(|c| format!(" {}", c + from)).collect::<String>();
    for start in 0..8 {
        let faces: Vec<Vec<usize>> = faces
            .iter()
            .map(|face| {
                let mut face = face.clone();
                let by = start % face.len();
                face.rotate_left(by);
                face
            })
            .collect();
        let obj = corners.iter().map(|c| format!("v {}\n", text(c))).collect::<String>()
            + &faces.iter().map(|f| format!("f{}\n", list(f, 1))).collect::<String>();
        let rows = corners.iter().map(|c| text(c) + "\n").collect::<String>()
            + &faces.iter().map(|f| format!("{}{}\n", f.len(), list(f, 0))).collect::<String>();
        let ply = format!(
            "ply\nformat ascii 1.0\nelement vertex 16\nproperty float x\nproperty float y\nproperty float z\n\
            element face 10\nproperty list uchar int vertex_indices\nend_header\n{rows}"
        );
        let vertices =
            |f: &Vec<usize>| f.iter().map(|&c| format!("vertex {}\n", text(&corners[c]))).collect::<String>();
        let stl = faces
            .iter()
            .map(|f| format!("facet normal 0 0 0\nouter loop\n{}endloop\nendfacet\n", vertices(f)));
        let stl = format!("solid x\n{}endsolid x\n", stl.collect::<String>());
        for bytes in [obj, ply, stl] {
            let file = parse(bytes.into_bytes(), "f", None).unwrap();
            let mended = file.surface.mend().unwrap().surface;
            // Twelve square units of each cap, and eight sides of the square root of five.
            assert!((mended.volume() - 12.0).abs() < 1e-12, "{}", mended.volume());
            assert!((mended.area() - 24.0 - 8.0 * 5_f64.sqrt()).abs() < 1e-9, "{}", mended.area());
        }
    }
}

#[test]
fn departures_from_gltf_that_leave_its_meaning_clear_are_read() {
    let floats =
        gltf().replace("\"count\":4,", "\"count\":4.0,").replace("\"byteOffset\":48", "\"byteOffset\":48.0");
    let second = gltf()
        .replace("\"scenes\":[{\"nodes\":[0]}]", "\"scenes\":[{\"nodes\":[0]},{\"name\":\"Scene.001\"}]");
    let infinite = gltf().replace("\"ior\":1.76", "\"ior\":Infinity");
    let bounds = gltf().replace("\"max\":[1,1,1]", "\"max\":[NaN,-inf,1e999]");
    let nowhere = gltf().replace("\"scene\":0", "\"scene\":7");
    let utf16: Vec<u8> = gltf().encode_utf16().flat_map(u16::to_le_bytes).collect();
    for (bytes, warning) in [
        (floats.into_bytes(), ""),
        (second.into_bytes(), ""),
        (infinite.into_bytes(), "`Infinity` is not a number of JSON and is left out"),
        (bounds.into_bytes(), "`NaN` is not a number of JSON"),
        (nowhere.into_bytes(), "scene 7 is to be shown, and there are 1"),
        (utf16, ""),
        (("\u{feff}".to_owned() + &gltf()).into_bytes(), ""),
    ] {
        let (volume, warnings) = told(bytes);
        assert!((volume - 8.0 / 6.0).abs() < 1e-6, "{volume} {warnings}");
        assert!(warnings.contains(warning) && warnings.is_empty() == warning.is_empty(), "{warnings}");
    }
    for version in ["1.0", "1", "3.0"] {
        let text = gltf().replace("\"version\":\"2.0\"", &format!("\"version\":\"{version}\""));
        let error = parse(text.into_bytes(), "f", None).unwrap_err().to_string();
        assert_eq!(
            error,
            format!("f: asset: this is glTF {version}; 2.0 is read; save the file as glTF 2.0")
        );
    }
}

#[test]
fn the_scene_that_has_triangles_is_read_and_hidden_nodes_are_not() {
    let scenes = |list: &str| gltf().replace("\"scene\":0,\"scenes\":[{\"nodes\":[0]}]", list);
    for (list, note) in [
        (
            "\"scenes\":[{\"nodes\":[]},{\"nodes\":[0],\"name\":\"stone\"}]",
            "2 scenes are in the file; scene 1 `stone` is read",
        ),
        (
            "\"scene\":1,\"scenes\":[{\"nodes\":[0]},{\"nodes\":[0]}]",
            "2 scenes are in the file; scene 1 is read",
        ),
        (
            "\"scene\":1,\"scenes\":[{\"nodes\":[0]},{\"nodes\":[]}]",
            "scene 0 is read, as the scene that is to be shown has no",
        ),
        ("\"scenes\":[]", ""),
        ("\"scenes\":[{\"nodes\":[]}]", "no scene of the file has triangles; all its nodes are read"),
    ] {
        let file = parse(scenes(list).into_bytes(), "f", None).unwrap();
        assert_eq!(file.surface.triangles.len(), 4, "{list}");
        assert!(
            file.notes.join("; ").contains(note) && file.notes.is_empty() == note.is_empty(),
            "{:?}",
            file.notes
        );
    }
    let hidden = "\"mesh\":1,\"extensions\":{\"KHR_node_visibility\":{\"visible\":false}},";
    let text = gltf().replace("\"mesh\":1,", hidden);
    let file = parse(text.into_bytes(), "f", None).unwrap();
    assert_eq!(file.surface.triangles.len(), 3);
    assert_eq!(file.warnings, ["1 hidden nodes are left out, with all below them"]);
}

#[test]
fn positions_of_every_type_and_displaced_ones_are_read() {
    use base64::Engine as _;
    let of = |code: u32, bytes: Vec<u8>, extra: &str| {
        let length = bytes.len();
        let whole = [bytes, gltf_buffer()[48..].to_vec()].concat();
        let data = base64::engine::general_purpose::STANDARD.encode(&whole);
        gltf_json(&format!("data:;base64,{data}"))
            .replace("\"byteLength\":72", &format!("\"byteLength\":{}", whole.len()))
            .replace("\"byteLength\":48", &format!("\"byteLength\":{length}"))
            .replace("\"byteOffset\":48", &format!("\"byteOffset\":{length}"))
            .replacen("\"componentType\":5126", &format!("\"componentType\":{code}{extra}"), 1)
    };
    let corners = TETRAHEDRON.split_whitespace().map(|n| n.parse::<i16>().unwrap());
    let corners: Vec<i16> = corners.collect();
    let bytes = |most: i16| corners.iter().map(|n| (n * most) as u8).collect::<Vec<u8>>();
    let shorts = |most: i32| {
        corners.iter().flat_map(|&n| ((i32::from(n) * most) as u16).to_le_bytes()).collect::<Vec<u8>>()
    };
    for (code, data, extra) in [
        (5120, bytes(127), ",\"normalized\":true"),
        (5121, bytes(255), ",\"normalized\":true"),
        (5122, shorts(32_767), ",\"normalized\":true"),
        (5123, shorts(65_535), ",\"normalized\":true"),
        (5121, bytes(1), ""),
        (5122, shorts(1), ",\"normalized\":false"),
    ] {
        let (volume, warnings) = told(of(code, data, extra));
        assert!(
            (volume - 8.0 / 6.0).abs() < 1e-6 && warnings.is_empty(),
            "{code}{extra}: {volume} {warnings}"
        );
    }
    // Every corner is displaced by itself: twice as large, eight times the volume.
    let targets = "\"attributes\":{\"POSITION\":0},\"targets\":[{\"POSITION\":0}],";
    for (given, factor) in [
        ("\"weights\":[1],\"primitives\"", 8.0),
        ("\"weights\":[0],\"primitives\"", 1.0),
        ("\"primitives\"", 1.0),
    ] {
        let text =
            gltf().replace("\"attributes\":{\"POSITION\":0},", targets).replace("\"primitives\"", given);
        let (volume, _) = told(text);
        assert!((volume - factor * 8.0 / 6.0).abs() < 1e-6, "{given}: {volume}");
    }
    let text = gltf()
        .replace("\"attributes\":{\"POSITION\":0},", targets)
        .replace("\"primitives\"", "\"weights\":[1],\"primitives\"")
        .replace("\"translation\":[1,2,3]", "\"translation\":[1,2,3],\"weights\":[0.5]");
    assert!(
        (told(text).0 - 1.5_f64.powi(3) * 8.0 / 6.0).abs() < 1e-6,
        "the weights of a node count before its mesh's"
    );
}
