//! The optics of surfaces and of the inside of a stone: refraction, reflection, dispersion and absorption; and the
//! colour of the light that comes out, from its spectrum to its encoding.
//!
//! This crate knows nothing of cuts, scenes or tracers. Conventions in all modules: wavelengths are in
//! nanometres unless the name says `um`; directions are unit vectors *of travel*; `eta` = index on the incident side
//! / index on the transmitted side; total internal reflection is a value (`None`), never an error.

// A test may list as many cases as it has.
#![cfg_attr(test, allow(clippy::too_many_lines))]

pub mod absorption;
pub mod colour;
pub mod dispersion;
pub mod fresnel;
mod frosted;
mod gems;
mod glasses;
pub mod illuminant;
pub mod material;
pub mod metal;
pub mod microfacets;
pub mod observer;
pub mod real;
pub mod snell;
pub mod strata;
mod weight;

pub use absorption::{Absorption, AbsorptionError, MOST_PER_MM, transmittance};
pub use colour::{LUMINANCE, LinearRgb, SrgbEncoder, encoded_from_linear, linear_from_encoded};
pub use dispersion::{Dispersion, DispersionError, INDICES, INDICES_IN_WORDS, VISIBLE_NM, line};
pub use fresnel::{Fresnel, fresnel, reflectance};
pub use frosted::{FrostedScatter, FrostedSurface};
pub use illuminant::{DAYLIGHT_KELVIN, Illuminant, IlluminantError};
pub use material::{Material, UnknownMaterial, material, materials};
pub use metal::{Metal, metal_reflectance};
pub use microfacets::{RoughMetal, Roughness, Scattered};
pub use observer::{D65_WHITE, OBSERVER_NM, SRGB_FROM_XYZ, adaptation, matching, seen};
pub use real::{Real, Truth, Vector};
pub use snell::{Incidence, brewster_angle, cos_transmitted, critical_angle, reflect, refract};
pub use strata::{SAMPLED_NM, Strata, Stratum, basis, strata};
pub use weight::MG_PER_CARAT;
