//! The search: designs scattered over all ranges first, and then from the best of them to the best near them.

use super::appraisal::{Appraisal, SearchError};
use super::goal::Goal;
use super::local::{climb, feel};
use super::objective::Objective;
use super::outcome::{ProgressPoint, SearchOutcome, SearchProgress};
use crate::cut::Design;
use crate::trace::{Watch, unwatched};
use rayon::prelude::*;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// A limit is kept where no more than this is missing.
const KEPT: f64 = 1e-9;

/// How much a limit that is missed by 1 counts against the total, while designs are compared that keep none.
const MISSED: f64 = 10.0;

/// Places nearer than this in every number, parts of its range, are climbed from only once.
const SAME_HILL: f64 = 0.12;

/// The first step of a search without slopes, a part of each range.
const FELT_STEP: f64 = 0.06;

/// The first step without slopes from where a climb ended, a part of each range.
const AFTER_CLIMB: f64 = 0.02;

/// How far from a promising design others are scattered, a part of each range.
const NEAR: f64 = 0.1;

/// The number of scattered designs after which the best of them is looked at for the first time; each time it takes twice as many.
const FIRST_BATCH: usize = 8;

/// The number of places from which the search feels its way at last: one for each core of a small machine.
const FELT_TOPS: usize = 2;

/// How a search goes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SearchOptions {
    /// The part of the light that may stay unresolved near the best; scattered designs take more.
    pub unresolved: f64,
    /// The number of designs that are scattered over the ranges; `None` for as many as the numbers need.
    pub scattered: Option<usize>,
    /// From how many of them the search goes on, at least 1.
    pub climbs: usize,
    /// Another number scatters other designs.
    pub seed: u64,
    /// Whether it climbs by slopes where there are any.
    pub by_slopes: bool,
    /// Whether polarisation is followed.
    pub polarised: bool,
}

impl Default for SearchOptions {
    fn default() -> Self {
        Self { unresolved: 2e-3, scattered: None, climbs: 3, seed: 0, by_slopes: true, polarised: true }
    }
}

/// By how many times more light may stay unresolved in scattered designs.
const COARSER: f64 = 5.0;

/// By how many times less light stays unresolved in the figures that are handed out.
const FINER: f64 = 4.0;

/// A search for the best design by a goal.
pub struct DesignSearch {
    objective: Objective,
    options: SearchOptions,
}

/// What is known while a search runs.
#[derive(Default)]
struct Record {
    best: Option<(Vec<f64>, f64)>,
    curve: Vec<ProgressPoint>,
}

/// The designs that a search tries, and the best of them.
pub(super) struct Trials<'a> {
    search: &'a DesignSearch,
    watch: Watch<'a>,
    report: &'a (dyn Fn(&SearchProgress) + Sync),
    /// The number of appraisals that the whole search takes at most.
    most: usize,
    appraised: AtomicUsize,
    stopped: AtomicBool,
    record: Mutex<Record>,
}

impl DesignSearch {
    /// Prepares the search for a design that meets a goal better than `design`.
    ///
    /// # Errors
    /// The goal or the design is at fault, or `watch` stops.
    pub fn new(
        design: &Design,
        goal: &Goal,
        options: SearchOptions,
        watch: Watch,
    ) -> Result<Self, SearchError> {
        let finest = options.unresolved / FINER;
        let objective = Objective::new(design, goal, options.polarised, finest, watch)?;
        Ok(Self { objective, options })
    }

    /// Returns how the search goes.
    pub fn options(&self) -> &SearchOptions {
        &self.options
    }

    /// Returns the goal for the design.
    pub fn objective(&self) -> &Objective {
        &self.objective
    }

