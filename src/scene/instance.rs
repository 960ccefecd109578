//! Stones beside one another, each of its own material.

use super::Body;
use crate::math::Solid;
use crate::optics::Material;
use glam::{DQuat, DVec3};

/// A stone in its place.
#[derive(Debug, Clone, PartialEq)]
pub struct Instance {
    /// Its shape, in the world's frame and unit.
    pub solid: Solid,
    /// What it is made of.
    pub material: Material,
    /// The facets' names, in their order; empty where they have none.
    pub names: Vec<String>,
    /// What its cut is called; may be empty.
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

impl Instance {
    /// A stone without names.
    pub fn new(solid: impl Into<Solid>, material: Material) -> Self {
        Self { solid: solid.into(), material, names: Vec::new(), label: String::new() }
    }

    /// A stone with the names of its facets, where it is.
    pub fn named(body: &Body, material: Material, label: &str) -> Self {
        Self { solid: body.into(), material, names: body.names(), label: label.to_owned() }
    }

    /// The same stone scaled by a factor above 0, turned, then shifted.
    pub fn moved(self, scale: f64, turn: DQuat, shift: DVec3) -> Self {
        Self { solid: self.solid.moved(scale, turn, shift), ..self }
    }

    /// Its weight in carats where the world's unit is `unit_mm` mm; `None` where its density is not known.
    pub fn carats(&self, unit_mm: f64) -> Option<f64> {
        self.material.carats(self.solid.volume() * unit_mm.powi(3))
    }
}
