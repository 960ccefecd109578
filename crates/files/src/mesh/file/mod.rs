//! Reads mesh files: glTF, OBJ, STL and PLY, each by its crate into one [`Surface`] of triangles.
//!
//! The content of a file decides its format, not the ending of its name. Unusual content gives a warning; unreadable
//! content gives an error that names the file, the place and what was expected. Only the file itself and buffers that
//! lie beside it are read.

mod gltf_file;
mod hint;
mod limits;
mod lines;
mod number;
mod obj_file;
mod parsed_mesh;
mod ply_file;
mod ply_header;
mod ply_rows;
mod polygons;
mod sniff;
mod statement;
mod stl_file;

#[cfg(test)]
mod tests;

use crate::encoding::{decoded, in_utf8};
use crate::foreign;
use brillianteer_base::{Fault, FileError};
use brillianteer_math::Surface;
use glam::DVec3;
use std::path::Path;

pub use hint::MaterialHint;
pub use limits::MAX_BYTES;
use parsed_mesh::ParsedMesh;
pub(super) use sniff::STL_HEADER;
use sniff::by_name;
pub use sniff::{MeshFormat, looks_like};
pub use statement::{Stands, Statement};

/// The message about a file that is none of the formats.
const NO_MESH: &str = "this is not a mesh; glTF, OBJ, STL or PLY is expected";

/// The content of a mesh file as it is written: not yet welded, in the file's unit and frame.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshFile {
    /// The format of the file.
    pub format: MeshFormat,
    /// All triangles. The surface's groups are the file's meshes, objects or groups, with their names.
    pub surface: Surface,
    /// The normals of the surface's corners, of any length, 0 where the file gives none; empty where it gives none at
    /// all. The normals of OBJ are read only for opaque bodies.
    pub normals: Vec<DVec3>,
    /// The material that the file states.
    pub hint: Option<MaterialHint>,
    /// The statement about the stone, where this program wrote the file.
    pub statement: Option<Statement>,
    /// Notes on what of the file was read, where it has more.
    pub notes: Vec<String>,
    /// Warnings about unusual content of the file.
    pub warnings: Vec<String>,
    /// The name that the file gives itself, or else the file's own name without its ending.
    pub name: String,
}

/// Reads the content of a mesh file; `label` stands for its path in errors, and `folder` is where its buffers lie, if it may
/// have any.
///
/// # Errors
/// Fails where the content is no mesh that can be read; the error has the place.
pub fn parse(bytes: Vec<u8>, label: &str, folder: Option<&Path>) -> Result<MeshFile, FileError> {
    parse_by(bytes, label, folder, obj_file::read)
}

/// Reads the content of a mesh file as [`parse`] does, with the normals of corners: corners of an OBJ that have several
/// normals are doubled.
///
/// # Errors
/// Fails where [`parse`] does; normals that cannot be read are left out.
pub fn parse_shaded(bytes: Vec<u8>, label: &str, folder: Option<&Path>) -> Result<MeshFile, FileError> {
    parse_by(bytes, label, folder, obj_file::read_shaded)
}

fn parse_by(
    bytes: Vec<u8>,
    label: &str,
    folder: Option<&Path>,
    read_obj: fn(&[u8]) -> Result<ParsedMesh, Fault>,
) -> Result<MeshFile, FileError> {
    if bytes.is_empty() {
        return Err(FileError::new(label, "the file is empty"));
    }
    let named = || match foreign::refusal(&bytes) {
        Some(message) => Err(message),
        None => by_name(&bytes, Path::new(label)).ok_or_else(|| NO_MESH.to_owned()),
    };
    let format =
        looks_like(&bytes).map_or_else(named, Ok).map_err(|message| FileError::new(label, message))?;
    let read = match format {
        MeshFormat::Glb => gltf_file::read(&bytes, folder),
        MeshFormat::Gltf => gltf_file::read(&in_utf8(&bytes), folder),
        MeshFormat::Obj => read_obj(decoded(&bytes, None).text.as_bytes()),
        MeshFormat::StlBinary => stl_file::read_binary(bytes),
        MeshFormat::StlText => stl_file::read_text(decoded(&bytes, None).text.as_bytes()),
        MeshFormat::Ply => ply_file::read(&in_utf8(&bytes)),
    };
    let ParsedMesh { surface, normals, hint, notes, mut warnings, name, said } =
        read.and_then(limits::checked).map_err(|fault| fault.in_file(label))?;
    let stem = Path::new(label).file_stem().map(|stem| stem.to_string_lossy().into_owned());
    let printable = |name: &String| brillianteer_cut::is_printable(name);
    let name = name.filter(printable).or(stem.filter(printable)).unwrap_or_else(|| "mesh".to_owned());
    let statement = said.and_then(|said| match Statement::parse(&said) {
        Ok(statement) => Some(statement),
        Err(why) => {
            warnings.push(format!(
                "its statement of the stone's size and upward direction cannot be read: {why}"
            ));
            None
        }
    });
    Ok(MeshFile { format, surface, normals, hint, statement, notes, warnings, name })
}
