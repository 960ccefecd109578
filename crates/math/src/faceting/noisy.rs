//! Tells scans, whose noise bends them everywhere, from models, and why a surface is no stone with flat facets.

use super::change::Change;
use super::deviation::outermost;
use super::hull::Hull;
use super::scan;
use super::search::{MatchingSolid, SAME, facet_of_triangles};
use crate::{Plane, Polytope, Surface};
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

/// A surface of fewer corners than this is read with what facets are found, with a warning: where a scan was thinned out to a few corners
/// for each facet, many of them lie within facets as well.
const FEWEST_OF_NOISE: usize = 1000;

/// The number of standard deviations of the noise up to which corners lie off their facets by noise, and the part of them that may lie
/// farther off.
const OUTLIER: f64 = 6.0;
const UNEXPLAINED: f64 = 0.02;

/// The part of the facets that may have such corners. Facets across the edges of a stone have few corners each.
const UNEXPLAINED_FACETS: f64 = 0.1;

/// Returns whether noise bends a surface everywhere, as that of a scan: nearly as often inward as outward. A model of few corners, such
/// as a star, may bend inward as often by intent.
pub(super) fn is_noisy(surface: &Surface) -> bool {
    /// The part of the edges that bend inward.
    const INWARD: f64 = 0.25;
    surface.vertices.len() >= scan::FEWEST && Change::inward_part(surface, BENT) > INWARD
}

/// How far the facets of a solid that reproduces a surface can be trusted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Trust {
    /// The surface is a scan whose noise is known, a model, or planar except for rounding.
    Known,
    /// Noise bends the surface, or corners lie off the facets by more than noise, and there are too few corners to tell which facets
    /// are true.
    Uncertain,
    /// Noise, or triangles across the edges of the stone, have made facets.
    OfNoise,
}

/// Returns how far the facets of a solid that reproduces a surface can be trusted. `is_hull` is true where it is the hull of a surface that
/// is not convex.
///
/// A scan has many corners within facets, and a model has none there: its corners are where facets meet. The number of corners for each
/// facet does not tell, for there are the more facets the more of them are false.
pub(super) fn trust(surface: &Surface, solid: &MatchingSolid, is_hull: bool) -> Trust {
    if solid.errors.is_some() || surface.vertices.len() < scan::FEWEST {
        return Trust::Known;
    }
    let is_rounded = solid.deviation <= ROUNDING * surface.size();
    let is_known = is_rounded || !(is_noisy(surface) || is_unexplained(surface, solid));
    if is_known && !are_across(surface, solid, is_hull) {
        // Each corner of a model is one of its stone, unless noise hides a facet beside it.
        let hides = !is_rounded && part_on_fewer(surface, solid, 3) > WITHIN;
        if hides { Trust::Uncertain } else { Trust::Known }
    } else if surface.vertices.len() >= FEWEST_OF_NOISE && has_corners_within(surface, solid) {
        Trust::OfNoise
    } else {
        Trust::Uncertain
    }
}

/// Returns whether corners lie off a solid by more than the noise that the flattest parts of the surface show.
fn is_unexplained(surface: &Surface, solid: &MatchingSolid) -> bool {
    let Some(noise) = scan::noise(surface) else { return false };
    let planes: Vec<Plane> = solid.polytope.planes().collect();
    let lies: Vec<(usize, f64)> = surface.vertices.par_iter().map(|v| outermost(&planes, *v)).collect();
    let off: Vec<usize> = lies.iter().filter(|(_, d)| d.abs() > OUTLIER * noise).map(|(f, _)| *f).collect();
    let mut facets = off.clone();
    facets.sort_unstable();
    facets.dedup();
    off.len() as f64 > UNEXPLAINED * lies.len() as f64
        || facets.len() as f64 > UNEXPLAINED_FACETS * planes.len() as f64
}

/// Returns whether triangles across the edges of the stone may have made facets of a solid: in a surface with corners within facets,
/// those whose corners all lie on others. Some of a hull may be; of a solid that reproduces the triangles, what is more than bevels of all
/// edges and corners between the other facets.
fn are_across(surface: &Surface, solid: &MatchingSolid, is_hull: bool) -> bool {
    let planes: Vec<Plane> = solid.polytope.planes().collect();
    let near = SAME * solid.tolerance;
    let only = |at: &DVec3| {
        let mut on = (0..planes.len()).filter(|&f| planes[f].distance(*at).abs() <= near);
        on.next().filter(|_| on.next().is_none())
    };
    let mut has_own = vec![false; planes.len()];
    let own: Vec<Option<usize>> = surface.vertices.par_iter().map(only).collect();
    own.into_iter().flatten().for_each(|facet| has_own[facet] = true);
    let others: Vec<Plane> = planes.iter().zip(&has_own).filter(|(_, own)| **own).map(|(p, _)| *p).collect();
    let bare = (planes.len() - others.len()) as f64;
    if bare <= UNEXPLAINED_FACETS * planes.len() as f64 || !has_corners_within(surface, solid) {
        return false;
    }
    is_hull || Polytope::from_planes(&others).is_ok_and(|rest| bare > bevels(&rest) as f64)
}

/// Returns the number of the edges and corners of a solid, each of which may have a bevel.
fn bevels(solid: &Polytope) -> usize {
    solid.facets().iter().map(|facet| facet.outline.len()).sum::<usize>() / 2 + solid.vertices().len()
}

/// Returns whether more corners of a surface lie within the facets of a solid than a model has there.
fn has_corners_within(surface: &Surface, solid: &MatchingSolid) -> bool {
    part_on_fewer(surface, solid, 2) > WITHIN
}

/// Returns the part of a surface's corners whose triangles lie on fewer facets of a solid than a number: 2 for corners within facets, 3 for
/// those on edges as well.
fn part_on_fewer(surface: &Surface, solid: &MatchingSolid, least: usize) -> f64 {
    let mut on: Vec<Vec<u32>> = vec![vec![]; surface.vertices.len()];
    for (facet, t) in facet_of_triangles(surface, &solid.polytope).into_iter().zip(&surface.triangles) {
        for &v in t {
            let known = &mut on[v as usize];
            if known.len() < least && !known.contains(&facet) {
                known.push(facet);
            }
        }
    }
    on.iter().filter(|on| on.len() < least).count() as f64 / on.len() as f64
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
