//! Appraises designs by a goal.

use super::appraisal::{Appraisal, GoalValue, SearchError, Slopes};
use super::goal::Goal;
use super::kept_corners::KeptCorners;
use super::limits::GeometryLimit;
use super::numbers::{AS_IT_IS, VariedNumber};
use super::terms::{GoalView, Term, views_and_terms};
use brillianteer_base::{Watch, at_once};
use brillianteer_cut::{Cut, Design, TierOutcome, Tiers};
use brillianteer_measure::{Interval, MeasureSettings, PatternSettings, ROCK_DEG};
use brillianteer_optics::line;
use brillianteer_render::{PlaneChanges, RenderError, Sweep, SweepError, SweepKey, SweptStone, with_numbers};
use brillianteer_scene::{Specimen, Stone};

/// The part of a number's range by which it is changed for the derivatives of the geometry.
const GEOMETRY_STEP: f64 = 1e-4;

/// The part of a number's range by which it is changed to test whether it keeps all meets.
const MEET_STEP: f64 = 0.01;

/// The parts of the memory of beams of which one belongs to a view of a design, and the most views that are measured at once.
pub(super) const PARTS: usize = 8;

/// A goal for one design.
pub struct Objective {
    design: Design,
    numbers: Vec<VariedNumber>,
    views: Vec<GoalView>,
    terms: Vec<Term>,
    limits: Vec<GeometryLimit>,
    corners: KeptCorners,
    /// The numbers that stay unchanged, because a change of them alone breaks a meet.
    held: Vec<VariedNumber>,
    start: Appraisal,
    polarised: bool,
}

impl Objective {
    /// Takes a goal for a design, and appraises the given design until no more than `unresolved` of the light is
    /// open.
    ///
    /// Allowed losses count from the given design as measured until no more than `searched` is open, like the designs
    /// of a search, so that a design without a loss is never refused.
    ///
    /// The meets that a design of tiers states, and those that its geometry shows, are followed from here on, except
    /// for stated ones that contradict the design. Numbers that break a meet when they alone change are held. Where
    /// the goal names no number, a side with a held tier also changes by its scale, which moves all its tiers
    /// together.
    ///
    /// # Errors
    /// Fails where the goal or the design has a fault, or where `watch` stops.
    pub fn new(
        design: &Design,
        goal: &Goal,
        polarised: bool,
        (searched, unresolved): (f64, f64),
        watch: Watch,
    ) -> Result<Self, SearchError> {
        goal.check()?;
        let mut design = design.clone();
        if let Cut::Tiers(tiers) = &mut design.cut {
            *tiers = followed(tiers.with_stated_meets().with_found_meets());
        }
        let specimen = Specimen::new(design.clone())?;
        let stone = stone_of(&specimen)?;
        let numbers = VariedNumber::all(goal, &design)?;
        let corners = KeptCorners::of(stone);
        let limits = GeometryLimit::all(goal, &specimen, stone)?;
        let (views, terms) = views_and_terms(goal);
        let blank = Appraisal {
            total: Interval::from(0.0, 0.0),
            values: vec![],
            figures: vec![],
            slacks: vec![],
            slopes: None,
        };
        let mut new =
            Self { design, numbers, views, terms, limits, corners, held: vec![], start: blank, polarised };
        new.drop_unsteady_meets();
        new.hold_what_breaks_meets();
        if goal.vary.is_empty() {
            new.drop_idle_scales();
        }
        if new.numbers.is_empty() {
            return Err(SearchError::NoNumbers);
        }
        new.start = new.appraise(&new.start_places(), searched, false, watch)?;
        new.limit_losses(goal);
        new.start = new.appraise(&new.start_places(), unresolved, false, watch)?;
        Ok(new)
    }

    /// Returns the design from before the search, with its meets.
    pub fn design(&self) -> &Design {
        &self.design
    }

    /// Returns the numbers that change.
    pub fn numbers(&self) -> &[VariedNumber] {
        &self.numbers
    }

    /// Returns the numbers that are held, because a change of them alone breaks a meet.
    pub fn held(&self) -> &[VariedNumber] {
        &self.held
    }

    /// Returns the appraisal of the design from before the search.
    pub fn start(&self) -> &Appraisal {
        &self.start
    }

    /// Returns the least and the greatest value of a limited figure; infinite where there is none.
    pub fn ends_of(&self, figure: &str) -> (f64, f64) {
        let limit = self.limits.iter().find(|limit| limit.name == figure);
        limit.map_or((f64::NEG_INFINITY, f64::INFINITY), |limit| limit.ends)
    }

    /// Returns the number of corners that are kept: those where four or more facets meet.
    pub fn kept_corners(&self) -> usize {
        self.corners.count()
    }

