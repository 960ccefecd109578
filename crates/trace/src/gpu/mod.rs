//! Point rays on a graphics card: the chain of bounces of [`ray`](super::ray) in WGSL, quick and in f32.
//!
//! Everything that can be edited (facets, medium, view, scope) is data in a buffer, so each shader is compiled only
//! once, when it is first used.

mod clusters;
mod device;
mod fields;
mod gpu_types;
mod imports;
mod light;
mod limits;
mod metals;
mod pane;
mod peak;
mod pieces;
mod scope;
mod shaders;
mod solids;
mod stage;
mod throttle;
mod triangles;

pub use device::{DispatchTotals, Gpu, GpuError};
pub use gpu_types::{PaneData, ScopePixel};
pub use light::{ByCard, GpuEnvironment};
pub use limits::{
    MOST_BODIES, MOST_BOUNCES, MOST_CARD_BANDS, MOST_METALS, MOST_ROUGHNESSES, MOST_TRIANGLES,
    MOST_WAVELENGTHS,
};
pub use pane::PaneStage;
pub use peak::CardPeak;

#[cfg(test)]
mod parity;
#[cfg(test)]
mod splits;