    /// Searches on all cores. `report` is called from any of them.
    ///
    /// When `watch` stops, the best so far is the outcome.
    ///
    /// # Errors
    /// The design that was found cannot be measured finely, which does not happen where it could be measured roughly.
    pub fn run(
        &self,
        watch: Watch,
        report: &(dyn Fn(&SearchProgress) + Sync),
    ) -> Result<SearchOutcome, SearchError> {
        let dimensions = self.objective.numbers().len();
        let scattered = self.options.scattered.unwrap_or(16 + 12 * dimensions);
        let has_slopes = self.options.by_slopes && self.objective.has_slopes();
        let climbing = if has_slopes { 10 + 6 * dimensions } else { 0 };
        let feeling = 20 + 15 * dimensions;
        let climbs = self.options.climbs.max(1);
        let trials = Trials {
            search: self,
            watch,
            report,
            most: scattered
                + 2 * climbs * near_count(dimensions)
                + climbs * if has_slopes { climbing } else { feeling }
                + FELT_TOPS * feeling,
            appraised: AtomicUsize::new(0),
            stopped: AtomicBool::new(false),
            record: Mutex::default(),
        };
        let start = self.objective.start_places();
        trials.note(&start, self.objective.start());
        let hills = self.hills(&trials, scattered, start);
        let climbed = hills.par_iter().take(climbs).filter_map(|from| {
            let places = match has_slopes {
                true => climb(&trials, from, climbing),
                false => feel(&trials, from, FELT_STEP, feeling),
            };
            Some((merit(&trials.near(&places, false)?), places))
        });
        let mut tops: Vec<(f64, Vec<f64>)> = climbed.collect();
        // The best that was met on the way may be better than where a climb ended.
        tops.extend(trials.best().map(|(places, total)| (total, places)));
        distinct(tops).par_iter().take(FELT_TOPS).for_each(|top| {
            feel(&trials, top, AFTER_CLIMB, feeling);
        });
        self.outcome(&trials)
    }

    /// Scatters designs over all ranges and then near the most promising, and returns the places to go on from, the best first.
    fn hills(&self, trials: &Trials, count: usize, start: Vec<f64>) -> Vec<Vec<f64>> {
        let dimensions = start.len();
        let coarse = self.options.unresolved * COARSER;
        let tried = |places: Vec<Vec<f64>>| -> Vec<(f64, Vec<f64>)> {
            let merit =
                |places: &Vec<f64>| Some((merit(&trials.appraise(places, coarse, false)?), places.clone()));
            let (mut found, mut rest, mut count) = (vec![], places.as_slice(), FIRST_BATCH);
            while !rest.is_empty() {
                let (batch, later) = rest.split_at(count.min(rest.len()));
                let batch: Vec<(f64, Vec<f64>)> = batch.par_iter().filter_map(merit).collect();
                // What promises most is measured finely at once, so that a better design is seen early.
                let promising = batch.iter().max_by(|a, b| a.0.total_cmp(&b.0));
                if let Some((_, places)) =
                    promising.filter(|(merit, _)| trials.best_total().is_none_or(|best| *merit > best))
                {
                    trials.near(places, false);
                }
                found.extend(batch);
                (rest, count) = (later, 2 * count);
            }
            found
        };
        let mut found = vec![(merit(self.objective.start()), start)];
        found.extend(tried(scattered(count, dimensions, self.options.seed)));
        let near = scattered(near_count(dimensions), dimensions, self.options.seed);
        let around = |hill: &Vec<f64>| -> Vec<Vec<f64>> {
            let place = |(at, to): (&f64, &f64)| (at + NEAR * (2.0 * to - 1.0)).clamp(0.0, 1.0);
            near.iter().map(|offset| hill.iter().zip(offset).map(place).collect()).collect()
        };
        let promising = distinct(found.clone());
        found.extend(tried(promising.iter().take(2 * self.options.climbs).flat_map(around).collect()));
        distinct(found)
    }

    fn outcome(&self, trials: &Trials) -> Result<SearchOutcome, SearchError> {
        let record = trials.record();
        let start = self.objective.start_places();
        let (places, keeps_limits) = match &record.best {
            Some((places, _)) => (places, true),
            None => (&start, false),
        };
        let finest = self.options.unresolved / FINER;
        let mut best = self.objective.start().clone();
        let mut found = places;
        if *places != start {
            // What has been found is measured to its end even where the search was stopped.
            let finely = self.objective.appraise(places, finest, false, &unwatched)?;
            // Rough figures may have promised what fine ones do not keep.
            if finely.total.middle() > best.total.middle() || !keeps(&best) {
                best = finely;
            } else {
                found = &start;
            }
        }
        let values = self.objective.numbers().iter().zip(found).map(|(number, &place)| number.at(place));
        Ok(SearchOutcome {
            design: self.objective.design_at(found)?,
            best,
            keeps_limits,
            values: values.collect(),
            curve: record.curve.clone(),
            appraised: trials.appraised.load(Ordering::Relaxed),
            was_stopped: trials.stopped.load(Ordering::Relaxed),
        })
    }
}

