//! Reads and writes designs in all formats. The content of a file decides its format, and the ending of its name only
//! where the content does not.
//!
//! To add a format, write a file as `asc.rs` is, with `looks_like` for the first bytes, `read` to an
//! [`ImportedDesign`] (with warnings for what the program does not hold) and `write` to an [`EncodedDesign`] (with
//! what the format cannot hold). No input may panic. Add a variant of [`DesignFormat`] with its place in `ALL`, its
//! ending and its arms in `read_with` and `written`; then the endings in messages (`src/cli/convert.rs`,
//! `optimise.rs` and `retarget.rs` there, `crates/session/src/model/update/files.rs`), the readers of tests/library/fuzz.rs,
//! and docs/formats.md.

use super::cut_file;
use super::cutters::WarningList;
use super::mesh::{self, FINENESS, MaterialHint, Stated, stated_in_stl};
use super::mesh_options::MeshOptions;
use super::mesh_options::MeshUnit;
use super::{WriteError, text};
use super::{asc, foreign, gcs, gem, write as write_whole};
use super::{write_glb, write_obj, write_ply, write_stl};
use brillianteer_base::{Failure, Fault, FileError};
use brillianteer_cut::{DEFAULT_DIAMETER_MM, Design, MaterialRef};
use brillianteer_math::at_most;
use brillianteer_scene::{Body, Specimen};
use std::path::Path;

mod encoded;
mod imported;

pub use encoded::EncodedDesign;
pub use imported::ImportedDesign;

/// A format of design files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DesignFormat {
    /// Cut files of this program.
    Toml,
    /// GemCad's text files.
    Asc,
    /// GemCad's binary files.
    Gem,
    /// Gem Cut Studio's files.
    Gcs,
    /// Wavefront's meshes, facets as polygons.
    Obj,
    /// Binary STL meshes.
    Stl,
    /// PLY meshes.
    Ply,
    /// Binary glTF meshes.
    Glb,
}

impl DesignFormat {
    /// All formats.
    pub const ALL: [Self; 8] =
        [Self::Toml, Self::Asc, Self::Gem, Self::Gcs, Self::Obj, Self::Stl, Self::Ply, Self::Glb];

    /// Returns the ending of the format's files, without the dot.
    pub fn ending(self) -> &'static str {
        match self {
            Self::Toml => "toml",
            Self::Asc => "asc",
            Self::Gem => "gem",
            Self::Gcs => "gcs",
            Self::Obj => "obj",
            Self::Stl => "stl",
            Self::Ply => "ply",
            Self::Glb => "glb",
        }
    }

    /// Returns whether the format holds a whole design for further work, and not only the shape.
    pub fn holds_designs(self) -> bool {
        match self {
            Self::Toml | Self::Asc | Self::Gem | Self::Gcs => true,
            Self::Obj | Self::Stl | Self::Ply | Self::Glb => false,
        }
    }

    /// Returns the format that the ending of a file's name stands for.
    pub fn of_name(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_string_lossy().to_lowercase();
        Self::ALL.into_iter().find(|format| format.ending() == ending)
    }

    /// Returns the format of a file with these bytes and this name.
    ///
    /// # Errors
    /// Fails where the bytes are of a format that is not read.
    fn of(bytes: &[u8], path: &Path) -> Result<Self, Fault> {
        let known = [
            (Self::Gcs, gcs::looks_like as fn(&[u8]) -> bool),
            (Self::Gem, gem::looks_like),
            (Self::Asc, asc::looks_like),
        ];
        if let Some((format, _)) = known.into_iter().find(|(_, looks_like)| looks_like(bytes)) {
            return Ok(format);
        }
        if let Some(message) = foreign::refusal(bytes) {
            return Err(message.into());
        }
        // The reader of glTF reports the faults of such a file.
        let is_gltf = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("gltf"));
        match Self::of_name(path) {
            _ if is_gltf => Ok(Self::Glb),
            Some(format) => Ok(format),
            None if foreign::has_keys(bytes) => Ok(Self::Toml),
            None => Err(foreign::unknown().into()),
        }
    }
}

/// Reads a design, a mesh with the default options.
///
/// # Errors
/// Fails where the file is no design; the error has its path, and a line where there is one.
pub fn read(path: &Path) -> Result<ImportedDesign, FileError> {
    read_with(path, &MeshOptions::default())
}

/// Reads a design; the options apply to meshes alone.
///
/// # Errors
/// Fails where the file is no design; the error has its path, and a line where there is one.
pub fn read_with(path: &Path, options: &MeshOptions) -> Result<ImportedDesign, FileError> {
    let label = path.display().to_string();
    let named = |fault: Fault| fault.in_file(&label);
    let bytes = text::read_bytes(path, mesh::MAX_BYTES).map_err(named)?;
    if mesh::looks_like(&bytes).is_some() {
        return mesh::read(bytes, path, options);
    }
    let format = DesignFormat::of(&bytes, path).map_err(named)?;
    let mut brought = match format {
        DesignFormat::Asc => asc::read(&bytes, &label),
        DesignFormat::Gem => gem::read(&bytes, &label),
        DesignFormat::Gcs => gcs::read(&bytes, &label),
        DesignFormat::Obj | DesignFormat::Stl | DesignFormat::Ply | DesignFormat::Glb => {
            return mesh::read(bytes, path, options);
        }
        DesignFormat::Toml => text::utf8(bytes).and_then(|text| cut_file::design(&text)).map(with_warnings),
    }
    .map_err(named)?;
    let is_sized = format == DesignFormat::Toml || options.unit == MeshUnit::Unneeded;
    if !is_sized {
        brought.notes.push(format!(
            "the file states no size; the stone is taken to be {DEFAULT_DIAMETER_MM} mm across"
        ));
    }
    if options.is_given() {
        brought.notes.push("the options of meshes have no effect on this design".to_owned());
    }
    Ok(brought)
}

