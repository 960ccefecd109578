//! Tests of the list of the audit: its rows, the facets that it selects, and its updates after changes of the design.

use super::*;
use brillianteer_cut::FindingKind;
use brillianteer_session::model::audit::finding_facets;
use egui_kittest::kittest::NodeT;

/// A design whose mains and breaks meet in points. Its table lies half a percent of the width deeper than the points
/// where it should meet them, so that its eight meets are split. After PC 01.338 of R. Long and N. Steele, *Facet
/// Design* V (1984).
const SPLIT: &str = r#"
format = 1
name = "Split meets"
material = "diamond"
diameter_mm = 6.5
[index]
gear = 96
offset = 48.0
symmetry = 8
mirror = true
[[tier]]
names = ["C1"]
angle = 37.0
distance = 0.60181
indices = [0, 12, 24, 36, 48, 60, 72, 84]
[[tier]]
names = ["C2"]
angle = 41.0
distance = 0.65045
indices = [2, 10, 14, 22, 26, 34, 38, 46, 50, 58, 62, 70, 74, 82, 86, 94]
[[tier]]
names = ["C3"]
angle = 43.94
distance = 0.68801
indices = [6, 18, 30, 42, 54, 66, 78, 90]
[[tier]]
names = ["C4"]
angle = 23.0
distance = 0.50486
indices = [6, 18, 30, 42, 54, 66, 78, 90]
[[tier]]
names = ["T"]
angle = 0.0
distance = 0.3159856
indices = [48]
[[tier]]
names = ["P1"]
angle = -43.0
distance = 0.711
indices = [0, 12, 24, 36, 48, 60, 72, 84]
[[tier]]
names = ["P2"]
angle = -44.0
distance = 0.71724
indices = [2, 10, 14, 22, 26, 34, 38, 46, 50, 58, 62, 70, 74, 82, 86, 94]
[[tier]]
names = ["P3"]
angle = -44.53
distance = 0.72352
indices = [6, 18, 30, 42, 54, 66, 78, 90]
[[tier]]
names = ["G"]
angle = -90.0
distance = 0.99144
indices = [2, 6, 10, 14, 18, 22, 26, 30, 34, 38, 42, 46, 50, 54, 58, 62, 66, 70, 74, 78, 82, 86, 90, 94]
"#;

/// Opens an editor with the design of split meets, and the list of its audit.
fn opened(folder: &tempfile::TempDir) -> Bench {
    let path = folder.path().join("split.toml");
    std::fs::write(&path, SPLIT).unwrap();
    let mut bench = Bench::sized(Setup { file: Some(path), ..Setup::default() }, egui::vec2(1400.0, 900.0));
    bench.settle();
    bench.choose("View", "Audit");
    audited(&mut bench);
    bench
}

/// Runs frames until the audit of the present stone is there.
fn audited(bench: &mut Bench) {
    bench.wait(|editor| {
        let model = &editor.model;
        let Some(found) = &model.session.audit.found else { return false };
        *found == model.document.specimen().audit().unwrap()
    });
}

fn split_meets(bench: &Bench) -> usize {
    let found = bench.editor().model.session.audit.found.as_ref().unwrap();
    found.of_kind(FindingKind::SplitMeet).count()
}

/// Returns the sentence of the row of the first split meet.
fn first_row(bench: &Bench) -> String {
    let row = bench.harness.get_all_by_label_contains("an edge of").next().unwrap();
    row.accesskit_node().label().unwrap()
}

#[test]
fn a_row_that_is_clicked_selects_the_facets_of_its_split_meet() {
    let folder = tempfile::tempdir().unwrap();
    let mut bench = opened(&folder);
    assert_eq!(split_meets(&bench), 8);
    assert!(bench.harness.query_by_label_contains("8 candidates; whether one is a fault").is_some());
    let row = first_row(&bench);
    assert!(row.contains("mm from the axis"), "{row}");
    bench.click(&row);
    let model = &bench.editor().model;
    let finding = model.session.audit.selected_finding().expect("a finding is selected");
    let Ok(stone) = model.document.specimen().stone() else { panic!() };
    let names: Vec<&str> =
        finding_facets(stone, finding).into_iter().map(|facet| stone.names()[facet].as_str()).collect();
    assert_eq!(names.len(), 4, "{names:?}");
    assert!(names.contains(&"T"), "{names:?}");
    // A second click ends it.
    bench.click(&row);
    assert_eq!(bench.editor().model.session.audit.selected, None);
}

/// Returns the number of pixels of the window in the colour of findings.
fn marked_pixels(bench: &mut Bench) -> usize {
    let picture = bench.harness.render().unwrap();
    let is_amber = |[r, g, b, _]: [u8; 4]| r > 200 && (100..200).contains(&g) && b < 90;
    picture.pixels().filter(|pixel| is_amber(pixel.0)).count()
}

#[test]
fn profile_and_diagram_mark_the_finding_that_is_selected() {
    for shows in [Shows::Profile, Shows::Diagram] {
        let folder = tempfile::tempdir().unwrap();
        let mut bench = opened(&folder);
        bench.harness.state_mut().model.workspace.panes.iter_mut().for_each(|pane| pane.shows = shows);
        bench.settle();
        let before = marked_pixels(&mut bench);
        let row = first_row(&bench);
        bench.click(&row);
        bench.settle();
        assert_eq!(bench.editor().model.found_marks().facets.len(), 4);
        let after = marked_pixels(&mut bench);
        assert!(after > before + 200, "{shows:?}: {before} and {after}");
        bench.click(&row);
        bench.settle();
        assert_eq!(marked_pixels(&mut bench), before, "{shows:?}");
    }
}

#[test]
fn the_list_follows_the_design_and_says_that_there_are_no_candidates() {
    let folder = tempfile::tempdir().unwrap();
    let mut bench = opened(&folder);
    bench.choose("View", "Table of tiers");
    let before = bench.editor().model.session.audit.found.clone();
    // A steeper main opens other edges.
    bench.type_number("Angle of C1", "37.3");
    audited(&mut bench);
    assert_ne!(bench.editor().model.session.audit.found, before);
    bench.choose("Edit", "Undo");
    audited(&mut bench);
    assert_eq!(bench.editor().model.session.audit.found, before);
    bench.choose("File", "New from a cut");
    bench.click("Tolkowsky 1919");
    bench.settle();
    audited(&mut bench);
    assert!(bench.harness.query_by_label_contains("No candidates").is_some());
}

#[test]
fn the_list_says_what_cannot_be_audited_and_closes_by_its_key() {
    let mut bench = Bench::new();
    bench.settle();
    let press = |bench: &mut Bench| {
        bench.harness.key_press_modifiers(egui::Modifiers::SHIFT, egui::Key::A);
        bench.harness.run_steps(3);
    };
    press(&mut bench);
    audited(&mut bench);
    assert!(bench.harness.query_by_label_contains("No candidates").is_some());
    bench.choose("File", "New from a cut");
    bench.click("Pill");
    bench.settle();
    assert!(bench.harness.query_by_label_contains("Only a convex stone").is_some());
    press(&mut bench);
    assert!(bench.harness.query_by_label_contains("Only a convex stone").is_none());
}
