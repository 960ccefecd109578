//! Stones as they are turned for their views.

use crate::scene::Specimen;
use std::sync::Arc;

/// A stone in the few turns that its views show it in: the same turn of the same stone is one and the same.
#[derive(Default)]
pub struct PoseCache(Vec<(Arc<Specimen>, f64, Arc<Specimen>)>);

/// Turns kept: that of the linked views and of each view that looks on its own.
const TURNS: usize = 5;

impl PoseCache {
    /// The stone at a turn.
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

/// A stone turned about its axis.
fn turned(specimen: &Arc<Specimen>, turn: f64) -> Arc<Specimen> {
    if turn == 0.0 {
        return Arc::clone(specimen);
    }
    let body = specimen.body.turned(turn);
    Arc::new(Specimen { body, ..(**specimen).clone() })
}
