//! What is being worked on: a design and its light, with the steps that led there and the file it came from.

use super::history::History;
use crate::cut::{Cut, Design};
use crate::io::design_file::{self, DesignFormat, ImportedDesign};
use crate::io::mesh_options::MeshOptions;
use crate::io::{cut_file, library};
use crate::scene::{Copies, Specimen, SpecimenError};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::SystemTime;

/// All that undo goes back over.
#[derive(Debug, Clone, PartialEq)]
pub struct Work {
    /// The stone.
    pub design: Design,
    /// Its copies in renders.
    pub company: Copies,
    /// The light's name, or its file.
    pub light: String,
    /// Stops.
    pub exposure: f64,
    /// Half angle of the observer's head in ASET and figures, degrees; 0 for none.
    pub head: f64,
    /// The mesh that the stone was read from, if it was one.
    pub mesh: Option<ReadMesh>,
    /// What was odd about its file, in words.
    pub remarks: Arc<[String]>,
}

/// A mesh file, and how it was read.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadMesh {
    /// The file.
    pub path: PathBuf,
    /// How it was read.
    pub options: MeshOptions,
    /// Whether its shape leaves a doubt which way its table faces.
    pub is_doubtful: bool,
    /// The diameter that it was read with, mm.
    pub diameter_mm: f64,
}

/// What a file was like when it was last read or written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stamp(Option<(SystemTime, u64)>);

impl Stamp {
    /// Of the file as it is now; of one that is not there, none.
    pub fn of(path: &Path) -> Self {
        let read = std::fs::metadata(path).and_then(|m| Ok((m.modified()?, m.len())));
        Self(read.ok())
    }
}

/// A design that is open.
#[derive(Debug)]
pub struct Document {
    /// As it is now; changed in place, and taken note of by [`update`](Self::update).
    pub work: Work,
    history: History<Work>,
    saved: Design,
    /// Its copies as they began, or were last written as a scene.
    laid: Copies,
    path: Option<PathBuf>,
    stamp: Stamp,
    /// Whether the file has gone.
    is_lost: bool,
    /// The stone of the last design that makes one. What changes no light, as the name, may be older in it than in `built`.
    specimen: Arc<Specimen>,
    fault: Option<SpecimenError>,
    /// The design that stone or fault belong to.
    built: Design,
}

/// Whether two designs make the same stone, whatever they are called and whatever is said of them.
fn is_same_stone(a: &Design, b: &Design) -> bool {
    let is_same_cut = match (&a.cut, &b.cut) {
        (Cut::Tiers(a), Cut::Tiers(b)) => (a.gear, a.offset, &a.tiers) == (b.gear, b.offset, &b.tiers),
        (a, b) => a == b,
    };
    is_same_cut && a.diameter_mm == b.diameter_mm && a.material == b.material
}

/// The light that a program starts with.
pub const FIRST_LIGHT: &str = "studio";

impl Document {
    /// A design that lies in a file, or in none yet.
    ///
    /// # Errors
    /// What keeps it from being a stone.
    pub fn new(design: Design, path: Option<PathBuf>) -> Result<Self, SpecimenError> {
        let specimen = Arc::new(Specimen::new(design.clone())?);
        let work = Work {
            design: design.clone(),
            company: Copies::default(),
            light: FIRST_LIGHT.to_owned(),
            exposure: 0.0,
            head: 0.0,
            mesh: None,
            remarks: Arc::default(),
        };
        let stamp = path.as_deref().map_or(Stamp(None), Stamp::of);
        let history = History::new(work.clone());
        Ok(Self {
            work,
            history,
            saved: design.clone(),
            laid: Copies::default(),
            path,
            stamp,
            is_lost: false,
            specimen,
            fault: None,
            built: design,
        })
    }

    /// A cut that comes with the program, as a design without a file.
    ///
    /// # Errors
    /// Where there is none of that name.
    pub fn of_library(name: &str) -> Result<Self, String> {
        let text = library::cut(name).ok_or_else(|| format!("no cut '{name}' comes with the program"))?;
        let design = cut_file::parse(text, name).map_err(|e| e.to_string())?;
        Self::new(design, None).map_err(|e| format!("{name}: {e}"))
    }

    /// The first design that anyone sees.
    ///
    /// # Errors
    /// None, unless the program itself is broken.
    pub fn first() -> Result<Self, String> {
        Self::of_library(library::FIRST_CUT)
    }

    /// Opens a design; the options are those of meshes.
    ///
    /// # Errors
    /// Text that names file, line and key, and what to do.
    pub fn open(path: &Path, mesh: MeshOptions) -> Result<Self, String> {
        let ImportedDesign { design, notes, warnings, doubt } =
            design_file::read_with(path, mesh).map_err(|e| e.to_string())?;
        let mut document =
            Self::new(design, Some(path.to_owned())).map_err(|e| format!("{}: {e}", path.display()))?;
        document.work.remarks = warnings.into_iter().chain(notes).collect();
        let diameter_mm = document.work.design.diameter_mm;
        let read = |is_doubtful| ReadMesh { path: path.to_owned(), options: mesh, is_doubtful, diameter_mm };
        document.work.mesh = doubt.map(read);
        document.history = History::new(document.work.clone());
        Ok(document)
    }

