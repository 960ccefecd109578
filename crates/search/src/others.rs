//! The changes of measures that the goal of a search does not weigh: a better design by one measure may be a worse
//! one by another.

use super::appraisal::{GoalValue, SearchError};
use super::kept_shape::estimated_class;
use super::objective::PARTS;
use super::outcome::SearchOutcome;
use super::run::DesignSearch;
use brillianteer_base::Watch;
use brillianteer_cut::{CutClass, Design};
use brillianteer_measure::{Interval, MeasureName, MeasureSettings};
use brillianteer_optics::line;
use brillianteer_render::Sweep;
use brillianteer_scene::{Specimen, Viewpoint};
use std::cmp::Ordering;

/// A measure that the goal does not weigh, face up and in the design's own material.
#[derive(Debug, Clone, PartialEq)]
pub struct OtherMeasure {
    /// The measure.
    pub name: MeasureName,
    /// Its value in the design before the search.
    pub before: Interval,
    /// Its value in the found design.
    pub after: Interval,
}

impl OtherMeasure {
    /// Takes the usual measures of the design before the search and of the found one, except for those that the goal
    /// weighs.
    ///
    /// # Errors
    /// Fails where one of the designs cannot be measured, or where `watch` stops.
    pub fn all(
        search: &DesignSearch,
        outcome: &SearchOutcome,
        watch: Watch,
    ) -> Result<Vec<Self>, SearchError> {
        let options = search.options();
        let measured = |design: &Design| {
            let sweep = Sweep {
                design: design.clone(),
                viewpoint: Viewpoint::default(),
                axes: vec![],
                settings: MeasureSettings::usual([1.0; 2]),
                wavelength_nm: line::SODIUM_D,
                unresolved: options.unresolved,
                polarised: options.polarised,
            };
            sweep.point(0, PARTS, watch)
        };
        let (before, after) = (measured(search.objective().design())?, measured(&outcome.design)?);
        let is_weighed = |name: &MeasureName| {
            let is_it =
                |value: &GoalValue| value.of == *name && value.material.is_none() && value.tilt_deg == 0.0;
            outcome.best.values.iter().any(is_it)
        };
        let names = MeasureName::all(&MeasureSettings::usual([1.0; 2]));
        let other = |name: MeasureName| {
            let (before, after) = (name.of(&before.measures)?, name.of(&after.measures)?);
            Some(Self { name, before, after })
        };
        Ok(names.into_iter().filter(|name| !is_weighed(name)).filter_map(other).collect())
    }

    /// Returns whether people want more of the measure (1), less (-1), or neither (0).
    pub fn wanted(&self) -> f64 {
        match self.name.better() {
            Some(Ordering::Greater) => 1.0,
            Some(_) => -1.0,
            None => 0.0,
        }
    }
}

/// Returns the classes of the design before the search and of the found one, estimated after the ranges that GIA
/// publishes for round brilliants of diamond; `None` where one of them is no such stone.
pub fn estimated_classes(search: &DesignSearch, outcome: &SearchOutcome) -> Option<[CutClass; 2]> {
    let class = |design: &Design| estimated_class(&Specimen::new(design.clone()).ok()?);
    Some([class(search.objective().design())?, class(&outcome.design)?])
}
