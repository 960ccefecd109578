//! Floor 4: figures. How much light comes from where, each with its error.

mod figures;
mod sampled;

pub use figures::{Figures, Zones, by_beams};
#[cfg(feature = "gpu")]
pub use sampled::by_gpu;
pub use sampled::by_rays;
