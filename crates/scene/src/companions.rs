//! Companions: the stones of other designs, and the metal, that stand beside a design and its copies.

use super::{Instance, MetalInstance, RingPlan, RingSeat, SceneRing, SeatKind, Specimen};
use brillianteer_math::Pose;
use glam::DVec3;
use std::sync::Arc;

/// A stone of another design.
#[derive(Debug, Clone)]
pub struct Companion {
    /// The stone.
    pub specimen: Arc<Specimen>,
    /// The pose that carries the stone, from its own unit, to its place.
    pub pose: Pose,
}

/// The stones of other designs and the bodies of metal in a scene. Lengths of all poses are in one unit.
#[derive(Debug, Clone, Default)]
pub struct Companions {
    /// The stones of other designs.
    pub stones: Vec<Companion>,
    /// The bodies of metal.
    pub metals: Vec<MetalInstance>,
    /// The ring that one of the bodies of metal belongs to, if the program made it; the body's pose is the ring's.
    pub ring: Option<SceneRing>,
}

/// Two places of a ring's stones that are nearer than this are one, in mm: rounding.
const SAME_SEAT_MM: f64 = 1e-6;

impl PartialEq for Companion {
    /// Stones are compared by pointer, because they are replaced and never changed.
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.specimen, &other.specimen) && self.pose == other.pose
    }
}

impl PartialEq for Companions {
    /// Meshes are compared by pointer, because they are replaced and never changed. That of a ring is made anew where undo
    /// comes back to it, so rings are compared by what they are made of.
    fn eq(&self, other: &Self) -> bool {
        let is_ring = |number| self.ring.as_ref().is_some_and(|ring| ring.metal == number);
        let is_same = |(number, (a, b)): (usize, (&MetalInstance, &MetalInstance))| {
            (is_ring(number) || Arc::ptr_eq(&a.mesh, &b.mesh))
                && (a.pose, a.metal, a.roughness) == (b.pose, b.metal, b.roughness)
        };
        self.stones == other.stones
            && self.ring == other.ring
            && self.metals.len() == other.metals.len()
            && self.metals.iter().zip(&other.metals).enumerate().all(is_same)
    }
}

impl Companions {
    /// Returns whether the design has no companions.
    pub fn is_empty(&self) -> bool {
        self.stones.is_empty() && self.metals.is_empty()
    }

    /// Returns the same bodies with their lengths in another unit: `factor` of it are one of the present unit.
    pub fn in_unit(&self, factor: f64) -> Self {
        self.carried(&Pose { scale: factor, ..Pose::STILL })
    }

    /// Returns the same bodies, carried on by a pose from their places.
    pub fn carried(&self, pose: &Pose) -> Self {
        let stone = |stone: &Companion| Companion { pose: pose.after(&stone.pose), ..stone.clone() };
        Self {
            stones: self.stones.iter().map(stone).collect(),
            metals: self.metals.iter().map(|metal| metal.clone().moved(pose)).collect(),
            ring: self.ring.clone(),
        }
    }

    /// Returns the kind of the ring's seat whose stone lies at a place; `None` where no stone of the ring lies there.
    pub fn seat_at(&self, at: DVec3) -> Option<SeatKind> {
        let ring = self.ring.as_ref()?;
        let pose = &self.metals.get(ring.metal)?.pose;
        let is_there = |seat: &&RingSeat| pose.place(seat.pose.at).distance(at) < SAME_SEAT_MM * pose.scale;
        ring.seats.iter().find(is_there).map(|seat| seat.kind)
    }

    /// Returns what the metal of the ring has to be made of now; `None` without a ring. The design's own stones are `own`,
    /// and the first of them lies at `at`.
    pub fn ring_plan(&self, own: &Arc<Specimen>, at: DVec3) -> Option<RingPlan> {
        let mut ring = self.ring.as_ref()?.ring.clone();
        let seated = |kind| {
            let is_seated = |at: DVec3| self.seat_at(at) == Some(kind);
            let beside = || self.stones.iter().find(|stone| is_seated(stone.pose.at));
            if is_seated(at) {
                Some(Arc::clone(own))
            } else {
                beside().map(|stone| Arc::clone(&stone.specimen))
            }
        };
        let (stone, small_stone) = (seated(SeatKind::Main), seated(SeatKind::Small));
        if let Some(small) = &small_stone {
            ring.small_diameter_mm = small.design.diameter_mm;
        }
        Some(RingPlan { ring, stone, small_stone })
    }

    /// Returns the ring if its metal was made of what it has to be made of now; see [`ring_plan`](Self::ring_plan).
    pub fn fitted_ring(&self, own: &Arc<Specimen>, at: DVec3) -> Option<&SceneRing> {
        let plan = self.ring_plan(own, at)?;
        self.ring.as_ref().filter(|ring| ring.made_of == plan)
    }

    /// Returns the stones as instances.
    pub fn instances(&self) -> impl Iterator<Item = Instance> + '_ {
        self.stones.iter().map(|Companion { specimen, pose }| {
            Instance::of(&specimen.body, specimen.material.clone(), &specimen.design.name).moved(pose)
        })
    }

    /// Returns points whose box holds all bodies.
    pub fn vertices(&self) -> impl Iterator<Item = DVec3> + '_ {
        let corners = |stone: &'_ Companion| {
            let pose = stone.pose;
            stone
                .specimen
                .solid()
                .vertices()
                .iter()
                .map(move |corner| pose.place(*corner))
                .collect::<Vec<_>>()
        };
        self.stones.iter().flat_map(corners).chain(self.metals.iter().flat_map(MetalInstance::vertices))
    }

    /// Returns a distance from the origin that no body exceeds.
    pub fn reach(&self) -> f64 {
        let stones = self.stones.iter().map(|s| s.pose.at.length() + s.specimen.radius * s.pose.scale);
        stones.chain(self.metals.iter().map(MetalInstance::reach)).fold(0.0, f64::max)
    }
}
