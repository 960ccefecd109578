//! What light does at a surface and inside a stone: refraction, reflection, dispersion, absorption, and the
//! encoding of the colour that comes out. Floor 0: knows nothing of cuts, scenes or tracers.
//!
//! Conventions, everywhere below: wavelengths in nanometres unless the name says `um`; directions are unit
//! vectors *of travel*; `eta` = index on the incident side / index on the transmitted side; total internal
//! reflection is a value (`None`), never an error.

pub mod absorption;
pub mod colour;
pub mod dispersion;
pub mod fresnel;
mod gems;
pub mod material;
pub mod snell;

pub use absorption::{Absorption, AbsorptionError, MOST_PER_MM};
pub use colour::{LinearRgb, SrgbEncoder, encoded_from_linear, linear_from_encoded};
pub use dispersion::{Dispersion, DispersionError, VISIBLE_NM, line};
pub use fresnel::{Fresnel, fresnel, reflectance};
pub use material::{Material, UnknownMaterial, material, materials};
pub use snell::{brewster_angle, cos_transmitted, critical_angle, reflect, refract};
