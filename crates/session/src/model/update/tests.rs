//! Tests of the editor without a window: the state that actions lead to, and the tasks that they start.

mod late;
mod maps;

use super::update;
use crate::model::action::{Computed, DialogAction, Edit, FileAction, FrameEnd, ViewAction};
use crate::model::choosing::{Choice, Purpose};
use crate::model::command::Command;
use crate::model::dialog::{Dialog, Then};
use crate::model::document::Document;
use crate::model::exporting::ExportEvent;
use crate::model::opening::{FileRequest, OpenedFile, OpeningPurpose};
use crate::model::plan::export_plan;
use crate::model::saving::Stamp;
use crate::model::task::WindowTask;
use crate::model::workspace::Workspace;
use crate::model::{Action, Model, Task};
use crate::studio::{Order, Paper, ShotLight, Which};
use crate::tasks::autosave::Autosave;
use crate::tasks::open;
use brillianteer_base::Failure;
use brillianteer_files::cut_file;
use brillianteer_files::mesh_options::MeshOptions;
use brillianteer_paper::lighting;
use brillianteer_scene::{Look, USUAL_LIGHT};
use std::path::{Path, PathBuf};

/// An editor without a window.
struct Bench {
    model: Model,
}

impl Bench {
    /// Changes what renders are made with, as a step of undo.
    fn change_look(&mut self, change: impl FnOnce(&mut Look)) -> Vec<Task> {
        let edit = self.model.look_with(change);
        self.act(edit)
    }

    fn new() -> Self {
        let mut model = Model::new(Workspace::default()).unwrap();
        model.session.safe.is_on = true;
        Self { model }
    }

    /// Opens a copy of the first cut that lies in a file.
    fn with_file(folder: &Path) -> (Self, PathBuf) {
        let path = folder.join("mine.toml");
        std::fs::write(&path, cut_file::write(&Document::first().unwrap().work.design)).unwrap();
        let mut bench = Self::new();
        bench.open(&path);
        (bench, path)
    }

    fn act(&mut self, action: impl Into<Action>) -> Vec<Task> {
        update(&mut self.model, action.into())
    }

    /// Ends a frame between two gestures, or in the middle of one.
    fn end_frame(&mut self, is_gesture: bool) -> Vec<Task> {
        self.act(Action::Frame(FrameEnd { now: 0.0, is_gesture }))
    }

    /// Opens a file and carries out the tasks that opening starts.
    fn open(&mut self, path: &Path) {
        let tasks = self.act(FileAction::Ask(Then::open(path.to_owned())));
        self.read(tasks);
    }

    /// Reads the file that a task names.
    fn read(&mut self, tasks: Vec<Task>) -> Vec<Task> {
        let request = request(tasks);
        let read = open::read(&request);
        self.act(FileAction::Opened(request, read))
    }

    /// Saves the design that a task holds.
    fn save(&mut self, tasks: Vec<Task>) -> Vec<Task> {
        let save = |task| if let Task::Save(request) = task { Some(request) } else { None };
        let request = tasks.into_iter().find_map(save).unwrap();
        self.act(FileAction::Saved(request.document, open::save(*request)))
    }

    fn diameter(&self) -> f64 {
        self.model.document.work.design.diameter_mm
    }

    fn dialog(&self) -> Option<&Dialog> {
        self.model.session.dialog.as_ref()
    }
}

/// Returns the request of the task that reads a file.
fn request(tasks: Vec<Task>) -> FileRequest {
    let read = |task| if let Task::Read(request) = task { Some(request) } else { None };
    tasks.into_iter().find_map(read).unwrap()
}

fn has(tasks: &[Task], is: impl Fn(&Task) -> bool) -> bool {
    tasks.iter().any(is)
}

