//! Files that are being opened: each is read and built on a thread of its own, so that the window stays quick whatever
//! their size.

use crate::app::dialogs::{Dialog, Then};
use crate::app::editor::Editor;
use crate::app::model::compare::Compared;
use crate::app::model::document::{Document, Work};
use crate::app::model::preset::Preset;
use crate::io::mesh_options::MeshOptions;
use crate::io::scene_file;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, channel};

/// What a file is opened for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OpeningPurpose {
    /// To work on the file.
    Anew,
    /// To read the open file again, without moving any view.
    Again,
    /// To compare with the file.
    Beside,
    /// To read the open mesh in another way.
    Otherwise,
}

/// The note about a mesh whose table may face another way.
const DOUBTFUL: &str = "The shape of this mesh leaves a doubt which way its table faces: choose it in the panel Design, by \
    Table faces.";

/// A file that is being opened.
pub struct Opening {
    wanted: OpeningPurpose,
    path: PathBuf,
    /// How the file is read where it is a mesh.
    mesh: MeshOptions,
    /// The work as it was when the file was requested.
    work: Work,
    answer: Receiver<Result<Came, String>>,
}

/// The content of a file.
enum Came {
    Design(Box<Document>),
    Scene(Box<Preset>),
}

impl Came {
    /// Reads a file; a scene is only read as one to be worked on.
    fn of(path: &Path, wanted: OpeningPurpose, mesh: MeshOptions) -> Result<Self, String> {
        match wanted == OpeningPurpose::Anew && is_scene(path) {
            true => Preset::read(path).map(Box::new).map(Self::Scene),
            false => Document::open(path, mesh).map(Box::new).map(Self::Design),
        }
    }
}

impl Opening {
    /// Whether the file is opened beside the present document, which stays.
    pub fn is_beside(&self) -> bool {
        self.wanted == OpeningPurpose::Beside
    }

    /// Says which file is being opened.
    pub fn message(&self) -> String {
        format!("opening {}…", self.path.file_name().unwrap_or_default().to_string_lossy())
    }
}

/// Whether a file is a scene; only a file that ends in .toml is looked into.
fn is_scene(path: &Path) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case("toml")) && scene_file::is_scene(path)
}

impl Editor {
    /// Opens a file; another that is still being read for the same purpose is dropped.
    pub(crate) fn open(&mut self, path: &Path, wanted: OpeningPurpose) {
        // A mesh that has changed is read as before; a design that was made of it and saved elsewhere is not a mesh.
        let is_mesh = self.document.work.mesh.as_ref().is_some_and(|mesh| mesh.path == path);
        let again = self.mesh_options().filter(|_| wanted == OpeningPurpose::Again && is_mesh);
        self.open_with(path, wanted, again.unwrap_or_default());
    }

    /// Returns how the open mesh was read, or how it is being read anew; `None` where the stone was read from no mesh.
    pub(crate) fn mesh_options(&self) -> Option<MeshOptions> {
        let mesh = self.document.work.mesh.as_ref()?;
        let is_pending = |o: &&Opening| o.wanted == OpeningPurpose::Otherwise && o.path == mesh.path;
        Some(self.opening.iter().find(is_pending).map_or(mesh.options, |opening| opening.mesh))
    }

    /// Opens a file as [`open`](Self::open) does; the options count where it is a mesh.
    pub(crate) fn open_with(&mut self, path: &Path, wanted: OpeningPurpose, mesh: MeshOptions) {
        let (sender, answer) = channel();
        let (name, wake) = (path.to_owned(), self.studio.wake());
        std::thread::spawn(move || {
            // Nobody waits for the answer any more where another file was chosen.
            let _ = sender.send(Came::of(&name, wanted, mesh));
            wake();
        });
        let work = self.document.work.clone();
        let opening = Opening { wanted, path: path.to_owned(), mesh, work, answer };
        self.opening.retain(|other| other.is_beside() != (wanted == OpeningPurpose::Beside));
        self.opening.push(opening);
    }

    /// Takes in the files that have been read.
    pub(crate) fn take_in_files(&mut self) {
        for opening in std::mem::take(&mut self.opening) {
            match opening.answer.try_recv() {
                Ok(Ok(came)) => self.opened(&opening, came),
                Ok(Err(why)) => self.notes.trouble(why),
                Err(std::sync::mpsc::TryRecvError::Empty) => self.opening.push(opening),
                Err(std::sync::mpsc::TryRecvError::Disconnected) => {
                    self.notes.trouble(format!("{}: reading it failed", opening.path.display()));
                }
            }
        }
    }

