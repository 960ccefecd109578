//! Loads the buffers of a glTF file, which lie within it, as text in it, or in files beside it, and checks that accessors
//! stay within them.

use super::super::limits::{self, MAX_BYTES};
use super::instances;
use super::meshopt::{self, Packed};
use super::repair::DRACO;
use super::uri;
use brillianteer_base::Fault;
use glam::DVec3;
use gltf::accessor::{DataType, Dimensions, Item, Iter};
use gltf::buffer::{Buffer, Source, View};
use gltf::{Accessor, Document, Semantic};
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::Path;

/// The bytes of each buffer; a buffer that no shape needs is empty where it is missing or broken.
pub(super) type Data = Vec<Vec<u8>>;

/// Loads all buffers; those that no shape needs may be missing.
pub(super) fn load(
    document: &Document,
    mut blob: Option<Vec<u8>>,
    folder: Option<&Path>,
) -> Result<Data, Fault> {
    let mut data = vec![];
    let mut whole = 0;
    let needed = needed(document);
    for buffer in document.buffers() {
        let place = format!("buffer {}", buffer.index());
        let read = match buffer.source() {
            // The bytes are those that packed views make.
            Source::Bin if is_filled_later(&buffer) => empty(buffer.length()),
            Source::Bin => blob.take().ok_or_else(|| Fault::whole("a binary chunk is expected in the file")),
            Source::Uri(uri) => uri::read(uri, folder),
        };
        let whole_one = read.and_then(|bytes| {
            if bytes.len() < buffer.length() {
                Err(format!("{} bytes are announced, and {} are there", buffer.length(), bytes.len()).into())
            } else {
                Ok(bytes)
            }
        });
        let bytes = match whole_one {
            Err(_) if !needed.contains(&buffer.index()) => vec![],
            read => read.map_err(|fault| Fault::part(&place, fault))?,
        };
        whole += bytes.len() as u64;
        if whole > MAX_BYTES {
            let most = MAX_BYTES >> 20;
            return Err(Fault::part(
                place,
                format!("all buffers are larger than {most} MiB; save a coarser mesh"),
            ));
        }
        data.push(bytes);
    }
    unpack(document, &mut data)?;
    Ok(data)
}

/// Returns whether a buffer has no bytes of its own in the file, because its views are packed elsewhere.
fn is_filled_later(buffer: &Buffer<'_>) -> bool {
    buffer.extension_value(meshopt::NAME).and_then(|extension| extension.get("fallback")?.as_bool())
        == Some(true)
}

fn empty(length: usize) -> Result<Vec<u8>, Fault> {
    if length as u64 > MAX_BYTES {
        Err("it is too large; save a coarser mesh".into())
    } else {
        Ok(vec![0; length])
    }
}

/// Unpacks the packed views that shapes need into their places.
fn unpack(document: &Document, data: &mut Data) -> Result<(), Fault> {
    let needed = needed_views(document);
    for view in document.views().filter(|view| needed.contains(&view.index())) {
        let Some(extension) = view.extension_value(meshopt::NAME) else { continue };
        let place = format!("bufferView {}", view.index());
        let (buffer, from) = (view.buffer().index(), view.offset());
        // Before anything is unpacked: the file says how much room that takes.
        let room = data.get(buffer).map_or(0, |bytes| bytes.len().saturating_sub(from));
        if view.length() > room {
            return Err(Fault::part(&place, "it is larger than its buffer"));
        }
        let bytes = unpacked(extension, view.length(), data).map_err(|fault| Fault::part(&place, fault))?;
        data[buffer][from..from + bytes.len()].copy_from_slice(&bytes);
    }
    Ok(())
}

