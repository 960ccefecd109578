//! Goals: the measures of a search, its limits, and the numbers that may change, in the form of a goal file.

use brillianteer_cut::MaterialRef;
use brillianteer_measure::MeasureName;
use brillianteer_scene::DomeLight;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fmt;

/// The most measures of a goal, each counted once for every material and view.
const MOST_TERMS: usize = 200;

/// A goal: the measures to raise or lower, the numbers of the design that may change, and the limits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Goal {
    /// The name of the goal, for people.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// True where an audit of the found design may find more than one of the given design. Otherwise a search also keeps facets and
    /// edges from becoming tiny, the girdle about as thick as it is, and the estimated class of a round brilliant of diamond.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub new_findings: bool,
    /// The measures that are weighed, at least one.
    pub measure: Vec<GoalMeasure>,
    /// The numbers that may change, with the least and the greatest value of each: keys of proportions, `tier:` or
    /// `distance:` and the name of a tier, `crown_scale` and `pavilion_scale`. Where the map is empty, all numbers
    /// that the design gives may change within usual ranges, except for its outline and girdle.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub vary: BTreeMap<String, [f64; 2]>,
    /// Limits on the geometry: keys of the cut's proportions, or [`LIMIT_NAMES`](super::LIMIT_NAMES).
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub limit: BTreeMap<String, AtLeastAtMost>,
}

/// A measure that a goal weighs. With several materials or views it is taken in each, and the weight is shared out evenly.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GoalMeasure {
    /// The measure.
    pub of: MeasureName,
    /// The weight of the measure: above 0 where more is better, below 0 where less is better, 0 where it is only
    /// limited.
    #[serde(default = "one")]
    pub weight: f64,
    /// The materials; `None` for that of the design.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub material: Option<OneOrMore<GoalMaterial>>,
    /// The tilts of the view, degrees, -90 to 90; `None` for face up.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tilt: Option<OneOrMore<f64>>,
    /// The azimuths of the tilts, degrees; `None` for 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub azimuth: Option<OneOrMore<f64>>,
    /// The least value, in each material and view; `None` for no limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_least: Option<f64>,
    /// The greatest value, in each material and view; `None` for no limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_most: Option<f64>,
    /// The loss that is allowed against the design before the search, in each material and view: downward where the
    /// weight is 0 or above, upward where it is below 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub may_lose: Option<f64>,
}

/// A least and a greatest value, of which one may be left out.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AtLeastAtMost {
    /// The least value.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_least: Option<f64>,
    /// The greatest value.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_most: Option<f64>,
}

/// A material of a goal.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum GoalMaterial {
    /// The same refractive index for every wavelength, of [`INDICES`](brillianteer_optics::INDICES), without absorption.
    Index(f64),
    /// A material of the library, by its name.
    Name(String),
}

impl GoalMaterial {
    /// Returns the material in the form that designs have.
    pub fn reference(&self) -> MaterialRef {
        match self {
            Self::Index(index) => MaterialRef::Index(*index),
            Self::Name(name) => MaterialRef::Name(name.clone()),
        }
    }
}

impl fmt::Display for GoalMaterial {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Index(index) => write!(f, "{index}"),
            Self::Name(name) => f.write_str(name),
        }
    }
}

/// A value, or a list of values.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum OneOrMore<T> {
    /// A single value.
    One(T),
    /// A list, which must not be empty.
    More(Vec<T>),
}

impl<T> OneOrMore<T> {
    /// Returns the values.
    pub fn all(&self) -> &[T] {
        match self {
            Self::One(value) => std::slice::from_ref(value),
            Self::More(values) => values,
        }
    }
}

/// A fault in a goal, with its key.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{problem}")]
pub struct GoalFault {
    /// The key at fault as a path, such as `measure/0/weight`.
    pub key: String,
    /// The description of the fault, which says what to give.
    pub problem: String,
}

fn one() -> f64 {
    1.0
}

impl Goal {
    /// Makes a goal that weighs measures of the design face up, in its own material.
    pub fn of(measures: impl IntoIterator<Item = (MeasureName, f64)>) -> Self {
        let measure = measures.into_iter().map(|(of, weight)| GoalMeasure::new(of, weight)).collect();
        Self { name: None, new_findings: false, measure, vary: BTreeMap::new(), limit: BTreeMap::new() }
    }

    /// Makes the default goal: bright and fiery. Half of the brightness is that of a viewer whose head hides 10°
    /// about the axis, half that of one who is far away. Neither fire nor the brightness under the head may fall below that of
    /// the given design: a design without fire is not bright and fiery, however much light it returns.
    ///
    /// The weights are our own choice. Among round brilliants of table 57 % in diamond the total is greatest around a
    /// crown of 34° over a pavilion of 41° and of 37° over 40.4°, within GIA's range for the best; a return without
    /// fire is greatest at crowns of 30° and less, and a dome whose head is hidden to 15° favours pavilions of 42.5°.
    pub fn usual() -> Self {
        let weighed = [
            (MeasureName::Return(DomeLight::of(2.0)), 0.5),
            (MeasureName::Return(DomeLight { head_deg: 10.0, ..DomeLight::of(2.0) }), 0.5),
            (MeasureName::Fire, 1.0),
        ];
        let mut goal = Self { name: Some("bright and fiery".to_owned()), ..Self::of(weighed) };
        goal.measure.iter_mut().skip(1).for_each(|measure| measure.may_lose = Some(0.0));
        goal
    }

