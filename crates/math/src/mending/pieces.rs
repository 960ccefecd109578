//! Leaves out the pieces of a surface that stay open, such as a backdrop beside a stone, and keeps the closed ones.

use super::parts::{name, taken};
use super::{CRACKS, Mended, SurfaceError, weld};
use crate::Surface;
use crate::edges::{Edges, ends};
use glam::DVec3;
use std::collections::{BTreeMap, HashMap};

/// The most pieces that are mended one by one; more of them are rubble.
const MOST_PIECES: usize = 1_000;

/// A piece is nearly closed if the square of its rim's length is less than this many times its area: a shell with a hole in
/// it, and not a sheet (16 for a square) or a dome (6.3 for half a sphere).
const NEARLY_CLOSED: f64 = 3.0;

/// A piece of a surface that cannot be closed.
#[derive(Debug, Clone, PartialEq)]
pub struct OpenPiece {
    /// The name of the groups that most of its triangles have; may be empty.
    pub name: String,
    /// The number of its triangles.
    pub triangles: usize,
    /// Its lengths along the axes, in the surface's unit.
    pub extent: DVec3,
}

impl Surface {
    /// Mends the surface as [`mend`](Self::mend) does. Where it is open, the pieces that cannot be closed are left out, if
    /// others can: then they are returned beside the rest.
    ///
    /// # Errors
    /// Fails as [`mend`](Self::mend) does where no piece can be closed, or where a large open piece is closed but for a
    /// hole, and is perhaps the solid that is meant.
    pub fn mend_closed(&self) -> Result<(Mended, Vec<OpenPiece>), SurfaceError> {
        let whole = match self.mend() {
            Ok(mended) => return Ok((mended, vec![])),
            Err(error @ SurfaceError::Open { .. }) => error,
            Err(error) => return Err(error),
        };
        let exact = weld::exactly(self);
        let pieces = pieces(&exact);
        if pieces.len() < 2 || pieces.len() > MOST_PIECES {
            return Err(whole);
        }
        let (mut closed, mut open, mut largest) = (vec![], vec![], 0.0_f64);
        for piece in &pieces {
            let own = taken(&exact, piece.iter().map(|&t| t as usize));
            match own.mend() {
                Ok(mended) => {
                    largest = largest.max(mended.surface.area());
                    closed.extend(piece.iter().copied());
                }
                Err(_) => open.push((piece, own)),
            }
        }
        if closed.is_empty() || open.iter().any(|(_, own)| own.area() >= largest && is_nearly_closed(own)) {
            return Err(whole);
        }
        closed.sort_unstable();
        let mended = taken(&exact, closed.into_iter().map(|t| t as usize)).mend()?;
        let open = open.into_iter().map(|(piece, own)| {
            let (low, high) = own.bounds();
            OpenPiece { name: name(&exact, piece), triangles: piece.len(), extent: high - low }
        });
        Ok((mended, open.collect()))
    }
}

fn is_nearly_closed(surface: &Surface) -> bool {
    let length = |[a, b]: [u32; 2]| surface.vertices[a as usize].distance(surface.vertices[b as usize]);
    let rim: f64 = Edges::of(surface).open.into_iter().map(length).sum();
    rim * rim < NEARLY_CLOSED * surface.area()
}

/// Returns the triangles of each connected piece: triangles that share an edge, or whose open edges are no farther apart than
/// the widest crack.
fn pieces(surface: &Surface) -> Vec<Vec<u32>> {
    let mut joined = Joined { parent: (0..surface.triangles.len() as u32).collect() };
    let mut first = HashMap::<[u32; 2], u32>::new();
    for (t, corners) in (0..).zip(&surface.triangles) {
        for k in 0..3 {
            let other = *first.entry(ends(corners, k)).or_insert(t);
            joined.join(t, other);
        }
    }
    let mut near = surface.clone();
    weld::along_gaps(&mut near, CRACKS[CRACKS.len() - 1] * surface.size());
    let open = Edges::of(surface).open;
    let loose: std::collections::HashSet<u32> = open.into_iter().flatten().collect();
    let mut at = HashMap::<u32, u32>::new();
    for (t, (corners, welded)) in (0..).zip(surface.triangles.iter().zip(&near.triangles)) {
        for (_, welded) in corners.iter().zip(welded).filter(|(corner, _)| loose.contains(corner)) {
            let other = *at.entry(*welded).or_insert(t);
            joined.join(t, other);
        }
    }
    let mut pieces = BTreeMap::<u32, Vec<u32>>::new();
    for t in 0..surface.triangles.len() as u32 {
        pieces.entry(joined.root(t)).or_default().push(t);
    }
    pieces.into_values().collect()
}

/// Sets of triangles, each known by its first one.
struct Joined {
    parent: Vec<u32>,
}

impl Joined {
    fn root(&mut self, t: u32) -> u32 {
        let mut root = t;
        while self.parent[root as usize] != root {
            let above = self.parent[root as usize];
            self.parent[root as usize] = self.parent[above as usize];
            root = above;
        }
        root
    }

    fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.parent[a.max(b) as usize] = a.min(b);
    }
}
