//! The audit of the stone in sight: its findings, and the selected one.

use brillianteer_cut::{Audit, Finding};
use brillianteer_picture::DrawnMarks;
use brillianteer_scene::{Specimen, Stone};
use std::sync::Arc;

/// The audit of the present stone. It is made in the background, once for each stone.
#[derive(Debug, Clone, Default)]
pub struct SessionAudit {
    /// The stone whose audit was requested last.
    asked: Option<Arc<Specimen>>,
    /// The findings in the stone that was audited last; `None` before the first answer.
    pub found: Option<Audit>,
    /// The place in the list of the finding that is selected.
    pub selected: Option<usize>,
}

impl SessionAudit {
    /// Requests the audit of a stone; returns whether it is another stone than before, so that an audit has to be
    /// started.
    pub fn want(&mut self, specimen: &Arc<Specimen>) -> bool {
        let is_known = self.asked.as_ref().is_some_and(|asked| Arc::ptr_eq(asked, specimen));
        if !is_known {
            self.asked = Some(Arc::clone(specimen));
        }
        !is_known
    }

    /// Takes the audit of a stone, if it answers the last request. The selection stays on the finding of the same
    /// kind about the same facets, or ends where there is none.
    pub fn take(&mut self, specimen: &Arc<Specimen>, found: Audit) {
        if !self.asked.as_ref().is_some_and(|asked| Arc::ptr_eq(asked, specimen)) {
            return;
        }
        let is_same = |a: &Finding, b: &Finding| a.kind == b.kind && a.facets == b.facets;
        self.selected = self
            .selected_finding()
            .and_then(|selected| found.findings.iter().position(|finding| is_same(finding, selected)));
        self.found = Some(found);
    }

    /// Returns the finding that is selected.
    pub fn selected_finding(&self) -> Option<&Finding> {
        self.found.as_ref()?.findings.get(self.selected?)
    }
}

/// Returns the places of the facets that a finding is about, by their names.
pub fn finding_facets(stone: &Stone, finding: &Finding) -> Vec<usize> {
    DrawnMarks::of(stone, [finding]).facets
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::document::Document;
    use brillianteer_cut::{FindingKind, FindingUnit};

    fn finding(facet: &str) -> Finding {
        Finding {
            kind: FindingKind::ThinFacet,
            points: vec![],
            facets: vec![facet.to_owned()],
            size: 0.5,
            threshold: 1.0,
            unit: FindingUnit::PercentOfWidth,
        }
    }

    #[test]
    fn a_stone_is_audited_once_and_an_answer_about_another_is_dropped() {
        let of = |name| Arc::clone(Document::of_library(name).unwrap().specimen());
        let (first, second) = (of("tolkowsky"), of("modern-ideal"));
        let mut audit = SessionAudit::default();
        assert!(audit.want(&first) && !audit.want(&first) && audit.want(&second));
        audit.take(&first, Audit { findings: vec![finding("table")] });
        assert_eq!(audit.found, None);
        audit.take(&second, Audit { findings: vec![finding("table")] });
        assert_eq!(audit.found.as_ref().unwrap().findings.len(), 1);
    }

    #[test]
    fn the_selection_stays_with_its_finding_and_ends_with_it() {
        let specimen = Arc::clone(Document::first().unwrap().specimen());
        let mut audit = SessionAudit::default();
        audit.want(&specimen);
        audit.take(&specimen, Audit { findings: vec![finding("table"), finding("bezel 1")] });
        audit.selected = Some(1);
        let Ok(stone) = specimen.stone() else { panic!() };
        let [place] = finding_facets(stone, audit.selected_finding().unwrap())[..] else { panic!() };
        assert_eq!(stone.names()[place], "bezel 1");
        audit.take(&specimen, Audit { findings: vec![finding("bezel 1")] });
        assert_eq!(audit.selected, Some(0));
        audit.take(&specimen, Audit::default());
        assert_eq!((audit.selected, audit.selected_finding()), (None, None));
    }
}
