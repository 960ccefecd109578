//! A design that was read, and the stone that was built from it.

use super::cut_file;
use super::design_file::{self, ImportedDesign};
use super::library::{self, CUTS, SCENES};
use super::mesh::MeshBody;
use super::mesh_options::MeshOptions;
use super::{is_standard, scene_file};
use brillianteer_base::{Failure, FileError, nearest};
use brillianteer_cut::from_mesh::FacetError;
use brillianteer_scene::Specimen;
use std::ops::Deref;
use std::path::Path;

/// Whether other options read a file in another way, as the remarks about it say.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OtherReadings {
    /// The path of the file.
    pub path: String,
    /// True for a mesh of several bodies, of which another may be chosen.
    pub of_bodies: bool,
    /// True for a mesh that may be read in another form or direction.
    pub of_shape: bool,
    /// True for a mesh whose facets may stay as they were found.
    pub of_symmetry: bool,
}

/// The end of the message about a scene where a design is expected.
const IS_SCENE: &str = "this is a scene, where the file or the name of a cut is expected";

/// A stone, the file that its design was read from, and the remarks about both.
#[derive(Debug)]
pub struct BuiltDesign {
    /// The path of the file, or the name of the cut.
    pub path: String,
    /// The stone, built from its design.
    pub made: Specimen,
    /// Notes and warnings, each with the path, as they are printed.
    pub remarks: Vec<String>,
    /// The first 256 bodies of a mesh that has several; empty for any other design.
    pub bodies: Vec<MeshBody>,
    /// True for a mesh that other options would read in another way, as its remarks say.
    pub has_other_reading: bool,
    /// True for a mesh that was given a symmetry, which another option leaves out.
    pub is_evened: bool,
    /// The standard errors of the facets of a scan; empty for other designs.
    pub errors: Vec<FacetError>,
}

impl Deref for BuiltDesign {
    type Target = Specimen;

    fn deref(&self) -> &Specimen {
        &self.made
    }
}

impl BuiltDesign {
    /// Reads a design, or takes a cut that comes with the program by its name, and builds the stone. A mesh is read
    /// with the options `mesh`. Where a file and a cut have the same name, the file is taken.
    ///
    /// # Errors
    /// Fails where the file cannot be read, is no design, or makes no stone.
    pub fn load(file: &Path, mesh: &MeshOptions) -> Result<Self, Failure> {
        let name = file.display().to_string();
        match library::cut(&name).filter(|_| !file.is_file()) {
            Some(text) => Self::parse(&name, text),
            None if !file.exists() && library::scene(&name).is_some() => {
                Err(Failure::Input(format!("{name}: {IS_SCENE}")))
            }
            None => Self::read(file, mesh),
        }
    }

    /// Reads a design from a file. A mesh is read with the options `mesh`.
    ///
    /// # Errors
    /// Fails where [`load`](Self::load) does.
    pub fn read(file: &Path, mesh: &MeshOptions) -> Result<Self, Failure> {
        let refused = |e: FileError| Failure::Input(format!("{e}{}", hint(file)));
        Self::of(file.display().to_string(), design_file::read_with(file, mesh).map_err(refused)?)
    }

    /// Builds a stone from the text of a cut file. Error messages call the file `path`.
    ///
    /// # Errors
    /// Fails where the text is no design, or makes no stone.
    pub fn parse(path: &str, text: &str) -> Result<Self, Failure> {
        let design = cut_file::parse(text, path)?;
        Self::of(path.to_owned(), ImportedDesign::of(design))
    }

    /// Returns whether other options read the file in another way.
    pub fn other_readings(&self) -> OtherReadings {
        let of_bodies = MeshBody::leave_a_choice(&self.bodies);
        let (of_shape, of_symmetry) = (self.has_other_reading, self.is_evened);
        OtherReadings { path: self.path.clone(), of_bodies, of_shape, of_symmetry }
    }

    fn of(path: String, imported: ImportedDesign) -> Result<Self, Failure> {
        let ImportedDesign { design, notes, warnings, bodies, has_other_reading, is_evened, errors, .. } =
            imported;
        let made = Specimen::new(design).map_err(|e| Failure::Input(format!("{path}: {e}")))?;
        let notes = notes.iter().map(|note| format!("note: {path}: {note}"));
        let unusual = made.unusual.iter().map(ToString::to_string);
        let warnings = warnings.into_iter().chain(unusual).chain(made.warnings.iter().cloned());
        let remarks = notes.chain(warnings.map(|w| format!("warning: {path}: {w}"))).collect();
        Ok(Self { path, made, remarks, bodies, has_other_reading, is_evened, errors })
    }
}

/// Returns whether a path means a scene: a scene file, or the name of a scene that comes with the program.
pub fn is_scene(file: &Path) -> bool {
    if file.is_file() || is_standard(file) {
        scene_file::is_scene(file)
    } else {
        library::scene(&file.to_string_lossy()).is_some()
    }
}

/// Returns the end of an error message about a file that cannot be read as a design: that it is a scene, or the most similar
/// name of a cut or a scene that comes with the program. Empty where neither applies.
pub fn hint(file: &Path) -> String {
    if is_scene(file) {
        return format!("; {IS_SCENE}");
    }
    let asked = file.file_name().unwrap_or_default().to_string_lossy().to_lowercase();
    let known: Vec<&str> = CUTS.iter().chain(&SCENES).map(|(name, _)| *name).collect();
    match nearest(&asked, &known).filter(|_| !file.exists()) {
        Some(name) => {
            let kind = if library::cut(name).is_some() { "cut" } else { "scene" };
            format!("; did you mean the {kind} '{name}'?")
        }
        None => String::new(),
    }
}
