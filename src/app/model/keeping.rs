//! Opens and saves designs, and keeps unsaved work safe.

use crate::app::dialogs::asked_path::AskedPath;
use crate::app::dialogs::{Dialog, Then};
use crate::app::editor::{Editor, Shown};
use crate::app::model::compare::Compared;
use crate::app::model::document::{Document, Work};
use crate::app::model::opening::OpeningPurpose;
use crate::app::model::workspace::Workspace;
use crate::app::studio::Which;
use crate::app::tasks::autosave::KeptScene;
use crate::app::tasks::files::{Choosing, Purpose, Question};
use crate::io::design_file::DesignFormat;
use std::path::{Path, PathBuf};

/// Whether a design can be saved under this name.
fn holds_designs(path: &Path) -> bool {
    DesignFormat::of_name(path).is_some_and(DesignFormat::holds_designs)
}

impl Editor {
    pub(crate) fn changed_outside(&mut self) {
        self.document.accept_outside();
        if self.document.is_lost() {
            self.notes.warn("The file is no longer there; save the design to keep it.".into());
        } else if self.document.is_changed() {
            self.dialog = Some(Dialog::ChangedOutside);
        } else if let Some(path) = self.document.path().map(Path::to_owned) {
            // No change of the user's is lost, so the new file is read without a question.
            self.open(&path, OpeningPurpose::Again);
        }
    }

    /// Ends the comparison: forgets the design compared with, and its pictures and figures.
    pub(crate) fn compare_no_more(&mut self) {
        self.compared = None;
        self.pictures.retain(|(_, which), _| *which == Which::Present);
        self.looked.retain(|(_, which), _| *which == Which::Present);
        self.figures.retain(|which, _| *which == Which::Present);
    }

    /// Begins to work on another document, under the present light.
    pub(crate) fn begin(&mut self, mut document: Document) {
        let work = &self.document.work;
        document.begin(&work.light, work.exposure, work.head);
        self.document = document;
        self.framing.renew(self.document.specimen());
        self.moving.rest();
        self.desk.rest();
        self.held = None;
        // Pictures and figures of the stone before do not belong to this one.
        let stays = |which: Which, shown: &Shown| which != Which::Present || shown.shot.shows.is_pane();
        self.pictures.retain(|(_, which), shown| stays(*which, shown));
        self.looked.retain(|(_, which), shown| stays(*which, shown));
        self.figures.retain(|which, _| *which != Which::Present);
        self.tilts = None;
        self.begun += 1;
        self.opening.retain(|o| o.is_beside());
        // Another stone is first seen face up.
        self.desk.face_up();
        self.notes.clear();
        if self.compared.as_ref().is_some_and(|c| c.is_saved) {
            self.compare_no_more();
        }
        self.take_note();
    }

    /// Does something that would lose unsaved work, after a question where there is such work.
    pub(crate) fn ask_before(&mut self, then: Then) {
        if self.dialog.as_ref().is_some_and(Dialog::insists) {
            self.notes.say("Answer what is asked first.");
        } else if self.document.is_changed() {
            self.dialog = Some(Dialog::Unsaved(then));
        } else if self.document.has_moved_copies() {
            self.dialog = Some(Dialog::Moved(then));
        } else {
            self.then(then);
        }
    }

    /// Carries out the action that waited for the answer to a question.
    pub(crate) fn then(&mut self, then: Then) {
        match then {
            Then::Open(path, mesh) => self.open_with(&path, OpeningPurpose::Anew, mesh),
            Then::Library(name) => self.begin_from_library(&name),
            Then::Preset(name) => self.begin_preset(&name),
            Then::Close => self.may_close = true,
        }
    }

    /// Begins a design from a cut that comes with the program.
    pub(crate) fn begin_from_library(&mut self, name: &str) {
        match Document::of_library(name) {
            Ok(document) => {
                self.desk.last = None;
                self.begin(document);
            }
            Err(why) => self.notes.trouble(why),
        }
    }

    /// Saves the design, and carries out the waiting action once that is done.
    pub(crate) fn save_then(&mut self, then: Then) {
        if self.save() {
            self.ask_before(then);
        } else if self.choosing.is_some() {
            self.after_save = Some(then);
        }
    }

    /// Asks the user for a file.
    pub(crate) fn choose(&mut self, purpose: Purpose) {
        if self.choosing.is_some() {
            return self.notes.say("Answer the file dialog that is open first.");
        }
        self.after_save = None;
        let wake = self.studio.wake();
        let question = Question { purpose, name: self.suggested() };
        self.choosing = Some(Choosing::ask(question, self.begun, &self.chooser, move || wake()));
    }

    /// Returns the name that is proposed for a new file.
    fn suggested(&self) -> String {
        let own = self
            .document
            .path()
            .map(|path| if holds_designs(path) { path.to_owned() } else { path.with_extension("toml") });
        own.as_deref().and_then(Path::file_name).map_or_else(
            || format!("{}.toml", self.document.work.design.name.to_lowercase().replace([' ', '/'], "-")),
            |n| n.to_string_lossy().into_owned(),
        )
    }

