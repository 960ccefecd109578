//! Rings of the program's own making: a few numbers and the stones give the metal's surfaces and the places of the
//! stones. Plain data; nothing here traces light.
//!
//! Lengths are in mm. The finger runs along y, the middle of its hole is the origin, and the head lies in the direction +z.

mod band;
mod error;
mod gem;
mod halo;
mod head;
mod making;
mod numbers;
mod path;
mod ring;
mod rod;
mod row;
mod skin;
mod turned;
mod weight;

#[cfg(test)]
mod tests;

pub use error::RingError;
pub use gem::SetStone;
pub use numbers::{RING_NUMBERS, RingNumber};
pub use ring::{MetalPart, Mounting, OuterShape, Ring, RingSeat, RingStyle, SeatKind};
pub use weight::{ALLOYS, Alloy};
