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

/// The factor by which a dispatch counts for less than the next one where a line is fitted to the times.
const FADE: f64 = 0.9;

/// The ratio of a dispatch's time to the expected one, or of the expected one to it, above which the card, or the picture, has
/// changed.
const CHANGED: f64 = 8.0;

/// The part of the mean squared work that its variance exceeds where a line can be fitted.
const EVEN: f64 = 0.01;

/// The factor by which the least time per work grows with each dispatch, so that it is forgotten.
const FORGET: f64 = 1.02;

/// The least time of the work of a dispatch, as a part of its wait.
const LEAST_SHARE: f64 = 0.5;

/// The time of a dispatch, in seconds, above which the next one is smaller in any case: drivers end work that takes twice as
/// long.
const LONGEST_S: f64 = 1.0;

/// The limit of the work of one dispatch, from the measured times of earlier dispatches. Work is counted in estimated
/// plane tests; only the ratio between dispatches matters.
///
/// A few rays may be so long, as between stones and metal, that their dispatch exceeds the budget however little work it
/// has. Smaller dispatches would then only wait more often for such rays. So a line is fitted to the times, and where the
/// time without work takes most of the budget, a dispatch gets work for the rest of twice the budget, and at least for half
/// of the wait.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Throttle {
    budget_s: f64,
    most: f64,
    /// The work per second of the last dispatch.
    speed: f64,
    times: TimeLine,
    /// The number of the picture, or part of one, that was traced last.
    picture: u64,
}

/// The times of dispatches as a line over their work, by least squares in which newer dispatches weigh more.
#[derive(Debug, Clone, Copy, PartialEq)]
struct TimeLine {
    count: f64,
    /// The sums of work, time, squared work, and work times time.
    sums: [f64; 4],
    /// The least time per work of a dispatch, in seconds; older ones count for more than they were.
    least: f64,
}

impl Default for TimeLine {
    fn default() -> Self {
        Self { count: 0.0, sums: [0.0; 4], least: f64::INFINITY }
    }
}

impl TimeLine {
    fn add(&mut self, work: f64, took_s: f64) {
        self.count = FADE * self.count + 1.0;
        self.least = (FORGET * self.least).min(took_s / work);
        let new = [work, took_s, work * work, work * took_s];
        self.sums = std::array::from_fn(|k| FADE * self.sums[k] + new[k]);
    }

    /// Returns the expected time of a dispatch, in seconds; `None` before the first one.
    fn expected(&self, work: f64) -> Option<f64> {
        let [wait, slope] = self.fitted().unwrap_or([0.0, self.sums[1] / self.sums[0]]);
        (self.count > 0.0).then_some(wait + slope * work)
    }

    /// Returns the time without work, in seconds, and the time per work, neither below 0; `None` where all dispatches had about
    /// the same work.
    fn fitted(&self) -> Option<[f64; 2]> {
        let [work, time, square, product] = self.sums.map(|sum| sum / self.count);
        let spread = square - work * work;
        if self.count < 1.5 || spread <= EVEN * square {
            return None;
        }
        // A dispatch that waits long is followed by a smaller one, so the line alone would be too steep.
        let slope = ((product - work * time) / spread).min(self.least);
        Some(match time - slope * work {
            _ if slope <= 0.0 => [time, 0.0],
            wait if wait < 0.0 => [0.0, time / work],
            wait => [wait, slope],
        })
    }
}

impl Default for Throttle {
    fn default() -> Self {
        Self::new(BUDGET_S, FIRST)
    }
}

impl Throttle {
    /// Returns a throttle whose first dispatch is given at most `first` plane tests.
    pub fn new(budget_s: f64, first: f64) -> Self {
        Self { budget_s, most: first, speed: f64::INFINITY, times: TimeLine::default(), picture: 0 }
    }

    /// Returns the most work that the next dispatch may be given, above 0.
    pub fn most(&self) -> f64 {
        self.most
    }

    /// Goes on with the picture, or the part of one, that has this number. Where another one was traced last, its first
    /// dispatch is a cautious one by the speed measured so far.
    pub fn open(&mut self, picture: u64) {
        if self.picture != picture {
            let most = self.most.min(self.speed * self.budget_s * OPENING).max(LEAST);
            *self = Self { most, picture, times: TimeLine::default(), ..*self };
        }
    }