    /// Asks for a path in a dialog of the window's own.
    pub(crate) fn ask_path(&mut self, purpose: Purpose) {
        let here = || std::env::current_dir().unwrap_or_default();
        let folder = self.document.path().and_then(Path::parent).map_or_else(here, Path::to_owned);
        let begin = if purpose == Purpose::SaveAs { folder.join(self.suggested()) } else { folder };
        self.dialog = Some(Dialog::Path(AskedPath::new(purpose, self.begun, &begin)));
    }

    pub(crate) fn chosen(&mut self, purpose: Purpose, document: u64, path: PathBuf) {
        match purpose {
            Purpose::SaveAs if document != self.begun => {
                self.notes.trouble("Not saved: another design was opened meanwhile.".into());
            }
            Purpose::Open => self.ask_before(Then::open(path)),
            Purpose::SaveAs => {
                let then = self.after_save.take();
                if self.save_as(path)
                    && let Some(then) = then
                {
                    self.ask_before(then);
                }
            }
            Purpose::Compare => self.open(&path, OpeningPurpose::Beside),
            Purpose::Light => self.document.work.light = path.display().to_string(),
            Purpose::Behind => self.desk.behind = Some(path.display().to_string()),
            Purpose::Folder => {
                if let Some(Dialog::Export(export)) = &mut self.dialog {
                    export.folder = path;
                }
            }
        }
    }

    /// Saves the document; asks for a file where it has none that holds designs. Returns whether it is saved.
    pub(crate) fn save(&mut self) -> bool {
        match self.document.path().map(Path::to_owned) {
            Some(path) if holds_designs(&path) => self.save_as(path),
            // A scan stays as it was: the design that was made of it is saved as another file.
            _ => {
                self.choose(Purpose::SaveAs);
                false
            }
        }
    }

    pub(crate) fn save_as(&mut self, path: PathBuf) -> bool {
        let completed = path.with_extension("toml");
        if path.extension().is_none() && completed.exists() {
            self.notes.trouble(format!(
                "{} exists; choose it by its whole name to replace it",
                completed.display()
            ));
            return false;
        }
        let path = if path.extension().is_some() { path } else { completed };
        if !holds_designs(&path) {
            let name = path.display();
            self.notes.trouble(format!(
                "{name}: designs are saved as .toml, .asc, .gem or .gcs; `brillianteer convert` writes meshes"
            ));
            return false;
        }
        match self.document.save(path.clone()) {
            Ok(lost) => {
                self.desk.remember(&path);
                self.notes.clear();
                self.notes.say(&format!("Saved {}", path.display()));
                if !lost.is_empty() {
                    let (name, lost) = (path.display(), lost.join("; "));
                    self.notes.warn(format!("{name}: {lost}. As .toml, all is kept."));
                }
                self.forget_unsaved();
                if let Some(Compared { is_saved: true, .. }) = self.compared {
                    self.compared = Compared::of_saved(&self.document).ok();
                }
                true
            }
            Err(why) => {
                self.notes.trouble(why);
                false
            }
        }
    }

    pub(crate) fn forget_unsaved(&mut self) {
        if let Some(safe) = &mut self.safe {
            safe.empty();
        }
    }

    /// Ends a gesture at the time `now`, seconds: what it changed becomes one step of undo.
    pub(crate) fn settle(&mut self, now: f64) {
        self.desk.eye.settle();
        self.desk
            .panes
            .iter_mut()
            .filter_map(|p| p.own.as_mut())
            .for_each(crate::app::model::eye::Eye::settle);
        self.looks.note(&self.desk, now);
        self.document.settle();
        if self.kept != self.document.work {
            self.take_note();
        }
    }

    /// Autosaves the work as it is now, and stores its light, exposure and head in the workspace.
    ///
    /// A design that makes no stone does not replace the last one that does.
    pub(crate) fn take_note(&mut self) {
        self.kept = self.document.work.clone();
        let Work { light, exposure, head, .. } = &self.kept;
        (self.desk.light, self.desk.exposure, self.desk.head) = (light.clone(), *exposure, *head);
        let Workspace { behind, behind_mm, strength, .. } = &self.desk;
        let (company, behind) = (self.kept.company.clone(), behind.clone());
        let around = KeptScene { company, behind, behind_mm: *behind_mm, strength: Some(*strength) };
        let Some(safe) = &mut self.safe else { return };
        if !self.document.is_changed() && !self.document.has_moved_copies() {
            safe.empty();
        } else if self.document.fault().is_none()
            && let Err(why) = safe.keep(&self.kept, &around, self.document.path())
        {
            self.notes.trouble(format!("unsaved work is not kept safe: {why}"));
        }
    }
}