#[test]
fn all_edits_of_a_gesture_are_one_step_that_is_undone_and_done_again() {
    let mut bench = Bench::new();
    let first = bench.model.document.work.clone();
    for mm in [6.6, 6.7, 6.8] {
        bench.act(Edit::Diameter(mm));
        bench.end_frame(true);
    }
    bench.end_frame(false);
    bench.change_look(|look| look.exposure = 1.0);
    bench.end_frame(false);
    let last = bench.model.document.work.clone();
    bench.act(Command::Undo);
    assert_eq!((bench.diameter(), bench.model.document.work.settings.look.exposure), (6.8, 0.0));
    bench.act(Command::Undo);
    assert_eq!(bench.model.document.work, first);
    assert!(!bench.model.is_possible(Command::Undo) && bench.model.is_possible(Command::Redo));
    assert_eq!(bench.model.document.specimen().design.diameter_mm, first.design.diameter_mm);
    bench.act(Command::Redo);
    bench.act(Command::Redo);
    assert_eq!(bench.model.document.work, last);
    // A command that is not possible does nothing.
    bench.act(Command::Redo);
    assert_eq!(bench.model.document.work, last);
}

#[test]
fn a_file_that_comes_after_an_edit_is_asked_about_and_opened_once_that_is_answered() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("other.toml");
    let other = Document::of_library("modern-ideal").unwrap().work.design;
    std::fs::write(&path, cut_file::write(&other)).unwrap();
    let mut bench = Bench::new();
    let tasks = bench.act(FileAction::Ask(Then::open(path.clone())));
    bench.act(Edit::Diameter(7.0));
    bench.read(tasks);
    assert!(matches!(bench.dialog(), Some(Dialog::Unsaved(Then::Open(waiting, _))) if *waiting == path));
    assert_eq!(bench.diameter(), 7.0);
    let tasks = bench.act(DialogAction::GiveUp);
    bench.read(tasks);
    assert_eq!(bench.model.document.work.design, other);
    assert!(bench.dialog().is_none() && bench.model.session.awaited.opening.is_empty());
}

#[test]
fn of_two_files_the_one_that_was_asked_for_last_is_opened() {
    let folder = tempfile::tempdir().unwrap();
    let (mut bench, path) = Bench::with_file(folder.path());
    let other = folder.path().join("other.toml");
    let design = Document::of_library("modern-ideal").unwrap().work.design;
    std::fs::write(&other, cut_file::write(&design)).unwrap();
    let [first, second] =
        [&path, &other].map(|path| request(bench.act(FileAction::Open(path.clone(), OpeningPurpose::Anew))));
    // The older answer comes last, and the editor ignores it.
    for request in [second, first] {
        let read = open::read(&request);
        bench.act(FileAction::Opened(request, read));
    }
    assert_eq!(bench.model.document.work.design, design);
}

#[test]
fn a_design_without_a_file_is_saved_where_the_user_says_and_what_waited_for_it_follows() {
    let folder = tempfile::tempdir().unwrap();
    let other = folder.path().join("other.toml");
    let design = Document::of_library("modern-ideal").unwrap().work.design;
    std::fs::write(&other, cut_file::write(&design)).unwrap();
    let mut bench = Bench::new();
    bench.act(Edit::Diameter(7.0));
    bench.act(FileAction::Ask(Then::open(other)));
    let tasks = bench.act(DialogAction::Keep);
    let Some(Task::ChooseFile(question)) = tasks.into_iter().next() else { panic!() };
    assert_eq!((question.purpose, question.name.as_str()), (Purpose::SaveAs, "tolkowsky-1919.toml"));
    let path = folder.path().join("mine.toml");
    let tasks = bench.act(FileAction::Chosen(question, Choice::File(path.clone())));
    assert!(bench.model.session.awaited.saving.is_some());
    let tasks = bench.save(tasks);
    bench.read(tasks);
    assert_eq!(bench.model.document.work.design.name, "Modern ideal");
    assert!(bench.model.session.awaited.saving.is_none());
    assert_eq!(cut_file::read(&path).unwrap().diameter_mm, 7.0);
}

