//! Makes a scene of the bodies of a mesh, each where it lies in the file.

use super::design_file::ImportedDesign;
use super::mesh::{self, read_bodies, upward};
use super::mesh_options::{MeshOptions, MeshPart};
use super::scene_file::{self, DEFAULT_GAP_MM, Entry, SceneFile};
use super::text;
use brillianteer_base::FileError;
use brillianteer_cut::from_mesh::Up;
use brillianteer_cut::{MaterialRef, Size, is_printable};
use brillianteer_math::Pose;
use brillianteer_scene::{Look, MOST_STONES, Movement};
use glam::{DQuat, DVec3};
use std::path::Path;

/// A scene of the bodies of a mesh, and what is to be said of the file.
#[derive(Debug, Clone, PartialEq)]
pub struct BodiesScene {
    /// The scene: a stone for each body that lies inside no other.
    pub scene: SceneFile,
    /// Warnings about unusual content of the file.
    pub warnings: Vec<String>,
}

/// Makes a scene of the bodies of the mesh at `file`, to be written into `folder`. The file's direction up points up in the
/// scene, z; a direction and a unit that the options give count more than those of the file. Each body is read as a scene
/// reads it, so that other options have no effect. `material` is that of every stone; `None` for the file's.
///
/// # Errors
/// Fails where the file is no mesh, where a body makes no stone or none of a size that stones have, and where there are more
/// bodies than a scene may have stones.
pub fn scene_of_bodies(
    file: &Path,
    folder: &Path,
    options: &MeshOptions,
    material: Option<&MaterialRef>,
) -> Result<BodiesScene, FileError> {
    let label = file.display().to_string();
    let bytes = text::read_bytes(file, mesh::MAX_BYTES).map_err(|fault| fault.in_file(&label))?;
    let up = match options.up {
        Up::Given(up) => up.try_normalize().unwrap_or(DVec3::Z),
        _ => upward(&bytes),
    };
    let own = MeshOptions { unit: options.unit, ..MeshOptions::default() };
    let bodies = read_bodies(bytes, file, &own, MOST_STONES)?;
    let warnings = bodies.first().map(|(_, body)| body.warnings.clone()).unwrap_or_default();
    let mm = mm_per_unit(&bodies);
    let upright = DQuat::from_rotation_arc(up, DVec3::Z);
    let cut = path_from(folder, file);
    let entry = |(part, body): (MeshPart, ImportedDesign)| {
        let pose = body.pose.unwrap_or(Pose::STILL);
        let entry =
            Entry::placed(&cut, upright * pose.turn.inverse(), mm * (upright * pose.unplace(DVec3::ZERO)));
        let size = Some(Size::Millimetres(2.0 * mm / pose.scale));
        Entry { part, size, material: material.cloned(), ..entry }
    };
    let scene = placed(file, bodies.into_iter().map(entry).collect());
    // What a scene file may not hold is refused here, in the words of its reader.
    scene_file::parse(&scene_file::write(&scene), &label, Some(folder))?;
    Ok(BodiesScene { scene, warnings })
}

/// Returns how many mm a unit of the file is, by the largest of its bodies: a small one may have no plausible size.
fn mm_per_unit(bodies: &[(MeshPart, ImportedDesign)]) -> f64 {
    let across = |body: &ImportedDesign| body.pose.map_or(0.0, |pose| 2.0 / pose.scale);
    let largest = bodies.iter().map(|(_, body)| body).max_by(|a, b| across(a).total_cmp(&across(b)));
    largest.map_or(1.0, |body| body.design.diameter_mm / across(body))
}

fn placed(file: &Path, stones: Vec<Entry>) -> SceneFile {
    let stem = file.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    SceneFile {
        name: stem.filter(|name| is_printable(name)).unwrap_or_else(|| "bodies".to_owned()),
        look: Look::default(),
        layout: None,
        gap_mm: DEFAULT_GAP_MM,
        movement: Movement::default(),
        angle_of_view: None,
        stones,
        metals: vec![],
        ring: None,
    }
}

