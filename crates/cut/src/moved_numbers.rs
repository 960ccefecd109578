//! Sets a number that follows from given ones, by changing those that it moves: all by one factor, angles by that of their
//! tangents.
//!
//! The depth of most cuts is linear in that factor. Only where rows differ by degrees it is not; there the secant method needs a few
//! steps more.

use super::Cut;
use super::family::Proportion;
use brillianteer_base::Unit;

/// The most steps of the secant method. Two are enough where the number is linear in the factor.
const MOST_STEPS: usize = 40;

/// The number is reached when it is off by no more than this part of itself: some roundings.
const REACHED: f64 = 1e-14;

impl Proportion {
    /// Sets a number that only follows from others by those that it [moves](Self::moves).
    pub(super) fn give_by_moving(&self, cut: &mut Cut, value: f64) {
        let rows: Vec<&'static Proportion> =
            self.moves.iter().filter_map(|key| cut.proportion(key)).collect();
        let usual = cut.family().map(|family| &family.first);
        // From 0 and from what is infinite no factor leads away.
        let scalable = |row: &&Proportion| row.scaled((row.get)(cut), 2.0).is_normal();
        let base = match usual {
            Some(usual) if !rows.iter().all(scalable) => {
                let mut base = cut.clone();
                rows.iter().for_each(|row| row.set(&mut base, (row.get)(usual)));
                base
            }
            _ => cut.clone(),
        };
        let scaled = |factor: f64| {
            let mut new = base.clone();
            rows.iter().for_each(|row| row.set(&mut new, row.scaled((row.get)(&base), factor)));
            new
        };
        let factor =
            if value.is_finite() { solve(|factor| (self.get)(&scaled(factor)), value) } else { value };
        *cut = scaled(factor);
    }

    /// Returns a value of this row times a factor; an angle by its tangent.
    fn scaled(&self, value: f64, factor: f64) -> f64 {
        match self.unit {
            Unit::Degrees => (value.to_radians().tan() * factor).atan().to_degrees(),
            _ => value * factor,
        }
    }
}

/// Returns the place, near 1, at which a nearly linear function has a value, by the secant method.
fn solve(of: impl Fn(f64) -> f64, value: f64) -> f64 {
    let mut far = (0.5, of(0.5) - value);
    let mut near = (1.0, of(1.0) - value);
    for _ in 0..MOST_STEPS {
        if near.1.abs() <= REACHED * value.abs() {
            break;
        }
        let next = near.0 - near.1 * (near.0 - far.0) / (near.1 - far.1);
        if !next.is_finite() {
            break;
        }
        (far, near) = (near, (next, of(next) - value));
    }
    near.0
}

#[cfg(test)]
mod tests {
    use super::super::FAMILIES;
    use super::*;

    /// Returns the rows that move others, of all families, with a possible cut of the family.
    fn moving() -> impl Iterator<Item = (&'static Proportion, &'static Cut)> {
        FAMILIES.into_iter().flat_map(|family| {
            let moving = family.proportions.iter().filter(|row| !row.moves.is_empty());
            moving.map(move |row| (row, &family.first))
        })
    }

    #[test]
    fn a_depth_that_is_set_is_read_back_and_leads_back_to_the_same_numbers() {
        let mut count = 0;
        for (row, first) in moving() {
            let start = (row.get)(first);
            let [least, most] = row.usual;
            for part in [0.0, 0.37, 1.0] {
                let wanted = least + (most - least) * part;
                let mut cut = first.clone();
                row.set(&mut cut, wanted);
                assert!(((row.get)(&cut) - wanted).abs() < 1e-9, "{cut:?}");
                assert_eq!(cut.check(), Ok(()), "{wanted} {cut:?}");
                assert_ne!(cut, *first);
                row.set(&mut cut, start);
                for ((row, now), (_, before)) in cut.given().zip(first.given()) {
                    assert!((now - before).abs() < 1e-9, "{row:?} of {first:?}: {now}");
                }
                count += 1;
            }
        }
        assert_eq!(count, 3 * 23);
    }

    #[test]
    fn only_the_numbers_that_a_depth_moves_change() {
        for (row, first) in moving() {
            let mut cut = first.clone();
            row.set(&mut cut, (row.get)(first) + 1.0);
            for ((given, now), (_, before)) in cut.given().zip(first.given()) {
                let moves = |key: &&str| *key == given.key || given.pair == Some(key);
                assert_eq!(now != before, row.moves.iter().any(moves), "{given:?} of {first:?}");
            }
        }
    }

    #[test]
    fn a_depth_that_no_stone_has_is_read_back_as_well_and_named_as_impossible() {
        for (row, first) in moving() {
            for wanted in [1.0, 4000.0] {
                let mut cut = first.clone();
                row.set(&mut cut, wanted);
                assert!(((row.get)(&cut) / wanted - 1.0).abs() < 1e-6, "{:?}", cut);
                assert!(cut.check().is_err(), "{cut:?}");
                let error = row.reached(first, wanted).unwrap_err();
                let limit = error.limit().unwrap();
                assert!(limit.row == row && limit.value == wanted, "{error}");
                // From the same numbers, so that it is the same to the last bit.
                let mut cut = first.clone();
                row.set(&mut cut, limit.limit);
                assert_eq!(cut.check(), Ok(()), "{error}");
                // A little beyond the limit there is no stone.
                row.set(&mut cut, limit.limit + 0.02_f64.copysign(wanted - limit.limit));
                assert!(cut.check().is_err(), "{error} of {first:?}: {cut:?}");
            }
        }
    }

    #[test]
    fn a_depth_too_large_for_any_number_is_refused() {
        for (row, first) in moving() {
            for wanted in [1e18, 1e300] {
                let limit = *row.reached(first, wanted).unwrap_err().limit().unwrap();
                assert!(limit.value == wanted && limit.limit < 1e4, "{limit:?} of {first:?}");
            }
        }
    }

    #[test]
    fn numbers_that_are_not_finite_are_named() {
        for (row, first) in moving() {
            let mut cut = first.clone();
            row.set(&mut cut, f64::NAN);
            assert!(cut.check().unwrap_err().to_string().contains("is not a finite number"));
        }
    }
}
