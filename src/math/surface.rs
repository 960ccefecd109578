//! Triangles that enclose a solid, convex or not.

use glam::DVec3;

/// Triangles over shared corners.
#[derive(Debug, Clone, PartialEq)]
pub struct Surface {
    /// Corners.
    pub vertices: Vec<DVec3>,
    /// Corners of each triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
}
