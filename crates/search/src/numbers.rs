//! The numbers of a design that a search may change.

use super::appraisal::SearchError;
use super::goal::Goal;
use brillianteer_base::Unit;
use brillianteer_cut::{Cut, Design, MachineSetting, ScaledSide};
use brillianteer_math::Plane;
use brillianteer_render::{SweepKey, with_numbers};

/// The default range of a tier's angle to either side, degrees.
const TIER_RANGE_DEG: f64 = 5.0;

/// The range that the angle of a leaning tier keeps to: a table stays a table, and a girdle a girdle.
const TIER_ANGLES_DEG: [f64; 2] = [1.0, 89.0];

/// The height of a side that changes by a scale, percent: its value in the design, and its default range. At 80 and
/// 125 a main of 41° would lie at 34.8 and 47.4°.
pub(super) const AS_IT_IS: f64 = 100.0;
const SCALE_RANGE: [f64; 2] = [80.0, 125.0];

/// The key of the girdle's thickness in all families.
const GIRDLE_KEY: &str = "girdle_thickness";

/// Facets whose normals rise by less than this are upright.
const UPRIGHT: f64 = 1e-6;

/// A value this near to a multiple of a step, in steps, is one.
const ROUNDING: f64 = 1e-9;

/// Numbers are multiples of one part of this: ten decimals.
const WRITTEN: f64 = 1e10;

/// A number of a design that a search may change.
#[derive(Debug, Clone, PartialEq)]
pub struct VariedNumber {
    /// The number.
    pub key: SweepKey,
    /// The least value, in the number's unit.
    pub least: f64,
    /// The greatest value, above the least.
    pub most: f64,
    /// The value in the design before the search, from `least` to `most`.
    pub start: f64,
}

impl VariedNumber {
    /// Returns the numbers that a cut gives, with their usual ranges, widened to the cut's own values.
    pub fn given_by(cut: &Cut) -> Vec<Self> {
        given_by(cut)
    }

    /// Returns the numbers that a search changes where its goal names none: all that the cut gives, except for those
    /// of its outline and girdle, which change the kind of stone rather than its light.
    pub fn usual(cut: &Cut) -> Vec<Self> {
        let keeps_girdle = |number: &Self| !changes_girdle(cut, number);
        given_by(cut).into_iter().filter(keeps_girdle).collect()
    }

