//! Compares the stone that was read with the mesh itself: what noise does not explain is told.

use brillianteer_cut::from_mesh::FromMesh;
use brillianteer_math::faceting::{Faceted, SWOLLEN};
use brillianteer_math::{at_most, signed};

/// The least departure of the volume that is told, as a part: a point of a carat (0.01 ct) in a stone of 10 carats. It is more than
/// noise leaves in any scan of the table in docs/formats.md.
const VOLUME: f64 = 1e-3;

/// Corners of a scan lie within this many tolerances (12 standard deviations of the noise) of its facets: of a million, noise moves none by
/// more than 5, and it may be twice as large in one direction as in the mean of all.
const FARTHEST: f64 = 4.0;

/// The distance, as a part of the size, by which rounding moves corners at most.
const ROUNDING: f64 = 1e-5;

/// What is told of the departure of a stone from its mesh.
pub(super) enum Departure {
    Note(String),
    Warning(String),
}

/// Returns what is to be told of the departure of a stone from the mesh that it was read from; `None` where noise, or the change that is
/// told anyway, explains it.
pub(super) fn departure(found: &Faceted, made: &FromMesh) -> Option<Departure> {
    let is_scan = found.faces.iter().any(|face| face.error.is_some());
    let told = found.change.map_or(0.0, |change| change.volume);
    let is_swollen = (made.volume_excess - told).abs() > VOLUME + found.volume_of_tolerance();
    let farthest = (FARTHEST * found.tolerance).max(ROUNDING * found.surface.size());
    let is_far = is_scan && made.deviation > made.pose.scale * farthest;
    let volume = format!("{} %", signed(100.0 * made.volume_excess, 3));
    let figures = format!(
        "its volume departs from the mesh's by {volume}, and the mesh's farthest corner lies {} girdle radii from its surface",
        at_most(made.deviation)
    );
    if is_swollen && is_scan && !is_far && made.volume_excess > 0.0 {
        // The search for the facets of a scan holds the volume to what such triangles cut off.
        let note = format!(
            "the mesh's triangles lie across edges of the stone, which has {volume} more volume than they enclose"
        );
        Some(Departure::Note(note))
    } else if is_swollen || is_far {
        Some(Departure::Warning(format!(
            "the stone departs from its mesh by more than the noise that was found: {figures}; a chip, dust or a hidden facet may be the \
             cause: compare it with the mesh read as triangles"
        )))
    } else if told > SWOLLEN {
        // A mesh that changes by less is read so without being asked, and a note tells the change.
        let facets = found.faces.len();
        Some(Departure::Warning(format!(
            "the convex stone around the mesh, of {facets} facets, is another shape than the mesh: {figures}; read as triangles the mesh \
             would stay as it is"
        )))
    } else {
        None
    }
}
