//! The numbers of a design that a search may change.

use super::appraisal::SearchError;
use super::goal::Goal;
use crate::cut::{Cut, Design, MachineSetting, Unit};
use crate::render::{SweepKey, with_numbers};

/// By how many degrees the angle of a tier may usually change, either way.
const TIER_RANGE_DEG: f64 = 5.0;

/// The angles that a tier keeps to: a table stays a table, and a girdle a girdle.
const TIER_ANGLES_DEG: [f64; 2] = [1.0, 89.0];

/// A number of a design that a search may change.
#[derive(Debug, Clone, PartialEq)]
pub struct VariedNumber {
    /// The number.
    pub key: SweepKey,
    /// The least value, in the number's unit.
    pub least: f64,
    /// The greatest value, above the least.
    pub most: f64,
    /// The value in the design as it was given, from `least` to `most`.
    pub start: f64,
}

impl VariedNumber {
    /// Returns the numbers that a cut gives, with their usual ranges, widened to the cut's own values: what a search changes
    /// where its goal names no number.
    pub fn usual(cut: &Cut) -> Vec<Self> {
        usual(cut)
    }

    /// Returns the numbers that the goal names, or all that the design gives.
    ///
    /// # Errors
    /// The design does not have a number, there is none, or the design as it is given lies outside a range.
    pub(super) fn all(goal: &Goal, design: &Design) -> Result<Vec<Self>, SearchError> {
        let numbers = match goal.vary.is_empty() {
            true => usual(&design.cut),
            false => {
                let named = goal.vary.iter().map(|(name, range)| Self::named(&design.cut, name, *range));
                named.collect::<Result<_, _>>()?
            }
        };
        if numbers.is_empty() {
            return Err(SearchError::NoNumbers);
        }
        for number in &numbers {
            // The design says best by itself which keys it does not have.
            with_numbers(design, [(&number.key, number.start)])?;
        }
        Ok(numbers)
    }

    fn named(cut: &Cut, name: &str, [least, most]: [f64; 2]) -> Result<Self, SearchError> {
        let key = SweepKey::of(name);
        let start = match &key {
            SweepKey::Proportion(key) => cut.proportion(key).map_or(f64::NAN, |row| (row.get)(cut)),
            SweepKey::Tier(tier) => of_tier(cut, tier, |setting| setting.angle.abs()),
            SweepKey::Distance(tier) => of_tier(cut, tier, |setting| setting.distance),
            _ => return Err(SearchError::NotOfDesign(name.to_owned())),
        };
        // A key that the design does not have is refused by the design, with what it has.
        let start = if start.is_nan() { least } else { start };
        if !(least..=most).contains(&start) {
            return Err(SearchError::StartOutside { key: name.to_owned(), start, least, most });
        }
        Ok(Self { key, least, most, start })
    }

    /// Returns the value at a place from 0, the least, to 1, the greatest.
    pub(super) fn at(&self, place: f64) -> f64 {
        (self.least + place * (self.most - self.least)).clamp(self.least, self.most)
    }

    /// Returns the place of the design as it was given, 0 to 1.
    pub(super) fn start_place(&self) -> f64 {
        (self.start - self.least) / (self.most - self.least)
    }
}

/// Returns a number of a tier; not a number where there is no such tier.
fn of_tier(cut: &Cut, name: &str, number: impl Fn(&MachineSetting) -> f64) -> f64 {
    cut.settings().iter().find(|setting| setting.name == name).map_or(f64::NAN, number)
}

/// Returns the numbers that a design gives, with their usual ranges, widened to the design's own values.
fn usual(cut: &Cut) -> Vec<VariedNumber> {
    let rows = cut.family().into_iter().flat_map(|family| family.editable());
    let given = rows.filter(|row| (row.is_given)(cut) && row.unit != Unit::Count);
    // A culet of 0 is a point, which stays.
    let mut numbers: Vec<VariedNumber> = given
        .filter_map(|row| {
            let start = (row.get)(cut);
            let [least, most] = row.usual;
            let key = SweepKey::Proportion(row.key.to_owned());
            (start > 0.0).then(|| VariedNumber { key, least: least.min(start), most: most.max(start), start })
        })
        .collect();
    for setting in cut.settings() {
        let start = setting.angle.abs();
        if (TIER_ANGLES_DEG[0]..=TIER_ANGLES_DEG[1]).contains(&start) {
            let least = (start - TIER_RANGE_DEG).max(TIER_ANGLES_DEG[0]);
            let most = (start + TIER_RANGE_DEG).min(TIER_ANGLES_DEG[1]);
            numbers.push(VariedNumber { key: SweepKey::Tier(setting.name), least, most, start });
        }
    }
    numbers
}
