//! Limits of the meshes that are read: enough for any scan of a stone, too little to fill the memory.

use super::parsed_mesh::ParsedMesh;
use crate::text::content;
use brillianteer_base::Fault;
use brillianteer_math::Surface;
use std::path::Path;

/// The size of the largest file that is read, in bytes; a buffer beside it may be as large again, and all buffers together.
pub const MAX_BYTES: u64 = 512 << 20;

/// The most corners that are read.
pub(super) const MAX_VERTICES: usize = 12_000_000;

/// The most triangles that are read.
pub(super) const MAX_TRIANGLES: usize = 4_000_000;

/// Reads a file, if it is no larger than [`MAX_BYTES`].
pub(super) fn bytes(path: &Path) -> Result<Vec<u8>, Fault> {
    let bytes = content(path, MAX_BYTES)?;
    if bytes.len() as u64 > MAX_BYTES {
        return Err(format!("this is larger than {} MiB; save a coarser mesh", MAX_BYTES >> 20).into());
    }
    Ok(bytes)
}

/// Refuses more triangles or corners than are read.
pub(super) fn count(vertices: usize, triangles: usize) -> Result<(), Fault> {
    let too_many = |what: &str, most: usize| {
        Err(format!("this has more than {} million {what}; save a coarser mesh", most / 1_000_000).into())
    };
    match (vertices > MAX_VERTICES, triangles > MAX_TRIANGLES) {
        (_, true) => too_many("triangles", MAX_TRIANGLES),
        (true, _) => too_many("corners", MAX_VERTICES),
        _ => Ok(()),
    }
}

/// Checks that a reader's triangles exist and refer to its corners, and leaves out those whose corners are not finite.
pub(super) fn checked(mut parsed: ParsedMesh) -> Result<ParsedMesh, Fault> {
    let surface = &parsed.surface;
    count(surface.vertices.len(), surface.triangles.len())?;
    if surface.triangles.is_empty() {
        return Err("this holds no triangles; a closed surface is expected".into());
    }
    let known = surface.vertices.len() as u32;
    if let Some(place) = surface.triangles.iter().position(|t| t.iter().any(|&v| v >= known)) {
        let corner = surface.triangles[place].into_iter().max().unwrap_or_default();
        let message = format!("it refers to corner {corner}, counted from 0, and there are {known}");
        return Err(Fault::part(format!("triangle {}", place + 1), message));
    }
    let warning = leave_out_endless(&mut parsed.surface)?;
    parsed.warnings.extend(warning);
    Ok(parsed)
}

/// Leaves out the triangles with corners that are infinite or NaN, with a warning. Such a corner that no triangle has is
/// moved to another.
fn leave_out_endless(surface: &mut Surface) -> Result<Option<String>, Fault> {
    let Some(corner) = surface.vertices.iter().position(|v| !v.is_finite()) else { return Ok(None) };
    let at = surface.vertices[corner];
    let is_finite = |t: &[u32; 3]| t.iter().all(|&v| surface.vertices[v as usize].is_finite());
    let keep: Vec<bool> = surface.triangles.iter().map(is_finite).collect();
    let (count, first) = (keep.iter().filter(|keep| !**keep).count(), keep.iter().position(|keep| !keep));
    let mut keeps = keep.iter();
    surface.groups.retain(|_| keeps.next() == Some(&true));
    let mut keeps = keep.iter();
    surface.triangles.retain(|_| keeps.next() == Some(&true));
    let Some(&[elsewhere, ..]) = surface.triangles.first() else {
        let message = format!("{at} is not a finite position; finite coordinates are expected");
        return Err(Fault::part(format!("corner {}", corner + 1), message));
    };
    let elsewhere = surface.vertices[elsewhere as usize];
    surface.vertices.iter_mut().filter(|v| !v.is_finite()).for_each(|v| *v = elsewhere);
    let left_out = if count == 1 {
        "triangle with a corner that is not finite is"
    } else {
        "triangles with corners that are not finite are"
    };
    Ok(first.map(|first| format!("{count} {left_out} left out; the first is triangle {}", first + 1)))
}
