//! Beams that several pictures share.

use crate::math::Polytope;
use crate::scene::{Medium, View};
use crate::trace::beam::{self, BeamOptions, Beams};
use crate::trace::{Stopped, Watch};
use std::sync::Arc;

/// How many sets of beams are kept.
const MOST_KEPT: usize = 6;

/// Beams that several pictures share.
#[derive(Default)]
pub struct BeamCache {
    kept: Vec<Kept>,
    /// The number of the present round.
    round: u64,
}

/// Beams, what they are of, and the round in which they were used last.
struct Kept {
    polytope: Polytope,
    medium: Medium,
    view: View,
    options: BeamOptions,
    beams: Arc<Beams>,
    used: u64,
}

impl BeamCache {
    /// Returns the beams of a stone; traces them unless they are kept.
    ///
    /// # Errors
    /// [`Stopped`] when `watch` asks to stop.
    pub fn of(
        &mut self,
        polytope: &Polytope,
        medium: Medium,
        view: &View,
        options: &BeamOptions,
        watch: Watch,
    ) -> Result<Arc<Beams>, Stopped> {
        let is_same = |kept: &&mut Kept| {
            (kept.medium, kept.view, kept.options) == (medium, *view, *options) && kept.polytope == *polytope
        };
        if let Some(kept) = self.kept.iter_mut().find(is_same) {
            kept.used = self.round;
            return Ok(Arc::clone(&kept.beams));
        }
        let beams = Arc::new(beam::trace(polytope, medium, view, options, watch)?);
        if self.kept.len() == MOST_KEPT {
            self.kept.remove(0);
        }
        let (polytope, view, options, used) = (polytope.clone(), *view, *options, self.round);
        self.kept.push(Kept { polytope, medium, view, options, beams: Arc::clone(&beams), used });
        Ok(beams)
    }

    /// Begins a round: beams that were not used in the last one are dropped.
    pub fn begin_round(&mut self) {
        self.kept.retain(|kept| kept.used == self.round);
        self.round += 1;
    }
}
