//! Scenes as TOML, format 1: stones of several cuts, materials and sizes, and how they lie.
//!
//! Lengths are in mm, angles in degrees. Every error names file, line and key, and says what was expected.

use super::background::BackgroundRef;
use super::cut_file::check_format;
use super::fault::Fault;
use super::text::{self, TextError};
use crate::cut::{MaterialRef, Size};
use crate::scene::{LIGHTS, Layout, light};
use form::{SceneForm, Surroundings};
use glam::{DQuat, DVec3};
use serde::Deserialize;
use std::path::{Path, PathBuf};
use toml::de::{DeTable, Deserializer};

mod form;
mod written;

#[cfg(test)]
mod tests;

/// The largest file taken, bytes.
const MAX_BYTES: u64 = 4 << 20;

/// The most stones that a scene may have.
pub const MOST_STONES: usize = 256;

/// The gap between girdles where a scene gives none, mm.
pub const DEFAULT_GAP_MM: f64 = 0.5;

/// What a scene file says.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneFile {
    /// What it is called, printable.
    pub name: String,
    /// The name of a light that comes with the program, or the path of a light file, the scene's folder included.
    pub light: Option<PathBuf>,
    /// How its stones are laid out; `None` where each says where it is.
    pub layout: Option<Layout>,
    /// Least distance between two stones of a layout, seen from the table, mm.
    pub gap_mm: f64,
    /// What lies behind them.
    pub background: Option<BackgroundRef>,
    /// How far behind the middle of all stones a pattern or photograph lies, mm, from 0.
    pub background_distance_mm: Option<f64>,
    /// How much of the way that refraction turns light is followed, 0 to 1; 1 is physics.
    pub strength: f64,
    /// At least one; with their counts at most [`MOST_STONES`].
    pub stones: Vec<Entry>,
}

/// Stones of one kind.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// A cut that comes with the program, or the path of a cut file from the scene's folder.
    pub cut: String,
    /// Its material, checked; `None` for the cut file's.
    pub material: Option<MaterialRef>,
    /// Its size; `None` for the cut file's.
    pub size: Option<Size>,
    /// How many, at least 1.
    pub count: usize,
    /// By how much it is turned about its own axis, degrees.
    pub turn: f64,
    /// By how much its table leans toward `azimuth`, degrees.
    pub tilt: f64,
    /// Degrees from +x toward +y.
    pub azimuth: f64,
    /// Where the middle of its girdle is, mm; of no effect in a layout.
    pub at_mm: DVec3,
    /// The line of the file where it begins, from 1.
    pub line: usize,
}

impl SceneFile {
    /// Its stones one by one: each by the place of its entry, and how it is turned.
    pub fn turns(&self) -> Vec<(usize, DQuat)> {
        let counted = self
            .stones
            .iter()
            .enumerate()
            .flat_map(|(k, entry)| std::iter::repeat_n((k, entry), entry.count));
        let more = |number| self.layout.map_or(0.0, |layout| layout.turn(number));
        counted.enumerate().map(|(number, (k, entry))| (k, entry.turned(more(number)))).collect()
    }

    /// Where its stones are, mm, each of which a circle of such a radius around its axis holds, seen from above.
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
    /// A cut as its file says, turned so and put there, mm.
    pub fn placed(cut: &str, turned: DQuat, at_mm: DVec3) -> Self {
        let axis = turned * DVec3::Z;
        let leaning = Self {
            cut: cut.to_owned(),
            material: None,
            size: None,
            count: 1,
            turn: 0.0,
            tilt: axis.truncate().length().atan2(axis.z).to_degrees(),
            azimuth: axis.y.atan2(axis.x).to_degrees(),
            at_mm,
            line: 0,
        };
        // What is left is about its axis.
        let about = leaning.turned(0.0).inverse() * turned;
        Self { turn: 2.0 * about.z.atan2(about.w).to_degrees(), ..leaning }
    }

    /// The world's frame from the cut's: turned about its axis, by some degrees more than it says, then leaning toward its
    /// azimuth.
    pub fn turned(&self, more: f64) -> DQuat {
        let azimuth = self.azimuth.to_radians();
        let axis = DVec3::new(-azimuth.sin(), azimuth.cos(), 0.0);
        let turn = DQuat::from_rotation_z((self.turn + more).to_radians());
        DQuat::from_axis_angle(axis, self.tilt.to_radians()) * turn
    }
}