#[test]
fn work_that_a_crash_left_is_offered_kept_anew_and_forgotten() {
    let folder = tempfile::tempdir().unwrap();
    let mut bench = Bench::new();
    bench.act(Edit::Diameter(7.25));
    let tasks = bench.end_frame(false);
    let mut safe = Autosave::new(folder.path().to_owned());
    let kept = |task| if let Task::Keep(unsaved) = task { Some(unsaved) } else { None };
    let unsaved = tasks.into_iter().find_map(kept).expect("it is kept");
    safe.keep(&unsaved).unwrap();
    drop(safe);
    let found = Autosave::new(folder.path().to_owned()).found();
    let file = found[0].file.clone();
    let mut next = Bench::new();
    next.act(FileAction::Found(found.clone()));
    // The question stays open.
    next.act(FileAction::Ask(Then::Library("modern-ideal".to_owned())));
    assert!(matches!(next.dialog(), Some(Dialog::Recover(_))));
    let tasks = next.act(DialogAction::Recover);
    assert_eq!(next.diameter(), 7.25);
    assert!(next.model.document.is_changed() && next.dialog().is_none());
    // Of several waiting autosaves only the newest is written, so each of them must remove the file.
    let replaces = |task: &Task| matches!(task, Task::Keep(kept) if kept.replaces.as_ref() == Some(&file));
    let mut kept = tasks.iter().filter(|task| !matches!(task, Task::KeepLast(_))).peekable();
    assert!(kept.peek().is_some() && kept.all(replaces) && file.exists());
    next.act(Edit::Diameter(7.5));
    assert!(has(&next.end_frame(false), replaces));
    let forgets = |task: &Task| matches!(task, Task::Forget(path) if *path == file);
    next.act(FileAction::Ask(Then::open("other.toml".into())));
    next.act(DialogAction::GiveUp);
    let tasks = next.act(FileAction::Opened(
        FileRequest {
            purpose: OpeningPurpose::Anew,
            path: "other.toml".into(),
            mesh: MeshOptions::default(),
        },
        Ok(OpenedFile::Design(Box::new(Document::first().unwrap()))),
    ));
    assert!(has(&tasks, forgets));
    assert!(!has(&next.act(FileAction::Ended), forgets), "it is removed once");
    let mut other = Bench::new();
    other.act(FileAction::Found(found));
    let tasks = other.act(DialogAction::Forget);
    assert!(has(&tasks, forgets));
    assert_eq!(other.diameter(), Bench::new().diameter());
}

#[test]
fn saved_work_is_kept_no_longer_and_impossible_work_does_not_replace_the_last_possible() {
    let folder = tempfile::tempdir().unwrap();
    let (mut bench, _) = Bench::with_file(folder.path());
    bench.act(Edit::Diameter(7.0));
    assert!(has(&bench.end_frame(false), |task| matches!(task, Task::Keep(_))));
    let stone = bench.model.document.specimen().clone();
    bench.act(Edit::Name(" ".to_owned()));
    assert!(!has(&bench.end_frame(false), |task| matches!(task, Task::Keep(_))));
    assert!(std::sync::Arc::ptr_eq(&stone, bench.model.document.specimen()));
    bench.act(Command::Undo);
    let tasks = bench.act(Command::Save);
    let tasks = bench.save(tasks);
    assert!(has(&tasks, |task| matches!(task, Task::EmptySafe)) && !bench.model.document.is_changed());
    let is_last = |task: &Task| matches!(task, Task::KeepLast(_));
    assert!(bench.act(FileAction::Ended).iter().all(is_last), "no unsaved work is kept any more");
}

#[test]
fn an_export_writes_what_there_was_when_it_began_and_the_window_waits_for_it() {
    let mut bench = Bench::new();
    let tasks = bench.act(Command::Export);
    assert!(has(&tasks, |task| matches!(task, Task::Thumbnails(_))));
    let tasks = bench.act(DialogAction::Write);
    let Some(Task::Export(plan)) = tasks.into_iter().next() else { panic!() };
    let before = plan.upright.clone();
    bench.act(Edit::Diameter(7.0));
    bench.end_frame(false);
    assert_eq!(plan.upright.design.diameter_mm, before.design.diameter_mm);
    assert_eq!(bench.diameter(), 7.0);
    let stays = |task: &Task| matches!(task, Task::Window(WindowTask::StayOpen));
    assert!(has(&bench.act(FileAction::Close), stays));
    bench.act(DialogAction::Exported(ExportEvent::Written("a.png".into())));
    assert!(has(&bench.act(DialogAction::Stop), |task| matches!(task, Task::StopExport)));
    bench.act(DialogAction::Exported(ExportEvent::Ended(Err(Failure::Stopped))));
    let Some(Dialog::Export(export)) = bench.dialog() else { panic!("it closes by itself") };
    let run = export.run.as_ref().unwrap();
    assert!(run.standing().starts_with("Stopped at 0 %, 1 of") && !export.is_busy());
    assert!(bench.act(DialogAction::Stop).is_empty(), "there is nothing to stop any more");
    // Without the export, the editor asks about the work that closing would lose.
    bench.act(DialogAction::Leave);
    assert!(has(&bench.act(FileAction::Close), stays));
    assert!(matches!(bench.dialog(), Some(Dialog::Unsaved(Then::Close))));
    let tasks = bench.act(DialogAction::GiveUp);
    assert!(has(&tasks, |task| matches!(task, Task::Window(WindowTask::Close))));
    assert!(bench.act(FileAction::Close).is_empty(), "it may close");
}

