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
    /// All names of the tier's facets, in lower case; then the name by which the tier is called, where it has no
    /// name.
    names: Vec<String>,
    /// The tier's own name; empty where it has none.
    name: String,
    /// The name by which the tier is called.
    called: String,
    zone: TierZone,
}

impl TierNames {
    pub fn of(tiers: &Tiers) -> Self {
        let named = (1..).zip(&tiers.tiers).map(|(number, tier)| {
            let mut names: Vec<String> = vec![];
            let own = tier.facets.iter().map(|facet| facet.name.as_str()).filter(|name| !name.is_empty());
            for name in own.map(str::to_lowercase).chain([tier.called(number).to_lowercase()]) {
                if !names.contains(&name) {
                    names.push(name);
                }
            }
            NamedTier { names, name: tier.name().to_owned(), called: tier.called(number), zone: tier.zone() }
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
        let with_name = |name: &str| -> Vec<usize> {
            let numbered = self.tiers.iter().enumerate();
            numbered
                .filter(|(_, tier)| tier.names.iter().any(|own| own == name))
                .map(|(place, _)| place)
                .collect()
        };
        let exact = with_name(&name);
        if !exact.is_empty() {
            return self.beside(exact, from);
        }
        if name == ANY_GIRDLE || name == "g" {
            return self.on_side(is_girdle).collect();
        }
        let Some((letter, rest)) = name.split_at_checked(1) else { return vec![] };
        let on_side: fn(TierZone) -> bool = match letter {
            "p" => is_pavilion,
            "c" => is_crown,
            "g" => is_girdle,
            _ => return vec![],
        };
        let named =
            with_name(rest).into_iter().filter(|&place| on_side(self.tiers[place].zone)).collect::<Vec<_>>();
        if !named.is_empty() {
            return named;
        }
        // Girdle tiers without names are often numbered in another order than they are listed.
        if letter == "g" {
            let nameless: Vec<usize> =
                self.on_side(is_girdle).filter(|&place| self.tiers[place].name.is_empty()).collect();
            if !nameless.is_empty() {
                return nameless;
            }
        }
        let number = rest.parse::<usize>().ok().filter(|&number| number > 0);
        number.and_then(|number| self.on_side(on_side).nth(number - 1)).into_iter().collect()
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

    /// Returns the name that means a tier in a meet of the tier at `from`: the tier's own name, or else the one by
    /// which it is called.
    pub fn written(&self, tier: usize, from: usize) -> String {
        let NamedTier { name, called, .. } = &self.tiers[tier];
        if !name.is_empty() && self.meant(name, from).contains(&tier) { name.clone() } else { called.clone() }
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
