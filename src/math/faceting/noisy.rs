//! Tells scans, whose noise bends them everywhere, from models.

use super::change::Change;
use super::scan;
use crate::math::Surface;

/// A surface with more corners than this for each facet is no model with corners only where facets meet.
pub const MODELLED: usize = 12;

/// Returns whether noise bends a surface everywhere, as that of a scan: nearly as often inward as outward. A model of few corners, such
/// as a star, may bend inward as often by intent.
pub fn is_noisy(surface: &Surface) -> bool {
    /// The part of the edges that bend inward.
    const INWARD: f64 = 0.25;
    surface.vertices.len() >= scan::FEWEST
        && Change::inward_edges(surface) as f64 > INWARD * 1.5 * surface.triangles.len() as f64
}
