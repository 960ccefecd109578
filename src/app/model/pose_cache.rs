//! Keeps stones as they are turned for their views.

use crate::scene::Specimen;
use std::sync::Arc;

/// A stone in the few turns that its views show it in: the same turn of the same stone gives the same [`Arc`].
#[derive(Debug, Clone, Default)]
pub struct PoseCache(Vec<(Arc<Specimen>, f64, Arc<Specimen>)>);

/// The number of turns that are kept: that of the linked views, and those of the four views that may look on their own.
const TURNS: usize = 5;

impl PoseCache {
    /// Returns the stone turned about its axis by `turn`, radians.
    pub fn of(&mut self, specimen: &Arc<Specimen>, turn: f64) -> Arc<Specimen> {
        self.0.retain(|(of, ..)| Arc::ptr_eq(of, specimen));
        if let Some((.., posed)) = self.0.iter().find(|(_, at, _)| *at == turn) {
            return Arc::clone(posed);
        }
        let posed = turned(specimen, turn);
        if self.0.len() == TURNS {
            self.0.remove(0);
        }
        self.0.push((Arc::clone(specimen), turn, Arc::clone(&posed)));
        posed
    }
}

/// Makes a stone that is turned about its axis by `turn`, radians.
fn turned(specimen: &Arc<Specimen>, turn: f64) -> Arc<Specimen> {
    if turn == 0.0 {
        return Arc::clone(specimen);
    }
    let body = specimen.body.turned(turn);
    Arc::new(Specimen { body, ..(**specimen).clone() })
}
