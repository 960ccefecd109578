//! Tests of dialogs: their questions, the keys Return and Escape in them, and the reports of an export.

use super::fitting::pick;
use super::*;
use brillianteer_files::cut_file;
use brillianteer_paper::export::OutputFormat;
use brillianteer_session::model::{
    action::FileAction,
    dialog::{Dialog, Then},
    export::Selection,
    exporting::{ExportEvent, ExportRun},
    plan::export_plan,
};
use brillianteer_session::tasks::export::run;
use egui::{Key, Role};
use std::path::Path;

#[test]
fn the_field_for_a_path_has_the_focus_and_return_takes_only_what_was_typed() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("typed.toml");
    let mut bench = Bench::new();
    bench.choose("File", "Save as…");
    bench.wait(|editor| matches!(editor.model.session.dialog, Some(Dialog::Path(_))));
    assert!(bench.field(Role::TextInput, "Path").is_focused());
    bench.harness.key_press(Key::Enter);
    bench.harness.run_steps(3);
    assert!(
        matches!(bench.editor().model.session.dialog, Some(Dialog::Path(_))),
        "nobody has typed that path"
    );
    assert!(bench.editor().model.document.path().is_none());
    assert!(bench.field(Role::TextInput, "Path").is_focused(), "it can still be typed");
    bench.harness.key_press_modifiers(egui::Modifiers::COMMAND, Key::A);
    bench.harness.event(egui::Event::Text(path.display().to_string()));
    bench.harness.run_steps(2);
    bench.harness.key_press(Key::Enter);
    bench.wait(|editor| editor.model.document.path().is_some());
    assert!(bench.editor().model.session.dialog.is_none());
    assert_eq!(cut_file::read(&path).unwrap(), bench.editor().model.document.work.design);
}

/// Opens the export dialog and asks for PNG files of all scopes, `size` pixels wide, in a folder.
fn export(bench: &mut Bench, folder: &Path, size: u32) {
    bench.harness.run_steps(2);
    bench.choose("File", "Export…");
    let Some(Dialog::Export(export)) = &mut bench.harness.state_mut().model.session.dialog else { panic!() };
    export.plan.folder = folder.to_owned();
    let selection = &mut export.plan.selection;
    selection.views = vec![Shows::Aset, Shows::AsetWhite, Shows::IdealScope, Shows::Hearts, Shows::Arrows];
    (selection.size, selection.formats) = (size, vec![OutputFormat::Png]);
    bench.harness.run_steps(2);
}

fn job(editor: &Editor) -> Option<&ExportRun> {
    match &editor.model.session.dialog {
        Some(Dialog::Export(export)) => export.run.as_ref(),
        _ => None,
    }
}

#[test]
fn a_stopped_export_says_how_far_it_came_and_its_button_stays_in_its_place() {
    let folder = tempfile::tempdir().unwrap();
    // High enough to show the whole dialog.
    let mut bench = Bench::sized(Setup::default(), egui::vec2(1000.0, 900.0));
    export(&mut bench, folder.path(), 1500);
    bench.click("Write files");
    bench.harness.run_steps(2);
    let first = bench.harness.get_by_label("Stop").rect();
    let standing = job(bench.editor()).map(ExportRun::standing).unwrap();
    assert!(standing.starts_with("tolkowsky-1919-aset") && standing.contains(" of 10"), "{standing}");
    assert!(bench.harness.query_by_label_contains(" of 10").is_some());
    bench.wait(|editor| job(editor).is_some_and(|job| job.written >= 2));
    assert_eq!(bench.harness.get_by_label("Stop").rect(), first, "it runs away under the pointer");
    bench.harness.key_press(Key::Escape);
    bench.wait(|editor| job(editor).is_some_and(|job| job.end.is_some()));
    let (done, written) = job(bench.editor()).map(|job| (job.done(), job.written)).unwrap();
    assert!(done < 0.95 && written < 10, "stopped at {done} with {written} files");
    assert!(bench.harness.query_by_label_contains(&format!("{written} of 10 files written")).is_some());
    assert_eq!(bench.harness.get_by_label("Close").rect().min, first.min, "it takes the place of Stop");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), written);
    bench.harness.key_press(Key::Escape);
    bench.harness.run_steps(2);
    assert!(bench.editor().model.session.dialog.is_none());
}

