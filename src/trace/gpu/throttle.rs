//! Limits the work of each dispatch to what a graphics card was measured to do in a short time. A long dispatch stops
//! the whole screen, and drivers end one that takes a second or two.

use std::time::Duration;

/// The time that a dispatch may take before the next one is made smaller, in seconds. A dispatch of work twice as
/// heavy as before still ends within a tenth of a second.
const BUDGET_S: f64 = 0.05;

/// The cost of the first dispatch that a card is ever given, in plane tests. A weak card does 1e9 of them in a
/// second, and llvmpipe 2e8 on two cores.
const FIRST: f64 = 16e6;

/// The cost below which no dispatch is worth dividing, in plane tests.
const LEAST: f64 = 1.0;

/// The part of the budget that a picture's first dispatch is meant to take, because the picture may be several times
/// as heavy as estimated.
const OPENING: f64 = 0.25;

/// The limit of the work of one dispatch, from the measured times of earlier dispatches. Work is counted in estimated
/// plane tests; only the ratio between dispatches matters.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Throttle {
    budget_s: f64,
    most: f64,
    /// The work per second of the last dispatch.
    speed: f64,
}

impl Default for Throttle {
    fn default() -> Self {
        Self::new(BUDGET_S, FIRST)
    }
}

impl Throttle {
    /// Returns a throttle whose first dispatch is given at most `first` plane tests.
    pub fn new(budget_s: f64, first: f64) -> Self {
        Self { budget_s, most: first, speed: f64::INFINITY }
    }

    /// Returns the most work that the next dispatch may be given, above 0.
    pub fn most(&self) -> f64 {
        self.most
    }

    /// Begins another picture, or another part of one, with a cautious first dispatch by the speed measured so far.
    pub fn open(&mut self) {
        self.most = self.most.min(self.speed * self.budget_s * OPENING).max(LEAST);
    }

    /// Records that a dispatch of this much work took this long.
    pub fn note(&mut self, work: f64, took: Duration) {
        let took_s = took.as_secs_f64().max(1e-9);
        self.speed = work / took_s;
        let fits = self.budget_s / took_s;
        if fits < 1.0 {
            // The aim is half the budget, so at least half of the work is left out.
            self.most = self.most.min(work * 0.5 * fits).max(LEAST);
        } else if fits > 2.0 {
            self.most = self.most.max(work * (0.75 * fits).min(2.0));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Dispatches as much work as the throttle allows, `count` times; `seconds` gives the time of a dispatch of some
    /// work. Returns the times of the dispatches.
    fn times(throttle: &mut Throttle, count: usize, seconds: impl Fn(f64) -> f64) -> Vec<f64> {
        let once = |_| {
            let work = throttle.most();
            let took = seconds(work);
            throttle.note(work, Duration::from_secs_f64(took));
            took
        };
        (0..count).map(once).collect()
    }

    proptest! {
        #[test]
        fn after_a_dispatch_over_the_budget_the_next_is_at_most_half(
            most in 2.0..1e12_f64, part in 0.01..1.0_f64, over in 1.001..1e6_f64,
        ) {
            let mut throttle = Throttle::new(BUDGET_S, most);
            let work = (most * part).max(2.0 * LEAST);
            throttle.note(work, Duration::from_secs_f64(BUDGET_S * over));
            prop_assert!(throttle.most() <= 0.5 * work && throttle.most() >= LEAST);
        }

        #[test]
        fn the_limit_is_never_zero_and_grows_at_most_twofold(
            times in prop::collection::vec((0.0..1.0_f64, 0.0..100.0_f64, any::<bool>()), 1..60),
        ) {
            let mut throttle = Throttle::default();
            for (part, took, opens) in times {
                let before = throttle.most();
                throttle.note(before * part, Duration::from_secs_f64(took));
                if opens {
                    throttle.open();
                }
                prop_assert!(throttle.most() >= LEAST && throttle.most() <= 2.0 * before, "{throttle:?}");
            }
        }

        #[test]
        fn a_device_of_any_constant_speed_is_used_well_and_not_for_too_long(exponent in 3.0..15.0_f64) {
            let speed = 10_f64.powf(exponent);
            let mut throttle = Throttle::default();
            let long = times(&mut throttle, 60, |work| work / speed);
            prop_assert!(long[1..].iter().all(|&t| t <= BUDGET_S), "{long:?}");
            prop_assert!(long[40..].iter().all(|&t| t >= 0.25 * BUDGET_S), "{long:?}");
        }

        #[test]
        fn a_speed_that_changes_costs_one_long_dispatch(down in 1.0..1e4_f64, up in 1.0..1e4_f64) {
            let mut throttle = Throttle::default();
            times(&mut throttle, 40, |work| work / 1e9);
            let slower = times(&mut throttle, 20, |work| work / 1e9 * down);
            prop_assert!(slower[1..].iter().all(|&t| t <= BUDGET_S), "{slower:?}");
            let faster = times(&mut throttle, 40, |work| work / 1e9 * down / up);
            prop_assert!(faster.iter().all(|&t| t <= BUDGET_S) && faster[39] >= 0.25 * BUDGET_S, "{faster:?}");
        }
    }

    #[test]
    fn a_picture_four_times_as_heavy_as_its_estimate_begins_within_the_budget() {
        let mut throttle = Throttle::default();
        times(&mut throttle, 40, |work| work / 1e9);
        throttle.open();
        let heavier = times(&mut throttle, 10, |work| 4.0 * work / 1e9);
        assert!(heavier.iter().all(|&t| t <= BUDGET_S * 1.001), "{heavier:?}");
        let mutant = Throttle { most: 4.0 * throttle.most(), ..throttle };
        assert!(times(&mut mutant.clone(), 1, |work| 4.0 * work / 1e9)[0] > BUDGET_S);
    }

    #[test]
    fn a_slow_dispatch_halves_the_work_and_quick_ones_let_it_grow() {
        let mut throttle = Throttle::new(BUDGET_S, 1024.0);
        throttle.note(1024.0, Duration::from_secs_f64(1.2 * BUDGET_S));
        let halved = throttle.most();
        assert!(halved <= 512.0 && halved > 256.0, "{halved}");
        throttle.note(halved, Duration::from_secs_f64(0.1 * BUDGET_S));
        assert_eq!(throttle.most(), 2.0 * halved);
        // A dispatch that fits changes nothing, so the two comparisons above can fail.
        throttle.note(2.0 * halved, Duration::from_secs_f64(0.8 * BUDGET_S));
        assert_eq!(throttle.most(), 2.0 * halved);
    }
}
