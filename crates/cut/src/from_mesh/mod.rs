//! Makes a stone of the facets that were found on a surface: puts it upright, evens it where only noise makes it
//! uneven, scales it by its girdle, and names its facets.
//!
//! The stone's frame is that of docs/architecture.md: +z out of the table, z = 0 at the crown's side of the girdle, +x
//! through a bezel or another facet of the crown that is its own mirror image. A long stone's width lies along x.

mod aim;
mod azimuth_classes;
mod cues;
mod error;
mod even;
mod evening;
mod facet_error;
mod likeness;
mod name;
mod nearly;
mod outline;
mod up;
mod whole_table;

#[cfg(test)]
mod tests;

use brillianteer_math::faceting::{Faceted, deviation};
use brillianteer_math::{Plane, Polytope, Pose, Symmetry};
use glam::DVec3;

use aim::{Aim, aim};
pub use aim::{Doubt, directions};
pub use error::FromMeshError;
pub use evening::Evening;
pub use facet_error::FacetError;
pub use up::Up;
pub use whole_table::TablePart;

/// A stone that was found in a surface.
#[derive(Debug, Clone, PartialEq)]
pub struct FromMesh {
    /// Names, no two alike, and planes in the stone's frame, in the order table, crown, girdle, pavilion, culet.
    pub facets: Vec<(String, Plane)>,
    /// The pose that carries the surface into the stone's frame.
    pub pose: Pose,
    /// The distance from the stone of the surface's corner that is farthest off, girdle radii.
    pub deviation: f64,
    /// By how much the stone's volume exceeds that of the surface, as a part of the latter; negative where it is less.
    pub volume_excess: f64,
    /// The symmetry that was given to the planes, because they had it except for noise; [`Symmetry::NONE`] where they
    /// were left as found.
    pub evened: Symmetry,
    /// The number of facets without which a scan that stays as found would have a symmetry; `None` where it has one, or lacks more
    /// than a few.
    pub lacking: Option<usize>,
    /// The direction that was taken as up, in the surface's frame, a unit vector.
    pub up: DVec3,
    /// The standard errors of the facets of a scan, in the order of the facets; empty where the surface is no scan.
    pub errors: Vec<FacetError>,
    /// Another direction that may be up, where the shape leaves a doubt.
    pub doubt: Option<Doubt>,
    /// A facet that may be a part of the table, which noise has divided, where the two are not one within the noise.
    pub table_part: Option<TablePart>,
}

/// The direction that was taken as up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UpFound {
    /// The direction in the surface's frame, a unit vector.
    pub up: DVec3,
    /// Another direction that may be up, where the shape leaves a doubt.
    pub doubt: Option<Doubt>,
}

/// Finds the direction up of a surface by its facets, such as those of the hull of a surface that is not convex. An axis of
/// the surface's frame that lies within 1.5 degrees of it is taken instead, so that a stone which was put along that axis
/// stays as it is.
///
/// # Errors
/// Fails where the direction up is given and is zero or not finite.
pub fn find_up(found: &Faceted, up: Up) -> Result<UpFound, FromMeshError> {
    let parts = even::FacetParts::about(found, even::centroid(&found.polytope));
    let Aim { axis, doubt, .. } = aim(&found.polytope, &parts, up, found.deviation.max(found.tolerance))?;
    Ok(UpFound { up: aim::put_along(axis).unwrap_or(axis), doubt })
}

/// Poses, evens and names the facets of a surface. The parts of a table that noise has divided are joined.
///
/// # Errors
/// Fails where the direction up is zero or not finite, or where the facets enclose nothing once they are evened.
pub fn from_mesh(found: &Faceted, up: Up, evening: Evening) -> Result<FromMesh, FromMeshError> {
    let made = posed(found, up, evening)?;
    let whole =
        made.table.filter(|_| !matches!(up, Up::Posed(_))).and_then(|table| whole_table::whole(found, table));
    Ok(whole.map_or(Ok(made), |whole| posed(&whole, up, evening))?.stone)
}

