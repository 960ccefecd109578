//! What a search has found, and how far it is.

use super::appraisal::Appraisal;
use crate::cut::Design;

/// How far a search is. It is handed out for each design that was appraised. The threads of a search hand theirs out as they come, so
/// that one with a smaller number may follow.
#[derive(Debug, Clone, PartialEq)]
pub struct SearchProgress {
    /// The number of designs that were appraised.
    pub appraised: usize,
    /// The part of the work that is surely done, 0 to 1; a search that settles early jumps to 1.
    pub part: f64,
    /// The total of the best design so far, which keeps all limits; `None` before there is one.
    pub best_total: Option<f64>,
    /// The best design so far, where it is a new one.
    pub new_best: Option<Box<Design>>,
}

/// A point of the curve of progress: the best was found with this many designs appraised.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProgressPoint {
    /// The number of designs that had been appraised.
    pub appraised: usize,
    /// The total of the best.
    pub total: f64,
}

/// What a search has found.
#[derive(Debug, Clone, PartialEq)]
pub struct SearchOutcome {
    /// The best design, in the material of the design that was given; that design itself where nothing better was found.
    pub design: Design,
    /// Its appraisal.
    pub best: Appraisal,
    /// Whether it keeps all limits; false only where no design was found that does.
    pub keeps_limits: bool,
    /// The values of the numbers that changed, in the order of the numbers of the objective.
    pub values: Vec<f64>,
    /// The totals of the best designs in the order in which they were found.
    pub curve: Vec<ProgressPoint>,
    /// The number of designs that were appraised.
    pub appraised: usize,
    /// Whether the search was stopped before its end.
    pub was_stopped: bool,
}
