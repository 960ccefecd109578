//! Indices that the gear of a cutter's design does not have.

use super::tiers::{Tier, Tiers};
use std::fmt;

/// The number of indices that a message names where there are more.
const MOST_NAMED: usize = 4;

/// The indices of a tier that lie beyond the gear. The stone still has facets there, as if the gear began anew.
///
/// Its text is a warning without the place in the file.
#[derive(Debug, Clone, PartialEq)]
pub struct BeyondGear {
    /// The number of the tier, from 1.
    pub tier: usize,
    /// The tier's name; empty where it has none.
    pub name: String,
    /// The teeth of the gear, above 0.
    pub teeth: u32,
    /// The indices at fault, in teeth, at least one.
    pub indices: Vec<f64>,
}

impl Tiers {
    /// Returns the indices beyond the gear, counted either way round, of each tier that has some.
    ///
    /// The number of teeth itself is usual and stands for 0. The index of a table or culet has no meaning, and is
    /// left out.
    pub fn beyond_gear(&self) -> impl Iterator<Item = BeyondGear> + '_ {
        let teeth = self.gear.unsigned_abs();
        let beyond = move |(number, tier): (usize, &Tier)| {
            let indices = tier.facets.iter().map(|facet| facet.index);
            let indices: Vec<f64> = indices.filter(|index| index.abs() > f64::from(teeth)).collect();
            let has_azimuth = tier.angle != 0.0;
            let name = tier.name().to_owned();
            (has_azimuth && !indices.is_empty()).then_some(BeyondGear { tier: number, name, teeth, indices })
        };
        (1..).zip(&self.tiers).filter_map(beyond)
    }
}

impl fmt::Display for BeyondGear {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { tier, name, teeth, indices } = self;
        let named = if name.is_empty() { String::new() } else { format!(" '{name:.40}'") };
        let shown = &indices[..indices.len().min(MOST_NAMED)];
        let list = |of: &dyn Fn(f64) -> f64| {
            shown.iter().map(|&index| of(index).to_string()).collect::<Vec<_>>().join(", ")
        };
        let more = match indices.len() - shown.len() {
            0 => String::new(),
            more => format!(" and {more} more"),
        };
        let (noun, verb) = if indices.len() == 1 { ("index", "is") } else { ("indices", "are") };
        let (given, taken) = (list(&|index| index), list(&|index| index.rem_euclid(f64::from(*teeth))));
        write!(
            f,
            "tier {tier}{named}: {noun} {given}{more} {verb} beyond the gear of {teeth} teeth and {verb} taken as \
             {taken}{more}; check the gear and the tier"
        )
    }
}

#[cfg(test)]
mod tests {
    use super::super::tiers::Indexed;
    use super::*;

    fn told(gear: i32, angle: f64, indices: &[f64]) -> Vec<String> {
        let facets = indices.iter().map(|&index| Indexed { index, name: String::new() }).collect();
        let tier = Tier {
            angle,
            distance: 1.0,
            instructions: String::new(),
            meet: None,
            is_cut: true,
            frosting: 0.0,
            facets,
        };
        let tiers = Tiers { gear, tiers: vec![tier], ..Tiers::default() };
        tiers.beyond_gear().map(|beyond| beyond.to_string()).collect()
    }

    #[test]
    fn every_tooth_of_the_gear_is_taken_without_a_word_and_the_next_is_not() {
        for gear in [96, -96] {
            assert_eq!(told(gear, 41.0, &[0.0, 95.5, 96.0, -96.0, -3.0]), [""; 0]);
            for index in [96.5, -97.0] {
                assert_eq!(told(gear, 41.0, &[1.0, index]).len(), 1, "{index} of {gear}");
            }
        }
        assert_eq!(told(96, 0.0, &[1000.0]), [""; 0], "a table has no azimuth");
    }

    #[test]
    fn many_indices_are_told_in_one_short_message() {
        let told = told(96, -41.0, &[100.0, 3.0, 124.0, 148.0, 172.0, 196.0, -100.0]);
        assert_eq!(
            told,
            [
                "tier 1: indices 100, 124, 148, 172 and 2 more are beyond the gear of 96 teeth and are taken as 4, 28, \
              52, 76 and 2 more; check the gear and the tier"
            ]
        );
    }
}
