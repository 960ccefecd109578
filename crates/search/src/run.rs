//! The search: scatters designs over all ranges first, and then climbs from the best of them.

mod snap;

use super::appraisal::{Appraisal, SearchError};
use super::goal::Goal;
use super::kept_shape::audit_of;
use super::local::{climb, feel};
use super::objective::Objective;
use super::outcome::{ProgressPoint, SearchOutcome, SearchProgress};
use brillianteer_base::{Watch, at_once};
use brillianteer_cut::Design;
use brillianteer_scene::Specimen;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// The number of designs, for each number, that are tried to bring angles to multiples of their step.
const SNAPPED_FOR_EACH: usize = 12;

/// The amount by which a limit that is missed by 1 reduces the total, for the comparison of designs of which none
/// keeps all limits.
const MISSED: f64 = 10.0;

/// The number of numbers below which no slopes are taken: they would cost more than the designs that they save.
const FEWEST_WITH_SLOPES: usize = 3;

/// The first step of a search without slopes, a part of each range.
const FELT_STEP: f64 = 0.005;

/// The number of scattered designs in the first batch, whose best is measured finely at once; each further batch is
/// twice as large.
const FIRST_BATCH: usize = 8;

/// The number of places from which the search climbs without slopes at the end. Where a total jumps, more short climbs find the
/// best more surely than fewer long ones: of 60 searches from random starts, two long climbs missed it four times, these twice.
const FELT_TOPS: usize = 4;

/// Designs are scattered over this many times each range and brought back to its ends, because the best often lies there.
const WIDENED: f64 = 1.15;

/// The factor by which more light may stay unresolved in designs that are scattered over all ranges.
const COARSEST: f64 = 10.0;

/// A step of the search that scatters designs around the most promising of those before them.
///
/// Totals of light jump and bend within hundredths of a degree, so that neither slopes nor steps lead far; designs
/// that are scattered nearer and nearer find the way over the jumps.
struct Zoom {
    /// The distance from a promising design within which others are scattered, a part of each range.
    reach: f64,
    /// The number of promising designs for each climb.
    hills: usize,
    /// Designs nearer than this in every number, parts of its range, count as one.
    apart: f64,
    /// The number of designs around each promising one: so many for each number, and four more.
    per_number: usize,
    /// The factor by which more light may stay unresolved.
    coarser: f64,
}

const ZOOMS: [Zoom; 3] = [
    Zoom { reach: 0.1, hills: 4, apart: 0.12, per_number: 4, coarser: 10.0 },
    Zoom { reach: 0.04, hills: 2, apart: 0.06, per_number: 3, coarser: 5.0 },
    Zoom { reach: 0.012, hills: 2, apart: 0.024, per_number: 2, coarser: 2.5 },
];

impl Zoom {
    /// Returns the number of designs that are scattered around one.
    fn around(&self, dimensions: usize) -> usize {
        4 + self.per_number * dimensions
    }
}

/// Designs nearer to each other than this in every number, parts of its range, start only one climb.
const SAME_TOP: f64 = 0.012;

/// The settings of a search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SearchOptions {
    /// The part of the light that may stay unresolved near the best; scattered designs take more.
    pub unresolved: f64,
    /// The number of designs that are scattered over the ranges; `None` for as many as the numbers need.
    pub scattered: Option<usize>,
    /// The number of them from which the search climbs, at least 1.
    pub climbs: usize,
    /// The seed of the scatter: another number scatters other designs.
    pub seed: u64,
    /// True where the search climbs by slopes if there are any.
    pub by_slopes: bool,
    /// True where polarisation is followed.
    pub polarised: bool,
    /// The step of angles in degrees, above 0, such as that of a faceting machine's scale. Angles that change end on
    /// multiples of it where their ranges hold one, also where the search is stopped; the angles of a scaled side do not.
    /// `None` for any angle.
    pub angle_step_deg: Option<f64>,
}

impl Default for SearchOptions {
    fn default() -> Self {
        Self {
            unresolved: 2e-3,
            scattered: None,
            climbs: 3,
            seed: 0,
            by_slopes: true,
            polarised: true,
            angle_step_deg: None,
        }
    }
}

/// The limit of unresolved light of the roughest designs.
const MOST_UNRESOLVED: f64 = 0.05;

/// The factor by which less light stays unresolved in the figures of the outcome.
const FINER: f64 = 4.0;

/// A search for the best design by a goal.
pub struct DesignSearch {
    objective: Objective,
    options: SearchOptions,
}

/// The record of a running search.
#[derive(Default, Clone)]
struct Record {
    /// The places of the best design, and its appraisal.
    best: Option<(Vec<f64>, Appraisal)>,
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
    /// Fails where the goal or the design has a fault, or where `watch` stops.
    pub fn new(
        design: &Design,
        goal: &Goal,
        options: SearchOptions,
        watch: Watch,
    ) -> Result<Self, SearchError> {
        let finest = options.unresolved / FINER;
        let fineness = (options.unresolved, finest);
        let objective = Objective::new(design, goal, options.polarised, fineness, watch)?;
        Ok(Self { objective, options })
    }

