//! What solid a closed surface is: the convex one between its facets' planes, or another.

use super::change::Change;
use super::edges::{Edges, NONE};
use super::hull::{Hull, LazyHull};
use super::regions::{NOWHERE, Regions, is_sliver, regions};
use super::{Surface, noise, settle};
use crate::math::{Facet, Plane, Polytope};
use glam::DVec3;
use rayon::prelude::*;

/// Tolerances tried one after the other, parts of the size: from the rounding of f32 to a thousandth, the noise that
/// careless modelling leaves.
pub(super) const NOISE: [f64; 7] = [1e-6, 1e-5, 4e-5, 1e-4, 2e-4, 4e-4, 1e-3];

/// Tolerances for scans, which are taken only where noise is what moves corners off their planes.
const SCANS: [f64; 5] = [4e-4, 1e-3, 1.5e-3, 2e-3, 4e-3];

/// A solid whose surface no corner leaves by more than this many tolerances is the surface: a corner may be one off
/// its own plane and, where regions were joined, three.
pub(super) const SAME: f64 = 3.0;

/// How far a scan's corners may leave the solid, a part of the size: noise hides a culet that is less wide than that.
const SAME_SCAN: f64 = 6e-3;

/// Fewer facets, or as many that lie closer, are better where they fit within this many times the deviation of the first
/// solid found, at one of the `FURTHER` next tolerances. Halves of a facet have few corners and fit them too well: those
/// that are whole lie up to 3.3 times as far off. At 4 the small facets of a real princess (deepar-princess.obj) are lost.
const AS_GOOD: f64 = 3.5;
const FURTHER: usize = 2;

/// Facets that lean apart by less than this many tolerances at the width of each may be one that noise has split.
const NEARLY_ONE: f64 = 10.0;

/// The most facets of which a solid is made: beyond it is a surface that is curved, and cutting it takes too long.
const MOST_FACETS: usize = 2_500;

/// A surface that does this part of its turning within regions and not between them is round.
const ROUND: f64 = 0.1;

/// A region and a group of the file are one where they share this part of the area of each.
const ONE: f64 = 0.99;

/// A facet that was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Face {
    /// Its plane, about [`Faceted::centre`].
    pub plane: Plane,
    /// Area of its triangles.
    pub area: f64,
    /// What the file calls it, where one of its groups is just this facet.
    pub name: Option<String>,
}

/// A surface that is a convex solid between planes. Lengths in the surface's unit.
#[derive(Debug, Clone, PartialEq)]
pub struct Faceted {
    /// The surface, with its `centre` moved to the origin.
    pub surface: Surface,
    /// Where the origin of the planes lies in the surface's own frame.
    pub centre: DVec3,
    /// Its facets, the largest first, in the order of those of `polytope`.
    pub faces: Vec<Face>,
    /// The solid between them, about the centre.
    pub polytope: Polytope,
    /// How far the corner that is farthest off lies from the solid's surface.
    pub deviation: f64,
    /// Within how much of their planes the corners of facets were found.
    pub tolerance: f64,
    /// What the solid changes of a surface that is not convex itself; `None` of one that is but for a thousandth.
    pub change: Option<Change>,
}

/// What a closed surface is.
#[derive(Debug, Clone, PartialEq)]
pub enum SurfaceKind {
    /// A convex solid between planes.
    Convex(Box<Faceted>),
    /// Anything else: to be traced as triangles, as it was given.
    Concave(Surface),
}

/// Finds the facets of a closed surface, as [`Surface::mend`] answers it.
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

/// The convex solid of a closed surface's corners, whatever lies between them: its own facets where it is convex, else
/// those of its hull.
///
/// # Errors
/// Where the hull is curved: it would take too many facets.
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

/// The hull of a surface's corners is curved, or has too many facets.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("its convex hull is curved, or has more than {MOST_FACETS} facets")]
pub struct TooCurved;

/// Whether facets that are neighbours lean apart by no more than noise could make halves of one lean.
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

/// The solid between the planes of regions of one tolerance, if no corner of the surface leaves it by more than `same`
/// tolerances; the planes are put right by the hull where they need it.
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

/// The solid between the planes of regions that are put right by the hull, if it is the surface.
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

/// The same with the planes of regions as they were gathered; else those regions, where there are not too many and the
/// surface is not round.
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

/// The same with regions that are found on a smoother copy of the surface: noise tilts triangles that are small beside it
/// so much that no region would grow from them.
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

/// The solid between the planes of regions, if it is the surface; else the regions.
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

/// How far the point that is farthest off lies from a solid's surface; of a point outside, how far it lies outside
/// the plane that it is farthest outside of.
pub fn deviation(polytope: &Polytope, points: &[DVec3]) -> f64 {
    let planes: Vec<Plane> = polytope.planes().collect();
    let depth = |p: &DVec3| planes.iter().map(|plane| plane.distance(*p)).fold(f64::NEG_INFINITY, f64::max);
    points.par_iter().map(|p| depth(p).abs()).reduce(|| 0.0, f64::max)
}

/// Whether the surface turns outward within regions, not at their edges alone. Noise turns it as much inward.
fn is_round(surface: &Surface, edges: &Edges, found: &Regions, tolerance: f64) -> bool {
    // A sliver's own normal is noise: it faces as its region does.
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

/// What is found where a surface that is not convex is read as a convex solid.
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

/// The name of each region that is just one group of the file.
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
