//! Brings the angles of the best design of a search to multiples of a step.

use super::super::appraisal::Appraisal;
use super::super::numbers::VariedNumber;
use super::{Trials, merit};
use brillianteer_base::at_once;
use brillianteer_cut::Cut;
use std::ops::ControlFlow;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

/// The longest time in which a search that was stopped brings angles to multiples of their step.
const ROUNDING: Duration = Duration::from_secs(10);

/// The numbers of a search, of which the angles are multiples of a step.
struct Scale<'a> {
    numbers: &'a [VariedNumber],
    cut: &'a Cut,
    /// The step of the angles, degrees.
    step: f64,
}

impl Scale<'_> {
    fn nearest(&self, number: &VariedNumber, place: f64) -> f64 {
        if number.is_angle(self.cut) { number.snapped(place, self.step).unwrap_or(place) } else { place }
    }

    /// Returns the places with their angles rounded.
    fn rounded(&self, places: &[f64]) -> Vec<f64> {
        self.numbers.iter().zip(places).map(|(number, &place)| self.nearest(number, place)).collect()
    }

    /// Returns the places that are one step of an angle away, in each angle and either way.
    fn neighbours(&self, places: &[f64]) -> Vec<Vec<f64>> {
        let beside = |(k, number): (usize, &VariedNumber)| {
            let by = self.step / (number.most - number.least);
            [-by, by].map(|by| {
                let mut places = places.to_vec();
                places[k] = self.nearest(number, (places[k] + by).clamp(0.0, 1.0));
                places
            })
        };
        let all = self.numbers.iter().enumerate().flat_map(beside);
        all.filter(|other| other.as_slice() != places).collect()
    }
}

impl Trials<'_> {
    /// Replaces the best so far by the best design near it whose angles are multiples of a step: its angles are
    /// rounded, and then each is moved by a step either way as long as that is better, but no more than `most`
    /// designs are appraised. A search that was stopped only rounds the angles, and moves them by a step where that breaks a
    /// limit or a meet, for no longer than [`ROUNDING`].
    pub(super) fn snap(&self, step: f64, most: usize) {
        let objective = &self.search.objective;
        let Some((best, _)) = self.best() else { return };
        let scale = Scale { numbers: objective.numbers(), cut: &objective.design().cut, step };
        let is_stopped = self.stopped.load(Ordering::Relaxed);
        let begun = Instant::now();
        let for_a_while = |_: f64| {
            if begun.elapsed() < ROUNDING { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        };
        let appraised = |places: &Vec<f64>| {
            let found = if is_stopped {
                objective.appraise(places, self.search.options.unresolved, false, &for_a_while).ok()
            } else {
                self.near(places, false)
            };
            Some((places.clone(), found?))
        };
        let first = scale.rounded(&best);
        let mut left = if is_stopped { 1 + 2 * best.len() } else { most };
        let mut found: Option<(Vec<f64>, Appraisal)> = None;
        let mut next = vec![first.clone()];
        while !next.is_empty() && left > 0 {
            next.truncate(left);
            left -= next.len();
            let tried = at_once(objective.designs_at_once(), &next, appraised);
            let top = tried.into_iter().flatten().max_by(|a, b| merit(&a.1).total_cmp(&merit(&b.1)));
            let Some(top) = top else {
                // The rounded angles break a meet; those beside them may not.
                next = if next == [first.as_slice()] { scale.neighbours(&first) } else { vec![] };
                continue;
            };
            if found.as_ref().is_some_and(|found| merit(&top.1) <= merit(&found.1)) {
                break;
            }
            let is_enough = is_stopped && top.1.keeps_limits();
            next = if is_enough { vec![] } else { scale.neighbours(&top.0) };
            found = Some(top);
        }
        // A search that was stopped while it rounded begins again.
        if !is_stopped && self.stopped.load(Ordering::Relaxed) {
            return self.snap(step, most);
        }
        self.record().best = found.filter(|(_, appraisal)| appraisal.keeps_limits());
    }
}
