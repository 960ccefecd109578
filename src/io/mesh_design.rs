//! Stones from meshes: the planes of one that is convex, the triangles of any other.

use super::cut_file::CutFileError;
use super::design_file::Brought;
use super::mesh_file::{self, MaterialHint, MeshFile, MeshFormat};
use crate::cut::from_mesh::{FromMesh, Pose, Up, from_mesh};
use crate::cut::{Cut, DEFAULT_DIAMETER_MM, Design, MAX_PLANES, MaterialRef, MeshShape, is_printable};
use crate::math::surface::{Faceted, Mending, Shape, facets};
use crate::math::{Shell, Surface};
use glam::{DQuat, DVec3};
use std::path::Path;
use std::sync::Arc;

/// The material that is taken where a file says nothing of one.
const USUAL: &str = "diamond";

/// Reads a mesh of any format, which lies in a file of this path; `up` is the direction of its table in the file's frame.
///
/// # Errors
/// What keeps it from being a stone, with path and place.
pub fn read(bytes: Vec<u8>, path: &Path, up: Up) -> Result<Brought, CutFileError> {
    let told = |e: mesh_file::MeshFileError| CutFileError {
        path: e.path,
        line: None,
        message: e.place.map_or_else(|| e.message.clone(), |place| format!("{place}: {}", e.message)),
    };
    let label = path.display().to_string();
    let MeshFile { format, surface, hint, mut warnings, name } =
        mesh_file::parse(bytes, &label, path.parent()).map_err(told)?;
    let fault = |message: String| CutFileError { path: label.clone(), line: None, message };
    let mended = surface.mend().map_err(|e| fault(e.to_string()))?;
    warnings.extend(told_of(&mended.mending));
    let name = Some(name).filter(|name| is_printable(name)).unwrap_or_else(|| "stone".to_owned());
    match facets(mended.surface) {
        Shape::Convex(found) if found.faces.len() <= MAX_PLANES => {
            planes(&found, up, name, hint, warnings).map_err(fault)
        }
        Shape::Convex(found) => triangles(found.surface, (up, format), name, hint, warnings).map_err(fault),
        Shape::Concave(surface) => triangles(surface, (up, format), name, hint, warnings).map_err(fault),
    }
}

fn planes(
    found: &Faceted,
    up: Up,
    name: String,
    hint: Option<MaterialHint>,
    mut warnings: Vec<String>,
) -> Result<Brought, String> {
    let FromMesh { facets, pose, deviation, .. } = from_mesh(found, up).map_err(|e| e.to_string())?;
    let count = facets.len();
    warnings.push(format!(
        "{count} facets were found; no corner lies farther from them than {deviation:.1e} girdle radii"
    ));
    let material = material(hint, pose.scale, &mut warnings);
    let design = design(name, material, Cut::Planes(facets));
    design.check().map_err(|e| e.to_string())?;
    Ok(Brought { design, warnings })
}

fn design(name: String, material: MaterialRef, cut: Cut) -> Design {
    Design { name, source: None, notes: None, material, diameter_mm: DEFAULT_DIAMETER_MM, cut }
}

fn triangles(
    surface: Surface,
    (up, format): (Up, MeshFormat),
    name: String,
    hint: Option<MaterialHint>,
    mut warnings: Vec<String>,
) -> Result<Brought, String> {
    let up = match up {
        Up::Given(up) => up.try_normalize().ok_or("the direction up points nowhere")?,
        // The standard of glTF has y up; the others say nothing, and stones are drawn with z up.
        Up::Found if matches!(format, MeshFormat::Glb | MeshFormat::Gltf) => DVec3::Y,
        Up::Found => DVec3::Z,
    };
    let turn = DQuat::from_rotation_arc(up, DVec3::Z);
    let shell = Shell::new(surface).map_err(|e| e.to_string())?.moved(1.0, turn, DVec3::ZERO);
    let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (low, high) = shell.vertices().iter().fold(start, |(low, high), v| (low.min(*v), high.max(*v)));
    let scale = 2.0 / (high - low).truncate().min_element();
    let shift = -0.5 * scale * (low + high);
    let pose = Pose { scale, turn, shift };
    warnings
        .push(format!("it is not convex, so it is traced as {} triangles", shell.surface().triangles.len()));
    let material = material(hint, pose.scale, &mut warnings);
    let shell = Arc::new(shell.moved(pose.scale, DQuat::IDENTITY, pose.shift));
    Ok(Brought { design: design(name, material, Cut::Mesh(MeshShape(shell))), warnings })
}

/// The material that a file asks for; `scale` is in girdle radii per unit of the file.
fn material(hint: Option<MaterialHint>, scale: f64, warnings: &mut Vec<String>) -> MaterialRef {
    let mm_per_unit = 0.5 * DEFAULT_DIAMETER_MM / scale;
    match hint.map(|hint| hint.material(mm_per_unit)).transpose() {
        Ok(Some(Some(material))) => return material,
        Ok(_) => warnings.push(format!("the file says of no material that it refracts; {USUAL} is taken")),
        Err(error) => warnings.push(format!("{error}; {USUAL} is taken")),
    }
    MaterialRef::Name(USUAL.to_owned())
}

/// What was mended of a mesh, where that is more than any file of triangles needs.
fn told_of(mending: &Mending) -> Vec<String> {
    let count = |count: usize, what: &str| (count > 0).then(|| format!("{count} {what}"));
    let crack = (mending.crack > 0.0)
        .then(|| format!("cracks of up to {:.1e} of its unit were closed", mending.crack));
    [
        count(mending.copies, "copies of triangles are left out"),
        count(mending.degenerate, "triangles without an area are left out"),
        count(mending.turned, "triangles that faced inward are turned"),
        count(mending.seams, "pieces were made of triangles whose edges had corners on them"),
        crack,
    ]
    .into_iter()
    .flatten()
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::{cut_file, library, write_obj, write_stl};
    use crate::math::Plane;
    use crate::scene::Specimen;

    /// Six digits of a cutter's file leave corners where facets nearly meet, and slivers of triangles beside them.
    #[test]
    fn facets_that_meet_but_for_the_last_digit_are_found() {
        let design = cut_file::parse(library::cut("tolkowsky").unwrap(), "t").unwrap();
        let rounded = |x: f64| (x * 1e6).round() / 1e6;
        let facets = design.facets().unwrap().into_iter().map(|(name, plane)| {
            (name, Plane::new(plane.normal.to_array().map(rounded).into(), rounded(plane.offset)))
        });
        let specimen = Specimen::new(Design { cut: Cut::Planes(facets.collect()), ..design }).unwrap();
        let count = specimen.stone().unwrap().polytope.facets().len();
        for bytes in
            [write_obj(&specimen.body, "t", 1.0).into_bytes(), write_stl(&specimen.body, 3.0).unwrap()]
        {
            let brought = read(bytes, Path::new("t"), Up::Found).unwrap();
            let Cut::Planes(planes) = &brought.design.cut else { panic!("concave") };
            assert_eq!(planes.len(), count);
            let again = Specimen::new(brought.design).unwrap().solid().volume();
            assert!((again - specimen.solid().volume()).abs() < 1e-4);
        }
    }
}
