//! Warnings about cuts of families that are possible but unusual, with the numbers that make them so.

use std::f64::consts::TAU;
use std::fmt;

use super::family::{Family, Proportion};
use super::family_cut::FamilyCut;
use super::proportion_error::rounded;
use super::proportions::{Proportions, STAR_AZIMUTH};
use super::round_brilliant_table::ROUND_BRILLIANT;
use super::shape::Cut;
use brillianteer_base::Unit;
use brillianteer_math::as_written;

/// A property of a stone that its owner may not have meant: a proportion, and its consequence.
///
/// Its text has the proportion's key in cut files; [`by_name`](Self::by_name) has the name that people read instead.
#[derive(Debug, Clone, PartialEq)]
pub struct Warning {
    /// The proportion that leads to it.
    pub row: &'static Proportion,
    /// The consequence of the proportion, with the numbers. Lengths are percent of the girdle diameter unless the
    /// text says otherwise.
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

/// The distance from its usual range up to which a number counts as rounded to it.
const ROUNDED: f64 = 1e-9;

/// The sine of the angle to the axis, or to the girdle plane, up to which a facet is a culet, or one of the girdle.
const FLAT: f64 = 1e-6;

impl Warning {
    /// Returns a warning for every number of a cut that lies outside its usual range, and for pavilion facets below the critical
    /// angle, in degrees, where there is one.
    pub(super) fn of_family(cut: &FamilyCut, critical_deg: Option<f64>) -> Vec<Self> {
        let whole = Cut::Family(*cut);
        let odd = |row: &'static Proportion| {
            let value = (row.get)(&whole);
            let [least, most] = row.usual;
            let is_usual = (least - ROUNDED..=most + ROUNDED).contains(&value);
            let statement = || {
                format!(
                    "{} lies outside the usual range of {} to {}",
                    row.written(value),
                    as_written(least),
                    row.written(most)
                )
            };
            // The range of a count contains all possible values.
            (!is_usual && row.unit != Unit::Count).then(|| Self { row, statement: statement() })
        };
        let leaking = critical_deg.and_then(|critical| leaking(cut, critical));
        cut.family.editable().filter_map(odd).chain(leaking).collect()
    }
}

/// Returns a warning about the pavilion tiers that lie wholly below the critical angle, at the number that shapes the
/// pavilion. Single facets lie below it in usual cuts as well, such as the mains at the ends of a marquise; the audit
/// lists them.
fn leaking(cut: &FamilyCut, critical_deg: f64) -> Option<Warning> {
    let net = cut.net().ok()?;
    let mut tiers: Vec<(&str, f64)> = vec![];
    for (tier, plane) in net.facets() {
        let across = plane.normal.truncate().length();
        let slope = across.atan2(-plane.normal.z).to_degrees();
        if plane.normal.z > -FLAT || across < FLAT {
            continue;
        }
        match tiers.iter_mut().find(|(own, _)| *own == tier) {
            Some((_, steepest)) => *steepest = steepest.max(slope),
            None => tiers.push((tier, slope)),
        }
    }
    tiers.retain(|(_, steepest)| *steepest < critical_deg);
    let named: Vec<String> = tiers
        .iter()
        .map(|(tier, slope)| format!("{} at {}°", tier.replace('_', " "), rounded(*slope)))
        .collect();
    let statement = format!(
        "pavilion tiers below the critical angle of {}° let light from above leak out: {}",
        rounded(critical_deg),
        named.join(", ")
    );
    (!named.is_empty()).then_some(Warning { row: pavilion_row(cut.family)?, statement })
}

/// Returns the number of a family that shapes its pavilion, or else its first slope or number.
fn pavilion_row(family: &'static Family) -> Option<&'static Proportion> {
    let rows = || family.editable();
    rows()
        .find(|row| row.key.starts_with("pavilion") && row.unit == Unit::Degrees)
        .or_else(|| rows().find(|row| row.key.starts_with("pavilion")))
        .or_else(|| rows().find(|row| row.unit == Unit::Degrees))
        .or_else(|| rows().next())
}

/// Returns a warning where upper and lower halves meet between the bezels and leave no girdle there, or none at all.
fn girdle(p: &Proportions) -> Option<String> {
    let (thickness, needed) = (50.0 * p.girdle, 50.0 * p.valley_depth());
    match thickness {
        0.0 => Some("0 % is a knife edge all round, so the stone has no girdle facets".to_owned()),
        _ if thickness <= needed => Some(format!(
            "{} % closes to a knife edge in the valleys, where the half facets take away {} %; a thicker girdle \
                stays open",
            as_written(thickness),
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
    let [size, tips] = [as_written(100.0 * p.culet), rounded(100.0 * reach)];
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

    /// Returns the warnings of a family's first cut with one number changed, in a material of this critical angle.
    fn of_family(key: &str, change: Option<(&str, f64)>, critical_deg: f64) -> Vec<String> {
        let family = crate::FAMILIES.into_iter().find(|family| family.key == key).unwrap();
        let mut cut = family.first.clone();
        if let Some((row, value)) = change {
            family.proportion(row).unwrap().set(&mut cut, value);
        }
        let Cut::Family(cut) = cut else { panic!() };
        Warning::of_family(&cut, Some(critical_deg)).iter().map(ToString::to_string).collect()
    }

    #[test]
    fn usual_cuts_of_diamond_have_no_warnings() {
        for family in crate::FAMILIES {
            let Cut::Family(cut) = &family.first else { continue };
            assert_eq!(Warning::of_family(cut, Some(24.43)), [], "{}", family.key);
        }
    }

    #[test]
    fn a_number_outside_its_usual_range_is_told_with_the_range() {
        assert_eq!(
            of_family("princess", Some(("star_azimuth", 40.0)), 24.43),
            ["star_azimuth: 40° lies outside the usual range of 4 to 9°"]
        );
        let steep = of_family("pear", Some(("crown_angle", 85.0)), 24.43);
        assert!(steep[0].starts_with("crown_angle: 85° lies outside the usual range of "), "{steep:?}");
        // The ends of the range are usual.
        for azimuth in [4.0, 9.0] {
            assert_eq!(of_family("princess", Some(("star_azimuth", azimuth)), 24.43), [""; 0]);
        }
    }

    #[test]
    fn pavilions_below_the_critical_angle_are_told_with_their_tiers() {
        let flat = of_family("emerald", Some(("pavilion_angle", 20.0)), 24.43);
        assert!(flat.iter().any(|text| text.contains("outside the usual range")), "{flat:?}");
        let leak = flat.iter().find(|text| text.contains("critical angle of 24.43°")).unwrap();
        assert!(leak.starts_with("pavilion_angle: pavilion tiers below"), "{leak}");
        // The oval's mains are steepest at its sides, 40.75°; a tier of which a part is steep enough causes no warning.
        let flat = of_family("oval", None, 40.8);
        assert_eq!(flat.len(), 1, "{flat:?}");
        assert!(flat[0].ends_with("main at 40.75°"), "{flat:?}");
        assert_eq!(of_family("oval", None, 40.7), [""; 0]);
    }
}
