//! A sweep that grows: its order, and the points that have been answered.

use crate::studio::{SweepOrder, SweptPoint};
use brillianteer_cut::Design;
use brillianteer_measure::{MeasureName, MeasureSettings, PatternSettings, ROCK_DEG};
use brillianteer_optics::line;
use brillianteer_render::{Sweep, SweepAxis, SweepError, SweptStone};
use brillianteer_scene::Viewpoint;
use std::sync::Arc;

/// The points of a sweep that have been answered.
#[derive(Debug, Clone)]
pub struct FoundSweep {
    /// The order that they answer.
    pub order: SweepOrder,
    /// The result at each point of the grid; `None` where there is no answer yet.
    points: Vec<Option<Arc<Result<SweptStone, SweepError>>>>,
    /// The number of points that have been answered.
    pub answered: usize,
}

impl FoundSweep {
    fn new(order: SweepOrder) -> Self {
        let points = vec![None; order.sweep.count()];
        Self { order, points, answered: 0 }
    }

    /// Returns the result at a point; `None` where there is no answer yet.
    pub fn at(&self, point: usize) -> Option<&Result<SweptStone, SweepError>> {
        self.points.get(point)?.as_deref()
    }

    /// Returns whether all points have been answered.
    pub fn is_whole(&self) -> bool {
        self.answered >= self.order.points.len()
    }
}

/// The latest order of a sweep, and its answers so far. Until the first points of a new sweep come in, those of the
/// one before stay in sight.
#[derive(Debug, Clone, Default)]
pub struct GrowingSweep {
    wanted: Option<SweepOrder>,
    found: Option<FoundSweep>,
}

impl GrowingSweep {
    /// Returns the latest order; `None` where no sweep is wanted.
    pub fn wanted(&self) -> Option<&SweepOrder> {
        self.wanted.as_ref()
    }

    /// Replaces the order; `None` for no sweep.
    pub fn want(&mut self, order: Option<SweepOrder>) {
        if order.is_none() {
            self.found = None;
        }
        self.wanted = order;
    }

    /// Takes points of the sweep of this number, if it is the latest one.
    pub fn take(&mut self, number: u64, points: &[SweptPoint]) {
        let Some(wanted) = self.wanted.as_ref().filter(|wanted| wanted.number == number) else { return };
        if self.found.as_ref().is_none_or(|found| found.order != *wanted) {
            self.found = Some(FoundSweep::new(wanted.clone()));
        }
        let Some(found) = &mut self.found else { return };
        for (point, result) in points {
            if let Some(at) = found.points.get_mut(*point) {
                found.answered += usize::from(at.is_none());
                *at = Some(Arc::clone(result));
            }
        }
    }

    /// Returns the points that are in sight.
    pub fn found(&self) -> Option<&FoundSweep> {
        self.found.as_ref()
    }

    /// Returns whether the points in sight belong to the latest order.
    pub fn is_present(&self) -> bool {
        self.found.as_ref().map(|found| &found.order) == self.wanted.as_ref()
    }
}

/// Returns whether a sweep records everything that a measure needs.
pub fn takes(sweep: &Sweep, measure: MeasureName) -> bool {
    let needed = PatternSettings::needed_by([&measure], 0.5 * sweep.design.diameter_mm, ROCK_DEG);
    let rocks = |pattern: PatternSettings| pattern.rock_deg.is_some();
    needed.is_none_or(|needed| sweep.settings.pattern.is_some_and(|has| rocks(has) || !rocks(needed)))
}

/// Returns the sweep of a design face up, at the sodium line, under the light, head and eye of the usual measures,
/// with the settings that the measure needs besides.
pub fn sweep_of(design: &Design, axes: Vec<SweepAxis>, measure: MeasureName, unresolved: f64) -> Sweep {
    let pattern = PatternSettings::needed_by([&measure], 0.5 * design.diameter_mm, ROCK_DEG);
    Sweep {
        design: design.clone(),
        viewpoint: Viewpoint::default(),
        axes,
        // The indices of colours are those of each point's material.
        settings: MeasureSettings { pattern, ..MeasureSettings::usual([1.0; 2]) },
        wavelength_nm: line::SODIUM_D,
        unresolved,
        polarised: true,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An order of three points, the last of which comes first.
    fn order(number: u64) -> SweepOrder {
        let design = crate::model::document::Document::first().unwrap().work.design;
        let axes = vec![SweepAxis {
            key: brillianteer_render::SweepKey::Tilt,
            values: [0.0, 1.0, 2.0].map(brillianteer_render::SweepValue::Number).into(),
        }];
        let sweep = Arc::new(sweep_of(&design, axes, MeasureName::Fire, 0.05));
        SweepOrder { number, sweep, points: Arc::new([2, 0, 1]), coarse: 1 }
    }

    /// The result for a point where the proportions make no stone.
    fn nothing(point: usize) -> SweptPoint {
        let error = SweepError::NoTier { key: String::new(), known: String::new() };
        (point, Arc::new(Err(error)))
    }

    #[test]
    fn points_of_a_sweep_that_is_no_longer_wanted_are_dropped_and_shown_ones_stay_until_new_ones_come() {
        let mut sweep = GrowingSweep::default();
        sweep.take(1, &[nothing(0)]);
        assert!(sweep.found().is_none(), "nothing is wanted");
        sweep.want(Some(order(1)));
        sweep.take(1, &[nothing(2), nothing(2), nothing(99)]);
        assert!(sweep.is_present() && sweep.found().is_some_and(|found| found.answered == 1));
        sweep.want(Some(order(2)));
        sweep.take(1, &[nothing(0)]);
        let found = sweep.found().unwrap();
        assert!(!sweep.is_present() && found.at(2).is_some() && found.at(0).is_none());
        sweep.take(2, &[nothing(0), nothing(1), nothing(2)]);
        assert!(sweep.is_present() && sweep.found().is_some_and(FoundSweep::is_whole));
        sweep.want(None);
        assert!(sweep.found().is_none());
    }
}
