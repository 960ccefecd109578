//! Finds the solid that a closed surface stands for: the convex one between the planes of its facets, or another.

use super::change::Change;
use super::edges::{Edges, NONE};
use super::hull::{Hull, LazyHull};
use super::regions::{NOWHERE, Regions, is_sliver, regions};
use super::{Surface, noise, settle};
use crate::math::{Facet, Plane, Polytope};
use glam::DVec3;
use rayon::prelude::*;

/// The tolerances tried one after the other, as parts of the size: from the rounding of f32 to a thousandth, the noise that
/// careless modelling leaves.
pub(super) const NOISE: [f64; 7] = [1e-6, 1e-5, 4e-5, 1e-4, 2e-4, 4e-4, 1e-3];

/// The tolerances for scans, which count only where noise is what moves corners off their planes.
const SCANS: [f64; 5] = [4e-4, 1e-3, 1.5e-3, 2e-3, 4e-3];

/// A solid reproduces a surface if no corner lies farther from the solid's surface than this many tolerances: a corner may
/// be one tolerance off its own plane and, where regions were joined, three.
pub(super) const SAME: f64 = 3.0;

/// How far a scan's corners may lie from the solid, as a part of the size: noise hides a culet that is narrower than that.
const SAME_SCAN: f64 = 6e-3;

/// A solid at a larger tolerance is better if it has fewer facets, or as many that lie closer, and its deviation is within
/// this many times that of the first solid found.
///
/// Halves of a facet have few corners and fit them too well: whole facets lie up to 3.3 times as far off. At 4 the small
/// facets of a real princess (deepar-princess.obj) are lost.
const AS_GOOD: f64 = 3.5;
/// How many of the next larger tolerances are tried for a better solid.
const FURTHER: usize = 2;

/// Neighbouring facets may be one facet that noise has split if their angle is less than this many tolerances make at the
/// width of each.
const NEARLY_ONE: f64 = 10.0;

/// The most facets of a solid. A surface with more is curved, and cutting it takes too long.
const MOST_FACETS: usize = 2_500;

/// A surface is round if more than this part of its turning lies within regions and not between them.
const ROUND: f64 = 0.1;

/// A region and a group of the file are the same if they share this part of the area of each.
const ONE: f64 = 0.99;

/// A facet that was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Face {
    /// The plane, with [`Faceted::centre`] as its origin.
    pub plane: Plane,
    /// The area of its triangles.
    pub area: f64,
    /// The name that the file gives the facet, where one of the file's groups is exactly this facet.
    pub name: Option<String>,
}

/// A surface that is a convex solid between planes. Lengths are in the surface's unit.
#[derive(Debug, Clone, PartialEq)]
pub struct Faceted {
    /// The surface, with its `centre` moved to the origin.
    pub surface: Surface,
    /// Where the origin of the planes lies in the surface's own frame.
    pub centre: DVec3,
    /// The facets, the largest first, in the order of the facets of `polytope`.
    pub faces: Vec<Face>,
    /// The solid between the planes, with the centre as its origin.
    pub polytope: Polytope,
    /// The greatest distance of a corner from the solid's surface.
    pub deviation: f64,
    /// The tolerance at which facets were found: their corners lie within it of their planes.
    pub tolerance: f64,
    /// The differences between the solid and a surface that is not convex itself; `None` for a surface that is convex up to
    /// a thousandth.
    pub change: Option<Change>,
}

/// The kind of solid that a closed surface stands for.
#[derive(Debug, Clone, PartialEq)]
pub enum SurfaceKind {
    /// A convex solid between planes.
    Convex(Box<Faceted>),
    /// Anything else, to be traced as triangles, just as it was given.
    Concave(Surface),
}

