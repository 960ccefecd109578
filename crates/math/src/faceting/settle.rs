//! Corrects the planes of regions that noise has spoilt, by properties that every convex solid has.
//!
//! Where noise has tilted a region of a few triangles, its plane cuts the solid. No facet of a convex solid does, so such
//! planes are left out, and each triangle is assigned to the facet that it lies on.

use super::deviation::outermost;
use super::hull::Hull;
use super::regions::{Regions, joined};
use super::search::SAME;
use crate::Surface;
use crate::edges::Edges;
use glam::DVec3;
use rayon::prelude::*;

/// The greatest number of rounds in which triangles are assigned again. Planes that noise has tilted settle in three
/// or four rounds.
const ROUNDS: usize = 6;

/// The greatest number of distances between triangles and planes that are computed in a round. A surface that needs
/// more is no cut stone.
const MOST_DISTANCES: usize = 200_000_000;

/// Returns the regions with each triangle assigned to the facet that it lies on. `None` where too few planes are left, or
/// too many distances would have to be computed.
pub(super) fn settled(
    surface: &Surface,
    edges: &Edges,
    hull: &Hull,
    found: Regions,
    tolerance: f64,
) -> Option<Regions> {
    let mut regions = found;
    let middles: Vec<DVec3> =
        (0..surface.triangles.len()).map(|t| surface.corners(t).iter().sum::<DVec3>() / 3.0).collect();
    for _ in 0..ROUNDS {
        let mut planes: Vec<_> = regions.fits.iter().map(|fit| fit.plane).collect();
        planes.retain(|plane| hull.outside(plane) <= SAME * tolerance);
        if planes.len() < 4 || planes.len() * middles.len() > MOST_DISTANCES {
            return None;
        }
        let of: Vec<u32> = middles.par_iter().map(|middle| outermost(&planes, *middle).0 as u32).collect();
        let mut members = vec![vec![]; planes.len()];
        (0..).zip(&of).for_each(|(t, &region)| members[region as usize].push(t));
        let next = joined(surface, edges, tolerance, of, members);
        let is_settled = next.of == regions.of;
        regions = next;
        if is_settled {
            break;
        }
    }
    Some(regions)
}
