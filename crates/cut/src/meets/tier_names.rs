//! The names of tiers: one for each, by which lists, drawings, meets and files call it.

use super::super::tier_change::TierChange;
use super::super::tiers::{Tier, TierZone, Tiers};
use super::meet::ANY_GIRDLE;
use super::names::TierNames;
use super::solve::{Bench, cutting_order};
use super::words;
use std::collections::{BTreeMap, BTreeSet};

impl TierZone {
    /// Returns the letter with which cutters begin the names of tiers in this zone.
    pub(super) fn letter(self) -> &'static str {
        match self {
            Self::Table => "T",
            Self::Crown => "C",
            Self::Girdle => "G",
            Self::Pavilion => "P",
            Self::Culet => "K",
        }
    }
}

impl Tiers {
    /// Returns the name by which each tier is called: its own, if it can stand in a list of names joined by dashes, or else
    /// the letter of its zone with its number there, such as P1, C2 or G1, and T for a table. A number that another name
    /// takes is passed over.
    ///
    /// Several tiers may have one name of their own, and a tier of the pavilion one of the crown.
    pub fn names(&self) -> Vec<String> {
        let mut taken = self.taken_names();
        let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
        let mut names = vec![];
        for tier in &self.tiers {
            let letter = tier.zone().letter();
            let count = counts.entry(letter).or_default();
            *count += 1;
            let name = match tier.name() {
                own if self.is_listable(tier, own) => own.to_owned(),
                _ => free_name(tier.zone(), *count, &taken),
            };
            taken.insert(name.to_lowercase());
            names.push(name);
        }
        names
    }

    /// Returns whether a meet of the design names a tier.
    pub fn has_named_meets(&self) -> bool {
        self.tiers.iter().filter_map(|tier| tier.meet.as_ref()).any(|meet| meet.names().next().is_some())
    }

    /// Returns the design with [these names](Self::names) in it, also where a tier had none.
    #[must_use]
    pub fn with_names(mut self) -> Self {
        for (tier, name) in self.names().into_iter().zip(&mut self.tiers).map(|(name, tier)| (tier, name)) {
            if tier.name() != name
                && let Some(first) = tier.facets.first_mut()
            {
                first.name = name;
            }
        }
        self
    }

    /// Returns the design with [its names](Self::with_names) in it, and with meets that mean the same tiers as before.
    ///
    /// Cutters number girdle tiers without names in any order. Where the number in a meet is now the name of another tier, the
    /// meet and the words of the instruction get the names of the tiers through whose corner the facets pass.
    #[must_use]
    pub fn with_names_in_meets(&self) -> Self {
        let mut design = self.clone().with_names();
        let (before, named) = (TierNames::of(self), design.clone());
        let mut bench = Bench::of(&named);
        for place in cutting_order(&named) {
            let tier = &named.tiers[place];
            if !tier.is_cut {
                continue;
            }
            let is_other = |name: &String| before.meant(name, place) != bench.names().meant(name, place);
            if let Some(meet) = &tier.meet
                && meet.names().any(is_other)
                && !bench.gives(place, tier, meet)
                && let Some(found) = bench.found_corner(place, tier)
            {
                design.change(TierChange::Meet(place, Some(found)));
            }
            bench.cut(place, tier);
        }
        design
    }

    /// Returns the names that no other tier gets, in small letters: those that facets have, also behind the letter of their
    /// zone.
    fn taken_names(&self) -> BTreeSet<String> {
        let named = |tier: &Tier| {
            let letter = tier.zone().letter().to_lowercase();
            let own = tier.facets.iter().map(|facet| facet.name.to_lowercase());
            own.filter(|own| !own.is_empty())
                .flat_map(|own| [format!("{letter}{own}"), own])
                .collect::<Vec<String>>()
        };
        self.tiers.iter().flat_map(named).collect()
    }

    /// Returns whether a list of names may name a tier so. The word for any girdle facet names the only tier of the girdle.
    fn is_listable(&self, tier: &Tier, name: &str) -> bool {
        let girdles = || self.tiers.iter().filter(|tier| tier.zone() == TierZone::Girdle).count();
        words::is_listable(name)
            || name.eq_ignore_ascii_case(ANY_GIRDLE) && tier.zone() == TierZone::Girdle && girdles() == 1
    }
}

/// Returns the letter of a zone with the first number, from this one, with which no name is taken; a flat tier that is the
/// first has the letter alone.
fn free_name(zone: TierZone, number: usize, taken: &BTreeSet<String>) -> String {
    let letter = zone.letter();
    let is_flat = matches!(zone, TierZone::Table | TierZone::Culet);
    let alone = (is_flat && number == 1).then(|| letter.to_owned());
    let mut names = alone.into_iter().chain((number..).map(|number| format!("{letter}{number}")));
    names.find(|name| !taken.contains(&name.to_lowercase())).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::super::super::tiers::Indexed;
    use super::*;

    fn named(tiers: &[(f64, &[&str])]) -> Tiers {
        let tier = |&(angle, names): &(f64, &[&str])| Tier {
            angle,
            distance: 1.0,
            instructions: String::new(),
            meet: None,
            is_cut: true,
            frosting: 0.0,
            facets: names.iter().map(|name| Indexed { index: 0.0, name: (*name).to_owned() }).collect(),
        };
        Tiers { gear: 96, tiers: tiers.iter().map(tier).collect(), ..Tiers::default() }
    }

    #[test]
    fn a_tier_without_a_name_is_called_by_its_zone_and_its_number_there() {
        let design = named(&[
            (-90.0, &[""]),
            (-42.0, &[""]),
            (-40.0, &["", "A"]),
            (-39.0, &[""]),
            (35.0, &[""]),
            (0.0, &[""]),
            (0.0, &[""]),
            (-0.0, &[""]),
        ]);
        assert_eq!(design.names(), ["G1", "P1", "A", "P3", "C1", "T", "T2", "K"]);
        // The names stay once they are written.
        let written = design.clone().with_names();
        assert_eq!(written.names(), design.names());
        assert_eq!(written.tiers[2].facets[0].name, "", "a name of its own stays where it is");
        assert!(written.tiers.iter().all(|tier| !tier.name().is_empty()));
    }

    #[test]
    fn names_that_cutters_use_stay_and_those_that_a_list_cannot_hold_do_not() {
        let kept = ["1", "A", "P2", "aa", "C12", "table", "1b", "upper_half", "Étoile"];
        let not = [
            "", " ", "\u{7}", "P 1", "a-b", "P2(G)", "[[", "culet", "Meet", "to", "Set", "PCP", "level",
            "CAM",
        ];
        for own in kept {
            assert_eq!(named(&[(-42.0, &[own])]).names(), [own]);
        }
        for own in not {
            assert_eq!(named(&[(-42.0, &[own])]).names(), ["P1"], "{own:?}");
        }
        assert_eq!(named(&[(-90.0, &["girdle"]), (-42.0, &["girdle"])]).names(), ["girdle", "P1"]);
        assert_eq!(named(&[(-90.0, &["girdle"]), (90.0, &["girdle"])]).names(), ["G1", "G2"]);
    }

    #[test]
    fn a_number_that_a_name_takes_is_passed_over() {
        let design = named(&[(-42.0, &["p2"]), (-41.0, &[""]), (-40.0, &["4"]), (-39.0, &[""])]);
        assert_eq!(design.names(), ["p2", "P3", "4", "P5"]);
    }
}
