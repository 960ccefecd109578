//! Tests of files in other formats: opened, changed and saved.

use super::*;
use brillianteer_cut::from_mesh::Up;
use brillianteer_cut::{Design, Glass, MeshShape};
use brillianteer_files::design_file::{self, DesignFormat};
use brillianteer_math::{Surface, TriangleMesh};
use brillianteer_scene::Specimen;
use brillianteer_session::model::document::Document;
use std::sync::Arc;

#[test]
fn a_cutters_file_opens_and_its_tiers_are_set() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("square.asc");
    let text = "GemCad 5.0\ng 96 0.0\ny 4 y\nI 1.76\nH A square\na -90 1 96 n G1 24 48 72\na -43 0.9 96 n P1 24 48 72\n\
                a 35 0.8 96 n C1 24 48 72\na 0 0.45 0 n T\nZ odd\n";
    std::fs::write(&path, text).unwrap();
    let mut bench = Bench::with(Setup { file: Some(path.clone()), ..Setup::default() });
    bench.settle();
    assert!(bench.harness.query_by_label_contains("'Z odd' is not a known record").is_some());
    let (picture, cut) = (bench.picture(0), bench.editor().model.document.work.design.cut.clone());
    bench.type_number("P1 · 4 Angle", "-41.5");
    bench.settle();
    assert!(bench.picture(0) != picture);
    bench.harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::S);
    bench.settle();
    let saved = std::fs::read_to_string(&path).unwrap();
    assert!(
        saved.contains("a -41.5 0.9 96 n P1 24 48 72") && !bench.editor().model.document.is_changed(),
        "{saved}"
    );
    bench.choose("Edit", "Undo");
    assert!(bench.editor().model.document.work.design.cut == cut);
}

#[test]
fn a_mesh_opens_as_its_facets_and_is_not_written_over() {
    let folder = tempfile::tempdir().unwrap();
    let (path, toml) = (folder.path().join("scan.stl"), folder.path().join("scan.toml"));
    let specimen = Specimen::new(Document::first().unwrap().work.design).unwrap();
    design_file::write(&specimen, DesignFormat::Stl, &path).unwrap();
    let scan = std::fs::read(&path).unwrap();
    let mut bench = Bench::with(Setup { file: Some(path.clone()), ..Setup::default() });
    bench.settle();
    assert!(bench.harness.query_by_label_contains("153 facets were found").is_some());
    bench.type_number("main · 8 Angle", "-41");
    bench.choices.lock().unwrap().push(toml.clone());
    bench.harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::S);
    bench.wait(|editor| !editor.model.document.is_changed());
    assert_eq!(std::fs::read(&path).unwrap(), scan);
    let Cut::Planes(planes) = design_file::read(&toml).unwrap().design.cut else { panic!() };
    let slope = |normal: glam::DVec3| normal.truncate().length().atan2(-normal.z).to_degrees();
    let mains = planes.iter().filter(|(name, _)| name.starts_with("main "));
    assert!(
        mains.clone().count() == 8 && mains.into_iter().all(|(_, p)| (slope(p.normal) - 41.0).abs() < 1e-4)
    );
}

#[test]
fn the_direction_of_a_meshs_table_is_chosen_and_seen_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("stone.obj");
    let specimen = Specimen::new(Document::first().unwrap().work.design).unwrap();
    design_file::write(&specimen, DesignFormat::Obj, &path).unwrap();
    let mut bench = Bench::with(Setup { file: Some(path), ..Setup::default() });
    bench.settle();
    let (picture, cut) = (bench.picture(0), bench.editor().model.document.work.design.cut.clone());
    bench.harness.get_by_role_and_label(egui::Role::ComboBox, "Table faces").click();
    bench.harness.run_steps(4);
    bench.harness.get_by_label("−z").click();
    bench.harness.run_steps(4);
    bench.wait(|editor| {
        editor.model.document.work.mesh.as_ref().is_some_and(|mesh| mesh.options.up != Up::Found)
    });
    bench.settle();
    assert!(bench.picture(0) != picture && bench.editor().model.document.work.design.cut != cut);
    let up = |cut: &Cut| match cut {
        Cut::Planes(planes) => {
            planes.iter().find(|(name, _)| name == "table").map(|(_, plane)| plane.normal.z)
        }
        _ => None,
    };
    let (before, after) = (up(&cut), up(&bench.editor().model.document.work.design.cut));
    assert!(before.unwrap() > 0.999 && after.unwrap() < -0.999, "{before:?} {after:?}");
    bench.choose("Edit", "Undo");
    bench.settle();
    assert!(bench.editor().model.document.work.design.cut == cut);
    assert_eq!(bench.editor().model.document.work.mesh.as_ref().map(|mesh| mesh.options.up), Some(Up::Found));
}

