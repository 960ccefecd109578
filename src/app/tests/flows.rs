//! What people do, from the first click to the last.

use super::*;
use crate::cut::Crown;
use crate::io::cut_file;
use crate::measure::by_beams;
use crate::optics::line;
use crate::scene::{ASET_CONE, Backing, Scope, Specimen, View};
use crate::trace::{beam, unwatched};

#[test]
fn a_crown_angle_changes_the_aset_and_undo_brings_it_back_to_the_pixel() {
    let mut bench = Bench::new();
    bench.settle();
    let before = (bench.brilliant(), bench.picture(0));
    bench.type_number("Crown angle", "32.5");
    bench.settle();
    assert_eq!(bench.brilliant().crown, Crown::Angle(32.5));
    assert_ne!(bench.picture(0), before.1);
    bench.choose("Edit", "Undo");
    bench.settle();
    assert_eq!((bench.brilliant(), bench.picture(0)), before);
    bench.choose("Edit", "Redo");
    bench.settle();
    assert_eq!(bench.brilliant().crown, Crown::Angle(32.5));
}

#[test]
fn a_drag_of_a_slider_is_one_step() {
    let mut bench = Bench::new();
    bench.settle();
    let before = bench.brilliant();
    let slider = bench.harness.get_by_role_and_label(egui::Role::Slider, "Table").rect();
    bench.harness.drag_at(slider.left_center() + egui::vec2(40.0, 0.0));
    bench.harness.step();
    for x in [60.0, 80.0, 90.0] {
        bench.harness.hover_at(slider.left_center() + egui::vec2(x, 0.0));
        bench.harness.step();
    }
    bench.harness.drop_at(slider.left_center() + egui::vec2(90.0, 0.0));
    bench.settle();
    assert_ne!(bench.brilliant().table, before.table);
    bench.choose("Edit", "Undo");
    assert_eq!(bench.brilliant(), before);
    assert!(!bench.editor().document.steps().0);
}

#[test]
fn the_one_of_a_pair_that_is_held_stays() {
    let mut bench = Bench::new();
    bench.settle();
    bench.click("Hold crown height");
    let height = match bench.brilliant().crown {
        Crown::Height(height) => height,
        other => panic!("{other:?}"),
    };
    bench.type_number("Table", "60");
    assert_eq!(bench.brilliant().crown, Crown::Height(height));
    assert!(bench.brilliant().derived().unwrap().crown_angle > 38.0);
    bench.type_number("Crown angle", "33");
    assert!(matches!(bench.brilliant().crown, Crown::Height(_)), "the height is still held");
    assert!((bench.brilliant().derived().unwrap().crown_angle - 33.0).abs() < 1e-9);
}

#[test]
fn what_is_edited_and_saved_opens_again_equal_and_its_figures_are_those_of_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.toml");
    let mut bench = Bench::new();
    bench.type_number("Pavilion angle", "41.1");
    bench.choices.lock().unwrap().push(path.clone());
    bench.choose("File", "Save as…");
    bench.settle();
    assert!(!bench.editor().document.is_changed());
    let design = bench.editor().document.work.design.clone();
    assert_eq!(cut_file::read(&path).unwrap(), design);
    let shown = &bench.editor().figures[&Which::Present];
    let specimen = Specimen::new(cut_file::read(&path).unwrap()).unwrap();
    let options = beam::Options { unresolved: 1.5e-4, ..beam::Options::default() };
    let medium = specimen.medium(line::SODIUM_D);
    let beams =
        beam::trace(&specimen.stone.polytope, medium, &View::default(), &options, &unwatched).unwrap();
    assert_eq!(shown.grade, Grade::Fine);
    assert_eq!(shown.figures, by_beams(&beams, &Scope::aset(ASET_CONE, Backing::Black)));
    let mut again = Bench::with(Setup { file: Some(path), ..Setup::default() });
    again.settle();
    assert_eq!(again.editor().document.work.design, design);
    assert_eq!(again.picture(0), bench.picture(0));
}

