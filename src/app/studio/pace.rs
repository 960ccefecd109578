//! Finds the effort that a picture may take while the user moves something.

use super::effort::{Effort, Grain};
use std::time::Duration;

/// The efforts from the finest to the coarsest.
///
/// Rays keep pixels no larger than 2 as long as they can, and take fewer bands instead: in a picture of glass that
/// moves, blocks are more conspicuous than colours that are a little off. The last steps are for meshes and many
/// stones.
const STEPS: [Effort; 10] = [
    step(5e-3, (1.0, 12), (1.5, 8)),
    step(1e-2, (1.0, 10), (2.0, 8)),
    step(2e-2, (1.34, 8), (2.0, 6)),
    step(3e-2, (1.67, 6), (2.5, 6)),
    step(5e-2, (2.0, 5), (3.0, 6)),
    step(8e-2, (3.0, 4), (3.0, 3)),
    step(8e-2, (3.0, 4), (4.0, 3)),
    step(8e-2, (3.0, 4), (5.0, 3)),
    step(8e-2, (3.0, 4), (6.5, 3)),
    step(8e-2, (3.0, 4), (9.0, 3)),
];

/// Makes an effort of: the share of the light that may stay unresolved; the factor of the pixels and the most bands;
/// and both where rays on the processor trace.
const fn step(unresolved: f64, (coarser, bands): (f64, u32), (by_rays, bands_of_rays): (f64, u32)) -> Effort {
    let grain_of_rays = Grain { coarser: by_rays, bands: bands_of_rays };
    Effort { grain_of_rays, ..Effort::rough(unresolved, Grain { coarser, bands }) }
}

/// The time that all pictures together should take, at most, so that more than 20 sets of them come in a second. Where they
/// take longer the next ones are coarser, where they take less than a third of it they are finer.
const GOAL: Duration = Duration::from_millis(40);

/// The limit of that time where the next step would have conspicuous blocks: ten sets in a second are then enough.
const SLOWEST: Duration = Duration::from_millis(100);

/// The largest blocks, in pixels of the film, that are hardly noticed in glass that moves before a sharp background.
const HARDLY_SEEN: f64 = 3.0;

/// Finds the effort that keeps up with the hand, as an index of `STEPS`.
#[derive(Debug, Clone, Copy)]
pub struct Pace(usize);

impl Default for Pace {
    fn default() -> Self {
        Self(2)
    }
}

impl Pace {
    /// Returns the present effort.
    pub fn effort(self) -> Effort {
        STEPS[self.0]
    }

    /// Adjusts the effort to the time that all pictures took.
    pub fn learn(&mut self, took: Duration) {
        let next = (self.0 + 1).min(STEPS.len() - 1);
        let has_blocks = |step: usize| STEPS[step].grain_of_rays.coarser > HARDLY_SEEN;
        let longest = if has_blocks(next) { SLOWEST } else { GOAL };
        // One step with blocks has less than twice as many pixels as the next, and a part of the time does not depend
        // on them.
        let shortest = if has_blocks(self.0) { SLOWEST * 2 / 3 } else { GOAL / 3 };
        if took > longest {
            self.0 = next;
        } else if took < shortest {
            self.0 = self.0.saturating_sub(1);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slow_pictures_become_coarser_and_quick_ones_finer() {
        let mut pace = Pace::default();
        (0..12).for_each(|_| pace.learn(2 * GOAL));
        assert_eq!(pace.effort(), STEPS[5], "no blocks where ten pictures a second come without");
        (0..12).for_each(|_| pace.learn(2 * SLOWEST));
        assert_eq!(pace.effort(), STEPS[9]);
        pace.learn(SLOWEST - GOAL / 2);
        assert_eq!(pace.effort(), STEPS[9]);
        (0..12).for_each(|_| pace.learn(SLOWEST * 2 / 3 - GOAL / 10));
        assert_eq!(pace.effort(), STEPS[5]);
        (0..12).for_each(|_| pace.learn(GOAL / 4));
        assert_eq!(pace.effort(), STEPS[0]);
    }
}
