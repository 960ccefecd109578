//! Mesh files: what is written reads back, faults are reported, and real files open.

#![allow(clippy::print_stdout, reason = "a test prints what it measured")]

mod broken;
mod faults;
mod kinds;
mod packed;
mod real;
mod unusual;

use super::statement::Measures;
use super::*;
use crate::design_file::{self, DesignFormat};
use crate::{cut_file, write_glb, write_obj, write_ply, write_stl};
use brillianteer_cut::from_mesh::{Evening, FromMesh, Up, from_mesh};
use brillianteer_cut::{Cut, Design, MaterialRef};
use brillianteer_math::Plane;
use brillianteer_math::faceting::{Faceted, SurfaceKind, facets};
use brillianteer_scene::{Body, Specimen, Stone};
use glam::{DQuat, DVec3};

fn brilliant(girdle_facets: u32) -> Stone {
    let design = cut_file::read(concat!(env!("CARGO_MANIFEST_DIR"), "/../../cuts/tolkowsky.toml")).unwrap();
    let Cut::RoundBrilliant(cut) = design.cut else { panic!("tolkowsky is a brilliant") };
    let cut = Cut::RoundBrilliant(brillianteer_cut::RoundBrilliant { girdle_facets, culet: 1.0, ..cut });
    Stone::new(&Design { cut, ..design }.facets().unwrap()).unwrap()
}

fn body(girdle_facets: u32) -> Body {
    Body::Stone(brilliant(girdle_facets))
}

fn open(bytes: Vec<u8>) -> MeshFile {
    parse(bytes, "stone.mesh", None).unwrap()
}

fn faceted(file: &MeshFile) -> Faceted {
    match facets(file.surface.mend().unwrap().surface) {
        SurfaceKind::Convex(found) => *found,
        SurfaceKind::Concave(_) => panic!("taken for concave"),
    }
}

/// Returns the largest differences of normals and of offsets (girdle radii). Facets are matched by name, or by the nearest
/// normal.
fn difference(stone: &Stone, found: &Faceted, scale: f64, named: bool) -> (f64, f64) {
    assert_eq!(stone.names().len(), found.faces.len());
    let mut worst = (0.0_f64, 0.0_f64);
    for (facet, name) in stone.polytope.facets().iter().zip(stone.names()) {
        let off = |p: &Plane| (p.normal - facet.plane.normal).length();
        let face = if named {
            found.faces.iter().find(|f| f.name.as_ref() == Some(name)).unwrap()
        } else {
            found.faces.iter().min_by(|a, b| off(&a.plane).total_cmp(&off(&b.plane))).unwrap()
        };
        let offset = (face.plane.offset + face.plane.normal.dot(found.centre)) / scale;
        worst = (worst.0.max(off(&face.plane)), worst.1.max((offset - facet.plane.offset).abs()));
    }
    worst
}

fn upright(mut file: MeshFile) -> MeshFile {
    // Files of glTF have y up.
    let turn = DQuat::from_rotation_x(std::f64::consts::FRAC_PI_2);
    file.surface.vertices.iter_mut().for_each(|v| *v = turn * *v);
    file
}

