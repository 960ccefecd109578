//! Files with several solids, and with pieces that are no solids.

use crate::design_file::ImportedDesign;
use crate::mesh::read;
use crate::mesh_options::{MeshForm, MeshOptions, MeshPart};
use crate::solids::{Triangles, extruded};
use brillianteer_base::FileError;
use brillianteer_cut::Cut;
use brillianteer_scene::Specimen;
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;
use std::path::Path;

/// Returns a prism of so many sides, of a size and at a place, whose triangles face inward where `is_inward` is set.
fn prism(sides: u32, size: f64, at: DVec3, is_inward: bool) -> Triangles {
    let corner = |k: u32| size * DVec2::from_angle(f64::from(k) * TAU / f64::from(sides));
    let (mut vertices, mut triangles) = extruded(&(0..sides).map(corner).collect::<Vec<_>>(), size);
    vertices.iter_mut().for_each(|v| *v += at);
    if is_inward {
        triangles.iter_mut().for_each(|t| t.swap(1, 2));
    }
    (vertices, triangles)
}

/// Writes named objects as OBJ.
fn obj(objects: &[(&str, Triangles)]) -> Vec<u8> {
    let (mut text, mut first) = (String::new(), 1);
    for (name, (vertices, triangles)) in objects {
        text += &format!("o {name}\n");
        text.extend(vertices.iter().map(|v| format!("v {} {} {}\n", v.x, v.y, v.z)));
        let face = |t: &[u32; 3]| format!("f {} {} {}\n", t[0] + first, t[1] + first, t[2] + first);
        text.extend(triangles.iter().map(face));
        first += vertices.len() as u32;
    }
    text.into_bytes()
}

fn open(bytes: &[u8], part: &str) -> Result<ImportedDesign, FileError> {
    read(
        bytes.to_vec(),
        Path::new("f.obj"),
        &MeshOptions { part: MeshPart::from(part), ..MeshOptions::default() },
    )
}

/// Returns the number of facets of a design between planes; 0 for one of triangles.
fn facets(found: &ImportedDesign) -> usize {
    if let Cut::Planes(planes) = &found.design.cut { planes.len() } else { 0 }
}

fn plane(size: f64) -> Triangles {
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    (corners.map(|(x, y)| DVec3::new(size * x, size * y, -3.0)).to_vec(), vec![[0, 1, 2], [0, 2, 3]])
}

#[test]
fn separate_solids_are_counted_and_one_of_them_is_read() {
    let at = |x: f64| DVec3::new(x, 0.0, 0.0);
    let bytes = obj(&[
        ("box", prism(4, 5.0, at(-20.0), false)),
        ("six", prism(6, 1.0, at(0.0), false)),
        ("Eight", prism(8, 2.0, at(10.0), false)),
        ("another", prism(8, 2.0, at(20.0), false)),
    ]);
    let found = open(&bytes, "").unwrap();
    // The largest that is more than a box; of equals the first.
    assert_eq!(facets(&found), 10);
    let note = &found.notes[0];
    assert!(note.starts_with("4 separate bodies are in the file: 1 `box` ("), "{note}");
    assert!(note.contains("; 3 `Eight` (") && note.ends_with("; 3 is read"), "{note}");
    let sizes: Vec<_> = found.bodies.iter().map(|body| (body.number, body.is_read, body.extent.z)).collect();
    assert_eq!(
        sizes,
        [(Some(1), false, 10.0), (Some(2), false, 2.0), (Some(3), true, 4.0), (Some(4), false, 4.0)]
    );
    assert_eq!((found.choices().len(), found.bodies[1].name.as_str()), (4, "six"));
    assert_eq!(found.bodies[2].extent.x, 4.0);
    for (part, count) in [("1", 6), ("2", 8), ("six", 8), ("eight", 10), ("all", 0), ("4", 10)] {
        assert_eq!(facets(&open(&bytes, part).unwrap()), count, "{part}");
    }
    for part in ["0", "5", "seven"] {
        let error = open(&bytes, part).unwrap_err().to_string();
        assert!(error.starts_with("f.obj: there is no body ") && error.contains("2 `six` ("), "{error}");
    }
    let twins = obj(&[("a", prism(6, 1.0, at(0.0), false)), ("a", prism(6, 1.0, at(9.0), false))]);
    let error = open(&twins, "a").unwrap_err().to_string();
    assert!(error.contains("2 bodies are called `a`; choose one by its number: 1 `a` ("), "{error}");
    let one = obj(&[("a", prism(6, 1.0, at(0.0), false))]);
    let found = open(&one, "").unwrap();
    assert!(found.bodies.is_empty() && !found.notes.join("; ").contains("bodies"), "{:?}", found.notes);
    assert_eq!(open(&one, "1").unwrap().design, found.design);
}