#[test]
fn escape_closes_every_small_window() {
    let mut bench = Bench::new();
    bench.harness.run_steps(2);
    bench.choose("File", "Export…");
    bench.harness.key_press(Key::Escape);
    bench.harness.run_steps(2);
    assert!(bench.editor().model.session.dialog.is_none(), "export");
    bench.harness.key_press(Key::F1);
    bench.harness.run_steps(2);
    assert!(bench.editor().model.session.dialog.is_some());
    bench.harness.key_press(Key::Escape);
    bench.harness.run_steps(2);
    assert!(bench.editor().model.session.dialog.is_none(), "keys and terms");
    bench.harness.state_mut().model.session.dialog = Some(Dialog::ChangedOutside);
    bench.harness.run_steps(2);
    bench.harness.key_press(Key::Escape);
    bench.harness.run_steps(2);
    assert!(bench.editor().model.session.dialog.is_none(), "the file has changed");
    bench.harness.key_press(Key::L);
    bench.harness.run_steps(2);
    bench.field(Role::TextInput, "Name").focus();
    bench.harness.run_steps(2);
    bench.harness.key_press(Key::Escape);
    bench.harness.run_steps(2);
    assert!(bench.editor().model.session.followed.is_open, "the first press ends what is typed");
    bench.harness.key_press(Key::Escape);
    bench.harness.run_steps(2);
    assert!(!bench.editor().model.session.followed.is_open, "the light path");
}

#[test]
fn a_click_beside_the_stone_opens_no_light_path() {
    let mut bench = Bench::new();
    bench.harness.run_steps(3);
    let picture = bench.harness.get_by_label("ASET picture").rect();
    bench.click_at(picture.left_top() + egui::vec2(6.0, 6.0));
    (0..40).for_each(|_| bench.harness.step());
    assert!(!bench.editor().model.session.followed.is_open);
    bench.click_at(picture.center() + egui::vec2(20.0, 10.0));
    (0..40).for_each(|_| bench.harness.step());
    assert!(bench.editor().model.session.followed.is_open);
}

/// Exports from an editor in its present state what `select` selects, 64 pixels wide, and returns the files in the order of
/// their names.
fn exported(bench: &Bench, select: impl FnOnce(&mut Selection)) -> Vec<Vec<u8>> {
    let folder = tempfile::tempdir().unwrap();
    let mut plan = export_plan(&bench.editor().model);
    plan.folder = folder.path().to_owned();
    plan.stem = "stone".to_owned();
    plan.selection.size = 64;
    select(&mut plan.selection);
    let end = Mutex::new(None);
    let hear = |event| {
        if let ExportEvent::Ended(how) = event {
            *end.lock().unwrap() = Some(how);
        }
    };
    run(&plan, &hear, &|| false);
    assert_eq!(end.into_inner().unwrap(), Some(Ok(())));
    // The names contain the tilt, so that they differ where the view leans; their order does not.
    let mut files: Vec<_> =
        std::fs::read_dir(folder.path()).unwrap().map(|file| file.unwrap().path()).collect();
    files.sort();
    files.iter().map(|file| std::fs::read(file).unwrap()).collect()
}

/// Exports what `select` selects from an editor in which only the view of that has a tilt of its own, and compares the files
/// with those of a stone that is upright and of one whose linked views have the same tilt.
fn is_exported_as_its_own_view_shows_it(bench: &mut Bench, count: usize, select: fn(&mut Selection)) {
    bench.harness.run_steps(2);
    let upright = exported(bench, select);
    assert_eq!(upright.len(), count);
    let workspace = &mut bench.harness.state_mut().model.workspace;
    let mut eye = workspace.eye;
    (eye.lean, eye.turn) = (glam::DVec2::new(0.3, 0.1), 0.2);
    workspace.panes[0].own = Some(eye);
    bench.harness.run_steps(2);
    let own = exported(bench, select);
    let workspace = &mut bench.harness.state_mut().model.workspace;
    (workspace.eye, workspace.panes[0].own) = (eye, None);
    bench.harness.run_steps(2);
    assert_ne!(own, upright);
    assert!(own == exported(bench, select), "linked at the same tilt it is the same file");
}