#[test]
fn unsaved_work_is_asked_about_before_it_is_lost() {
    let mut bench = Bench::new();
    bench.type_number("Table", "58");
    bench.choose("File", "New from");
    bench.harness.get_by_label("Modern ideal").click();
    bench.harness.run_steps(4);
    bench.click("Cancel");
    assert!((bench.brilliant().table - 58.0).abs() < 1e-12);
    bench.choose("File", "New from");
    bench.harness.get_by_label("Modern ideal").click();
    bench.harness.run_steps(4);
    bench.click("Don't save");
    assert_eq!(bench.editor().document.work.design.name, "Modern ideal");
}

#[test]
fn a_crash_loses_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let safe = Some(folder.path().to_owned());
    let mut bench = Bench::with(Setup { safe: safe.clone(), ..Setup::default() });
    bench.type_number("Table", "59.5");
    bench.harness.run_steps(3);
    let design = bench.editor().document.work.design.clone();
    // As if it had been killed: nothing is told that it ends.
    drop(bench);
    let mut next = Bench::with(Setup { safe: safe.clone(), ..Setup::default() });
    next.harness.run_steps(3);
    next.click("Go on");
    next.harness.run_steps(3);
    assert_eq!(next.editor().document.work.design, design);
    assert!(next.editor().document.is_changed());
}

#[test]
fn a_bad_file_is_told_and_nothing_is_lost() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bad.toml");
    std::fs::write(
        &path,
        "format = 1\nname = \"x\"\nmaterial = \"diamond\"\n[round_brilliant]\ntable = 5x\n",
    )
    .unwrap();
    let mut bench = Bench::new();
    let before = bench.brilliant();
    bench.choices.lock().unwrap().push(path);
    bench.choose("File", "Open…");
    bench.settle();
    assert_eq!(bench.brilliant(), before);
    assert!(bench.harness.query_by_label_contains("bad.toml:5").is_some());
    bench.click("Dismiss");
    assert!(bench.harness.query_by_label_contains("bad.toml:5").is_none());
}

#[test]
fn a_number_out_of_its_limits_is_told_where_it_stands_and_the_last_stone_stays() {
    let mut bench = Bench::new();
    bench.settle();
    let stone = Arc::clone(bench.editor().document.specimen());
    bench.type_number("Table", "97");
    assert!(bench.harness.query_by_label_contains("table: 97 % must be below").is_some());
    assert!(Arc::ptr_eq(&stone, bench.editor().document.specimen()));
}

#[test]
fn every_view_shows_a_picture() {
    for (k, shows) in crate::app::shows::Shows::ALL.into_iter().enumerate() {
        let mut bench = Bench::new();
        bench.harness.state_mut().desk.panes[0].shows = shows;
        bench.settle();
        if shows != crate::app::shows::Shows::Profile {
            let picture = bench.picture(0);
            assert!(picture.iter().any(|p| *p != picture[0]), "{k}: {shows:?} is empty");
        }
    }
}

#[test]
fn keys_tilt_and_bring_back() {
    let mut bench = Bench::new();
    bench.settle();
    bench.harness.key_press(egui::Key::F);
    bench.harness.run_steps(2);
    assert!(bench.editor().desk.eye.tilt() > 0.3);
    bench.harness.key_press(egui::Key::B);
    bench.harness.run_steps(2);
    assert!(bench.editor().desk.eye.from_below && bench.editor().desk.eye.tilt() == 0.0);
    bench.harness.key_press(egui::Key::T);
    bench.harness.run_steps(2);
    assert!(!bench.editor().desk.eye.from_below);
    bench.harness.key_press(egui::Key::Num1);
    bench.settle();
    assert_eq!(bench.editor().desk.shown(), [0]);
}

#[test]
fn nothing_is_drawn_again_while_nothing_changes() {
    let mut bench = Bench::new();
    bench.settle();
    let count = bench.harness.run();
    assert!(count <= 3, "{count} frames for nothing");
}
