//! Finds the tiers that a name in an instruction means.

use super::super::tiers::{TierZone, Tiers};
use super::meet::ANY_GIRDLE;

/// The tiers of a design by their names.
#[derive(Debug, Clone)]
pub(super) struct TierNames {
    tiers: Vec<NamedTier>,
}

#[derive(Debug, Clone)]
struct NamedTier {
    /// All names of the tier's facets, in lower case.
    names: Vec<String>,
    /// The name by which the tier is called, as [`Tiers::names`] gives it.
    called: String,
    zone: TierZone,
}

impl TierNames {
    pub fn of(tiers: &Tiers) -> Self {
        let named = tiers.names().into_iter().zip(&tiers.tiers).map(|(called, tier)| {
            let mut names: Vec<String> = vec![];
            let own = tier.facets.iter().map(|facet| facet.name.as_str()).filter(|name| !name.is_empty());
            for name in own.map(str::to_lowercase) {
                if !names.contains(&name) {
                    names.push(name);
                }
            }
            NamedTier { names, called, zone: tier.zone() }
        });
        Self { tiers: named.collect() }
    }

    /// Returns the places of the tiers that a name means in an instruction of the tier at `from`; the list is empty
    /// where no tier has the name.
    ///
    /// A name is that of a tier. After the letter P, C or G it may be that of a pavilion, crown or girdle tier, or
    /// the number of a tier on that side, where all girdle tiers without names have every number. Where a pavilion
    /// and a crown tier share a name, it means the one on the side of `from`.
    pub fn meant(&self, name: &str, from: usize) -> Vec<usize> {
        let name = name.to_lowercase();
        let exact = self.with_name(&name);
        if !exact.is_empty() {
            return self.beside(exact, from);
        }
        if name == ANY_GIRDLE || name == "g" {
            return self.on_side(is_girdle).collect();
        }
        let on_side = name.split_at_checked(1).and_then(|(letter, rest)| {
            let side: fn(TierZone) -> bool = match letter {
                "p" => is_pavilion,
                "c" => is_crown,
                "g" => is_girdle,
                _ => return None,
            };
            Some((side, rest))
        });
        let numbered = on_side.and_then(|(side, rest)| self.behind_letter(side, rest));
        let called = || self.tiers.iter().position(|tier| tier.called.to_lowercase() == name);
        let nth = || {
            let (side, rest) = on_side?;
            let number = rest.parse::<usize>().ok()?.checked_sub(1)?;
            self.on_side(side).nth(number)
        };
        numbered
            .unwrap_or_else(|| called().or_else(|| self.in_full(&name)).or_else(nth).into_iter().collect())
    }

    /// Returns the places of the tiers that have this name, in small letters, of their own.
    fn with_name(&self, name: &str) -> Vec<usize> {
        let all = self.tiers.iter().enumerate();
        all.filter(|(_, tier)| tier.names.iter().any(|own| own == name)).map(|(place, _)| place).collect()
    }

    /// Returns the places of the tiers on a side that a name behind the letter of the side means.
    fn behind_letter(&self, side: fn(TierZone) -> bool, rest: &str) -> Option<Vec<usize>> {
        let named: Vec<usize> =
            self.with_name(rest).into_iter().filter(|&place| side(self.tiers[place].zone)).collect();
        // Girdle tiers without names are often numbered in another order than they are listed.
        let is_girdle_number = side(TierZone::Girdle) && rest.parse::<usize>().is_ok();
        let nameless = || self.on_side(is_girdle).filter(|&place| self.tiers[place].names.is_empty());
        let found = if named.is_empty() && is_girdle_number { nameless().collect() } else { named };
        (!found.is_empty()).then_some(found)
    }

    /// Returns the place of the tier that a zone's whole name means, with the number of the tier in the list (pavilion-2),
    /// or without one for table and culet. Earlier versions wrote such names into cut files.
    fn in_full(&self, name: &str) -> Option<usize> {
        let (zone, place) = match name.split_once('-') {
            Some((zone, number)) => (zone, number.parse::<usize>().ok()?.checked_sub(1)?),
            None if name == TierZone::Table.name() || name == TierZone::Culet.name() => {
                (name, self.tiers.iter().position(|tier| tier.zone.name() == name)?)
            }
            None => return None,
        };
        self.tiers.get(place).filter(|tier| tier.zone.name() == zone).map(|_| place)
    }

    /// Returns the name with the letter of the side of the tier at `from` in place of the letter of the other side.
    /// `None` for names without such a letter, and where the result means no tier. Cutters who copy an instruction
    /// leave such letters.
    pub fn on_own_side(&self, name: &str, from: usize) -> Option<String> {
        let (letter, rest) = name.split_at_checked(1)?;
        let own = match letter {
            "p" if is_crown(self.tiers[from].zone) => "c",
            "c" if is_pavilion(self.tiers[from].zone) => "p",
            _ => return None,
        };
        let name = format!("{own}{rest}");
        (!rest.is_empty() && !self.meant(&name, from).is_empty()).then_some(name)
    }

    /// Returns the name that means a tier in a meet of the tier at `from`: the name by which it is called, behind the letter of
    /// its zone where that name alone means a tier on the other side.
    pub fn written(&self, tier: usize, from: usize) -> String {
        let NamedTier { called, zone, .. } = &self.tiers[tier];
        let with_letter = format!("{}{called}", zone.letter());
        let means = |name: &String| self.meant(name, from).contains(&tier);
        [called, &with_letter].into_iter().find(|name| means(name)).unwrap_or(called).clone()
    }

    fn on_side(&self, side: fn(TierZone) -> bool) -> impl Iterator<Item = usize> + '_ {
        (0..self.tiers.len()).filter(move |&place| side(self.tiers[place].zone))
    }

    /// Returns, of tiers that share a name, those on the side of a tier, where there are any.
    fn beside(&self, places: Vec<usize>, from: usize) -> Vec<usize> {
        let is_crown_tier = is_crown(self.tiers[from].zone);
        let is_beside = |&place: &usize| {
            let zone = self.tiers[place].zone;
            is_girdle(zone) || is_girdle(self.tiers[from].zone) || is_crown(zone) == is_crown_tier
        };
        let beside: Vec<usize> = places.iter().copied().filter(is_beside).collect();
        if beside.is_empty() { places } else { beside }
    }
}

fn is_pavilion(zone: TierZone) -> bool {
    matches!(zone, TierZone::Pavilion | TierZone::Culet)
}

fn is_crown(zone: TierZone) -> bool {
    matches!(zone, TierZone::Crown | TierZone::Table)
}

fn is_girdle(zone: TierZone) -> bool {
    zone == TierZone::Girdle
}
