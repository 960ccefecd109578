//! Carries out the tasks of the editor: it reads and writes files, opens file dialogs, and opens folders and web pages.
//!
//! [`Outside`] carries out the [`Task`]s of a model in the background; their answers are [`Action`]s, or pictures for the
//! window.

pub mod autosave;
pub mod copying;
pub mod export;
pub mod export_scene;
pub mod files;
mod light;
mod look_ups;
pub mod lookup;
pub mod open;
pub mod runner;
mod search;

use crate::model::action::{Computed, DialogAction, FileAction, NoteAction};
use crate::model::choosing::{Choice, Question};
use crate::model::cut_search::{SearchEvent, SearchRequest};
use crate::model::export::ExportPlan;
use crate::model::exporting::ExportEvent;
use crate::model::fitting::LightRequest;
use crate::model::opening::FileRequest;
use crate::model::recovery::{RecoveredWork, UnsavedWork};
use crate::model::saving::{SaveRequest, Stamp};
use crate::model::task::CopyRequest;
use crate::model::{Action, Task};
use crate::pixels::Pixels;
use crate::shows::Shows;
use crate::studio::{ShotLight, Slot, TakenPicture, Wake};
use autosave::Autosave;
use brillianteer_base::Failure;
use brillianteer_paper::{goal_file, lighting};
use brillianteer_scene::{RingPlan, Specimen};
use brillianteer_search::Goal;
use files::Chooser;
use look_ups::LookUps;
use lookup::LookupRequest;
use runner::{JobHandle, TaskRunner, Turn};
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

/// The key of a task; the newest task with the same key wins.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
enum Key {
    Light,
    Read { is_beside: bool },
    Save,
    Choose,
    Safe,
    Last,
    Forget,
    Watch,
    Look,
    Open,
    Thumbnails,
    Export,
    Copy,
    Audit,
    Ring,
    StoneLight,
    Search,
    Goal,
    GoalSaved,
    LookUp(Slot),
}

/// An answer of a task.
pub enum TaskAnswer {
    /// An action on the model.
    Act(Box<Action>),
    /// A picture for the clipboard.
    Copied(Result<Pixels, Failure>),
    /// A small picture of what can be exported.
    Thumbnail(Shows, Pixels),
    /// A picture that was looked up, or an error that says why it could not be made.
    Looked(Slot, Arc<LookupRequest>, Result<TakenPicture, Failure>),
}

impl<A: Into<Action>> From<A> for TaskAnswer {
    fn from(action: A) -> Self {
        Self::Act(Box::new(action.into()))
    }
}

/// The text of an error that the program itself has made.
const FAULT: &str = "this is a fault in the program; please report it, with the design";

/// Returns the error of a task that panicked; `failed` names the work that was not done.
fn fault(failed: &str) -> Failure {
    Failure::Output(format!("{failed}; {FAULT}"))
}

/// A function that opens a folder by its path, or a page of the web by its address, without waiting for it.
pub type Opener = Arc<dyn Fn(&str) -> std::io::Result<()> + Send + Sync>;

/// Carries out tasks.
pub struct Outside {
    runner: TaskRunner<Key, TaskAnswer>,
    chooser: Chooser,
    opener: Opener,
    safe: Option<Arc<Mutex<Autosave>>>,
    look_ups: LookUps,
}

impl Outside {
    /// Makes the executor of tasks; `wake` is called whenever there is an answer.
    pub fn new(chooser: Chooser, opener: Opener, safe: Option<Autosave>, wake: Wake) -> Self {
        let safe = safe.map(|safe| Arc::new(Mutex::new(safe)));
        Self { runner: TaskRunner::new(wake), chooser, opener, safe, look_ups: LookUps::default() }
    }

    /// Returns the answers that have arrived since the last call.
    pub fn answers(&mut self) -> Vec<TaskAnswer> {
        self.runner.answers()
    }

