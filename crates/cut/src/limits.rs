//! Checks proportions against the bounds of their family's table.

use super::Cut;
use super::facet_net::NoRoom;
use super::family::{Bound, BoundAt, Proportion};
use super::proportion_error::{Limit, ProportionError};

impl Cut {
    /// Checks the proportions; a cut that lists its facets or triangles has none.
    ///
    /// # Errors
    /// The error names the first bound that is crossed, and the excess. Bounds that depend on other proportions are
    /// tested after fixed ones, and those of derived numbers last, so that they are computed from possible numbers.
    /// Where a derived number crosses its bound, the error names the given proportion that leads to it.
    pub fn check(&self) -> Result<(), ProportionError> {
        self.check_numbers()?;
        match self {
            Self::Family(cut) => cut.settled().map(|_| ()).map_err(|unfit| self.without_room(unfit)),
            _ => Ok(()),
        }
    }

    /// Checks the proportions as [`check`](Self::check) does, except for the room of the facets of a
    /// [`FamilyCut`](super::FamilyCut).
    pub(super) fn check_numbers(&self) -> Result<(), ProportionError> {
        if let Some((row, value)) = self.given().find(|(_, value)| !value.is_finite()) {
            return Err(ProportionError::NotFinite { row, value });
        }
        self.given().try_for_each(|(row, value)| row.check_fixed(value))?;
        let all = self.proportions().iter().filter(|row| (row.is_given)(self));
        for row in all.filter(|row| row.least.is_some() || row.most.is_some()) {
            row.check((row.get)(self), Some(self)).map_err(|error| self.in_given_terms(row, error))?;
        }
        Ok(())
    }