    /// Records that a dispatch of this much work took this long.
    pub fn note(&mut self, work: f64, took: Duration) {
        let took_s = took.as_secs_f64().max(1e-9);
        self.speed = work / took_s;
        let fits = self.budget_s / took_s;
        let off = self.times.expected(work).map_or(1.0, |expected| took_s / expected);
        if !(1.0 / CHANGED..=CHANGED).contains(&off) {
            self.times = TimeLine::default();
        }
        self.times.add(work, took_s);
        let mut most = self.most;
        if fits < 1.0 {
            // The aim is half the budget, so at least half of the work is left out.
            most = most.min(work * 0.5 * fits);
        } else if fits > 2.0 {
            most = most.max(work * (0.75 * fits).min(2.0));
        }
        if took_s < LONGEST_S {
            most = most.max(self.worth_waiting(work));
        }
        self.most = most.min(2.0 * self.most).max(LEAST);
    }

    /// Returns the work for which the waits of dispatches are worth while, at most twice that of the last one; 0 where the waits
    /// leave room for work within the budget.
    fn worth_waiting(&self, work: f64) -> f64 {
        match self.times.fitted() {
            Some([wait, slope]) if wait > 0.5 * self.budget_s => {
                let seconds = (2.0 * self.budget_s - wait).max(LEAST_SHARE * wait);
                (2.0 * work).min(seconds / slope)
            }
            _ => 0.0,
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
            for (picture, (part, took, opens)) in (1..).zip(times) {
                let before = throttle.most();
                throttle.note(before * part, Duration::from_secs_f64(took));
                if opens {
                    throttle.open(picture);
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

    /// Returns the time that a device takes for ten seconds of work, where each dispatch also waits for its longest ray, for up
    /// to `longest_s` seconds: by a spread that is even, or by one with few long waits. `None` where it takes a thousand times as
    /// long.
    fn in_all(longest_s: f64, is_even: bool, note: impl Fn(&mut Throttle, f64, f64)) -> Option<f64> {
        let (mut throttle, mut done, mut seconds) = (Throttle::default(), 0.0, 0.0);
        for k in 1.. {
            let part = (f64::from(k) * 0.618_034).fract();
            let wait = longest_s * if is_even { 0.25 + 0.75 * part } else { 0.01 / (1.01 - part) };
            let work = throttle.most().min(1e11 - done);
            let took = wait + 1e-10 * work;
            note(&mut throttle, work, took);
            (done, seconds) = (done + work, seconds + took);
            if done >= 1e11 {
                break;
            }
            if seconds > 1e4 {
                return None;
            }
        }
        Some(seconds)
    }

    proptest! {
        #[test]
        fn work_is_not_divided_in_vain_where_single_rays_take_longer_than_the_budget(
            longest_s in 0.001..0.6_f64, is_even: bool,
        ) {
            let note = |throttle: &mut Throttle, work, took| throttle.note(work, Duration::from_secs_f64(took));
            let seconds = in_all(longest_s, is_even, note).unwrap_or(f64::INFINITY);
            prop_assert!(seconds < 80.0, "{seconds} s");
        }
    }

    #[test]
    fn a_throttle_that_knows_no_waits_would_hardly_come_to_an_end() {
        let forgetful = |throttle: &mut Throttle, work, took| {
            throttle.times = TimeLine::default();
            throttle.note(work, Duration::from_secs_f64(took));
        };
        assert_eq!(in_all(0.5, true, forgetful), None);
    }

    #[test]
    fn a_picture_four_times_as_heavy_as_its_estimate_begins_within_the_budget() {
        let mut throttle = Throttle::default();
        times(&mut throttle, 40, |work| work / 1e9);
        throttle.open(1);
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
        let mut throttle = Throttle::new(BUDGET_S, 1024.0);
        throttle.note(1024.0, Duration::from_secs_f64(0.8 * BUDGET_S));
        assert_eq!(throttle.most(), 1024.0);
    }
}