#[test]
fn a_shell_inside_another_is_a_cavity_where_it_faces_inward_and_else_a_solid_of_its_own() {
    let volume = |found: ImportedDesign| {
        let made = Specimen::new(found.design).unwrap();
        let (low, high) = made.solid().bounds();
        // As if the solid were four units high, whatever its unit.
        made.solid().volume() / ((high.z - low.z) / 4.0).powi(3)
    };
    let solid = 8.0 * 4.0 * (TAU / 8.0).sin() * 2.0;
    for is_turned in [false, true] {
        let outer = |inward| prism(8, 2.0, DVec3::ZERO, is_turned != inward);
        let inner = |inward| prism(8, 1.0, DVec3::ZERO, is_turned != inward);
        let nested = obj(&[("a", outer(false)), ("b", inner(false))]);
        let found = open(&nested, "").unwrap();
        assert!(
            found.notes[0].starts_with("2 bodies are in the file, one inside another: 1 `a`"),
            "{:?}",
            found.notes
        );
        assert!(found.notes[0].contains("triangles, inside 1)") && found.notes[0].ends_with("; 1 is read"));
        assert!((volume(found) - solid).abs() < 1e-9);
        assert!((volume(open(&nested, "b").unwrap()) - solid).abs() < 1e-9);
        // As one, the inner one is a cavity.
        assert!((volume(open(&nested, "all").unwrap()) - solid * 7.0 / 8.0).abs() < 1e-9);
        let hollow = open(&obj(&[("a", outer(false)), ("b", inner(true))]), "").unwrap();
        assert!(hollow.notes.iter().any(|note| note == "it is hollow: a shell inside it faces inward"));
        assert!(hollow.bodies.is_empty() && (volume(hollow) - solid * 7.0 / 8.0).abs() < 1e-9);
    }
}

#[test]
fn open_pieces_beside_a_closed_solid_are_left_out_and_named() {
    let gem = || prism(8, 1.0, DVec3::ZERO, false);
    let alone = open(&obj(&[("gem", gem())]), "").unwrap();
    for backdrops in [vec![("ground", plane(10.0))], vec![("wall", plane(2.0)), ("", plane(300.0))]] {
        let count = backdrops.len();
        let objects: Vec<_> = backdrops.into_iter().chain([("gem", gem())]).collect();
        let found = open(&obj(&objects), "").unwrap();
        assert_eq!(found.design.cut, alone.design.cut);
        // An open piece is listed, and cannot be chosen.
        assert_eq!((found.bodies.len(), found.choices().len()), (1 + count, 0));
        let ground = &found.bodies[1];
        assert!(
            ground.number.is_none() && !ground.is_read && ground.triangles == 2 && ground.extent.z == 0.0
        );
        let warnings = found.warnings.join("; ");
        let expected = [
            "`ground` (2 triangles) is no closed surface",
            "2 parts are no closed surfaces and are left out: `wall`",
        ];
        assert!(warnings.contains(expected[count - 1]), "{warnings}");
    }
    // A large solid with a hole is what is meant, and not the bead beside it.
    let (vertices, mut triangles) = prism(8, 5.0, DVec3::new(9.0, 0.0, 0.0), false);
    triangles.pop();
    let error =
        open(&obj(&[("stone", (vertices, triangles)), ("bead", prism(6, 0.1, DVec3::ZERO, false))]), "");
    assert!(error.unwrap_err().to_string().starts_with("f.obj: the surface is open: 3 edges"));
}

#[test]
fn a_heap_that_this_program_wrote_is_read_as_it_was() {
    let bytes = obj(&[("a", prism(6, 1.0, DVec3::ZERO, false)), ("b", prism(6, 1.0, DVec3::X * 5.0, false))]);
    let form = MeshForm::Triangles;
    let options = MeshOptions { part: MeshPart::All, form, ..MeshOptions::default() };
    let first = read(bytes, Path::new("f.obj"), &options).unwrap().design;
    let made = Specimen::new(first.clone()).unwrap();
    let text = crate::write_obj(&made.body, "heap", made.unit_mm(), None);
    let again = read(text.into_bytes(), Path::new("f.obj"), &MeshOptions::default()).unwrap();
    assert!(again.warnings.is_empty(), "{:?}", again.warnings);
    let again = Specimen::new(again.design).unwrap();
    assert!((again.solid().volume() - made.solid().volume()).abs() < 1e-9);
}