#[test]
fn a_stone_without_names_is_written_with_all_its_facets() {
    let (named, bare) = (body(16), Body::from(brilliant(16).polytope));
    let stl = |body| write_stl(body, 3.0, None).unwrap();
    assert!(stl(&named) == stl(&bare));
    let ply = |body| write_ply(body, 3.0, None).unwrap();
    assert!(ply(&named) == ply(&bare));
    let obj = |body| write_obj(body, "x", 3.0, None);
    let without_groups = |text: String| {
        text.lines().filter(|line| !line.starts_with("g ")).map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(without_groups(obj(&named)), obj(&bare).lines().collect::<Vec<_>>());
    let clear = MaterialHint::default();
    let glb = open(write_glb(&bare, "x", 3e-3, (&clear, None)).unwrap());
    let facets = bare.stone().unwrap().polytope.facets().len();
    assert_eq!(faceted(&glb).faces.len(), facets);
}

#[test]
fn a_ply_holds_triangles_alone_because_many_programs_read_no_polygons() {
    let bytes = write_ply(&body(16), 1.0, None).unwrap();
    let end = b"end_header\n";
    let header = end.len() + bytes.windows(end.len()).position(|part| part == end).unwrap();
    let surface = open(bytes.clone()).surface;
    // Three f64 for each corner; for each face a byte, which says three, and three i32.
    assert_eq!(bytes.len(), header + 24 * surface.vertices.len() + 13 * surface.triangles.len());
    assert_eq!(bytes[bytes.len() - 13], 3);
}

#[test]
fn what_is_written_comes_back_with_its_planes_and_names() {
    let clear = MaterialHint::of(brillianteer_optics::material("diamond").unwrap(), 1.0);
    for (count, scale) in [(16, 1.0), (16, 3.25), (96, 3.25)] {
        let (stone, body) = (brilliant(count), body(count));
        let obj = open(write_obj(&body, "a stone", scale, None).into_bytes());
        assert_eq!((obj.format, obj.name.as_str(), &obj.warnings), (MeshFormat::Obj, "a stone", &vec![]));
        let (normal, offset) = difference(&stone, &faceted(&obj), scale, true);
        println!("obj {count} {scale}: normals {normal:.1e}, offsets {offset:.1e}");
        assert!(normal < 1e-12 && offset < 1e-12, "{normal} {offset}");
        let ply = open(write_ply(&body, scale, None).unwrap());
        assert_eq!((ply.format, &ply.warnings), (MeshFormat::Ply, &vec![]));
        let (normal, offset) = difference(&stone, &faceted(&ply), scale, false);
        println!("ply {count} {scale}: normals {normal:.1e}, offsets {offset:.1e}");
        assert!(normal < 1e-12 && offset < 1e-12, "{normal} {offset}");
        let stl = open(write_stl(&body, scale, None).unwrap());
        assert_eq!(stl.format, MeshFormat::StlBinary);
        let (normal, offset) = difference(&stone, &faceted(&stl), scale, false);
        println!("stl {count} {scale}: normals {normal:.1e}, offsets {offset:.1e}");
        assert!(normal < 1e-5 && offset < 1e-6, "{normal} {offset}");
        let glb = upright(open(write_glb(&body, "a stone", scale / 1000.0, (&clear, None)).unwrap()));
        assert_eq!((glb.format, glb.name.as_str()), (MeshFormat::Glb, "a stone"));
        let (normal, offset) = difference(&stone, &faceted(&glb), scale / 1000.0, true);
        println!("glb {count} {scale}: normals {normal:.1e}, offsets {offset:.1e}");
        assert!(normal < 1e-5 && offset < 1e-6, "{normal} {offset}");
    }
}

#[test]
fn a_stone_posed_from_a_file_is_the_one_that_was_written() {
    let (stone, body) = (brilliant(96), body(96));
    let clear = MaterialHint::of(brillianteer_optics::material("diamond").unwrap(), 1.0);
    let files = [
        (write_obj(&body, "x", 3.0, None).into_bytes(), 1e-12),
        (write_stl(&body, 3.0, None).unwrap(), 1e-6),
        (write_glb(&body, "x", 3e-3, (&clear, None)).unwrap(), 1e-6),
    ];
    for (bytes, within) in files {
        let FromMesh { facets, deviation, .. } =
            from_mesh(&faceted(&open(bytes)), Up::Found, Evening::default()).unwrap();
        let names: Vec<&String> = facets.iter().map(|(name, _)| name).collect();
        assert_eq!(names, stone.names().iter().collect::<Vec<_>>());
        let normal = |((_, a), b): (&(String, Plane), &Plane)| (a.normal - b.normal).length();
        let offset = |((_, a), b): (&(String, Plane), &Plane)| (a.offset - b.offset).abs();
        let planes: Vec<Plane> = stone.polytope.planes().collect();
        let normal = facets.iter().zip(&planes).map(normal).fold(0.0, f64::max);
        let offset = facets.iter().zip(&planes).map(offset).fold(0.0, f64::max);
        println!("posed: normals {normal:.1e}, offsets {offset:.1e}, deviation {deviation:.1e}");
        assert!(normal < within && offset < within, "{normal} {offset} beyond {within}");
    }
}

#[test]
fn the_material_of_a_glb_comes_back() {
    let ruby = brillianteer_optics::material("ruby").unwrap();
    let hint = MaterialHint::of(ruby, 1000.0);
    let back = open(write_glb(&body(16), "ruby", 2e-3, (&hint, None)).unwrap()).hint.unwrap();
    let near = |a: Option<f64>, b: Option<f64>| (a.unwrap() - b.unwrap()).abs() < 1e-6;
    assert!(near(back.ior, hint.ior) && near(back.dispersion, hint.dispersion) && back.transmits);
    let ((a, one), (b, other)) = (back.attenuation.unwrap(), hint.attenuation.unwrap());
    assert!((one / other - 1.0).abs() < 1e-6 && a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6));
    assert_eq!(back.name.as_deref(), Some("ruby"));
}