impl Trials<'_> {
    /// Appraises a place near the best; `None` where there is no stone, or the search was stopped.
    pub fn near(&self, places: &[f64], with_slopes: bool) -> Option<Appraisal> {
        self.appraise(places, self.search.options.unresolved, with_slopes)
    }

    /// Returns the number of limits.
    pub fn slack_count(&self) -> usize {
        self.search.objective.start().slacks.len()
    }

    /// Returns the total of the best so far.
    pub fn best_total(&self) -> Option<f64> {
        self.best().map(|(_, total)| total)
    }

    /// Returns the place and the total of the best so far.
    fn best(&self) -> Option<(Vec<f64>, f64)> {
        self.record().best.clone()
    }

    fn appraise(&self, places: &[f64], unresolved: f64, with_slopes: bool) -> Option<Appraisal> {
        if self.stopped.load(Ordering::Relaxed) {
            return None;
        }
        let done = self.appraised.fetch_add(1, Ordering::Relaxed) + 1;
        let part = (done as f64 / self.most as f64).min(1.0);
        let watch = |_: f64| (self.watch)(part);
        match self.search.objective.appraise(places, unresolved, with_slopes, &watch) {
            Ok(found) => {
                // Rough figures only say where to look.
                match unresolved <= self.search.options.unresolved {
                    true => self.note(places, &found),
                    false => self.tell(done, self.best_total(), None),
                }
                Some(found)
            }
            Err(SearchError::Stopped) => {
                self.stopped.store(true, Ordering::Relaxed);
                None
            }
            Err(_) => None,
        }
    }

    /// Takes note of a design if it is the best so far that keeps all limits.
    fn note(&self, places: &[f64], found: &Appraisal) {
        let total = found.total.middle();
        let appraised = self.appraised.load(Ordering::Relaxed);
        let mut record = self.record();
        let is_best = keeps(found) && record.best.as_ref().is_none_or(|(_, best)| total > *best);
        if is_best {
            record.best = Some((places.to_vec(), total));
            record.curve.push(ProgressPoint { appraised, total });
        }
        let best_total = record.best.as_ref().map(|(_, total)| *total);
        drop(record);
        let design = is_best.then(|| self.search.objective.design_at(places).ok()).flatten();
        self.tell(appraised, best_total, design);
    }

    /// Says how far the search is.
    fn tell(&self, appraised: usize, best_total: Option<f64>, new_best: Option<Design>) {
        let part = (appraised as f64 / self.most as f64).min(1.0);
        (self.report)(&SearchProgress { appraised, part, best_total, new_best: new_best.map(Box::new) });
    }

    fn record(&self) -> std::sync::MutexGuard<'_, Record> {
        self.record.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn keeps(found: &Appraisal) -> bool {
    found.slacks.iter().all(|slack| *slack >= -KEPT)
}

/// Returns a total that counts missed limits against a design.
fn merit(found: &Appraisal) -> f64 {
    found.total.middle() - MISSED * found.slacks.iter().map(|slack| (-slack).max(0.0)).sum::<f64>()
}

/// Returns the places, those of the greatest merit first, without those that lie beside a better one.
fn distinct(mut found: Vec<(f64, Vec<f64>)>) -> Vec<Vec<f64>> {
    found.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut hills: Vec<Vec<f64>> = vec![];
    for (_, places) in found {
        let is_near = |hill: &Vec<f64>| hill.iter().zip(&places).all(|(a, b)| (a - b).abs() < SAME_HILL);
        if !hills.iter().any(is_near) {
            hills.push(places);
        }
    }
    hills
}

/// Returns the number of designs that are scattered near a promising one.
fn near_count(dimensions: usize) -> usize {
    4 + 2 * dimensions
}

/// Returns places spread evenly over the unit cube: the additive recurrence of M. Roberts ("The unreasonable effectiveness of
/// quasirandom sequences", 2018), in steps of powers of 1/φ, where φ > 1 solves φᵈ⁺¹ = φ + 1.
fn scattered(count: usize, dimensions: usize, seed: u64) -> Vec<Vec<f64>> {
    let mut phi: f64 = 2.0;
    for _ in 0..64 {
        phi = (1.0 + phi).powf(1.0 / (dimensions as f64 + 1.0));
    }
    let shift = 0.5 + seed as f64 * 0.618_033_988_749_895;
    let place = |point: usize, k: usize| {
        let step = phi.powi(-(k as i32 + 1));
        (shift * (1.0 + k as f64) + (point as f64 + 1.0) * step).fract()
    };
    (0..count).map(|point| (0..dimensions).map(|k| place(point, k)).collect()).collect()
}