#[test]
fn a_file_that_others_change_is_read_again_or_asked_about() {
    let folder = tempfile::tempdir().unwrap();
    let (mut bench, path) = Bench::with_file(folder.path());
    let change = |name: &str, bench: &mut Bench| {
        let mut design = bench.model.document.saved().clone();
        design.name = name.to_owned();
        std::fs::write(&path, cut_file::write(&design)).unwrap();
        bench.act(FileAction::OnDisk(path.clone(), Stamp::of(&path)))
    };
    let tasks = change("once", &mut bench);
    bench.read(tasks);
    assert_eq!(bench.model.document.work.design.name, "once");
    bench.act(Edit::Diameter(7.0));
    // While another dialog is open, the question waits.
    bench.act(Command::Keys);
    assert!(change("a second time", &mut bench).is_empty());
    assert!(matches!(bench.dialog(), Some(Dialog::Keys)));
    bench.act(DialogAction::Leave);
    assert!(matches!(bench.dialog(), Some(Dialog::ChangedOutside)));
    bench.act(DialogAction::Leave);
    bench.act(FileAction::OnDisk(path.clone(), Stamp::of(&path)));
    assert!(bench.dialog().is_none(), "the same change is asked about once");
    assert_eq!((bench.diameter(), bench.model.document.work.design.name.as_str()), (7.0, "once"));
    bench.act(FileAction::OnDisk(path.clone(), Stamp::default()));
    assert!(bench.model.document.is_lost() && bench.model.session.notes.troubles().len() == 1);
}

#[test]
fn what_the_program_saves_itself_is_no_change_by_others() {
    let folder = tempfile::tempdir().unwrap();
    let (mut bench, path) = Bench::with_file(folder.path());
    bench.act(Edit::Name("longer than before".to_owned()));
    let tasks = bench.act(Command::Save);
    let Some(Task::Save(request)) = tasks.into_iter().next() else { panic!() };
    let (document, saved) = (request.document, open::save(*request));
    // The change of the file is noticed before the answer comes.
    bench.act(FileAction::OnDisk(path.clone(), Stamp::of(&path)));
    let tasks = bench.act(FileAction::Saved(document, saved));
    assert!(tasks.iter().all(|task| !matches!(task, Task::Read(_))));
    assert!(bench.act(FileAction::OnDisk(path.clone(), Stamp::of(&path))).is_empty());
    assert!(bench.dialog().is_none() && bench.model.session.notes.troubles().is_empty());
}

#[test]
fn a_light_is_loaded_once_and_one_that_cannot_be_loaded_leaves_the_last() {
    let mut bench = Bench::new();
    let before = bench.model.session.light.at_hand.clone();
    let is_load = |task: &Task| matches!(task, Task::LoadLight(name) if name == "nowhere");
    assert!(has(&bench.change_look(|look| look.light = "nowhere".to_owned()), is_load));
    assert!(bench.end_frame(false).iter().all(|task| !is_load(task)), "it is being loaded");
    bench.act(Computed::Light("nowhere".to_owned(), Err(Failure::Input("a fault".to_owned()))));
    assert!(bench.model.session.light.loading.is_none());
    assert!(before == bench.model.session.light.at_hand);
    assert!(bench.model.session.notes.troubles()[0].text.starts_with("a fault; "));
    assert!(!has(&bench.end_frame(false), is_load), "it is not loaded again and again");
    // Exports name the light that is shown.
    assert_eq!(export_plan(&bench.model).light, USUAL_LIGHT);
    bench.change_look(|look| look.light = "dome".to_owned());
    bench.act(Computed::Light("dome".to_owned(), Ok(before)));
    assert_eq!(export_plan(&bench.model).light, "dome");
}

