//! Files on their way in: read and built aside, so that the window stays quick whatever their size.

use super::compare::Compared;
use super::dialogs::{Dialog, Then};
use super::document::{Document, Work};
use super::editor::Editor;
use super::preset::Preset;
use crate::io::mesh_options::MeshOptions;
use crate::io::scene_file;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, channel};

/// What a file is opened for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Wanted {
    /// To be worked on.
    Anew,
    /// The file that is open already, without moving any view.
    Again,
    /// To be compared with.
    Beside,
    /// The mesh that is open already, read in another way.
    Otherwise,
}

/// What is said of a mesh whose table may face another way.
const DOUBTFUL: &str = "The shape of this mesh leaves a doubt which way its table faces: choose it in the panel Design, by \
    Table faces.";

/// A file on its way in.
pub struct Opening {
    wanted: Wanted,
    path: PathBuf,
    /// The work as it was when the file was asked for.
    work: Work,
    answer: Receiver<Result<Came, String>>,
}

/// What was in a file.
enum Came {
    Design(Box<Document>),
    Scene(Box<Preset>),
}

impl Came {
    /// Reads a file; scenes are taken only to be worked on.
    fn of(path: &Path, wanted: Wanted, mesh: MeshOptions) -> Result<Self, String> {
        match wanted == Wanted::Anew && is_scene(path) {
            true => Preset::read(path).map(Box::new).map(Self::Scene),
            false => Document::open(path, mesh).map(Box::new).map(Self::Design),
        }
    }
}

impl Opening {
    /// Whether what is worked on stays.
    pub fn is_beside(&self) -> bool {
        self.wanted == Wanted::Beside
    }

    /// What is under way, in words.
    pub fn told(&self) -> String {
        format!("opening {}…", self.path.file_name().unwrap_or_default().to_string_lossy())
    }
}

/// Whether a file is a scene; what has another ending is not looked into.
fn is_scene(path: &Path) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case("toml")) && scene_file::is_scene(path)
}

impl Editor {
    /// Opens a file; one that is still on its way for the same purpose is forgotten.
    pub(super) fn open(&mut self, path: &Path, wanted: Wanted) {
        // A mesh that has changed is read as it was.
        let again = self.document.work.mesh.as_ref().filter(|_| wanted == Wanted::Again);
        let mesh = again.map_or(MeshOptions::default(), |mesh| mesh.options);
        self.open_with(path, wanted, mesh);
    }

    /// Opens a file as [`open`](Self::open) does; the options are those of meshes.
    pub(super) fn open_with(&mut self, path: &Path, wanted: Wanted, mesh: MeshOptions) {
        let (sender, answer) = channel();
        let (name, wake) = (path.to_owned(), self.studio.wake());
        std::thread::spawn(move || {
            // Nobody waits for it any more where another was chosen.
            let _ = sender.send(Came::of(&name, wanted, mesh));
            wake();
        });
        let opening = Opening { wanted, path: path.to_owned(), work: self.document.work.clone(), answer };
        self.opening.retain(|other| other.is_beside() != (wanted == Wanted::Beside));
        self.opening.push(opening);
    }

    /// Takes in the files that have come.
    pub(super) fn take_in_files(&mut self) {
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
        // What was changed while the file was on its way is nothing that anyone has given up.
        let is_later = self.document.work != opening.work;
        match (opening.wanted, came) {
            (Wanted::Anew, _) if is_later => self.ask_before(Then::Open(opening.path.clone())),
            (Wanted::Again, _) if is_later => self.dialog = Some(Dialog::ChangedOutside),
            (_, Came::Scene(preset)) => {
                self.begin_scene(*preset);
                self.desk.remember(&opening.path);
            }
            (Wanted::Beside, Came::Design(document)) => self.compared = Some(Compared::of(&document)),
            (Wanted::Anew, Came::Design(document)) => {
                self.desk.remember(&opening.path);
                let is_doubtful = document.work.mesh.as_ref().is_some_and(|mesh| mesh.is_doubtful);
                self.begin(*document);
                if is_doubtful {
                    self.notes.say(DOUBTFUL);
                }
            }
            (Wanted::Otherwise, Came::Design(document)) => {
                // Another design may have been opened meanwhile.
                let path = |work: &Work| work.mesh.as_ref().map(|mesh| mesh.path.clone());
                if path(&self.document.work) == path(&document.work) {
                    self.document.take_shape(*document);
                }
            }
            (Wanted::Again, Came::Design(mut document)) => {
                let (desk, framing) = (self.desk.clone(), self.framing.clone());
                document.take_copies(&self.document);
                self.begin(*document);
                (self.desk, self.framing) = (desk, framing);
                self.notes.say("The file was changed by another program and has been read again.");
            }
        }
    }
}
