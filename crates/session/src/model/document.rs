//! The open document: a design and its light, with the steps of undo and the file it came from.

use super::document_origin::DocumentOrigin;
use super::extent::Extent;
use super::history::History;
use super::impossible;
use super::recovery::RecoveredWork;
use super::render_settings::RenderSettings;
use super::saving::{SaveRequest, SavedDesign, Stamp};
use super::view_history::ViewState;
use super::work::{ReadMesh, Work};
use brillianteer_base::{Failure, FileError};
use brillianteer_cut::{Cut, Design, Tiers};
use brillianteer_files::design_file::{self, ImportedDesign};
use brillianteer_files::mesh_options::MeshOptions;
use brillianteer_files::{cut_file, library};
use brillianteer_scene::{Companions, Copies, RingPlan, Specimen, SpecimenError};
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

/// A design that is open.
#[derive(Debug, Clone)]
pub struct Document {
    /// The work as it is now. It is changed in place; [`update`](Self::update) then rebuilds the stone.
    pub work: Work,
    history: History<Work>,
    /// The origins of the designs in the steps of undo; the work has the number of its own.
    origins: Vec<DocumentOrigin>,
    /// The stone of the last design that makes one. Its own design may be older than `built` in what changes no light, such
    /// as the name.
    specimen: Arc<Specimen>,
    /// The extent of that stone, measured when it is first needed.
    extent: OnceLock<Extent>,
    fault: Option<SpecimenError>,
    /// The design that `specimen` or `fault` belongs to.
    built: Design,
}

/// Returns whether two designs make the same stone, whatever their names and notes.
fn is_same_stone(a: &Design, b: &Design) -> bool {
    let is_same_cut = match (&a.cut, &b.cut) {
        // The audit measures a stone by the symmetry that its design states.
        (Cut::Tiers(a), Cut::Tiers(b)) => {
            let planes = |tiers: &Tiers| (tiers.gear, tiers.offset, tiers.symmetry, tiers.mirror);
            planes(a) == planes(b) && a.tiers == b.tiers
        }
        (a, b) => a == b,
    };
    is_same_cut && a.diameter_mm == b.diameter_mm && a.material == b.material
}

/// Takes the meets that the instructions of a design state, where its file keeps none and they move no tier.
fn adopt_meets(design: &mut Design) {
    if let Cut::Tiers(tiers) = &mut design.cut
        && tiers.tiers.iter().all(|tier| tier.meet.is_none())
    {
        *tiers = tiers.with_kept_stated_meets();
    }
}

/// Returns the name of a file for a name that people read.
fn file_name(name: &str) -> String {
    name.to_lowercase().replace([' ', '/'], "-")
}

impl Document {
    /// Opens a design, with or without a file.
    ///
    /// # Errors
    /// Fails where the design makes no stone; the error says why.
    pub fn new(design: Design, path: Option<PathBuf>) -> Result<Self, SpecimenError> {
        let specimen = Arc::new(Specimen::new(design.clone())?);
        let work = Work {
            design: design.clone(),
            copies: Copies::default(),
            companions: Companions::default(),
            settings: RenderSettings::default(),
            mesh: None,
            remarks: Arc::default(),
            origin: 0,
        };
        let history = History::new(work.clone());
        Ok(Self {
            work,
            history,
            origins: vec![DocumentOrigin::new(design.clone(), path)],
            specimen,
            extent: OnceLock::new(),
            fault: None,
            built: design,
        })
    }

    /// Opens a cut that comes with the program, as a design without a file.
    ///
    /// # Errors
    /// Fails where no cut of that name comes with the program.
    pub fn of_library(name: &str) -> Result<Self, FileError> {
        let text = library::cut(name)
            .ok_or_else(|| FileError::new(name, "no cut of this name comes with the program"))?;
        let design = cut_file::parse(text, name)?;
        Self::new(design, None).map_err(|error| FileError::new(name, error))
    }

    /// Opens the first design that a user sees.
    ///
    /// # Errors
    /// Fails only where the program itself is broken.
    pub fn first() -> Result<Self, FileError> {
        Self::of_library(library::FIRST_CUT)
    }

