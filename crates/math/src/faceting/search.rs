//! Searches for the solid that reproduces a surface, between the planes of regions, at growing tolerances.

use super::deviation::deviation;
use super::deviation::outermost;
use super::fit::PlaneFit;
use super::hull::Hull;
use super::plane_error::PlaneError;
use super::regions::{NOWHERE, Regions, is_sliver, regions};
use super::scan::{ScannedSolid, scanned};
use super::settle;
use crate::edges::Edges;
use crate::{Facet, Plane, Polytope, Surface};
use glam::DVec3;
use rayon::prelude::*;
use std::cell::OnceCell;

/// The tolerances that are tried one after the other, as parts of the size: from the rounding of f32 to a thousandth,
/// which is the noise of careless modelling.
pub(super) const NOISE: [f64; 7] = [1e-6, 1e-5, 4e-5, 1e-4, 2e-4, 4e-4, 1e-3];

/// A solid reproduces a surface if no corner lies farther from the solid's surface than this many tolerances, and its
/// volume differs by no more than its area times this many tolerances. A corner may be one tolerance off its own
/// plane and, where regions were joined, three.
pub(super) const SAME: f64 = 3.0;

/// A solid at a larger tolerance is better if it has fewer facets, or as many with a smaller deviation, and its
/// deviation is within this many times that of the first solid found.
///
/// The halves of a facet have few corners and fit them too well: whole facets deviate up to 3.3 times as much. At 4
/// the small facets of a real princess (deepar-princess.obj) are lost.
const AS_GOOD: f64 = 3.5;
/// The number of larger tolerances that are tried next for a better solid.
const FURTHER: usize = 2;

/// Neighbouring facets may be halves of one facet that noise has divided, if the angle between them is less than this
/// many tolerances make at the width of each.
const NEARLY_ONE: f64 = 10.0;

/// The greatest number of facets of a solid. A surface with more is curved, and cutting it takes too long.
pub(super) const MOST_FACETS: usize = 2_500;

/// A surface is round if more than this part of its total turning lies within regions and not between them.
const ROUND: f64 = 0.1;

/// The limits within which a solid reproduces a surface.
#[derive(Clone, Copy)]
pub(super) struct Limits {
    /// The distance within which corners lie in one plane.
    pub tolerance: f64,
    /// The number of tolerances that a corner may lie off the solid.
    pub same: f64,
}

/// A solid that reproduces a surface.
pub(super) struct MatchingSolid {
    pub found: Regions,
    pub polytope: Polytope,
    pub deviation: f64,
    pub tolerance: f64,
    /// The standard errors of the facets' planes, in the order of the facets; `None` where the surface is no scan.
    pub errors: Option<Vec<PlaneError>>,
    /// Whether each facet of a scan may be several that noise hides; empty where the surface is no scan.
    pub are_bent: Vec<bool>,
}

/// A surface with its centre at the origin, and the data that the search for its solid needs.
pub(super) struct SolidSearch<'a> {
    surface: &'a Surface,
    edges: Edges,
    /// The hull of the corners, computed at first use, since most surfaces do not need it; `None` where all corners
    /// lie in one plane.
    hull: OnceCell<Option<Hull>>,
}

impl<'a> SolidSearch<'a> {
    pub fn of(surface: &'a Surface) -> Self {
        Self { surface, edges: Edges::of(surface), hull: OnceCell::new() }
    }

    fn hull(&self) -> Option<&Hull> {
        self.hull.get_or_init(|| Hull::of(self.surface)).as_ref()
    }

    /// Returns the solid that reproduces the surface up to the noise of careless modelling; `None` where there is no
    /// such solid.
    pub fn exact(&self) -> Option<MatchingSolid> {
        let size = self.surface.size();
        let mut limits = NOISE.iter().map(|noise| Limits { tolerance: noise * size, same: SAME });
        let mut failed = vec![];
        let mut tried = |limits| self.gathered(limits).map_err(|found| failed.push((limits, found))).ok();
        let planar = limits.next().and_then(&mut tried);
        if planar.is_none() {
            let regions = NOISE[1..].iter().filter_map(|noise| self.flat_regions(self.surface, noise * size));
            if let Some(scan) = scanned(self.surface, MOST_FACETS, regions) {
                return Some(self.of_scan(scan));
            }
        }
        let first = planar.or_else(|| limits.by_ref().find_map(tried));
        let settled = || failed.into_iter().find_map(|(limits, found)| self.put_right(found?, limits));
        let mut best = first.or_else(settled)?;
        // Noise may have divided facets that stay whole at a larger tolerance.
        let limit = AS_GOOD * best.deviation;
        let further = if is_split(&best) { FURTHER } else { 0 };
        for next in limits.take(further).filter_map(|limits| self.gathered(limits).ok()) {
            let (count, least) = (next.polytope.facets().len(), best.polytope.facets().len());
            let is_closer = next.deviation < best.deviation;
            if next.deviation <= limit && (count < least || (count == least && is_closer)) {
                best = next;
            }
        }
        Some(best)
    }

    /// Returns the hull, where the surface is meant to be its hull.
    pub fn meant(&self) -> Option<MatchingSolid> {
        self.hull()?.meant(self.surface)
    }

