//! Writes the copies in renders as a scene file and its cut file.

use crate::app::model::export::ExportPlan;
use crate::app::studio::Shot;
use crate::app::studio::hung;
use crate::io::background::BackgroundRef;
use crate::io::scene_file::{self, DEFAULT_GAP_MM, Entry, SceneFile};
use crate::io::{Failure, WriteError, cut_file, write};
use crate::scene::{Pose, Projection, middle};
use glam::DVec3;
use std::path::PathBuf;

/// The text of a scene file and of the cut file of its stones.
pub struct SceneOut {
    paths: [PathBuf; 2],
    scene: String,
    cut: String,
}

impl SceneOut {
    /// Makes the scene that a plan's renders show.
    pub fn of(plan: &ExportPlan) -> Self {
        let shot = &plan.shot;
        let paths = plan.scene_paths();
        let cut = format!("{}-cut.toml", plan.stem);
        let design = &shot.specimen.design;
        let turned = Pose::turned(shot.view.turn);
        let poses: Vec<Pose> = shot.copies.iter().map(|pose| turned.after(pose)).collect();
        let unit_mm = 0.5 * design.diameter_mm;
        // Scenes are seen around their middle.
        let middle = middle(&poses, shot.specimen.solid().vertices());
        let is_picture = shot.behind.as_ref().is_some_and(BackgroundRef::is_picture);
        let scene = SceneFile {
            name: design.name.clone(),
            light: Some(plan.light.clone()),
            light_turn: shot.light_turn,
            light_upright: shot.light_upright,
            layout: None,
            gap_mm: DEFAULT_GAP_MM,
            background: shot.behind.clone(),
            background_distance_mm: is_picture.then(|| (hung(shot) + middle.z) * unit_mm),
            strength: shot.strength,
            angle_of_view: angle_of_view(shot, &poses, middle),
            exposure: shot.exposure,
            stones: poses
                .iter()
                .map(|pose| Entry::placed(&cut, pose.turn, (pose.at - middle) * unit_mm))
                .collect(),
            metals: vec![],
            ring: None,
        };
        Self { paths, scene: scene_file::write(&scene), cut: cut_file::write(design) }
    }

    /// Writes both files, each whole or not at all.
    pub fn write(&self) -> Result<(), Failure> {
        let [scene, cut] = &self.paths;
        let folder = scene.parent();
        // A scene that reaches farther than scenes may is refused before anything is written.
        scene_file::parse(&self.scene, &scene.display().to_string(), folder)?;
        for (path, text) in [(cut, &self.cut), (scene, &self.scene)] {
            write(path, |file| file.write_all(text.as_bytes()).map_err(|e| WriteError::io(path, e)))?;
        }
        Ok(())
    }
}

/// Returns the angle of view of a shot in perspective, in degrees, across the longer extent of the stones seen face up.
fn angle_of_view(shot: &Shot, poses: &[Pose], middle: DVec3) -> Option<f64> {
    let Projection::Perspective { distance } = shot.view.projection else { return None };
    let corners = shot.specimen.solid().vertices();
    let placed = poses.iter().flat_map(|pose| corners.iter().map(move |&corner| pose.place(corner) - middle));
    let reach = placed.map(|at| at.truncate().abs().max_element()).fold(0.0, f64::max);
    // The scene is moved so that its middle lies at the origin.
    let distance = (distance - middle.z).max(f64::MIN_POSITIVE);
    Some((2.0 * (reach / distance).atan()).to_degrees().clamp(1.0, 120.0))
}
