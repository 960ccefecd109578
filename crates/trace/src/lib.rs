//! The tracers, which follow light through stones. Exact beams and point rays share Fresnel's equations, the
//! stone, the view and the guess of the next facet, which each of them verifies in its own way.
//!
//! A tracer answers with energy by direction, or by the response that each channel and band of wavelengths is
//! given, never with a colour of its own.

// A test may list as many cases as it has.
#![cfg_attr(test, allow(clippy::too_many_lines))]

pub mod beam;
mod coherency;
mod dispersed_ray;
pub mod environment;
mod facet_guess;
#[cfg(feature = "gpu")]
pub mod gpu;
mod lanes;
mod packet;
pub mod places;
pub mod ray;
pub mod sampling;
mod scope_shot;
pub mod shared_tail;
pub mod tail;

pub use dispersed_ray::DispersedRay;
pub use scope_shot::ScopeShot;

// Files that tests of several crates share.
#[cfg(test)]
#[path = "../../../tests/common/proportions.rs"]
mod random;
#[cfg(test)]
#[path = "../../../tests/common/solids.rs"]
mod solids;
