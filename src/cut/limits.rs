//! The limits that a round brilliant must keep.
//!
//! Upper limits are geometry: beyond them a facet has nowhere to lie. Lower limits keep every facet well clear of its
//! neighbours, and catch fractions written for percent and radians written for degrees.

use super::proportion_error::{Limit, ProportionError, Unit};
use super::proportions::{Proportions, STAR_AZIMUTH};
use super::round_brilliant::{Crown, LowerHalf, Pavilion, RoundBrilliant};

/// The smallest table, percent. Above 1, so that a fraction is noticed.
const LEAST_TABLE: f64 = 5.0;
/// The flattest bezel or main, degrees. Above π/2, so that radians are noticed.
const LEAST_ANGLE: f64 = 2.0;
/// The shortest lower half, radial percent. Above 1, so that a fraction is noticed.
const LEAST_LOWER_HALF: f64 = 2.0;
/// The deepest stone, percent of its diameter. Up to there rounding stays below every tolerance.
const MOST_DEPTH: f64 = 300.0;

/// Returns the star length, percent, at which the stars lie flat with the table, because their tips lie on the bezels at the
/// table's level.
pub(super) fn least_star_length(table: f64) -> f64 {
    let (t, cos, sin) = (table / 100.0, STAR_AZIMUTH.cos(), STAR_AZIMUTH.sin());
    100.0 * t * sin * sin / (cos * (1.0 - t * cos))
}

/// Returns the number of girdle facets if it lies from 16 to 128.
///
/// # Errors
/// The limit crossed, and by how much.
pub fn girdle_facets(count: i64) -> Result<u32, ProportionError> {
    let whole = |limit, reason| Limit {
        key: "girdle_facets",
        value: count as f64,
        limit,
        unit: Unit::Count,
        inclusive: true,
        reason,
    };
    match u32::try_from(count) {
        Ok(valid @ 16..=128) => Ok(valid),
        _ if count < 16 => Err(ProportionError::TooSmall(whole(16.0, "one for each half facet"))),
        _ => Err(ProportionError::TooLarge(whole(128.0, "finer than which no girdle is faceted"))),
    }
}

/// Returns the proportions in the units of the closed form, or the first limit crossed.
pub(super) fn check(given: &RoundBrilliant) -> Result<Proportions, ProportionError> {
    finite(given)?;
    table(given.table)?;
    culet(given.culet)?;
    crown(given)?;
    pavilion(given)?;
    star_length(given)?;
    lower_half(given.lower_half)?;
    girdle_facets(i64::from(given.girdle_facets))?;
    let thickness = Range::percent("girdle_thickness", given.girdle_thickness);
    thickness.at_least(0.0, "a knife edge all round")?;
    let proportions = Proportions::unchecked(given);
    let depth = Range::percent("total_depth", 50.0 * proportions.total_depth());
    depth.at_most(MOST_DEPTH, "beyond which it is a needle, not a brilliant")?;
    Ok(proportions)
}

fn finite(given: &RoundBrilliant) -> Result<(), ProportionError> {
    let numbers = [
        ("table", given.table),
        named_crown(given.crown),
        named_pavilion(given.pavilion),
        ("star_length", given.star_length),
        named_lower_half(given.lower_half),
        ("girdle_thickness", given.girdle_thickness),
        ("culet", given.culet),
    ];
    match numbers.into_iter().find(|(_, value)| !value.is_finite()) {
        Some((key, value)) => Err(ProportionError::NotFinite { key, value }),
        None => Ok(()),
    }
}

fn named_crown(crown: Crown) -> (&'static str, f64) {
    match crown {
        Crown::Angle(degrees) => ("crown_angle", degrees),
        Crown::Height(percent) => ("crown_height", percent),
    }
}

fn named_pavilion(pavilion: Pavilion) -> (&'static str, f64) {
    match pavilion {
        Pavilion::Angle(degrees) => ("pavilion_angle", degrees),
        Pavilion::Depth(percent) => ("pavilion_depth", percent),
    }
}

fn named_lower_half(length: LowerHalf) -> (&'static str, f64) {
    match length {
        LowerHalf::Radial(percent) => ("lower_half_length", percent),
        LowerHalf::Vertical(percent) => ("lower_half_length_vertical", percent),
    }
}

