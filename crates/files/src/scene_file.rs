//! Reads and writes scene files: TOML, format 1, with stones of several cuts, materials and sizes, and their places.
//!
//! Lengths are in mm, angles in degrees. Every error names file, line and key, and says what was expected.

use super::mesh_options::MeshPart;
use super::text;
use super::toml_format::check_format;
use super::toml_text::TomlText;
use brillianteer_base::{Fault, FileError};
use brillianteer_cut::{MaterialRef, Size};
use brillianteer_optics::Metal;
use brillianteer_scene::{BackgroundRef, LIGHTS, Layout, Look, MOST_STONES, Movement, Pose, light};
use form::{SceneForm, SceneNumbers};
use glam::{DQuat, DVec3};
pub use ring_entry::RingEntry;
use shared::{Angles, leaning, likely, shown};
use std::path::Path;
use toml::de::DeTable;

mod form;
mod metal_form;
mod numbers;
mod ring_entry;
mod ring_form;
mod shared;

#[cfg(test)]
mod tests;

/// The size of the largest file that is read, in bytes.
const MAX_BYTES: u64 = 4 << 20;

/// The gap between girdles where a scene gives none, in mm.
pub const DEFAULT_GAP_MM: f64 = 0.5;

/// The content of a scene file.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneFile {
    /// The scene's name, printable.
    pub name: String,
    /// What its pictures are made with; files that it names are named from the scene's folder.
    pub look: Look,
    /// The layout of the stones; `None` where each states its own place.
    pub layout: Option<Layout>,
    /// The least distance between two stones of a layout, seen from the table, in mm.
    pub gap_mm: f64,
    /// How plates move where time goes on.
    pub movement: Movement,
    /// The angle of view of a perspective, across the longer extent of the stones, in degrees; `None` for parallel rays.
    pub angle_of_view: Option<f64>,
    /// The kinds of stones; with their counts they are at most [`MOST_STONES`] stones. There are none only where there is metal or a ring.
    pub stones: Vec<Entry>,
    /// The bodies of metal.
    pub metals: Vec<MetalEntry>,
    /// The ring that the program makes.
    pub ring: Option<RingEntry>,
}

/// A body of metal in a scene file: its mesh, its metal, and its place.
#[derive(Debug, Clone, PartialEq)]
pub struct MetalEntry {
    /// The path of its mesh from the scene's folder.
    pub mesh: String,
    /// The metal.
    pub metal: Metal,
    /// The roughness of its surface, 0 to 1.
    pub roughness: f64,
    /// The length of the file's unit, in mm.
    pub scale: f64,
    /// The turn about its own z axis, in degrees.
    pub turn: f64,
    /// The angle by which its z axis leans toward `azimuth`, in degrees.
    pub tilt: f64,
    /// The direction in which it leans, in degrees from +x toward +y.
    pub azimuth: f64,
    /// The place of the file's origin, in mm; in a layout, from the middle of the layout.
    pub at_mm: DVec3,
    /// The line of the file where the entry begins, from 1.
    pub line: usize,
}

/// A kind of stone in a scene, and how often it stands there.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// A cut that comes with the program, or the path of a cut file from the scene's folder.
    pub cut: String,
    /// The body that is taken of a mesh that has several.
    pub part: MeshPart,
    /// The material, checked; `None` for the cut file's.
    pub material: Option<MaterialRef>,
    /// The size; `None` for the cut file's.
    pub size: Option<Size>,
    /// The number of stones of this kind, at least 1.
    pub count: usize,
    /// The turn about the stone's own axis, in degrees.
    pub turn: f64,
    /// The angle by which the stone's table leans toward `azimuth`, in degrees.
    pub tilt: f64,
    /// The direction in which the table leans, in degrees from +x toward +y.
    pub azimuth: f64,
    /// The middle of the stone's girdle, in mm; of no effect in a layout.
    pub at_mm: DVec3,
    /// The line of the file where the entry begins, from 1.
    pub line: usize,
}

impl SceneFile {
    /// Returns the stones one by one: the place of each one's entry in `stones`, and its rotation.
    pub fn turns(&self) -> Vec<(usize, DQuat)> {
        let counted = self
            .stones
            .iter()
            .enumerate()
            .flat_map(|(k, entry)| std::iter::repeat_n((k, entry), entry.count));
        let more = |number| self.layout.map_or(0.0, |layout| layout.turn(number));
        counted.enumerate().map(|(number, (k, entry))| (k, entry.turned(more(number)))).collect()
    }

    /// Returns the places of the stones, in mm. Seen from above, a circle around the axis of each, of its radius,
    /// holds the stone.
    pub fn places_mm(&self, radii_mm: &[f64]) -> Vec<DVec3> {
        match self.layout {
            Some(layout) => {
                layout.places(radii_mm, self.gap_mm).into_iter().map(|at| at.extend(0.0)).collect()
            }
            None => self.stones.iter().map(|entry| entry.at_mm).collect(),
        }
    }
}

