//! Reads and builds the stone that a command works on.

use super::console::say;
use super::names::hint;
use crate::cut::{MaterialError, MaterialRef, Size};
use crate::io::cut_file;
use crate::io::design_file::{self, ImportedDesign};
use crate::io::mesh_options::MeshOptions;
use crate::io::{Failure, FileError, is_standard, library};
use crate::optics::Material;
use crate::scene;
use std::collections::BTreeSet;
use std::ops::Deref;
use std::path::Path;
use std::sync::{Mutex, PoisonError};

/// A stone, and the file that it was read from.
#[derive(Debug)]
pub struct LoadedSpecimen {
    /// The path or name as given on the command line.
    pub path: String,
    /// The stone, built from its design.
    pub made: scene::Specimen,
}

impl Deref for LoadedSpecimen {
    type Target = scene::Specimen;

    fn deref(&self) -> &scene::Specimen {
        &self.made
    }
}

impl LoadedSpecimen {
    /// Reads a design, or takes a cut that comes with the program by its name, and builds the stone. Prints notes and
    /// warnings about it.
    pub fn load(file: &Path, mesh: MeshOptions) -> Result<Self, Failure> {
        let name = file.display().to_string();
        match library::cut(&name).filter(|_| !file.is_file()) {
            Some(text) => Self::parse(&name, text),
            None => Self::read(file, mesh),
        }
    }

    /// Reads a design from a file. A mesh is read with the options `mesh`.
    pub fn read(file: &Path, mesh: MeshOptions) -> Result<Self, Failure> {
        let refused = |e: FileError| Failure::Input(format!("{e}{}", hint(file)));
        Self::of(file.display().to_string(), design_file::read_with(file, mesh).map_err(refused)?)
    }

    /// Builds a stone from the text of a cut file. Error messages call the file `path`.
    pub fn parse(path: &str, text: &str) -> Result<Self, Failure> {
        let design = cut_file::parse(text, path)?;
        Self::of(path.to_owned(), ImportedDesign::of(design))
    }

    fn of(
        path: String,
        ImportedDesign { design, notes, warnings, .. }: ImportedDesign,
    ) -> Result<Self, Failure> {
        let refused = |e| Failure::Input(format!("{path}: {e}"));
        let made = scene::Specimen::new(design).map_err(refused)?;
        let specimen = Self { path, made };
        notes.iter().for_each(|note| say(&format!("note: {}: {note}", specimen.path)));
        warnings.iter().for_each(|w| specimen.say(w));
        specimen.unusual.iter().for_each(|w| specimen.say(&w.to_string()));
        specimen.warnings.iter().for_each(|w| specimen.say(w));
        Ok(specimen)
    }

    /// Returns the same stone with another material (a name or an index) and size, where they are given.
    pub fn made_of(self, material: Option<&str>, size: Option<Size>) -> Result<Self, Failure> {
        let Self { path, made } = self;
        let mut design = made.design.clone();
        let mut of = made.material.clone();
        if let Some(text) = material {
            (design.material, of) = asked_material(text)?;
        }
        if let Some(size) = size {
            let diameter = size.diameter_mm(made.solid().volume(), &of);
            design.diameter_mm = diameter.map_err(|e| Failure::Input(format!("{path}: size: {e}")))?;
        }
        let made = made.remade(design).map_err(|e| Failure::Input(format!("{path}: {e}")))?;
        Ok(Self { path, made })
    }

    /// Prints a warning about the stone.
    pub fn say(&self, what: &str) {
        say(&format!("warning: {}: {what}", self.path));
    }
}

/// Parses the value of `--material`: a material's name or a refractive index.
pub fn asked_material(text: &str) -> Result<(MaterialRef, Material), Failure> {
    let asked = text.parse().map_or_else(|_| MaterialRef::Name(text.to_owned()), MaterialRef::Index);
    let refused = |error: MaterialError| {
        Failure::Usage(format!("--material: {}", error.to_string().trim_start_matches("material: ")))
    };
    let material = asked.material().map_err(refused)?;
    Ok((asked, material))
}

/// Prints a note where the colour of a material is illustrative and not measured, once for each material in a run.
pub fn note_colour(material: &Material) {
    static SAID: Mutex<BTreeSet<String>> = Mutex::new(BTreeSet::new());
    let is_new = || SAID.lock().unwrap_or_else(PoisonError::into_inner).insert(material.name.clone());
    if material.colour_is_illustrative && is_new() {
        say(&format!(
            "note: the colour of {} is illustrative: chosen to look like the gem's, and not measured",
            material.name
        ));
    }
}

/// Returns a file's name without its ending, with which the names of its outputs begin; `stdin` for standard input.
pub fn stem(file: &Path) -> String {
    if is_standard(file) {
        return "stdin".into();
    }
    file.file_stem().map_or_else(|| "stone".into(), |s| s.to_string_lossy().into_owned())
}
