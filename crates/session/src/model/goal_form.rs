//! The form of a search for a better cut: measures with weights and limits, and the numbers of the design that may
//! change.

use super::measure_map::MapAxis;
use brillianteer_cut::{Cut, Proportion};
use brillianteer_measure::measure_words;
use brillianteer_render::SweepKey;
use brillianteer_search::{Goal, GoalMeasure, SearchOptions, VariedNumber};
use std::collections::BTreeMap;

/// The proportions that may change at first, where a cut has them.
const FIRST: [&str; 2] = ["crown_angle", "pavilion_angle"];

/// The time that a search may take.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SearchEffort {
    /// Few designs, measured roughly.
    Quick,
    /// As many designs as the command `optimise` tries by default.
    #[default]
    Usual,
    /// Many designs, with climbs from more of them.
    Thorough,
}

impl SearchEffort {
    /// All efforts, the quickest first.
    pub const ALL: [Self; 3] = [Self::Quick, Self::Usual, Self::Thorough];

    /// Returns the name on the screen.
    pub fn name(self) -> &'static str {
        match self {
            Self::Quick => "quick",
            Self::Usual => "usual",
            Self::Thorough => "thorough",
        }
    }

    /// Returns what the effort means, in a sentence.
    pub fn meaning(self) -> &'static str {
        match self {
            Self::Quick => "Tries few designs, and leaves up to 1 % of the light open.",
            Self::Usual => {
                "Tries as many designs as the numbers need, and leaves up to 0.2 % of the light open."
            }
            Self::Thorough => "Tries three times as many designs, and goes on from twice as many of them.",
        }
    }

    /// Returns the options of a search over so many numbers.
    pub fn options(self, numbers: usize) -> SearchOptions {
        let usual = SearchOptions::default();
        match self {
            Self::Quick => {
                let scattered = Some(24 + 8 * numbers);
                SearchOptions { unresolved: 0.01, scattered, climbs: 1, ..usual }
            }
            Self::Usual => usual,
            Self::Thorough => {
                SearchOptions { scattered: Some(240 + 75 * numbers), climbs: 2 * usual.climbs, ..usual }
            }
        }
    }
}

/// A number of the design that a search may change.
#[derive(Debug, Clone, PartialEq)]
pub struct NumberChoice {
    /// The proportion or the tier.
    pub key: SweepKey,
    /// The name of the number on the screen.
    pub name: String,
    /// The unit of its values.
    pub unit: &'static str,
    /// Its value in the present design.
    pub value: f64,
    /// The least and the greatest value that the search tries.
    pub ends: [f64; 2],
    /// The ends of its range before the user changes them.
    usual: [f64; 2],
    /// True where searches that name no number change it: it shapes neither the outline nor the girdle.
    is_usual: bool,
    /// True where the search may change it.
    pub is_varied: bool,
}

/// The content of the form.
#[derive(Debug, Clone, PartialEq)]
pub struct GoalForm {
    /// The measures, and the limits on the geometry that a goal file gave. The numbers that may change are those of `numbers`.
    pub goal: Goal,
    /// The numbers of the design, in the order of its table or its tiers.
    pub numbers: Vec<NumberChoice>,
    /// The time that the search may take.
    pub effort: SearchEffort,
    /// The step of angles, degrees; see [`SearchOptions::angle_step_deg`].
    pub angle_step_deg: Option<f64>,
}

/// The reason why a search cannot begin.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum GoalFormFault {
    /// The goal neither raises nor lowers a measure.
    #[error("Choose at least one measure of which more or less is wanted.")]
    NoMeasure,
    /// The form lets no number change.
    #[error("Tick at least one number that may change.")]
    NoNumber,
    /// The ends of a range are the wrong way round, or the design lies outside them.
    #[error("{name}: the least value must be below the greatest, and the design's {value} between them.")]
    Range {
        /// The name of the number.
        name: String,
        /// Its value in the design, with its unit.
        value: String,
    },
    /// The goal has another fault.
    #[error("{0}")]
    Goal(#[from] brillianteer_search::GoalFault),
}

impl Default for GoalForm {
    fn default() -> Self {
        let goal = Goal::usual();
        Self { goal, numbers: vec![], effort: SearchEffort::default(), angle_step_deg: None }
    }
}