/// Finds the facets of a closed surface, as [`Surface::mend`] returns it.
pub fn facets(surface: Surface) -> SurfaceKind {
    let (low, high) = surface.bounds();
    let centre = (low + high) / 2.0;
    let mut moved = surface.clone();
    moved.vertices.iter_mut().for_each(|v| *v -= centre);
    let (edges, size) = (Edges::of(&moved), moved.size());
    let hull = LazyHull::of(&moved);
    let mut tolerances = NOISE.iter().map(|noise| noise * size);
    let mut failed = vec![];
    let first = tolerances.by_ref().find_map(|tolerance| {
        gathered(&moved, &edges, (tolerance, SAME)).map_err(|found| failed.push((tolerance, found))).ok()
    });
    let settled = || {
        failed
            .into_iter()
            .find_map(|(tolerance, found)| put_right(&moved, &edges, &hull, found?, (tolerance, SAME)))
    };
    let Some(mut best) = first.or_else(settled) else {
        let smooth = noise::smoothed(&moved);
        let of_scan = |noise: &f64| {
            let limits = (noise * size, SAME_SCAN / noise);
            let is_noise = |solid: &MatchingSolid| noise::is_noise(&moved, &solid.polytope);
            let rough = solid(&moved, &edges, &hull, limits).filter(is_noise);
            rough.or_else(|| of_smooth(&moved, &smooth, &edges, &hull, limits).filter(is_noise))
        };
        let scan = SCANS.iter().find_map(of_scan);
        let Some(solid) = scan.or_else(|| hull.get()?.meant(&moved)) else {
            return SurfaceKind::Concave(surface);
        };
        return SurfaceKind::Convex(Box::new(changed(moved, centre, solid)));
    };
    // Noise may have split facets that a larger tolerance keeps whole.
    let limit = AS_GOOD * best.deviation;
    let further = if is_split(&best) { FURTHER } else { 0 };
    for next in tolerances.take(further).filter_map(|t| gathered(&moved, &edges, (t, SAME)).ok()) {
        let (count, least) = (next.polytope.facets().len(), best.polytope.facets().len());
        let is_closer = next.deviation < best.deviation;
        if next.deviation <= limit && (count < least || (count == least && is_closer)) {
            best = next;
        }
    }
    SurfaceKind::Convex(Box::new(faceted(moved, centre, best)))
}

/// Returns the convex solid around a closed surface's corners, whatever lies between them.
///
/// Its facets are the surface's own where that is convex, and otherwise those of its hull.
///
/// # Errors
/// Returns [`TooCurved`] where the hull is curved: it would take too many facets.
pub fn faceted_hull(surface: Surface) -> Result<Box<Faceted>, TooCurved> {
    let surface = match facets(surface) {
        SurfaceKind::Convex(found) => return Ok(found),
        SurfaceKind::Concave(surface) => surface,
    };
    let (low, high) = surface.bounds();
    let centre = (low + high) / 2.0;
    let mut moved = surface;
    moved.vertices.iter_mut().for_each(|v| *v -= centre);
    let solid = LazyHull::of(&moved).get().and_then(Hull::solid).ok_or(TooCurved)?;
    Ok(Box::new(changed(moved, centre, solid)))
}

/// The error where the hull of a surface's corners is curved, or has too many facets.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("its convex hull is curved, or has more than {MOST_FACETS} facets")]
pub struct TooCurved;

/// Whether some neighbouring facets lean apart by no more than noise could make the halves of one facet lean.
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

/// A solid that reproduces a surface.
pub(super) struct MatchingSolid {
    pub found: Regions,
    pub polytope: Polytope,
    pub deviation: f64,
    pub tolerance: f64,
}

/// Returns the solid between the planes of regions of one tolerance, if no corner of the surface lies farther off than
/// `same` tolerances. Where needed, the planes are corrected by the hull.
pub(super) fn solid(
    surface: &Surface,
    edges: &Edges,
    hull: &LazyHull<'_>,
    (tolerance, same): (f64, f64),
) -> Option<MatchingSolid> {
    match gathered(surface, edges, (tolerance, same)) {
        Ok(solid) => Some(solid),
        Err(found) => put_right(surface, edges, hull, found?, (tolerance, same)),
    }
}

/// Returns the solid between the planes of regions after the hull has corrected them, if it reproduces the surface.
fn put_right(
    surface: &Surface,
    edges: &Edges,
    hull: &LazyHull<'_>,
    found: Regions,
    (tolerance, same): (f64, f64),
) -> Option<MatchingSolid> {
    let found = settle::settled(surface, edges, hull.get()?, found, tolerance)?;
    reproduced(surface, found, (tolerance, same)).ok()
}

/// Returns the solid between the planes of regions as they were gathered, if it reproduces the surface.
///
/// Otherwise returns those regions, unless there are too many or the surface is round.
fn gathered(
    surface: &Surface,
    edges: &Edges,
    (tolerance, same): (f64, f64),
) -> Result<MatchingSolid, Option<Regions>> {
    let found = regions(surface, edges, tolerance, MOST_FACETS).ok_or(None)?;
    if is_round(surface, edges, &found, tolerance) {
        return Err(None);
    }
    reproduced(surface, found, (tolerance, same)).map_err(Some)
}

/// Returns the solid between the planes of regions that are found on a smoother copy of the surface.
///
/// Noise tilts triangles that are small beside it so much that no region would grow from them on the surface itself.
fn of_smooth(
    surface: &Surface,
    smooth: &Surface,
    edges: &Edges,
    hull: &LazyHull<'_>,
    (tolerance, same): (f64, f64),
) -> Option<MatchingSolid> {
    let found = regions(smooth, edges, tolerance, MOST_FACETS)?;
    let found = (!is_round(smooth, edges, &found, tolerance)).then_some(found)?;
    put_right(surface, edges, hull, found, (tolerance, same))
}

