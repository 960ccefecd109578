//! Opens, saves and watches files.

use super::begin::{
    Begun, begin_again, begin_design, begin_library, begin_preset, begin_restored, begin_scene,
};
use super::{safe, searching};
use crate::model::Model;
use crate::model::action::FileAction;
use crate::model::choosing::{Choice, Purpose, Question};
use crate::model::compare::Compared;
use crate::model::dialog::{Dialog, PathForm, Then};
use crate::model::document::Document;
use crate::model::opening::{FileRequest, OpenedFile, Opening, OpeningPurpose};
use crate::model::recovery::RecoveredWork;
use crate::model::saving::SavedDesign;
use crate::model::session::Session;
use crate::model::task::{Task, WindowTask};
use crate::model::work::Work;
use brillianteer_base::Failure;
use brillianteer_files::design_file::DesignFormat;
use brillianteer_files::mesh_options::MeshOptions;
use brillianteer_scene::BackgroundRef;
use std::path::{Path, PathBuf};

/// The warning about a mesh whose table may face another way.
const DOUBTFUL: &str = "The shape of this mesh does not show clearly which way its table faces. If it faces the \
    wrong way, choose another direction at Table faces in the design panel.";

/// Carries out a file action.
pub fn change(model: &mut Model, tasks: &mut Vec<Task>, change: FileAction) {
    match change {
        FileAction::Ask(then) => ask_before(model, tasks, then),
        FileAction::Choose(purpose) => choose(model, tasks, purpose),
        FileAction::Chosen(question, choice) => answered(model, tasks, question, choice),
        FileAction::Begin(next) => carry_out(model, tasks, next, Begun::Anew),
        FileAction::Restore(found) => restore(model, tasks, *found),
        FileAction::Open(path, purpose) => open(model, tasks, path, purpose),
        FileAction::OpenWith(request) => open_with(model, tasks, request),
        FileAction::Opened(request, read) => is_read(model, &request, read),
        FileAction::ReadMesh(mesh) => {
            if let Some(path) = model.document.work.mesh.as_ref().map(|mesh| mesh.path.clone()) {
                open_with(model, tasks, FileRequest { purpose: OpeningPurpose::Otherwise, path, mesh });
            }
        }
        FileAction::Saved(document, saved) => is_saved(model, tasks, document, saved),
        FileAction::OnDisk(path, stamp) => {
            if model.document.path() == Some(&path) {
                model.session.on_disk = Some(stamp);
            }
        }
        FileAction::Dropped(files) => {
            model.session.awaited.dropped = true;
            tasks.push(Task::LookInto(files));
        }
        FileAction::DroppedFor(files) => dropped(model, tasks, files),
        FileAction::NotKept(why) => {
            model.session.notes.trouble(format!("the autosave of unsaved work failed: {why}"));
        }
        FileAction::Found(found) => {
            if let Some(first) = found.into_iter().next() {
                model.session.dialog = Some(Dialog::Recover(Box::new(first)));
            }
        }
        FileAction::Close => close(model, tasks),
        FileAction::Ended => {
            safe::keep_last(model, tasks, true);
            // Where the system closed the window without asking the user, the autosave stays for the next start.
            if model.session.may_close || !model.document.is_changed() {
                safe::empty(model, tasks);
            }
        }
        FileAction::OpenOutside(what) => tasks.push(Task::OpenOutside(what)),
    }
}

/// Opens a file that has been read, and adds the tasks that the present state needs: to load another light, to watch
/// another file, or to read the open file again because another program has changed it.
pub fn wanted(model: &mut Model, tasks: &mut Vec<Task>) {
    open_read(model, tasks);
    let light = &mut model.session.light;
    let name = &model.document.work.settings.look.light;
    // A light that is being loaded takes the place of the last one, even where that one is wanted again.
    if light.loading.as_ref().unwrap_or(&light.tried) != name {
        light.loading = Some(name.clone());
        tasks.push(Task::LoadLight(name.clone()));
    }
    if model.session.watched.as_deref() != model.document.path() {
        model.session.watched = model.document.path().map(Path::to_owned);
        tasks.push(Task::Watch(model.session.watched.clone().map(|path| (path, model.document.stamp()))));
    }
    let awaited = &model.session.awaited;
    // Reading the open file again would drop the other file that is being opened in its place.
    let is_replaced = awaited.opening.iter().any(|opening| opening.request.purpose == OpeningPurpose::Anew);
    if model.session.dialog.is_none() && awaited.saving.is_none() && !is_replaced {
        let stamp = model.session.on_disk.take().filter(|stamp| *stamp != model.document.stamp());
        if let Some(stamp) = stamp {
            model.document.accept_outside(stamp);
            changed_outside(model, tasks);
        }
    }
}