/// Returns the bytes of a packed view, at most `most` of them.
fn unpacked(extension: &Value, most: usize, data: &Data) -> Result<Vec<u8>, Fault> {
    let number =
        |key: &str| extension.get(key).map_or(Some(0), Value::as_u64).and_then(|n| usize::try_from(n).ok());
    let text = |key: &str| extension.get(key).and_then(Value::as_str).unwrap_or_default();
    let lacks = || Fault::whole(format!("its {} does not lie within its buffer", meshopt::NAME));
    let [buffer, offset, length, stride, count] =
        ["buffer", "byteOffset", "byteLength", "byteStride", "count"]
            .map(|key| number(key).ok_or_else(lacks));
    let (offset, length, stride, count) = (offset?, length?, stride?, count?);
    let end = offset.checked_add(length).ok_or_else(lacks)?;
    let bytes = data.get(buffer?).and_then(|bytes| bytes.get(offset..end)).ok_or_else(lacks)?;
    if stride.checked_mul(count).is_none_or(|size| size > most) {
        return Err(lacks());
    }
    Packed { bytes, count, stride, mode: text("mode"), filter: text("filter") }.unpacked()
}

/// Returns the buffers that hold the positions of corners, or the indices of triangles.
fn needed(document: &Document) -> BTreeSet<usize> {
    let needed = needed_views(document);
    let views = document.views().filter(|view| needed.contains(&view.index()));
    let packed = |view: &View<'_>| {
        let source = view.extension_value(meshopt::NAME)?.get("buffer")?.as_u64()?;
        usize::try_from(source).ok()
    };
    views.flat_map(|view| [Some(view.buffer().index()), packed(&view)]).flatten().collect()
}

/// Returns the views of positions, of their displacements, and of indices, those of the places of copies, and those of packed
/// shapes.
fn needed_views(document: &Document) -> BTreeSet<usize> {
    let mut views = BTreeSet::new();
    let copies = document.nodes().flat_map(|node| instances::accessors(&node, document));
    let view = |accessor: Accessor<'_>| accessor.view().map(|view| view.index());
    views.extend(copies.filter_map(view));
    for primitive in document.meshes().flat_map(|mesh| mesh.primitives().collect::<Vec<_>>()) {
        let shifts = primitive.morph_targets().filter_map(|target| target.positions());
        let own = [primitive.get(&Semantic::Positions), primitive.indices()].into_iter().flatten();
        for accessor in own.chain(shifts) {
            views.extend(accessor.view().map(|view| view.index()));
            if let Some(sparse) = accessor.sparse() {
                views.extend([sparse.indices().view().index(), sparse.values().view().index()]);
            }
        }
        let packed = primitive.extension_value(DRACO).and_then(|found| found.get("bufferView")?.as_u64());
        views.extend(packed.and_then(|view| usize::try_from(view).ok()));
    }
    views
}

/// Reads the vectors of an accessor, of any type of numbers that KHR_mesh_quantization allows.
pub(super) fn vectors(accessor: &Accessor<'_>, data: &Data) -> Result<Vec<DVec3>, Fault> {
    Ok(values::<3>(accessor, Dimensions::Vec3, data)?.into_iter().map(DVec3::from_array).collect())
}

/// Reads the quaternions of an accessor, x, y, z and w, of any length.
pub(super) fn quaternions(accessor: &Accessor<'_>, data: &Data) -> Result<Vec<[f64; 4]>, Fault> {
    values::<4>(accessor, Dimensions::Vec4, data)
}

fn values<const N: usize>(
    accessor: &Accessor<'_>,
    shape: Dimensions,
    data: &Data,
) -> Result<Vec<[f64; N]>, Fault>
where
    [i8; N]: Item,
    [u8; N]: Item,
    [i16; N]: Item,
    [u16; N]: Item,
    [f32; N]: Item,
{
    let types = [DataType::F32, DataType::I8, DataType::U8, DataType::I16, DataType::U16];
    check(accessor, &types, shape, data)?;
    let is_normalized = accessor.normalized();
    let scaled = |most: f64| move |x: f64| if is_normalized { (x / most).max(-1.0) } else { x };
    match accessor.data_type() {
        DataType::I8 => numbers::<i8, N>(accessor, data, scaled(127.0)),
        DataType::U8 => numbers::<u8, N>(accessor, data, scaled(255.0)),
        DataType::I16 => numbers::<i16, N>(accessor, data, scaled(32_767.0)),
        DataType::U16 => numbers::<u16, N>(accessor, data, scaled(65_535.0)),
        _ => numbers::<f32, N>(accessor, data, |x| x),
    }
    .ok_or_else(|| Fault::whole("its values cannot be read; save the file again"))
}

