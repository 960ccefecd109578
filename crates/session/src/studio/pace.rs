//! Finds the effort that a picture may take while the user moves something.

use super::effort::{Effort, Grain};
use std::time::Duration;

/// The efforts from the finest to the coarsest.
///
/// Rays keep pixels no larger than 2 as long as they can, and take fewer bands instead: in a picture of glass that
/// moves, blocks are more conspicuous than colours that are a little off. The last steps are for meshes and many
/// stones.
const STEPS: [Effort; 11] = [
    step(5e-3, (1.0, 12), (1.5, 8)),
    step(1e-2, (1.0, 10), (2.0, 8)),
    step(2e-2, (1.34, 8), (2.0, 6)),
    step(3e-2, (1.67, 6), (2.0, 4)),
    step(5e-2, (2.0, 5), (2.0, 3)),
    step(8e-2, (3.0, 4), (2.5, 3)),
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
/// take longer the next ones are coarser.
const GOAL: Duration = Duration::from_millis(40);

/// The limit of that time where the next step would have conspicuous blocks: ten sets in a second are then enough.
const SLOWEST: Duration = Duration::from_millis(100);

/// The part of the goal below which the time of finer pictures must be expected before they are tried. The rest is for times
/// that differ from picture to picture, so that two efforts do not alternate.
const SAFE: f64 = 0.8;

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
        if took > longest(self.0) {
            self.0 = next;
        } else if let Some(finer) = self.0.checked_sub(1)
            && took.mul_f64(growth(finer)) < longest(finer).mul_f64(SAFE)
        {
            self.0 = finer;
        }
    }
}

/// Returns the most time that all pictures may take by a step before the next one is taken.
fn longest(step: usize) -> Duration {
    let has_blocks = STEPS.get(step + 1).is_none_or(|next| next.grain_of_rays.coarser > HARDLY_SEEN);
    if has_blocks { SLOWEST } else { GOAL }
}

/// Returns the factor by which pictures by a step take longer than by the next one, at most: rays by their number, beams by
/// the light that they follow.
fn growth(step: usize) -> f64 {
    let rays = |effort: &Effort| {
        let Grain { coarser, bands } = effort.grain_of_rays;
        f64::from(bands) / (coarser * coarser)
    };
    let (finer, next) = (&STEPS[step], &STEPS[step + 1]);
    (rays(finer) / rays(next)).max(next.unresolved / finer.unresolved)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the steps that a pace takes, where pictures take a fixed time and a time by the number of their rays, in
    /// milliseconds for a step with one ray for each pixel. Each time is off by a tenth, to and fro.
    fn steps(mut pace: Pace, fixed_ms: f64, per_ray_ms: f64) -> Vec<usize> {
        let once = |k: u32| {
            let Grain { coarser, bands } = pace.effort().grain_of_rays;
            let took = fixed_ms + per_ray_ms * f64::from(bands) / (coarser * coarser);
            let off = 1.0 + 0.1 * (f64::from(k) * 0.618_034).fract();
            pace.learn(Duration::from_secs_f64(took * off * 1e-3));
            pace.0
        };
        (0..60).map(once).collect()
    }

    #[test]
    fn the_finest_effort_that_keeps_up_is_found_and_kept() {
        for (fixed_ms, per_ray_ms) in
            [(2.0, 2.0), (5.0, 12.0), (8.0, 20.0), (10.0, 30.0), (15.0, 60.0), (20.0, 150.0)]
        {
            for first in [0, 4, STEPS.len() - 1] {
                let all = steps(Pace(first), fixed_ms, per_ray_ms);
                let last = all[59];
                assert!(all[30..].iter().all(|&step| step == last), "{fixed_ms}, {per_ray_ms}: {all:?}");
                let time = |step: usize| {
                    let Grain { coarser, bands } = STEPS[step].grain_of_rays;
                    Duration::from_secs_f64(
                        1e-3 * (fixed_ms + per_ray_ms * f64::from(bands) / (coarser * coarser)),
                    )
                };
                assert!(time(last) <= longest(last), "{fixed_ms}, {per_ray_ms}: {last}");
                // The effort is at most one step coarser than possible, except by the safety.
                if let Some(finer) = last.checked_sub(2) {
                    assert!(
                        time(finer).mul_f64(1.1) > longest(finer).mul_f64(SAFE),
                        "{fixed_ms}, {per_ray_ms}: {last}"
                    );
                }
            }
        }
    }

    #[test]
    fn slow_pictures_become_coarser_and_quick_ones_finer() {
        let mut pace = Pace::default();
        (0..12).for_each(|_| pace.learn(2 * GOAL));
        assert_eq!(pace.effort(), STEPS[6], "no blocks where ten pictures a second come without");
        (0..12).for_each(|_| pace.learn(2 * SLOWEST));
        assert_eq!(pace.effort(), STEPS[10]);
        pace.learn(SLOWEST - GOAL / 2);
        assert_eq!(pace.effort(), STEPS[10]);
        (0..12).for_each(|_| pace.learn(SLOWEST.mul_f64(0.4)));
        assert_eq!(pace.effort(), STEPS[6]);
        (0..12).for_each(|_| pace.learn(GOAL / 4));
        assert_eq!(pace.effort(), STEPS[0]);
    }
}
