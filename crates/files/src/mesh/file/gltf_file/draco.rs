//! Unpacks the corners and triangles that KHR_draco_mesh_compression has packed, by draco-core.

use super::super::limits::{self, MAX_BYTES, MAX_TRIANGLES, MAX_VERTICES};
use super::buffers::Data;
use super::repair::DRACO;
use brillianteer_base::Fault;
use draco_core::{DecodeLimits, DecoderBuffer, GeometryAttributeType, Mesh, MeshDecoder};
use glam::DVec3;
use gltf::{Document, Primitive};
use serde_json::Value;

/// Corners, and triangles by their numbers.
pub(super) struct Unpacked {
    pub vertices: Vec<DVec3>,
    pub order: Vec<u32>,
}

/// Returns the corners and triangles of a primitive that is packed; `None` for any other.
///
/// # Errors
/// Fails where the packed bytes are missing or broken, or hold more than a mesh may have.
pub(super) fn unpacked(
    primitive: &Primitive<'_>,
    document: &Document,
    data: &Data,
) -> Result<Option<Unpacked>, Fault> {
    let Some(extension) = primitive.extension_value(DRACO) else { return Ok(None) };
    let fault = |why: &str| {
        Fault::whole(format!("its {DRACO} cannot be read: {why}; save the file again, or without it"))
    };
    let view = extension.get("bufferView").and_then(Value::as_u64);
    let view = view.and_then(|view| document.views().nth(usize::try_from(view).ok()?));
    let view = view.ok_or_else(|| fault("it has no buffer view"))?;
    let end = view.offset().checked_add(view.length());
    let bytes = end.and_then(|end| data.get(view.buffer().index())?.get(view.offset()..end));
    let bytes = bytes.ok_or_else(|| fault("its buffer view is longer than its buffer"))?;
    let most = DecodeLimits::default()
        .with_max_points(MAX_VERTICES as u64)
        .with_max_faces(MAX_TRIANGLES as u64)
        .with_max_decoded_bytes(MAX_BYTES);
    let mut mesh = Mesh::new();
    MeshDecoder::new()
        .decode(&mut DecoderBuffer::new(bytes).with_limits(most), &mut mesh)
        .map_err(|_| fault("its packed bytes are damaged, or packed in a way that is not read"))?;
    limits::count(mesh.num_points(), mesh.num_faces())?;
    let own = extension.pointer("/attributes/POSITION").and_then(Value::as_u64);
    let own = own.and_then(|id| mesh.attribute_by_unique_id(u32::try_from(id).ok()?));
    let positions = own.or_else(|| mesh.named_attribute(GeometryAttributeType::Position));
    let positions = positions.filter(|found| found.num_components() == 3);
    let numbers = positions.ok_or_else(|| fault("it has no positions"))?.read_f32s(mesh.num_points(), 3);
    let vertices = numbers.as_chunks().0.iter().map(|&at: &[f32; 3]| DVec3::from_array(at.map(f64::from)));
    let order = mesh.faces().iter().flatten().map(|corner| corner.0).collect();
    Ok(Some(Unpacked { vertices: vertices.collect(), order }))
}
