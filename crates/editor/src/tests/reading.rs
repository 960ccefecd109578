//! Tests of meshes that are read, and read again in another way.

use super::*;
use brillianteer_cut::from_mesh::{Evening, Up};
use brillianteer_files::design_file::{self, DesignFormat};
use brillianteer_files::mesh_options::{MeshForm, MeshOptions, MeshPart, MeshUnit};
use brillianteer_scene::Specimen;
use brillianteer_session::model::{
    action::FileAction,
    dialog::{Dialog, Then},
    document::Document,
    opening::{FileRequest, Opening, OpeningPurpose},
};
use glam::DVec3;
use std::path::Path;

/// Writes the first cut as a mesh.
fn scan(folder: &Path) -> PathBuf {
    let path = folder.join("scan.stl");
    let specimen = Specimen::new(Document::first().unwrap().work.design).unwrap();
    design_file::write(&specimen, DesignFormat::Stl, &path).unwrap();
    path
}

const UP: MeshOptions = MeshOptions {
    up: Up::Given(DVec3::NEG_Y),
    form: MeshForm::Found,
    unit: MeshUnit::Found,
    part: MeshPart::Found,
    evening: Evening::WhereLikely,
};

#[test]
fn a_mesh_that_is_opened_after_a_question_is_read_as_it_was_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let path = scan(folder.path());
    let mut bench = Bench::new();
    let editor = bench.harness.state_mut();
    editor.act(FileAction::OpenWith(FileRequest {
        purpose: OpeningPurpose::Anew,
        path: path.clone(),
        mesh: UP,
    }));
    // No frame has come in between, so that the design is changed before the file is taken in.
    editor.model.document.work.design.name = "mine".to_owned();
    bench.wait(|editor| editor.model.session.dialog.is_some());
    assert!(
        matches!(&bench.editor().model.session.dialog, Some(Dialog::Unsaved(Then::Open(_, mesh))) if *mesh == UP)
    );
    bench.click("Don't save");
    bench.wait(|editor| editor.model.document.work.mesh.is_some());
    assert_eq!(bench.editor().model.mesh_options(), Some(UP));
}

#[test]
fn until_the_first_file_is_read_no_other_stone_is_shown() {
    let mut bench = Bench::new();
    let editor = bench.harness.state_mut();
    // Nothing reads this request, so that the state lasts.
    let request =
        FileRequest { purpose: OpeningPurpose::Anew, path: "slow.stl".into(), mesh: MeshOptions::default() };
    let work = editor.model.document.work.clone();
    editor.model.session.awaited.opening.push(Opening { request, work, read: None });
    editor.is_starting = true;
    bench.harness.run_steps(2);
    let shows = |bench: &Bench, label: &str| bench.harness.query_all_by_label(label).next().is_some();
    assert!(shows(&bench, "reading slow.stl…") && !shows(&bench, "Crown angle"));
    bench.harness.state_mut().model.session.awaited.opening.clear();
    bench.harness.run_steps(2);
    assert!(!shows(&bench, "reading slow.stl…") && shows(&bench, "Crown angle"));
    assert!(!bench.editor().is_starting);
}

#[test]
fn a_second_choice_keeps_the_first_that_has_not_come_yet() {
    let folder = tempfile::tempdir().unwrap();
    let path = scan(folder.path());
    let mut bench = Bench::with(Setup { file: Some(path.clone()), ..Setup::default() });
    bench.wait(|editor| editor.model.document.work.mesh.is_some());
    bench.harness.run_steps(3);
    let editor = bench.harness.state_mut();
    let (work, mesh) = (editor.model.document.work.clone(), UP);
    let request = FileRequest { purpose: OpeningPurpose::Otherwise, path, mesh };
    editor.model.session.awaited.opening.push(Opening { request, work, read: None });
    bench.harness.run_steps(2);
    bench.harness.get_by_label("Triangles").click();
    bench.harness.run_steps(2);
    let both = MeshOptions { form: MeshForm::Triangles, ..UP };
    bench.wait(|editor| {
        editor.model.document.work.mesh.as_ref().is_some_and(|mesh| mesh.options != MeshOptions::default())
    });
    assert_eq!(bench.editor().model.document.work.mesh.as_ref().map(|mesh| &mesh.options), Some(&both));
}

#[test]
fn a_design_that_was_made_of_a_mesh_and_saved_is_read_again_without_the_meshs_options() {
    let folder = tempfile::tempdir().unwrap();
    let (path, toml) = (scan(folder.path()), folder.path().join("scan.toml"));
    let mut bench = Bench::with(Setup { file: Some(path.clone()), mesh: UP, ..Setup::default() });
    bench.wait(|editor| editor.model.document.work.mesh.is_some());
    let editor = bench.harness.state_mut();
    editor.act(FileAction::Open(path, OpeningPurpose::Again));
    assert_eq!(editor.model.session.awaited.opening[0].request.mesh, UP);
    editor.act(FileAction::Open(toml, OpeningPurpose::Again));
    assert_eq!(editor.model.session.awaited.opening[0].request.mesh, MeshOptions::default());
}

#[test]
fn the_unit_of_a_mesh_sets_its_size_when_it_is_read_again() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("box.obj");
    let corners = [(4, 4), (-4, 4), (-4, -4), (4, -4)];
    let corner = |z: i32| corners.map(|(x, y)| format!("v {x} {y} {z}\n")).concat();
    let faces = "f 1 2 3 4\nf 5 8 7 6\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n";
    std::fs::write(&path, corner(2) + &corner(-2) + faces).unwrap();
    let mut bench = Bench::with(Setup { file: Some(path), ..Setup::default() });
    bench.wait(|editor| editor.model.document.work.mesh.is_some());
    assert_eq!(bench.editor().model.document.work.design.diameter_mm, 8.0);
    let remarks = bench.editor().model.document.work.remarks.join("; ");
    assert!(remarks.contains("the file states no unit"), "{remarks}");
    bench.harness.run_steps(3);
    bench.harness.get_by_role_and_label(egui::Role::ComboBox, "Unit").click();
    bench.harness.run_steps(3);
    bench.harness.get_by_label("cm").click();
    bench.wait(|editor| editor.model.document.work.design.diameter_mm == 80.0);
    let remarks = bench.editor().model.document.work.remarks.join("; ");
    assert!(!remarks.contains("the file states no unit"), "{remarks}");
}
