//! Findings about single facets and tiers: small and thin ones, pavilion tiers below the critical angle, unused planes.

use super::finding::{Finding, FindingKind, FindingUnit};
use super::subject::Subject;
use crate::{TierZone, tier_stem};
use brillianteer_math::grouped;

/// A facet smaller than this, in percent of the median area of the facets of its zone, is small.
pub const SMALL_FACET: f64 = 15.0;

/// A facet of crown or pavilion whose least width is below this, in percent of the stone's width, is thin.
pub const THIN_FACET: f64 = 1.0;

/// Angles nearer to the critical angle than this, degrees, do not count as below it: the last digit of cutters'
/// files.
const ROUNDING_DEG: f64 = 1e-3;

/// Returns the area of each facet of crown, girdle and pavilion in percent of the median area of its zone. Table and culet
/// have no others beside them.
pub(super) fn relative_areas(subject: &Subject) -> Vec<(usize, f64)> {
    let areas: Vec<f64> =
        subject.facets().iter().map(|facet| subject.given.stone.facet_area(facet)).collect();
    let zones = [TierZone::Crown, TierZone::Girdle, TierZone::Pavilion];
    let of_zone = |zone| {
        let facets: Vec<usize> = (0..areas.len()).filter(|&facet| subject.zones[facet] == zone).collect();
        let median = median(facets.iter().map(|&facet| areas[facet]).collect());
        facets.into_iter().map(|facet| (facet, 100.0 * areas[facet] / median)).collect::<Vec<_>>()
    };
    zones.into_iter().flat_map(of_zone).collect()
}

/// Returns the small facets, each beside the facets of its zone.
pub(super) fn small(subject: &Subject) -> Vec<Finding> {
    let finding = |(facet, size)| Finding {
        kind: FindingKind::SmallFacet,
        points: vec![subject.middle(facet)],
        facets: subject.names(&[facet]),
        size,
        threshold: SMALL_FACET,
        unit: FindingUnit::PercentOfMedianArea,
    };
    let small = relative_areas(subject).into_iter().filter(|(_, size)| *size < SMALL_FACET);
    small.map(finding).collect()
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

/// Returns the thin facets of crown and pavilion. Girdles are thin by nature.
pub(super) fn thin(subject: &Subject) -> Vec<Finding> {
    let leaning = (0..subject.facets().len())
        .filter(|&facet| matches!(subject.zones[facet], TierZone::Crown | TierZone::Pavilion));
    let least_width = |facet: usize| subject.given.stone.facet_width(&subject.facets()[facet]);
    let sized = leaning.map(|facet| (facet, subject.percent(least_width(facet))));
    let finding = |(facet, size)| Finding {
        kind: FindingKind::ThinFacet,
        points: vec![subject.middle(facet)],
        facets: subject.names(&[facet]),
        size,
        threshold: THIN_FACET,
        unit: FindingUnit::PercentOfWidth,
    };
    sized.filter(|(_, size)| *size < THIN_FACET).map(finding).collect()
}

/// Returns the tiers of the pavilion that lie flatter than the critical angle, each with the angle of its flattest facet.
pub(super) fn below_critical(subject: &Subject) -> Vec<Finding> {
    let Some(critical) = subject.given.critical_deg else { return vec![] };
    let slope = |facet: usize| {
        let normal = subject.facets()[facet].plane.normal;
        normal.truncate().length().atan2(-normal.z).to_degrees()
    };
    let flat = (0..subject.facets().len()).filter(|&facet| {
        subject.zones[facet] == TierZone::Pavilion && slope(facet) < critical - ROUNDING_DEG
    });
    let finding = |tier: Vec<usize>| Finding {
        kind: FindingKind::BelowCritical,
        points: tier.iter().map(|&facet| subject.middle(facet)).collect(),
        facets: subject.names(&tier),
        size: tier.iter().map(|&facet| slope(facet)).fold(f64::INFINITY, f64::min),
        threshold: critical,
        unit: FindingUnit::Degrees,
    };
    grouped(flat, |&a, &b| subject.tier(a) == subject.tier(b)).into_iter().map(finding).collect()
}

/// Returns the planes that never touch the stone, by tiers.
pub(super) fn unused(subject: &Subject) -> Vec<Finding> {
    let planes = subject.given.planes;
    // Planes beyond those of the design are the faces of the block that closes an open stone.
    let of_design = |place: &&usize| planes.is_empty() || **place < planes.len();
    let name = |&place: &usize| match planes.get(place) {
        Some(name) => name.clone(),
        None => format!("plane {}", place + 1),
    };
    let names = subject.given.stone.redundant().iter().filter(of_design).map(name);
    let finding = |facets: Vec<String>| Finding {
        kind: FindingKind::UnusedPlane,
        points: vec![],
        size: facets.len() as f64,
        facets,
        threshold: 0.0,
        unit: FindingUnit::Planes,
    };
    grouped(names, |a, b| tier_stem(a) == tier_stem(b)).into_iter().map(finding).collect()
}