    /// Begins to carry out a task. The caller carries out tracing and the window's tasks.
    pub fn start(&mut self, task: Task) {
        match task {
            Task::LoadLight(name) => self.load_light(name),
            Task::Read(request) => self.read(request),
            Task::Save(request) => self.save(*request),
            Task::ChooseFile(question) => self.choose_file(question),
            Task::Keep(unsaved) => self.keep(move |safe| safe.keep(&unsaved).err().map(|e| e.to_string())),
            Task::KeepLast(work) => self.keep_last(work),
            Task::EmptySafe => self.keep(|safe| {
                safe.empty();
                None
            }),
            Task::Forget(path) => self.forget(path),
            Task::Watch(file) => self.watch(file),
            Task::LookInto(files) => self.look_into(files),
            Task::OpenOutside(what) => self.open_outside(what),
            Task::Thumbnails(plan) => self.make_thumbnails(*plan),
            Task::StopThumbnails => self.runner.stop(Key::Thumbnails),
            Task::Export(plan) => self.export(*plan),
            Task::StopExport => self.runner.stop(Key::Export),
            Task::MakeCopy(request) => self.make_copy(request),
            Task::Audit(specimen) => self.audit(specimen),
            Task::MakeRing(document, plan) => self.make_ring(document, plan),
            Task::MeasureLight(request) => self.measure_light(*request),
            Task::StopLight => self.runner.stop(Key::StoneLight),
            Task::Search(request) => self.search(*request),
            Task::ReadGoal(path) => self.read_goal(path),
            Task::WriteGoal(path, goal) => self.write_goal(path, *goal),
            Task::StopSearch => self.runner.stop(Key::Search),
            Task::Trace(_) | Task::Window(_) => {}
        }
    }

    fn load_light(&mut self, name: String) {
        let why = fault(&format!("{name}: loading the light failed"));
        let failed = Computed::Light(name.clone(), Err(why));
        self.run(Key::Light, failed, move |job| {
            let at_hand =
                |coarse| job.send(Computed::Light(name.clone(), Ok(ShotLight::coarse(coarse))).into());
            let loaded = lighting::load_watched(&name, &|done| job.watch(done), at_hand);
            Computed::Light(name, loaded.map(ShotLight::whole))
        });
    }

    fn read(&mut self, request: FileRequest) {
        let why = fault(&format!("{}: reading the file failed", request.path.display()));
        let failed = FileAction::Opened(request.clone(), Err(why));
        self.run(Key::Read { is_beside: request.is_beside() }, failed, move |_| {
            let read = open::read(&request);
            FileAction::Opened(request, read)
        });
    }

    fn save(&mut self, request: SaveRequest) {
        let document = request.document;
        let why = fault(&format!("{}: saving the design failed", request.path.display()));
        let failed = FileAction::Saved(document, Err(why));
        self.write(Key::Save, failed, move || Some(FileAction::Saved(document, open::save(request))));
    }

    fn choose_file(&mut self, question: Question) {
        let chooser = Arc::clone(&self.chooser);
        self.run(Key::Choose, FileAction::Chosen(question.clone(), Choice::NoDialog), move |_| {
            let choice = chooser(&question);
            FileAction::Chosen(question, choice)
        });
    }

    fn keep(&mut self, job: impl FnOnce(&mut Autosave) -> Option<String> + Send + 'static) {
        let Some(safe) = self.safe.clone() else { return };
        self.write(Key::Safe, FileAction::NotKept(FAULT.to_owned()), move || {
            job(&mut safe.lock().unwrap_or_else(PoisonError::into_inner)).map(FileAction::NotKept)
        });
    }

    fn keep_last(&mut self, work: Box<UnsavedWork>) {
        let Some(safe) = self.safe.clone() else { return };
        self.write(Key::Last, FileAction::NotKept(FAULT.to_owned()), move || {
            let safe = safe.lock().unwrap_or_else(PoisonError::into_inner);
            safe.keep_last(&work).err().map(|error| FileAction::NotKept(error.to_string()))
        });
    }

    fn forget(&mut self, path: PathBuf) {
        self.write(Key::Forget, FileAction::NotKept(FAULT.to_owned()), move || {
            autosave::forget(&path);
            None
        });
    }

    fn watch(&mut self, file: Option<(PathBuf, Stamp)>) {
        self.runner.start(Key::Watch, Turn::AtOnce, None, move |job| {
            file.into_iter().for_each(|(path, stamp)| open::watch(&path, stamp, job));
        });
    }

    fn look_into(&mut self, files: Vec<PathBuf>) {
        let failed = FileAction::DroppedFor(vec![]);
        self.run(Key::Look, failed, move |_| FileAction::DroppedFor(open::look_into(files)));
    }

    fn open_outside(&mut self, what: String) {
        let opener = Arc::clone(&self.opener);
        self.runner.start(Key::Open, Turn::AtOnce, None, move |job| {
            if let Err(why) = opener(&what) {
                job.send(NoteAction::Trouble(format!("{what} could not be opened: {why}")).into());
            }
        });
    }

    fn make_thumbnails(&mut self, plan: ExportPlan) {
        self.runner.start(Key::Thumbnails, Turn::AtOnce, None, move |job| {
            let hang = |shows, image| job.send(TaskAnswer::Thumbnail(shows, image));
            export::thumbnails(&plan, &hang, &|| job.is_stopped());
        });
    }