#[test]
fn a_coarse_light_is_shown_until_the_whole_one_comes_and_another_light_takes_its_place() {
    let mut bench = Bench::new();
    let lighting = || lighting::load("white").unwrap();
    let loads =
        |tasks: &[Task], light: &str| has(tasks, |t| matches!(t, Task::LoadLight(name) if name == light));
    assert!(loads(&bench.change_look(|look| look.light = "sunset".to_owned()), "sunset"));
    let coarse = ShotLight::coarse(lighting());
    bench.act(Computed::Light("sunset".to_owned(), Ok(coarse.clone())));
    let light = bench.model.session.light.clone();
    assert!(light.at_hand == coarse && light.name == "sunset");
    assert_eq!(light.loading.as_deref(), Some("sunset"), "the whole one is still to come");
    assert!(export_plan(&bench.model).shot.waits_for_light());
    assert!(!loads(&bench.end_frame(false), "sunset"), "it is being loaded");
    bench.act(Computed::Light("sunset".to_owned(), Ok(ShotLight::whole(lighting()))));
    let light = bench.model.session.light.clone();
    assert!(
        light.at_hand != coarse
            && light.loading.is_none()
            && !export_plan(&bench.model).shot.waits_for_light()
    );
    // The light before is wanted again while another is being loaded.
    bench.change_look(|look| look.light = "city".to_owned());
    bench.act(Computed::Light("city".to_owned(), Ok(coarse)));
    assert!(loads(&bench.change_look(|look| look.light = "sunset".to_owned()), "sunset"));
}

#[test]
fn a_picture_that_is_not_made_for_the_clipboard_is_reported() {
    let mut bench = Bench::new();
    assert!(bench.act(ViewAction::CopyAt(1, 512)).is_empty(), "nothing was ordered yet");
    let mut waves = Default::default();
    let mut orders =
        crate::model::ordering::Orders { model: &bench.model, waves: &mut waves, paper: Paper::default() };
    let shot = orders.shot(1, Which::Present, [64, 32]).unwrap();
    let order = Order { shots: vec![((1, Which::Present), shot)], ..Order::default() };
    bench.act(Computed::Order(Box::new(order)));
    let tasks = bench.act(ViewAction::CopyAt(1, 512));
    assert!(has(&tasks, |task| matches!(task, Task::MakeCopy(request) if request.side == 512)));
    bench.act(Computed::Copied(Err(Failure::Output("no memory".to_owned()))));
    assert_eq!(bench.model.session.notes.troubles()[0].text, "ASET could not be copied: no memory");
    assert!(bench.model.session.awaited.copying.is_none());
}

#[test]
fn an_answer_for_a_design_that_is_gone_is_not_saved_over_the_next() {
    let mut bench = Bench::new();
    let tasks = bench.act(Command::SaveAs);
    let Some(Task::ChooseFile(question)) = tasks.into_iter().next() else { panic!() };
    bench.act(FileAction::Ask(Then::Library("modern-ideal".to_owned())));
    let tasks = bench.act(FileAction::Chosen(question, Choice::File("late.toml".into())));
    assert!(tasks.is_empty() && bench.model.session.awaited.saving.is_none());
    assert!(bench.model.session.notes.troubles()[0].text.starts_with("The design was not saved"));
}

#[test]
fn a_mesh_is_asked_for_with_its_options_again_after_the_question() {
    let mut bench = Bench::new();
    let mesh =
        MeshOptions { form: brillianteer_files::mesh_options::MeshForm::Triangles, ..MeshOptions::default() };
    bench.act(Edit::Diameter(7.0));
    bench.act(FileAction::Ask(Then::Open("scan.stl".into(), mesh.clone())));
    let request = request(bench.act(DialogAction::GiveUp));
    assert_eq!((request.mesh, request.purpose), (mesh, OpeningPurpose::Anew));
}
