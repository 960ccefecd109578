//! Tests of files: opening and saving them, changes by other programs, and recovery after a crash.

use super::*;
use brillianteer_files::cut_file;
use brillianteer_session::model::{
    action::FileAction, dialog::Dialog, document::Document, opening::OpeningPurpose,
};

#[test]
fn a_file_that_others_change_is_read_again_and_asked_about_where_work_would_be_lost() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.toml");
    let mut design = Document::first().unwrap().work.design;
    std::fs::write(&path, cut_file::write(&design)).unwrap();
    let mut bench = Bench::with(Setup { file: Some(path.clone()), ..Setup::default() });
    bench.settle();
    design.name = "Changed outside once".to_owned();
    std::fs::write(&path, cut_file::write(&design)).unwrap();
    bench.wait(|editor| editor.model.document.work.design.name == "Changed outside once");
    bench.type_number("Table", "57");
    design.name = "Changed outside a second time".to_owned();
    std::fs::write(&path, cut_file::write(&design)).unwrap();
    bench.wait(|editor| editor.model.session.dialog.is_some());
    bench.click("Keep my changes");
    assert!((bench.brilliant().table - 57.0).abs() < 1e-12);
    bench.choose("Edit", "Undo");
    assert!(!bench.editor().model.document.is_changed());
    std::fs::remove_file(&path).unwrap();
    bench.wait(|editor| editor.model.document.is_changed());
    assert!(bench.harness.query_by_label_contains("no longer exists").is_some());
}

#[test]
fn a_file_that_comes_after_a_change_is_asked_about() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("other.toml");
    let design = Document::of_library("modern-ideal").unwrap().work.design;
    std::fs::write(&path, cut_file::write(&design)).unwrap();
    let mut bench = Bench::new();
    bench.settle();
    let editor = bench.harness.state_mut();
    editor.act(FileAction::Open(path.clone(), OpeningPurpose::Anew));
    editor.model.document.work.design.name = "changed meanwhile".to_owned();
    bench.wait(|editor| editor.model.session.dialog.is_some());
    assert!(!bench.editor().model.document.work.design.eq(&design));
    bench.click("Don't save");
    bench.wait(|editor| editor.model.document.work.design.eq(&design));
}

#[test]
fn keys_with_shift_are_not_those_without() {
    let folder = tempfile::tempdir().unwrap();
    let [first, second] = ["first.toml", "second.toml"].map(|name| folder.path().join(name));
    let text = cut_file::write(&Document::first().unwrap().work.design);
    std::fs::write(&first, &text).unwrap();
    let mut bench = Bench::with(Setup { file: Some(first.clone()), ..Setup::default() });
    bench.settle();
    bench.type_number("Table", "57");
    let with_shift = egui::Modifiers::COMMAND | egui::Modifiers::SHIFT;
    bench.harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::Z);
    bench.harness.run_steps(2);
    assert!(bench.brilliant().table < 56.0);
    bench.harness.key_press_modifiers(with_shift, egui::Key::Z);
    bench.harness.run_steps(2);
    assert!((bench.brilliant().table - 57.0).abs() < 1e-12);
    bench.choices.lock().unwrap().push(second.clone());
    bench.harness.key_press_modifiers(with_shift, egui::Key::S);
    bench.wait(|editor| !editor.model.document.is_changed());
    assert_eq!((std::fs::read_to_string(&first).unwrap(), second.exists()), (text, true));
}

#[test]
fn what_is_put_off_until_work_is_saved_is_done_once_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.toml");
    std::fs::write(&path, cut_file::write(&Document::first().unwrap().work.design)).unwrap();
    let mut bench = Bench::with(Setup { file: Some(path.clone()), ..Setup::default() });
    bench.wait(|editor| editor.model.document.path().is_some());
    bench.type_number("Table", "58");
    bench.choose("File", "New from a cut…");
    bench.harness.get_by_label("Modern ideal").click();
    bench.harness.run_steps(4);
    // The first "Save" is in the menu, which is still fading away.
    bench.harness.get_all_by_label("Save").last().unwrap().click();
    bench.wait(|editor| editor.model.document.work.design.name == "Modern ideal");
    assert!(std::fs::read_to_string(&path).unwrap().contains("table = 58"));
}

#[test]
fn what_was_recovered_is_kept_until_it_is_saved() {
    let folder = tempfile::tempdir().unwrap();
    let setup = || Setup { safe: Some(folder.path().to_owned()), ..Setup::default() };
    let mut bench = Bench::with(setup());
    bench.type_number("Table", "59.5");
    bench.harness.run_steps(3);
    drop(bench);
    for _ in 0..2 {
        let mut next = Bench::with(setup());
        next.harness.run_steps(3);
        next.click("Recover");
        next.harness.run_steps(3);
        assert!((next.brilliant().table - 59.5).abs() < 1e-12);
    }
    let mut last = Bench::with(setup());
    last.harness.run_steps(3);
    last.click("Discard");
    drop(last);
    let none = Bench::with(setup());
    assert!(none.editor().model.session.dialog.is_none());
}

#[test]
fn where_the_system_opens_no_dialog_the_path_is_typed() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("typed.toml");
    let mut bench = Bench::new();
    // The chooser reports at once that the system has no dialog.
    bench.choose("File", "Save as…");
    bench.wait(|editor| matches!(editor.model.session.dialog, Some(Dialog::Path(_))));
    bench.harness.get_by_role_and_label(egui::Role::TextInput, "Path").focus();
    bench.harness.run_steps(2);
    bench.harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::A);
    bench.harness.event(egui::Event::Text(path.display().to_string()));
    bench.harness.run_steps(2);
    bench.click("Save");
    bench.wait(|editor| editor.model.document.path().is_some());
    assert!(bench.editor().model.session.dialog.is_none());
    assert_eq!(cut_file::read(&path).unwrap(), bench.editor().model.document.work.design);
    assert_eq!(bench.editor().model.document.path(), Some(path.as_path()));
}
