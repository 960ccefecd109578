//! Tests of answers that come late: for another document than the one that is open by then, or under an open dialog.

use super::*;
use crate::model::choosing::Question;
use crate::model::figures::SessionFigures;
use crate::model::motion::WaveCache;
use crate::model::ordering::Orders;
use crate::studio::{FiguresOrder, Grade};
use brillianteer_cut::Design;
use brillianteer_measure::Figures;

/// Asks for a file to save to, and answers with `path`.
fn save_as(bench: &mut Bench, path: &Path) -> Vec<Task> {
    let question = question(bench.act(Command::SaveAs));
    bench.act(FileAction::Chosen(question, Choice::File(path.to_owned())))
}

/// Returns the question of the file dialog that a task opens.
fn question(tasks: Vec<Task>) -> Question {
    let asked = |task| if let Task::ChooseFile(question) = task { Some(question) } else { None };
    tasks.into_iter().find_map(asked).unwrap()
}

/// Begins a design from a cut that comes with the program.
fn begin_another(bench: &mut Bench) -> Vec<Task> {
    bench.act(FileAction::Ask(Then::Library("modern-ideal".to_owned())))
}

#[test]
fn a_design_that_is_saved_late_gives_the_next_one_no_file_and_what_waits_for_that_one_goes_on_waiting() {
    let folder = tempfile::tempdir().unwrap();
    let mut bench = Bench::new();
    let late = save_as(&mut bench, &folder.path().join("first.toml"));
    begin_another(&mut bench);
    bench.act(Edit::Diameter(7.0));
    let second = folder.path().join("second.toml");
    let tasks = save_as(&mut bench, &second);
    bench.act(FileAction::Close);
    let after = bench.save(late);
    assert!(!has(&after, |task| matches!(task, Task::Window(_))), "the design that is open is not saved yet");
    let document = &bench.model.document;
    assert!(
        document.path().is_none() && document.is_changed() && document.work.design.name == "Modern ideal"
    );
    assert!(folder.path().join("first.toml").exists());
    let after = bench.save(tasks);
    assert!(bench.model.document.path() == Some(&second) && bench.model.session.awaited.saving.is_none());
    assert!(has(&after, |task| matches!(task, Task::Window(WindowTask::Close))));
}

#[test]
fn the_window_that_is_to_close_waits_for_a_design_that_is_no_longer_open_to_be_saved() {
    let folder = tempfile::tempdir().unwrap();
    let mut bench = Bench::new();
    let late = save_as(&mut bench, &folder.path().join("first.toml"));
    begin_another(&mut bench);
    let stays = |task: &Task| matches!(task, Task::Window(WindowTask::StayOpen));
    assert!(has(&bench.act(FileAction::Close), stays));
    let after = bench.save(late);
    assert!(has(&after, |task| matches!(task, Task::Window(WindowTask::Close))));
    assert!(bench.model.document.path().is_none());
}

#[test]
fn what_waited_for_a_document_to_be_saved_is_not_done_once_another_is_open() {
    let mut bench = Bench::new();
    let close_and_save = |bench: &mut Bench| {
        bench.act(Edit::Diameter(7.0));
        bench.act(Command::Quit);
        let tasks = bench.act(DialogAction::Keep);
        assert_eq!(bench.model.session.after_save, Some(Then::Close));
        tasks
    };
    let late = question(close_and_save(&mut bench));
    begin_another(&mut bench);
    bench.act(DialogAction::GiveUp);
    assert_eq!((bench.model.session.begun, &bench.model.session.after_save), (1, &None));
    // The dialog that asks for the file of the first design is still open, and no second one opens.
    assert!(close_and_save(&mut bench).is_empty());
    bench.act(FileAction::Chosen(late, Choice::File("late.toml".into())));
    assert_eq!(bench.model.session.after_save, None);
}

/// Writes a cut that comes with the program to a file.
fn other_file(folder: &Path) -> PathBuf {
    let path = folder.join("other.toml");
    std::fs::write(&path, cut_file::write(&Document::of_library("modern-ideal").unwrap().work.design))
        .unwrap();
    path
}

/// Changes the open file as another program would, and reports it.
fn change_outside(bench: &mut Bench, path: &Path) -> Vec<Task> {
    let design = Design { name: "changed by others".to_owned(), ..bench.model.document.saved().clone() };
    std::fs::write(path, cut_file::write(&design)).unwrap();
    bench.act(FileAction::OnDisk(path.to_owned(), Stamp::of(path)))
}

#[test]
fn a_change_of_the_open_file_by_others_does_not_drop_the_file_that_is_being_opened() {
    let folder = tempfile::tempdir().unwrap();
    let (mut bench, path) = Bench::with_file(folder.path());
    let opening = bench.act(FileAction::Ask(Then::open(other_file(folder.path()))));
    assert!(change_outside(&mut bench, &path).is_empty());
    bench.read(opening);
    assert_eq!(bench.model.document.work.design.name, "Modern ideal");
}

