//! An audit of a stone: a list of places that may not be what its designer meant.
//!
//! Findings are candidates, never verdicts: a short edge may be intended, and so may a tier below the critical angle.
//! Lengths are measured by W, the width of the stone's outline, so that an audit does not depend on the stone's unit.
//! The thresholds are those that the audit of OpenGemCutting publishes (same corner 0.1 % of W, near miss 1 %, split
//! meet 12 %, small facet 15 % of the median area); those of thin facets, uneven girdles and symmetry are this
//! program's own.

mod corners;
mod facets;
mod finding;
mod girdle;
mod least;
mod subject;
mod symmetry;

pub use corners::{NEAR_MISS, SAME_CORNER, SPLIT_MEET};
pub use facets::{SMALL_FACET, THIN_FACET};
pub use finding::{Finding, FindingKind, FindingUnit};
pub use girdle::UNEVEN_GIRDLE;
pub use least::SmallestParts;
pub use subject::AuditSubject;
pub use symmetry::{MOST_KEEP, OFF_SYMMETRY};

use corners::Corners;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use subject::Subject;

/// The result of an audit.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Audit {
    /// The findings, in the order of [`FindingKind::ALL`]; those of one kind with the smallest size first.
    pub findings: Vec<Finding>,
}

impl Audit {
    /// Audits a convex stone.
    pub fn of(given: &AuditSubject) -> Self {
        let subject = Subject::new(given);
        let corners = Corners::of(&subject);
        let mut findings = corners.findings(&subject);
        findings.extend(facets::small(&subject));
        findings.extend(facets::thin(&subject));
        findings.extend(facets::below_critical(&subject));
        findings.extend(girdle::uneven(&subject, &corners));
        findings.extend(symmetry::departures(&subject));
        findings.extend(facets::unused(&subject));
        findings.sort_by(|a, b| a.kind.cmp(&b.kind).then(a.size.total_cmp(&b.size)));
        Self { findings }
    }

    /// Returns the findings of one kind.
    pub fn of_kind(&self, kind: FindingKind) -> impl Iterator<Item = &Finding> {
        self.findings.iter().filter(move |finding| finding.kind == kind)
    }
}

/// The result of an audit with its counts, as programs read it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CountedAudit {
    /// The number of findings of each kind, also of those without any, by its [key](FindingKind::key) and sorted by it.
    pub counts: BTreeMap<String, usize>,
    /// The findings, as in [`Audit`].
    pub findings: Vec<Finding>,
}

impl From<Audit> for CountedAudit {
    fn from(audit: Audit) -> Self {
        let count = |kind: FindingKind| (kind.key().to_owned(), audit.of_kind(kind).count());
        Self { counts: FindingKind::ALL.map(count).into(), findings: audit.findings }
    }
}

#[cfg(test)]
mod tests;
