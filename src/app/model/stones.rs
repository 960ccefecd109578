//! The stones that pictures show, turned and moved, each made once.

use super::Model;
use super::motion::WaveCache;
use super::pose_cache::PoseCache;
use crate::app::studio::Which;
use crate::scene::{Pose, Specimen};
use std::sync::Arc;

/// Makes stones as pictures show them, and keeps them: the same stone in the same turn is the same [`Arc`].
#[derive(Debug, Clone, Default)]
pub struct Stones {
    present: PoseCache,
    other: PoseCache,
    waves: WaveCache,
}

impl Stones {
    /// Returns the present stone, turned about its axis by `turn`, radians.
    pub fn posed(&mut self, model: &Model, turn: f64) -> Arc<Specimen> {
        self.present.of(model.document.specimen(), turn)
    }

    /// Returns one of the two stones, turned about its axis by `turn`, radians.
    pub fn of(&mut self, model: &Model, which: Which, turn: f64) -> Option<Arc<Specimen>> {
        match which {
            Which::Present => Some(self.posed(model, turn)),
            Which::Other => Some(self.other.of(&model.session.compared.as_ref()?.specimen, turn)),
        }
    }

    /// Returns what a render shows: the stone, and the poses of its copies.
    pub fn company(&mut self, model: &Model, which: Which, turn: f64) -> Option<(Arc<Specimen>, Vec<Pose>)> {
        if model.is_alone() {
            return Some((self.of(model, which, turn)?, vec![Pose::STILL]));
        }
        let specimen = match which {
            Which::Present => model.document.specimen(),
            Which::Other => &model.session.compared.as_ref()?.specimen,
        };
        Some(model.session.motion.now(&mut self.waves, specimen, &model.document.work.company, turn))
    }
}