#[test]
fn a_mesh_is_read_in_another_form_by_a_click_which_can_be_undone() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("heart.glb");
    let (vertices, triangles) = crate::solids::heart();
    let shape = MeshShape(Arc::new(TriangleMesh::new(Surface::new(vertices, triangles)).unwrap()));
    let first = Document::first().unwrap().work.design;
    let design = Design { name: "heart".into(), cut: Cut::Mesh(shape), ..first };
    design_file::write(&Specimen::new(design).unwrap(), DesignFormat::Glb, &path).unwrap();
    let mut bench = Bench::with(Setup { file: Some(path), ..Setup::default() });
    let is_mesh = |editor: &Editor| matches!(editor.model.document.work.design.cut, Cut::Mesh(_));
    bench.wait(is_mesh);
    bench.harness.run_steps(3);
    // In cubic mm, because each form has a frame of its own.
    let cubic_mm = |editor: &Editor| {
        let specimen = editor.model.document.specimen();
        specimen.solid().volume() * specimen.unit_mm().powi(3)
    };
    let volume = cubic_mm(bench.editor());
    bench.harness.get_by_label("Facets").click();
    bench.wait(|editor| !is_mesh(editor));
    bench.harness.run_steps(3);
    let editor = bench.editor();
    assert!(editor.model.document.specimen().stone().is_ok() && editor.model.document.is_changed());
    let bends =
        |editor: &Editor| editor.model.document.work.remarks.iter().any(|note| note.contains("bends inward"));
    assert!(bends(editor));
    let scale = |editor: &Editor| cubic_mm(editor) / volume;
    assert!(scale(editor) > 1.05, "{}", scale(editor));
    bench.harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::Z);
    bench.wait(is_mesh);
    bench.harness.run_steps(3);
    assert!(!bends(bench.editor()), "what was said of the facets goes with them");
    assert!((scale(bench.editor()) - 1.0).abs() < 1e-12 && !bench.editor().model.document.is_changed());
    bench.harness.key_press_modifiers(egui::Modifiers::COMMAND | egui::Modifiers::SHIFT, egui::Key::Z);
    bench.wait(|editor| !is_mesh(editor));
}

