//! Stones and metal in one world: bodies that are built once, each carried by its pose, and each of its own material.

use super::{Body, Medium, MetalInstance, Specimen};
use brillianteer_math::{Pose, PosedSolid, bounds};
use brillianteer_optics::Material;
use glam::DVec3;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// An instance: a stone in its place.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Instance {
    /// The stone's body in its own frame. Instances of one body share it, and the data that tracers build for it.
    pub body: Arc<Body>,
    /// The pose that carries the body into the world.
    pub pose: Pose,
    /// The stone's material.
    pub material: Material,
    /// The name of the cut; may be empty.
    pub label: String,
}

/// The most stones that a scene may have.
pub const MOST_STONES: usize = 256;

/// Stones and bodies of metal in one world; no two stones overlap.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Scene {
    /// The stones.
    pub instances: Vec<Instance>,
    /// The bodies of metal.
    #[serde(default)]
    pub metals: Vec<MetalInstance>,
    /// The world's unit in mm: half the girdle diameter of the largest stone.
    pub unit_mm: f64,
}

impl Scene {
    /// Returns the scene of one stone, in the stone's frame and unit.
    pub fn alone(specimen: &Specimen) -> Self {
        let stone = Instance::of(&specimen.body, specimen.material.clone(), &specimen.design.name);
        Self { instances: vec![stone], metals: vec![], unit_mm: specimen.unit_mm() }
    }

    /// Returns whether a stone has frosted facets, whose light only rays in pictures under light follow.
    pub fn is_frosted(&self) -> bool {
        self.instances.iter().any(|stone| stone.body.is_frosted())
    }

    /// Returns a distance from the origin that no body exceeds.
    pub fn reach(&self) -> f64 {
        let stones = self.instances.iter().map(|stone| stone.solid().reach());
        stones.chain(self.metals.iter().map(MetalInstance::reach)).fold(0.0, f64::max)
    }

    /// Returns the corners of the box along the axes that holds all bodies: the least and the greatest coordinates. Of a scene
    /// without bodies they are infinite.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        let stones = self.instances.iter().map(|stone| stone.solid().bounds());
        let boxes = stones.chain(self.metals.iter().map(|metal| bounds(metal.vertices())));
        let none = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        boxes.fold(none, |(low, high), (a, b)| (low.min(a), high.max(b)))
    }

    /// Returns the same scene, carried on by a pose.
    pub fn moved(self, pose: &Pose) -> Self {
        Self {
            instances: self.instances.into_iter().map(|stone| stone.moved(pose)).collect(),
            metals: self.metals.into_iter().map(|metal| metal.moved(pose)).collect(),
            ..self
        }
    }

    /// Returns points whose box holds all bodies.
    pub fn vertices(&self) -> impl Iterator<Item = DVec3> + '_ {
        let stones = self.instances.iter().flat_map(|stone| stone.solid().vertices());
        stones.chain(self.metals.iter().flat_map(MetalInstance::vertices))
    }

    /// Returns the medium of a stone, in the unit of its body. `nm` are the first, the traced and the last wavelength of a
    /// band.
    pub fn medium(&self, stone: &Instance, nm: (f64, f64, f64)) -> Medium {
        Medium::of(&stone.material, nm, self.unit_mm * stone.pose.scale)
    }
}

impl Instance {
    /// Returns an instance without a label, in the place and at the scale of the body's own frame.
    pub fn new(body: impl Into<Body>, material: Material) -> Self {
        Self::of(&Arc::new(body.into()), material, "")
    }

    /// Returns a body as an instance, in the place and at the scale of the body's own frame.
    pub fn of(body: &Arc<Body>, material: Material, label: &str) -> Self {
        Self { body: Arc::clone(body), pose: Pose::STILL, material, label: label.to_owned() }
    }

    /// Returns the same stone, carried on by a pose from its place.
    pub fn moved(self, pose: &Pose) -> Self {
        Self { pose: pose.after(&self.pose), ..self }
    }

    /// Returns the stone's shape in its place.
    pub fn solid(&self) -> PosedSolid<'_> {
        PosedSolid { solid: self.body.solid(), pose: self.pose }
    }

    /// Returns the stone's weight in carats where the world's unit is `unit_mm` mm; `None` where its density is not known.
    pub fn carats(&self, unit_mm: f64) -> Option<f64> {
        self.material.carats(self.body.solid().volume() * (unit_mm * self.pose.scale).powi(3))
    }
}
