//! The direction that is up in a surface's own frame.

use brillianteer_math::Pose;
use glam::DVec3;

/// The direction of a surface's table, and the source of that knowledge.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Up {
    /// Found from the shape; z is up by custom.
    #[default]
    Found,
    /// Found from the shape; this axis of the surface's frame is up by custom, as y is in glTF.
    FoundBy(DVec3),
    /// Given in the surface's frame, with any length but zero. The largest facet within 5 degrees is the table, whose normal is
    /// then up, unless another of them is half as large; then only facets within 1.5 degrees are.
    Given(DVec3),
    /// Known exactly, in the surface's frame, of length 1. Only a facet square to it is the table.
    Known(DVec3),
    /// Known together with the whole pose of the stone, by which the surface is then moved exactly.
    Posed(Pose),
}