fn changed_outside(model: &mut Model, tasks: &mut Vec<Task>) {
    if model.document.is_lost() {
        model.session.notes.warn("The file no longer exists; save the design to keep it.".into());
    } else if model.document.is_changed() {
        model.session.dialog = Some(Dialog::ChangedOutside);
    } else if let Some(path) = model.document.path().map(Path::to_owned) {
        // The user has no unsaved changes, so the new file is read without a question.
        open(model, tasks, path, OpeningPurpose::Again);
    }
}

/// Carries out an action that would lose unsaved work; asks first where there is any.
fn ask_before(model: &mut Model, tasks: &mut Vec<Task>, next: Then) {
    if model.session.dialog.as_ref().is_some_and(Dialog::insists) {
        model.session.notes.say("Answer the open dialog first.");
    } else if loses_design(model, &next) {
        model.session.dialog = Some(Dialog::Unsaved(next));
    } else if loses_copies(model, &next) {
        model.session.dialog = Some(Dialog::Moved(next));
    } else {
        then(model, tasks, next);
    }
}

/// Returns whether an action loses unsaved changes of the design.
///
/// What comes with the program takes the place of a design as a step of undo. So only a design with a file, which is left
/// unsaved, is asked about.
fn loses_design(model: &Model, next: &Then) -> bool {
    let is_step = matches!(next, Then::Library(_) | Then::Preset(_));
    model.document.is_changed() && (!is_step || model.document.path().is_some())
}

/// Returns whether an action loses the places of copies: those of the last work are there again at the next start.
fn loses_copies(model: &Model, next: &Then) -> bool {
    let is_kept = match next {
        Then::Library(_) | Then::Preset(_) => true,
        Then::Close => model.session.safe.is_on,
        Then::Open(..) => false,
    };
    model.document.has_moved_copies() && !is_kept
}

/// Carries out the action that waited for the answer to a question.
pub fn then(model: &mut Model, tasks: &mut Vec<Task>, then: Then) {
    carry_out(model, tasks, then, Begun::AsStep);
}

/// Carries out an action; `begun` says whether what comes with the program is a step of undo.
fn carry_out(model: &mut Model, tasks: &mut Vec<Task>, then: Then, begun: Begun) {
    match then {
        Then::Open(path, mesh) => {
            open_with(model, tasks, FileRequest { purpose: OpeningPurpose::Anew, path, mesh })
        }
        Then::Library(name) => begin_library(model, tasks, &name, begun),
        Then::Preset(name) => begin_preset(model, tasks, &name, begun),
        Then::Close => {
            model.session.may_close = true;
            tasks.push(Task::Window(WindowTask::Close));
        }
    }
}

fn close(model: &mut Model, tasks: &mut Vec<Task>) {
    let session = &mut model.session;
    if session.dialog.as_ref().is_some_and(Dialog::insists) {
        session.notes.say("Answer the open dialog first, or stop the export.");
    } else if session.may_close {
        return;
    } else if session.awaited.saving.is_some() {
        session.after_save = Some(Then::Close);
    } else if loses_design(model, &Then::Close) {
        model.session.dialog = Some(Dialog::Unsaved(Then::Close));
    } else if loses_copies(model, &Then::Close) {
        model.session.dialog = Some(Dialog::Moved(Then::Close));
    } else {
        return;
    }
    tasks.push(Task::Window(WindowTask::StayOpen));
}

