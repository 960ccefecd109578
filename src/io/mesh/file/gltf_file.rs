//! Reads glTF 2.0, by the gltf crate: all meshes of the scene where their nodes put them, and the material of most
//! triangles.

mod buffers;
mod images;
mod scene;
mod shape_only;

use super::parsed_mesh::ParsedMesh;
use crate::io::file_error::Fault;
use gltf::json::validation::Checked;
use gltf::json::{Root, deserialize};
use gltf::{Document, Semantic};
use shape_only::shape_alone;
use std::path::Path;

/// The size of a binary glTF file's header, in bytes.
const GLB_HEADER: usize = 12;

/// The beginning of the message about a file that is no glTF.
const UNREADABLE: &str = "this glTF 2.0 cannot be read: ";

/// The extensions without which shapes would be read wrongly. A file can be read without any other.
const NEEDED: [&str; 4] = [
    "KHR_draco_mesh_compression",
    "EXT_meshopt_compression",
    "KHR_mesh_quantization",
    "EXT_mesh_gpu_instancing",
];

pub(super) fn read(bytes: &[u8], folder: Option<&Path>) -> Result<ParsedMesh, Fault> {
    let (json, blob) = split(bytes)?;
    let (document, mut warnings) = document(&json)?;
    let data = buffers::load(&document, blob, folder)?;
    let mut mesh = scene::gather(&document, &data)?;
    warnings.append(&mut mesh.warnings);
    warnings.extend(images::warning(&document, &data, folder));
    let name = document
        .default_scene()
        .or_else(|| document.scenes().next())
        .and_then(|s| s.name().map(str::to_owned));
    Ok(ParsedMesh { warnings, name: name.filter(|name| !name.starts_with("Scene")), ..mesh })
}

/// Parses the JSON; returns its document and warnings. Where something besides the shape is broken, such as a texture, the
/// shape is read without it.
fn document(json: &[u8]) -> Result<(Document, Vec<String>), Fault> {
    let fault = match parsed(json) {
        Ok(read) => return Ok(read),
        Err(fault) => fault,
    };
    for (keeps_materials, lost) in
        [(true, "textures and what else is"), (false, "materials, textures and what else is")]
    {
        let alone = shape_alone(json, keeps_materials);
        if let Some((document, mut warnings)) = alone.and_then(|json| parsed(&json).ok()) {
            let place = fault.line.map(|line| format!("line {line}: ")).unwrap_or_default();
            let broken = fault.problem.strip_prefix(UNREADABLE).unwrap_or(&fault.problem);
            let warning =
                format!("{lost} beside the shape are left out, because the file is broken: {place}{broken}");
            warnings.insert(0, warning);
            return Ok((document, warnings));
        }
    }
    Err(fault)
}

fn parsed(json: &[u8]) -> Result<(Document, Vec<String>), Fault> {
    let mut root: Root = deserialize::from_slice(json)
        .map_err(|error| Fault::line(error.line(), format!("{UNREADABLE}{error}")))?;
    let mut warnings = extensions(&mut root)?;
    warnings.extend(positions(&mut root)?);
    let document = Document::from_json(root).map_err(|error| Fault::whole(message(error)))?;
    Ok((document, warnings))
}

/// Splits a file into its JSON and, of a binary file, the bytes that come with it.
fn split(bytes: &[u8]) -> Result<(Vec<u8>, Option<Vec<u8>>), Fault> {
    if !bytes.starts_with(b"glTF") {
        let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        return Ok((text.to_vec(), None));
    }
    // The crate subtracts the header's length from this length without checking it.
    let length = bytes.get(8..GLB_HEADER).and_then(|b| b.try_into().ok()).map_or(0, u32::from_le_bytes);
    if (length as usize) < GLB_HEADER + 8 || length as usize > bytes.len() {
        let message =
            format!("the header says {length} bytes, and the file has {}; it has been cut off", bytes.len());
        return Err(Fault::part("offset 8", message));
    }
    let glb = gltf::Glb::from_slice(bytes).map_err(|error| Fault::whole(message(error)))?;
    Ok((glb.json.into_owned(), glb.bin.map(std::borrow::Cow::into_owned)))
}

fn message(error: gltf::Error) -> String {
    match error {
        gltf::Error::Validation(faults) => {
            let first = faults.first().map(|(path, error)| format!("{path}: {error}")).unwrap_or_default();
            format!("{UNREADABLE}{first}")
        }
        other => format!("{UNREADABLE}{other}"),
    }
}

/// Ensures two assumptions of the gltf crate: that POSITION refers to an accessor that exists, and that its bounds
/// are given. The bounds are not used, so missing ones are filled in, with a warning.
fn positions(root: &mut Root) -> Result<Option<String>, Fault> {
    let mut unbounded = 0;
    let primitives =
        root.meshes.iter().enumerate().flat_map(|(m, mesh)| mesh.primitives.iter().map(move |p| (m, p)));
    for (mesh, primitive) in primitives {
        let Some(index) = primitive.attributes.get(&Checked::Valid(Semantic::Positions)) else { continue };
        let count = root.accessors.len();
        let Some(accessor) = root.accessors.get_mut(index.value()) else {
            let message = format!("POSITION refers to accessor {}, and there are {count}", index.value());
            return Err(Fault::part(format!("mesh {mesh}"), message));
        };
        unbounded += u32::from(accessor.min.is_none() || accessor.max.is_none());
        for bound in [&mut accessor.min, &mut accessor.max] {
            bound.get_or_insert_with(|| serde_json::json!([0.0, 0.0, 0.0]));
        }
    }
    Ok((unbounded > 0).then(|| format!("the bounds of places are missing {unbounded} times")))
}

/// Checks the extensions of a file. Those that change shapes are faults where the file needs them and warnings where it does
/// not. The list of needed extensions is emptied, since the crate would refuse others too, such as those of materials.
fn extensions(root: &mut Root) -> Result<Vec<String>, Fault> {
    if let Some(name) = root.extensions_required.iter().find(|name| NEEDED.contains(&name.as_str())) {
        let message = format!("the shape is written with {name}, which is not read; export it without");
        return Err(Fault::part("extensionsRequired", message));
    }
    let shapeless =
        |name: &String| ["KHR_materials_", "KHR_texture_", "KHR_lights_"].iter().any(|p| name.starts_with(p));
    let strange = root.extensions_required.iter().filter(|name| !shapeless(name));
    let mut warnings: Vec<String> = strange
        .map(|name| {
            format!("the file requires {name}, which this program does not support; it is read without that")
        })
        .collect();
    let optional = root.extensions_used.iter().filter(|name| NEEDED.contains(&name.as_str()));
    warnings.extend(optional.map(|name| format!("{name} is not read; a part of the shape may be missing")));
    root.extensions_required.clear();
    Ok(warnings)
}