#[test]
fn a_change_by_others_is_read_once_another_file_cannot_be_opened() {
    let folder = tempfile::tempdir().unwrap();
    let (mut bench, path) = Bench::with_file(folder.path());
    let opening = bench.act(FileAction::Ask(Then::open(folder.path().join("nowhere.toml"))));
    change_outside(&mut bench, &path);
    let tasks = bench.read(opening);
    bench.read(tasks);
    assert_eq!(bench.model.document.work.design.name, "changed by others");
}

#[test]
fn a_file_that_is_read_under_a_dialog_about_the_document_waits_until_that_is_answered() {
    let folder = tempfile::tempdir().unwrap();
    let (mut bench, path) = Bench::with_file(folder.path());
    let other = other_file(folder.path());
    let opening = bench.act(FileAction::Ask(Then::open(other.clone())));
    bench.act(Command::Export);
    bench.read(opening);
    assert_eq!(bench.model.document.path(), Some(path.as_path()));
    bench.act(DialogAction::Write);
    bench.act(DialogAction::Exported(ExportEvent::Ended(Ok(()))));
    assert!(matches!(bench.dialog(), Some(Dialog::Export(_))));
    assert_eq!(bench.model.document.path(), Some(path.as_path()));
    bench.act(DialogAction::Leave);
    assert_eq!(bench.model.document.path(), Some(other.as_path()));
    assert!(bench.model.session.awaited.opening.is_empty());
}

#[test]
fn an_error_of_a_file_and_a_file_under_a_dialog_about_the_program_do_not_wait() {
    let folder = tempfile::tempdir().unwrap();
    let mut bench = Bench::new();
    let opening = bench.act(FileAction::Ask(Then::open(folder.path().join("nowhere.toml"))));
    bench.act(Command::Export);
    bench.read(opening);
    assert_eq!(bench.model.session.notes.troubles().len(), 1);
    bench.act(DialogAction::Leave);
    let other = other_file(folder.path());
    let opening = bench.act(FileAction::Ask(Then::open(other.clone())));
    bench.act(Command::Keys);
    bench.read(opening);
    assert_eq!(bench.model.document.path(), Some(other.as_path()));
}

#[test]
fn a_file_that_is_read_while_the_window_waits_to_close_does_not_keep_it_open() {
    let folder = tempfile::tempdir().unwrap();
    let (mut bench, path) = Bench::with_file(folder.path());
    bench.act(Edit::Diameter(7.0));
    bench.act(FileAction::Ask(Then::open(other_file(folder.path()))));
    let opening = bench.act(DialogAction::GiveUp);
    bench.act(Command::Quit);
    let saving = bench.act(DialogAction::Keep);
    bench.read(opening);
    assert_eq!(bench.model.document.path(), Some(path.as_path()));
    let tasks = bench.save(saving);
    assert!(has(&tasks, |task| matches!(task, Task::Window(WindowTask::Close))));
}

#[test]
fn figures_of_a_document_or_of_a_comparison_that_has_ended_are_not_shown() {
    let mut bench = Bench::new();
    let ordered = |bench: &Bench| {
        let (model, mut waves) = (&bench.model, WaveCache::default());
        Orders { model, waves: &mut waves, paper: Paper::default() }.all(&[]).tilts.unwrap()
    };
    let first = ordered(&bench);
    begin_another(&mut bench);
    let second = ordered(&bench);
    let take = |bench: &mut Bench, which: Which, order: &FiguresOrder| {
        bench.act(Computed::Figures(which, order.clone(), Grade::Rough, Box::new(no_figures())));
        bench.act(Computed::Tilts(order.clone(), vec![]));
        let SessionFigures { figures, tilts } = &bench.model.session.measured;
        (figures.contains_key(&which), tilts.is_some())
    };
    assert_eq!(take(&mut bench, Which::Present, &first), (false, false));
    assert_eq!(take(&mut bench, Which::Present, &second), (true, true));
    assert_eq!(take(&mut bench, Which::Other, &second), (false, true));
    bench.act(Command::CompareSaved);
    // The design that is compared with may have been measured under the document before.
    assert_eq!(take(&mut bench, Which::Other, &first), (true, true));
}

fn no_figures() -> Figures {
    Figures {
        silhouette_area: 0.0,
        surface: vec![],
        transmitted: vec![],
        strongest_exit_area: vec![],
        strongest_exit_undecided: 0.0,
        absorbed: 0.0,
        unresolved: 0.0,
        beams: 0,
        standard_error: 0.0,
        estimate: None,
    }
}
