//! The changes by a search, measure by measure: which measures rose, and which fell.

use super::appraisal::{Appraisal, GoalValue};
use super::goal::GoalMaterial;
use super::others::OtherMeasure;
use super::outcome::SearchOutcome;
use brillianteer_measure::{Interval, MeasureName};
use std::cmp::Ordering;

/// Changes of a measure below this part of the face count as none.
const SAME: f64 = 5e-5;

/// A measure of the design before the search and of the found one.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasureChange {
    /// The measure.
    pub of: MeasureName,
    /// The material, where it is not that of the design.
    pub material: Option<GoalMaterial>,
    /// The tilt of the view, degrees.
    pub tilt_deg: f64,
    /// The azimuth of the tilt, degrees.
    pub azimuth_deg: f64,
    /// Its value in the design before the search.
    pub before: Interval,
    /// Its value in the found design.
    pub after: Interval,
    /// Above 0 where more of the measure is better, below 0 where less is better, and 0 where neither is.
    pub wanted: f64,
}

/// A group of changes under one title.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ChangeGroup {
    /// Measures of the goal that became better.
    Won,
    /// Measures of the goal that became worse.
    GivenUp,
    /// Measures of the goal that became neither better nor worse.
    AsItWas,
    /// Other measures that became worse.
    OtherWorse,
    /// Other measures that became better.
    OtherBetter,
    /// Other measures that changed, of which neither more nor less is better.
    OtherTaste,
}

impl ChangeGroup {
    /// All groups in the order of reports, in which losses come before gains among the other measures.
    const ALL: [Self; 6] =
        [Self::Won, Self::GivenUp, Self::AsItWas, Self::OtherWorse, Self::OtherBetter, Self::OtherTaste];

    /// Returns the group's title.
    pub fn title(self) -> &'static str {
        match self {
            Self::Won => "Won",
            Self::GivenUp => "Given up for it",
            Self::AsItWas => "As it was",
            Self::OtherWorse => "Not asked for, worse",
            Self::OtherBetter => "Not asked for, better",
            Self::OtherTaste => "Not asked for, a matter of taste",
        }
    }

    /// Returns whether the changes of the group are better (greater), worse (less), or neither.
    pub fn gain(self) -> Ordering {
        match self {
            Self::Won | Self::OtherBetter => Ordering::Greater,
            Self::GivenUp | Self::OtherWorse => Ordering::Less,
            Self::AsItWas | Self::OtherTaste => Ordering::Equal,
        }
    }
}

impl MeasureChange {
    /// Returns all changes of a search in groups, without measures that did not change. `start` is the appraisal of
    /// the design before the search.
    pub fn grouped(
        start: &Appraisal,
        outcome: &SearchOutcome,
        others: &[OtherMeasure],
    ) -> Vec<(ChangeGroup, Vec<Self>)> {
        let values = start.values.iter().zip(&outcome.best.values);
        let weighed: Vec<Self> = values.map(|(before, after)| Self::weighed(before, after)).collect();
        let other: Vec<Self> = others.iter().map(Self::other).collect();
        let of_group = |group: ChangeGroup| -> Vec<Self> {
            let is_of_group = |change: &&Self| change.gain() == group.gain();
            match group {
                ChangeGroup::Won | ChangeGroup::GivenUp | ChangeGroup::AsItWas => {
                    weighed.iter().filter(is_of_group).cloned().collect()
                }
                ChangeGroup::OtherWorse | ChangeGroup::OtherBetter => {
                    other.iter().filter(is_of_group).cloned().collect()
                }
                ChangeGroup::OtherTaste => {
                    other.iter().filter(|change| change.wanted == 0.0 && !change.is_none()).cloned().collect()
                }
            }
        };
        let groups = ChangeGroup::ALL.map(|group| (group, of_group(group)));
        groups.into_iter().filter(|(_, changes)| !changes.is_empty()).collect()
    }

    fn weighed(before: &GoalValue, after: &GoalValue) -> Self {
        Self {
            of: before.of,
            material: before.material.clone(),
            tilt_deg: before.tilt_deg,
            azimuth_deg: before.azimuth_deg,
            before: before.value,
            after: after.value,
            wanted: before.weight,
        }
    }

    fn other(other: &OtherMeasure) -> Self {
        Self {
            of: other.name,
            material: None,
            tilt_deg: 0.0,
            azimuth_deg: 0.0,
            before: other.before,
            after: other.after,
            wanted: other.wanted(),
        }
    }

    /// Returns the difference of the intervals' middles.
    pub fn by(&self) -> f64 {
        self.after.middle() - self.before.middle()
    }

    fn is_none(&self) -> bool {
        self.by().abs() < SAME
    }

    /// Returns whether the change is for the better (greater), for the worse (less), or neither.
    pub fn gain(&self) -> Ordering {
        let gain = if self.is_none() { 0.0 } else { self.wanted * self.by() };
        gain.partial_cmp(&0.0).unwrap_or(Ordering::Equal)
    }

    /// Returns the material and the tilt in which the measure is taken, as a text after its name; empty where they
    /// are the design's own and face up.
    pub fn conditions(&self) -> String {
        let material = self.material.as_ref().map_or(String::new(), |name| format!(", {name}"));
        let tilt = match (self.tilt_deg, self.azimuth_deg) {
            (0.0, _) => String::new(),
            (tilt, 0.0) => format!(", tilt {tilt}°"),
            (tilt, azimuth) => format!(", tilt {tilt}° toward {azimuth}°"),
        };
        format!("{material}{tilt}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_is_a_gain_by_what_is_wanted_and_none_within_rounding() {
        let gain = |by: f64, wanted: f64| {
            let other = OtherMeasure {
                name: MeasureName::Leakage,
                before: Interval::from(0.5, 0.0),
                after: Interval::from(0.5 + by, 0.0),
            };
            MeasureChange { wanted, ..MeasureChange::other(&other) }.gain()
        };
        assert_eq!([gain(0.1, 1.0), gain(0.1, -1.0)], [Ordering::Greater, Ordering::Less]);
        assert_eq!([gain(-0.1, -2.0), gain(1e-5, 1.0)], [Ordering::Greater, Ordering::Equal]);
        assert_eq!(gain(0.1, 0.0), Ordering::Equal);
    }
}