fn numbers<T: Copy + Into<f64>, const N: usize>(
    accessor: &Accessor<'_>,
    data: &Data,
    scaled: impl Fn(f64) -> f64,
) -> Option<Vec<[f64; N]>>
where
    [T; N]: Item,
{
    let values = Iter::<[T; N]>::new(accessor.clone(), |buffer| data.get(buffer.index()).map(Vec::as_slice))?;
    Some(values.map(|vector| vector.map(|x| scaled(x.into()))).collect())
}

/// Returns the name that glTF gives to a type of numbers.
fn type_name(of: DataType) -> &'static str {
    match of {
        DataType::I8 => "BYTE",
        DataType::U8 => "UNSIGNED_BYTE",
        DataType::I16 => "SHORT",
        DataType::U16 => "UNSIGNED_SHORT",
        DataType::U32 => "UNSIGNED_INT",
        DataType::F32 => "FLOAT",
    }
}

/// Checks that an accessor has one of the expected types and lies within its buffers; the crate checks neither.
pub(super) fn check(
    accessor: &Accessor<'_>,
    types: &[DataType],
    shape: Dimensions,
    data: &Data,
) -> Result<(), Fault> {
    let fault = |message: String| Err(Fault::part(format!("accessor {}", accessor.index()), message));
    if !types.contains(&accessor.data_type()) || accessor.dimensions() != shape {
        let types: Vec<&str> = types.iter().map(|expected| type_name(*expected)).collect();
        return fault(format!(
            "its values are {:?} of {}; {shape:?} of {} are expected; save the file again with these",
            accessor.dimensions(),
            type_name(accessor.data_type()),
            types.join(", ")
        ));
    }
    let (count, size) = (accessor.count(), accessor.size());
    if count == 0 {
        return fault("it has no values; one or more are expected".to_owned());
    }
    limits::count(count, count / 3)?;
    let mut parts = vec![(accessor.view(), accessor.offset(), count, size)];
    if let Some(sparse) = accessor.sparse() {
        let (indices, values) = (sparse.indices(), sparse.values());
        let bytes = indices.index_type().size();
        parts.push((Some(indices.view()), indices.offset(), sparse.count(), bytes));
        parts.push((Some(values.view()), values.offset(), sparse.count(), size));
    } else if accessor.view().is_none() {
        return fault("it has no values".to_owned());
    }
    let outside = |(view, offset, count, size): &(Option<View<'_>>, usize, usize, usize)| {
        view.as_ref().is_some_and(|view| !fits(view, *offset, *count, *size, data))
    };
    match parts.iter().find(|part| outside(part)) {
        Some((_, offset, count, size)) => fault(format!(
            "{count} values of {size} bytes from {offset} on are more than its buffer view holds"
        )),
        None => check_places(accessor, data),
    }
}

/// Checks that the places of an accessor's sparse values exist, in rising order; the crate leaves others out.
fn check_places(accessor: &Accessor<'_>, data: &Data) -> Result<(), Fault> {
    let Some(sparse) = accessor.sparse() else { return Ok(()) };
    let indices = sparse.indices();
    let (view, size) = (indices.view(), indices.index_type().size());
    let start = view.offset() + indices.offset();
    let bytes = &data[view.buffer().index()][start..start + size * sparse.count()];
    let place =
        |bytes: &[u8]| bytes.iter().rev().fold(0, |place: usize, byte| place << 8 | usize::from(*byte));
    let mut next = 0;
    for place in bytes.chunks_exact(size).map(place) {
        if place < next || place >= accessor.count() {
            let problem = format!(
                "it has a sparse value at place {place}, where rising places below {} are expected; save the file \
                 without sparse values",
                accessor.count()
            );
            return Err(Fault::part(format!("accessor {}", accessor.index()), problem));
        }
        next = place + 1;
    }
    Ok(())
}

fn fits(view: &View<'_>, offset: usize, count: usize, size: usize, data: &Data) -> bool {
    let stride = view.stride().unwrap_or(size);
    let needed = || stride.checked_mul(count.checked_sub(1)?)?.checked_add(size)?.checked_add(offset);
    let end = view.offset().checked_add(view.length());
    stride >= size
        && needed().is_some_and(|needed| needed <= view.length())
        && end.is_some_and(|end| end <= data[view.buffer().index()].len())
}
