//! Writes the bodies of a scene, its stones and its metal where they lie, as one mesh.

use super::WriteError;
use super::assembly::Assembly;
use super::design_file::{DesignFormat, EncodedDesign};
use super::mesh::{FINENESS, write_scene_glb, write_scene_obj, write_scene_ply, write_scene_stl};
use super::write as write_whole;
use brillianteer_base::Failure;
use brillianteer_math::at_most;
use brillianteer_scene::{Body, Scene};
use std::path::Path;

/// The most triangles of a scene that is written: as many as a mesh that is read may have.
const MOST_TRIANGLES: usize = 4_000_000;

/// Encodes the bodies of a scene as a mesh: OBJ, STL and PLY in mm with z up, binary glTF in metres with y up.
///
/// # Errors
/// Fails with [`Failure::Usage`] for a format of designs, [`Failure::Output`] where the scene has too many triangles.
pub fn written(assembly: &Assembly, format: DesignFormat) -> Result<EncodedDesign, Failure> {
    let Assembly { path, name, scene, .. } = assembly;
    if format.holds_designs() {
        return Err(Failure::Usage(format!(
            "{path}: this is a scene, which is converted to .glb, .obj, .ply or .stl only, not to .{}",
            format.ending()
        )));
    }
    if triangles(scene) > MOST_TRIANGLES {
        return Err(Failure::Output(format!(
            "{path}: the bodies have more than {} million triangles, too many for one file; write fewer of them",
            MOST_TRIANGLES / 1_000_000
        )));
    }
    let refused = |error: &dyn std::fmt::Display| Failure::Output(format!("{path}: {error}"));
    let bytes = match format {
        DesignFormat::Obj => write_scene_obj(scene).into_bytes(),
        DesignFormat::Stl => write_scene_stl(scene).map_err(|error| refused(&error))?,
        DesignFormat::Ply => write_scene_ply(scene).map_err(|error| refused(&error))?,
        _ => write_scene_glb(scene, name).map_err(|error| refused(&error))?,
    };
    Ok(EncodedDesign { bytes, lost: lost(scene, format) })
}

/// Writes the bodies of a scene as a mesh, whole or not at all, and returns in words what the format cannot hold.
///
/// # Errors
/// Fails where [`written`] does, or where the file cannot be written.
pub fn write(assembly: &Assembly, format: DesignFormat, path: &Path) -> Result<Vec<String>, Failure> {
    let written = written(assembly, format)?;
    write_whole(path, |file| file.write_all(&written.bytes).map_err(|e| WriteError::io(path, e)))?;
    Ok(written.lost)
}

/// Returns about how many triangles all bodies have; each of a stone's facets counts as many as it has corners.
fn triangles(scene: &Scene) -> usize {
    let of_stone = |body: &Body| match body {
        Body::Stone(stone) => stone.polytope.facets().iter().map(|facet| facet.outline.len()).sum(),
        Body::Mesh(shell) => shell.surface().triangles.len(),
        Body::Glass(smooth) => smooth.field().surface(FINENESS).triangles.len(),
    };
    let stones = scene.instances.iter().map(|stone| of_stone(&stone.body));
    stones.chain(scene.metals.iter().map(|metal| metal.mesh.surface().corners.len())).sum()
}