    /// Returns the error of facets without room in terms of one given proportion, with its limit: of those that alone
    /// make room when they are usual, the one that is farthest from its usual range; of all, where none makes room
    /// alone.
    pub(super) fn without_room(&self, unfit: NoRoom) -> ProportionError {
        let given: Vec<(&'static Proportion, f64)> = self.given().collect();
        let first = self.family().map(|family| &family.first);
        let usual = |row: &Proportion| first.map_or(f64::NAN, |first| (row.get)(first));
        let with = |cut: &Self, row: &Proportion, value| {
            let mut cut = cut.clone();
            row.set(&mut cut, value);
            cut
        };
        let fits = |cut: &Self| matches!(cut, Self::Family(cut) if cut.settled().is_ok());
        let unusual = |(row, value): &(&Proportion, f64)| {
            (value - usual(row)).abs() / (row.usual[1] - row.usual[0]).max(f64::MIN_POSITIVE)
        };
        let most = |rows: &mut dyn Iterator<Item = (&'static Proportion, f64)>| {
            rows.max_by(|a, b| unusual(a).total_cmp(&unusual(b)))
        };
        let heals = |(row, _): &(&'static Proportion, f64)| fits(&with(self, row, usual(row)));
        let alone = most(&mut given.iter().copied().filter(heals));
        let others = if alone.is_some() { self } else { first.unwrap_or(self) };
        let (row, value) =
            alone.or_else(|| most(&mut given.iter().copied())).expect("every family has proportions");
        let limit = farthest(usual(row), value, |value| fits(&with(others, row, value)));
        // The limit of a count is a possible count.
        let limit = (row.get)(&with(others, row, limit));
        let limit = Limit {
            row,
            value,
            limit,
            inclusive: true,
            reason: "beyond which no room is left",
            tier: unfit.tier,
        };
        if value > limit.limit { ProportionError::TooLarge(limit) } else { ProportionError::TooSmall(limit) }
    }

    /// Returns the error of a derived number in terms of the given proportion that changes that number most, with the
    /// limit of that proportion.
    ///
    /// The limit holds with the other proportions as they are, or, where they alone cross the bound, with usual ones.
    fn in_given_terms(&self, derived: &'static Proportion, error: ProportionError) -> ProportionError {
        let (Some(family), Some(limit), None) = (self.family(), error.limit(), derived.give) else {
            return error;
        };
        let usual = |row: &Proportion| (row.get)(&family.first);
        let with = |cut: &Self, row: &Proportion, value| {
            let mut cut = cut.clone();
            row.set(&mut cut, value);
            cut
        };
        let keeps = |cut: &Self| derived.check((derived.get)(cut), Some(cut)).is_ok();
        let share = |row: &Proportion| {
            let eased = with(self, row, usual(row));
            // Infinite numbers have no difference.
            ((derived.get)(self) - (derived.get)(&eased)).abs().max(0.0)
        };
        let given = family.editable().filter(|row| (row.is_given)(self));
        let Some(row) = given.max_by(|a, b| share(a).total_cmp(&share(b))) else { return error };
        let others = if keeps(&with(self, row, usual(row))) { self } else { &family.first };
        let value = (row.get)(self);
        let at = farthest(usual(row), value, |value| keeps(&with(others, row, value)));
        let limit = Limit { row, value, limit: at, inclusive: true, reason: limit.reason, tier: limit.tier };
        if value > at { ProportionError::TooLarge(limit) } else { ProportionError::TooSmall(limit) }
    }
}

/// A number is reached where it is off by no more than this part of itself; far above rounding, far below what shows.
const REACHED: f64 = 1e-6;

impl Proportion {
    /// Returns a cut with this number set, after a check that the stone can have it.
    ///
    /// # Errors
    /// The limit of this number, with the others as they are, and by how much it is crossed. A cut that is impossible for another
    /// reason as well is returned as it is.
    pub fn reached(&'static self, cut: &Cut, value: f64) -> Result<Cut, ProportionError> {
        let with = |value: f64| {
            let mut cut = cut.clone();
            self.set(&mut cut, value);
            cut
        };
        let usual = (self.get)(cut);
        if !value.is_finite() {
            return Err(ProportionError::NotFinite { row: self, value });
        }
        // Huge values are not reached at all, because the numbers that would have to move round to others.
        let has = |cut: &Cut, value: f64| ((self.get)(cut) - value).abs() <= REACHED * value.abs().max(1.0);
        let is_possible = |cut: &Cut, value: f64| has(cut, value) && cut.check().is_ok();
        let wanted = with(value);
        if is_possible(&wanted, value) || cut.check().is_err() && has(&wanted, value) {
            return Ok(wanted);
        }
        let limit = farthest(usual, value, |value| is_possible(&with(value), value));
        let reason = "beyond which no stone has it with the other numbers as they are";
        let limit = Limit { row: self, value, limit, inclusive: true, reason, tier: "" };
        Err(if value > limit.limit {
            ProportionError::TooLarge(limit)
        } else {
            ProportionError::TooSmall(limit)
        })
    }
}

/// Returns the last possible value on the way from a possible to an impossible one, with two decimals if those are
/// enough to leave the possible value.
fn farthest(possible: f64, impossible: f64, is_possible: impl Fn(f64) -> bool) -> f64 {
    let (mut good, mut bad) = (possible, impossible);
    loop {
        let middle = good + (bad - good) / 2.0;
        if middle == good || middle == bad {
            break;
        }
        *(if is_possible(middle) { &mut good } else { &mut bad }) = middle;
    }
    let hundreds = 100.0 * good;
    let short = if bad > good { hundreds.floor() } else { hundreds.ceil() } / 100.0;
    if is_possible(short) { short } else { good }
}

impl Proportion {
    /// Checks a value against the bounds that depend on nothing else.
    ///
    /// # Errors
    /// The error names the bound that is crossed, and the excess.
    pub fn check_fixed(&'static self, value: f64) -> Result<(), ProportionError> {
        self.check(value, None)
    }

    /// Checks a value; without a cut only against the bounds that depend on nothing else.
    fn check(&'static self, value: f64, cut: Option<&Cut>) -> Result<(), ProportionError> {
        let crossed = |bound: &Option<Bound>, side: f64| {
            let Bound { at, inclusive, reason } = (*bound)?;
            let limit = match at {
                BoundAt::Fixed(at) => at,
                BoundAt::Of(at) => at(cut?),
            };
            let is_kept = side * (value - limit) > 0.0 || (inclusive && value == limit);
            (!is_kept).then_some(Limit { row: self, value, limit, inclusive, reason, tier: "" })
        };
        let too_small = crossed(&self.least, 1.0).map(ProportionError::TooSmall);
        let error = too_small.or_else(|| crossed(&self.most, -1.0).map(ProportionError::TooLarge));
        error.map_or(Ok(()), Err)
    }
}

#[cfg(test)]
mod tests {
    use super::super::round_brilliant::{Crown, LowerHalf, MODERN, Pavilion, RoundBrilliant};
    use super::*;
    use brillianteer_base::Unit;

    fn text(given: RoundBrilliant) -> String {
        given.derived().unwrap_err().to_string()
    }

    /// Returns a modern brilliant that gives one of its proportions this value.
    fn with(key: &str, value: f64) -> Cut {
        let mut cut = Cut::RoundBrilliant(MODERN);
        (cut.proportion(key).unwrap().give.unwrap())(&mut cut, value);
        cut
    }

    #[test]
    fn a_star_that_cannot_rise_says_by_how_much_it_is_short() {
        let given = RoundBrilliant { table: 53.0, star_length: 12.0, ..MODERN };
        assert_eq!(
            text(given),
            "star_length: 12 % must be above 16.46 %, where the star facets would lie flat with the table; \
             raise it by at least 4.47"
        );
        assert!(RoundBrilliant { star_length: 12.0 + 4.47, ..given }.derived().is_ok());
    }

    #[test]
    fn every_limit_names_its_proportion_and_itself() {
        for (key, value, expected) in [
            ("table", 4.0, "4 % must be at least 5 %"),
            ("table", 93.0, "93 % must be below 92.39 %"),
            ("crown_angle", 0.0, "0° must be at least 2°"),
            ("crown_angle", 90.0, "90° must be below 90°"),
            ("crown_height", -1.0, "-1 % must be at least 0.77 %"),
            ("pavilion_angle", 1.9, "1.9° must be at least 2°"),
            ("pavilion_angle", 95.0, "95° must be below 90°"),
            ("pavilion_depth", 1.0, "1 % must be at least 1.75 %"),
            ("star_length", 100.0, "100 % must be below 100 %"),
            ("lower_half_length", 1.5, "1.5 % must be at least 2 %"),
            ("lower_half_length", 101.0, "101 % must be below 100 %"),
            ("lower_half_length_vertical", 7.0, "7 % must be at least 9.46 %"),
            (
                "girdle_thickness",
                -0.5,
                "-0.5 % must be at least 0 %, a knife edge all round; raise it by at least 0.5",
            ),
            ("girdle_facets", 15.0, "15 must be at least 16"),
            ("girdle_facets", 200.0, "200 must be at most 128"),
            ("culet", -1.0, "-1 % must be at least 0 %"),
            ("culet", 100.0, "100 % must be below 100 %"),
        ] {
            let error = with(key, value).check().unwrap_err();
            assert!(
                error.to_string().starts_with(&format!("{key}: {expected}")),
                "{error} is not {expected}"
            );
            assert_eq!(error.row().key, key);
        }
    }

    #[test]
    fn a_stone_that_is_too_deep_is_the_fault_of_the_number_that_was_given() {
        let depth = "above which the total depth is more than 300 %";
        for (key, value, limit) in [
            ("crown_angle", 89.9, "85.04°"),
            ("crown_height", 1e9, "253.84 %"),
            ("pavilion_angle", 85.0, "79.94°"),
            ("pavilion_depth", 1e300, "281.87 %"),
            ("girdle_thickness", 400.0, "241.72 %"),
        ] {
            let error = with(key, value).check().unwrap_err();
            let text = error.to_string();
            assert!(text.starts_with(&format!("{key}: ")), "{text}");
            assert!(text.contains(&format!(" must be at most {limit}, {depth}")), "{text} is not {limit}");
            // The limit that the message names makes a stone.
            assert_eq!(with(key, error.limit().unwrap().limit).check(), Ok(()), "{key}");
        }
    }

    #[test]
    fn where_crown_and_pavilion_are_both_too_deep_the_deeper_one_is_named_first() {
        let mut both = with("crown_angle", 88.0);
        (both.proportion("pavilion_angle").unwrap().give.unwrap())(&mut both, 89.0);
        let error = both.check().unwrap_err();
        assert_eq!(error.row().key, "pavilion_angle");
        (both.proportion("pavilion_angle").unwrap().give.unwrap())(&mut both, error.limit().unwrap().limit);
        let error = both.check().unwrap_err();
        assert_eq!(error.row().key, "crown_angle");
    }

    #[test]
    fn numbers_that_are_not_finite_are_named() {
        let modern = Cut::RoundBrilliant(MODERN);
        for row in modern.family().unwrap().editable().filter(|row| row.unit != Unit::Count) {
            for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                let error = with(row.key, value).check().unwrap_err();
                assert!(matches!(error, ProportionError::NotFinite { row: at, .. } if at == row), "{error}");
            }
        }
        let nan = with("table", f64::NAN).check().unwrap_err().to_string();
        assert_eq!(nan, "table: NaN is not a finite number; write what was measured");
    }

    #[test]
    fn just_inside_its_limits_a_stone_is_taken() {
        let upper = RoundBrilliant { table: 92.38, star_length: 99.999, girdle_thickness: 0.0, ..MODERN };
        let lower = RoundBrilliant {
            table: 5.0,
            crown: Crown::Angle(2.0),
            pavilion: Pavilion::Angle(2.0),
            star_length: 0.9,
            lower_half: LowerHalf::Radial(2.0),
            girdle_facets: 16,
            culet: 99.0,
            ..MODERN
        };
        for given in [upper, lower] {
            assert!(given.facets().unwrap().iter().all(|(_, plane)| plane.normalized().is_some()));
        }
    }
}
