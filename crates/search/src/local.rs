//! Climbs to better designs near a place: by slopes (SLSQP: D. Kraft, 1988) and without them (COBYLA: M. J. D.
//! Powell, 1994).
//!
//! Both are the crates of R. Lafage (`slsqp`, `cobyla`), after NLopt. They minimise, so totals change their sign
//! here. They cannot be stopped from outside, so a stopped trial returns one number everywhere, on which they settle.

use super::run::Trials;
use cobyla::RhoBeg;
use std::cell::RefCell;

/// The accuracy of places, as a part of a number's range.
const PLACE_TOLERANCE: f64 = 1e-5;

/// The change of the total below which a climb ends.
const TOTAL_TOLERANCE: f64 = 1e-6;

/// The difference by which a place without a stone counts as worse than the best.
const NO_STONE: f64 = 1.0;

/// The last place that was tried, with its result.
struct LastTried {
    places: Vec<f64>,
    has_slopes: bool,
    found: Tried,
}

/// The result at a place.
#[derive(Debug, Clone)]
struct Tried {
    total: f64,
    slacks: Vec<f64>,
    slopes: Option<super::appraisal::Slopes>,
}

/// The results of the last place. A solver requests the total and each slack by itself, but all are computed at once.
struct Memory<'a> {
    trials: &'a Trials<'a>,
    last: RefCell<Option<LastTried>>,
    worst: RefCell<f64>,
}

impl Memory<'_> {
    fn tried<T>(&self, places: &[f64], with_slopes: bool, read: impl FnOnce(&Tried) -> T) -> T {
        let mut last = self.last.borrow_mut();
        let is_known = |last: &LastTried| last.places == places && (last.has_slopes || !with_slopes);
        if !last.as_ref().is_some_and(is_known) {
            let found = self.trials.near(places, with_slopes).map(|found| Tried {
                total: found.total.middle(),
                slacks: found.slacks,
                slopes: found.slopes,
            });
            let count = self.trials.slack_count();
            let mut worst = self.worst.borrow_mut();
            let found = match found {
                Some(found) => {
                    *worst = worst.min(found.total);
                    found
                }
                None => Tried { total: *worst - NO_STONE, slacks: vec![0.0; count], slopes: None },
            };
            *last = Some(LastTried { places: places.to_vec(), has_slopes: with_slopes, found });
        }
        read(&last.as_ref().expect("it was just tried").found)
    }
}

fn memory<'a>(trials: &'a Trials<'a>) -> Memory<'a> {
    Memory { trials, last: RefCell::new(None), worst: RefCell::new(trials.start_total()) }
}

/// Climbs by slopes from a place, and returns the place where it ends.
pub(super) fn climb(trials: &Trials, from: &[f64], most: usize) -> Vec<f64> {
    let memory = memory(trials);
    let fill = |into: Option<&mut [f64]>, slopes: Option<&Vec<f64>>| {
        if let Some(into) = into {
            match slopes {
                Some(slopes) => into.iter_mut().zip(slopes).for_each(|(into, slope)| *into = -slope),
                None => into.fill(0.0),
            }
        }
    };
    let total = |places: &[f64], into: Option<&mut [f64]>, (): &mut ()| {
        memory.tried(places, into.is_some(), |found| {
            fill(into, found.slopes.as_ref().map(|slopes| &slopes.total));
            -found.total
        })
    };
    let slack = |k: usize| {
        let memory = &memory;
        move |places: &[f64], into: Option<&mut [f64]>, (): &mut ()| {
            memory.tried(places, into.is_some(), |found| {
                fill(into, found.slopes.as_ref().map(|slopes| &slopes.slacks[k]));
                -found.slacks[k]
            })
        }
    };
    let slacks: Vec<_> = (0..trials.slack_count()).map(slack).collect();
    let tolerances = slsqp::StopTols {
        ftol_abs: TOTAL_TOLERANCE,
        xtol_abs: vec![PLACE_TOLERANCE; from.len()],
        ..Default::default()
    };
    let bounds = vec![(0.0, 1.0); from.len()];
    match slsqp::minimize(total, from, &bounds, &slacks, (), most, Some(tolerances)) {
        Ok((_, places, _)) | Err((_, places, _)) => places,
    }
}

/// Climbs from a place without slopes, first by steps of this part of each range, and returns the place where it
/// ends.
pub(super) fn feel(trials: &Trials, from: &[f64], step: f64, most: usize) -> Vec<f64> {
    let memory = memory(trials);
    let total = |places: &[f64], (): &mut ()| memory.tried(places, false, |found| -found.total);
    let slack = |k: usize| {
        let memory = &memory;
        move |places: &[f64], (): &mut ()| memory.tried(places, false, |found| found.slacks[k])
    };
    let slacks: Vec<_> = (0..trials.slack_count()).map(slack).collect();
    let tolerances = cobyla::StopTols {
        ftol_abs: TOTAL_TOLERANCE,
        xtol_abs: vec![PLACE_TOLERANCE; from.len()],
        ..Default::default()
    };
    let bounds = vec![(0.0, 1.0); from.len()];
    match cobyla::minimize(total, from, &bounds, &slacks, (), most, RhoBeg::All(step), Some(tolerances)) {
        Ok((_, places, _)) | Err((_, places, _)) => places,
    }
}