/// Reads a scene.
///
/// # Errors
/// Text that names the file and, where it is known, the line and key, and says what was expected.
pub fn read(path: &Path) -> Result<SceneFile, String> {
    let label = path.display().to_string();
    let folder = path.parent().unwrap_or(Path::new(""));
    match text::read(path, MAX_BYTES) {
        Ok(text) => parse(&text, &label, Some(folder)),
        Err(TextError { line: Some(line), message }) => Err(format!("{label}:{line}: {message}")),
        Err(TextError { line: None, message }) => Err(format!("{label}: {message}")),
    }
}

/// Reads a scene from its text; `label` stands for its path in errors, `folder` is where its files are.
///
/// # Errors
/// As [`read`].
pub fn parse(text: &str, label: &str, folder: Option<&Path>) -> Result<SceneFile, String> {
    scene(text, folder).map_err(|fault| {
        let line = fault.line(text).map_or(String::new(), |line| format!(":{line}"));
        format!("{label}{line}: {}", fault.message)
    })
}

/// The text of a scene file that reads back as the same scene, from the same folder; colours behind it to 8 bits.
///
/// A scene that [`parse`] refuses is written too, but not read back.
pub fn write(scene: &SceneFile) -> String {
    // TOML lacks a form only for maps without text keys and integers beyond 64 bits, and here are neither.
    toml::to_string(&written::EncodedScene::of(scene))
        .expect("a scene's form is text, numbers, lists and tables")
}

/// Whether a file is meant as a scene: it has a key that cut files lack. `false` for what cannot be read.
pub fn is_scene(path: &Path) -> bool {
    text::read(path, MAX_BYTES).is_ok_and(|text| is_meant_as_scene(&text))
}

fn is_meant_as_scene(text: &str) -> bool {
    const KEYS: [&str; 4] = ["stone", "layout", "light", "gap_mm"];
    match DeTable::parse(text) {
        Ok(table) => KEYS.iter().any(|&key| table.get_ref().contains_key(key)),
        Err(_) => text.lines().any(|line| line.trim_start().starts_with("[[stone]]")),
    }
}

fn scene(text: &str, folder: Option<&Path>) -> Result<SceneFile, Fault> {
    if text.len() as u64 > MAX_BYTES {
        return Err(Fault::whole(text::too_large(MAX_BYTES)));
    }
    let table = DeTable::parse(text).map_err(|error| Fault::syntax(text, &error))?;
    check_format(table.get_ref())?;
    let form = SceneForm::deserialize(Deserializer::from(table)).map_err(Fault::form)?;
    let line = |number| Fault::at(format!("stone/{number}"), "").line(text).unwrap_or(1);
    let behind = |given: &str| behind(given, folder);
    form.scene(&Surroundings { light: &|given| found(given, folder), background: &behind, line: &line })
}

/// What lies behind, a file from the scene's folder.
fn behind(given: &str, folder: Option<&Path>) -> Result<BackgroundRef, Fault> {
    BackgroundRef::read(given, folder.unwrap_or(Path::new("")))
        .map_err(|error| Fault::at("background", format!("background: {error}")))
}

/// A light by its name, or its file.
fn found(given: &str, folder: Option<&Path>) -> Result<PathBuf, Fault> {
    if light(given).is_some() {
        return Ok(given.into());
    }
    if let Some(path) = folder.map(|folder| folder.join(given)).filter(|path| path.is_file()) {
        return Ok(path);
    }
    let what = "is no light of the program's and no file beside this one";
    Err(Fault::at("light", format!("light: '{}' {what}{}", shown(given), likely(given, &LIGHTS))))
}

/// A name among some that is most like one asked for, and all of them.
fn likely(asked: &str, known: &[&str]) -> String {
    let slips = |name: &&&str| strsim::damerau_levenshtein(asked, name);
    let near = known.iter().min_by_key(slips).filter(|name| slips(name) <= 2);
    let meant = near.map_or(String::new(), |name| format!("; did you mean '{name}'?"));
    format!("{meant}; known: {}", known.join(", "))
}

/// As much of a text as a person reads.
fn shown(text: &str) -> String {
    text.chars().take(80).collect()
}
