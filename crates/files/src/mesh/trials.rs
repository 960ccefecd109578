//! Small files that other programs write and that this one once refused or misread.

use crate::design_file::{self, ImportedDesign};
use brillianteer_cut::Cut;
use brillianteer_scene::Specimen;
use std::path::PathBuf;

/// The files of the round stone of 25 facets, each with a part of its notes and warnings; empty where it has no warning.
const STONES: [(&str, &str); 34] = [
    ("bare-normal.stl", ""),
    ("base64-without-padding.gltf", ""),
    ("binary-count-0.stl", "0 triangles are announced, and the file holds 46"),
    ("blank-lines.ply", ""),
    ("bom.obj", ""),
    ("buffer-dot-slash.gltf", ""),
    ("buffer-in-subfolder.gltf", ""),
    ("color-line.stl", ""),
    ("cr-only.obj", ""),
    ("cr-only.ply", ""),
    ("decimal-comma.obj", "line 1: '0,55' has a decimal comma and is read as 0.55"),
    ("decimal-comma.ply", "line 10: '0,55' has a decimal comma"),
    ("decimal-comma.stl", "line 4: '0,55' has a decimal comma"),
    ("doublesided-quads.obj", ""),
    ("draco.glb", ""),
    ("end-loop.stl", ""),
    ("gem-and-backdrop.glb", "`ground` (2 triangles) is no closed surface and is left out"),
    ("integers-written-as-floats.glb", ""),
    ("ior-inf.glb", "`inf` is not a number of JSON"),
    ("meshopt.glb", ""),
    ("morph-weights.glb", ""),
    ("nan-in-unused-corner.glb", ""),
    ("nan-normals.stl", ""),
    ("nested-shells.obj", "2 bodies are in the file, one inside another"),
    ("no-default-scene.glb", "scene 1 is read, as those before it have no triangles"),
    (
        "one-nan-facet.stl",
        "1 triangle with a corner that is not finite is left out; the first is triangle 47",
    ),
    ("quads.stl", ""),
    ("quantization-required-but-positions-are-float.glb", ""),
    ("quantized.glb", ""),
    ("second-scene-without-nodes.glb", ""),
    ("three-stones.glb", "3 separate bodies are in the file: 1 `stone 0`"),
    ("tristrips.ply", ""),
    ("utf16.obj", ""),
    ("utf16.stl", ""),
];

/// The files that cannot be read, each with a part of the message.
const REFUSED: [(&str, &str); 10] = [
    ("comma-separated.obj", ":1: '0.55,' is not a number; write a decimal point, and blanks between numbers"),
    ("index-0.obj", ":26: the face refers to corner 0; numbers of corners count from 1"),
    ("point-cloud.ply", "this is a cloud of points without faces"),
    ("version-1.gltf", "this is glTF 1.0; 2.0 is read"),
    ("stone.step", "this is STEP; "),
    ("stone.dxf", "this is DXF; "),
    ("stone.3dm", "this is 3DM, of Rhino; "),
    ("stone.3mf", "this is 3MF; "),
    ("stone.off", "this is OFF; "),
    ("stone.asc.gz", "packed by gzip; unpack it"),
];

fn folder() -> PathBuf {
    PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data/trials"))
}

fn volume(found: ImportedDesign) -> f64 {
    Specimen::new(found.design).unwrap().solid().volume()
}

#[test]
fn files_of_other_programs_are_read_or_refused_with_what_to_do() {
    if !folder().is_dir() {
        println!("SKIPPED: {} is not there", folder().display());
        return;
    }
    for (name, expected) in STONES {
        let found = design_file::read(&folder().join(name)).unwrap_or_else(|e| panic!("{e}"));
        let said = [found.notes.join("; "), found.warnings.join("; ")].join("; ");
        assert!(said.contains(expected), "{name}: {said}");
        assert!(!expected.is_empty() || found.warnings.is_empty(), "{name}: {said}");
        let Cut::Planes(planes) = &found.design.cut else { panic!("{name}: {said}") };
        assert_eq!(planes.len(), 25, "{name}");
        let volume = volume(found);
        assert!((volume - 1.9044).abs() < 2e-4, "{name}: {volume}");
    }
    for (name, expected) in REFUSED {
        let error = design_file::read(&folder().join(name)).unwrap_err().to_string();
        assert!(error.contains(name) && error.contains(expected) && !error.contains('\n'), "{error}");
    }
    let [whole, parts] = ["star-with-ngon-caps.obj", "star-with-triangulated-caps-for-comparison.obj"]
        .map(|name| design_file::read(&folder().join(name)).unwrap());
    let [Cut::Mesh(one), Cut::Mesh(other)] = [&whole.design.cut, &parts.design.cut] else {
        panic!("no triangles")
    };
    // Both have the same facets; the caps are one each.
    assert_eq!(one.0.planes().len(), other.0.planes().len());
    let areas = [one, other].map(|shape| shape.surface().area());
    assert!((areas[0] - areas[1]).abs() < 1e-9 && (volume(whole) - volume(parts)).abs() < 1e-9, "{areas:?}");
}
