//! Floor 4: figures. They say how much light comes from where, each with its error.
//!
//! [`measure`](crate::measure()) takes a design to its figures in one call.

mod estimated;
mod figures;
mod measured;
mod sampled;

pub use estimated::{Estimate, by_beams_and_rays};
pub use figures::{Figures, Zones, by_beams, by_summed_beams};
pub use measured::{Bounds, LATTICE, Measured, STANDARD_ERROR, UNRESOLVED, Zone, measured};
#[cfg(feature = "gpu")]
pub use sampled::by_gpu;
pub use sampled::by_rays;
