//! The edges of a surface and the triangles that meet there.

use super::Surface;
use rayon::slice::ParallelSliceMut;

/// The mark of an edge that has no triangle across it, or more than one.
pub(super) const NONE: u32 = u32::MAX;

/// The edges of a surface; edge k of a triangle begins at its corner k.
pub(super) struct Edges {
    /// The triangle across each edge of each triangle, or [`NONE`].
    pub neighbours: Vec<[u32; 3]>,
    /// The edges with an odd number of triangles, sorted, lower corner first.
    pub open: Vec<[u32; 2]>,
}

impl Edges {
    pub fn of(surface: &Surface) -> Self {
        let mut sides: Vec<([u32; 2], u32)> = Vec::with_capacity(3 * surface.triangles.len());
        for (t, corners) in (0..).zip(&surface.triangles) {
            sides.extend((0..3).map(|k| (ends(corners, k), 3 * t + k as u32)));
        }
        sides.par_sort_unstable();
        let mut neighbours = vec![[NONE; 3]; surface.triangles.len()];
        let mut open = vec![];
        for same in sides.chunk_by(|a, b| a.0 == b.0) {
            if let [(_, one), (_, other)] = same {
                neighbours[*one as usize / 3][*one as usize % 3] = other / 3;
                neighbours[*other as usize / 3][*other as usize % 3] = one / 3;
            } else if same.len() % 2 == 1 {
                open.push(same[0].0);
            }
        }
        Self { neighbours, open }
    }

    /// Returns each pair of neighbouring triangles once, with the place of their edge in the first of them.
    pub fn pairs(&self) -> impl Iterator<Item = (usize, usize, usize)> {
        self.neighbours.iter().enumerate().flat_map(|(t, beside)| {
            let later = move |(_, n): &(usize, &u32)| **n != NONE && **n as usize > t;
            beside.iter().enumerate().filter(later).map(move |(k, &n)| (t, k, n as usize))
        })
    }
}

/// Returns the ends of edge `k` of a triangle, the lower first.
pub(super) fn ends(corners: &[u32; 3], k: usize) -> [u32; 2] {
    let (a, b) = (corners[k], corners[(k + 1) % 3]);
    [a.min(b), a.max(b)]
}
