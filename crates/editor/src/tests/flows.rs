//! Tests of whole tasks, from the user's first click to the last.

use super::*;
use brillianteer_cut::Crown;
use brillianteer_files::cut_file;
use brillianteer_render::{MeasureOptions, measure};
use brillianteer_session::model::dialog::Dialog;
use egui_kittest::kittest::NodeT;

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
    assert!(!bench.editor().model.document.steps().0);
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
    assert!(!bench.editor().model.document.is_changed());
    let design = bench.editor().model.document.work.design.clone();
    assert_eq!(cut_file::read(&path).unwrap(), design);
    let shown = &bench.editor().model.session.measured.figures[&Which::Present];
    let measured = measure(&cut_file::read(&path).unwrap(), &MeasureOptions::default()).unwrap();
    assert_eq!(shown.grade, Grade::Fine);
    assert_eq!(shown.figures, measured.figures);
    let mut again = Bench::with(Setup { file: Some(path), ..Setup::default() });
    again.settle();
    assert_eq!(again.editor().model.document.work.design, design);
    assert_eq!(again.picture(0), bench.picture(0));
}

#[test]
fn unsaved_work_is_asked_about_before_it_is_lost() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("other.toml");
    std::fs::write(&path, brillianteer_files::library::cut("modern-ideal").unwrap()).unwrap();
    let open = |bench: &mut Bench| {
        bench.choices.lock().unwrap().push(path.clone());
        bench.choose("File", "Open…");
        bench.settle();
    };
    let mut bench = Bench::new();
    bench.type_number("Table", "58");
    open(&mut bench);
    bench.click("Cancel");
    assert!((bench.brilliant().table - 58.0).abs() < 1e-12);
    open(&mut bench);
    bench.click("Don't save");
    bench.settle();
    assert_eq!(bench.editor().model.document.work.design.name, "Modern ideal");
}

#[test]
fn a_cut_that_comes_with_the_program_takes_the_place_of_unsaved_work_as_a_step_of_undo() {
    let mut bench = Bench::new();
    bench.type_number("Table", "58");
    bench.choose("File", "New from a cut…");
    bench.harness.get_by_label("Modern ideal").click();
    bench.harness.run_steps(4);
    assert_eq!(bench.editor().model.document.work.design.name, "Modern ideal");
    bench.harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::Z);
    bench.harness.run_steps(3);
    assert!((bench.brilliant().table - 58.0).abs() < 1e-12);
}

#[test]
fn a_crash_loses_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let safe = Some(folder.path().to_owned());
    let mut bench = Bench::with(Setup { safe: safe.clone(), ..Setup::default() });
    bench.type_number("Table", "59.5");
    bench.harness.run_steps(3);
    let design = bench.editor().model.document.work.design.clone();
    // As if the program had been killed: the editor gets no notice of the end.
    drop(bench);
    let mut next = Bench::with(Setup { safe: safe.clone(), ..Setup::default() });
    next.harness.run_steps(3);
    next.click("Recover");
    next.harness.run_steps(3);
    assert_eq!(next.editor().model.document.work.design, design);
    assert!(next.editor().model.document.is_changed());
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
    let stone = Arc::clone(bench.editor().model.document.specimen());
    bench.type_number("Table", "97");
    assert!(bench.harness.query_by_label_contains("Table: 97 % is impossible").is_some());
    assert!(Arc::ptr_eq(&stone, bench.editor().model.document.specimen()));
}

