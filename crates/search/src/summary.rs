//! The result of a search as plain data, which programs read.

use super::others::{OtherMeasure, estimated_classes};
use super::outcome::SearchOutcome;
use super::run::DesignSearch;
use brillianteer_cut::{CutClass, FindingKind};
use brillianteer_measure::{Interval, MeasureName};
use serde::Serialize;

/// A value of the design before a search and of the found one.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct BeforeAndAfter<T> {
    /// The value before the search.
    pub before: T,
    /// The value of the found design.
    pub after: T,
}

/// The result of a search.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SearchSummary {
    /// The sum of the weighted measures, in parts of the light that the weights weigh.
    pub total: BeforeAndAfter<Interval>,
    /// The measures of the goal, in each material and view.
    pub measures: Vec<WeighedMeasure>,
    /// The classes, estimated after the ranges that GIA publishes; `None` unless both designs are round brilliants of diamond.
    pub estimate_after_gia: Option<BeforeAndAfter<CutClass>>,
    /// The usual measures, face up, that the goal does not weigh.
    pub others: Vec<UnweighedMeasure>,
    /// The numbers that the search may have changed.
    pub numbers: Vec<SearchedNumber>,
    /// The keys of the numbers that were held, because a change of them alone breaks a meet.
    pub held: Vec<String>,
    /// The figures that are limited.
    pub limits: Vec<LimitedFigure>,
    /// False where no design was found that keeps all limits; the design is the given one then.
    pub keeps_limits: bool,
    /// The audits of both designs.
    pub audit: AuditChange,
    /// The number of corners of four facets or more, all of which are kept.
    pub kept_corners: usize,
    /// The greatest distance of the planes of the found design from these corners, girdle radii.
    pub miss_of_meets: f64,
    /// The number of designs that were measured.
    pub appraised: usize,
    /// True where the search was stopped before its end.
    pub stopped: bool,
    /// The growth of the best: pairs of the number of designs that had been measured, and the total of the best then.
    pub curve: Vec<(usize, f64)>,
}

/// A measure of the goal in one material and view.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WeighedMeasure {
    /// The measure.
    pub of: MeasureName,
    /// The name of the material, or its index; `None` for the design's own.
    pub material: Option<String>,
    /// The tilt of the view, degrees.
    pub tilt: f64,
    /// The azimuth of the tilt, degrees.
    pub azimuth: f64,
    /// The share of the measure's weight; below 0 where less of the measure is wanted.
    pub weight: f64,
    /// The values of the measure in both designs.
    #[serde(flatten)]
    pub values: BeforeAndAfter<Interval>,
}

/// A measure that the goal does not weigh.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct UnweighedMeasure {
    /// The measure.
    pub of: MeasureName,
    /// The values of the measure in both designs.
    #[serde(flatten)]
    pub values: BeforeAndAfter<Interval>,
}

/// A number that a search may change, in its own unit.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SearchedNumber {
    /// The key of the number.
    pub key: String,
    /// The least value that was allowed.
    pub least: f64,
    /// The greatest value that was allowed.
    pub most: f64,
    /// The values of the number in both designs.
    #[serde(flatten)]
    pub values: BeforeAndAfter<f64>,
}

/// A figure that the goal limits, in its own unit.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LimitedFigure {
    /// The name of the figure, as in goals.
    pub name: String,
    /// The values of the figure in both designs.
    #[serde(flatten)]
    pub values: BeforeAndAfter<f64>,
}

/// The numbers of findings of two audits.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AuditChange {
    /// The numbers of all findings.
    #[serde(flatten)]
    pub findings: BeforeAndAfter<usize>,
    /// The kinds that either audit has.
    pub kinds: Vec<KindChange>,
}

/// The numbers of findings of one kind.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct KindChange {
    /// The kind.
    pub kind: FindingKind,
    /// The numbers of its findings.
    #[serde(flatten)]
    pub findings: BeforeAndAfter<usize>,
}

impl<T: Copy> BeforeAndAfter<T> {
    fn of([before, after]: [T; 2]) -> Self {
        Self { before, after }
    }
}

impl SearchSummary {
    /// Describes the outcome of a search; `others` are the measures that its goal does not weigh.
    pub fn of(search: &DesignSearch, outcome: &SearchOutcome, others: &[OtherMeasure]) -> Self {
        let (objective, best) = (search.objective(), &outcome.best);
        let start = objective.start();
        let weighed = start.values.iter().zip(&best.values).map(|(before, after)| WeighedMeasure {
            of: before.of,
            material: before.material.as_ref().map(ToString::to_string),
            tilt: before.tilt_deg,
            azimuth: before.azimuth_deg,
            weight: before.weight,
            values: BeforeAndAfter::of([before.value, after.value]),
        });
        let unweighed = others.iter().map(|other| UnweighedMeasure {
            of: other.name,
            values: BeforeAndAfter::of([other.before, other.after]),
        });
        let numbers = objective.numbers().iter().zip(&outcome.values).map(|(number, value)| SearchedNumber {
            key: number.key.to_string(),
            least: number.least,
            most: number.most,
            values: BeforeAndAfter::of([number.start, *value]),
        });
        let limits = start.figures.iter().zip(&best.figures).map(|((name, before), (_, after))| {
            LimitedFigure { name: name.clone(), values: BeforeAndAfter::of([*before, *after]) }
        });
        Self {
            total: BeforeAndAfter::of([start.total, best.total]),
            measures: weighed.collect(),
            estimate_after_gia: estimated_classes(search, outcome).map(BeforeAndAfter::of),
            others: unweighed.collect(),
            numbers: numbers.collect(),
            held: objective.held().iter().map(|number| number.key.to_string()).collect(),
            limits: limits.collect(),
            keeps_limits: outcome.keeps_limits,
            audit: AuditChange::of(outcome),
            kept_corners: objective.kept_corners(),
            miss_of_meets: objective.miss_of_meets(&outcome.design),
            appraised: outcome.appraised,
            stopped: outcome.was_stopped,
            curve: outcome.curve.iter().map(|point| (point.appraised, point.total)).collect(),
        }
    }
}

impl AuditChange {
    fn of(outcome: &SearchOutcome) -> Self {
        let kinds = outcome.findings().into_iter();
        let kinds = kinds.map(|(kind, counts)| KindChange { kind, findings: BeforeAndAfter::of(counts) });
        let findings = outcome.audits.each_ref().map(|audit| audit.findings.len());
        Self { findings: BeforeAndAfter::of(findings), kinds: kinds.collect() }
    }
}
