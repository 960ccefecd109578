//! The terms of a goal: each measure in one material and view.

use super::goal::{Goal, GoalMaterial, GoalMeasure};
use super::{AtLeastAtMost, OneOrMore};
use brillianteer_measure::MeasureName;
use brillianteer_scene::Viewpoint;

/// A material and view in which measures are taken together.
pub(super) struct GoalView {
    pub material: Option<GoalMaterial>,
    pub viewpoint: Viewpoint,
    pub names: Vec<MeasureName>,
}

/// One measure in one material and view.
pub(super) struct Term {
    pub view: usize,
    pub name: MeasureName,
    pub weight: f64,
    /// The limits of the value; infinite where there are none.
    pub ends: (f64, f64),
}

/// Returns the materials of a goal; `None` for the design's own.
pub(super) fn materials(goal: &Goal) -> Vec<Option<GoalMaterial>> {
    goal.measure.iter().flat_map(materials_of).collect()
}

fn materials_of(measure: &GoalMeasure) -> Vec<Option<GoalMaterial>> {
    match &measure.material {
        None => vec![None],
        Some(names) => names.all().iter().cloned().map(Some).collect(),
    }
}

/// Returns the views of a goal, each once, and its measures in them.
pub(super) fn views_and_terms(goal: &Goal) -> (Vec<GoalView>, Vec<Term>) {
    let (mut views, mut terms): (Vec<GoalView>, Vec<Term>) = (vec![], vec![]);
    for measure in &goal.measure {
        let list =
            |given: &Option<OneOrMore<f64>>| given.as_ref().map_or(vec![0.0], |all| all.all().to_vec());
        let weight = measure.weight / measure.terms() as f64;
        for material in materials_of(measure) {
            for tilt_deg in list(&measure.tilt) {
                for azimuth_deg in list(&measure.azimuth) {
                    let viewpoint = Viewpoint { tilt_deg, azimuth_deg, ..Viewpoint::default() };
                    let is_same = |view: &GoalView| view.material == material && view.viewpoint == viewpoint;
                    let view = views.iter().position(is_same).unwrap_or_else(|| {
                        views.push(GoalView { material: material.clone(), viewpoint, names: vec![] });
                        views.len() - 1
                    });
                    if !views[view].names.contains(&measure.of) {
                        views[view].names.push(measure.of);
                    }
                    let ends = AtLeastAtMost { at_least: measure.at_least, at_most: measure.at_most }.ends();
                    terms.push(Term { view, name: measure.of, weight, ends });
                }
            }
        }
    }
    (views, terms)
}