#[test]
fn every_view_shows_a_picture() {
    for (k, shows) in Shows::ALL.into_iter().enumerate() {
        // A small window, because maps and renders take long.
        let mut bench = Bench::sized(Setup::default(), egui::vec2(900.0, 300.0));
        bench.harness.state_mut().model.workspace.panes[0].shows = shows;
        bench.look();
        if shows != Shows::Profile {
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
    assert_eq!(bench.editor().model.workspace.eye.tilt(), 0.0, "the view had no tilt before");
    bench.harness.state_mut().model.workspace.eye.lean = glam::DVec2::new(-0.25, -0.55);
    bench.harness.key_press(egui::Key::T);
    bench.harness.run_steps(2);
    assert_eq!(bench.editor().model.workspace.eye.tilt(), 0.0);
    bench.harness.key_press(egui::Key::F);
    bench.harness.run_steps(2);
    assert!(bench.editor().model.workspace.eye.tilt() > 0.3);
    bench.harness.key_press(egui::Key::B);
    bench.harness.run_steps(2);
    assert!(
        bench.editor().model.workspace.eye.from_below && bench.editor().model.workspace.eye.tilt() == 0.0
    );
    bench.harness.key_press(egui::Key::T);
    bench.harness.run_steps(2);
    assert!(!bench.editor().model.workspace.eye.from_below);
    bench.harness.key_press(egui::Key::Num1);
    bench.settle();
    assert_eq!(bench.editor().model.workspace.shown(), [0]);
    // Four changes of the view, each undone by itself. The design stays as it is.
    let tilts = |bench: &mut Bench, modifiers| {
        bench.harness.key_press_modifiers(modifiers, egui::Key::Backspace);
        bench.harness.run_steps(2);
        let workspace = &bench.editor().model.workspace;
        (workspace.shown().len(), workspace.eye.from_below, workspace.eye.tilt() > 0.3)
    };
    let back: Vec<_> = (0..4).map(|_| tilts(&mut bench, egui::Modifiers::NONE)).collect();
    assert_eq!(back, [(2, false, false), (2, true, false), (2, false, true), (2, false, false)]);
    assert_eq!(tilts(&mut bench, egui::Modifiers::SHIFT), (2, false, true));
    assert!(
        !bench.editor().model.document.is_changed()
            && bench.editor().model.document.steps() == (false, false)
    );
}

#[test]
fn nothing_is_drawn_again_while_nothing_changes() {
    let mut bench = Bench::new();
    bench.settle();
    let count = bench.harness.run();
    assert!(count <= 3, "{count} frames for nothing");
}

#[test]
fn every_view_is_exported_as_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let mut bench = Bench::new();
    bench.choose("File", "Export…");
    let Some(Dialog::Export(export)) = &mut bench.harness.state_mut().model.session.dialog else { panic!() };
    export.plan.folder = folder.path().join("out");
    bench.harness.run_steps(2);
    for shows in Shows::EXPORTED {
        let box_ = bench.harness.get_by_role_and_label(egui::Role::CheckBox, shows.name());
        if box_.accesskit_node().toggled() != Some(egui::accesskit::Toggled::True) {
            box_.click();
            bench.harness.run_steps(2);
        }
    }
    ["SVG", "JSON", "Refraction map and page", "Scene file and its cuts"]
        .into_iter()
        .for_each(|name| bench.click(name));
    let size = bench.harness.get_by_role_and_label(egui::Role::SpinButton, "Size");
    size.focus();
    bench.type_number("Size", "96");
    bench.click("Write files");
    bench.wait(|editor| matches!(&editor.model.session.dialog, Some(Dialog::Export(e)) if !e.is_busy()));
    let Some(Dialog::Export(export)) = &bench.editor().model.session.dialog else { panic!() };
    assert_eq!(export.run.as_ref().and_then(|run| run.end.clone()), Some(Ok(())));
    assert!(bench.harness.query_by_label("All files have been written.").is_some());
    let names: Vec<String> = std::fs::read_dir(folder.path().join("out"))
        .unwrap()
        .map(|f| f.unwrap().file_name().to_string_lossy().into_owned())
        .collect();
    for shows in Shows::EXPORTED {
        let name = format!("tolkowsky-1919-{}.png", shows.key());
        assert!(names.contains(&name), "{name} is missing in {names:?}");
    }
    assert!(names.contains(&"tolkowsky-1919-figures.json".to_owned()) && names.len() > 20, "{names:?}");
    let map = ["refraction.png", "refraction.html", "scene.toml", "cut.toml"]
        .map(|end| format!("tolkowsky-1919-{end}"));
    assert!(map.iter().all(|name| names.contains(name)), "{names:?}");
    bench.click("Close");
    assert!(bench.editor().model.session.dialog.is_none());
}

#[test]
fn the_profile_is_pulled_into_another_shape() {
    let mut workspace = Bench::small();
    workspace.panes[1].shows = Shows::Profile;
    let mut bench = Bench::with(Setup { workspace, ..Setup::default() });
    bench.settle();
    let before = (bench.brilliant(), bench.picture(0));
    let tip = bench.harness.get_by_label("Pavilion depth, percent").rect().center();
    bench.harness.hover_at(tip);
    bench.harness.step();
    bench.harness.drag_at(tip);
    bench.harness.step();
    for down in [4.0, 8.0, 12.0] {
        bench.harness.hover_at(tip + egui::vec2(0.0, down));
        bench.harness.step();
    }
    bench.harness.drop_at(tip + egui::vec2(0.0, 12.0));
    bench.settle();
    let deeper = bench.brilliant().derived().unwrap().pavilion_depth;
    assert!(deeper > before.0.derived().unwrap().pavilion_depth + 1.0, "{deeper}");
    assert_ne!(bench.picture(0), before.1);
    bench.choose("Edit", "Undo");
    bench.settle();
    assert_eq!((bench.brilliant(), bench.picture(0)), before, "a drag is one step");
}

#[test]
fn a_click_follows_a_ray_and_a_double_click_enlarges() {
    let mut bench = Bench::new();
    bench.settle();
    let at = bench.harness.get_by_label("ASET picture").rect().center() + egui::vec2(30.0, 10.0);
    bench.click_at(at);
    (0..40).for_each(|_| bench.harness.step());
    assert!(bench.editor().model.session.followed.is_open);
    assert!(bench.harness.query_by_label_contains("Light path through the stone").is_some());
    bench.harness.key_press(egui::Key::L);
    // The light path fades away.
    bench.harness.run_steps(30);
    assert!(!bench.editor().model.session.followed.is_open);
    bench.click_at(at);
    bench.click_at(at);
    (0..40).for_each(|_| bench.harness.step());
    assert_eq!(
        (bench.editor().model.workspace.large, bench.editor().model.session.followed.is_open),
        (Some(0), false)
    );
}

#[test]
fn space_follows_the_ray_in_the_middle_of_the_picture_that_has_the_focus() {
    let mut bench = Bench::new();
    bench.settle();
    bench.harness.get_by_label("ASET picture").focus();
    bench.harness.run_steps(2);
    bench.harness.key_press(egui::Key::Space);
    (0..40).for_each(|_| bench.harness.step());
    assert!(bench.editor().model.session.followed.is_open);
}

#[test]
fn two_designs_are_compared_and_their_figures_differ() {
    let mut bench = Bench::new();
    bench.settle();
    bench.choose("Compare", "Compare with saved");
    bench.type_number("Pavilion angle", "42.2");
    bench.settle();
    let figures = |which| &bench.editor().model.session.measured.figures[&which].figures;
    assert_ne!(figures(Which::Present), figures(Which::Other));
    let pictures = |which| bench.editor().views.gallery.traced[&(0, which)].taken.image.clone();
    assert_ne!(pictures(Which::Present), pictures(Which::Other));
    assert_eq!(bench.harness.query_all_by_label("present").count(), 2);
    bench.harness.key_down(egui::Key::C);
    bench.harness.run_steps(2);
    assert_eq!(bench.harness.query_all_by_label("as saved").count(), 2);
    bench.harness.key_up(egui::Key::C);
    bench.harness.run_steps(2);
    assert_eq!(bench.harness.query_all_by_label("as saved").count(), 0);
}

#[test]
fn keys_work_and_steps_end_while_a_handle_has_the_focus() {
    let mut workspace = Bench::small();
    workspace.panes[1].shows = Shows::Profile;
    let mut bench = Bench::with(Setup { workspace, ..Setup::default() });
    bench.harness.run_steps(2);
    bench.harness.get_by_label("Crown angle, degrees").focus();
    bench.harness.run_steps(2);
    let before = bench.brilliant();
    for _ in 0..2 {
        bench.harness.key_press(egui::Key::ArrowUp);
        bench.harness.run_steps(3);
    }
    assert!(bench.brilliant().derived().unwrap().crown_angle > before.derived().unwrap().crown_angle + 0.15);
    bench.harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::Z);
    bench.harness.run_steps(2);
    assert!(bench.brilliant() != before, "each press is a step");
    bench.harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::Z);
    bench.harness.run_steps(2);
    assert_eq!(bench.brilliant(), before);
    bench.harness.key_press(egui::Key::X);
    bench.harness.run_steps(2);
    assert!(bench.editor().model.workspace.strongest);
    bench.type_number("Table", "54");
    bench.harness.get_by_role_and_label(egui::Role::TextInput, "Name").focus();
    bench.harness.run_steps(2);
    bench.harness.event(egui::Event::Text("x".to_owned()));
    bench.harness.key_press(egui::Key::X);
    bench.harness.run_steps(2);
    assert!(bench.editor().model.workspace.strongest, "a letter typed into a name is no command");
    assert!(bench.editor().model.document.work.design.name.contains('x'));
}