#[test]
fn an_stl_keeps_size_and_material_however_many_digits_the_size_has() {
    let ruby = MaterialRef::Name("ruby".to_owned());
    for radius_mm in [3.25, 3.061_728_394_506, 3_061.728_394_506_17] {
        let file = open(write_stl(&body(16), radius_mm, Some(&ruby)).unwrap());
        let statement = file.statement.unwrap();
        assert!((statement.diameter_mm - 2.0 * radius_mm).abs() < 1e-6, "{}", statement.diameter_mm);
        assert_eq!(statement.material.as_ref(), Some(&ruby), "{radius_mm}");
    }
    let measures =
        Measures { volume: 12.345_678, span: [-1.234_567, 1.345_678], middle: DVec3::splat(-0.123_456) };
    let of =
        |diameter_mm| Statement { up: DVec3::Z, mm_per_unit: 1.0, diameter_mm, material: None, measures };
    let text = of(12_345.678_901_234_567).text(80).unwrap();
    assert!(text.len() <= 80 && text.contains(" d=12345.678901 "), "{text}");
    assert_eq!(Statement::parse(&text).unwrap().diameter_mm, 12_345.678_901);
    assert_eq!(of(1.234_567_890_123e15).text(70), None);
    assert!(of(1e-9 / 3.0).text(100).is_some_and(|text| Statement::parse(&text).unwrap().diameter_mm > 0.0));
}

#[test]
fn coordinates_that_are_nothing_but_rounding_are_written_as_0() {
    for scale in [3.25, 3.25e-9, 1e9] {
        let text = write_obj(&body(96), "x", scale, None);
        let numbers =
            text.lines().filter_map(|line| line.strip_prefix("v ")).flat_map(|line| line.split(' '));
        let numbers: Vec<&str> = numbers.collect();
        assert!(numbers.contains(&"0") && !numbers.contains(&"-0"));
        let least = numbers.iter().map(|n| n.parse::<f64>().unwrap().abs()).filter(|x| *x > 0.0);
        let least = least.fold(f64::INFINITY, f64::min);
        assert!(least > 1e-6 * scale, "{least}");
    }
}

const TETRAHEDRON: &str = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";

