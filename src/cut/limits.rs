//! Checks proportions against the bounds of their family's table.

use super::Cut;
use super::family::{Bound, BoundAt, Proportion};
use super::proportion_error::{Limit, ProportionError};

impl Cut {
    /// Checks the proportions; a cut that lists its facets or triangles has none.
    ///
    /// # Errors
    /// The first bound crossed, and by how much. Bounds that depend on other proportions come after fixed ones, and those
    /// of derived numbers at last, so that they are computed from what is possible by itself.
    pub fn check(&self) -> Result<(), ProportionError> {
        if let Some((row, value)) = self.given().find(|(_, value)| !value.is_finite()) {
            return Err(ProportionError::NotFinite { row, value });
        }
        self.given().try_for_each(|(row, value)| row.check_fixed(value))?;
        let all = self.proportions().iter().filter(|row| row.is_given(self) || row.give.is_none());
        for row in all.filter(|row| row.least.is_some() || row.most.is_some()) {
            row.check((row.get)(self), |at| Some(at.of(self)))?;
        }
        Ok(())
    }
}

impl BoundAt {
    /// Returns where the bound lies for a cut.
    pub fn of(self, cut: &Cut) -> f64 {
        match self {
            Self::Fixed(at) => at,
            Self::Of(at) => at(cut),
        }
    }
}

impl Proportion {
    /// Checks a value against the bounds that depend on nothing else.
    ///
    /// # Errors
    /// The bound crossed, and by how much.
    pub fn check_fixed(&'static self, value: f64) -> Result<(), ProportionError> {
        self.check(value, |at| match at {
            BoundAt::Fixed(at) => Some(at),
            BoundAt::Of(_) => None,
        })
    }

    fn check(
        &'static self,
        value: f64,
        place: impl Fn(BoundAt) -> Option<f64>,
    ) -> Result<(), ProportionError> {
        let crossed = |bound: &Option<Bound>, side: f64| {
            let Bound { at, inclusive, reason } = (*bound)?;
            let limit = place(at)?;
            let room = side * (value - limit);
            let is_kept = room > 0.0 || (inclusive && value == limit);
            (!is_kept).then_some(Limit { row: self, value, limit, inclusive, reason })
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

    fn text(given: RoundBrilliant) -> String {
        given.derived().unwrap_err().to_string()
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
        use {Crown::*, LowerHalf::*, Pavilion as P};
        let cases = [
            (RoundBrilliant { table: 4.0, ..MODERN }, "table: 4 % must be at least 5 %"),
            (RoundBrilliant { table: 93.0, ..MODERN }, "table: 93 % must be below 92.39 %"),
            (RoundBrilliant { crown: Angle(0.0), ..MODERN }, "crown_angle: 0° must be at least 2°"),
            (RoundBrilliant { crown: Angle(90.0), ..MODERN }, "crown_angle: 90° must be below 90°"),
            (RoundBrilliant { crown: Height(-1.0), ..MODERN }, "crown_height: -1 % must be at least 0.77 %"),
            (
                RoundBrilliant { pavilion: P::Angle(1.9), ..MODERN },
                "pavilion_angle: 1.9° must be at least 2°",
            ),
            (RoundBrilliant { pavilion: P::Angle(95.0), ..MODERN }, "pavilion_angle: 95° must be below 90°"),
            (
                RoundBrilliant { pavilion: P::Depth(1.0), ..MODERN },
                "pavilion_depth: 1 % must be at least 1.75 %",
            ),
            (RoundBrilliant { star_length: 100.0, ..MODERN }, "star_length: 100 % must be below 100 %"),
            (
                RoundBrilliant { lower_half: Radial(1.5), ..MODERN },
                "lower_half_length: 1.5 % must be at least 2 %",
            ),
            (
                RoundBrilliant { lower_half: Radial(101.0), ..MODERN },
                "lower_half_length: 101 % must be below 100 %",
            ),
            (
                RoundBrilliant { lower_half: Vertical(7.0), ..MODERN },
                "lower_half_length_vertical: 7 % must be at least 9.46 %",
            ),
            (
                RoundBrilliant { girdle_thickness: -0.5, ..MODERN },
                "girdle_thickness: -0.5 % must be at least 0 %, a knife edge all round; raise it by at least 0.5",
            ),
            (RoundBrilliant { girdle_facets: 15, ..MODERN }, "girdle_facets: 15 must be at least 16"),
            (RoundBrilliant { girdle_facets: 200, ..MODERN }, "girdle_facets: 200 must be at most 128"),
            (RoundBrilliant { culet: -1.0, ..MODERN }, "culet: -1 % must be at least 0 %"),
            (RoundBrilliant { culet: 100.0, ..MODERN }, "culet: 100 % must be below 100 %"),
            (RoundBrilliant { crown: Angle(89.9), ..MODERN }, "total_depth: 12651."),
            (
                RoundBrilliant { pavilion: P::Depth(1e300), ..MODERN },
                "total_depth: 1e300 % must be at most 300 %",
            ),
        ];
        for (given, expected) in cases {
            assert!(text(given).starts_with(expected), "{} is not {expected}", text(given));
            let key = expected.split(':').next().unwrap();
            assert_eq!(given.derived().unwrap_err().row().key, key);
        }
    }

    #[test]
    fn numbers_that_are_not_finite_are_named() {
        let mut cases = [MODERN; 7];
        cases[0].table = f64::NAN;
        cases[1].crown = Crown::Height(f64::INFINITY);
        cases[2].pavilion = Pavilion::Angle(f64::NAN);
        cases[3].star_length = f64::NEG_INFINITY;
        cases[4].lower_half = LowerHalf::Vertical(f64::NAN);
        cases[5].girdle_thickness = f64::NAN;
        cases[6].culet = f64::INFINITY;
        let keys = [
            "table",
            "crown_height",
            "pavilion_angle",
            "star_length",
            "lower_half_length_vertical",
            "girdle_thickness",
            "culet",
        ];
        for (given, expected) in cases.into_iter().zip(keys) {
            assert!(
                matches!(given.derived(), Err(ProportionError::NotFinite { row, .. }) if row.key == expected)
            );
        }
        assert_eq!(text(cases[0]), "table: NaN is not a finite number; write what was measured");
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
