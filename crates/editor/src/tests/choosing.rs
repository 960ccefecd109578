//! Tests of the chooser of cuts: from the menu, from the row of the design panel, and by keys.

use super::*;
use crate::library_cuts::library_cuts;
use brillianteer_session::model::dialog::Dialog;
use egui::{Key, Role};

fn is_open(bench: &Bench) -> bool {
    matches!(bench.editor().model.session.dialog, Some(Dialog::Cuts))
}

fn name(bench: &Bench) -> &str {
    &bench.editor().model.document.work.design.name
}

#[test]
fn a_cut_is_chosen_from_the_menu_and_the_next_one_from_its_row() {
    let mut bench = Bench::new();
    bench.choose("File", "New from a cut…");
    assert!(is_open(&bench));
    for heading in ["Rounds", "Fancy brilliant cuts", "Glass"] {
        assert!(bench.harness.query_by_label(heading).is_some(), "{heading}");
    }
    for cut in library_cuts() {
        assert!(bench.harness.query_by_role_and_label(Role::Button, &cut.title).is_some(), "{}", cut.title);
    }
    bench.click("Portuguese");
    assert_eq!((name(&bench), is_open(&bench)), ("Portuguese", false));
    assert_eq!(bench.editor().model.document.work.design.cut.family().unwrap().key, "portuguese");
    bench.click("Portuguese cut…");
    assert!(is_open(&bench));
    bench.click("Old European");
    assert_eq!((name(&bench), is_open(&bench)), ("Old European", false));
}

#[test]
fn keys_open_the_chooser_move_in_it_choose_and_leave() {
    let mut bench = Bench::new();
    let open = |bench: &mut Bench| {
        bench.harness.key_press_modifiers(egui::Modifiers::COMMAND, Key::N);
        bench.harness.run_steps(4);
        assert!(is_open(bench));
    };
    open(&mut bench);
    assert!(bench.field(Role::Button, &library_cuts()[0].title).is_focused());
    bench.harness.key_press(Key::Escape);
    bench.harness.run_steps(3);
    assert_eq!((name(&bench), is_open(&bench)), ("Tolkowsky 1919", false));
    open(&mut bench);
    bench.harness.key_press(Key::Tab);
    bench.harness.run_steps(3);
    let second = &library_cuts()[1].title;
    assert!(bench.field(Role::Button, second).is_focused());
    bench.harness.key_press(Key::Enter);
    bench.harness.run_steps(4);
    assert_eq!((name(&bench), is_open(&bench)), (second.as_str(), false));
}

#[test]
fn a_file_with_unsaved_work_is_asked_about_before_another_cut_begins() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.toml");
    std::fs::write(&path, brillianteer_files::library::cut("tolkowsky").unwrap()).unwrap();
    let mut bench = Bench::with(Setup { file: Some(path), ..Setup::default() });
    bench.wait(|editor| editor.model.document.path().is_some());
    bench.type_number("Table", "58");
    bench.click("Round brilliant…");
    bench.click("Dutch rose");
    assert!(matches!(bench.editor().model.session.dialog, Some(Dialog::Unsaved(_))));
    bench.click("Cancel");
    assert!((bench.brilliant().table - 58.0).abs() < 1e-12);
}