#[test]
fn a_view_that_is_not_linked_is_exported_as_it_is_seen() {
    // The ASET has two pictures: by energy and by strongest exits.
    is_exported_as_its_own_view_shows_it(&mut Bench::new(), 2, |s| s.views = vec![Shows::Aset]);
}

#[test]
fn a_refraction_map_whose_view_is_not_linked_is_exported_as_it_is_seen() {
    let mut bench = Bench::new();
    bench.harness.state_mut().model.workspace.show(0, Shows::Refraction);
    // The map, its diffuse layer and the page.
    is_exported_as_its_own_view_shows_it(&mut bench, 3, |s| (s.views, s.map) = (vec![], true));
}

#[test]
fn what_was_recovered_says_when_it_was_changed_and_not_when_the_program_ended() {
    let folder = tempfile::tempdir().unwrap();
    let setup = || Setup { safe: Some(folder.path().to_owned()), ..Setup::default() };
    let mut bench = Bench::with(setup());
    bench.type_number("Table", "59.5");
    bench.harness.run_steps(3);
    drop(bench);
    // As if the work was last changed some time before the program ended.
    let changed = std::time::SystemTime::now() - Duration::from_secs(125);
    for file in std::fs::read_dir(folder.path()).unwrap() {
        std::fs::File::options()
            .append(true)
            .open(file.unwrap().path())
            .unwrap()
            .set_modified(changed)
            .unwrap();
    }
    let mut next = Bench::with(setup());
    next.harness.run_steps(3);
    assert!(next.harness.query_by_label_contains("The program ended before").is_some());
    assert!(next.harness.query_by_label_contains("It was last changed 2 minutes ago").is_some());
    next.harness.key_press(Key::Escape);
    next.harness.run_steps(2);
    assert!(next.editor().model.session.dialog.is_none(), "it is offered again at the next start");
    let names = std::fs::read_dir(folder.path()).unwrap().map(|file| file.unwrap().file_name());
    assert_eq!(names.filter(|name| name.to_string_lossy().starts_with("unsaved-")).count(), 1);
}

#[test]
fn the_sheet_of_an_oval_is_exported_with_the_names_that_its_tiers_get() {
    let folder = tempfile::tempdir().unwrap();
    let mut bench = Bench::sized(Setup::default(), egui::vec2(1000.0, 900.0));
    bench.harness.state_mut().act(FileAction::Ask(Then::Library("oval".to_owned())));
    bench.settle();
    export(&mut bench, folder.path(), 64);
    let Some(Dialog::Export(form)) = &mut bench.harness.state_mut().model.session.dialog else { panic!() };
    form.plan.selection.views.clear();
    bench.harness.run_steps(2);
    bench.click("Cutter's sheet");
    bench.settle();
    assert!(bench.harness.query_by_label("oval-1.40-sheet.pdf").is_some());
    pick(&mut bench, "Format of the sheet", "SVG");
    pick(&mut bench, "Paper of the sheet", "US letter");
    bench.click("Left-handed gear");
    bench.settle();
    // The list names every page before any is written.
    assert!(bench.harness.query_by_label("oval-1.40-sheet.svg").is_some());
    bench.click("Write files");
    bench.wait(|editor| job(editor).is_some_and(|job| job.end.is_some()));
    let run = job(bench.editor()).unwrap();
    assert_eq!((run.end.clone(), run.written), (Some(Ok(())), run.files.len()));
    let pages: Vec<String> = run.files.iter().map(|file| std::fs::read_to_string(file).unwrap()).collect();
    let text = pages.concat();
    for said in ["width=\"215.9mm\"", "P1", "G1", "C1", "Meet ", "between teeth", "clockwise"] {
        assert!(text.contains(said), "{said} is missing");
    }
    assert!(!text.contains("bezel"));
}