    /// Opens a design file; the options apply to meshes.
    ///
    /// # Errors
    /// Fails where the file cannot be read, is no design, or makes no stone.
    pub fn open(path: &Path, mesh: &MeshOptions) -> Result<Self, FileError> {
        let imported = design_file::read_with(path, mesh)?;
        let parts = imported.choices();
        let ImportedDesign { mut design, notes, warnings, doubt, .. } = imported;
        adopt_meets(&mut design);
        let mut document = Self::new(design, Some(path.to_owned()))
            .map_err(|error| FileError::new(path.display(), error))?;
        document.work.remarks = warnings.into_iter().chain(notes).collect();
        let diameter_mm = document.work.design.diameter_mm;
        let (path, options) = (path.to_owned(), mesh.clone());
        let read = |is_doubtful| ReadMesh { path, options, parts, is_doubtful, diameter_mm };
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
    /// # Errors
    /// Fails where the design makes no stone; the text says why.
    pub fn recovered(found: &RecoveredWork) -> Result<Self, Failure> {
        let mut document =
            Self::new(found.design.clone(), found.path.clone()).map_err(|e| Failure::Input(e.to_string()))?;
        document.work.mesh.clone_from(&found.mesh);
        document.history = History::new(document.work.clone());
        let nameless = || Design { name: String::new(), ..found.design.clone() };
        document.origin_mut().saved = found.on_disk.clone().unwrap_or_else(nameless);
        Ok(document)
    }

    fn origin(&self) -> &DocumentOrigin {
        &self.origins[self.work.origin]
    }

    fn origin_mut(&mut self) -> &mut DocumentOrigin {
        &mut self.origins[self.work.origin]
    }

    /// Takes a scene around the design, with settings of pictures, as the first state of the document; this is not a step of
    /// undo.
    pub fn begin_with(&mut self, copies: Copies, companions: Companions, settings: RenderSettings) {
        (self.work.copies, self.work.companions) = (copies, companions);
        self.origin_mut().first.clone_from(&settings);
        self.work.settings = settings;
        self.keep_copies();
        self.history = History::new(self.work.clone());
    }

    /// Takes the copies and companions as they were opened or last written as a scene, before what is there now.
    pub fn begin_laid(&mut self, copies: Copies, companions: Companions) {
        self.origin_mut().laid = (copies, companions);
    }

    /// Goes on from another document, whose views are given: this one becomes the next step of undo after that one.
    pub fn go_on_from(&mut self, before: Self, views: ViewState) {
        let Self { work, mut history, mut origins, .. } = before;
        history.settle(&work);
        origins[work.origin].views = Some(views);
        let own = DocumentOrigin { scene_from: origins.len(), ..self.origin().clone() };
        self.work.origin = origins.len();
        origins.push(own);
        history.settle(&self.work);
        (self.history, self.origins) = (history, origins);
    }

    /// Returns whether the origin of this number is that of a stone of the present scene, or of the present design.
    pub fn is_of_this_scene(&self, origin: usize) -> bool {
        self.origins.get(origin).is_some_and(|other| other.scene_from == self.origin().scene_from)
    }

    /// Keeps the views of the design with another origin, which undo or redo has replaced by the present one; returns the views
    /// that the present design had.
    pub fn exchange_views(&mut self, left: usize, views: ViewState) -> Option<ViewState> {
        if let Some(origin) = self.origins.get_mut(left) {
            origin.views = Some(views);
        }
        self.origin_mut().views.take()
    }

    /// Takes over the copies, the companions and the settings of another document, and their first state.
    pub fn take_scene(&mut self, other: &Self) {
        let Work { copies, companions, settings, .. } = other.work.clone();
        (self.work.copies, self.work.companions, self.work.settings) = (copies, companions, settings);
        let DocumentOrigin { laid, first, .. } = other.origin().clone();
        (self.origin_mut().laid, self.origin_mut().first) = (laid, first);
        self.history = History::new(self.work.clone());
    }

    /// Returns the settings of pictures with which the design was opened: the defaults of their rows.
    pub fn first_settings(&self) -> &RenderSettings {
        &self.origin().first
    }

    /// Returns the copies and the companions as they were opened, or last written as a scene.
    pub fn laid(&self) -> (&Copies, &Companions) {
        let (copies, companions) = &self.origin().laid;
        (copies, companions)
    }

    /// Replaces the design by that of another stone of the scene, as a step of undo. The new design belongs to no
    /// file.
    pub fn take_up(&mut self, design: Design, copies: Copies, companions: Companions) {
        let was_laid = !self.has_moved_copies() && !self.is_changed();
        let DocumentOrigin { laid, first, scene_from, .. } = self.origin().clone();
        let begun = DocumentOrigin::new(design.clone(), None);
        self.origins.push(DocumentOrigin { laid, first, scene_from, ..begun });
        let origin = self.origins.len() - 1;
        self.work = Work { design, copies, companions, mesh: None, origin, ..self.work.clone() };
        if was_laid {
            self.keep_copies();
        }
        self.update();
        self.settle();
    }

    /// Marks the present places of the copies and their companions as saved.
    pub fn keep_copies(&mut self) {
        self.origin_mut().laid = (self.work.copies.clone(), self.work.companions.clone());
    }

    /// Returns what the metal of the scene's ring has to be made of now; `None` without a ring, and while the design makes no
    /// stone.
    pub fn ring_plan(&self) -> Option<RingPlan> {
        let first = self.work.copies.poses.first().filter(|_| !self.shows_last_possible())?;
        self.work.companions.ring_plan(&self.specimen, first.at * self.specimen.unit_mm())
    }

    /// Returns whether copies or their companions have been moved since they were read or last saved.
    pub fn has_moved_copies(&self) -> bool {
        self.laid() != (&self.work.copies, &self.work.companions)
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
                (self.specimen, self.extent) = (Arc::new(specimen), OnceLock::new());
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

    /// Lets the last step of undo lead to the present work, without a new step, because a change followed from that step.
    pub fn amend(&mut self) {
        self.history.amend(&self.work);
    }

    /// Ends a step of undo with this design in the place of the present one. Returns whether the step differs from
    /// the last one.
    pub fn settle_with(&mut self, design: &Design) -> bool {
        self.history.settle(&Work { design: design.clone(), ..self.work.clone() })
    }

    /// Returns the work before the last step, which undo brings back.
    pub fn step_before(&self) -> Option<&Work> {
        self.history.before()
    }

    /// Returns the last stone that could be built.
    pub fn specimen(&self) -> &Arc<Specimen> {
        &self.specimen
    }

    /// Returns the extent of the last stone that could be built, from above.
    pub fn extent(&self) -> Extent {
        *self.extent.get_or_init(|| Extent::of(&self.specimen))
    }

    /// Returns a stone of this document, [`specimen`](Self::specimen) or one that moves, under the name that the design has
    /// now.
    pub fn named(&self, specimen: &Arc<Specimen>) -> Arc<Specimen> {
        let now = &self.specimen.design;
        if *now == self.built || !is_same_stone(now, &self.built) {
            return Arc::clone(specimen);
        }
        let mut design = self.built.clone();
        // The stone of a moving plate is in another phase of its waves than the design.
        if let Cut::Glass(_) = design.cut {
            design.cut = specimen.design.cut.clone();
        }
        Arc::new(Specimen { design, ..(**specimen).clone() })
    }

    /// Returns whether the design makes no stone, so that [`specimen`](Self::specimen) is the last one that it made.
    pub fn shows_last_possible(&self) -> bool {
        self.fault.is_some() && !is_same_stone(&self.specimen.design, &self.built)
    }

    /// Returns why the present design makes no stone.
    pub fn fault(&self) -> Option<&SpecimenError> {
        self.fault.as_ref()
    }

    /// Returns the file that the document is saved in, if any.
    pub fn path(&self) -> Option<&Path> {
        self.origin().path.as_deref()
    }

    /// Sets the name of the scene whose stone is edited.
    pub fn call_scene(&mut self, name: &str) {
        self.origin_mut().scene = Some(name.to_owned());
    }

    /// Returns the name of the scene whose stone is edited, or that of the design.
    pub fn name(&self) -> &str {
        self.origin().scene.as_deref().unwrap_or(&self.work.design.name)
    }

    /// Returns the title of the document: the name of its file, of its scene, or of the design.
    pub fn title(&self) -> String {
        let file = self.path().and_then(Path::file_name).map(|n| n.to_string_lossy().into_owned());
        file.unwrap_or_else(|| self.name().to_owned())
    }

    /// Returns the folder of the document's file, or the present folder where there is no file.
    pub fn folder(&self) -> PathBuf {
        let here = || std::env::current_dir().unwrap_or_default();
        self.path().and_then(Path::parent).map_or_else(here, Path::to_owned)
    }

    /// Returns the name for files of the document, without an ending: that of its file, or one made of its own name.
    pub fn stem(&self) -> String {
        let file = self.path().and_then(Path::file_stem).map(|n| n.to_string_lossy().into_owned());
        file.unwrap_or_else(|| file_name(self.name()))
    }

    /// Returns the name for a file of the design alone, without an ending.
    pub fn design_stem(&self) -> String {
        file_name(&self.work.design.name)
    }

    /// Returns the design as it was last saved.
    pub fn saved(&self) -> &Design {
        &self.origin().saved
    }

    /// Returns whether closing the document would lose work.
    pub fn is_changed(&self) -> bool {
        self.work.design != self.origin().saved || self.is_lost()
    }

    /// Returns the state of the file when it was last read or written.
    pub fn stamp(&self) -> Stamp {
        self.origin().stamp
    }

    /// Returns whether the file no longer existed when it was last checked.
    pub fn is_lost(&self) -> bool {
        self.origin().is_lost
    }

    /// Accepts the file on disk as it is, so that its change is not reported again.
    pub fn accept_outside(&mut self, stamp: Stamp) {
        let origin = self.origin_mut();
        (origin.stamp, origin.is_lost) = (stamp, !stamp.is_there());
    }

    /// Returns whether there is a step to undo, and one to redo.
    pub fn steps(&self) -> (bool, bool) {
        (self.history.can_undo() || self.has_unsettled(), self.history.can_redo())
    }

    /// Returns whether anything has changed since the last step, for example by a gesture that is still going on.
    pub fn has_unsettled(&self) -> bool {
        self.work != *self.history.present()
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

    /// Returns the request that saves the design of this document, whose number is `document`, to `path`.
    ///
    /// # Errors
    /// Fails when the design makes no stone.
    pub fn to_save(&self, document: u64, path: PathBuf) -> Result<SaveRequest, Failure> {
        match &self.fault {
            Some(fault) => Err(Failure::Input(format!(
                "this design is impossible, so it cannot be saved: {}",
                impossible::by_name(fault)
            ))),
            None => Ok(SaveRequest {
                document,
                path,
                design: self.work.design.clone(),
                specimen: Arc::clone(&self.specimen),
            }),
        }
    }

    /// Records that a design of this document has been saved: its file is that of the document from now on.
    pub fn take_saved(&mut self, saved: SavedDesign) {
        let origin = self.origin_mut();
        (origin.stamp, origin.path, origin.is_lost) = (saved.stamp, Some(saved.path), false);
        origin.saved = saved.design;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tasks::open::save;
    use brillianteer_cut::Crown;

    fn crown(document: &mut Document, degrees: f64) {
        let Cut::RoundBrilliant(brilliant) = &mut document.work.design.cut else { panic!() };
        brilliant.crown = Crown::Angle(degrees);
    }

    /// Returns whether the file has changed since the document was last read from it or written to it.
    fn is_changed_outside(document: &Document) -> bool {
        document.path().is_some_and(|path| Stamp::of(path) != document.stamp())
    }

    #[test]
    fn an_edited_design_is_saved_and_reads_back_equal() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("mine.toml");
        let mut document = Document::first().unwrap();
        assert!(!document.is_changed() && document.path().is_none());
        crown(&mut document, 35.125);
        assert!(document.update() && document.settle() && document.is_changed());
        document.take_saved(save(document.to_save(0, path.clone()).unwrap()).unwrap());
        assert!(!document.is_changed() && document.title() == "mine.toml" && !is_changed_outside(&document));
        assert_eq!(Document::open(&path, &MeshOptions::default()).unwrap().work.design, document.work.design);
        std::fs::write(&path, "format = 1").unwrap();
        assert!(is_changed_outside(&document));
        document.accept_outside(Stamp::of(&path));
        assert!(!is_changed_outside(&document) && !document.is_changed());
        std::fs::remove_file(&path).unwrap();
        assert!(is_changed_outside(&document));
        document.accept_outside(Stamp::of(&path));
        assert!(document.is_changed(), "what is nowhere any more is not saved");
    }

    #[test]
    fn a_name_that_no_file_can_hold_is_not_saved() {
        let folder = tempfile::tempdir().unwrap();
        let mut document = Document::first().unwrap();
        document.work.design.name = " ".to_owned();
        assert!(!document.update() && document.fault().is_some() && !document.shows_last_possible());
        let path = folder.path().join("mine.toml");
        assert!(
            document.to_save(0, path.clone()).unwrap_err().to_string().contains("printable")
                && !path.exists()
        );
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
        assert!(
            document.to_save(0, path.clone()).unwrap_err().to_string().contains(": Crown angle: ")
                && !path.exists()
        );
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
