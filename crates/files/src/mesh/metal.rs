//! Reads meshes of metal, which need not be closed: their triangles unchanged, with the normals of the file or
//! computed ones.

use super::file::{self, MeshFile, MeshFormat};
use crate::text;
use brillianteer_base::FileError;
use brillianteer_math::{ShadedMesh, ShadedSurface};
use glam::DVec3;
use std::fmt::Write;
use std::path::Path;

/// The angle between neighbouring triangles, in degrees, from which on an edge is sharp where a file gives no normals.
const CREASE_DEG: f64 = 40.0;

/// Reads the mesh of an opaque body from glTF, OBJ, STL or PLY, with warnings about the file. glTF's y, which is up, becomes z;
/// lengths keep the file's unit.
///
/// # Errors
/// Fails where the file holds no triangles that can be read; the error has its path and the place.
pub fn read_shaded(path: &Path) -> Result<(ShadedMesh, Vec<String>), FileError> {
    let label = path.display().to_string();
    let bytes = text::read_bytes(path, file::MAX_BYTES).map_err(|fault| fault.in_file(&label))?;
    let MeshFile { format, surface, normals, warnings, .. } =
        file::parse_shaded(bytes, &label, path.parent())?;
    let is_given = |&v: &u32| normals.get(v as usize).is_some_and(|n| n.is_finite() && *n != DVec3::ZERO);
    let mut made = if surface.triangles.iter().flatten().all(is_given) {
        ShadedSurface { points: surface.vertices, corners: surface.triangles, normals }
    } else {
        ShadedSurface::creased(&surface.vertices, &surface.triangles, CREASE_DEG.to_radians().cos())
    };
    if matches!(format, MeshFormat::Glb | MeshFormat::Gltf) {
        let upright = |v: &mut DVec3| *v = DVec3::new(v.x, -v.z, v.y);
        made.points.iter_mut().chain(&mut made.normals).for_each(upright);
    }
    let mesh = ShadedMesh::new(made).map_err(|error| FileError::new(&label, error))?;
    Ok((mesh, warnings))
}

/// Returns the text of an OBJ file of an opaque surface with its normals, which [`read_shaded`] reads as the same surface.
pub fn write_shaded(surface: &ShadedSurface) -> String {
    let ShadedSurface { points, corners, normals } = surface;
    let mut text =
        String::from("# A surface of metal; lengths are in the unit of the scene that names this file.\n");
    for (key, vectors) in [("v", points), ("vn", normals)] {
        for DVec3 { x, y, z } in vectors {
            let _ = writeln!(text, "{key} {x} {y} {z}");
        }
    }
    let has_normals = !normals.is_empty();
    for corners in corners {
        let [a, b, c] = corners.map(|corner| {
            let number = corner + 1;
            if has_normals { format!("{number}//{number}") } else { number.to_string() }
        });
        let _ = writeln!(text, "f {a} {b} {c}");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(name: &str, content: &str) -> Result<ShadedMesh, FileError> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(name);
        std::fs::write(&path, content).unwrap();
        read_shaded(&path).map(|(mesh, _)| mesh)
    }

    /// Two triangles that meet at the x axis, at a right angle.
    const ROOF: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";

    #[test]
    fn an_open_obj_is_read_with_its_own_normals_or_with_those_of_its_triangles() {
        let mesh = read("a.obj", &format!("{ROOF}f 1 2 3\nf 2 1 4\n")).unwrap();
        // At a right angle the edge is sharp: its points are doubled.
        assert_eq!((mesh.surface().points.len(), mesh.surface().corners.len()), (6, 2));
        assert!(mesh.normals(0, DVec3::ZERO).shading.distance(DVec3::Z) < 1e-12);
        let given = format!("{ROOF}vn 0 -0.6 0.8\nvn 0 0 3\nf 1//1 2//1 3//2\nf 2//1 1//1 4//1\n");
        let mesh = read("a.obj", &given).unwrap();
        assert!(mesh.normals(0, DVec3::ZERO).shading.distance(DVec3::new(0.0, -0.6, 0.8)) < 1e-12);
        assert!(mesh.normals(0, DVec3::Y).shading.distance(DVec3::Z) < 1e-12);
        assert_eq!(mesh.surface().points.len(), 4);
        // Normals that cannot be read are left out, and the triangles are not.
        let broken = format!("{ROOF}vn 0 x 0.8\nf 1//1 2//1 3//9\n");
        assert_eq!(read("a.obj", &broken).unwrap().surface().corners.len(), 1);
        let error = read("a.obj", &format!("{ROOF}f 1 2 9\n")).unwrap_err().to_string();
        assert!(error.contains("a.obj:5: the face refers to corner 9, and the file has 4"), "{error}");
    }

    #[test]
    fn a_surface_that_is_written_is_read_as_it_was() {
        let given = format!("{ROOF}vn 0 -0.6 0.8\nvn 0 0 1\nf 1//1 2//1 3//2\nf 2//1 1//1 4//1\n");
        let mesh = read("a.obj", &given).unwrap();
        let again = read("b.obj", &write_shaded(mesh.surface())).unwrap();
        let (before, after) = (mesh.surface(), again.surface());
        assert_eq!((&after.points, &after.corners), (&before.points, &before.corners));
        assert!(after.normals.iter().zip(&before.normals).all(|(a, b)| a.distance(*b) < 1e-15));
    }

    #[test]
    fn gltf_stands_upright_with_its_normals() {
        let floats = [0_f32, 0., 0., 1., 0., 0., 0., 1., 0., 0., 0.6, 0.8, 0., 0.6, 0.8, 0., 0.6, 0.8];
        let bytes: Vec<u8> = floats.iter().flat_map(|x| x.to_le_bytes()).collect();
        use base64::Engine as _;
        let data = base64::engine::general_purpose::STANDARD.encode(bytes);
        let gltf = format!(
            r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],
            "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"NORMAL":1}}}}]}}],
            "accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}},
            {{"bufferView":1,"componentType":5126,"count":3,"type":"VEC3"}}],
            "bufferViews":[{{"buffer":0,"byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":36}}],
            "buffers":[{{"byteLength":72,"uri":"data:application/octet-stream;base64,{data}"}}]}}"#
        );
        let mesh = read("a.gltf", &gltf).unwrap();
        assert_eq!(mesh.surface().points, [DVec3::ZERO, DVec3::X, DVec3::Z]);
        let normal = mesh.normals(0, DVec3::ZERO);
        assert!(normal.flat.distance(DVec3::NEG_Y) < 1e-12, "{normal:?}");
        assert!(normal.shading.distance(DVec3::new(0.0, -0.8, 0.6)) < 1e-6, "{normal:?}");
        let without = read("a.gltf", &gltf.replace(",\"NORMAL\":1", "")).unwrap();
        assert!(without.normals(0, DVec3::ZERO).shading.distance(DVec3::NEG_Y) < 1e-6);
    }
}
