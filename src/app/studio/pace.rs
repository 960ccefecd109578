//! How much a picture may cost while the hand moves.

use super::effort::Effort;
use std::time::Duration;

/// The efforts from the finest to the coarsest.
const STEPS: [Effort; 6] = [
    Effort::rough(5e-3, 1.0, 12),
    Effort::rough(1e-2, 1.0, 10),
    Effort::rough(2e-2, 1.34, 8),
    Effort::rough(3e-2, 1.67, 6),
    Effort::rough(5e-2, 2.0, 5),
    Effort::rough(8e-2, 3.0, 4),
];

/// The time that all pictures together should take, at most, so that more than 20 sets of them come in a second. Where they
/// take longer the next ones are coarser, where they take less than a third of it they are finer.
const GOAL: Duration = Duration::from_millis(40);

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
        if took > GOAL {
            self.0 = (self.0 + 1).min(STEPS.len() - 1);
        } else if took < GOAL / 3 {
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
        (0..9).for_each(|_| pace.learn(2 * GOAL));
        assert_eq!(pace.effort(), STEPS[5]);
        pace.learn(GOAL / 2);
        assert_eq!(pace.effort(), STEPS[5]);
        (0..9).for_each(|_| pace.learn(GOAL / 4));
        assert_eq!(pace.effort(), STEPS[0]);
    }
}