/// Returns the path of a file from a folder, or its whole path where it lies elsewhere.
fn path_from(folder: &Path, file: &Path) -> String {
    let whole = file.canonicalize().unwrap_or_else(|_| file.to_owned());
    let own = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let within = own.canonicalize().ok().and_then(|own| whole.strip_prefix(own).ok().map(Path::to_owned));
    within.unwrap_or(whole).to_string_lossy().replace('\\', "/")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assembly::Assembly;
    use crate::solids::{Triangles, extruded};
    use glam::DVec2;
    use std::f64::consts::TAU;

    /// Returns a prism of so many sides, turned and moved.
    fn prism(sides: u32, size: f64, turn: DQuat, at: DVec3) -> Triangles {
        let corner = |k: u32| size * DVec2::from_angle(0.1 + f64::from(k) * TAU / f64::from(sides));
        let (vertices, triangles) = extruded(&(0..sides).map(corner).collect::<Vec<_>>(), 0.8 * size);
        (vertices.into_iter().map(|v| turn * v + at).collect(), triangles)
    }

    fn obj(bodies: &[Triangles]) -> String {
        let (mut text, mut first) = (String::new(), 1);
        for (vertices, triangles) in bodies {
            text.extend(vertices.iter().map(|v| format!("v {} {} {}\n", v.x, v.y, v.z)));
            let face = |t: &[u32; 3]| format!("f {} {} {}\n", t[0] + first, t[1] + first, t[2] + first);
            text.extend(triangles.iter().map(face));
            first += vertices.len() as u32;
        }
        text
    }

    #[test]
    fn every_body_of_a_mesh_lies_in_the_scene_where_it_lies_in_the_file() {
        let lean = DQuat::from_euler(glam::EulerRot::XYZ, 0.3, -0.2, 0.7);
        let mut bodies = vec![
            prism(8, 2.0, DQuat::IDENTITY, DVec3::new(1.0, 2.0, 3.0)),
            prism(6, 1.0, lean, DVec3::new(-6.0, 0.5, 0.0)),
            prism(12, 1.5, DQuat::from_rotation_x(1.2), DVec3::new(3.0, -9.0, 1.0)),
        ];
        let folder = tempfile::tempdir().unwrap();
        let [file, path] = ["many.obj", "scene.toml"].map(|name| folder.path().join(name));
        // The fourth lies inside the first.
        let inner = prism(5, 0.2, DQuat::IDENTITY, DVec3::new(1.0, 2.0, 3.8));
        std::fs::write(&file, obj(&[bodies.clone(), vec![inner]].concat())).unwrap();
        let unit = "0.5mm".parse().unwrap();
        let options = MeshOptions { unit, up: Up::Given(DVec3::Y), ..MeshOptions::default() };
        let made = scene_of_bodies(&file, folder.path(), &options, None).unwrap();
        assert_eq!(made.scene.stones.len(), 3);
        assert_eq!(made.scene.stones[1].cut, "many.obj");
        std::fs::write(&path, scene_file::write(&made.scene)).unwrap();
        let scene = Assembly::load(&path, None, None, &MeshOptions::default()).unwrap().scene;
        let corners = |k: usize| -> Vec<DVec3> {
            let instance = &scene.instances[k];
            let own = instance.body.solid().vertices().to_vec();
            own.into_iter().map(|v| scene.unit_mm * instance.pose.place(v)).collect()
        };
        let turn = DQuat::from_rotation_arc(DVec3::Y, DVec3::Z);
        bodies.iter_mut().for_each(|(vertices, _)| vertices.iter_mut().for_each(|v| *v = 0.5 * (turn * *v)));
        let middle = |all: &mut dyn Iterator<Item = DVec3>| {
            let (low, high) = brillianteer_math::bounds(all);
            0.5 * (low + high)
        };
        // Pictures are centred, so that all may be shifted together.
        let shift = middle(&mut (0..3).flat_map(corners))
            - middle(&mut bodies.iter().flat_map(|(vertices, _)| vertices.iter().copied()));
        for (k, (vertices, _)) in bodies.iter().enumerate() {
            let found = corners(k);
            // The caps have corners in their middles, which are none of the solid.
            assert_eq!(found.len() + 2, vertices.len());
            for f in found {
                let near = vertices.iter().map(|v| f.distance(*v + shift)).fold(f64::INFINITY, f64::min);
                assert!(near < 1e-6, "{k}: {f} is {near} mm off");
            }
        }
    }

    #[test]
    fn a_scene_elsewhere_names_the_whole_path_of_its_mesh() {
        let folder = tempfile::tempdir().unwrap();
        let below = folder.path().join("below");
        std::fs::create_dir(&below).unwrap();
        let file = folder.path().join("many.obj");
        std::fs::write(&file, obj(&[prism(8, 2.0, DQuat::IDENTITY, DVec3::ZERO)])).unwrap();
        assert_eq!(path_from(folder.path(), &file), "many.obj");
        let whole = path_from(&below, &file);
        assert!(Path::new(&whole).is_absolute() && whole.ends_with("/many.obj"), "{whole}");
        let made = scene_of_bodies(&file, &below, &MeshOptions::default(), None).unwrap();
        assert_eq!((made.scene.stones.len(), made.scene.name.as_str()), (1, "many"));
        let error = scene_of_bodies(&below, &below, &MeshOptions::default(), None).unwrap_err().to_string();
        assert!(error.contains("this is a directory"), "{error}");
    }
}