    /// Returns the settings of the search.
    pub fn options(&self) -> &SearchOptions {
        &self.options
    }

    /// Returns the goal for the design.
    pub fn objective(&self) -> &Objective {
        &self.objective
    }

    /// Searches on all cores. `report` is called from any of them.
    ///
    /// Where `watch` stops, the outcome is the best design so far, measured no more finely than until then.
    ///
    /// # Errors
    /// Fails where the found design cannot be measured finely, which does not happen if it could be measured roughly.
    pub fn run(
        &self,
        watch: Watch,
        report: &(dyn Fn(&SearchProgress) + Sync),
    ) -> Result<SearchOutcome, SearchError> {
        let dimensions = self.objective.numbers().len();
        let scattered = self.options.scattered.unwrap_or(80 + 25 * dimensions);
        let climbs = self.options.climbs.max(1);
        let has_slopes =
            self.options.by_slopes && dimensions >= FEWEST_WITH_SLOPES && self.objective.has_slopes();
        let climbing = if has_slopes { 10 + 6 * dimensions } else { 0 };
        let feeling = 6 + 5 * dimensions;
        let zoomed: usize = ZOOMS.iter().map(|zoom| climbs * zoom.hills * zoom.around(dimensions)).sum();
        let trials = Trials {
            search: self,
            watch,
            report,
            most: scattered + zoomed + climbs * climbing + FELT_TOPS * feeling + self.snapping(),
            appraised: AtomicUsize::new(0),
            stopped: AtomicBool::new(false),
            record: Mutex::default(),
        };
        let start = self.objective.start_places();
        trials.note(&start, self.objective.start());
        let mut tops = self.tops(&trials, scattered, start);
        if has_slopes {
            let mut starts = distinct(&tops, SAME_TOP);
            starts.truncate(climbs);
            let climbed = at_once(self.objective.designs_at_once(), &starts, |from| {
                let places = climb(&trials, from, climbing);
                Some((merit(&trials.near(&places, false)?), places))
            });
            tops.extend(climbed.into_iter().flatten());
            // The best design on the way may be better than the end of a climb.
            tops.extend(trials.best().map(|(places, total)| (total, places)));
        }
        let mut starts = distinct(&tops, SAME_TOP);
        starts.truncate(FELT_TOPS);
        at_once(self.objective.designs_at_once(), &starts, |top| feel(&trials, top, FELT_STEP, feeling));
        if let Some(step) = self.options.angle_step_deg {
            trials.snap(step, self.snapping());
        }
        self.outcome(&trials, watch)
    }

    /// Returns the number of appraisals that bring angles to multiples of their step.
    fn snapping(&self) -> usize {
        self.options.angle_step_deg.map_or(0, |_| SNAPPED_FOR_EACH * self.objective.numbers().len())
    }