impl GoalForm {
    /// Takes the numbers of a cut. Choices for a number stay as long as the cut has it.
    pub fn follow(&mut self, cut: &Cut) {
        let axes = MapAxis::all(cut);
        let all = VariedNumber::given_by(cut);
        let usual = VariedNumber::usual(cut);
        let is_usual = |key: &SweepKey| usual.iter().any(|number| number.key == *key);
        let is_first = |key: &SweepKey| FIRST.iter().any(|first| *key == SweepKey::of(first));
        let has_first = all.iter().any(|number| is_first(&number.key));
        let number = |number: VariedNumber| {
            let VariedNumber { key, least, most, start } = number;
            let axis = axes.iter().find(|axis| axis.key == key);
            let before = self.numbers.iter().find(|before| before.key == key);
            let usual = [least, most];
            NumberChoice {
                name: axis.map_or_else(|| key.to_string(), |axis| axis.name.clone()),
                unit: axis.map_or("", |axis| axis.unit),
                value: start,
                ends: before.filter(|before| before.ends != before.usual).map_or(usual, |before| before.ends),
                usual,
                is_usual: is_usual(&key),
                is_varied: before.map_or_else(
                    || if has_first { is_first(&key) } else { is_usual(&key) },
                    |before| before.is_varied,
                ),
                key,
            }
        };
        self.numbers = all.into_iter().map(number).collect();
        self.goal.vary.retain(|key, _| has(cut, key));
    }

    /// Takes the goal of a file: its measures and limits, and its numbers as far as the cut has them; all usual ones where it names
    /// none. Returns the keys of the numbers that the cut lacks.
    ///
    /// Numbers that are not listed, such as distances of tiers, stay in the goal, so that they are searched and saved.
    pub fn take(&mut self, mut goal: Goal, cut: &Cut) -> Vec<String> {
        let mut vary = std::mem::take(&mut goal.vary);
        let is_named = !vary.is_empty();
        for number in &mut self.numbers {
            let ends = vary.remove(&number.key.to_string());
            number.is_varied = ends.is_some() || (!is_named && number.is_usual);
            number.ends = ends.unwrap_or(number.usual);
        }
        let (kept, missing): (BTreeMap<_, _>, BTreeMap<_, _>) =
            vary.into_iter().partition(|(key, _)| has(cut, key));
        goal.vary = kept;
        self.goal = goal;
        missing.into_keys().collect()
    }

    /// Returns the goal with the numbers that may change. Where these are the usual ones in their usual ranges, the
    /// goal names none, so that the search itself finds whether tiers move alone or their side as a whole.
    ///
    /// # Errors
    /// Fails where no measure is chosen, no number may change, or a range is wrong.
    pub fn wanted(&self) -> Result<Goal, GoalFormFault> {
        if self.goal.measure.iter().all(|measure| measure.weight == 0.0) {
            return Err(GoalFormFault::NoMeasure);
        }
        let varied = || self.numbers.iter().filter(|number| number.is_varied);
        if varied().next().is_none() && self.goal.vary.is_empty() {
            return Err(GoalFormFault::NoNumber);
        }
        if let Some(wrong) = varied().find(|number| !number.is_range()) {
            let (name, value) = (wrong.name.clone(), wrong.written(wrong.value));
            return Err(GoalFormFault::Range { name, value });
        }
        let mut goal = self.goal.clone();
        let are_usual = goal.vary.is_empty()
            && self.numbers.iter().all(|number| {
                number.is_varied == number.is_usual && (!number.is_varied || number.ends == number.usual)
            });
        if !are_usual {
            goal.vary.extend(varied().map(|number| (number.key.to_string(), number.ends)));
        }
        goal.check()?;
        Ok(goal)
    }

    /// Adds the first measure that has no weight yet.
    pub fn add_measure(&mut self) {
        let all = measure_words::all();
        let is_free = |name: &&brillianteer_measure::MeasureName| {
            self.goal.measure.iter().all(|measure| measure.of != **name)
        };
        if let Some(of) = all.iter().find(is_free).or(all.first()) {
            let new = GoalMeasure::new(*of, 1.0);
            self.goal.measure.push(new);
        }
    }
}

/// Returns whether a cut has a number that a search can change.
fn has(cut: &Cut, key: &str) -> bool {
    match SweepKey::of(key) {
        SweepKey::Proportion(key) => cut.proportion(&key).is_some_and(Proportion::can_be_set),
        SweepKey::Tier(name) | SweepKey::Distance(name) => {
            cut.settings().iter().any(|setting| setting.name == name)
        }
        SweepKey::Scale(_) => cut.has_scalable_sides(),
        SweepKey::Index | SweepKey::Material | SweepKey::Tilt | SweepKey::Azimuth => false,
    }
}

impl NumberChoice {
    fn is_range(&self) -> bool {
        let [least, most] = self.ends;
        least < most && (least..=most).contains(&self.value)
    }

    /// Writes a value with its unit.
    pub fn written(&self, value: f64) -> String {
        format!("{:.2}{}", value, self.unit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::document::Document;
    use brillianteer_measure::MeasureName;

    fn form() -> (GoalForm, Cut) {
        let cut = Document::first().unwrap().work.design.cut;
        let mut form = GoalForm::default();
        form.follow(&cut);
        (form, cut)
    }

    fn number<'a>(form: &'a mut GoalForm, name: &str) -> &'a mut NumberChoice {
        form.numbers.iter_mut().find(|number| number.name == name).unwrap()
    }

