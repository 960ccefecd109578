//! Exact beams: light followed as convex polygons of the image, in f64, with a bound on what is left.
//!
//! In a convex stone under parallel rays every path from the eye splits the image into convex polygons (virtual
//! facets), each with one direction at every depth. Within one, where a ray stands and how far it goes is affine
//! in the image's coordinates, so that the facets which a beam lands on are the cells of the lower envelope of
//! affine functions, and the whole tracing happens in two dimensions. Light is reversible: it is followed from
//! the eye inward, and a beam's weight is the share of the light from its exit direction that reaches the eye.

mod cells;
mod coherency;
mod follow;
mod grow;
mod split;
mod sweep;
mod tree;

pub use cells::Cell;
pub use grow::{BeamOptions, trace};
pub use tree::{Beam, Beams};
