//! Welds corners: several corners that a file lists separately become one.

use super::Mending;
use crate::Surface;
use crate::edges::{Edges, ends};
use glam::{DVec3, I64Vec3};
use rayon::slice::ParallelSliceMut;
use std::collections::HashMap;

/// Welds corners at exactly the same place, and leaves out corners that belong to no triangle.
pub(super) fn exactly(surface: &Surface) -> Surface {
    // Adding 0 turns -0 into 0, which compares equal to it.
    let bits = |v: DVec3| (v + DVec3::ZERO).to_array().map(f64::to_bits);
    let mut number: HashMap<[u64; 3], u32> = HashMap::with_capacity(surface.vertices.len());
    let mut known = vec![u32::MAX; surface.vertices.len()];
    let mut vertices = Vec::new();
    let mut triangles = surface.triangles.clone();
    for corner in triangles.iter_mut().flatten() {
        let at = *corner as usize;
        if known[at] == u32::MAX {
            known[at] = *number.entry(bits(surface.vertices[at])).or_insert_with(|| {
                vertices.push(surface.vertices[at]);
                vertices.len() as u32 - 1
            });
        }
        *corner = known[at];
    }
    Surface { vertices, triangles, groups: surface.groups.clone(), names: surface.names.clone() }
}

/// Welds corners of open edges that lie within `gap` of one another. The welded corner is in the middle of all that
/// meet.
pub(super) fn along_gaps(surface: &mut Surface, gap: f64) {
    let mut loose: Vec<u32> = Edges::of(surface).open.into_iter().flatten().collect();
    loose.sort_unstable();
    loose.dedup();
    let mut clusters = Clusters { gap, cells: HashMap::new(), first: vec![], sum: vec![] };
    let joined: Vec<usize> = loose.iter().map(|&v| clusters.join(v, surface.vertices[v as usize])).collect();
    let mut target: Vec<u32> = (0..surface.vertices.len() as u32).collect();
    for (&v, &cluster) in loose.iter().zip(&joined) {
        target[v as usize] = clusters.first[cluster].0;
    }
    for (&(first, _), &(sum, count)) in clusters.first.iter().zip(&clusters.sum) {
        surface.vertices[first as usize] = sum / count;
    }
    surface.triangles.iter_mut().flatten().for_each(|v| *v = target[*v as usize]);
}

/// Points gathered into clusters around the first point of each. These first points are farther apart than the gap,
/// so a cell holds few of them.
struct Clusters {
    gap: f64,
    cells: HashMap<I64Vec3, Vec<usize>>,
    first: Vec<(u32, DVec3)>,
    sum: Vec<(DVec3, f64)>,
}

impl Clusters {
    fn join(&mut self, vertex: u32, at: DVec3) -> usize {
        // Cells are twice the gap wide, so that all within the gap lie in the eight around the nearest cell corner.
        let corner = (at / (2.0 * self.gap)).round().as_i64vec3();
        let around = (0..8).map(|i| corner - I64Vec3::new(i & 1, i >> 1 & 1, i >> 2 & 1));
        let near = around.filter_map(|cell| self.cells.get(&cell)).flatten().copied();
        let distance = |c: usize| self.first[c].1.distance(at);
        let nearest = near.min_by(|&a, &b| distance(a).total_cmp(&distance(b)).then(a.cmp(&b)));
        let cluster = match nearest.filter(|&c| distance(c) <= self.gap) {
            Some(cluster) => cluster,
            None => {
                self.first.push((vertex, at));
                self.sum.push((DVec3::ZERO, 0.0));
                let own = (at / (2.0 * self.gap)).floor().as_i64vec3();
                self.cells.entry(own).or_default().push(self.first.len() - 1);
                self.first.len() - 1
            }
        };
        let (sum, count) = self.sum[cluster];
        self.sum[cluster] = (sum + at, count + 1.0);
        cluster
    }
}

/// Leaves out triangles with fewer than three distinct corners, and copies of a triangle in either sense, and counts
/// both.
///
/// One of several copies is kept, unless the surface would then have an odd number of triangles at its edges: the two
/// sides of a flat sheet enclose nothing.
pub(super) fn tidy(surface: &mut Surface, mending: &mut Mending) {
    let key = |(t, corners): (u32, &[u32; 3])| {
        let mut key = *corners;
        key.sort_unstable();
        (key, t)
    };
    let mut keys: Vec<([u32; 3], u32)> = (0..).zip(&surface.triangles).map(key).collect();
    keys.par_sort_unstable();
    let mut keep = vec![true; keys.len()];
    let mut copied = vec![];
    for same in keys.chunk_by(|a, b| a.0 == b.0) {
        let [a, b, c] = same[0].0;
        let thin = a == b || b == c;
        let dropped = if thin { same } else { &same[1..] };
        copied.extend((!thin && !dropped.is_empty()).then_some(same[0].0));
        dropped.iter().for_each(|(_, t)| keep[*t as usize] = false);
        *(if thin { &mut mending.degenerate } else { &mut mending.copies }) += dropped.len();
    }
    retain(surface, &keep);
    mending.copies += flat_left(surface, &copied);
}

/// Leaves out the triangles with these corners all of whose edges are open, and returns their number. `copied` is
/// sorted, and so are the corners in each of its triangles.
fn flat_left(surface: &mut Surface, copied: &[[u32; 3]]) -> usize {
    if copied.is_empty() {
        return 0;
    }
    let open = Edges::of(surface).open;
    let is_open = |edge: [u32; 2]| open.binary_search(&edge).is_ok();
    let is_flat = |t: &[u32; 3]| {
        let mut key = *t;
        key.sort_unstable();
        (0..3).all(|k| is_open(ends(t, k))) && copied.binary_search(&key).is_ok()
    };
    let keep: Vec<bool> = surface.triangles.iter().map(|t| !is_flat(t)).collect();
    retain(surface, &keep);
    keep.iter().filter(|keep| !**keep).count()
}

/// Leaves out the triangles for which `keep` is false.
fn retain(surface: &mut Surface, keep: &[bool]) {
    let mut keeps = keep.iter();
    surface.triangles.retain(|_| keeps.next() == Some(&true));
    let mut keeps = keep.iter();
    surface.groups.retain(|_| keeps.next() == Some(&true));
}
