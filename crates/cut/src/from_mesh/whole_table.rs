//! Joins the parts of a table that noise has divided.

use brillianteer_math::Polytope;
use brillianteer_math::faceting::Faceted;

/// Facets that lean less than this from the table may be parts of it, radians: the facets of cuts lean more, from 2 degrees on.
const PART: f64 = 0.033;

/// Facets that were found at a smaller tolerance than this part of the size are not those that noise makes.
const EXACT: f64 = 1e-5;

/// A facet that may be a part of the table.
#[derive(Debug, Clone, PartialEq)]
pub struct TablePart {
    /// The name of the facet.
    pub facet: String,
    /// The angle between its normal and that of the table, degrees.
    pub lean_deg: f64,
}

/// Returns the facets that may be parts of a table, without the table itself, those that lean least first: its neighbours
/// that lean little from it, and their neighbours that do.
pub(super) fn parts(found: &Faceted, table: usize) -> Vec<usize> {
    let facets = found.polytope.facets();
    if found.tolerance <= EXACT * found.surface.size() {
        return vec![];
    }
    let mut parts = vec![table];
    let mut at = 0;
    while at < parts.len() {
        let near = facets[parts[at]].neighbours.iter().map(|&n| n as usize);
        let near: Vec<usize> = near.filter(|&n| lean(&found.polytope, table, n) < PART).collect();
        near.into_iter().for_each(|n| {
            if !parts.contains(&n) {
                parts.push(n)
            }
        });
        at += 1;
    }
    parts.remove(0);
    parts.sort_by(|&a, &b| lean(&found.polytope, table, a).total_cmp(&lean(&found.polytope, table, b)));
    parts
}

/// Returns the angle between the normals of two facets, radians.
pub(super) fn lean(solid: &Polytope, one: usize, other: usize) -> f64 {
    let [one, other] = [one, other].map(|place| solid.facets()[place].plane.normal);
    one.cross(other).length().atan2(one.dot(other))
}

/// Returns the solid with as many parts of the table as possible joined to it; `None` where there are none.
pub(super) fn whole(found: &Faceted, table: usize) -> Option<Faceted> {
    let parts = parts(found, table);
    let group = |count: usize| [&[table], &parts[..count]].concat();
    (1..=parts.len()).rev().find_map(|count| found.joined(&group(count)))
}