#[test]
fn a_solid_that_is_not_convex_is_shown_by_rays_and_measured() {
    let folder = tempfile::tempdir().unwrap();
    let (path, toml) = (folder.path().join("heart.glb"), folder.path().join("heart.toml"));
    let (vertices, triangles) = crate::solids::heart();
    let shape = MeshShape(Arc::new(TriangleMesh::new(Surface::new(vertices, triangles)).unwrap()));
    let first = Document::first().unwrap().work.design;
    let design = Design { name: "heart".into(), cut: Cut::Mesh(shape), ..first };
    design_file::write(&Specimen::new(design).unwrap(), DesignFormat::Glb, &path).unwrap();
    let mut workspace = Bench::small();
    workspace.panes[1].shows = Shows::Diagram;
    let mut bench = Bench::with(Setup { file: Some(path), workspace, ..Setup::default() });
    // A mesh has no diagram to wait for, and the first figures are enough.
    bench.wait(|editor| {
        let shown = editor.views.gallery.traced.get(&(0, Which::Present));
        shown.is_some_and(|shown| shown.grade == Grade::Fine)
            && editor.model.session.measured.figures.contains_key(&Which::Present)
    });
    assert!(bench.harness.query_by_label_contains("Triangles of a mesh").is_some());
    assert!(bench.harness.query_by_label_contains("it is not convex; read as a faceted stone").is_some());
    let picture = bench.picture(0);
    assert!(picture.iter().any(|p| p != &picture[0]));
    let figures = &bench.editor().model.session.measured.figures[&Which::Present];
    assert!((figures.figures.sum() - 1.0).abs() < 1e-9 && figures.figures.standard_error > 0.0);
    assert!(bench.harness.query_by_label("Diameter").is_none(), "a heart is not round");
    bench.type_number("Width", "9");
    bench.choices.lock().unwrap().push(toml.clone());
    bench.harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::S);
    bench.wait(|editor| !editor.model.document.is_changed());
    assert_eq!(design_file::read(&toml).unwrap().design, bench.editor().model.document.work.design);
}

#[test]
fn a_glass_shape_is_taken_from_the_library_and_its_dimensions_are_set() {
    let mut bench = Bench::with(Setup { file: Some("plate".into()), ..Setup::default() });
    bench.leave_one();
    bench.settle();
    let cut = bench.editor().model.document.work.design.cut.clone();
    let Cut::Glass(Glass::Plate(plate)) = &cut else { panic!("{cut:?}") };
    assert!(bench.harness.query_all_by_label("Wavy plate").count() >= 1 && plate.amplitude == 4.91);
    let before = bench.picture(0);
    bench.type_number("Amplitude", "9.5");
    bench.settle();
    assert!(bench.picture(0) != before);
    let Cut::Glass(Glass::Plate(plate)) = bench.editor().model.document.work.design.cut else { panic!() };
    assert_eq!(plate.amplitude, 9.5);
    bench.type_number("Edge", "40");
    let message = "Edge: 40 % is impossible. With the other proportions as they are, it can be at most ";
    assert!(bench.harness.query_by_label_contains(message).is_some());
    assert!(bench.harness.query_by_label_contains("edge:").is_none(), "no key of a file is shown");
    bench.choose("Edit", "Undo");
    bench.choose("Edit", "Undo");
    assert!(bench.editor().model.document.work.design.cut == cut);
}

#[test]
fn renders_show_three_bands_of_wavelengths_while_a_key_is_down() {
    let [render, ..] = Workspace::default().panes;
    let workspace = Workspace { layout: PaneLayout::One, panes: [render; 4], ..Workspace::default() };
    let mut bench = Bench::with(Setup { file: Some("prism".into()), workspace, ..Setup::default() });
    bench.leave_one();
    bench.settle();
    let many = bench.picture(0);
    bench.harness.key_down(egui::Key::Z);
    bench.settle();
    let three = bench.picture(0);
    assert!(three != many);
    bench.harness.key_up(egui::Key::Z);
    bench.settle();
    assert!(bench.picture(0) == many);
}

#[test]
fn a_pattern_hangs_behind_glass_and_is_refracted_as_strongly_as_asked() {
    let [render, ..] = Workspace::default().panes;
    let workspace = Workspace { layout: PaneLayout::One, panes: [render; 4], ..Workspace::default() };
    let setup = Setup { file: Some("cube".into()), workspace, ..Setup::default() };
    let mut bench = Bench::sized(setup, egui::vec2(900.0, 300.0));
    bench.leave_one();
    bench.look();
    let plain = bench.picture(0);
    bench.harness.state_mut().model.document.work.settings.look.background = Some("grid".into());
    bench.look();
    let refracted = bench.picture(0);
    assert!(refracted != plain);
    assert!(bench.harness.query_by_role_and_label(egui::Role::SpinButton, "Strength").is_some());
    bench.harness.state_mut().model.document.work.settings.look.strength = 0.1;
    bench.look();
    assert!(bench.picture(0) != refracted);
}
