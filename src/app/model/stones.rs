//! The stones that pictures show, as they move in time, each made once.

use super::Model;
use super::motion::WaveCache;
use crate::app::studio::Which;
use crate::scene::{Pose, Specimen};
use std::sync::Arc;

/// Makes stones as pictures show them, and keeps those that change in time.
#[derive(Debug, Clone, Default)]
pub struct Stones {
    waves: WaveCache,
}

impl Stones {
    /// Returns one of the two stones.
    pub fn of(model: &Model, which: Which) -> Option<Arc<Specimen>> {
        match which {
            Which::Present => Some(Arc::clone(model.document.specimen())),
            Which::Other => Some(Arc::clone(&model.session.compared.as_ref()?.specimen)),
        }
    }

    /// Returns what a render shows: the stone, and the poses of its copies.
    pub fn company(&mut self, model: &Model, which: Which) -> Option<(Arc<Specimen>, Vec<Pose>)> {
        let specimen = Self::of(model, which)?;
        if model.is_alone() {
            return Some((specimen, vec![Pose::STILL]));
        }
        Some(model.session.motion.now(&mut self.waves, &specimen, &model.document.work.company))
    }
}
