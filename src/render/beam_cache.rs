//! Beams that several pictures share.

use crate::math::Polytope;
use crate::scene::{Body, Medium, View};
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
    body: Arc<Body>,
    medium: Medium,
    view: View,
    options: BeamOptions,
    beams: Arc<Beams>,
    used: u64,
}

impl BeamCache {
    /// Returns the beams of a body that is a polytope; traces them unless they are kept.
    ///
    /// # Errors
    /// [`Stopped`] when `watch` asks to stop.
    pub fn of(
        &mut self,
        (body, polytope): (&Arc<Body>, &Polytope),
        medium: Medium,
        view: &View,
        options: &BeamOptions,
        watch: Watch,
    ) -> Result<Arc<Beams>, Stopped> {
        let is_same = |kept: &&mut Kept| {
            (kept.medium, kept.view, kept.options) == (medium, *view, *options)
                && Arc::ptr_eq(&kept.body, body)
        };
        if let Some(kept) = self.kept.iter_mut().find(is_same) {
            kept.used = self.round;
            return Ok(Arc::clone(&kept.beams));
        }
        let beams = Arc::new(beam::trace(polytope, medium, view, options, watch)?);
        if self.kept.len() == MOST_KEPT {
            self.kept.remove(0);
        }
        let (body, view, options, used) = (Arc::clone(body), *view, *options, self.round);
        self.kept.push(Kept { body, medium, view, options, beams: Arc::clone(&beams), used });
        Ok(beams)
    }

    /// Begins a round: beams that were not used in the last one are dropped.
    pub fn begin_round(&mut self) {
        self.kept.retain(|kept| kept.used == self.round);
        self.round += 1;
    }
}
