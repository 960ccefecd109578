//! Tests of the corners that a tier can be moved to, on a brilliant that is cut by meets.

use super::super::tier_change::TierChange;
use super::super::tiers::{TierZone, Tiers};
use super::tests::{assert_near, brilliant};
use super::*;

/// The tolerance of meets, in lengths of the largest distance: how near a tier passes to a point that its meet finds.
const NEAR: f64 = 2e-5;

/// Returns the distance from a corner of the facet that is cut to it.
fn miss(tiers: &Tiers, place: usize, corner: &TierCorner) -> f64 {
    let tier = &tiers.tiers[place];
    tiers.plane(tier, tier.facets[corner.facet].index).distance(corner.at).abs()
}

#[test]
fn a_tier_that_meets_a_corner_has_it_among_its_corners_with_its_own_meet() {
    let design = brilliant();
    for (name, own) in [("2", "11G1G1"), ("B", "AAG1G1"), ("T", "BBCC")] {
        let place = design.tiers.iter().position(|tier| tier.name() == name).unwrap();
        let corners = design.tier_corners(place);
        let now: Vec<&TierCorner> =
            corners.iter().filter(|corner| miss(&design, place, corner) < NEAR).collect();
        assert!(now.len() >= design.tiers[place].facets.len(), "{name}: {}", now.len());
        for corner in now {
            assert_near(&[corner.distance], &[design.tiers[place].distance]);
            let meet =
                design.meet_at(place, corner).map_or_else(|fault| fault.to_string(), |meet| meet.to_string());
            let named = meet.strip_prefix("Meet ").unwrap_or_default();
            assert!(named.split('-').count() >= 3, "{name}: {meet}");
            for other in named.split('-') {
                assert!(own.contains(other), "{name}: {meet}");
            }
        }
    }
}

#[test]
fn a_meet_at_a_corner_takes_the_tier_there_and_the_corner_stays() {
    let design = brilliant();
    let mut reached = 0;
    for place in 0..design.tiers.len() {
        let corners = design.tier_corners(place);
        for corner in corners.iter().filter(|corner| corner.facet == 0) {
            let Ok(meet) = design.meet_at(place, corner) else { continue };
            let moved = design.changed(TierChange::Meet(place, Some(meet))).tiers;
            let off = miss(&moved, place, corner);
            assert!(off < NEAR, "{}: {off}", design.tiers[place].name());
            let stays = moved.tier_corners(place).iter().any(|other| other.at.distance(corner.at) < NEAR);
            assert!(stays, "the corners of a tier move with it");
            reached += 1;
        }
    }
    assert!(reached >= 12, "{reached} corners are reached by meets");
}

#[test]
fn the_next_meet_is_deeper_or_farther_out_and_leads_back() {
    let design = brilliant();
    let place = design.tiers.iter().position(|tier| tier.name() == "B").unwrap();
    let distance = |tiers: &Tiers| tiers.tiers[place].distance;
    let deeper = design.next_meet(place, true).unwrap();
    let moved = design.changed(TierChange::Meet(place, Some(deeper))).tiers;
    assert!(distance(&moved) < distance(&design) - NEAR);
    let back = moved.next_meet(place, false).unwrap();
    let back = moved.changed(TierChange::Meet(place, Some(back))).tiers;
    assert!((distance(&back) - distance(&design)).abs() < NEAR, "{} {}", distance(&back), distance(&design));
    assert_eq!(design.next_meet(99, true), None);
    assert_eq!(design.tier_corners(99), []);
}

#[test]
fn a_tier_is_cut_to_corners_on_its_side_or_at_the_girdle_only() {
    let design = brilliant();
    for (place, tier) in design.tiers.iter().enumerate().filter(|(_, tier)| tier.angle.abs() < 90.0) {
        let side = if matches!(tier.zone(), TierZone::Crown | TierZone::Table) { 1.0 } else { -1.0 };
        let is_across = |corner: &TierCorner| corner.normals.iter().all(|normal| normal.z * side < 0.0);
        let offered = design.tier_corners(place);
        assert!(!offered.is_empty() && !offered.iter().any(is_across), "{}", tier.name());
        let (mut across, mut own) = (0, 0);
        for (corner, fault) in design.corners_to_pick(place, 1) {
            assert_eq!(is_across(&corner), fault == Some(CornerFault::Across { zone: tier.zone() }));
            across += usize::from(is_across(&corner));
            let is_offered = offered.iter().any(|other| other.at == corner.at);
            assert_eq!(fault.is_none(), is_offered, "{}: {corner:?} {fault:?}", tier.name());
            own += usize::from(is_offered);
        }
        assert!(across > 0 && own > 0, "{}: {across} {own}", tier.name());
    }
}
