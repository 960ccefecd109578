//! Finds girdles whose edges do not run level from meet to meet.

use super::corners::{Corner, Corners};
use super::finding::{Finding, FindingKind, FindingUnit};
use super::subject::Subject;
use crate::TierZone;

/// Meets on one edge of the girdle whose heights differ by more than this, in percent of the width, are uneven.
pub const UNEVEN_GIRDLE: f64 = 0.5;

/// Returns a finding for each edge of the girdle whose meets lie at different heights.
///
/// A meet is a corner where at least two facets of one side reach a girdle facet. Between meets an edge may dip, as it does
/// in every round brilliant. Stones without girdle facets have no such edges.
pub(super) fn uneven(subject: &Subject, corners: &Corners) -> Vec<Finding> {
    [TierZone::Crown, TierZone::Pavilion]
        .into_iter()
        .filter_map(|side| uneven_edge(subject, corners, side))
        .collect()
}

/// Returns a finding where the meets of one edge lie at different heights.
fn uneven_edge(subject: &Subject, corners: &Corners, side: TierZone) -> Option<Finding> {
    let is_meet = |corner: &&Corner| {
        let of = |zone| corner.facets.iter().filter(|&&facet| subject.zones[facet] == zone).count();
        of(TierZone::Girdle) > 0 && of(side) > 1
    };
    let by_height = |a: &&Corner, b: &&Corner| a.at.z.total_cmp(&b.at.z);
    let meets = || corners.all.iter().filter(is_meet);
    let (low, high) = (meets().min_by(by_height)?, meets().max_by(by_height)?);
    let size = subject.percent(high.at.z - low.at.z);
    let mut facets = [low.facets.as_slice(), &high.facets].concat();
    facets.sort_unstable();
    facets.dedup();
    (size > UNEVEN_GIRDLE).then(|| Finding {
        kind: FindingKind::UnevenGirdle,
        points: vec![low.at, high.at],
        facets: subject.names(&facets),
        size,
        threshold: UNEVEN_GIRDLE,
        unit: FindingUnit::PercentOfWidth,
    })
}