    /// Returns the greatest distance by which the planes of a design miss the kept corners, girdle radii: at most
    /// 1e-9, or a tenth more than in the design before the search. It is infinite where the design makes no such
    /// stone.
    pub fn miss_of_meets(&self, design: &Design) -> f64 {
        let specimen = Specimen::new(design.clone()).ok();
        let stone = specimen.as_ref().and_then(|specimen| specimen.stone().ok());
        stone.map_or(f64::INFINITY, |stone| self.corners.miss(stone))
    }

    /// Returns the place of the design before the search in the ranges of its numbers, each 0 to 1.
    pub(super) fn start_places(&self) -> Vec<f64> {
        self.numbers.iter().map(VariedNumber::start_place).collect()
    }

    /// Returns whether the goal has useful derivatives: those of extinction and contrast exist, but jump too often. A
    /// tier that is varied beside the scale of its side does not follow that scale, which the derivative by the scale
    /// would ignore.
    pub(super) fn has_slopes(&self) -> bool {
        let cut = &self.design.cut;
        let is_beside = |scale: &VariedNumber| {
            let beside = |other: &&VariedNumber| other.key != scale.key && other.side(cut) == scale.side(cut);
            matches!(scale.key, SweepKey::Scale(_)) && self.numbers.iter().any(|other| beside(&other))
        };
        !self.numbers.iter().any(is_beside) && self.terms.iter().all(|term| term.name.is_energy())
    }

    /// Returns the design at a place of the ranges, with its meets followed.
    ///
    /// # Errors
    /// Fails where a meet cannot be followed.
    pub(super) fn design_at(&self, places: &[f64]) -> Result<Design, SearchError> {
        let values = self.numbers.iter().zip(places).map(|(number, &place)| (&number.key, number.at(place)));
        Ok(with_numbers(&self.design, values)?)
    }

    /// Appraises the design at a place of the ranges.
    ///
    /// # Errors
    /// Fails where there is no such stone, where it does not keep the meets, or where `watch` stops.
    pub(super) fn appraise(
        &self,
        places: &[f64],
        unresolved: f64,
        with_slopes: bool,
        watch: Watch,
    ) -> Result<Appraisal, SearchError> {
        let design = self.design_at(places)?;
        let figures = self.figures(&design)?;
        let sweeps: Vec<Sweep> =
            self.views.iter().map(|view| self.sweep(view, &design, unresolved)).collect();
        let changes = match (with_slopes, sweeps.first()) {
            (true, Some(sweep)) => {
                let keys: Vec<_> = self.numbers.iter().map(|number| number.key.clone()).collect();
                // Where a facet comes or goes beside the design there are no slopes, but there is a stone.
                sweep.plane_changes(&keys).ok()
            }
            _ => None,
        };
        let views: Vec<_> = sweeps.iter().zip(&self.views).collect();
        let measured = at_once(self.views_at_once(), &views, |(sweep, view)| {
            taken(sweep, view, changes.as_ref(), watch)
        });
        let measured = measured.into_iter().collect::<Result<Vec<_>, _>>()?;
        let mut appraisal = self.summed(&measured, figures)?;
        if changes.is_some() {
            appraisal.slopes = Some(self.slopes(places, &measured));
        }
        Ok(appraisal)
    }

    /// Returns the number of views of a design that are measured at once.
    fn views_at_once(&self) -> usize {
        self.views.len().clamp(1, PARTS)
    }

    /// Returns the number of designs that may be appraised at once, so that the views of all have memory.
    pub(super) fn designs_at_once(&self) -> usize {
        PARTS / self.views_at_once()
    }

    /// Returns the limited figures of a design that keeps its meets.
    fn figures(&self, design: &Design) -> Result<Vec<(String, f64)>, SearchError> {
        let specimen = Specimen::new(design.clone())?;
        let stone = stone_of(&specimen)?;
        if !self.corners.has_all_facets(stone) {
            return Err(SearchError::Vanished);
        }
        if let Some(facets) = self.corners.broken(stone) {
            return Err(SearchError::Broken(facets.join(", ")));
        }
        let figure = |limit: &GeometryLimit| (limit.name.clone(), limit.value(&specimen, stone));
        Ok(self.limits.iter().map(figure).collect())
    }

    fn of_material(&self, view: &GoalView, mut design: Design) -> Design {
        if let Some(material) = &view.material {
            design.material = material.reference();
        }
        design
    }

