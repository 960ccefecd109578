//! Exact light in gemstone cuts.

pub mod math;
pub mod optics;
pub mod scene;
pub mod trace;