fn ply(format: &str) -> Vec<u8> {
    let mut bytes = format!(
        "ply\nformat {format} 1.0\ncomment made here\nelement vertex 4\nproperty float x\nproperty float y\n\
         property float z\nproperty uchar red\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n"
    )
    .into_bytes();
    let faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];
    if format == "ascii" {
        TETRAHEDRON.lines().for_each(|line| bytes.extend(format!("{line} 255\n").as_bytes()));
        faces.iter().for_each(|[a, b, c]| bytes.extend(format!("3 {a} {b} {c}\n").as_bytes()));
        return bytes;
    }
    let big = format == "binary_big_endian";
    let put = |n: [u8; 4], big: bool| if big { n } else { [n[3], n[2], n[1], n[0]] };
    for line in TETRAHEDRON.lines() {
        line.split(' ').for_each(|n| bytes.extend(put(n.parse::<f32>().unwrap().to_be_bytes(), big)));
        bytes.push(255);
    }
    for face in faces {
        bytes.push(3);
        face.iter().for_each(|n: &i32| bytes.extend(put(n.to_be_bytes(), big)));
    }
    bytes
}

fn stl_text() -> String {
    let at = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]];
    let faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];
    let vertex = |v: usize| format!("      vertex {} {} {}\n", at[v][0], at[v][1], at[v][2]);
    let facet = |f: [usize; 3]| {
        let corners: String = f.into_iter().map(vertex).collect();
        format!("  facet normal 0 0 0\n    outer loop\n{corners}    endloop\n  endfacet\n")
    };
    format!("solid my stone\n{}endsolid\n", faces.into_iter().map(facet).collect::<String>())
}

fn obj_text() -> String {
    let corners: String = TETRAHEDRON.lines().map(|line| format!("v {line}\n")).collect();
    format!("# é\no my stone\n{corners}vt 0 0\nf 1/1 3/1 2/1\nf 1//9 2//9 4\nf -3 -2 -1\nf 1 4 \\\n 3\n")
}

/// Returns a tetrahedron in two meshes under scaled and moved nodes: three of its faces in one, the fourth as a strip in the
/// other.
fn gltf_json(uri: &str) -> String {
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],
        "nodes":[{{"children":[1,2],"scale":[2,2,2]}},{{"mesh":0,"translation":[1,2,3],"name":"sides"}},
                 {{"mesh":1,"translation":[1,2,3],"rotation":[0,0,0,1]}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1,"material":0}}]}},
                  {{"name":"base","primitives":[{{"attributes":{{"POSITION":0}},"indices":2,"mode":5}}]}}],
        "materials":[{{"extensions":{{"KHR_materials_ior":{{"ior":1.76}},"KHR_materials_dispersion":{{"dispersion":0.25}},
            "KHR_materials_transmission":{{"transmissionFactor":1}},
            "KHR_materials_volume":{{"thicknessFactor":1,"attenuationColor":[0.5,0.25,1],"attenuationDistance":0.004}}}}}}],
        "extensionsUsed":["KHR_materials_ior","KHR_materials_dispersion"],"extensionsRequired":["KHR_materials_dispersion"],
        "buffers":[{{"byteLength":72,"uri":"{uri}"}}],
        "bufferViews":[{{"buffer":0,"byteLength":48}},{{"buffer":0,"byteOffset":48,"byteLength":24}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,1]}},
                     {{"bufferView":1,"componentType":5123,"count":9,"type":"SCALAR"}},
                     {{"bufferView":1,"byteOffset":18,"componentType":5123,"count":3,"type":"SCALAR"}}]}}"#
    )
}

fn gltf_buffer() -> Vec<u8> {
    let places = TETRAHEDRON.split_whitespace().flat_map(|n| n.parse::<f32>().unwrap().to_le_bytes());
    let order = [0_u16, 1, 3, 1, 2, 3, 0, 3, 2, 0, 2, 1].into_iter().flat_map(u16::to_le_bytes);
    places.chain(order).collect()
}

fn gltf() -> String {
    use base64::Engine as _;
    let text = base64::engine::general_purpose::STANDARD.encode(gltf_buffer());
    gltf_json(&format!("data:application/octet-stream;base64,{text}"))
}

