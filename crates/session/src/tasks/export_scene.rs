//! Writes the stones and metal of renders as a scene file, with the cut files of its designs and the meshes of its
//! metal.

use crate::model::export::{ExportPlan, kinds};
use crate::studio::Shot;
use crate::studio::hung;
use brillianteer_base::Failure;
use brillianteer_files::mesh::write_shaded;
use brillianteer_files::scene_file::{self, DEFAULT_GAP_MM, Entry, MetalEntry, RingEntry, SceneFile};
use brillianteer_files::{WriteError, cut_file, write};
use brillianteer_scene::{
    BackgroundRef, Companion, Companions, Look, MetalInstance, Pose, Projection, RingPlan, Scene, Specimen,
};
use glam::DVec3;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The files of a scene: the scene file, the cut file of each design, and the meshes of its metal.
pub struct SceneOut {
    /// The path and the text of each file; the scene file is the first.
    files: Vec<(PathBuf, String)>,
}

impl SceneOut {
    /// Makes the scene that the renders of a plan show.
    pub fn of(plan: &ExportPlan) -> Self {
        let shot = &plan.shot;
        let paths = plan.scene_paths();
        let unit_mm = shot.specimen.unit_mm();
        let turned = Pose::turned(shot.view.turn);
        let poses: Vec<Pose> = shot.copies.iter().map(|pose| turned.after(pose)).collect();
        let companions = shot.companions.carried(&turned);
        let (low, high) = Scene::clone(&shot.scene()).moved(&turned).bounds();
        // A scene is viewed around its middle; a single stone at the origin is written without a shift.
        let is_alone = companions.is_empty() && matches!(poses[..], [alone] if alone.at == DVec3::ZERO);
        let middle = if is_alone { DVec3::ZERO } else { 0.5 * (low + high) };
        let kinds = kinds(&companions);
        let names: Vec<String> = paths.iter().map(|path| file_name(path)).collect();
        let meshes = plan.meshes();
        let (cuts, metals) = names[1..].split_at(1 + kinds.len());
        let at_mm = |pose: &Pose| (pose.at - middle) * unit_mm;
        let cut_of = |specimen: &Arc<Specimen>| {
            let kind = kinds.iter().position(|kind| Arc::ptr_eq(kind, specimen));
            kind.map_or(&*cuts[0], |kind| &*cuts[1 + kind])
        };
        // A ring places its own stones.
        let has_ring = plan.ring().is_some();
        let is_loose = |pose: &Pose| !has_ring || companions.seat_at(pose.at).is_none();
        let own = poses.iter().filter(|pose| is_loose(pose));
        let own = own.map(|pose| Entry::placed(&cuts[0], pose.turn, at_mm(pose)));
        let others = companions.stones.iter().filter(|stone| is_loose(&stone.pose));
        let others = others
            .map(|Companion { specimen, pose }| Entry::placed(cut_of(specimen), pose.turn, at_mm(pose)));
        let in_mm = |metal: &MetalInstance| {
            let pose = turned.after(&metal.pose);
            Pose { at: at_mm(&pose), scale: pose.scale * unit_mm, ..pose }
        };
        let placed = |(metal, name): (&&MetalInstance, &String)| {
            MetalEntry::placed(name, (metal.metal, metal.roughness), &in_mm(metal))
        };
        let is_picture = shot.look.background.as_ref().is_some_and(BackgroundRef::is_picture);
        let look = Look {
            light: plan.light.clone(),
            background_mm: is_picture.then(|| (hung(shot) + middle.z) * unit_mm),
            ..shot.look.clone()
        };
        let scene = SceneFile {
            name: shot.title.clone(),
            look,
            layout: None,
            gap_mm: DEFAULT_GAP_MM,
            movement: plan.movement,
            angle_of_view: angle_of_view(shot, corners(shot, &poses, &companions), middle),
            stones: own.chain(others).collect(),
            metals: meshes.iter().zip(metals).map(placed).collect(),
            ring: ring(plan, cut_of, in_mm),
        };
        let designs = std::iter::once(&shot.specimen).chain(kinds).map(|kind| cut_file::write(&kind.design));
        let surfaces = meshes.iter().map(|metal| write_shaded(metal.mesh.surface()));
        let texts = std::iter::once(scene_file::write(&scene)).chain(designs).chain(surfaces);
        Self { files: paths.into_iter().zip(texts).collect() }
    }

    /// Writes all files, each whole or not at all.
    pub fn write(&self) -> Result<(), Failure> {
        let (scene, text) = &self.files[0];
        // A scene that is larger than scene files allow is refused before any file is written.
        scene_file::parse(text, &scene.display().to_string(), scene.parent())?;
        // The scene file is written last, so that it never names a missing file.
        for (path, text) in self.files.iter().rev() {
            write(path, |file| file.write_all(text.as_bytes()).map_err(|e| WriteError::io(path, e)))?;
        }
        Ok(())
    }
}

/// Returns the entry of the ring that a plan describes by its numbers. `cut_of` returns the file of a stone's cut, and
/// `in_mm` the place of a body of metal.
fn ring<'a>(
    plan: &ExportPlan,
    cut_of: impl Fn(&Arc<Specimen>) -> &'a str,
    in_mm: impl Fn(&MetalInstance) -> Pose,
) -> Option<RingEntry> {
    let Shot { specimen, copies, companions, .. } = &plan.shot;
    let body = &companions.metals[plan.ring()?.metal];
    let RingPlan { ring, stone, small_stone } = companions.ring_plan(specimen, copies.first()?.at)?;
    let cuts = [stone, small_stone].map(|stone| stone.map(|stone| cut_of(&stone).to_owned()));
    Some(RingEntry::placed(ring, cuts, (body.metal, body.roughness), &in_mm(body)))
}

/// Returns the name of a file without its folder.
fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// Returns points between which all bodies of a scene lie.
fn corners(shot: &Shot, poses: &[Pose], companions: &Companions) -> impl Iterator<Item = DVec3> {
    let own = shot.specimen.solid().vertices();
    let copies = poses.iter().flat_map(move |pose| own.iter().map(move |&corner| pose.place(corner)));
    copies.chain(companions.vertices())
}

/// Returns the angle of view of a shot in perspective, in degrees, across the longer extent of all bodies seen face up.
fn angle_of_view(shot: &Shot, corners: impl Iterator<Item = DVec3>, middle: DVec3) -> Option<f64> {
    let Projection::Perspective { distance } = shot.view.projection else { return None };
    let reach = corners.map(|at| (at - middle).truncate().abs().max_element()).fold(0.0, f64::max);
    // The scene is moved so that its middle lies at the origin.
    let distance = (distance - middle.z).max(f64::MIN_POSITIVE);
    Some((2.0 * (reach / distance).atan()).to_degrees().clamp(1.0, 120.0))
}
