//! From triangles as a file has them to a closed surface that is turned outward.

use super::edges::Edges;
use super::fault::MOST_EDGES;
use super::{Surface, SurfaceError, orient, seams, weld};
use glam::DVec3;

/// Gaps that are closed one after the other until nothing is open, parts of the size: from the rounding of f32 to
/// a fifth of a percent, beyond which a gap is a hole.
const CRACKS: [f64; 9] = [1e-7, 1e-6, 1e-5, 5e-5, 1e-4, 2e-4, 4e-4, 1e-3, 2e-3];

/// Sizes taken, so that areas and volumes neither overflow nor vanish.
const SIZES: std::ops::RangeInclusive<f64> = 1e-60..=1e60;

/// A surface farther from the origin than this many times its size has lost its digits, even in f64.
const FARTHEST: f64 = 1e9;

/// Content below this part of the area times the size is none.
const FLAT: f64 = 1e-9;

/// A surface that is closed and turned outward, and what was done to it.
#[derive(Debug, Clone, PartialEq)]
pub struct Mended {
    /// Welded, without copies; every edge has an even number of triangles.
    pub surface: Surface,
    /// What had to be mended.
    pub mending: Mending,
}

/// What had to be mended of a surface.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Mending {
    /// Corners that were one with another, or of no triangle.
    pub welded: usize,
    /// Triangles without three corners of their own, left out.
    pub degenerate: usize,
    /// Copies of other triangles, left out.
    pub copies: usize,
    /// The widest gap that was closed, in the surface's unit; 0 where there was none.
    pub crack: f64,
    /// Pieces that triangles were split into, at corners that lay on their edges.
    pub seams: usize,
    /// Triangles that ran clockwise.
    pub turned: usize,
    /// Connected parts.
    pub shells: usize,
}

impl Surface {
    /// The same surface closed: corners welded, triangles without area and copies of others left out, cracks of up to
    /// 0.2 % of the size closed, all triangles turned outward.
    ///
    /// # Errors
    /// What cannot be mended: numbers that are none, holes (with the ends of their edges), one side only.
    pub fn mend(&self) -> Result<Mended, SurfaceError> {
        self.check()?;
        let size = self.size();
        let exact = weld::exactly(self);
        let mut mending = Mending::default();
        let (mut surface, edges) = close(&exact, size, &mut mending)?;
        (mending.turned, mending.shells) = orient::outward(&mut surface, &edges)?;
        if surface.triangles.len() < self.triangles.len() || mending.crack > 0.0 {
            surface = weld::exactly(&surface);
        }
        mending.welded = self.vertices.len() - surface.vertices.len().min(self.vertices.len());
        if surface.volume().abs() <= FLAT * surface.area() * size {
            return Err(SurfaceError::Flat);
        }
        Ok(Mended { surface, mending })
    }

    /// What makes every other step safe: numbers, numbering and scale.
    fn check(&self) -> Result<(), SurfaceError> {
        let vertices = self.vertices.len();
        for (triangle, &vertex) in
            self.triangles.iter().enumerate().flat_map(|(t, c)| c.iter().map(move |v| (t, v)))
        {
            match self.vertices.get(vertex as usize) {
                None => return Err(SurfaceError::Index { triangle, vertex, vertices }),
                Some(at) if !at.is_finite() => {
                    return Err(SurfaceError::NotFinite { vertex: vertex as usize, at: *at });
                }
                Some(_) => {}
            }
        }
        let (low, high) = self.bounds();
        let (size, distance) = (self.size(), ((low / 2.0) + (high / 2.0)).length());
        if self.triangles.is_empty() || size == 0.0 {
            return Err(SurfaceError::Empty);
        }
        let scaled = SIZES.contains(&size) && distance <= FARTHEST * size;
        if scaled { Ok(()) } else { Err(SurfaceError::OutOfScale { size, distance }) }
    }
}

/// Closes ever wider gaps until no edge is open.
fn close(exact: &Surface, size: f64, mending: &mut Mending) -> Result<(Surface, Edges), SurfaceError> {
    let mut first_open = None;
    for crack in std::iter::once(0.0).chain(CRACKS.map(|part| part * size)) {
        let mut surface = exact.clone();
        if crack > 0.0 {
            weld::along_gaps(&mut surface, crack);
        }
        let (mut degenerate, mut copies) = weld::tidy(&mut surface);
        let mut edges = Edges::of(&surface);
        let mut pieces = 0;
        if crack > 0.0 && !edges.open.is_empty() {
            pieces = seams::split(&mut surface, crack);
            let more = weld::tidy(&mut surface);
            (degenerate, copies) = (degenerate + more.0, copies + more.1);
            edges = Edges::of(&surface);
        }
        if surface.triangles.is_empty() {
            break;
        }
        if edges.open.is_empty() {
            *mending = Mending { degenerate, copies, crack, seams: pieces, ..*mending };
            return Ok((surface, edges));
        }
        first_open = Some((surface, edges));
    }
    let Some((surface, edges)) = first_open else { return Err(SurfaceError::Empty) };
    let mut open: Vec<[DVec3; 2]> =
        edges.open.iter().map(|e| e.map(|v| surface.vertices[v as usize])).collect();
    let count = open.len();
    open.sort_by(|p, q| q[0].distance(q[1]).total_cmp(&p[0].distance(p[1])));
    open.truncate(MOST_EDGES);
    Err(SurfaceError::Open { count, edges: open, crack: CRACKS[CRACKS.len() - 1] * size })
}