    /// Returns the solid of a scan with its triangles assigned to the facets that they lie on.
    fn of_scan(&self, scan: ScannedSolid) -> MatchingSolid {
        let ScannedSolid { polytope, deviation, noise, errors, are_bent } = scan;
        let planes: Vec<Plane> = polytope.planes().collect();
        let of = facet_of_triangles(self.surface, &polytope);
        let fit = |f: &Facet| PlaneFit {
            plane: f.plane,
            area: polytope.facet_area(f),
            width: polytope.facet_width(f),
        };
        let fits = polytope.facets().iter().map(fit).collect();
        // The facets' sources are the planes of the fits.
        let polytope = Polytope::from_planes(&planes).unwrap_or(polytope);
        MatchingSolid {
            found: Regions { of, fits },
            polytope,
            deviation,
            tolerance: SAME * noise,
            errors: Some(errors),
            are_bent,
        }
    }

    /// Returns the solid between the planes of regions of one tolerance, if it reproduces the surface. Where
    /// necessary, the planes are corrected with the hull.
    pub fn solid(&self, limits: Limits) -> Option<MatchingSolid> {
        match self.gathered(limits) {
            Ok(solid) => Some(solid),
            Err(found) => self.put_right(found?, limits),
        }
    }

    /// Returns the solid between the planes of regions after their correction with the hull, if it reproduces the
    /// surface.
    fn put_right(&self, found: Regions, limits: Limits) -> Option<MatchingSolid> {
        let found = settle::settled(self.surface, &self.edges, self.hull()?, found, limits.tolerance)?;
        self.reproduced(found, limits).ok()
    }

    /// Returns the solid between the planes of regions as they were gathered, if it reproduces the surface.
    ///
    /// Otherwise it returns those regions, unless there are too many or the surface is round.
    fn gathered(&self, limits: Limits) -> Result<MatchingSolid, Option<Regions>> {
        let found = self.flat_regions(self.surface, limits.tolerance).ok_or(None)?;
        self.reproduced(found, limits).map_err(Some)
    }

    /// Returns the regions of this surface, or of a copy with other corners; `None` where there are too many or the
    /// surface is round.
    fn flat_regions(&self, surface: &Surface, tolerance: f64) -> Option<Regions> {
        let found = regions(surface, &self.edges, tolerance, MOST_FACETS)?;
        (!is_round(surface, &self.edges, &found, tolerance)).then_some(found)
    }

    /// Returns the solid between the planes of regions, if it reproduces the surface; otherwise returns the regions.
    fn reproduced(&self, found: Regions, limits: Limits) -> Result<MatchingSolid, Regions> {
        let Limits { tolerance, same } = limits;
        let planes: Vec<Plane> = found.fits.iter().map(|f| f.plane).collect();
        let Ok(polytope) = Polytope::from_planes(&planes) else { return Err(found) };
        let deviation = deviation(&polytope, &self.surface.vertices);
        let swelling = (polytope.volume() - self.surface.volume()).abs();
        let is_same = deviation <= same * tolerance && swelling <= SAME * tolerance * polytope.surface_area();
        if is_same {
            Ok(MatchingSolid { found, polytope, deviation, tolerance, errors: None, are_bent: vec![] })
        } else {
            Err(found)
        }
    }
}

/// Returns for each triangle the facet that its middle is farthest outside of.
pub(super) fn facet_of_triangles(surface: &Surface, solid: &Polytope) -> Vec<u32> {
    let planes: Vec<Plane> = solid.planes().collect();
    let middle = |t: usize| surface.corners(t).iter().sum::<DVec3>() / 3.0;
    let facet = |t| outermost(&planes, middle(t)).0 as u32;
    (0..surface.triangles.len()).into_par_iter().map(facet).collect()
}

/// Returns whether some neighbouring facets differ in direction by no more than noise could turn the halves of one
/// facet.
fn is_split(solid: &MatchingSolid) -> bool {
    let facets = solid.polytope.facets();
    let fit = |f: &Facet| solid.found.fits[f.source];
    let near = |f: &Facet, g: &Facet| {
        let (f, g) = (fit(f), fit(g));
        let noise = solid.tolerance * (1.0 / f.width + 1.0 / g.width);
        (f.plane.normal - g.plane.normal).length() < NEARLY_ONE * noise
    };
    facets.iter().any(|f| f.neighbours.iter().any(|&n| near(f, &facets[n as usize])))
}

/// Returns whether the surface turns outward within regions and not only at their edges. Noise turns it inward as
/// much as outward.
fn is_round(surface: &Surface, edges: &Edges, found: &Regions, tolerance: f64) -> bool {
    // The normal of a sliver is only noise, so the normal of its region is used.
    let unit = |t: usize| match found.of[t] {
        region if region != NOWHERE && is_sliver(surface, t, tolerance) => {
            found.fits[region as usize].plane.normal
        }
        _ => surface.area_vector(t).normalize_or_zero(),
    };
    let units: Vec<DVec3> = (0..surface.triangles.len()).map(unit).collect();
    let (mut within, mut whole) = (0.0, 0.0);
    for (t, k, n) in edges.pairs() {
        let corners = surface.corners(t);
        let outward = units[n] - units[t];
        // At an edge that bends outward, the two normals point away from each other.
        let across = surface.corners(n).iter().sum::<DVec3>() - corners.iter().sum::<DVec3>();
        let turn =
            (corners[(k + 1) % 3] - corners[k]).length() * outward.length().copysign(outward.dot(across));
        whole += turn;
        within += if found.of[t] == found.of[n] { turn } else { 0.0 };
    }
    within > ROUND * whole
}
