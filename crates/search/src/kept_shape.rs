//! What a search keeps of a design though its goal does not say so: no facet and no edge becomes tiny, the girdle stays about
//! as thick, an audit finds nothing that it did not find before, and the estimated class stays.

use super::goal::{AtLeastAtMost, Goal};
use super::limits::{GIRDLE, LOWER_CLASS, NEW_FINDINGS, SHORTEST_EDGE, SMALLEST_FACET};
use brillianteer_cut::{
    Audit, ClassEstimate, CutClass, FindingKind, NEAR_MISS, SMALL_FACET, SheetFigures, SmallestParts,
};
use brillianteer_measure::brilliant_proportions;
use brillianteer_scene::{Specimen, Stone};
use std::collections::BTreeMap;

/// The part of the present size to which the smallest facet and the shortest edge may shrink where they are findings already.
const MAY_SHRINK: f64 = 0.9;

/// The most by which the girdle's thickness may change, as a part of the stone's width.
const GIRDLE_WITHIN: f64 = 0.005;

/// The key of the girdle's thickness, which a goal names that is to change it.
const GIRDLE_KEY: &str = "girdle_thickness";

/// Returns the limits that a search keeps by itself, without those that the goal states.
pub(super) fn usual_limits(goal: &Goal, stone: &Stone) -> BTreeMap<String, AtLeastAtMost> {
    let mut limits = BTreeMap::new();
    if goal.new_findings {
        return limits;
    }
    let at_least = |end: f64| AtLeastAtMost { at_least: end.is_finite().then_some(end), at_most: None };
    let parts = SmallestParts::of(&stone.polytope);
    let part = |percent: f64, usual: f64| 0.01 * usual.min(MAY_SHRINK * percent);
    limits.insert(SMALLEST_FACET.to_owned(), at_least(part(parts.facet_percent, SMALL_FACET)));
    limits.insert(SHORTEST_EDGE.to_owned(), at_least(part(parts.edge_percent, NEAR_MISS)));
    let girdle = SheetFigures::of(&stone.polytope, stone.names()).girdle_to_width;
    if !goal.vary.contains_key(GIRDLE_KEY) {
        let (least, most) = ((girdle - GIRDLE_WITHIN).max(0.5 * girdle), girdle + GIRDLE_WITHIN);
        limits.insert(GIRDLE.to_owned(), AtLeastAtMost { at_least: Some(least), at_most: Some(most) });
    }
    let none = AtLeastAtMost { at_least: None, at_most: Some(0.0) };
    limits.insert(NEW_FINDINGS.to_owned(), none);
    // The class is one of diamond, which a design for other materials need not keep.
    if goal.measure.iter().any(|measure| measure.material.is_none()) {
        limits.insert(LOWER_CLASS.to_owned(), none);
    }
    let is_end = |limit: &AtLeastAtMost| limit.at_least.or(limit.at_most).is_some();
    limits.retain(|name, limit| !goal.limit.contains_key(name) && is_end(limit));
    limits
}

/// The number of findings of each kind that an audit has for a design.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct FindingCounts([usize; FindingKind::ALL.len()]);

impl FindingCounts {
    /// Counts the findings of an audit.
    pub fn of(audit: &Audit) -> Self {
        Self(FindingKind::ALL.map(|kind| audit.of_kind(kind).count()))
    }

    /// Returns the number of findings of another audit that go beyond these, kind by kind.
    pub fn new_in(&self, audit: &Audit) -> usize {
        let now = Self::of(audit);
        now.0.iter().zip(&self.0).map(|(now, before)| now.saturating_sub(*before)).sum()
    }
}

/// Returns the audit of a specimen; one without findings where it is no convex stone.
pub(super) fn audit_of(specimen: &Specimen) -> Audit {
    specimen.audit().unwrap_or_default()
}

/// Returns the class of a specimen, estimated after the ranges that GIA publishes for round brilliants of diamond; `None` for any
/// other stone.
pub(super) fn estimated_class(specimen: &Specimen) -> Option<CutClass> {
    let is_diamond = specimen.material.name.eq_ignore_ascii_case("diamond");
    let proportions = brilliant_proportions(specimen.stone().ok().filter(|_| is_diamond)?).ok()?;
    Some(ClassEstimate::after_gia(&proportions).class)
}
