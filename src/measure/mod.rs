//! Floor 4: figures. How much light comes from where, each with its error.

mod figures;
mod sampled;

pub use figures::{Figures, Zones, by_beams};
pub use sampled::by_rays;