    fn opened(&mut self, opening: &Opening, came: Came) {
        // The user has not given up what was changed while the file was being read.
        let is_later = self.document.work != opening.work;
        match (opening.wanted, came) {
            (OpeningPurpose::Anew, _) if is_later => {
                self.ask_before(Then::Open(opening.path.clone(), opening.mesh));
            }
            (OpeningPurpose::Again, _) if is_later => self.dialog = Some(Dialog::ChangedOutside),
            (_, Came::Scene(preset)) => {
                self.begin_scene(*preset);
                self.desk.remember(&opening.path);
            }
            (OpeningPurpose::Beside, Came::Design(document)) => self.compared = Some(Compared::of(&document)),
            (OpeningPurpose::Anew, Came::Design(document)) => {
                self.desk.remember(&opening.path);
                let is_doubtful = document.work.mesh.as_ref().is_some_and(|mesh| mesh.is_doubtful);
                self.begin(*document);
                if is_doubtful {
                    self.notes.say(DOUBTFUL);
                }
            }
            (OpeningPurpose::Otherwise, Came::Design(document)) => {
                // Another design may have been opened meanwhile.
                let path = |work: &Work| work.mesh.as_ref().map(|mesh| mesh.path.clone());
                if path(&self.document.work) == path(&document.work) {
                    self.document.take_shape(*document);
                }
            }
            (OpeningPurpose::Again, Came::Design(mut document)) => {
                let (desk, framing) = (self.desk.clone(), self.framing.clone());
                document.take_copies(&self.document);
                self.begin(*document);
                (self.desk, self.framing) = (desk, framing);
                self.notes.say("The file was changed by another program and has been read again.");
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::editor::Setup;
    use crate::app::tests::Bench;
    use crate::cut::from_mesh::Up;
    use crate::io::design_file::{self, DesignFormat};
    use crate::io::mesh_options::MeshForm;
    use crate::scene::Specimen;
    use egui_kittest::kittest::Queryable;
    use glam::DVec3;

    /// Writes the first cut as a mesh.
    fn scan(folder: &Path) -> PathBuf {
        let path = folder.join("scan.stl");
        let specimen = Specimen::new(Document::first().unwrap().work.design).unwrap();
        design_file::write(&specimen, DesignFormat::Stl, &path).unwrap();
        path
    }

    const UP: MeshOptions = MeshOptions { up: Up::Given(DVec3::NEG_Y), form: MeshForm::Found };

    #[test]
    fn a_mesh_that_is_opened_after_a_question_is_read_as_it_was_asked_for() {
        let folder = tempfile::tempdir().unwrap();
        let path = scan(folder.path());
        let mut bench = Bench::new();
        let editor = bench.harness.state_mut();
        editor.open_with(&path, OpeningPurpose::Anew, UP);
        // No frame has come in between, so that the design is changed before the file is taken in.
        editor.document.work.design.name = "mine".to_owned();
        bench.wait(|editor| editor.dialog.is_some());
        assert!(matches!(&bench.editor().dialog, Some(Dialog::Unsaved(Then::Open(_, mesh))) if *mesh == UP));
        bench.click("Don't save");
        bench.wait(|editor| editor.document.work.mesh.is_some());
        assert_eq!(bench.editor().mesh_options(), Some(UP));
    }

    #[test]
    fn a_second_choice_keeps_the_first_that_has_not_come_yet() {
        let folder = tempfile::tempdir().unwrap();
        let path = scan(folder.path());
        let mut bench = Bench::with(Setup { file: Some(path.clone()), ..Setup::default() });
        bench.wait(|editor| editor.document.work.mesh.is_some());
        bench.harness.run_steps(3);
        let (sender, answer) = channel();
        let editor = bench.harness.state_mut();
        let (work, mesh) = (editor.document.work.clone(), UP);
        editor.opening.push(Opening { wanted: OpeningPurpose::Otherwise, path, mesh, work, answer });
        bench.harness.run_steps(2);
        bench.harness.get_by_label("Triangles").click();
        bench.harness.run_steps(2);
        let both = MeshOptions { form: MeshForm::Triangles, ..UP };
        bench.wait(|editor| {
            editor.document.work.mesh.as_ref().is_some_and(|mesh| mesh.options != MeshOptions::default())
        });
        assert_eq!(bench.editor().document.work.mesh.as_ref().map(|mesh| mesh.options), Some(both));
        drop(sender);
    }

    #[test]
    fn a_design_that_was_made_of_a_mesh_and_saved_is_read_again_without_the_meshs_options() {
        let folder = tempfile::tempdir().unwrap();
        let (path, toml) = (scan(folder.path()), folder.path().join("scan.toml"));
        let mut bench = Bench::with(Setup { file: Some(path.clone()), mesh: UP, ..Setup::default() });
        bench.wait(|editor| editor.document.work.mesh.is_some());
        let editor = bench.harness.state_mut();
        editor.open(&path, OpeningPurpose::Again);
        assert_eq!(editor.opening[0].mesh, UP);
        editor.open(&toml, OpeningPurpose::Again);
        assert_eq!(editor.opening[0].mesh, MeshOptions::default());
    }
}