    fn export(&mut self, plan: ExportPlan) {
        let answer = |event| DialogAction::Exported(event).into();
        let why = fault("the export failed");
        let failed = answer(ExportEvent::Ended(Err(why)));
        self.runner.start(Key::Export, Turn::AtOnce, Some(failed), move |job| {
            export::run(&plan, &|event| job.send(answer(event)), &|| job.is_stopped());
        });
    }

    fn make_copy(&mut self, request: CopyRequest) {
        let why = "making the picture failed; try another size";
        let failed = TaskAnswer::Copied(Err(Failure::Output(why.to_owned())));
        self.run(Key::Copy, failed, move |job| {
            TaskAnswer::Copied(copying::make(&request, &|| job.is_stopped()))
        });
    }

    fn audit(&mut self, specimen: Arc<Specimen>) {
        let failed = Computed::Audit(Arc::clone(&specimen), Err(fault("the audit failed")));
        self.run(Key::Audit, failed, move |_| {
            let found = specimen.audit().map_err(|why| Failure::Input(why.to_string()));
            Computed::Audit(specimen, found)
        });
    }

    fn make_ring(&mut self, document: u64, plan: Box<RingPlan>) {
        let why = fault("making the ring failed");
        let failed = Computed::RingMetal(document, plan.clone(), Err(why));
        self.run(Key::Ring, failed, move |_| {
            let made = plan.made().map_err(|error| Failure::Input(error.to_string()));
            Computed::RingMetal(document, plan, made)
        });
    }

    fn measure_light(&mut self, request: LightRequest) {
        let failed = Computed::StoneLight(request.number, Err(fault("measuring the light failed")));
        self.run(Key::StoneLight, failed, move |job| {
            Computed::StoneLight(request.number, light::measured(&request, &|| job.is_stopped()))
        });
    }

    fn search(&mut self, request: SearchRequest) {
        let failed = SearchEvent::Ended(Err(fault("the search failed")));
        self.run(Key::Search, Computed::Search(request.number, failed), move |job| {
            let say = |event| job.send(Computed::Search(request.number, event).into());
            let found = search::search(&request, &say, &|| job.is_stopped());
            Computed::Search(request.number, SearchEvent::Ended(found))
        });
    }

    fn read_goal(&mut self, path: PathBuf) {
        let why = fault(&format!("{}: reading the goal failed", path.display()));
        self.run(Key::Goal, Computed::Goal(path.clone(), Err(why)), move |_| {
            let goal = goal_file::read(&path).map(Box::new).map_err(Failure::from);
            Computed::Goal(path, goal)
        });
    }

    fn write_goal(&mut self, path: PathBuf, goal: Goal) {
        let why = fault(&format!("{}: writing the goal failed", path.display()));
        let failed = Computed::GoalSaved(path.clone(), Err(why)).into();
        let job = move |handle: &JobHandle<TaskAnswer>| {
            let written = goal_file::write(&goal, &path);
            handle.send(Computed::GoalSaved(path, written).into());
        };
        // Like all jobs that write, it waits for the one before it, and the program waits for it.
        self.runner.start(Key::GoalSaved, Turn::Write, Some(failed), job);
    }

    /// Runs a job with one answer; `failed` is its answer where it panics.
    fn run<A: Into<TaskAnswer>>(
        &mut self,
        key: Key,
        failed: A,
        job: impl FnOnce(&JobHandle<TaskAnswer>) -> A + Send + 'static,
    ) {
        let job = |handle: &JobHandle<_>| handle.send(job(handle).into());
        self.runner.start(key, Turn::AtOnce, Some(failed.into()), job);
    }

    /// Runs a job that writes, once the one before it has written; `failed` is its answer where it panics.
    fn write(
        &mut self,
        key: Key,
        failed: FileAction,
        job: impl FnOnce() -> Option<FileAction> + Send + 'static,
    ) {
        let job = |handle: &JobHandle<_>| job().into_iter().for_each(|answer| handle.send(answer.into()));
        self.runner.start(key, Turn::Write, Some(failed.into()), job);
    }

    /// Waits until all files that were to be written are written.
    pub fn finish(&mut self) {
        self.runner.finish();
    }

    /// Returns the work that was open when the program last ended, without going to the background.
    pub fn last(&self) -> Option<RecoveredWork> {
        self.safe.as_ref().and_then(|safe| safe.lock().unwrap_or_else(PoisonError::into_inner).last())
    }

    /// Finds the work that crashes left behind, without going to the background: it is offered in the first frame.
    pub fn found(&self) -> FileAction {
        let found =
            self.safe.as_ref().map(|safe| safe.lock().unwrap_or_else(PoisonError::into_inner).found());
        FileAction::Found(found.unwrap_or_default())
    }
}

impl Drop for Outside {
    fn drop(&mut self) {
        self.finish();
    }
}
