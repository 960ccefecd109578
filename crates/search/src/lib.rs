//! Finds better designs. A [`Goal`] states as plain data the measures to raise or lower, the numbers of a
//! design that may change, and the limits; an [`Objective`] appraises a design by it, with derivatives where the
//! light has them; a [`DesignSearch`] scatters designs over all ranges, and then climbs from the best.

// A test may list as many cases as it has.
#![cfg_attr(test, allow(clippy::too_many_lines))]

mod appraisal;
mod changes;
mod goal;
mod kept_corners;
mod kept_shape;
mod limits;
mod local;
mod numbers;
mod objective;
mod others;
mod outcome;
mod run;
mod summary;
mod terms;

#[cfg(test)]
mod tests;

pub use appraisal::{Appraisal, GoalValue, SearchError};
pub use changes::{ChangeGroup, MeasureChange};
pub use goal::{AtLeastAtMost, Goal, GoalFault, GoalMaterial, GoalMeasure, OneOrMore};
pub use limits::LIMIT_NAMES;
pub use numbers::VariedNumber;
pub use objective::Objective;
pub use others::{OtherMeasure, estimated_classes};
pub use outcome::{ProgressPoint, SearchOutcome, SearchProgress};
pub use run::{DesignSearch, SearchOptions};
pub use summary::{
    AuditChange, BeforeAndAfter, KindChange, LimitedFigure, SearchSummary, SearchedNumber, UnweighedMeasure,
    WeighedMeasure,
};