    fn sweep(&self, view: &GoalView, design: &Design, unresolved: f64) -> Sweep {
        let mut domes = vec![];
        for dome in view.names.iter().filter_map(|name| name.dome()) {
            if !domes.contains(&dome) {
                domes.push(dome);
            }
        }
        Sweep {
            design: self.of_material(view, design.clone()),
            viewpoint: view.viewpoint,
            axes: vec![],
            // The indices of colours are those of each stone's material.
            settings: MeasureSettings {
                domes,
                pattern: PatternSettings::needed_by(&view.names, 0.5 * design.diameter_mm, ROCK_DEG),
                ..MeasureSettings::usual([1.0; 2])
            },
            wavelength_nm: line::SODIUM_D,
            unresolved,
            polarised: self.polarised,
        }
    }

    /// Adds up the measures of all views.
    fn summed(
        &self,
        measured: &[(SweptStone, Vec<Vec<f64>>)],
        figures: Vec<(String, f64)>,
    ) -> Result<Appraisal, SearchError> {
        let (mut least, mut most) = (0.0, 0.0);
        let (mut values, mut slacks) = (vec![], vec![]);
        for term in &self.terms {
            let view = &self.views[term.view];
            let value = term.name.of(&measured[term.view].0.measures);
            let value = value.ok_or_else(|| SearchError::NotMeasured(term.name.to_string()))?;
            let (worse, better) =
                if term.weight < 0.0 { (value.most, value.least) } else { (value.least, value.most) };
            // A weight of 0 times an infinite end would be NaN.
            if term.weight != 0.0 {
                (least, most) = (least + term.weight * worse, most + term.weight * better);
            }
            // A limit is kept where the whole interval keeps it.
            push_slacks(&mut slacks, term.ends, (value.least, value.most));
            values.push(GoalValue {
                of: term.name,
                material: view.material.clone(),
                tilt_deg: view.viewpoint.tilt_deg,
                azimuth_deg: view.viewpoint.azimuth_deg,
                weight: term.weight,
                value,
            });
        }
        for (limit, (_, figure)) in self.limits.iter().zip(&figures) {
            push_slacks(&mut slacks, limit.ends, (*figure, *figure));
        }
        Ok(Appraisal { total: Interval { least, most }, values, figures, slacks, slopes: None })
    }

    /// Returns the changes of total and slacks; the part of the light was measured.
    fn slopes(&self, places: &[f64], measured: &[(SweptStone, Vec<Vec<f64>>)]) -> Slopes {
        let count = self.numbers.len();
        let (mut total, mut slacks) = (vec![0.0; count], vec![]);
        for term in &self.terms {
            let place = self.views[term.view].names.iter().position(|name| *name == term.name);
            let per = place.and_then(|place| measured[term.view].1.get(place));
            let whole = |k: usize| {
                let slope = per.map_or(0.0, |per| per[k] * self.units_at(places, k));
                slope * (self.numbers[k].most - self.numbers[k].least)
            };
            let slope: Vec<f64> = (0..count).map(whole).collect();
            total.iter_mut().zip(&slope).for_each(|(sum, slope)| *sum += term.weight * slope);
            push_slopes(&mut slacks, term.ends, &slope);
        }
        let changes: Vec<Vec<f64>> = (0..count).map(|k| self.figure_slopes(places, k)).collect();
        for (place, limit) in self.limits.iter().enumerate() {
            let of_number = |of: &Vec<f64>| if limit.is_stepped() { 0.0 } else { of[place] };
            let slope: Vec<f64> = changes.iter().map(of_number).collect();
            push_slopes(&mut slacks, limit.ends, &slope);
        }
        Slopes { total, slacks }
    }

    /// Returns the factor from a slope by the design at this place to a slope by the number. A scale is in percent of
    /// the height in the given design, but the slope is in percent of the height at this place.
    fn units_at(&self, places: &[f64], number: usize) -> f64 {
        match self.numbers[number].key {
            SweepKey::Scale(_) => AS_IT_IS / self.numbers[number].at(places[number]),
            _ => 1.0,
        }
    }

    /// Returns the changes of the limited figures over the range of a number; 0 where one side of the place makes no
    /// stone.
    fn figure_slopes(&self, places: &[f64], number: usize) -> Vec<f64> {
        if self.limits.is_empty() {
            return vec![];
        }
        let at = |by: f64| {
            let mut places = places.to_vec();
            places[number] = (places[number] + by).clamp(0.0, 1.0);
            let figures = self.design_at(&places).and_then(|design| self.figures(&design)).ok()?;
            Some((places[number], figures))
        };
        match (at(-GEOMETRY_STEP), at(GEOMETRY_STEP)) {
            (Some((low, below)), Some((high, above))) if high > low => {
                below.iter().zip(&above).map(|((_, a), (_, b))| (b - a) / (high - low)).collect()
            }
            _ => vec![0.0; self.limits.len()],
        }
    }

