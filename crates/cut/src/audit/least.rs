//! The smallest facet and the shortest edge of a stone, by which one sees how near it is to losing one.

use super::corners::Corners;
use super::facets::relative_areas;
use super::subject::{AuditSubject, Subject};
use brillianteer_math::Polytope;

/// The smallest facet and the shortest edge of a stone, in percent; infinite where there are none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SmallestParts {
    /// The area of the smallest facet of crown, girdle and pavilion, in percent of the median area of the facets of its zone.
    pub facet_percent: f64,
    /// The length of the shortest edge, in percent of the stone's width. Corners nearer than [`SAME_CORNER`](super::SAME_CORNER)
    /// are one, and edges between two facets of the girdle do not count, since they are as long as the girdle is thick.
    pub edge_percent: f64,
}

impl SmallestParts {
    /// Finds the smallest parts of a convex stone.
    pub fn of(stone: &Polytope) -> Self {
        let given = AuditSubject { stone, names: &[], planes: &[], tiers: None, critical_deg: None };
        let subject = Subject::new(&given);
        let facets = relative_areas(&subject).into_iter().map(|(_, percent)| percent);
        let edges = Corners::of(&subject).edges_beside_girdle(&subject);
        Self {
            facet_percent: facets.fold(f64::INFINITY, f64::min),
            edge_percent: subject.percent(edges.into_iter().fold(f64::INFINITY, f64::min)),
        }
    }
}