/// A stone, and the place of its table among the facets that were found.
struct Made {
    stone: FromMesh,
    table: Option<usize>,
}

fn posed(found: &Faceted, up: Up, evening: Evening) -> Result<Made, FromMeshError> {
    let posed = if let Up::Posed(pose) = up { Some(pose) } else { None };
    let is_posed = posed.is_some();
    let middle = match posed {
        Some(pose) => pose.unplace(DVec3::ZERO) - found.centre,
        None => even::centroid(&found.polytope),
    };
    let parts = even::FacetParts::about(found, middle);
    let Aim { axis, table, doubt } = aim(&found.polytope, &parts, up, found.deviation.max(found.tolerance))?;
    let even = even::evened(&parts, axis, posed.is_some(), evening);
    let upright = match posed {
        Some(pose) => outline::as_posed(&even, &pose),
        None => outline::placed(&even, &parts.areas)?,
    };
    let posed: Vec<Plane> = even.planes.iter().map(|p| p.placed(&upright)).collect();
    let polytope = Polytope::from_planes(&posed)?;
    let turn = upright.turn * even.turn;
    let at = upright.place(even.shift) - upright.scale * (turn * (found.centre + middle));
    let pose = Pose { at, turn, ..upright };
    let points: Vec<DVec3> = found.surface.vertices.iter().map(|&v| pose.place(v + found.centre)).collect();
    let given = found.faces.iter().map(|f| f.name.clone()).collect::<Option<Vec<_>>>();
    let facets = name::named(&posed, table, given, upright.scale * found.tolerance);
    let level = table.filter(|_| even.symmetry(upright.turn) == Symmetry::NONE && !is_posed);
    let errors = errors(found, &pose, &facets, &posed, level);
    let table_part = table.filter(|_| !is_posed).and_then(|table| table_part(found, table, &facets, &posed));
    let is_left = evening == Evening::WhereLikely && even.symmetry(upright.turn) == Symmetry::NONE;
    let lacking = if is_left && !errors.is_empty() { nearly::lacking(&even.planes) } else { None };
    let stone = FromMesh {
        errors,
        lacking,
        facets,
        pose,
        deviation: deviation(&polytope, &points),
        volume_excess: polytope.volume() / (pose.scale.powi(3) * found.surface.volume()) - 1.0,
        evened: even.symmetry(upright.turn),
        up: axis,
        doubt,
        table_part,
    };
    Ok(Made { stone, table })
}

/// Returns the facet that leans least from the table, if it may be a part of it. The planes of the named facets are among
/// `posed` in the order of the found faces.
fn table_part(
    found: &Faceted,
    table: usize,
    facets: &[(String, Plane)],
    posed: &[Plane],
) -> Option<TablePart> {
    let place = *whole_table::parts(found, table).first()?;
    let (name, _) = facets.iter().find(|(_, plane)| *plane == posed[place])?;
    let lean_deg = whole_table::lean(&found.polytope, table, place).to_degrees();
    Some(TablePart { facet: name.clone(), lean_deg })
}

/// Returns the standard errors of the named facets of a scan, whose planes are among `posed` in the order of the found faces;
/// none where the surface is no scan. `table` is the place of the table where its normal is the axis.
fn errors(
    found: &Faceted,
    pose: &Pose,
    facets: &[(String, Plane)],
    posed: &[Plane],
    table: Option<usize>,
) -> Vec<FacetError> {
    let placed = |place: usize| {
        let error = found.faces[place].error?;
        Some(error.placed(&pose.after(&Pose { at: found.centre, ..Pose::STILL })))
    };
    let axis = table.and_then(placed);
    let of = |(name, plane): &(String, Plane)| {
        let place = posed.iter().position(|other| other == plane)?;
        let error =
            FacetError::of(name, plane, &placed(place)?, axis.as_ref().filter(|_| table != Some(place)));
        Some(FacetError { is_bent: found.faces[place].is_bent, ..error })
    };
    facets.iter().filter_map(of).collect()
}
