//! Warnings about round brilliants that are possible but unusual, with the numbers that make them so.

use std::f64::consts::TAU;

use super::proportion_error::{given, rounded};
use super::proportions::{Proportions, STAR_AZIMUTH};

/// Something about a stone that its owner may not have meant. Lengths are percent of the girdle diameter unless said
/// otherwise.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum Warning {
    /// The girdle has no thickness at all.
    #[error("girdle_thickness: 0 % is a knife edge all round, so the stone has no girdle facets")]
    NoGirdle,
    /// Upper and lower halves meet between the bezels and leave no girdle there.
    #[error(
        "girdle_thickness: {} % closes to a knife edge in the valleys, where the halves take {} %; \
         above that the girdle stays open",
        given(*.thickness), rounded(*.needed)
    )]
    GirdleClosesInValleys {
        /// The girdle's thickness at the bezels.
        thickness: f64,
        /// The thickness that the valleys take away.
        needed: f64,
    },
    /// The culet cuts off the tips of the lower halves, so that mains no longer touch one another.
    #[error(
        "culet: {} % reaches the tips of the lower halves at {} %, so neighbouring mains no longer touch",
        given(*.culet), rounded(*.reach)
    )]
    CuletReachesLowerHalves {
        /// The culet's size.
        culet: f64,
        /// The culet's size at which it would just touch the tips.
        reach: f64,
    },
    /// A star tip or a lower-half tip lies outside one of the girdle's flats.
    #[error(
        "{key}: it puts tips at {} % of the radius, outside the girdle's flats at {} %, which cut them off",
        rounded(*.tip), rounded(*.girdle)
    )]
    TipsOutsideGirdle {
        /// The proportion that puts the tips there: `star_length` or `lower_half_length`.
        key: &'static str,
        /// The distance of the tips from the axis, percent of the girdle radius.
        tip: f64,
        /// The girdle's distance from the axis in the same direction, percent of the girdle radius.
        girdle: f64,
    },
    /// The girdle's facets do not share the stone's symmetry.
    #[error(
        "girdle_facets: {count} is not a multiple of 8, which breaks the eightfold mirror symmetry and makes tracing \
         slower; {} keeps it",
        .count.div_ceil(8) * 8
    )]
    SymmetryBroken {
        /// The number of girdle facets.
        count: u32,
    },
}

impl Warning {
    /// Returns a warning for everything unusual about valid proportions, in the order of the keys of a cut file.
    pub(super) fn of(p: &Proportions) -> Vec<Self> {
        let (radius, _) = p.star_tip();
        let checks = [
            tips("star_length", radius, p),
            tips("lower_half_length", 1.0 - p.lower, p),
            girdle(p),
            (!p.girdle_facets.is_multiple_of(8)).then_some(Self::SymmetryBroken { count: p.girdle_facets }),
            culet(p),
        ];
        checks.into_iter().flatten().collect()
    }
}

fn girdle(p: &Proportions) -> Option<Warning> {
    let (thickness, needed) = (50.0 * p.girdle, 50.0 * p.valley_depth());
    match thickness {
        0.0 => Some(Warning::NoGirdle),
        _ if thickness <= needed => Some(Warning::GirdleClosesInValleys { thickness, needed }),
        _ => None,
    }
}

/// The octagon in which the culet cuts the mains has a corner over each lower-half tip, further out than its flats.
fn culet(p: &Proportions) -> Option<Warning> {
    let reach = (1.0 - p.lower) * STAR_AZIMUTH.cos();
    let crossed = p.culet >= reach;
    crossed.then_some(Warning::CuletReachesLowerHalves { culet: 100.0 * p.culet, reach: 100.0 * reach })
}

fn tips(key: &'static str, tip: f64, p: &Proportions) -> Option<Warning> {
    let azimuths = (0..8).map(|k| STAR_AZIMUTH + f64::from(k) * TAU / 8.0);
    let girdle = azimuths.map(|azimuth| p.girdle_radius(azimuth)).fold(1.0, f64::min);
    let outside = tip >= girdle;
    outside.then_some(Warning::TipsOutsideGirdle { key, tip: 100.0 * tip, girdle: 100.0 * girdle })
}

#[cfg(test)]
mod tests {
    use super::super::round_brilliant::{LowerHalf, MODERN, RoundBrilliant};
    use super::*;

    fn texts(given: RoundBrilliant) -> Vec<String> {
        given.warnings().unwrap().iter().map(ToString::to_string).collect()
    }

    #[test]
    fn a_modern_ideal_gives_no_warning() {
        assert_eq!(texts(MODERN), [""; 0]);
    }

    #[test]
    fn a_thin_girdle_closes_in_its_valleys() {
        let expected = "girdle_thickness: 1.2 % closes to a knife edge in the valleys, where the halves take 1.7 %; \
                        above that the girdle stays open";
        assert_eq!(texts(RoundBrilliant { girdle_thickness: 1.2, ..MODERN }), [expected]);
        let straight = RoundBrilliant { girdle_thickness: 1.2, girdle_facets: 16, ..MODERN };
        assert_eq!(texts(straight), [""; 0]);
        let none = RoundBrilliant { girdle_thickness: 0.0, ..MODERN };
        assert_eq!(none.warnings().unwrap(), [Warning::NoGirdle]);
    }

    #[test]
    fn the_valley_closes_exactly_where_the_warning_says() {
        let thin = RoundBrilliant { girdle_thickness: 1.0, ..MODERN };
        let Warning::GirdleClosesInValleys { needed, .. } = thin.warnings().unwrap()[0] else { panic!() };
        for (change, count) in [(1e-9, 0), (-1e-9, 1)] {
            let given = RoundBrilliant { girdle_thickness: needed + change, ..MODERN };
            assert_eq!(texts(given).len(), count);
            assert_eq!(given.derived().unwrap().girdle_thickness_valley > 0.0, count == 0);
        }
    }

    #[test]
    fn a_large_culet_reaches_the_lower_halves() {
        assert_eq!(texts(RoundBrilliant { culet: 21.2, ..MODERN }), [""; 0]);
        let expected = "culet: 30 % reaches the tips of the lower halves at 21.25 %, so neighbouring mains no longer \
                        touch";
        assert_eq!(texts(RoundBrilliant { culet: 30.0, ..MODERN }), [expected]);
    }

    #[test]
    fn a_girdle_of_another_symmetry_is_told() {
        let expected = "girdle_facets: 97 is not a multiple of 8, which breaks the eightfold mirror symmetry and makes \
                        tracing slower; 104 keeps it";
        assert_eq!(texts(RoundBrilliant { girdle_facets: 97, ..MODERN }), [expected]);
    }

    #[test]
    fn tips_outside_the_girdles_flats_are_told() {
        let given = RoundBrilliant { girdle_facets: 24, star_length: 99.0, ..MODERN };
        let expected = "star_length: it puts tips at 99.52 % of the radius, outside the girdle's flats at 99.14 %, which cut \
             them off";
        assert!(texts(given).contains(&expected.to_owned()), "{:?}", texts(given));
        assert!(!texts(RoundBrilliant { girdle_facets: 48, ..given }).contains(&expected.to_owned()));
        let short = RoundBrilliant { girdle_facets: 16 + 8, lower_half: LowerHalf::Vertical(9.5), ..MODERN };
        assert_eq!(texts(short).iter().filter(|text| text.starts_with("lower_half_length:")).count(), 0);
    }
}