/// Returns whether the format of a file name can hold designs.
fn holds_designs(path: &Path) -> bool {
    DesignFormat::of_name(path).is_some_and(DesignFormat::holds_designs)
}

/// Asks the user for a file.
pub fn choose(model: &mut Model, tasks: &mut Vec<Task>, purpose: Purpose) {
    if model.session.awaited.choosing.is_some() {
        model.session.notes.say("Answer the open file dialog first.");
        return;
    }
    model.session.after_save = None;
    model.session.awaited.choosing = Some(purpose);
    let name = if purpose == Purpose::SaveGoal { "goal.toml".to_owned() } else { suggested(model) };
    let question = Question { purpose, name, document: model.session.begun };
    tasks.push(Task::ChooseFile(question));
}

/// Returns the name that is proposed for a new file.
fn suggested(model: &Model) -> String {
    let document = &model.document;
    let is_design = document.path().is_some_and(holds_designs);
    if is_design { document.title() } else { format!("{}.toml", document.design_stem()) }
}

fn answered(model: &mut Model, tasks: &mut Vec<Task>, question: Question, choice: Choice) {
    model.session.awaited.choosing = None;
    match choice {
        Choice::File(path) => chosen(model, tasks, question.purpose, question.document, path),
        // The export dialog has its own field for the folder.
        Choice::NoDialog if model.session.dialog.is_none() => {
            let folder = model.document.folder();
            let begin = if question.purpose.is_new() { folder.join(&question.name) } else { folder };
            model.session.dialog =
                Some(Dialog::Path(PathForm::new(question.purpose, model.session.begun, &begin)));
        }
        Choice::NoDialog | Choice::GivenUp => {
            model.session.after_save = None;
        }
    }
}

/// Takes the file that was chosen for the document of this number.
pub fn chosen(model: &mut Model, tasks: &mut Vec<Task>, purpose: Purpose, document: u64, path: PathBuf) {
    match purpose {
        Purpose::SaveAs if document != model.session.begun => {
            model.session.after_save = None;
            model
                .session
                .notes
                .trouble("The design was not saved, because another design was opened meanwhile.");
        }
        Purpose::Open => ask_before(model, tasks, Then::open(path)),
        Purpose::SaveAs => save_as(model, tasks, path),
        Purpose::Compare => open(model, tasks, path, OpeningPurpose::Beside),
        Purpose::Light => {
            let edit = model.look_with(|look| look.light = path.display().to_string());
            super::edits::edit(model, edit);
        }
        Purpose::Behind => {
            let edit = model.look_with(|look| look.background = Some(BackgroundRef::Photo(path)));
            super::edits::edit(model, edit);
        }
        Purpose::Goal => tasks.push(Task::ReadGoal(path)),
        Purpose::SaveGoal => searching::save_goal(model, tasks, path),
        Purpose::Folder => {
            if let Some(Dialog::Export(export)) = &mut model.session.dialog {
                export.plan.folder = path;
                export.plan.list_sheet();
            }
        }
    }
}

impl Model {
    /// Returns the options by which the open mesh was read or is being read anew; `None` where the stone was read
    /// from no mesh.
    pub fn mesh_options(&self) -> Option<MeshOptions> {
        let mesh = self.document.work.mesh.as_ref()?;
        let pending = self.session.awaited.opening.iter().map(|opening| &opening.request);
        let mut anew = pending.filter(|r| r.purpose == OpeningPurpose::Otherwise && r.path == mesh.path);
        Some(anew.next().map_or(&mesh.options, |request| &request.mesh).clone())
    }
}

fn open(model: &mut Model, tasks: &mut Vec<Task>, path: PathBuf, purpose: OpeningPurpose) {
    // A changed mesh is read with its former options; a design that was made from a mesh and saved to another file is
    // no mesh.
    let is_mesh = model.document.work.mesh.as_ref().is_some_and(|mesh| mesh.path == path);
    let again = model.mesh_options().filter(|_| purpose == OpeningPurpose::Again && is_mesh);
    open_with(model, tasks, FileRequest { purpose, path, mesh: again.unwrap_or_default() })
}