#[test]
fn a_number_that_is_only_looked_at_stays_as_it_is() {
    let mut bench = Bench::new();
    bench.settle();
    let before = bench.editor().model.document.work.clone();
    for name in ["Crown height", "Weight", "Lower half, side", "Pavilion depth"] {
        bench.harness.get_by_role_and_label(egui::Role::SpinButton, name).focus();
        bench.harness.run_steps(2);
        bench.harness.key_press(egui::Key::Tab);
        bench.harness.run_steps(3);
    }
    assert_eq!(bench.editor().model.document.work, before);
}

#[test]
fn a_view_of_its_own_turn_comes_to_rest() {
    let mut bench = Bench::new();
    bench.settle();
    bench.harness.get_all_by_label("Linked").next().unwrap().click();
    bench.harness.run_steps(2);
    bench.harness.state_mut().model.workspace.panes[0].own.as_mut().unwrap().turn = 0.3;
    bench.settle();
    let picture = bench.picture(0);
    bench.harness.state_mut().model.workspace.panes[0].own = None;
    bench.settle();
    assert_ne!(bench.picture(0), picture);
}

#[test]
fn the_total_depth_of_an_oval_is_set_and_says_what_it_moves() {
    let mut bench = Bench::sized(Setup::default(), egui::vec2(1400.0, 900.0));
    bench.choose("File", "New from a cut");
    bench.click("Oval 1.40");
    bench.settle();
    let value = |bench: &Bench, key: &str| {
        let cut = &bench.editor().model.document.work.design.cut;
        (cut.proportion(key).unwrap().get)(cut)
    };
    let [depth, angle, crown] =
        ["total_depth", "pavilion_angle", "crown_angle"].map(|key| value(&bench, key));
    bench.type_number("Total depth", "62.5");
    bench.settle();
    assert!((value(&bench, "total_depth") - 62.5).abs() < 1e-9);
    assert!(value(&bench, "pavilion_angle") > angle && value(&bench, "crown_angle") == crown);
    let said = format!("Total depth by pavilion angle {:.2}°", value(&bench, "pavilion_angle"));
    assert!(bench.harness.query_by_label_contains(&said).is_some(), "{said}");
    // A depth that no stone has is explained at its row, and the last stone stays in sight.
    bench.type_number("Total depth", "12");
    let message =
        "Total depth: 12 % is impossible. With the other proportions as they are, it can be at least ";
    assert!(bench.harness.query_by_label_contains(message).is_some());
    assert!(bench.editor().model.document.shows_last_possible());
    bench.choose("Edit", "Undo");
    bench.choose("Edit", "Undo");
    bench.settle();
    assert_eq!([value(&bench, "total_depth"), value(&bench, "pavilion_angle")], [depth, angle]);
}