fn volume(file: &MeshFile) -> f64 {
    file.surface.mend().unwrap().surface.volume()
}

#[test]
fn a_gem_keeps_its_material_through_glb_at_any_size() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("gem.glb");
    let first = cut_file::read(concat!(env!("CARGO_MANIFEST_DIR"), "/../../cuts/tolkowsky.toml")).unwrap();
    for name in ["diamond", "ruby", "sapphire", "emerald", "tourmaline"] {
        let Ok(known) = MaterialRef::Name(name.to_owned()).material() else { continue };
        for diameter_mm in [0.9, 2.0, 6.5, 30.0] {
            let material = MaterialRef::Name(name.to_owned());
            let design = Design { material, diameter_mm, ..first.clone() };
            design_file::write(&Specimen::new(design.clone()).unwrap(), DesignFormat::Glb, &path).unwrap();
            let back = design_file::read(&path).unwrap().design;
            assert_eq!(back.material, design.material, "{name} of {diameter_mm} mm");
            // Without the statement of the name the colour is that of the material all the same, per mm of the stone.
            let text = String::from_utf8_lossy(&std::fs::read(&path).unwrap()).into_owned();
            let has_colour = text.contains("attenuationColor");
            assert_eq!(has_colour, !known.absorption.iter().all(|a| a.is_clear()), "{name}");
        }
    }
    // Absorption that a file gives per metre is that of the stone, whatever its size.
    let ruby = brillianteer_optics::material("ruby").unwrap();
    let mean = |m: &brillianteer_optics::Material| {
        m.absorption.iter().map(|a| a.coefficient(550.0)).sum::<f64>() / 2.0
    };
    for radius_mm in [0.5, 3.25, 20.0] {
        let hint = MaterialHint::of(ruby, 1000.0);
        let bytes = write_glb(&body(16), "ruby", 1e-3 * radius_mm, (&hint, None)).unwrap();
        std::fs::write(&path, bytes).unwrap();
        let back = design_file::read(&path).unwrap().design.material.material().unwrap();
        assert!((mean(&back) / mean(ruby) - 1.0).abs() < 0.05, "{} for {}", mean(&back), mean(ruby));
    }
}

#[test]
fn every_format_is_told_by_content_and_read() {
    let mut stl = vec![b' '; 80];
    stl[..5].copy_from_slice(b"solid");
    let faces = super::stl_file::read_text(stl_text().as_bytes()).unwrap().surface;
    stl.extend(4_u32.to_le_bytes());
    for t in 0..4 {
        stl.extend([0; 12]);
        let corners = faces.corners(t).into_iter().flat_map(|c| c.as_vec3().to_array());
        corners.for_each(|x| stl.extend(x.to_le_bytes()));
        stl.extend([0; 2]);
    }
    let upper = stl_text().to_uppercase() + &stl_text();
    let cases = [
        (ply("ascii"), MeshFormat::Ply, 1.0),
        (ply("binary_little_endian"), MeshFormat::Ply, 1.0),
        (ply("binary_big_endian"), MeshFormat::Ply, 1.0),
        (stl_text().into_bytes(), MeshFormat::StlText, 1.0),
        (upper.into_bytes(), MeshFormat::StlText, 1.0),
        (stl, MeshFormat::StlBinary, 1.0),
        (obj_text().into_bytes(), MeshFormat::Obj, 1.0),
        (obj_text().replace('\n', "\r\n").into_bytes(), MeshFormat::Obj, 1.0),
        (gltf().into_bytes(), MeshFormat::Gltf, 8.0),
    ];
    for (bytes, format, content) in cases {
        assert_eq!(looks_like(&bytes), Some(format));
        let file = open(bytes);
        assert_eq!(file.format, format);
        assert!((volume(&file) - content / 6.0).abs() < 1e-9, "{format:?}");
        let named = matches!(format, MeshFormat::StlText | MeshFormat::Obj);
        assert_eq!(file.name.to_lowercase(), if named { "my stone" } else { "stone" }, "{format:?}");
    }
    for nothing in [
        &b""[..],
        b"\0\0\0",
        b"hello",
        b"{}",
        b"# v 1 2 3",
        b"<GemCutStudio version=\"1\">",
        b"GemCad 5.0\ng 96 0",
    ] {
        assert_eq!(looks_like(nothing), None, "{}", String::from_utf8_lossy(nothing));
    }
}

