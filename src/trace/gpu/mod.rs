//! The chain of bounces on a graphics card: the twin of [`ray`](super::ray) in WGSL, quick and in f32.
//!
//! Everything that can be edited (facets, medium, view, scope) is data in a buffer: shaders are compiled once, when
//! the card is opened.

mod bunches;
mod device;
mod door;
mod fields;
mod light;
mod scope;
mod shaders;
mod solids;
mod stage;
mod triangles;

pub use device::{Gpu, GpuError};
pub use door::Seen;
pub use light::{Around, ByCard, MOST_WAVELENGTHS};
pub use scope::{MOST_BANDS, MOST_BOUNCES, Shot};
pub use solids::MOST_BODIES;
pub use triangles::MOST_TRIANGLES;

#[cfg(test)]
mod twins;