/// Returns the solid between the planes of regions, if it reproduces the surface; otherwise returns the regions.
fn reproduced(
    surface: &Surface,
    found: Regions,
    (tolerance, same): (f64, f64),
) -> Result<MatchingSolid, Regions> {
    let planes: Vec<Plane> = found.fits.iter().map(|f| f.plane).collect();
    let Ok(polytope) = Polytope::from_planes(&planes) else { return Err(found) };
    let deviation = deviation(&polytope, &surface.vertices);
    let swelling = (polytope.volume() - surface.volume()).abs();
    let is_same = deviation <= same * tolerance && swelling <= SAME * tolerance * polytope.surface_area();
    if is_same { Ok(MatchingSolid { found, polytope, deviation, tolerance }) } else { Err(found) }
}

/// Returns the greatest distance of points from a solid's surface.
///
/// For a point outside, it is the distance from the plane that the point is farthest outside of.
pub fn deviation(polytope: &Polytope, points: &[DVec3]) -> f64 {
    let planes: Vec<Plane> = polytope.planes().collect();
    let depth = |p: &DVec3| planes.iter().map(|plane| plane.distance(*p)).fold(f64::NEG_INFINITY, f64::max);
    points.par_iter().map(|p| depth(p).abs()).reduce(|| 0.0, f64::max)
}

/// Whether the surface turns outward within regions and not only at their edges. Noise turns it inward as much as outward.
fn is_round(surface: &Surface, edges: &Edges, found: &Regions, tolerance: f64) -> bool {
    // A sliver's own normal is noise, so the normal of its region is used.
    let unit = |t: usize| match found.of[t] {
        region if region != NOWHERE && is_sliver(surface, t, tolerance) => {
            found.fits[region as usize].plane.normal
        }
        _ => surface.area_vector(t).normalize_or_zero(),
    };
    let (mut within, mut whole) = (0.0, 0.0);
    for (t, neighbours) in edges.neighbours.iter().enumerate() {
        let (corners, normal) = (surface.corners(t), unit(t));
        for (k, &n) in neighbours.iter().enumerate().filter(|(_, n)| **n != NONE && **n > t as u32) {
            let outward = unit(n as usize) - normal;
            // Across an edge that stands out, normals lean apart.
            let across = surface.corners(n as usize).iter().sum::<DVec3>() - corners.iter().sum::<DVec3>();
            let turn =
                (corners[(k + 1) % 3] - corners[k]).length() * outward.length().copysign(outward.dot(across));
            whole += turn;
            within += if found.of[t] == found.of[n as usize] { turn } else { 0.0 };
        }
    }
    within > ROUND * whole
}

/// Returns the facets of a surface that is not convex but is read as a convex solid.
fn changed(surface: Surface, centre: DVec3, solid: MatchingSolid) -> Faceted {
    let change = Change::of(&surface, &solid.polytope);
    Faceted { change: Some(change), ..faceted(surface, centre, solid) }
}

fn faceted(surface: Surface, centre: DVec3, solid: MatchingSolid) -> Faceted {
    let MatchingSolid { found, polytope, deviation, tolerance } = solid;
    let names = names(&surface, &found);
    let face =
        |r: usize| Face { plane: found.fits[r].plane, area: found.fits[r].area, name: names[r].clone() };
    let faces = polytope.facets().iter().map(|f| face(f.source)).collect();
    Faceted { surface, centre, faces, polytope, deviation, tolerance, change: None }
}

/// Returns the name of each region that is exactly one group of the file.
fn names(surface: &Surface, found: &Regions) -> Vec<Option<String>> {
    let mut shared = std::collections::BTreeMap::<(u32, u32), f64>::new();
    let mut groups = vec![0.0; surface.names.len()];
    let mut whole = vec![0.0; found.fits.len()];
    for (t, (&group, &region)) in surface.groups.iter().zip(&found.of).enumerate() {
        let area = surface.area_vector(t).length();
        groups[group as usize] += area;
        if region != NOWHERE {
            whole[region as usize] += area;
            *shared.entry((group, region)).or_default() += area;
        }
    }
    let mut names = vec![None; found.fits.len()];
    for ((group, region), area) in shared {
        let (g, r) = (group as usize, region as usize);
        if area >= ONE * groups[g] && area >= ONE * whole[r] && !surface.names[g].trim().is_empty() {
            names[r] = Some(surface.names[g].clone());
        }
    }
    names
}