#[test]
fn nodes_place_meshes_and_extensions_give_the_material() {
    let file = open(gltf().into_bytes());
    let (low, high) = file.surface.bounds();
    assert!(low == DVec3::new(2.0, 4.0, 6.0) && high == DVec3::new(4.0, 6.0, 8.0), "{low} {high}");
    assert_eq!(file.surface.names, ["sides", "base"]);
    let hint = file.hint.unwrap();
    assert!((hint.ior.unwrap() - 1.76).abs() < 1e-7 && hint.dispersion == Some(0.25) && hint.transmits);
    let material = hint.material(1000.0).unwrap().unwrap().material().unwrap();
    assert!((material.index(587.6) - 1.76).abs() < 1e-5);
    assert!((material.absorption[0].coefficient(550.0) - 4_f64.ln() / 4.0).abs() < 1e-6);
    assert!(file.warnings.is_empty(), "{:?}", file.warnings);
    let unbounded = open(gltf().replace(",\"min\":[0,0,0],\"max\":[1,1,1]", "").into_bytes());
    assert_eq!(unbounded.warnings, ["the bounds of places are missing 1 times"]);
}

#[test]
fn buffers_are_read_beside_the_file_and_nowhere_else() {
    let folder = tempfile::tempdir().unwrap();
    let inner = folder.path().join("inner");
    std::fs::create_dir(&inner).unwrap();
    std::fs::write(inner.join("my buffer.bin"), gltf_buffer()).unwrap();
    std::fs::write(folder.path().join("secret.bin"), gltf_buffer()).unwrap();
    let read_with = |uri: &str| {
        let path = inner.join("a.gltf");
        std::fs::write(&path, gltf_json(uri)).unwrap();
        read(&path)
    };
    std::fs::create_dir(inner.join("deep")).unwrap();
    std::fs::write(inner.join("deep/100%.bin"), gltf_buffer()).unwrap();
    for uri in [
        "my%20buffer.bin",
        "my buffer.bin",
        "./my%20buffer.bin",
        "deep/100%25.bin",
        "deep/100%.bin",
        "deep\\\\100%.bin",
    ] {
        let file = read_with(uri).unwrap_or_else(|e| panic!("{uri}: {e}"));
        assert!((volume(&file) - 8.0 / 6.0).abs() < 1e-9 && file.name == "a", "{uri}");
    }
    let secret = folder.path().join("secret.bin").display().to_string();
    for uri in ["../secret.bin", "%2e%2e/secret.bin", "..%2Fsecret.bin", "..", &secret, "file:///etc/passwd"]
    {
        let error = read_with(uri).unwrap_err().to_string();
        assert!(
            error.contains("a.gltf: buffer 0: ") && error.contains("is not a file beside this one"),
            "{error}"
        );
    }
    let missing = read_with("none.bin").unwrap_err().to_string();
    assert!(missing.ends_with("buffer 0: none.bin: there is no such file"), "{missing}");
    std::fs::create_dir(inner.join("folder.bin")).unwrap();
    let folder = read_with("folder.bin").unwrap_err().to_string();
    assert!(folder.ends_with("folder.bin: this is a directory; a file is expected"), "{folder}");
}

fn read(path: &Path) -> Result<MeshFile, FileError> {
    parse(std::fs::read(path).unwrap(), &path.display().to_string(), path.parent())
}