    /// Returns a remark for a value at an end of the range, where a wider range may hold a better one; empty elsewhere.
    pub fn end_of_range(&self, value: f64) -> &'static str {
        let near = 1e-6 * (self.most - self.least);
        match value {
            low if low - self.least <= near => ", ended at the least",
            high if self.most - high <= near => ", ended at the greatest",
            _ => "",
        }
    }

    /// Returns the side of the stone on which the number moves one tier or all; `None` for other numbers.
    pub(super) fn side(&self, cut: &Cut) -> Option<ScaledSide> {
        match &self.key {
            SweepKey::Scale(side) => Some(*side),
            SweepKey::Tier(name) | SweepKey::Distance(name) => {
                let angle = of_tier(cut, name, |setting| setting.angle);
                Some(if angle > 0.0 { ScaledSide::Crown } else { ScaledSide::Pavilion })
            }
            _ => None,
        }
    }

    /// Returns whether the number is an angle, degrees.
    pub fn is_angle(&self, cut: &Cut) -> bool {
        match &self.key {
            SweepKey::Tier(_) => true,
            SweepKey::Proportion(key) => cut.proportion(key).is_some_and(|row| row.unit == Unit::Degrees),
            _ => false,
        }
    }

    /// Returns the place of the multiple of `step` that is nearest to a place and in the range; `None` where the range holds none.
    pub(super) fn snapped(&self, place: f64, step: f64) -> Option<f64> {
        let [first, last] = [(self.least / step - ROUNDING).ceil(), (self.most / step + ROUNDING).floor()];
        (first <= last).then(|| {
            let value = (self.at(place) / step).round().clamp(first, last) * step;
            ((value - self.least) / (self.most - self.least)).clamp(0.0, 1.0)
        })
    }

    /// Returns the numbers that the goal names, or the usual ones.
    ///
    /// # Errors
    /// Fails where the design lacks a number, where there is none, or where the given design lies outside a range.
    pub(super) fn all(goal: &Goal, design: &Design) -> Result<Vec<Self>, SearchError> {
        let numbers = if goal.vary.is_empty() {
            Self::usual(&design.cut)
        } else {
            let named = goal.vary.iter().map(|(name, range)| Self::named(&design.cut, name, *range));
            named.collect::<Result<_, _>>()?
        };
        if numbers.is_empty() {
            return Err(SearchError::NoNumbers);
        }
        for number in &numbers {
            // The design itself reports best which keys it lacks.
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
            SweepKey::Scale(_) => AS_IT_IS,
            _ => return Err(SearchError::NotOfDesign(name.to_owned())),
        };
        // The design refuses a key that it lacks, and lists its own.
        let start = if start.is_nan() { least } else { start };
        if !(least..=most).contains(&start) {
            return Err(SearchError::StartOutside { key: name.to_owned(), start, least, most });
        }
        Ok(Self { key, least, most, start })
    }

    /// Returns the value at a place from 0, the least, to 1, the greatest.
    pub(super) fn at(&self, place: f64) -> f64 {
        let value = self.least + place * (self.most - self.least);
        // The value is rounded to the digits that people write, without the last digits of rounding.
        ((value * WRITTEN).round() / WRITTEN).clamp(self.least, self.most)
    }

    /// Returns the place of the design before the search, 0 to 1.
    pub(super) fn start_place(&self) -> f64 {
        (self.start - self.least) / (self.most - self.least)
    }
}

/// Returns a number of a tier; NaN where there is no such tier.
fn of_tier(cut: &Cut, name: &str, number: impl Fn(&MachineSetting) -> f64) -> f64 {
    cut.settings().iter().find(|setting| setting.name == name).map_or(f64::NAN, number)
}

/// Returns whether a change of a number moves facets of the girdle, or makes it thicker.
fn changes_girdle(cut: &Cut, number: &VariedNumber) -> bool {
    let SweepKey::Proportion(key) = &number.key else { return false };
    let Some(row) = cut.proportion(key) else { return false };
    let Some(before) = girdle(cut) else { return false };
    let mut moved = cut.clone();
    let by = 1e-3 * (number.most - number.least);
    row.give(
        &mut moved,
        if number.start + by <= number.most { number.start + by } else { number.start - by },
    );
    let is_same = |(before, after): (&(String, Plane), &(String, Plane))| {
        before.1.normal.distance(after.1.normal) < 1e-9 && (before.1.offset - after.1.offset).abs() < 1e-9
    };
    row.key == GIRDLE_KEY
        || girdle(&moved)
            .is_some_and(|after| after.len() != before.len() || !before.iter().zip(&after).all(is_same))
}

/// Returns the upright facets of a cut that is shaped by proportions.
fn girdle(cut: &Cut) -> Option<Vec<(String, Plane)>> {
    let facets = match cut {
        Cut::RoundBrilliant(cut) => cut.facets().ok()?,
        Cut::Family(cut) => cut.facets().ok()?,
        _ => return None,
    };
    Some(facets.into_iter().filter(|(_, plane)| plane.normal.z.abs() < UPRIGHT).collect())
}

/// Returns the numbers that a design gives, with their usual ranges, widened to the design's own values.
fn given_by(cut: &Cut) -> Vec<VariedNumber> {
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
    if cut.has_scalable_sides() {
        let [least, most] = SCALE_RANGE;
        let scale = |side| VariedNumber { key: SweepKey::Scale(side), least, most, start: AS_IT_IS };
        numbers.extend(ScaledSide::ALL.map(scale));
    }
    numbers
}