/// Opens a file; an older request for the same purpose that is still being read is dropped.
fn open_with(model: &mut Model, tasks: &mut Vec<Task>, request: FileRequest) {
    let opening = &mut model.session.awaited.opening;
    opening.retain(|other| other.request.is_beside() != request.is_beside());
    opening.push(Opening { request: request.clone(), work: model.document.work.clone(), read: None });
    tasks.push(Task::Read(request));
}

/// Takes the content of a requested file, or reports why it could not be read.
fn is_read(model: &mut Model, request: &FileRequest, read: Result<OpenedFile, Failure>) {
    let Session { awaited, notes, .. } = &mut model.session;
    let Some(place) = awaited.opening.iter().position(|opening| opening.request == *request) else { return };
    match notes.ok_or_report(read) {
        Some(file) => awaited.opening[place].read = Some(file),
        None => {
            awaited.opening.remove(place);
            model.session.safe.restoring = None;
        }
    }
}

/// Opens a file that has been read. It waits where it would replace a document that a dialog is about, or that is
/// being saved before another action.
fn open_read(model: &mut Model, tasks: &mut Vec<Task>) {
    let session = &mut model.session;
    let must_stay =
        session.after_save.is_some() || session.dialog.as_ref().is_some_and(Dialog::is_about_document);
    let all = &mut session.awaited.opening;
    let may_open = |opening: &Opening| opening.read.is_some() && (opening.request.is_beside() || !must_stay);
    let Some(place) = all.iter().position(may_open) else { return };
    let Opening { request, work, read: Some(file) } = all.remove(place) else { return };
    // The user has edited the document since the file was requested, and has not agreed to lose that.
    let is_later = model.document.work != work;
    match (request.purpose, file) {
        (OpeningPurpose::Anew, _) if is_later => {
            ask_before(model, tasks, Then::Open(request.path, request.mesh));
        }
        (OpeningPurpose::Again, _) if is_later => model.session.dialog = Some(Dialog::ChangedOutside),
        (OpeningPurpose::Beside, OpenedFile::Design(document)) => {
            model.session.compared = Some(Compared::of(&document));
        }
        (OpeningPurpose::Otherwise, OpenedFile::Design(document)) => {
            // The user may have opened another design meanwhile.
            let path = |work: &Work| work.mesh.as_ref().map(|mesh| mesh.path.clone());
            if path(&model.document.work) == path(&document.work) {
                model.document.take_shape(*document);
                model.document.update();
            }
        }
        (OpeningPurpose::Again, OpenedFile::Design(document)) => begin_again(model, tasks, *document),
        (OpeningPurpose::Anew, OpenedFile::Design(document)) => {
            model.workspace.remember(&request.path);
            let is_doubtful = document.work.mesh.as_ref().is_some_and(|mesh| mesh.is_doubtful);
            match model.session.safe.restoring.take_if(|found| found.path.as_ref() == Some(&request.path)) {
                Some(found) => begin_restored(model, tasks, *document, *found),
                None => begin_design(model, tasks, *document),
            }
            if is_doubtful {
                model.session.notes.say(DOUBTFUL);
            }
        }
        (_, OpenedFile::Scene(preset)) => {
            begin_scene(model, tasks, *preset, Begun::Anew);
            model.workspace.remember(&request.path);
        }
    }
}

/// Opens the work that was open when the program last ended: from its file, if it has one.
fn restore(model: &mut Model, tasks: &mut Vec<Task>, found: RecoveredWork) {
    match &found.path {
        Some(path) => {
            let (path, mesh) =
                (path.clone(), found.mesh.as_ref().map(|mesh| mesh.options.clone()).unwrap_or_default());
            model.session.safe.restoring = Some(Box::new(found));
            open_with(model, tasks, FileRequest { purpose: OpeningPurpose::Anew, path, mesh });
        }
        None => {
            let document = Document::new(found.design.clone(), None);
            if let Some(document) = model.session.notes.ok_or_report(document) {
                begin_restored(model, tasks, document, found);
            }
        }
    }
}