/// Returns what a mesh of this format keeps of a scene, and what it cannot hold.
fn lost(scene: &Scene, format: DesignFormat) -> Vec<String> {
    let kept = match format {
        DesignFormat::Obj => "where its bodies lie, each as an object, and the names of their materials",
        DesignFormat::Glb => {
            "its bodies, each as a node in its place, and their materials in red, green and blue"
        }
        _ => "where its bodies lie, joined without their names and materials",
    };
    let mut lost = vec![format!("only this part of the scene is kept: {kept}")];
    let off = |body: &Body| match body {
        Body::Glass(smooth) => Some(smooth.field().deviation(FINENESS)),
        Body::Stone(_) | Body::Mesh(_) => None,
    };
    let off = scene.instances.iter().filter_map(|stone| Some(off(&stone.body)? * stone.pose.scale));
    if let Some(off) = off.reduce(f64::max) {
        let off = at_most(off * scene.unit_mm);
        lost.push(format!("smooth surfaces are written as triangles, {off} mm off them at most"));
    }
    if scene.is_frosted() {
        lost.push("a mesh has no place for frosted facets; they will be read as polished".to_owned());
    }
    lost
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assembly::Assembly;
    use crate::mesh::{MeshFile, parse};
    use crate::mesh_options::MeshOptions;
    use glam::DVec3;
    use serde_json::Value;

    fn assembly(name: &str) -> Assembly {
        Assembly::load(Path::new(name), None, None, &MeshOptions::default()).unwrap()
    }

    /// Returns a scene as it reads back, in mm with z up.
    fn back(assembly: &Assembly, format: DesignFormat) -> MeshFile {
        let bytes = written(assembly, format).unwrap().bytes;
        let mut file = parse(bytes, "scene.mesh", None).unwrap();
        if format == DesignFormat::Glb {
            file.surface.vertices.iter_mut().for_each(|v| *v = 1e3 * DVec3::new(v.x, -v.z, v.y));
        }
        file
    }

    const FORMATS: [DesignFormat; 4] =
        [DesignFormat::Obj, DesignFormat::Stl, DesignFormat::Ply, DesignFormat::Glb];

    #[test]
    fn all_bodies_of_a_scene_are_written_in_the_place_and_the_size_that_they_have() {
        for name in ["trilogy", "solitaire", "eternity", "subtle-pill"] {
            let assembly = assembly(name);
            let scene = &assembly.scene;
            let (low, high) = scene.bounds();
            for format in FORMATS {
                let file = back(&assembly, format);
                let (a, b) = file.surface.bounds();
                // Between two corners a triangle lies within a smooth surface, whose hull the bounds hold.
                let near =
                    if name == "subtle-pill" { 0.02 * (high - low).length() * scene.unit_mm } else { 1e-4 };
                assert!(a.distance(scene.unit_mm * low) < near, "{name} {format:?}: {a} {low}");
                assert!(b.distance(scene.unit_mm * high) < near, "{name} {format:?}: {b} {high}");
                let volume = |of: &dyn Fn(usize) -> [DVec3; 3], count: usize| -> f64 {
                    let cone = |t| {
                        let [a, b, c] = of(t);
                        a.dot(b.cross(c)) / 6.0
                    };
                    (0..count).map(cone).sum()
                };
                let found = volume(&|t| file.surface.corners(t), file.surface.triangles.len());
                let stones: f64 =
                    scene.instances.iter().map(|s| s.body.solid().volume() * s.pose.scale.powi(3)).sum();
                let metal: f64 =
                    scene.metals.iter().map(|m| m.mesh.surface().volume() * m.pose.scale.powi(3)).sum();
                let wanted = (stones + metal) * scene.unit_mm.powi(3);
                assert!((found / wanted - 1.0).abs() < 1e-2, "{name} {format:?}: {found} {wanted}");
            }
        }
    }

    #[test]
    fn a_gltf_of_a_ring_has_a_node_for_each_body_and_bodies_that_are_alike_share_their_mesh_and_material() {
        let assembly = assembly("halo-ring");
        let bytes = written(&assembly, DesignFormat::Glb).unwrap().bytes;
        let json: Value = serde_json::from_slice(&gltf::Glb::from_slice(&bytes).unwrap().json).unwrap();
        let list = |key: &str| json[key].as_array().unwrap().clone();
        let (stones, metals) = (assembly.scene.instances.len(), assembly.scene.metals.len());
        assert_eq!(list("nodes").len(), 1 + stones + metals);
        // The main stone, the small ones around it, and the metal.
        assert_eq!((stones > 3, list("meshes").len()), (true, 3));
        let metal = list("materials")
            .into_iter()
            .find(|material| material["pbrMetallicRoughness"]["metallicFactor"] == 1.0);
        let metal = metal.unwrap();
        assert_eq!(metal["name"], assembly.scene.metals[0].metal.name());
        assert_eq!(metal["pbrMetallicRoughness"]["roughnessFactor"], assembly.scene.metals[0].roughness);
        assert!(
            list("materials").iter().any(|material| material["extensions"]["KHR_materials_ior"].is_object())
        );
        let document = gltf::Gltf::from_slice_without_validation(&bytes).unwrap();
        assert_eq!(document.nodes().filter(|node| node.mesh().is_some()).count(), stones + metals);
    }

    #[test]
    fn the_bodies_of_an_obj_and_a_gltf_have_names() {
        let assembly = assembly("solitaire");
        for format in [DesignFormat::Obj, DesignFormat::Glb] {
            let names = back(&assembly, format).surface.names;
            assert!(names.iter().any(|name| name.starts_with("stone 1, ")), "{format:?}: {names:?}");
            assert!(names.iter().any(|name| name.starts_with("metal 1")), "{format:?}: {names:?}");
        }
    }

    #[test]
    fn a_scene_is_refused_by_formats_of_designs() {
        let error = written(&assembly("trilogy"), DesignFormat::Gem).unwrap_err().to_string();
        assert_eq!(
            error,
            "trilogy: this is a scene, which is converted to .glb, .obj, .ply or .stl only, not to .gem"
        );
    }
}
