//! Glass shapes, which show spectral refraction beside gems.
//!
//! Lengths are percent of the design's diameter, as with stones; +z points to the eye of the view face up. A cube or prism
//! with sharp edges is a solid between planes like any stone; every other shape is a smooth solid.

use brillianteer_math::ImplicitForm;
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// A glass shape with its dimensions.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Glass {
    /// A stadium with rounded edges.
    Pill(Sides),
    /// A box; with three equal sides a cube.
    Cube(Sides),
    /// A prism along x, whose cross-section is an isosceles triangle with its apex toward the eye.
    Prism(Sides),
    /// A plate whose middle waves.
    Plate(Plate),
}

/// Outer dimensions, percent of the diameter.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Sides {
    /// The length along x.
    pub length: f64,
    /// The width along y; of a prism its base.
    pub width: f64,
    /// The depth along z; of a prism its height.
    pub depth: f64,
    /// The radius of the edges; 0 is sharp.
    pub edge: f64,
}

/// A plate whose middle waves. Lengths are percent of the diameter. Measured along z it has the same thickness everywhere.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Plate {
    /// The outer dimensions of the plate without its wave.
    pub sides: Sides,
    /// The height of the wave's crests, and the depth of its troughs.
    pub amplitude: f64,
    /// The distance from crest to crest, along x and along y.
    pub wavelength: f64,
    /// The phase at which the wave begins, degrees.
    pub phase: f64,
}

impl Glass {
    /// Returns the outer dimensions.
    pub fn sides(&self) -> &Sides {
        match self {
            Self::Pill(sides) | Self::Cube(sides) | Self::Prism(sides) | Self::Plate(Plate { sides, .. }) => {
                sides
            }
        }
    }

    /// Returns the shape as an implicit form, `unit` long for each percent.
    pub(super) fn form(&self, unit: f64) -> ImplicitForm {
        let Sides { length, width, depth, edge } = *self.sides();
        let (size, edge) = (DVec3::new(length, width, depth) * unit, edge * unit);
        match self {
            Self::Pill(_) => ImplicitForm::Pill { size, edge },
            Self::Cube(_) => ImplicitForm::Block { size, edge },
            Self::Prism(_) => ImplicitForm::Prism { size, edge },
            Self::Plate(p) => ImplicitForm::Plate {
                size,
                edge,
                amplitude: p.amplitude * unit,
                wavelength: p.wavelength * unit,
                phase: p.phase.to_radians(),
            },
        }
    }
}
