//! Reads glTF 2.0, by the gltf crate: all meshes of the scene where their nodes put them, and the material of most
//! triangles.

mod buffers;
mod draco;
mod faults;
mod images;
mod instances;
mod meshopt;
mod repair;
mod scene;
mod shape_only;
mod uri;

use super::parsed_mesh::ParsedMesh;
use brillianteer_base::Fault;
use faults::{UNREADABLE, broken, unfit};
use gltf::json::validation::Checked;
use gltf::json::{Root, deserialize};
use gltf::{Document, Semantic};
use repair::{Repaired, repaired, with_views};
use serde_json::Value;
use shape_only::shape_alone;
use std::path::Path;

/// The size of a binary glTF file's header, in bytes.
const GLB_HEADER: usize = 12;

/// The extension that packs shapes in a way that is not read. Where a file does not require it, its buffers hold the shapes
/// also as they are.
const PACKED: &str = "KHR_meshopt_compression";

/// The extensions of shapes that are read.
const READ: [&str; 5] =
    [repair::DRACO, meshopt::NAME, instances::NAME, "KHR_mesh_quantization", scene::HIDDEN];

pub(super) fn read(bytes: &[u8], folder: Option<&Path>) -> Result<ParsedMesh, Fault> {
    let (json, blob) = split(bytes)?;
    let (document, mut warnings) = document(&json)?;
    let data = buffers::load(&document, blob, folder)?;
    let (mut mesh, name) = scene::gather(&document, &data)?;
    warnings.append(&mut mesh.warnings);
    warnings.extend(images::warning(&document, &data, folder));
    Ok(ParsedMesh { warnings, name: name.filter(|name| !name.starts_with("Scene")), ..mesh })
}

/// Parses the JSON; returns its document and warnings. Where it departs from the standard it is repaired, and where something
/// besides the shape is broken, such as a texture, the shape is read without it.
fn document(json: &[u8]) -> Result<(Document, Vec<String>), Fault> {
    let fault = match parsed(json) {
        Ok(read) => return Ok(read),
        Err(fault) => fault,
    };
    let Some(Repaired { mut root, warnings: left_out }) = repaired(json) else { return Err(fault) };
    check_version(&root)?;
    with_views(&mut root);
    let with =
        |(document, warnings): (Document, Vec<String>)| (document, [left_out.clone(), warnings].concat());
    if let Some(read) = serde_json::to_vec(&root).ok().and_then(|json| parsed(&json).ok()) {
        return Ok(with(read));
    }
    for (keeps_materials, lost) in
        [(true, "textures and what else is"), (false, "materials, textures and what else is")]
    {
        let alone = shape_alone(&root, keeps_materials);
        if let Some((document, mut warnings)) = alone.and_then(|json| parsed(&json).ok()) {
            let place = fault.line.map(|line| format!("line {line}: ")).unwrap_or_default();
            let broken = fault.problem.strip_prefix(UNREADABLE).unwrap_or(&fault.problem);
            let warning =
                format!("{lost} beside the shape are left out, because the file is broken: {place}{broken}");
            warnings.insert(0, warning);
            return Ok(with((document, warnings)));
        }
    }
    Err(fault)
}

/// Refuses files of another version of glTF than 2.
fn check_version(root: &Value) -> Result<(), Fault> {
    let version = root.pointer("/asset/version").map(|version| match version {
        Value::String(text) => text.clone(),
        other => other.to_string(),
    });
    match version.filter(|version| version.split('.').next() != Some("2")) {
        Some(version) => Err(other_version(&version)),
        None => Ok(()),
    }
}

fn other_version(version: &str) -> Fault {
    Fault::part("asset", format!("this is glTF {version:.20}; 2.0 is read; save the file as glTF 2.0"))
}

fn parsed(json: &[u8]) -> Result<(Document, Vec<String>), Fault> {
    let mut root: Root = deserialize::from_slice(json).map_err(|error| broken(json, &error))?;
    if !root.asset.version.starts_with("2") {
        return Err(other_version(&root.asset.version));
    }
    let requires_packed = root.extensions_required.iter().any(|name| name == PACKED);
    let mut warnings = extensions(&mut root);
    warnings.extend(positions(&mut root)?);
    let document = Document::from_json(root).map_err(unfit)?;
    if requires_packed && document.views().any(|view| view.extension_value(PACKED).is_some()) {
        let message =
            format!("the shape is written with {PACKED}, which is not read; save the file without it");
        return Err(Fault::part("extensionsRequired", message));
    }
    Ok((document, warnings))
}

/// Splits a file into its JSON and, of a binary file, the bytes that come with it.
fn split(bytes: &[u8]) -> Result<(Vec<u8>, Option<Vec<u8>>), Fault> {
    if !bytes.starts_with(b"glTF") {
        return Ok((bytes.to_vec(), None));
    }
    if bytes.get(4..8).is_some_and(|version| version != 2_u32.to_le_bytes()) {
        return Err(other_version(&format!("{}.0", u32::from(bytes[4]))));
    }
    // The crate subtracts the header's length from this length without checking it.
    let length = bytes.get(8..GLB_HEADER).and_then(|b| b.try_into().ok()).map_or(0, u32::from_le_bytes);
    if (length as usize) < GLB_HEADER + 8 || length as usize > bytes.len() {
        let message =
            format!("the header says {length} bytes, and the file has {}; it has been cut off", bytes.len());
        return Err(Fault::part("offset 8", message));
    }
    let glb = gltf::Glb::from_slice(bytes).map_err(unfit)?;
    Ok((glb.json.into_owned(), glb.bin.map(std::borrow::Cow::into_owned)))
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
        let is_missing = |bound: &Option<Value>| {
            let numbers = bound.as_ref().and_then(Value::as_array);
            numbers.is_none_or(|list| list.len() != 3 || !list.iter().all(Value::is_number))
        };
        let bounds = [&mut accessor.min, &mut accessor.max];
        unbounded += u32::from(bounds.iter().any(|bound| is_missing(bound)));
        for bound in bounds.into_iter().filter(|bound| is_missing(bound)) {
            *bound = Some(serde_json::json!([0.0, 0.0, 0.0]));
        }
    }
    Ok((unbounded > 0).then(|| format!("the bounds of places are missing {unbounded} times")))
}

/// Returns a warning for each needed extension that is not known. The list of needed extensions is emptied, since the crate
/// would refuse others too, such as those of materials.
fn extensions(root: &mut Root) -> Vec<String> {
    let shapeless = |name: &str| {
        ["KHR_materials_", "KHR_texture_", "EXT_texture_", "KHR_lights_"].iter().any(|p| name.starts_with(p))
    };
    let is_known = |name: &str| READ.contains(&name) || name == PACKED;
    let required = std::mem::take(&mut root.extensions_required);
    let strange = required.into_iter().filter(|name| !shapeless(name) && !is_known(name));
    let warning = |name| {
        format!("the file requires {name}, which this program does not support; it is read without that")
    };
    strange.map(warning).collect()
}
