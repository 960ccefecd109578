//! Finds the facets of a surface: groups of neighbouring triangles in one plane.

use super::{Plane, Surface, TriangleMeshError};
use glam::DVec3;
use rayon::prelude::*;

/// A triangle lies in a plane if none of its corners is farther from it than this part of the solid's size: about ten
/// roundings of the f32 in which files store corners.
const FLAT: f64 = 1e-6;

/// The cosine of the greatest angle between a triangle of a facet and the facet's plane.
///
/// The angle is far greater than rounding turns any triangle but a sliver, and less than a fold. A sliver belongs to
/// the plane in which it lies, whatever the direction of its normal.
const NOT_FOLDED: f64 = 0.9;

/// The mark of a triangle that has no facet yet.
const NONE: u32 = u32::MAX;

/// Returns the facet of each triangle. Facets are numbered in the order of their first triangles.
///
/// # Errors
/// Fails with [`TriangleMeshError::Open`] where the surface is open.
pub(super) fn regions(surface: &Surface) -> Result<Vec<u32>, TriangleMeshError> {
    let neighbours = neighbours(&surface.triangles)?;
    let twice_areas: Vec<DVec3> = (0..surface.triangles.len()).map(|t| twice_area(surface, t)).collect();
    let size = surface.vertices.iter().map(|v| v.length()).fold(0.0, f64::max);
    // Facets grow from the largest triangles outward, because their planes are the most accurate.
    let mut seeds: Vec<u32> = (0..surface.triangles.len() as u32).collect();
    let area = |k: u32| twice_areas[k as usize].length_squared();
    seeds.par_sort_by(|&a, &b| area(b).total_cmp(&area(a)));
    let mut facets = vec![NONE; surface.triangles.len()];
    let mut edge = vec![];
    for seed in seeds {
        if facets[seed as usize] != NONE {
            continue;
        }
        let normal = twice_areas[seed as usize].normalize_or_zero();
        let plane = Plane { normal, offset: normal.dot(surface.corners(seed as usize)[0]) };
        facets[seed as usize] = seed;
        edge.push(seed);
        while let Some(k) = edge.pop() {
            for &next in &neighbours[k as usize] {
                let own = twice_areas[next as usize];
                let is_turned = own.dot(normal) < NOT_FOLDED * own.length();
                let is_near = |corner: &DVec3| plane.distance(*corner).abs() <= FLAT * size;
                let is_flat = surface.corners(next as usize).iter().all(is_near);
                let is_sliver = own.length() <= FLAT * size * surface.longest_edge(next as usize);
                if facets[next as usize] == NONE && is_flat && (!is_turned || is_sliver) {
                    facets[next as usize] = seed;
                    edge.push(next);
                }
            }
        }
    }
    Ok(renumbered(facets))
}

/// Returns the plane of each facet: the mean of its triangles' planes, weighted by area.
pub(super) fn planes_of(surface: &Surface, facets: &[u32]) -> Vec<Plane> {
    let count = facets.iter().max().map_or(0, |&last| last as usize + 1);
    let mut sums = vec![(DVec3::ZERO, DVec3::ZERO, 0.0); count];
    for (t, &facet) in facets.iter().enumerate() {
        let (area, sum) = (twice_area(surface, t), &mut sums[facet as usize]);
        let middle = surface.corners(t).iter().sum::<DVec3>() / 3.0;
        sum.0 += area;
        sum.1 += middle * area.length();
        sum.2 += area.length();
    }
    let plane = |(area, middle, weight): (DVec3, DVec3, f64)| {
        let normal = area.normalize_or(DVec3::Z);
        // A facet without area is never met by a ray, so any plane serves.
        let middle = if weight > 0.0 { middle / weight } else { DVec3::ZERO };
        Plane { normal, offset: normal.dot(middle) }
    };
    sums.into_iter().map(plane).collect()
}

fn twice_area(surface: &Surface, triangle: usize) -> DVec3 {
    2.0 * surface.area_vector(triangle)
}

/// Returns the triangle across each edge of each triangle. Every edge must have as many triangles on one side as on the
/// other.
pub(super) fn neighbours(triangles: &[[u32; 3]]) -> Result<Vec<[u32; 3]>, TriangleMeshError> {
    // Each entry holds an edge, then true if its triangle runs along it from the higher corner, then the triangle,
    // and the place of the edge in the triangle.
    let edges_of = |(k, t): (usize, &[u32; 3])| {
        let t = *t;
        [0, 1, 2].map(|i| {
            let (a, b) = (t[i], t[(i + 1) % 3]);
            ((a.min(b), a.max(b)), a > b, k as u32, i)
        })
    };
    let mut edges: Vec<_> = triangles.par_iter().enumerate().flat_map_iter(edges_of).collect();
    edges.par_sort_unstable();
    let mut neighbours: Vec<[u32; 3]> = (0..triangles.len() as u32).map(|k| [k; 3]).collect();
    for same in edges.chunk_by(|a, b| a.0 == b.0) {
        let up = same.partition_point(|e| !e.1);
        if 2 * up != same.len() {
            return Err(TriangleMeshError::Open(same[0].0.0, same[0].0.1));
        }
        for (a, b) in same[..up].iter().zip(&same[up..]) {
            neighbours[a.2 as usize][a.3] = b.2;
            neighbours[b.2 as usize][b.3] = a.2;
        }
    }
    Ok(neighbours)
}

fn renumbered(mut facets: Vec<u32>) -> Vec<u32> {
    let (mut number, mut count) = (vec![NONE; facets.len()], 0);
    for facet in &mut facets {
        let own = &mut number[*facet as usize];
        if *own == NONE {
            *own = count;
            count += 1;
        }
        *facet = *own;
    }
    facets
}