    /// Scatters designs over all ranges, and then nearer and nearer around the most promising. Returns all with their
    /// merit.
    fn tops(&self, trials: &Trials, count: usize, start: Vec<f64>) -> Vec<(f64, Vec<f64>)> {
        let dimensions = start.len();
        let tried = |places: Vec<Vec<f64>>, coarser: f64| -> Vec<(f64, Vec<f64>)> {
            let unresolved = (self.options.unresolved * coarser).min(MOST_UNRESOLVED);
            let tried = |places: &Vec<f64>| {
                Some((merit(&trials.appraise(places, unresolved, false)?), places.clone()))
            };
            let (mut found, mut rest, mut count) = (vec![], places.as_slice(), FIRST_BATCH);
            while !rest.is_empty() {
                let (batch, later) = rest.split_at(count.min(rest.len()));
                let batch = at_once(self.objective.designs_at_once(), batch, tried);
                let batch: Vec<(f64, Vec<f64>)> = batch.into_iter().flatten().collect();
                // The most promising design is measured finely at once, so that a better design is shown early.
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
        let mut everywhere = scattered(count, dimensions, self.options.seed);
        everywhere.iter_mut().flatten().for_each(|place| *place = beyond_the_ends(*place));
        found.extend(tried(everywhere, COARSEST));
        for zoom in &ZOOMS {
            let near = scattered(zoom.around(dimensions), dimensions, self.options.seed);
            let around = |hill: Vec<f64>| -> Vec<Vec<f64>> {
                let place = |(at, to): (&f64, &f64)| (at + zoom.reach * (2.0 * to - 1.0)).clamp(0.0, 1.0);
                near.iter().map(|offset| hill.iter().zip(offset).map(place).collect()).collect()
            };
            let hills =
                distinct(&found, zoom.apart).into_iter().take(zoom.hills * self.options.climbs.max(1));
            found.extend(tried(hills.flat_map(around).collect(), zoom.coarser));
        }
        found
    }

    /// Measures the best finely, unless the search was stopped, in which case its figures stay rough.
    fn outcome(&self, trials: &Trials, watch: Watch) -> Result<SearchOutcome, SearchError> {
        // A copy, so that the lock is not held while the best is measured on the pool.
        let record = trials.record().clone();
        let start = self.objective.start_places();
        let finest = self.options.unresolved / FINER;
        let mut best = self.objective.start().clone();
        let mut found = &start;
        if let Some((places, roughly)) = record.best.as_ref().filter(|(places, _)| *places != start) {
            let finely = if trials.stopped.load(Ordering::Relaxed) {
                Err(SearchError::Stopped)
            } else {
                self.objective.appraise(places, finest, false, &|_| watch(1.0))
            };
            let better = match finely {
                Err(SearchError::Stopped) => {
                    trials.stopped.store(true, Ordering::Relaxed);
                    roughly.clone()
                }
                finely => finely?,
            };
            // The design may be better by rough figures, but not by fine ones.
            if better.total.middle() > best.total.middle() || !best.keeps_limits() {
                (best, found) = (better, places);
            }
        }
        let keeps_limits = record.best.is_some() || self.objective.start().keeps_limits();
        let values = self.objective.numbers().iter().zip(found).map(|(number, &place)| number.at(place));
        let design = self.objective.design_at(found)?;
        let audit = |design: &Design| Ok::<_, SearchError>(audit_of(&Specimen::new(design.clone())?));
        let audits = [audit(self.objective.design())?, audit(&design)?];
        Ok(SearchOutcome {
            design,
            audits,
            best,
            keeps_limits,
            values: values.collect(),
            curve: record.curve,
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

    /// Returns the total of the design before the search. It is the same in every run, unlike the best so far.
    pub fn start_total(&self) -> f64 {
        self.search.objective.start().total.middle()
    }

    /// Returns the total of the best so far.
    fn best_total(&self) -> Option<f64> {
        self.best().map(|(_, total)| total)
    }

    /// Returns the place and the total of the best so far.
    fn best(&self) -> Option<(Vec<f64>, f64)> {
        self.record().best.as_ref().map(|(places, found)| (places.clone(), found.total.middle()))
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
                // Rough figures only show where to measure finely.
                if unresolved <= self.search.options.unresolved {
                    self.note(places, &found)
                } else {
                    self.tell(done, self.best_total(), None)
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

    /// Records a design if it is the best so far that keeps all limits.
    fn note(&self, places: &[f64], found: &Appraisal) {
        let total = found.total.middle();
        let mut record = self.record();
        // The count is read while the record is locked, so that the curve never goes back.
        let appraised = self.appraised.load(Ordering::Relaxed);
        let best = record.best.as_ref().map(|(_, best)| best.total.middle());
        let is_best = found.keeps_limits() && best.is_none_or(|best| total > best);
        if is_best {
            record.best = Some((places.to_vec(), found.clone()));
            record.curve.push(ProgressPoint { appraised, total });
        }
        let best_total = record.best.as_ref().map(|(_, best)| best.total.middle());
        drop(record);
        let design = is_best.then(|| self.search.objective.design_at(places).ok()).flatten();
        self.tell(appraised, best_total, design);
    }

    /// Reports the progress of the search.
    fn tell(&self, appraised: usize, best_total: Option<f64>, new_best: Option<Design>) {
        let part = (appraised as f64 / self.most as f64).min(1.0);
        (self.report)(&SearchProgress { appraised, part, best_total, new_best: new_best.map(Box::new) });
    }

    fn record(&self) -> std::sync::MutexGuard<'_, Record> {
        self.record.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Returns the total less a penalty for missed limits.
fn merit(found: &Appraisal) -> f64 {
    found.total.middle() - MISSED * found.slacks.iter().map(|slack| (-slack).max(0.0)).sum::<f64>()
}

/// Returns the places, those of the greatest merit first, without those that lie in every number nearer than `apart` to a better one.
fn distinct(found: &[(f64, Vec<f64>)], apart: f64) -> Vec<Vec<f64>> {
    let mut sorted: Vec<&(f64, Vec<f64>)> = found.iter().collect();
    sorted.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut hills: Vec<Vec<f64>> = vec![];
    for (_, places) in sorted {
        let is_near = |hill: &Vec<f64>| hill.iter().zip(places).all(|(a, b)| (a - b).abs() < apart);
        if !hills.iter().any(is_near) {
            hills.push(places.clone());
        }
    }
    hills
}

/// Returns a place of the widened range, brought back to the ends.
fn beyond_the_ends(place: f64) -> f64 {
    (0.5 + WIDENED * (place - 0.5)).clamp(0.0, 1.0)
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