    /// Checks that the goal has a measure to raise or lower, and that its numbers are in their ranges.
    ///
    /// # Errors
    /// The fault names the first key that is wrong.
    pub fn check(&self) -> Result<(), GoalFault> {
        let fault = |key: String, problem: &str| Err(GoalFault { key, problem: problem.to_owned() });
        for (place, measure) in self.measure.iter().enumerate() {
            let materials = measure.material.iter().flat_map(OneOrMore::all);
            for material in materials {
                if let Err(error) = material.reference().material() {
                    return fault(format!("measure/{place}/material"), &error.to_string());
                }
            }
            if let Some((key, problem)) = measure.fault() {
                return fault(format!("measure/{place}/{key}"), &format!("{key}: {problem}"));
            }
        }
        if self.measure.iter().all(|measure| measure.weight == 0.0) {
            let problem = "measure: give at least one [[measure]] whose weight is not 0";
            return fault("measure".to_owned(), problem);
        }
        if self.measure.iter().map(GoalMeasure::terms).sum::<usize>() > MOST_TERMS {
            let problem =
                format!("measure: materials and views make more than {MOST_TERMS} values; give fewer");
            return fault("measure".to_owned(), &problem);
        }
        for (key, [from, to]) in &self.vary {
            if !(from.is_finite() && to.is_finite() && from < to) {
                let problem = format!("{key}: give the least and then the greatest value, such as [30, 38]");
                return fault(format!("vary/{key}"), &problem);
            }
        }
        for (key, limit) in &self.limit {
            let (low, high) = limit.ends();
            let are_finite = limit.at_least.iter().chain(&limit.at_most).all(|end| end.is_finite());
            if limit.at_least.or(limit.at_most).is_none() || !are_finite || low > high {
                let problem = format!(
                    "{key}: give at_least, at_most or both as finite numbers, the first not above the second"
                );
                return fault(format!("limit/{key}"), &problem);
            }
        }
        Ok(())
    }
}

impl GoalMeasure {
    /// Makes a measure of the design's material, face up, without limits.
    pub fn new(of: MeasureName, weight: f64) -> Self {
        let (material, tilt, azimuth) = (None, None, None);
        Self { of, weight, material, tilt, azimuth, at_least: None, at_most: None, may_lose: None }
    }

    /// Returns the number of materials and views in which the measure is taken.
    pub(super) fn terms(&self) -> usize {
        let materials = self.material.as_ref().map_or(1, |all| all.all().len());
        let tilts = self.tilt.as_ref().map_or(1, |all| all.all().len());
        let azimuths = self.azimuth.as_ref().map_or(1, |all| all.all().len());
        materials.saturating_mul(tilts).saturating_mul(azimuths)
    }

    /// Returns the key of the first fault, and what to give there.
    fn fault(&self) -> Option<(&'static str, &'static str)> {
        let numbers = |list: &Option<OneOrMore<f64>>| list.as_ref().map_or(vec![], |all| all.all().to_vec());
        let limits = [self.at_least, self.at_most, self.may_lose];
        if !(-1000.0..=1000.0).contains(&self.weight) {
            Some(("weight", "give a number from -1000 to 1000"))
        } else if self.terms() == 0 {
            Some(("of", "a list of materials, tilts or azimuths is empty; leave it out"))
        } else if numbers(&self.tilt).iter().any(|tilt| !(-90.0..=90.0).contains(tilt)) {
            Some(("tilt", "give -90 to 90 degrees"))
        } else if numbers(&self.azimuth).iter().any(|azimuth| !(-360.0..=360.0).contains(azimuth)) {
            Some(("azimuth", "give -360 to 360 degrees"))
        } else if limits.iter().flatten().any(|limit| !limit.is_finite()) {
            Some(("at_least", "limits are finite numbers"))
        } else if self.may_lose.is_some_and(|lost| lost < 0.0) {
            Some(("may_lose", "give 0 or more"))
        } else if self.at_least > self.at_most && self.at_most.is_some() {
            Some(("at_least", "it must not be above at_most"))
        } else {
            None
        }
    }
}

impl AtLeastAtMost {
    /// Returns both ends; infinite where one is left out.
    pub fn ends(&self) -> (f64, f64) {
        (self.at_least.unwrap_or(f64::NEG_INFINITY), self.at_most.unwrap_or(f64::INFINITY))
    }
}