fn with_warnings((design, warnings): (Design, Vec<String>)) -> ImportedDesign {
    let mut list = WarningList::default();
    warnings.into_iter().for_each(|text| list.warn(|| text));
    ImportedDesign { warnings: list.texts(), ..ImportedDesign::of(design) }
}

/// Encodes a stone's design as a file.
///
/// # Errors
/// Fails with [`Failure::Input`] where the format takes convex stones alone and this is none, [`Failure::Output`]
/// where a mesh is too large for the format.
pub fn written(specimen: &Specimen, format: DesignFormat) -> Result<EncodedDesign, Failure> {
    let (name, radius_mm) = (specimen.design.name.as_str(), specimen.unit_mm());
    let material = &specimen.design.material;
    let refused = |error: &dyn std::fmt::Display| Failure::Output(format!("{}: {error}", format.ending()));
    if matches!(format, DesignFormat::Asc | DesignFormat::Gem | DesignFormat::Gcs)
        && specimen.stone().is_err()
    {
        let why = specimen.why_not_convex().unwrap_or_default();
        return Err(Failure::Input(format!(
            "{name}: .{} takes convex stones between planes, and {why}; write .toml, .obj, .stl, .ply or .glb",
            format.ending()
        )));
    }
    let mesh = match format {
        DesignFormat::Toml => {
            let bytes = cut_file::write(&specimen.design).into_bytes();
            if bytes.len() as u64 > cut_file::MAX_MESH_BYTES {
                return Err(refused(
                    &"this mesh is too large for a cut file; write it as .glb, .ply, .stl or .obj",
                ));
            }
            return Ok(EncodedDesign { bytes, lost: vec![] });
        }
        DesignFormat::Asc => return Ok(asc::write(specimen)),
        DesignFormat::Gem => return Ok(gem::write(specimen)),
        DesignFormat::Gcs => return Ok(gcs::write(specimen)),
        DesignFormat::Obj => write_obj(&specimen.body, name, radius_mm, Some(material)).into_bytes(),
        DesignFormat::Stl => write_stl(&specimen.body, radius_mm, Some(material)).map_err(|e| refused(&e))?,
        DesignFormat::Ply => write_ply(&specimen.body, radius_mm, Some(material)).map_err(|e| refused(&e))?,
        DesignFormat::Glb => {
            // The standard's unit is the metre.
            let (scale, hint) = (1e-3 * radius_mm, MaterialHint::of(&specimen.material, 1e3));
            write_glb(&specimen.body, name, scale, (&hint, Some(material))).map_err(|e| refused(&e))?
        }
    };
    Ok(as_mesh(specimen, format, mesh))
}

/// Wraps the bytes of a mesh, with messages about the properties that meshes cannot hold.
fn as_mesh(specimen: &Specimen, format: DesignFormat, bytes: Vec<u8>) -> EncodedDesign {
    let is_named = matches!(format, DesignFormat::Obj | DesignFormat::Glb);
    let shape = match &*specimen.body {
        Body::Mesh(_) | Body::Glass(_) => "its triangles",
        Body::Stone(_) if is_named => "its facets, their names",
        Body::Stone(_) => "its facets",
    };
    let material = match &specimen.design.material {
        MaterialRef::Name(_) => Some("the name of its material"),
        MaterialRef::Index(_) => Some("its refractive index"),
        MaterialRef::Custom(_) => None,
    };
    let stated = match format {
        DesignFormat::Stl => stated_in_stl(&bytes),
        _ => Stated { place: true, material: true },
    };
    let seen = (format == DesignFormat::Glb).then_some("the material in red, green and blue");
    let size = stated.place.then_some("its size");
    let kept: Vec<&str> =
        [Some(shape), size, material.filter(|_| stated.material), seen].into_iter().flatten().collect();
    let mut lost = vec![format!("only this part of the design is kept: {}", listed(&kept))];
    if !stated.place {
        lost.push("the file's header has no room for the stone's size and for the way it faces".to_owned());
    } else if let Some(material) = material.filter(|_| !stated.material) {
        lost.push(format!("the file's header has no room for {material}"));
    }
    let measured = "the proportions are not kept; they are measured anew when the mesh is read";
    lost.extend(specimen.design.cut.brilliant().map(|_| measured.to_owned()));
    if let Body::Glass(smooth) = &*specimen.body {
        let off = smooth.field().deviation(FINENESS) * specimen.unit_mm();
        lost.push(format!("its smooth surface is written as triangles, {} mm off it at most", at_most(off)));
    }
    if specimen.body.is_frosted() {
        lost.push("a mesh has no place for frosted facets; they will be read as polished".to_owned());
    }
    EncodedDesign { bytes, lost }
}

/// Joins words as in a sentence: `a, b and c`.
fn listed(words: &[&str]) -> String {
    match words {
        [rest @ .., last] if !rest.is_empty() => format!("{} and {last}", rest.join(", ")),
        _ => words.concat(),
    }
}

/// Writes a stone's design, whole or not at all, and returns in words the properties that the format cannot hold.
///
/// # Errors
/// Fails where the design cannot be encoded, as for [`written`], or where the file cannot be written.
pub fn write(specimen: &Specimen, format: DesignFormat, path: &Path) -> Result<Vec<String>, Failure> {
    let written = written(specimen, format)?;
    write_whole(path, |file| file.write_all(&written.bytes).map_err(|e| WriteError::io(path, e)))?;
    Ok(written.lost)
}
