//! The outcome of a search, and its progress.

use super::appraisal::Appraisal;
use brillianteer_cut::{Audit, Design, FindingKind};

/// The progress of a search, reported for each appraised design. Threads report in any order, so a report with a
/// smaller number may follow.
#[derive(Debug, Clone, PartialEq)]
pub struct SearchProgress {
    /// The number of designs that were appraised.
    pub appraised: usize,
    /// The part of the work that is certainly done, 0 to 1; it jumps to 1 where a search settles early.
    pub part: f64,
    /// The total of the best design so far, which keeps all limits; `None` before there is one.
    pub best_total: Option<f64>,
    /// The best design so far, where it is a new one.
    pub new_best: Option<Box<Design>>,
}

/// A point of the curve of progress: the best design so far was found with this many designs appraised.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProgressPoint {
    /// The number of designs that had been appraised.
    pub appraised: usize,
    /// The total of the best.
    pub total: f64,
}

/// The result of a search.
#[derive(Debug, Clone, PartialEq)]
pub struct SearchOutcome {
    /// The best design, in the material of the given design; that design itself where no better one was found.
    pub design: Design,
    /// Its appraisal.
    pub best: Appraisal,
    /// True where it keeps all limits; false only where no design was found that does.
    pub keeps_limits: bool,
    /// The values of the numbers that changed, in the order of the numbers of the objective.
    pub values: Vec<f64>,
    /// The totals of the best designs in the order in which they were found.
    pub curve: Vec<ProgressPoint>,
    /// The number of designs that were appraised.
    pub appraised: usize,
    /// True where the search was stopped before its end.
    pub was_stopped: bool,
    /// The audits of the design before the search and of the found design.
    pub audits: [Audit; 2],
}

impl SearchOutcome {
    /// Returns the kinds of findings of the audits, each with its number before and after, without kinds that neither has.
    pub fn findings(&self) -> Vec<(FindingKind, [usize; 2])> {
        let count = |kind| self.audits.each_ref().map(|audit| audit.of_kind(kind).count());
        let counted = FindingKind::ALL.into_iter().map(|kind| (kind, count(kind)));
        counted.filter(|(_, counts)| *counts != [0, 0]).collect()
    }
}
