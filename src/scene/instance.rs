//! Stones in one world, each of its own material.

use super::{Body, Specimen};
use crate::math::Solid;
use crate::optics::Material;
use glam::{DQuat, DVec3};

/// An instance: a stone in its place.
#[derive(Debug, Clone, PartialEq)]
pub struct Instance {
    /// The stone's shape, in the world's frame and unit.
    pub solid: Solid,
    /// The stone's material.
    pub material: Material,
    /// The names of the facets, in their order; empty where they have none.
    pub names: Vec<String>,
    /// The name of the cut; may be empty.
    pub label: String,
}

/// Stones in one world; no two overlap.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// The stones.
    pub instances: Vec<Instance>,
    /// The world's unit in mm: half the girdle diameter of the largest stone.
    pub unit_mm: f64,
}

impl Scene {
    /// Returns the scene of one stone, in the stone's frame and unit.
    pub fn alone(specimen: &Specimen) -> Self {
        let stone = Instance::named(&specimen.body, specimen.material.clone(), &specimen.design.name);
        Self { instances: vec![stone], unit_mm: specimen.unit_mm() }
    }
}

impl Instance {
    /// Returns an instance without names.
    pub fn new(solid: impl Into<Solid>, material: Material) -> Self {
        Self { solid: solid.into(), material, names: Vec::new(), label: String::new() }
    }

    /// Returns a body as an instance, with the names of its facets, in the place and at the scale of the body's own frame.
    pub fn named(body: &Body, material: Material, label: &str) -> Self {
        Self { solid: body.into(), material, names: body.names(), label: label.to_owned() }
    }

    /// Returns the same stone scaled by a factor above 0, then turned, then shifted.
    pub fn moved(self, scale: f64, turn: DQuat, shift: DVec3) -> Self {
        Self { solid: self.solid.moved(scale, turn, shift), ..self }
    }

    /// Returns the stone's weight in carats where the world's unit is `unit_mm` mm; `None` where its density is not known.
    pub fn carats(&self, unit_mm: f64) -> Option<f64> {
        self.material.carats(self.solid.volume() * unit_mm.powi(3))
    }
}
