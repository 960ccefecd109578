//! The open document: a design and its light, with the steps of undo and the file it came from.

use crate::app::model::history::History;
use crate::cut::{Cut, Design};
use crate::io::design_file::{self, DesignFormat, ImportedDesign};
use crate::io::mesh_options::MeshOptions;
use crate::io::{cut_file, library};
use crate::scene::{Copies, Specimen, SpecimenError};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::SystemTime;

/// Everything that undo restores.
#[derive(Debug, Clone, PartialEq)]
pub struct Work {
    /// The design of the stone.
    pub design: Design,
    /// The copies of the stone in renders.
    pub company: Copies,
    /// The name of the light, or its file.
    pub light: String,
    /// The exposure of renders, in stops.
    pub exposure: f64,
    /// The half angle of the observer's head in ASET and figures, degrees; 0 for none.
    pub head: f64,
    /// The mesh file that the stone was read from, if it was one.
    pub mesh: Option<ReadMesh>,
    /// The warnings and notes about the file, in words.
    pub remarks: Arc<[String]>,
}

/// A mesh file, and how it was read.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadMesh {
    /// The mesh file.
    pub path: PathBuf,
    /// How the file was read.
    pub options: MeshOptions,
    /// Whether the shape leaves a doubt which way the table faces.
    pub is_doubtful: bool,
    /// The diameter of the stone when it was read, mm.
    pub diameter_mm: f64,
}

/// The time of change and the length of a file when it was last read or written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stamp(Option<(SystemTime, u64)>);

impl Stamp {
    /// Returns the stamp of the file as it is now; it is empty where there is no such file.
    pub fn of(path: &Path) -> Self {
        let read = std::fs::metadata(path).and_then(|m| Ok((m.modified()?, m.len())));
        Self(read.ok())
    }
}

/// A design that is open.
#[derive(Debug)]
pub struct Document {
    /// The work as it is now. It is changed in place; [`update`](Self::update) then takes note of the change.
    pub work: Work,
    history: History<Work>,
    saved: Design,
    /// The copies as they were at first, or as they were last written as a scene.
    laid: Copies,
    path: Option<PathBuf>,
    stamp: Stamp,
    /// Whether the file no longer exists.
    is_lost: bool,
    /// The stone of the last design that makes one. Its own design may be older than `built` in what changes no light, such
    /// as the name.
    specimen: Arc<Specimen>,
    fault: Option<SpecimenError>,
    /// The design that `specimen` or `fault` belongs to.
    built: Design,
}

/// Whether two designs make the same stone, whatever their names and notes.
fn is_same_stone(a: &Design, b: &Design) -> bool {
    let is_same_cut = match (&a.cut, &b.cut) {
        (Cut::Tiers(a), Cut::Tiers(b)) => (a.gear, a.offset, &a.tiers) == (b.gear, b.offset, &b.tiers),
        (a, b) => a == b,
    };
    is_same_cut && a.diameter_mm == b.diameter_mm && a.material == b.material
}

/// The light that the program starts with.
pub const FIRST_LIGHT: &str = "studio";

impl Document {
    /// Opens a design that lies in a file, or in none yet.
    ///
    /// # Errors
    /// Fails where the design makes no stone; the error says why.
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

    /// Opens a cut that comes with the program, as a design without a file.
    ///
    /// # Errors
    /// Fails where no cut of that name comes with the program.
    pub fn of_library(name: &str) -> Result<Self, String> {
        let text = library::cut(name).ok_or_else(|| format!("no cut '{name}' comes with the program"))?;
        let design = cut_file::parse(text, name).map_err(|e| e.to_string())?;
        Self::new(design, None).map_err(|e| format!("{name}: {e}"))
    }

    /// Opens the first design that a user sees.
    ///
    /// # Errors
    /// Fails only where the program itself is broken.
    pub fn first() -> Result<Self, String> {
        Self::of_library(library::FIRST_CUT)
    }

    /// Opens a design file; the options count where it is a mesh.
    ///
    /// # Errors
    /// The text names file, line and key, and says what to do.
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

    /// Takes the shape of the same mesh, read in another way, as a step that can be undone.
    ///
    /// All else of the work stays, and so does the factor by which the stone was made larger than in its file.
    pub fn take_shape(&mut self, other: Self) {
        let enlarged =
            self.work.mesh.as_ref().map_or(1.0, |mesh| self.work.design.diameter_mm / mesh.diameter_mm);
        self.work.design.diameter_mm = enlarged * other.work.design.diameter_mm;
        self.work.design.cut = other.work.design.cut;
        self.work.mesh = other.work.mesh;
        self.work.remarks = other.work.remarks;
    }

