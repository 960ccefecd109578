//! Scenes that the editor can work on: copies of one design, their light, and what lies behind them.

use crate::cut::Design;
use crate::io::scene_file::{self, Entry, SceneFile};
use crate::io::{Failure, FileError, cut_file, design_file, library};
use crate::scene::{Copies, MOST_COPIES, Pose, Specimen, middle};
use glam::{DQuat, DVec3};
use std::fmt::Display;
use std::path::Path;

/// A scene of glass that comes with the program.
pub struct Known {
    /// The name by which [`Preset::of_library`] finds the scene.
    pub name: &'static str,
    /// The title in menus.
    pub title: &'static str,
    /// Whether the scene begins to move at once.
    pub moves: bool,
    /// The number of bands of wavelengths that the scene is seen in.
    wavelengths: u32,
}

/// All scenes of glass that come with the program, in menu order.
pub const PRESETS: [Known; 5] = [
    Known { name: "subtle-pill", title: "Subtle pill", moves: false, wavelengths: 8 },
    Known { name: "prism-rainbow", title: "Prism rainbow", moves: false, wavelengths: 16 },
    Known { name: "rotating-cube", title: "Rotating cube", moves: true, wavelengths: 16 },
    Known { name: "wavy-plate", title: "Wavy plate", moves: true, wavelengths: 16 },
    Known { name: "free-diamond", title: "Free diamond", moves: true, wavelengths: 16 },
];

/// A scene that the editor can work on.
#[derive(Debug, Clone)]
pub struct Preset {
    /// The design, with its material and size.
    pub design: Design,
    pub copies: Copies,
    /// The number of bands of wavelengths that the scene is seen in, if it is known.
    pub wavelengths: Option<u32>,
    /// The scene file, which holds the rest.
    pub scene: SceneFile,
}

impl Preset {
    /// Returns a scene that comes with the program.
    ///
    /// # Errors
    /// Fails where no scene of that name comes with the program, or where it is of several designs.
    pub fn of_library(name: &str) -> Result<Self, FileError> {
        let text = library::scene(name)
            .ok_or_else(|| FileError::new(name, "no scene of this name comes with the program"))?;
        let wavelengths = PRESETS.iter().find(|known| known.name == name).map(|known| known.wavelengths);
        Ok(Self { wavelengths, ..Self::new(scene_file::parse(text, name, None)?, name, None)? })
    }

    /// Reads a scene file.
    ///
    /// # Errors
    /// Fails where the file cannot be read, is no scene, or is one of several designs.
    pub fn read(path: &Path) -> Result<Self, FileError> {
        Self::new(scene_file::read(path)?, &path.display().to_string(), path.parent())
    }

    fn new(scene: SceneFile, label: &str, folder: Option<&Path>) -> Result<Self, FileError> {
        let has_metal = scene.ring.is_some() || !scene.metals.is_empty();
        let Some(first) = scene.stones.first().filter(|_| !has_metal) else {
            let problem = format!(
                "the editor opens only scenes without metal; draw this one by `brillianteer render {label}`"
            );
            return Err(FileError::new(label, problem));
        };
        let kind = |e: &Entry| (e.cut.clone(), e.material.clone(), e.size);
        let count: usize = scene.stones.iter().map(|e| e.count).sum();
        if scene.stones.iter().any(|e| kind(e) != kind(first)) || count > MOST_COPIES {
            let problem = format!(
                "the editor opens only scenes of up to {MOST_COPIES} stones that share one cut, material and size; \
                    draw this one by `brillianteer render {label}`"
            );
            return Err(FileError::new(label, problem));
        }
        let refused = |error: &dyn Display| FileError::new(label, error);
        let mut design = design(&first.cut, folder).map_err(|error| refused(&error))?;
        if let Some(material) = &first.material {
            design.material = material.clone();
        }
        let specimen = Specimen::new(design.clone()).map_err(|error| refused(&error))?;
        let corners = specimen.solid().vertices();
        if let Some(size) = first.size {
            let volume = specimen.solid().volume();
            let diameter = size.diameter_mm(volume, &specimen.material);
            design.diameter_mm = diameter.map_err(|error| refused(&format_args!("size: {error}")))?;
        }
        let poses = poses(&scene, corners, 0.5 * design.diameter_mm);
        Ok(Self { copies: Copies::at(poses, corners), design, scene, wavelengths: None })
    }
}

/// Reads a cut that lies beside the scene, or else one that comes with the program.
fn design(cut: &str, folder: Option<&Path>) -> Result<Design, Failure> {
    let beside = folder.map(|folder| folder.join(cut)).filter(|path| path.is_file());
    match (beside, library::cut(cut)) {
        (Some(path), _) => Ok(design_file::read(&path)?.design),
        (None, Some(text)) => Ok(cut_file::parse(text, cut)?),
        (None, None) => Err(Failure::Input(format!(
            "there is no file '{cut}', and no cut of that name comes with the program"
        ))),
    }
}

/// Returns the poses of the stones, in girdle radii around the middle of all.
fn poses(scene: &SceneFile, corners: &[DVec3], unit_mm: f64) -> Vec<Pose> {
    let turns: Vec<_> = scene.turns().into_iter().map(|(_, turn)| turn).collect();
    let across = |turn: &DQuat| corners.iter().map(|c| (*turn * *c).truncate().length()).fold(0.0, f64::max);
    let radii: Vec<f64> = turns.iter().map(|turn| across(turn) * unit_mm).collect();
    let places = scene.places_mm(&radii).into_iter().map(|at| at / unit_mm);
    let mut poses: Vec<Pose> =
        places.zip(turns).map(|(at, turn)| Pose { at, ..Pose::turned(turn) }).collect();
    let middle = middle(&poses, corners);
    poses.iter_mut().for_each(|pose| pose.at -= middle);
    poses
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_presets_are_as_their_files_say_and_no_copy_is_put_behind_another() {
        for Known { name, .. } in PRESETS {
            let preset = Preset::of_library(name).unwrap();
            let specimen = Specimen::new(preset.design.clone()).unwrap();
            let corners = specimen.solid().vertices();
            assert_eq!(preset.copies.poses(corners, None), preset.copies.poses, "{name}");
            assert_eq!(preset.copies.poses.len(), if name == "free-diamond" { 1 } else { 4 });
        }
        let pill = Preset::of_library("subtle-pill").unwrap();
        assert_eq!((pill.design.diameter_mm, pill.scene.strength), (40.0, 0.035));
        // Twenty millimetres are a radius.
        assert!((pill.copies.poses[0].at - DVec3::new(-0.25, 1.005, 0.0)).length() < 1e-9);
    }

    #[test]
    fn scenes_of_several_designs_are_refused_with_what_draws_them() {
        for name in ["trilogy", "ring", "parcel"] {
            let why = Preset::of_library(name).err().unwrap();
            assert!(why.to_string().contains("brillianteer render"), "{why}");
        }
    }
}
