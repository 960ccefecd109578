//! Stones beside one another, each of its own material.

use crate::math::Polytope;
use crate::optics::Material;

/// A stone in its place.
#[derive(Debug, Clone, PartialEq)]
pub struct Placed {
    /// Its facets, in the world's frame and unit.
    pub polytope: Polytope,
    /// What it is made of.
    pub material: Material,
}

/// Stones in one world; no two overlap.
#[derive(Debug, Clone, PartialEq)]
pub struct Setting {
    /// The stones.
    pub stones: Vec<Placed>,
    /// The world's unit in mm: half the girdle diameter of a stone alone.
    pub unit_mm: f64,
}
