//! Tells scans, whose noise bends them everywhere, from models, and why a surface is no stone with flat facets.

use super::change::Change;
use super::deviation::outermost;
use super::hull::Hull;
use super::scan;
use super::search::MatchingSolid;
use crate::{Plane, Surface};
use glam::DVec3;
use rayon::prelude::*;

/// A surface with more corners than this for each facet is no model with corners only where facets meet.
pub const MODELLED: usize = 12;

/// The part of a model's corners that may lie within facets, where no others meet.
const WITHIN: f64 = 0.1;

/// The distance, as a part of the size, up to which corners lie off their facets by rounding rather than noise.
const ROUNDING: f64 = 1e-5;

/// Edges that bend inward by less than this are flat except for rounding, radians.
const BENT: f64 = 2e-4;

/// A surface of fewer corners than this is read with what facets are found: where a scan was thinned out to a few corners for each
/// facet, many of them lie within facets as well.
const FEWEST_OF_NOISE: usize = 1000;

/// Returns whether noise bends a surface everywhere, as that of a scan: nearly as often inward as outward. A model of few corners, such
/// as a star, may bend inward as often by intent.
pub(super) fn is_noisy(surface: &Surface) -> bool {
    /// The part of the edges that bend inward.
    const INWARD: f64 = 0.25;
    surface.vertices.len() >= scan::FEWEST && Change::inward_part(surface, BENT) > INWARD
}

/// Returns whether a solid that reproduces a noisy surface has facets that noise or triangles across the edges of the stone have
/// made. Such a surface has many corners within facets, as a scan has, and a model has none there: its corners are where facets
/// meet. The number of corners for each facet does not tell, for there are the more facets the more of them are false.
pub(super) fn is_of_noise(surface: &Surface, solid: &MatchingSolid) -> bool {
    let is_rounded = solid.deviation <= ROUNDING * surface.size();
    if solid.errors.is_some() || is_rounded || surface.vertices.len() < FEWEST_OF_NOISE || !is_noisy(surface)
    {
        return false;
    }
    let planes: Vec<Plane> = solid.polytope.planes().collect();
    let middle = |t: usize| surface.corners(t).iter().sum::<DVec3>() / 3.0;
    let on: Vec<usize> =
        (0..surface.triangles.len()).into_par_iter().map(|t| outermost(&planes, middle(t)).0).collect();
    let mut facets: Vec<Option<usize>> = vec![None; surface.vertices.len()];
    let mut is_within = vec![true; surface.vertices.len()];
    for (facet, v) in
        on.iter().zip(&surface.triangles).flat_map(|(f, t)| t.iter().map(move |&v| (*f, v as usize)))
    {
        is_within[v] &= *facets[v].get_or_insert(facet) == facet;
    }
    is_within.iter().filter(|within| **within).count() as f64 > WITHIN * is_within.len() as f64
}

/// The reason why a surface is not read as a convex solid between planes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unfaceted {
    /// It is not convex.
    Concave,
    /// It is convex and curved, or has more facets than a stone can have.
    Curved,
    /// Noise bends it everywhere, and hides any facets that it has.
    Noisy,
}

impl Unfaceted {
    /// Returns why a closed surface, in which [`facets`](super::facets) found no solid, has none.
    pub fn of(surface: &Surface) -> Self {
        /// The greatest additional volume of the hull of a convex surface, as a part, and the number of standard deviations of the
        /// noise by which it lies outside.
        const SWOLLEN: f64 = 0.03;
        const OUTSIDE: f64 = 5.0;
        /// The part of the edges of a convex surface that may bend inward.
        const INWARD: f64 = 0.01;
        let is_noisy = is_noisy(surface);
        let noise = Some(()).filter(|()| is_noisy).and_then(|()| scan::noise(surface)).unwrap_or_default();
        let swollen = Hull::of(surface).map_or(0.0, |hull| hull.volume() - surface.volume());
        if swollen > SWOLLEN * surface.volume() + OUTSIDE * noise * surface.area() {
            Self::Concave
        } else if is_noisy {
            Self::Noisy
        } else if Change::inward_part(surface, BENT) <= INWARD {
            Self::Curved
        } else {
            Self::Concave
        }
    }
}
