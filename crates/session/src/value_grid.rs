//! The grid on which a proportion is set, so that it stays within its limits.

use brillianteer_cut::{Cut, Proportion};

/// A bound beyond any proportion, which keeps requested values finite.
const FARTHEST: f64 = 1e9;
/// A value this near to a step, in steps, counts as lying on it.
const ON_STEP: f64 = 1e-6;

/// The grid on which values are set, by the number of its steps per percent or degree.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ValueGrid(f64);

impl ValueGrid {
    /// Whole steps.
    pub const WHOLE: Self = Self(1.0);
    /// Steps of a tenth.
    pub const COARSE: Self = Self(10.0);
    /// Steps of a hundredth.
    pub const FINE: Self = Self(100.0);

    /// Returns the size of one step, in percent or degrees.
    pub fn step(self) -> f64 {
        1.0 / self.0
    }

    /// Returns the last step that a value has reached on its way up or down, in steps.
    fn passed(self, value: f64, up: bool) -> f64 {
        let steps = value * self.0;
        if up { (steps + ON_STEP).floor() } else { (steps - ON_STEP).ceil() }
    }

    /// Returns a cut with a proportion at the step nearest to `wanted`, or as near to that step as the limits of the
    /// proportion allow.
    pub fn toward(self, row: &Proportion, cut: &Cut, wanted: f64) -> Cut {
        let possible = |step: f64| {
            let mut new = cut.clone();
            row.set(&mut new, step / self.0);
            new.check().is_ok().then_some(new)
        };
        let value = (row.get)(cut);
        let target = (wanted.clamp(-FARTHEST, FARTHEST) * self.0).round();
        if cut.check().is_err() || (target - value * self.0).abs() < ON_STEP {
            return cut.clone();
        }
        let passed = self.passed(value, target > value * self.0);
        let new = possible(target).or_else(|| last_possible(passed, target, possible));
        new.unwrap_or_else(|| cut.clone())
    }

    /// Returns a cut with a proportion so many steps higher or, negative, lower, as far as its limits allow.
    pub fn stepped(self, row: &Proportion, cut: &Cut, steps: i32) -> Cut {
        let passed = self.passed((row.get)(cut), steps > 0);
        self.toward(row, cut, (passed + f64::from(steps)) / self.0)
    }
}

/// Searches by halving for the last whole number on the way from `good` to `bad` at which `at` returns something, and
/// returns that; `None` if there is nothing beyond `good`.
fn last_possible<T>(mut good: f64, mut bad: f64, at: impl Fn(f64) -> Option<T>) -> Option<T> {
    let mut last = None;
    while (bad - good).abs() > 1.0 {
        let middle = ((good + bad) / 2.0).round();
        match at(middle) {
            Some(found) => (last, good) = (Some(found), middle),
            None => bad = middle,
        }
    }
    last
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_cut::{Crown, Pavilion, RoundBrilliant, TOLKOWSKY};

    fn tolkowsky() -> Cut {
        Cut::RoundBrilliant(TOLKOWSKY)
    }

    fn by_lengths() -> Cut {
        let lengths = (Crown::Height(15.0), Pavilion::Depth(43.0));
        Cut::RoundBrilliant(RoundBrilliant { crown: lengths.0, pavilion: lengths.1, ..TOLKOWSKY })
    }

    fn row(key: &str) -> &'static Proportion {
        tolkowsky().proportion(key).unwrap()
    }

    /// Returns the value of a proportion after it has been set toward another.
    fn set(cut: &Cut, key: &str, wanted: f64, grid: ValueGrid) -> f64 {
        (row(key).get)(&grid.toward(row(key), cut, wanted))
    }

    #[test]
    fn the_held_one_of_a_pair_stays_held_and_takes_the_value_asked_of_the_other() {
        let pairs = [
            ("crown_height", 17.3),
            ("crown_angle", 31.2),
            ("pavilion_depth", 44.4),
            ("pavilion_angle", 39.9),
        ];
        for (key, wanted) in pairs {
            for given in [tolkowsky(), by_lengths()] {
                let new = ValueGrid::COARSE.toward(row(key), &given, wanted);
                assert!(((row(key).get)(&new) - wanted).abs() < 1e-9);
                for (other, _) in pairs {
                    assert_eq!((row(other).is_given)(&new), (row(other).is_given)(&given), "{key} {other}");
                }
            }
        }
    }

    #[test]
    fn values_come_out_as_they_are_written() {
        assert_eq!(set(&tolkowsky(), "table", 56.32, ValueGrid::COARSE), 56.3);
        assert_eq!(set(&tolkowsky(), "table", 56.327, ValueGrid::FINE), 56.33);
        assert_eq!(set(&tolkowsky(), "crown_angle", 35.04, ValueGrid::COARSE), 35.0);
        assert_eq!(set(&by_lengths(), "crown_height", 12.31, ValueGrid::COARSE), 12.3);
    }

    #[test]
    fn what_would_cross_a_limit_stops_at_the_last_step_before_it() {
        let far = set(&tolkowsky(), "table", 1000.0, ValueGrid::COARSE);
        // The stars would lie flat with a larger table.
        let beyond = RoundBrilliant { table: far + 0.1, ..TOLKOWSKY };
        assert!(far > 75.0 && beyond.derived().is_err(), "{far}");
        for (key, wanted, expected) in [
            ("table", 0.0, 5.0),
            ("girdle_thickness", -1.0, 0.0),
            ("culet", 300.0, 99.9),
            ("pavilion_angle", 0.0, 2.0),
        ] {
            let new = set(&tolkowsky(), key, wanted, ValueGrid::COARSE);
            assert!((new - expected).abs() < 1e-9, "{key}: {new}");
        }
        assert!(set(&by_lengths(), "pavilion_angle", -107.0, ValueGrid::COARSE) < 2.2);
        assert_eq!(ValueGrid::FINE.toward(row("table"), &tolkowsky(), f64::NAN), tolkowsky());
        let impossible = Cut::RoundBrilliant(RoundBrilliant { table: 99.0, ..TOLKOWSKY });
        assert_eq!(ValueGrid::FINE.toward(row("table"), &impossible, 50.0), impossible);
    }

    #[test]
    fn a_step_goes_to_the_next_on_the_grid() {
        let step = |table, steps, grid: ValueGrid| {
            let cut = Cut::RoundBrilliant(RoundBrilliant { table, ..TOLKOWSKY });
            (row("table").get)(&grid.stepped(row("table"), &cut, steps))
        };
        assert_eq!([step(53.0, 1, ValueGrid::COARSE), step(53.0, -2, ValueGrid::COARSE)], [53.1, 52.8]);
        assert_eq!([step(53.07, 1, ValueGrid::COARSE), step(53.07, -1, ValueGrid::COARSE)], [53.1, 53.0]);
        assert_eq!([step(53.07, 1, ValueGrid::FINE), step(53.3, 1, ValueGrid::COARSE)], [53.08, 53.4]);
        assert_eq!(step(5.0, -1, ValueGrid::COARSE), 5.0);
    }
}
