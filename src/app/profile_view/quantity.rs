//! The proportions that can be changed by dragging the profile: how they are read, set and kept within their limits.

use crate::app::panels::proportions::{set_crown, set_pavilion};
use crate::cut::{Crown, Derived, Pavilion, RoundBrilliant};
use crate::picture::profile::{degrees, percent};

/// A bound beyond any proportion, which keeps requested values finite.
const FARTHEST: f64 = 1e4;
/// A value this near to a step, in steps, counts as standing on it.
const ON_STEP: f64 = 1e-6;

/// A proportion of a round brilliant, in percent of the girdle diameter or degrees.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// The size of the table, in percent.
    Table,
    /// The crown height, in percent.
    CrownHeight,
    /// The crown angle, in degrees.
    CrownAngle,
    /// The girdle thickness at the bezels, in percent.
    Girdle,
    /// The pavilion angle, in degrees.
    PavilionAngle,
    /// The pavilion depth, in percent.
    PavilionDepth,
    /// The size of the culet, in percent.
    Culet,
}

/// The grid on which values are set: so many steps to a percent or degree.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ValueGrid(f64);

impl ValueGrid {
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
}

impl Quantity {
    /// Returns the name of the proportion.
    pub fn name(self) -> &'static str {
        match self {
            Self::Table => "Table",
            Self::CrownHeight => "Crown height",
            Self::CrownAngle => "Crown angle",
            Self::Girdle => "Girdle",
            Self::PavilionAngle => "Pavilion angle",
            Self::PavilionDepth => "Pavilion depth",
            Self::Culet => "Culet",
        }
    }

    /// Returns the name of the unit.
    pub fn unit(self) -> &'static str {
        if self.is_angle() { "degrees" } else { "percent" }
    }

    /// Writes a value with its unit.
    pub fn written(self, value: f64) -> String {
        if self.is_angle() { degrees(value) } else { percent(value) }
    }

    fn is_angle(self) -> bool {
        matches!(self, Self::CrownAngle | Self::PavilionAngle)
    }

    /// Whether this proportion follows from the other one of its pair, which is held.
    pub fn follows(self, given: &RoundBrilliant) -> bool {
        match self {
            Self::CrownHeight => matches!(given.crown, Crown::Angle(_)),
            Self::CrownAngle => matches!(given.crown, Crown::Height(_)),
            Self::PavilionDepth => matches!(given.pavilion, Pavilion::Angle(_)),
            Self::PavilionAngle => matches!(given.pavilion, Pavilion::Depth(_)),
            Self::Table | Self::Girdle | Self::Culet => false,
        }
    }

    /// Returns the value of this proportion.
    pub fn of(self, given: &RoundBrilliant, derived: &Derived) -> f64 {
        match self {
            Self::Table => given.table,
            Self::CrownHeight => derived.crown_height,
            Self::CrownAngle => derived.crown_angle,
            Self::Girdle => given.girdle_thickness,
            Self::PavilionAngle => derived.pavilion_angle,
            Self::PavilionDepth => derived.pavilion_depth,
            Self::Culet => given.culet,
        }
    }

    /// Returns the proportions with another value of this one, whether they are possible or not. Of a pair, the same one
    /// stays held.
    fn with(self, given: &RoundBrilliant, value: f64) -> RoundBrilliant {
        let mut new = *given;
        match self {
            Self::Table => new.table = value,
            Self::Girdle => new.girdle_thickness = value,
            Self::Culet => new.culet = value,
            Self::CrownHeight => set_crown(&mut new, Crown::Height(value)),
            Self::CrownAngle => set_crown(&mut new, Crown::Angle(value)),
            Self::PavilionDepth => set_pavilion(&mut new, Pavilion::Depth(value)),
            Self::PavilionAngle => set_pavilion(&mut new, Pavilion::Angle(value)),
        }
        new
    }

    /// Returns the proportions with this one at the step nearest to `wanted`, or as near to that as its limits allow.
    pub fn toward(self, given: &RoundBrilliant, wanted: f64, grid: ValueGrid) -> RoundBrilliant {
        let Ok(derived) = given.derived() else { return *given };
        let at = |step: f64| Some(self.with(given, step / grid.0)).filter(|new| new.derived().is_ok());
        let value = self.of(given, &derived);
        let target = (wanted.clamp(-FARTHEST, FARTHEST) * grid.0).round();
        if (target - value * grid.0).abs() < ON_STEP {
            return *given;
        }
        let passed = grid.passed(value, target > value * grid.0);
        at(target).or_else(|| last_possible(passed, target, at)).unwrap_or(*given)
    }

    /// Returns the proportions with this one so many steps of the grid higher or, negative, lower, as far as its limits
    /// allow.
    pub fn stepped(self, given: &RoundBrilliant, steps: i32, grid: ValueGrid) -> RoundBrilliant {
        let Ok(derived) = given.derived() else { return *given };
        let passed = grid.passed(self.of(given, &derived), steps > 0);
        self.toward(given, (passed + f64::from(steps)) / grid.0, grid)
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
    use crate::cut::TOLKOWSKY;

    fn by_lengths() -> RoundBrilliant {
        RoundBrilliant { crown: Crown::Height(15.0), pavilion: Pavilion::Depth(43.0), ..TOLKOWSKY }
    }

    fn value(quantity: Quantity, given: &RoundBrilliant) -> f64 {
        quantity.of(given, &given.derived().unwrap())
    }

    #[test]
    fn the_held_one_of_a_pair_stays_held_and_takes_the_value_asked_of_the_other() {
        use Quantity::*;
        for (quantity, wanted) in
            [(CrownHeight, 17.3), (CrownAngle, 31.2), (PavilionDepth, 44.4), (PavilionAngle, 39.9)]
        {
            for given in [TOLKOWSKY, by_lengths()] {
                let new = quantity.toward(&given, wanted, ValueGrid::COARSE);
                assert!((value(quantity, &new) - wanted).abs() < 1e-9);
                for other in [CrownHeight, CrownAngle, PavilionDepth, PavilionAngle] {
                    assert_eq!(other.follows(&new), other.follows(&given), "{quantity:?} {other:?}");
                }
            }
        }
    }

    #[test]
    fn values_come_out_as_they_are_written() {
        let new = Quantity::Table.toward(&TOLKOWSKY, 56.32, ValueGrid::COARSE);
        assert_eq!(new.table, 56.3);
        assert_eq!(Quantity::Table.toward(&TOLKOWSKY, 56.327, ValueGrid::FINE).table, 56.33);
        assert_eq!(
            Quantity::CrownAngle.toward(&TOLKOWSKY, 35.04, ValueGrid::COARSE).crown,
            Crown::Angle(35.0)
        );
        assert_eq!(
            Quantity::CrownHeight.toward(&by_lengths(), 12.31, ValueGrid::COARSE).crown,
            Crown::Height(12.3)
        );
    }

    #[test]
    fn what_would_cross_a_limit_stops_at_the_last_step_before_it() {
        let far = Quantity::Table.toward(&TOLKOWSKY, 1000.0, ValueGrid::COARSE).table;
        // The stars would lie flat with a larger table.
        let beyond = RoundBrilliant { table: far + 0.1, ..TOLKOWSKY };
        assert!(far > 75.0 && beyond.derived().is_err(), "{far}");
        for (quantity, wanted, expected) in [
            (Quantity::Table, 0.0, 5.0),
            (Quantity::Girdle, -1.0, 0.0),
            (Quantity::Culet, 300.0, 99.9),
            (Quantity::PavilionAngle, 0.0, 2.0),
        ] {
            let new = quantity.toward(&TOLKOWSKY, wanted, ValueGrid::COARSE);
            assert!(
                (value(quantity, &new) - expected).abs() < 1e-9,
                "{quantity:?}: {}",
                value(quantity, &new)
            );
        }
        let flat = Quantity::PavilionAngle.toward(&by_lengths(), -107.0, ValueGrid::COARSE);
        assert!(value(Quantity::PavilionAngle, &flat) < 2.2);
        assert_eq!(Quantity::Table.toward(&TOLKOWSKY, f64::NAN, ValueGrid::FINE), TOLKOWSKY);
        let impossible = RoundBrilliant { table: 99.0, ..TOLKOWSKY };
        assert_eq!(Quantity::Table.toward(&impossible, 50.0, ValueGrid::FINE), impossible);
    }

    #[test]
    fn a_step_goes_to_the_next_on_the_grid() {
        let step = |table, steps, grid| {
            Quantity::Table.stepped(&RoundBrilliant { table, ..TOLKOWSKY }, steps, grid).table
        };
        assert_eq!([step(53.0, 1, ValueGrid::COARSE), step(53.0, -2, ValueGrid::COARSE)], [53.1, 52.8]);
        assert_eq!([step(53.07, 1, ValueGrid::COARSE), step(53.07, -1, ValueGrid::COARSE)], [53.1, 53.0]);
        assert_eq!([step(53.07, 1, ValueGrid::FINE), step(53.3, 1, ValueGrid::COARSE)], [53.08, 53.4]);
        assert_eq!(step(5.0, -1, ValueGrid::COARSE), 5.0);
    }
}
