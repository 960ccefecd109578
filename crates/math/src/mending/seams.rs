//! Splits triangles along seams where one side has corners that the other side lacks.

use crate::Surface;
use crate::edges::{Edges, ends};
use std::collections::HashMap;

/// The greatest number of open edges among which seams are sought. The search compares each edge with the corners
/// that could lie on it, and a surface with more open edges is not cracked but rubble.
const MOST_OPEN: usize = 5_000;

/// The greatest number of rounds in which the pieces of a triangle are divided again. Each edge is divided once;
/// without a limit, rubble could be divided endlessly.
const MOST_ROUNDS: u32 = 3;

/// Divides triangles with open edges at the corners of other open edges that lie on them within `gap`. Returns the
/// number of corners that were inserted.
pub(super) fn split(surface: &mut Surface, gap: f64) -> usize {
    let open = Edges::of(surface).open;
    if open.len() > MOST_OPEN {
        return 0;
    }
    let mut loose: Vec<u32> = open.iter().flatten().copied().collect();
    loose.sort_by(|&a, &b| x(surface, a).total_cmp(&x(surface, b)).then(a.cmp(&b)));
    loose.dedup();
    let between: HashMap<[u32; 2], Vec<u32>> = open
        .iter()
        .map(|&edge| (edge, passed(surface, edge, &loose, gap)))
        .filter(|(_, list)| !list.is_empty())
        .collect();
    let before = surface.triangles.len();
    // A triangle is replaced by its pieces, each of which may have another edge to divide.
    for t in 0..before {
        split_one(surface, t, &between, MOST_ROUNDS);
    }
    surface.triangles.len() - before
}

fn x(surface: &Surface, vertex: u32) -> f64 {
    surface.vertices[vertex as usize].x
}

/// Returns the corners that lie on an edge, in order from its lower to its higher end.
fn passed(surface: &Surface, [a, b]: [u32; 2], loose: &[u32], gap: f64) -> Vec<u32> {
    let (from, to) = (surface.vertices[a as usize], surface.vertices[b as usize]);
    let along = to - from;
    let (low, high) = (from.x.min(to.x) - gap, from.x.max(to.x) + gap);
    let start = loose.partition_point(|&v| x(surface, v) < low);
    let near = loose[start..].iter().copied().take_while(|&v| x(surface, v) <= high);
    let mut on: Vec<(f64, u32)> = near
        .filter(|&v| v != a && v != b)
        .map(|v| ((surface.vertices[v as usize] - from).dot(along) / along.length_squared(), v))
        .filter(|&(part, v)| {
            let inside = part > 0.0 && part < 1.0;
            inside && (from + along * part).distance(surface.vertices[v as usize]) <= gap
        })
        .collect();
    on.sort_by(|p, q| p.0.total_cmp(&q.0).then(p.1.cmp(&q.1)));
    on.into_iter().map(|(_, v)| v).collect()
}

fn split_one(surface: &mut Surface, triangle: usize, between: &HashMap<[u32; 2], Vec<u32>>, rounds: u32) {
    let corners = surface.triangles[triangle];
    let split = |k: &usize| rounds > 0 && between.contains_key(&ends(&corners, *k));
    let Some(k) = (0..3).find(split) else { return };
    let [a, b, c] = [corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3]];
    let mut chain = between[&ends(&corners, k)].clone();
    chain.retain(|&v| v != c);
    if chain.is_empty() {
        return;
    }
    if a > b {
        chain.reverse();
    }
    surface.triangles[triangle] = [a, chain[0], c];
    split_one(surface, triangle, between, rounds - 1);
    let group = surface.groups[triangle];
    for (place, from) in chain.iter().enumerate() {
        surface.triangles.push([*from, chain.get(place + 1).copied().unwrap_or(b), c]);
        surface.groups.push(group);
        let last = surface.triangles.len() - 1;
        split_one(surface, last, between, rounds - 1);
    }
}