    /// Opens unsaved work that was found after a crash; it counts as changed.
    ///
    /// `mesh` is the mesh file that the stone was read from, if it was one.
    ///
    /// # Errors
    /// Fails where the design makes no stone; the text says why.
    pub fn recovered(design: Design, path: Option<PathBuf>, mesh: Option<ReadMesh>) -> Result<Self, String> {
        let mut document = Self::new(design, path).map_err(|e| e.to_string())?;
        document.work.mesh = mesh;
        document.history = History::new(document.work.clone());
        // `read` takes a mesh in the direction that it finds: a table direction that the user chose is a change that the
        // file lacks.
        let on_disk = document.path.as_deref().and_then(|p| design_file::read(p).ok());
        document.saved = on_disk
            .map(|brought| brought.design)
            .unwrap_or_else(|| Design { name: String::new(), ..document.saved });
        Ok(document)
    }

    /// Begins under a light; this is not a step of undo.
    pub fn begin(&mut self, light: &str, exposure: f64, head: f64) {
        (self.work.light, self.work.exposure, self.work.head) = (light.to_owned(), exposure, head);
        self.history = History::new(self.work.clone());
    }

    /// Takes over the copies of another document, and whether they count as kept.
    pub fn take_copies(&mut self, other: &Self) {
        self.work.company.clone_from(&other.work.company);
        self.laid.clone_from(&other.laid);
    }

    /// Counts the copies as kept where they lie now.
    pub fn keep_copies(&mut self) {
        self.laid.clone_from(&self.work.company);
    }

    /// Whether the copies lie otherwise than at first, or than when they were last written.
    pub fn has_moved_copies(&self) -> bool {
        self.laid != self.work.company
    }

    /// Builds the stone after a change, or notes why there is none.
    ///
    /// Returns whether the stone is another than before and has to be traced: a new name makes no other stone.
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
                // A stone can be built whose name no file can hold.
                self.fault = self.built.check().err().map(SpecimenError::from);
                true
            }
            Err(fault) => {
                self.fault = Some(fault);
                false
            }
        }
    }

    /// Ends a gesture: all that it changed becomes one step of undo. Returns whether it changed anything.
    pub fn settle(&mut self) -> bool {
        self.history.settle(&self.work)
    }

    /// Returns the last stone that could be built.
    pub fn specimen(&self) -> &Arc<Specimen> {
        &self.specimen
    }

    /// Returns a stone of this document, [`specimen`](Self::specimen) or a turned one, under the name that the design has
    /// now.
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

    /// Whether the design makes no stone, so that [`specimen`](Self::specimen) is the last one that it made.
    pub fn shows_last_possible(&self) -> bool {
        self.fault.is_some() && !is_same_stone(&self.specimen.design, &self.built)
    }

    /// Returns what keeps the present design from being a stone.
    pub fn fault(&self) -> Option<&SpecimenError> {
        self.fault.as_ref()
    }

    /// Returns the file that the document is saved in, if any.
    pub fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }

    /// Returns the title of the document: the name of its file, or that of the design.
    pub fn title(&self) -> String {
        let file = self.path.as_deref().and_then(Path::file_name).map(|n| n.to_string_lossy().into_owned());
        file.unwrap_or_else(|| self.work.design.name.clone())
    }

    /// Returns the design as it was last saved.
    pub fn saved(&self) -> &Design {
        &self.saved
    }

    /// Whether closing the document would lose work.
    pub fn is_changed(&self) -> bool {
        self.work.design != self.saved || self.is_lost
    }

    /// Whether the file has changed since the document was last read from it or written to it.
    pub fn is_changed_outside(&self) -> bool {
        self.path.as_deref().is_some_and(|path| Stamp::of(path) != self.stamp)
    }

    /// Whether the file no longer existed when it was last checked.
    pub fn is_lost(&self) -> bool {
        self.is_lost
    }

    /// Accepts the file on disk as it is, so that its change is not reported again.
    pub fn accept_outside(&mut self) {
        if let Some(path) = &self.path {
            self.stamp = Stamp::of(path);
            self.is_lost = !path.exists();
        }
    }

    /// Whether there is anything to undo, and anything to redo.
    pub fn steps(&self) -> (bool, bool) {
        (self.history.can_undo() || self.work != *self.history.present(), self.history.can_redo())
    }

    /// Undoes one step.
    pub fn undo(&mut self) {
        self.settle();
        if let Some(work) = self.history.undo() {
            self.work = work;
        }
    }

    /// Redoes one step that was undone.
    pub fn redo(&mut self) {
        if !self.settle()
            && let Some(work) = self.history.redo()
        {
            self.work = work;
        }
    }

    /// Saves the design to `path`, which is its file from now on, in the format of the file's name.
    ///
    /// Returns what that format could not hold, in words.
    ///
    /// # Errors
    /// Fails when the design makes no stone, or the file system refuses; the old file stays as it is.
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
