//! Mends surfaces of triangles from files: makes them closed, and turns them outward: [`Surface::mend`].
//!
//! The steps, in their order:
//!
//! 1. coordinates, numbering and scale are checked, because all further steps rely on them;
//! 2. corners at exactly the same place become one (`weld`);
//! 3. wider and wider gaps are closed until no edge is open: corners of open edges within the gap become one
//!    (`weld`), triangles are divided where corners lie on their edges (`seams`), and triangles without area and
//!    copies are left out;
//! 4. triangles are turned to agree with their neighbours and with the outside (`orient`);
//! 5. the solids that the shells bound are told apart (`parts`).
//!
//! Of a surface that cannot be closed, [`Surface::mend_closed`] keeps the pieces that can (`pieces`).
//!
//! Lengths are in the file's own unit; tolerances are parts of [`Surface::size`].

mod fault;
mod orient;
mod parts;
mod pieces;
mod seams;
#[cfg(test)]
pub(crate) mod tests;
mod weld;

use super::Surface;
use super::edges::Edges;
use fault::MOST_EDGES;
pub use fault::SurfaceError;
use glam::DVec3;
pub use parts::SolidPart;
pub use pieces::OpenPiece;

/// The widths of gaps that are closed, tried one after the other until no edge is open, as parts of the size. They
/// range from the rounding of f32 to a fifth of a percent; a wider gap is a hole.
const CRACKS: [f64; 9] = [1e-7, 1e-6, 1e-5, 5e-5, 1e-4, 2e-4, 4e-4, 1e-3, 2e-3];

/// The range of sizes that are accepted, so that areas and volumes neither overflow nor vanish.
const SIZES: std::ops::RangeInclusive<f64> = 1e-60..=1e60;

/// A surface that is farther from the origin than this many times its size has lost its digits, even in f64.
const FARTHEST: f64 = 1e9;

/// A surface encloses nothing if its volume is below this part of its area times its size.
const FLAT: f64 = 1e-9;

/// A closed surface that is turned outward, and the repairs that made it so.
#[derive(Debug, Clone, PartialEq)]
pub struct Mended {
    /// The surface. Its corners are welded, it has no copies of triangles, and each of its edges has an even number of
    /// triangles.
    pub surface: Surface,
    /// The repairs that were necessary.
    pub mending: Mending,
    /// The solids in the surface, in the order of their first triangles. A shell that encloses nothing is none.
    pub parts: Vec<SolidPart>,
}

/// The repairs that a surface needed.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Mending {
    /// The number of corners left out because they coincided with another or belonged to no triangle.
    pub welded: usize,
    /// The number of triangles left out because they lacked three distinct corners.
    pub degenerate: usize,
    /// The number of triangles left out because they were copies of others.
    pub copies: usize,
    /// The widest gap that was closed, in the surface's unit; 0 where there was none.
    pub crack: f64,
    /// The number of triangles added by splitting others at corners that lay on their edges.
    pub seams: usize,
    /// The number of triangles that ran clockwise and were turned.
    pub turned: usize,
    /// The number of connected parts.
    pub shells: usize,
}

impl Surface {
    /// Returns the same surface, closed, with all triangles turned outward.
    ///
    /// Corners are welded, triangles without area and copies of others are left out, and cracks of up to 0.2 % of the size
    /// are closed.
    ///
    /// # Errors
    /// The error names the fault that cannot be mended: coordinates that are not finite, corners that do not exist,
    /// sizes out of scale, holes (with the ends of their edges), a surface with only one side, or one that encloses
    /// nothing.
    pub fn mend(&self) -> Result<Mended, SurfaceError> {
        self.check()?;
        let size = self.size();
        let exact = weld::exactly(self);
        let (mut surface, edges, mut mending) = close(&exact, size)?;
        let (turned, shells) = orient::outward(&mut surface, &edges)?;
        (mending.turned, mending.shells) = (turned, shells.len());
        if surface.triangles.len() < self.triangles.len() || mending.crack > 0.0 {
            surface = weld::exactly(&surface);
        }
        mending.welded = self.vertices.len() - surface.vertices.len().min(self.vertices.len());
        if surface.volume().abs() <= FLAT * surface.area() * size {
            return Err(SurfaceError::Flat);
        }
        let parts = parts::parts(&surface, &shells);
        Ok(Mended { surface, mending, parts })
    }

    /// Checks the properties that every further step relies on: coordinates, numbering and scale.
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

/// Closes wider and wider gaps until no edge is open.
fn close(exact: &Surface, size: f64) -> Result<(Surface, Edges, Mending), SurfaceError> {
    let mut still_open = None;
    for crack in std::iter::once(0.0).chain(CRACKS.map(|part| part * size)) {
        let (mut surface, mut mending) = (exact.clone(), Mending { crack, ..Mending::default() });
        if crack > 0.0 {
            weld::along_gaps(&mut surface, crack);
        }
        weld::tidy(&mut surface, &mut mending);
        let mut edges = Edges::of(&surface);
        if crack > 0.0 && !edges.open.is_empty() {
            mending.seams = seams::split(&mut surface, crack);
            weld::tidy(&mut surface, &mut mending);
            edges = Edges::of(&surface);
        }
        if surface.triangles.is_empty() {
            break;
        }
        if edges.open.is_empty() {
            return Ok((surface, edges, mending));
        }
        still_open = Some((surface, edges));
    }
    // The edges that are still open after the widest gap has been closed belong to holes; all others were cracks.
    let Some((surface, edges)) = still_open else { return Err(SurfaceError::Empty) };
    let mut open: Vec<[DVec3; 2]> =
        edges.open.iter().map(|e| e.map(|v| surface.vertices[v as usize])).collect();
    let count = open.len();
    open.sort_by(|p, q| q[0].distance(q[1]).total_cmp(&p[0].distance(p[1])));
    open.truncate(MOST_EDGES);
    Err(SurfaceError::Open { count, edges: open, crack: CRACKS[CRACKS.len() - 1] * size })
}