    /// Takes the shape of a mesh that was read once more, in another way; all else of the work stays, so also how much larger
    /// the stone was made than the file has it. A step that can be undone.
    pub fn take_shape(&mut self, other: Self) {
        let enlarged =
            self.work.mesh.as_ref().map_or(1.0, |mesh| self.work.design.diameter_mm / mesh.diameter_mm);
        self.work.design.diameter_mm = enlarged * other.work.design.diameter_mm;
        self.work.design.cut = other.work.design.cut;
        self.work.mesh = other.work.mesh;
        self.work.remarks = other.work.remarks;
    }

    /// A design that was never saved, found after a crash, and the mesh that it was read from, if it was one: it counts as
    /// changed.
    ///
    /// # Errors
    /// What keeps it from being a stone.
    pub fn recovered(design: Design, path: Option<PathBuf>, mesh: Option<ReadMesh>) -> Result<Self, String> {
        let mut document = Self::new(design, path).map_err(|e| e.to_string())?;
        document.work.mesh = mesh;
        document.history = History::new(document.work.clone());
        // A mesh is read as it is found: a table direction that was chosen is a change, which the file does not hold.
        let on_disk = document.path.as_deref().and_then(|p| design_file::read(p).ok());
        document.saved = on_disk
            .map(|brought| brought.design)
            .unwrap_or_else(|| Design { name: String::new(), ..document.saved });
        Ok(document)
    }

    /// Begins under a light, which is no step of its own.
    pub fn begin(&mut self, light: &str, exposure: f64, head: f64) {
        (self.work.light, self.work.exposure, self.work.head) = (light.to_owned(), exposure, head);
        self.history = History::new(self.work.clone());
    }

    /// Takes over the copies of another, and whether they are safe.
    pub fn take_copies(&mut self, other: &Self) {
        self.work.company.clone_from(&other.work.company);
        self.laid.clone_from(&other.laid);
    }

    /// The copies are safe as they lie.
    pub fn keep_copies(&mut self) {
        self.laid.clone_from(&self.work.company);
    }

    /// Whether copies lie otherwise than they began, or were last written.
    pub fn has_moved_copies(&self) -> bool {
        self.laid != self.work.company
    }

    /// Takes note of changes: builds the stone, or notes why there is none. Whether there is another stone than before, which
    /// has to be traced: a new name makes none.
    pub fn update(&mut self) -> bool {
        if self.work.design == self.built {
            return false;
        }
        self.built = self.work.design.clone();
        if is_same_stone(&self.specimen.design, &self.built) {
            self.fault = self.built.check().err().map(SpecimenError::from);
            return false;
        }
        match self.specimen.remade(self.built.clone()) {
            Ok(specimen) => {
                self.specimen = Arc::new(specimen);
                // A stone may have a name that no file can hold.
                self.fault = self.built.check().err().map(SpecimenError::from);
                true
            }
            Err(fault) => {
                self.fault = Some(fault);
                false
            }
        }
    }

    /// Ends a gesture: what it changed is one step; whether it changed anything.
    pub fn settle(&mut self) -> bool {
        self.history.settle(&self.work)
    }

    /// The last stone that could be built.
    pub fn specimen(&self) -> &Arc<Specimen> {
        &self.specimen
    }

    /// A stone of this document, as [`specimen`](Self::specimen) or turned, under the name that its design has now.
    pub fn named(&self, specimen: &Arc<Specimen>) -> Arc<Specimen> {
        let now = &self.specimen.design;
        if *now == self.built || !is_same_stone(now, &self.built) {
            return Arc::clone(specimen);
        }
        let mut design = self.built.clone();
        // A plate that waves is in another phase than its design.
        if let Cut::Glass(_) = design.cut {
            design.cut = specimen.design.cut.clone();
        }
        Arc::new(Specimen { design, ..(**specimen).clone() })
    }

    /// Whether the design makes no stone, and [`specimen`](Self::specimen) is the last one that it made.
    pub fn shows_last_possible(&self) -> bool {
        self.fault.is_some() && !is_same_stone(&self.specimen.design, &self.built)
    }

    /// What keeps the design as it is now from being a stone.
    pub fn fault(&self) -> Option<&SpecimenError> {
        self.fault.as_ref()
    }

