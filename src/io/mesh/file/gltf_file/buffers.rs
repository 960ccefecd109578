//! Loads the buffers of a glTF file, which lie within it, as text in it, or in files beside it, and checks that accessors
//! stay within them.

use super::super::limits::{self, MAX_BYTES};
use crate::io::file_error::Fault;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use gltf::accessor::{DataType, Dimensions};
use gltf::buffer::{Source, View};
use gltf::{Accessor, Document, Semantic};
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
            Source::Bin => blob.take().ok_or_else(|| Fault::whole("a binary chunk is expected in the file")),
            Source::Uri(uri) => from_uri(uri, folder),
        };
        let whole_one = read.and_then(|bytes| match bytes.len() < buffer.length() {
            true => {
                Err(format!("{} bytes are announced, and {} are there", buffer.length(), bytes.len()).into())
            }
            false => Ok(bytes),
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
    Ok(data)
}

/// Returns the buffers that hold the positions of corners, or the indices of triangles.
fn needed(document: &Document) -> BTreeSet<usize> {
    let primitives = document.meshes().flat_map(|mesh| mesh.primitives().collect::<Vec<_>>());
    let accessors = primitives.flat_map(|p| [p.get(&Semantic::Positions), p.indices()]).flatten();
    let views = accessors.flat_map(|accessor| {
        let sparse = accessor.sparse().map(|sparse| [sparse.indices().view(), sparse.values().view()]);
        accessor.view().into_iter().chain(sparse.into_iter().flatten()).collect::<Vec<_>>()
    });
    views.map(|view| view.buffer().index()).collect()
}

pub(super) fn from_uri(uri: &str, folder: Option<&Path>) -> Result<Vec<u8>, Fault> {
    if let Some(rest) = uri.strip_prefix("data:") {
        let (_, text) = rest.split_once(";base64,").ok_or("a `data:` of base64 is expected")?;
        return STANDARD.decode(text).map_err(|error| Fault::whole(format!("this is not base64: {error}")));
    }
    let name = percent_encoding::percent_decode_str(uri).decode_utf8_lossy();
    // Only files beside this one are read: an untrusted mesh must not make the program read others.
    let outside = name.contains(['/', '\\', ':', '\0']) || name == ".." || name == "." || name.is_empty();
    let Some(folder) = folder.filter(|_| !outside) else {
        return Err(format!("`{name}` is not a file beside this one; put it there, or embed it").into());
    };
    limits::bytes(&folder.join(&*name)).map_err(|fault| Fault::whole(format!("{name}: {fault}")))
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
        return fault(format!(
            "{:?} of {:?} are given; {shape:?} of {types:?} are expected",
            accessor.dimensions(),
            accessor.data_type()
        ));
    }
    let (count, size) = (accessor.count(), accessor.size());
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
        None => Ok(()),
    }
}

fn fits(view: &View<'_>, offset: usize, count: usize, size: usize, data: &Data) -> bool {
    let stride = view.stride().unwrap_or(size);
    let needed = || stride.checked_mul(count.checked_sub(1)?)?.checked_add(size)?.checked_add(offset);
    let end = view.offset().checked_add(view.length());
    stride >= size
        && needed().is_some_and(|needed| needed <= view.length())
        && end.is_some_and(|end| end <= data[view.buffer().index()].len())
}