impl Entry {
    /// Makes an entry of one stone: a cut as its file says, with this rotation, in this place, in mm.
    pub fn placed(cut: &str, turned: DQuat, at_mm: DVec3) -> Self {
        let Angles { turn, tilt, azimuth } = Angles::of(turned);
        let cut = cut.to_owned();
        let part = MeshPart::Found;
        Self { cut, part, material: None, size: None, count: 1, turn, tilt, azimuth, at_mm, line: 0 }
    }

    /// Returns the rotation from the cut's frame to the world's: first about the stone's axis, by `more` degrees beyond its
    /// own turn, then leaning toward its azimuth.
    pub fn turned(&self, more: f64) -> DQuat {
        leaning(self.turn + more, self.tilt, self.azimuth)
    }
}

impl MetalEntry {
    /// Makes an entry of a mesh that a pose carries from its file's unit to its place, in mm.
    pub fn placed(mesh: &str, (metal, roughness): (Metal, f64), pose: &Pose) -> Self {
        let Angles { turn, tilt, azimuth } = Angles::of(pose.turn);
        let (mesh, scale, at_mm) = (mesh.to_owned(), pose.scale, pose.at);
        Self { mesh, metal, roughness, scale, turn, tilt, azimuth, at_mm, line: 0 }
    }

    /// Returns the rotation from the mesh's frame to the world's.
    pub fn turned(&self) -> DQuat {
        leaning(self.turn, self.tilt, self.azimuth)
    }
}

/// Reads a scene file.
///
/// # Errors
/// Fails where the file cannot be read or is no scene; the error names path, line and key.
pub fn read(path: &Path) -> Result<SceneFile, FileError> {
    let scene = text::read(path, MAX_BYTES).and_then(|text| scene(&text, Some(folder_of(path))));
    scene.map_err(|fault| fault.in_file(path.display()))
}

/// Reads a file that may be a scene, once; `None` where it is none, as [`is_scene`] finds.
///
/// # Errors
/// Fails where the file is meant as a scene and is none; the error names path, line and key.
pub fn read_if_scene(path: &Path) -> Result<Option<SceneFile>, FileError> {
    let text = text::read(path, MAX_BYTES).ok().filter(|text| is_meant_as_scene(text));
    text.map(|text| parse(&text, &path.display().to_string(), Some(folder_of(path)))).transpose()
}

/// Returns the folder from which a scene file names other files.
fn folder_of(path: &Path) -> &Path {
    path.parent().unwrap_or(Path::new(""))
}

/// Reads a scene from the text of its file; `label` stands for its path in errors, `folder` is the folder of the
/// files that it names.
///
/// # Errors
/// Fails where [`read`] does.
pub fn parse(text: &str, label: &str, folder: Option<&Path>) -> Result<SceneFile, FileError> {
    scene(text, folder).map_err(|fault| fault.in_file(label))
}

/// Returns the text of a scene file that reads back as the same scene, from the same folder; colours behind it to 8 bits.
///
/// A scene that [`parse`] refuses is written too, but does not read back.
pub fn write(scene: &SceneFile) -> String {
    // TOML has no form for maps without text keys and for integers beyond 64 bits; a scene has neither.
    toml::to_string(&SceneForm::of(scene)).expect("a scene's form is text, numbers, lists and tables")
}

/// Returns whether a file is a scene: it has a key that cut files lack. A file that cannot be read is none.
pub fn is_scene(path: &Path) -> bool {
    text::read(path, MAX_BYTES).is_ok_and(|text| is_meant_as_scene(&text))
}

fn is_meant_as_scene(text: &str) -> bool {
    const KEYS: [&str; 6] = ["stone", "metal", "ring", "layout", "light", "gap_mm"];
    match DeTable::parse(text) {
        Ok(table) => KEYS.iter().any(|&key| table.get_ref().contains_key(key)),
        Err(_) => {
            let begins =
                |line: &str| ["[[stone]]", "[[metal]]", "[ring]"].iter().any(|key| line.starts_with(key));
            text.lines().map(str::trim_start).any(begins)
        }
    }
}

fn scene(text: &str, folder: Option<&Path>) -> Result<SceneFile, Fault> {
    text::check_size(text.len(), MAX_BYTES)?;
    let toml = TomlText::parse(text)?;
    check_format(&toml)?;
    let make = |form: SceneForm, numbers| form.scene(&numbers, text, folder);
    toml.read_beside(&SceneNumbers::keys(), SceneNumbers::take, make).map(|(scene, _)| scene)
}

/// Reads the name of a background; a file is sought from the scene's folder.
fn behind(given: &str, folder: Option<&Path>) -> Result<BackgroundRef, Fault> {
    BackgroundRef::read(given, folder.unwrap_or(Path::new("")))
        .map_err(|error| Fault::key("background", format!("background: {error}")))
}

/// Returns a light's name as it is, or else the path of its file beside the scene.
fn found(given: &str, folder: Option<&Path>) -> Result<String, Fault> {
    if light(given).is_some() {
        return Ok(given.to_owned());
    }
    if let Some(path) = folder.map(|folder| folder.join(given)).filter(|path| path.is_file()) {
        return Ok(path.to_string_lossy().into_owned());
    }
    let what = "is neither a light of the program nor a file beside this one";
    Err(Fault::key("light", format!("light: '{}' {what}{}", shown(given), likely(given, &LIGHTS))))
}
