//! Warnings about round brilliants that are possible but unusual, with the numbers that make them so.

use std::f64::consts::TAU;
use std::fmt;

use super::family::Proportion;
use super::proportion_error::{given, rounded};
use super::proportions::{Proportions, STAR_AZIMUTH};
use super::round_brilliant_table::ROUND_BRILLIANT;

/// Something about a stone that its owner may not have meant: a proportion, and what it leads to.
///
/// It is written with the proportion's key in cut files; [`by_name`](Self::by_name) has the name that people read instead.
#[derive(Debug, Clone, PartialEq)]
pub struct Warning {
    /// The proportion that leads to it.
    pub row: &'static Proportion,
    /// What the proportion leads to, with the numbers. Lengths are percent of the girdle diameter unless said otherwise.
    pub statement: String,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.row.key, self.statement)
    }
}

impl Warning {
    /// Returns the warning with the name of the proportion, as panels show it.
    pub fn by_name(&self) -> String {
        format!("{}: {}", self.row.name, self.statement)
    }

    /// Returns a warning for everything unusual about valid proportions, in the order of the keys of a cut file.
    pub(super) fn of(p: &Proportions) -> Vec<Self> {
        let (radius, _) = p.star_tip();
        let checks = [
            ("star_length", tips(radius, p)),
            ("lower_half_length", tips(1.0 - p.lower, p)),
            ("girdle_thickness", girdle(p)),
            ("girdle_facets", symmetry(p.girdle_facets)),
            ("culet", culet(p)),
        ];
        let warning =
            |(key, statement)| Some(Self { row: ROUND_BRILLIANT.proportion(key)?, statement: statement? });
        checks.into_iter().filter_map(warning).collect()
    }
}

/// Returns a warning where upper and lower halves meet between the bezels and leave no girdle there, or none at all.
fn girdle(p: &Proportions) -> Option<String> {
    let (thickness, needed) = (50.0 * p.girdle, 50.0 * p.valley_depth());
    match thickness {
        0.0 => Some("0 % is a knife edge all round, so the stone has no girdle facets".to_owned()),
        _ if thickness <= needed => Some(format!(
            "{} % closes to a knife edge in the valleys, where the half facets take away {} %; a thicker girdle \
                stays open",
            given(thickness),
            rounded(needed)
        )),
        _ => None,
    }
}

/// Returns a warning where the girdle's facets do not share the stone's symmetry.
fn symmetry(count: u32) -> Option<String> {
    let even = count.next_multiple_of(8);
    let text = format!(
        "{count} is not a multiple of 8, which breaks the eightfold mirror symmetry and makes tracing slower; {even} keeps it"
    );
    (count != even).then_some(text)
}

/// Returns a warning where the culet cuts off the tips of the lower halves.
///
/// The octagon in which it cuts the mains has a corner over each lower-half tip, further out than its flats.
fn culet(p: &Proportions) -> Option<String> {
    let reach = (1.0 - p.lower) * STAR_AZIMUTH.cos();
    let [size, tips] = [given(100.0 * p.culet), rounded(100.0 * reach)];
    let text = format!(
        "{size} % reaches the tips of the lower halves at {tips} %, so neighbouring mains no longer touch"
    );
    (p.culet >= reach).then_some(text)
}

/// Returns a warning where tips at this distance from the axis, in girdle radii, lie outside one of the girdle's flats.
fn tips(tip: f64, p: &Proportions) -> Option<String> {
    let azimuths = (0..8).map(|k| STAR_AZIMUTH + f64::from(k) * TAU / 8.0);
    let girdle = azimuths.map(|azimuth| p.girdle_radius(azimuth)).fold(1.0, f64::min);
    let [at, flats] = [tip, girdle].map(|radius| rounded(100.0 * radius));
    let text = format!(
        "it puts tips at {at} % of the radius, outside the girdle's flats at {flats} %, which cut them off"
    );
    (tip >= girdle).then_some(text)
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
        let expected = "girdle_thickness: 1.2 % closes to a knife edge in the valleys, where the half facets take \
            away 1.7 %; a thicker girdle stays open";
        assert_eq!(texts(RoundBrilliant { girdle_thickness: 1.2, ..MODERN }), [expected]);
        let straight = RoundBrilliant { girdle_thickness: 1.2, girdle_facets: 16, ..MODERN };
        assert_eq!(texts(straight), [""; 0]);
        let none = RoundBrilliant { girdle_thickness: 0.0, ..MODERN };
        assert_eq!(
            none.warnings().unwrap()[0].by_name(),
            "Girdle: 0 % is a knife edge all round, so the stone has no girdle facets"
        );
    }

    #[test]
    fn the_valley_closes_exactly_where_the_warning_says() {
        let thin = RoundBrilliant { girdle_thickness: 1.0, ..MODERN };
        assert_eq!(thin.warnings().unwrap().len(), 1);
        let needed = 50.0 * Proportions::unchecked(&thin).valley_depth();
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
