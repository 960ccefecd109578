//! Reads and builds the stone that a command works on.

use super::console::say;
use super::progress::while_reading;
use brillianteer_base::Failure;
use brillianteer_cut::from_mesh::FacetError;
use brillianteer_cut::{Cut, MaterialError, MaterialRef, Size};
use brillianteer_files::built_design::{BuiltDesign, OtherReadings};
use brillianteer_files::is_standard;
use brillianteer_files::mesh::MeshBody;
use brillianteer_files::mesh_options::MeshOptions;
use brillianteer_measure::MeasureName;
use brillianteer_optics::{Dispersion, Material};
use brillianteer_render::SweepKey;
use brillianteer_scene::Stone;
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
    pub made: brillianteer_scene::Specimen,
    /// The standard errors of the facets of a scan; empty for other designs.
    pub errors: Vec<FacetError>,
    /// The first 256 bodies of a mesh that has several; empty for any other design.
    pub bodies: Vec<MeshBody>,
    /// The notes and warnings on how the file was read.
    pub remarks: Vec<String>,
}

impl Deref for LoadedSpecimen {
    type Target = brillianteer_scene::Specimen;

    fn deref(&self) -> &brillianteer_scene::Specimen {
        &self.made
    }
}

impl LoadedSpecimen {
    /// Reads a design, or takes by its name a cut that comes with the program, and builds the stone. Prints notes and
    /// warnings about it.
    pub fn load(file: &Path, mesh: &MeshOptions) -> Result<Self, Failure> {
        let read = while_reading(file, || BuiltDesign::load(file, mesh))?;
        read.remarks.iter().for_each(|remark| say(remark));
        note_readings(&read.other_readings());
        let BuiltDesign { path, made, errors, bodies, remarks, .. } = read;
        Ok(Self { path, made, errors, bodies, remarks })
    }

    /// Returns the same stone with another material (a name or an index) and size, where one of them is `Some`.
    pub fn made_of(self, material: Option<&str>, size: Option<Size>) -> Result<Self, Failure> {
        let Self { path, made, errors, bodies, remarks } = self;
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
        Ok(Self { path, made, errors, bodies, remarks })
    }

    /// Returns the stone with its facets. `what` begins the message where there is none: what the command does of which
    /// stones.
    ///
    /// # Errors
    /// Fails with [`Failure::Input`] where the solid is no convex stone between planes.
    pub fn convex_stone(&self, what: &str) -> Result<&Stone, Failure> {
        let why = || self.why_not_convex().unwrap_or_default();
        self.stone().map_err(|_| Failure::Input(format!("{}: {what}, and {}", self.path, why())))
    }

    /// Prints a warning about the stone.
    pub fn say(&self, what: &str) {
        say(&format!("warning: {}: {what}", self.path));
    }
}

/// Prints which options read a file in another way, each of them once in a run, with the first file that it is of use for.
pub fn note_readings(other: &OtherReadings) {
    let OtherReadings { path, of_bodies, of_shape, of_symmetry } = other;
    static SAID: Mutex<BTreeSet<&str>> = Mutex::new(BTreeSet::new());
    let is_new = |what| SAID.lock().unwrap_or_else(PoisonError::into_inner).insert(what);
    for (applies, what) in [
        (*of_bodies, "--part NUMBER, --part NAME or --part all chooses what is read of it"),
        (*of_symmetry, "--as-found keeps the facets as found"),
        (*of_shape, "--as and --up choose how it is read"),
    ] {
        if applies && is_new(what) {
            say(&format!("note: {path}: {what}"));
        }
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

/// Prints a note for each key of a tier whose name several tiers of a design have: which of them the key means, and how the
/// others are called.
pub fn note_namesakes<'k>(path: &str, cut: &Cut, keys: impl IntoIterator<Item = &'k SweepKey>) {
    for key in keys {
        let (SweepKey::Tier(name) | SweepKey::Distance(name)) = key else { continue };
        let others = cut.namesakes(name);
        if !others.is_empty() {
            let (count, others) = (others.len() + 1, others.join(", "));
            say(&format!(
                "note: {path}: {count} tiers are called {name}; {key} is the first of them, and the others are {others}"
            ));
        }
    }
}

/// Prints a note where fire is measured for a material of which only one index is known; `where_to` says where to name another.
pub fn note_no_fire(material: &Material, measures: impl IntoIterator<Item = MeasureName>, where_to: &str) {
    if measures.into_iter().any(|name| lacks_fire(material, name)) {
        say(&format!("note: {}", no_fire(material, where_to)));
    }
}

/// Returns whether a measure is of colours and the material parts none, so that it is 0 whatever the cut.
pub fn lacks_fire(material: &Material, measure: MeasureName) -> bool {
    matches!(material.dispersion, Dispersion::Constant(_))
        && matches!(measure, MeasureName::Fire | MeasureName::FireSeen)
}

/// Says that a material has no fire, and how to give the stone dispersion.
pub fn no_fire(material: &Material, where_to: &str) -> String {
    format!(
        "{} has one index for all colours, so that it has no fire; name a material with dispersion, such as quartz, {where_to} \
         (brillianteer materials lists them)",
        material.name
    )
}

/// Formats a weight; without one, says why it is not known and what to give.
pub fn weight(carats: Option<f64>, material: &str) -> String {
    match carats {
        Some(carats) => format!("{carats:.3} ct"),
        None => format!(
            "not known: no density is known of {material}; name a material by --material, such as quartz"
        ),
    }
}

/// Returns a file's name without its ending, with which the names of its outputs begin; `stdin` for standard input.
pub fn stem(file: &Path) -> String {
    if is_standard(file) {
        return "stdin".into();
    }
    file.file_stem().map_or_else(|| "stone".into(), |s| s.to_string_lossy().into_owned())
}