    #[test]
    fn a_form_varies_the_angles_first_and_keeps_what_was_chosen_while_the_design_changes() {
        let (mut form, cut) = form();
        let varied: Vec<_> =
            form.numbers.iter().filter(|number| number.is_varied).map(|number| &number.name).collect();
        assert_eq!(varied, ["Crown angle", "Pavilion angle"]);
        number(&mut form, "Table").is_varied = true;
        number(&mut form, "Crown angle").ends = [30.0, 38.0];
        let changed = Document::of_library("modern-ideal").unwrap().work.design.cut;
        assert_ne!(changed, cut);
        form.follow(&changed);
        assert!(number(&mut form, "Table").is_varied);
        assert_eq!(number(&mut form, "Crown angle").ends, [30.0, 38.0]);
        assert_eq!(form.wanted().unwrap().vary["crown_angle"], [30.0, 38.0]);
    }

    #[test]
    fn a_form_says_what_is_missing() {
        let (mut form, _) = form();
        assert!(form.wanted().is_ok());
        number(&mut form, "Crown angle").ends = [50.0, 38.0];
        let fault = form.wanted().unwrap_err().to_string();
        assert!(fault.starts_with("Crown angle: the least value"), "{fault}");
        form.numbers.iter_mut().for_each(|number| number.is_varied = false);
        assert_eq!(form.wanted(), Err(GoalFormFault::NoNumber));
        form.goal.measure.iter_mut().for_each(|measure| measure.weight = 0.0);
        assert_eq!(form.wanted(), Err(GoalFormFault::NoMeasure));
    }

    #[test]
    fn the_numbers_of_a_goal_file_are_ticked_and_those_that_the_design_lacks_are_named() {
        let (mut form, cut) = form();
        let mut goal = Goal::of([(MeasureName::Fire, 2.0)]);
        goal.vary = [("table".to_owned(), [52.0, 60.0]), ("tier:P1".to_owned(), [40.0, 42.0])].into();
        assert_eq!(form.take(goal.clone(), &cut), ["tier:P1"]);
        goal.vary.remove("tier:P1");
        assert_eq!(form.wanted(), Ok(goal.clone()));
        // A goal that names no number is one of all but the girdle.
        goal.vary.clear();
        assert!(form.take(goal, &cut).is_empty());
        let held: Vec<_> =
            form.numbers.iter().filter(|number| !number.is_varied).map(|number| &number.name).collect();
        assert_eq!(held, ["Girdle"]);
        assert!(form.wanted().unwrap().vary.is_empty(), "the usual numbers are not named");
        number(&mut form, "Table").is_varied = false;
        let named = form.wanted().unwrap().vary;
        assert!(named.contains_key("crown_angle") && !named.contains_key("table"), "{named:?}");
    }

    #[test]
    fn the_sides_of_tiers_are_ticked_at_first_and_named_where_others_are_not() {
        let document = Document::first().unwrap();
        let cut = Cut::Tiers(brillianteer_files::as_tiers(document.specimen()).unwrap());
        let mut form = GoalForm::default();
        form.follow(&cut);
        let scale = number(&mut form, "Scale of the crown");
        assert!(scale.is_varied && scale.written(scale.value) == "100.00 %");
        assert!(form.wanted().unwrap().vary.is_empty());
        form.numbers.iter_mut().for_each(|number| number.is_varied = number.name.starts_with("Scale"));
        let named: Vec<String> = form.wanted().unwrap().vary.into_keys().collect();
        assert_eq!(named, ["crown_scale", "pavilion_scale"]);
    }

    #[test]
    fn numbers_that_are_not_listed_stay_in_the_goal_of_a_file_while_the_cut_has_them() {
        let planes = Cut::Planes(brillianteer_cut::TOLKOWSKY.facets().unwrap());
        let mut form = GoalForm::default();
        form.follow(&planes);
        let mut goal = Goal::of([(MeasureName::Fire, 1.0)]);
        goal.vary = [("distance:bezel".to_owned(), [0.5, 0.7])].into();
        assert!(form.take(goal.clone(), &planes).is_empty());
        assert_eq!(form.wanted(), Ok(goal));
        form.follow(&Document::first().unwrap().work.design.cut);
        assert!(!form.wanted().unwrap().vary.contains_key("distance:bezel"));
    }

    #[test]
    fn a_measure_that_is_added_is_another_one() {
        let mut form = GoalForm::default();
        let before = form.goal.measure.len();
        (0..3).for_each(|_| form.add_measure());
        let mut names: Vec<_> = form.goal.measure.iter().map(|measure| measure.of.to_string()).collect();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), before + 3);
    }
}