fn table(percent: f64) -> Result<(), ProportionError> {
    let table = Range::percent("table", percent);
    table.at_least(LEAST_TABLE, "the smallest table taken")?;
    table.below(100.0 * STAR_AZIMUTH.cos(), "where no star facet fits between table and girdle")
}

fn culet(percent: f64) -> Result<(), ProportionError> {
    let culet = Range::percent("culet", percent);
    culet.at_least(0.0, "a pointed culet")?;
    culet.below(100.0, "where the culet would be as wide as the girdle")
}

fn crown(given: &RoundBrilliant) -> Result<(), ProportionError> {
    let (key, value) = named_crown(given.crown);
    let flattest = LEAST_ANGLE.to_radians().tan() * (50.0 - 0.5 * given.table);
    match given.crown {
        Crown::Angle(_) => Range::degrees(key, value).slope("where the bezels would stand upright"),
        Crown::Height(_) => Range::percent(key, value).at_least(flattest, "where the bezels lie at 2°"),
    }
}

fn pavilion(given: &RoundBrilliant) -> Result<(), ProportionError> {
    let (key, value) = named_pavilion(given.pavilion);
    let flattest = LEAST_ANGLE.to_radians().tan() * (50.0 - 0.5 * given.culet);
    match given.pavilion {
        Pavilion::Angle(_) => Range::degrees(key, value).slope("where the mains would stand upright"),
        Pavilion::Depth(_) => Range::percent(key, value).at_least(flattest, "where the mains lie at 2°"),
    }
}

fn star_length(given: &RoundBrilliant) -> Result<(), ProportionError> {
    let star = Range::percent("star_length", given.star_length);
    star.above(least_star_length(given.table), "where the star facets would lie flat with the table")?;
    star.below(100.0, "where the star tips would lie on the girdle and the upper halves stand upright")
}

fn lower_half(length: LowerHalf) -> Result<(), ProportionError> {
    let (key, value) = named_lower_half(length);
    let least = match length {
        LowerHalf::Radial(_) => LEAST_LOWER_HALF,
        LowerHalf::Vertical(_) => 100.0 - (100.0 - LEAST_LOWER_HALF) * STAR_AZIMUTH.cos(),
    };
    let range = Range::percent(key, value);
    range.at_least(least, "where the lower halves end within 2 % of the girdle, nearly upright")?;
    range.below(100.0, "where the lower halves would meet in the centre and leave no mains")
}

/// A value that is to be checked against its limits.
#[derive(Clone, Copy)]
struct Range {
    key: &'static str,
    value: f64,
    unit: Unit,
}

impl Range {
    fn percent(key: &'static str, value: f64) -> Self {
        Self { key, value, unit: Unit::Percent }
    }

    fn degrees(key: &'static str, value: f64) -> Self {
        Self { key, value, unit: Unit::Degrees }
    }

    fn above(self, limit: f64, reason: &'static str) -> Result<(), ProportionError> {
        self.keep(self.value > limit, ProportionError::TooSmall, (limit, false, reason))
    }

    fn at_least(self, limit: f64, reason: &'static str) -> Result<(), ProportionError> {
        self.keep(self.value >= limit, ProportionError::TooSmall, (limit, true, reason))
    }

    fn below(self, limit: f64, reason: &'static str) -> Result<(), ProportionError> {
        self.keep(self.value < limit, ProportionError::TooLarge, (limit, false, reason))
    }

    fn at_most(self, limit: f64, reason: &'static str) -> Result<(), ProportionError> {
        self.keep(self.value <= limit, ProportionError::TooLarge, (limit, true, reason))
    }

    fn keep(
        self,
        kept: bool,
        error: fn(Limit) -> ProportionError,
        (limit, inclusive, reason): (f64, bool, &'static str),
    ) -> Result<(), ProportionError> {
        let Self { key, value, unit } = self;
        if kept { Ok(()) } else { Err(error(Limit { key, value, limit, unit, inclusive, reason })) }
    }

    fn slope(self, upright: &'static str) -> Result<(), ProportionError> {
        self.at_least(LEAST_ANGLE, "the flattest facet taken")?;
        self.below(90.0, upright)
    }
}

#[cfg(test)]
mod tests {
    use super::super::round_brilliant::MODERN;
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
            assert_eq!(given.derived().unwrap_err().key(), key);
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
                matches!(given.derived(), Err(ProportionError::NotFinite { key, .. }) if key == expected)
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