    /// Drops meets that rounding alone breaks: they can be followed once, but not again from the resulting distances.
    fn drop_unsteady_meets(&mut self) {
        let start = self.start_places();
        while let Err(SearchError::Sweep(SweepError::Meet(error))) = self.design_at(&start) {
            let Cut::Tiers(tiers) = &mut self.design.cut else { return };
            match tiers.tiers.get_mut(error.tier - 1).and_then(|tier| tier.meet.take()) {
                Some(_) => (),
                None => return,
            }
        }
    }

    /// Holds the numbers that break a meet when they alone change.
    fn hold_what_breaks_meets(&mut self) {
        let keeps = |number: &VariedNumber| {
            let place = number.start_place();
            let beside = number.at(place + if place < 0.5 { MEET_STEP } else { -MEET_STEP });
            // The others are not set: tiers that are set to their angles do not move with their side.
            let design = with_numbers(&self.design, [(&number.key, beside)]).map_err(SearchError::from);
            design.and_then(|design| self.figures(&design)).is_ok()
        };
        let kept: Vec<bool> = self.numbers.iter().map(keeps).collect();
        let all = std::mem::take(&mut self.numbers).into_iter().zip(kept);
        let (numbers, held): (Vec<_>, Vec<_>) = all.partition(|(_, keeps)| *keeps);
        self.numbers = numbers.into_iter().map(|(number, _)| number).collect();
        self.held = held.into_iter().map(|(number, _)| number).collect();
    }

    /// Drops the scales of sides whose tiers all move alone.
    fn drop_idle_scales(&mut self) {
        let held: Vec<_> = self.held.iter().filter_map(|number| number.side(&self.design.cut)).collect();
        self.numbers.retain(|number| match &number.key {
            SweepKey::Scale(side) => held.contains(side),
            _ => true,
        });
    }

    /// Turns the allowed losses against the start into limits.
    fn limit_losses(&mut self, goal: &Goal) {
        let mut places = 0..;
        for measure in &goal.measure {
            for _ in 0..measure.terms() {
                let Some(place) = places.next() else { return };
                let (Some(lost), Some(start)) = (measure.may_lose, self.start.values.get(place)) else {
                    continue;
                };
                let ends = &mut self.terms[place].ends;
                if measure.weight < 0.0 {
                    ends.1 = ends.1.min(start.value.most + lost);
                } else {
                    ends.0 = ends.0.max(start.value.least - lost);
                }
            }
        }
    }
}

/// Returns the stone of a design.
///
/// # Errors
/// Fails where the design makes no convex stone between planes.
fn stone_of(specimen: &Specimen) -> Result<&Stone, SearchError> {
    let why = || specimen.why_not_convex().unwrap_or_default();
    specimen.stone().map_err(|_| SearchError::NotConvex(why()))
}

/// Follows all meets, and drops those that cannot be followed: their tiers stay where they are.
///
/// Distances that follow from meets can break another meet, so the meets are followed until no tier moves any more.
fn followed(mut tiers: Tiers) -> Tiers {
    // Every pass except the last moves tiers or drops a meet; a design that never settles is left in the state of the
    // last pass.
    for _ in 0..2 * tiers.tiers.len() + 2 {
        let solved = tiers.solved();
        let is_failed = |outcome: &TierOutcome| matches!(outcome, TierOutcome::Failed(_));
        match solved.outcomes.iter().position(is_failed) {
            Some(place) => tiers.tiers[place].meet = None,
            None if solved.tiers == tiers => break,
            None => tiers = solved.tiers,
        }
    }
    tiers
}

/// Measures one view; with `changes`, also the derivatives of its measures by each number.
fn taken(
    sweep: &Sweep,
    view: &GoalView,
    changes: Option<&PlaneChanges>,
    watch: Watch,
) -> Result<(SweptStone, Vec<Vec<f64>>), SearchError> {
    let stopped = |error: SweepError| match error {
        SweepError::Render(RenderError::Stopped(_)) => SearchError::Stopped,
        error => SearchError::Sweep(error),
    };
    match changes {
        None => Ok((sweep.point(0, PARTS, watch).map_err(stopped)?, vec![])),
        Some(changes) => {
            let graded = sweep.graded(changes, (&view.names, PARTS), watch).map_err(stopped)?;
            Ok((graded.stone, graded.gradients.into_iter().map(|gradient| gradient.per).collect()))
        }
    }
}

fn push_slacks(slacks: &mut Vec<f64>, (low, high): (f64, f64), (least, most): (f64, f64)) {
    slacks.extend(low.is_finite().then_some(least - low));
    slacks.extend(high.is_finite().then_some(high - most));
}

fn push_slopes(slopes: &mut Vec<Vec<f64>>, (low, high): (f64, f64), slope: &[f64]) {
    slopes.extend(low.is_finite().then(|| slope.to_vec()));
    slopes.extend(high.is_finite().then(|| slope.iter().map(|slope| -slope).collect()));
}