    /// Where it is saved.
    pub fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }

    /// What it is called: its file's name, or its own.
    pub fn title(&self) -> String {
        let file = self.path.as_deref().and_then(Path::file_name).map(|n| n.to_string_lossy().into_owned());
        file.unwrap_or_else(|| self.work.design.name.clone())
    }

    /// The design as it was last saved.
    pub fn saved(&self) -> &Design {
        &self.saved
    }

    /// Whether closing it would lose work.
    pub fn is_changed(&self) -> bool {
        self.work.design != self.saved || self.is_lost
    }

    /// Whether its file is another than it was read from or written to.
    pub fn is_changed_outside(&self) -> bool {
        self.path.as_deref().is_some_and(|path| Stamp::of(path) != self.stamp)
    }

    /// Whether its file has gone, as far as is known.
    pub fn is_lost(&self) -> bool {
        self.is_lost
    }

    /// Takes the file on disk for what was meant to be there: it is not told of again.
    pub fn accept_outside(&mut self) {
        if let Some(path) = &self.path {
            self.stamp = Stamp::of(path);
            self.is_lost = !path.exists();
        }
    }

    /// Whether there is anything to undo, and to do again.
    pub fn steps(&self) -> (bool, bool) {
        (self.history.can_undo() || self.work != *self.history.present(), self.history.can_redo())
    }

    /// Goes one step back.
    pub fn undo(&mut self) {
        self.settle();
        if let Some(work) = self.history.undo() {
            self.work = work;
        }
    }

    /// Does again what was undone.
    pub fn redo(&mut self) {
        if !self.settle()
            && let Some(work) = self.history.redo()
        {
            self.work = work;
        }
    }

    /// Saves the design where it lies, or elsewhere from now on, in the format that the file's name asks for; what that
    /// could not hold, in words.
    ///
    /// # Errors
    /// When the design makes no stone, or the file system refuses; the old file stays as it is.
    pub fn save(&mut self, path: PathBuf) -> Result<Vec<String>, String> {
        if let Some(fault) = &self.fault {
            return Err(format!("this design cannot be read again: {fault}"));
        }
        let specimen = self.specimen.remade(self.work.design.clone()).map_err(|e| e.to_string())?;
        let format = DesignFormat::of_name(&path).unwrap_or(DesignFormat::Toml);
        let lost = design_file::write(&specimen, format, &path).map_err(|e| e.to_string())?;
        (self.stamp, self.path, self.is_lost) = (Stamp::of(&path), Some(path), false);
        self.saved = self.work.design.clone();
        Ok(lost)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cut::Crown;

    fn crown(document: &mut Document, degrees: f64) {
        let Cut::RoundBrilliant(brilliant) = &mut document.work.design.cut else { panic!() };
        brilliant.crown = Crown::Angle(degrees);
    }

    #[test]
    fn an_edited_design_is_saved_and_reads_back_equal() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("mine.toml");
        let mut document = Document::first().unwrap();
        assert!(!document.is_changed() && document.path().is_none());
        crown(&mut document, 35.125);
        assert!(document.update() && document.settle() && document.is_changed());
        document.save(path.clone()).unwrap();
        assert!(!document.is_changed() && document.title() == "mine.toml" && !document.is_changed_outside());
        assert_eq!(Document::open(&path, MeshOptions::default()).unwrap().work.design, document.work.design);
        std::fs::write(&path, "format = 1").unwrap();
        assert!(document.is_changed_outside());
        document.accept_outside();
        assert!(!document.is_changed_outside() && !document.is_changed());
        std::fs::remove_file(&path).unwrap();
        assert!(document.is_changed_outside());
        document.accept_outside();
        assert!(document.is_changed(), "what is nowhere any more is not saved");
    }

    #[test]
    fn a_name_that_no_file_can_hold_is_not_saved() {
        let folder = tempfile::tempdir().unwrap();
        let mut document = Document::first().unwrap();
        document.work.design.name = " ".to_owned();
        assert!(!document.update() && document.fault().is_some() && !document.shows_last_possible());
        let path = folder.path().join("mine.toml");
        assert!(document.save(path.clone()).unwrap_err().contains("printable") && !path.exists());
    }

    #[test]
    fn a_design_that_makes_no_stone_keeps_the_last_one_and_is_not_saved() {
        let folder = tempfile::tempdir().unwrap();
        let mut document = Document::first().unwrap();
        let stone = Arc::clone(document.specimen());
        crown(&mut document, 90.0);
        assert!(!document.update());
        assert!(document.fault().unwrap().to_string().contains("crown_angle"));
        assert!(Arc::ptr_eq(&stone, document.specimen()) && document.shows_last_possible());
        let path = folder.path().join("mine.toml");
        assert!(document.save(path.clone()).unwrap_err().contains("crown_angle") && !path.exists());
        document.undo();
        assert!(!document.update() && document.fault().is_none(), "it is the stone that is in sight");
        assert!(Arc::ptr_eq(&stone, document.specimen()) && !document.shows_last_possible());
    }

    #[test]
    fn undo_in_the_middle_of_a_gesture_undoes_it() {
        let mut document = Document::first().unwrap();
        let before = document.work.clone();
        crown(&mut document, 30.0);
        assert_eq!(document.steps(), (true, false));
        document.undo();
        assert_eq!((&document.work, document.steps()), (&before, (false, true)));
    }
}
