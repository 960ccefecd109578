//! Exact beams: light followed as convex polygons of the image, in f64, with a bound on the light that is not followed.
//!
//! In a convex stone under parallel rays, every path from the eye splits the image into convex polygons (virtual
//! facets), each with one direction at every depth. Within one polygon, the start of a ray and its length are affine
//! in the image's coordinates. So the facets that a beam lands on are the cells of the lower envelope of affine
//! functions, and all tracing happens in two dimensions. Light is reversible: it is followed from the eye inward, and
//! a beam's weight is the share of the light from its exit direction that reaches the eye.

mod adjoint;
mod blocks;
mod cells;
mod coherency;
mod effort;
mod exit_change;
mod fan;
mod follow;
mod grow;
mod shared;
mod split;
mod sums;
mod tree;
mod whole;

pub use adjoint::{BeamPartials, PlaneDerivatives};
pub use cells::Cell;
pub(crate) use follow::{Flight, Front};
pub use grow::trace_bounces;
pub use grow::{BeamOptions, SumOptions, SummedBeams, sum_up, trace};
pub use shared::{
    BeamEnd, EntryFacet, Inside, MovingCorner, SharedBeam, SharedBeams, SharedExit, SharedView,
    SharingOptions, Slant, trace_shared,
};
pub use sums::BeamSums;
pub use tree::{Beam, Beams};