/// Saves the document; asks for a file where the document has none in a format that holds designs.
pub fn save(model: &mut Model, tasks: &mut Vec<Task>) {
    match model.document.path().map(Path::to_owned) {
        Some(path) if holds_designs(&path) => save_as(model, tasks, path),
        // A mesh stays as it is: the design that was made from it is saved to another file.
        _ => choose(model, tasks, Purpose::SaveAs),
    }
}

/// Saves the document, and then carries out the action that waited for that.
pub fn save_then(model: &mut Model, tasks: &mut Vec<Task>, then: Then) {
    save(model, tasks);
    if model.session.awaited.saving.is_some() || model.session.awaited.choosing == Some(Purpose::SaveAs) {
        model.session.after_save = Some(then);
    }
}

fn save_as(model: &mut Model, tasks: &mut Vec<Task>, path: PathBuf) {
    if path.extension().is_some() && !holds_designs(&path) {
        let name = path.display();
        model.session.notes.trouble(format!(
            "{name}: designs are saved as .toml, .asc, .gem or .gcs; `brillianteer convert` writes meshes"
        ));
        model.session.after_save = None;
        return;
    }
    model.document.update();
    let document = model.session.begun;
    let request = model.document.to_save(document, path);
    let Some(request) = model.session.notes.ok_or_report(request) else {
        model.session.after_save = None;
        return;
    };
    model.session.awaited.saving = Some(document);
    tasks.push(Task::Save(Box::new(request)));
}

/// Reports that a document was saved; where it is still open, records its file.
fn is_saved(model: &mut Model, tasks: &mut Vec<Task>, document: u64, saved: Result<SavedDesign, Failure>) {
    let session = &mut model.session;
    let is_awaited = session.awaited.saving.take_if(|awaited| *awaited == document).is_some();
    let waiting = if is_awaited { session.after_save.take() } else { None };
    let Some(saved) = session.notes.ok_or_report(saved) else { return };
    let is_open = document == session.begun;
    if is_open {
        session.notes.clear();
    }
    session.notes.say(&format!("Saved {}", saved.path.display()));
    if !saved.lost.is_empty() {
        let (name, lost) = (saved.path.display(), saved.lost.join("; "));
        session.notes.warn(format!("{name}: {lost}. Save it as .toml to keep everything."));
    }
    if is_open {
        take_saved(model, tasks, saved);
    }
    if let Some(next) = waiting {
        ask_before(model, tasks, next);
    }
}

/// Records the file in which the present document has been saved.
fn take_saved(model: &mut Model, tasks: &mut Vec<Task>, saved: SavedDesign) {
    let Model { document, workspace, session } = model;
    workspace.remember(&saved.path);
    document.take_saved(saved);
    session.on_disk = None;
    if let Some(Compared { is_saved: true, .. }) = session.compared {
        session.compared = Compared::of_saved(document).ok();
    }
    if !document.is_changed() {
        safe::empty(model, tasks);
    }
    safe::keep_last(model, tasks, false);
}

fn dropped(model: &mut Model, tasks: &mut Vec<Task>, files: Vec<(PathBuf, Purpose)>) {
    let name = |path: &Path| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    model.session.awaited.dropped = false;
    let mut to_open = files.iter().filter(|(_, purpose)| *purpose == Purpose::Open);
    if let Some((path, _)) = to_open.next() {
        ask_before(model, tasks, Then::open(path.clone()));
        let more = to_open.count();
        if more > 0 {
            let files = if more == 1 { "file was" } else { "files were" };
            model.session.notes.say(&format!(
                "{} is opened. Only one design can be open at a time, so {more} more {files} left out.",
                name(path)
            ));
        }
    }
    for (path, purpose) in files.into_iter().filter(|(_, purpose)| *purpose != Purpose::Open) {
        let text = match purpose {
            Purpose::Light => format!("{} lights the stone.", name(&path)),
            _ => format!(
                "{} is now the background. To use it as a light, choose it at Light in the design panel.",
                name(&path)
            ),
        };
        chosen(model, tasks, purpose, model.session.begun, path);
        model.session.notes.say(&text);
    }
}
