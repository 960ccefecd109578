//! Finds the meet that leads a tier through two or three picked corners. Two corners give the tier's angle, and three
//! give its index too.

use super::super::tiers::{Tier, Tiers};
use super::corner_fault::CornerFault;
use super::corners::{MOST_FOLLOWED, TierCorner};
use super::fault::MeetFault;
use super::found::{NAMES, PASSES};
use super::meet::{Meet, MeetPoint};
use super::solve::{Bench, TierOutcome};
use crate::facet_zones::EXACT;
use brillianteer_math::Plane;
use glam::DVec3;

/// The most corners that are tried for the same names.
const MOST_REACHED: usize = 8;

/// The most names of a corner that are tried together with those of the others.
const MOST_WAYS: usize = 4;

/// The most facets of the tier that are tried; they are those that face the corners.
const MOST_FACETS: usize = 4;

/// The largest distance between a picked corner and the corner to which names lead, in lengths of the largest
/// distance, at which both count as one.
const SAME_CORNER: f64 = 1e-9;

impl Tiers {
    /// Returns the meet that leads a facet of the tier at a place through two or three of the [corners that can be
    /// picked](Self::corners_to_pick), or why no meet does once all are followed.
    pub fn meet_through(&self, place: usize, corners: &[&TierCorner]) -> Result<Meet, CornerFault> {
        let own = self.tiers.get(place).ok_or(CornerFault::NoFacets)?;
        let bench = self.bench_without(place);
        let tier = Tier { meet: None, is_cut: true, ..own.clone() };
        let planes = bench.planes(&tier, tier.angle);
        let out =
            |facet: &usize| corners.iter().map(|corner| planes[*facet].normal.dot(corner.at)).sum::<f64>();
        let mut facets: Vec<usize> = (0..planes.len()).collect();
        facets.sort_by(|a, b| out(b).total_cmp(&out(a)));
        // The facet on whose side the corners lie says best why they do not go together.
        let mut first = None;
        for facet in facets.into_iter().take(MOST_FACETS) {
            match self.meet_of_facet(&bench, (place, &tier), (facet, &planes), corners) {
                Ok(meet) => return Ok(meet),
                Err(fault) => _ = first.get_or_insert(fault),
            }
        }
        Err(first.unwrap_or(CornerFault::NoFacets))
    }

    /// Returns the meet that leads one facet of a tier through corners; `planes` are those of the tier.
    fn meet_of_facet(
        &self,
        bench: &Bench,
        (place, tier): (usize, &Tier),
        (facet, planes): (usize, &[Plane]),
        corners: &[&TierCorner],
    ) -> Result<Meet, CornerFault> {
        let turned = bench.turned(tier, planes, facet, corners)?;
        let (now, before) = (turned[facet].normal, planes[facet].normal);
        if before.z != 0.0 && now.z * before.z.signum() < EXACT {
            let angle = now.z.abs().clamp(0.0, 1.0).acos().to_degrees();
            return Err(CornerFault::OtherSide { angle, zone: tier.zone(), count: corners.len() });
        }
        let ways: Vec<Vec<MeetPoint>> =
            corners.iter().map(|corner| bench.ways(place, &turned, facet, corner)).collect();
        if let Some(nameless) = ways.iter().position(Vec::is_empty) {
            return Err(CornerFault::NoName { number: nameless + 1 });
        }
        let (mut first, mut given) = (None, vec![]);
        for meet in combined(&ways).into_iter().map(Meet::Points) {
            match bench.follow(place, &mut tier.clone(), &meet) {
                Ok(_) => given.push(meet),
                Err(fault) => _ = first.get_or_insert(CornerFault::from(fault)),
            }
        }
        for meet in given.into_iter().take(MOST_FOLLOWED) {
            match self.passes(place, tier, &meet, (facet, corners)) {
                Ok(()) => return Ok(meet),
                Err(fault) => _ = first.get_or_insert(fault),
            }
        }
        Err(first.unwrap_or(CornerFault::CutAtOtherPlace))
    }

    /// Checks that a facet of a tier passes through corners by a meet once all meets of the design are followed.
    fn passes(
        &self,
        place: usize,
        tier: &Tier,
        meet: &Meet,
        (facet, corners): (usize, &[&TierCorner]),
    ) -> Result<(), CornerFault> {
        let mut design = self.clone();
        design.tiers[place] = Tier { meet: Some(meet.clone()), ..tier.clone() };
        let scale = Bench::of(self).stone().scale();
        let solved = design.solved();
        let tier = &solved.tiers.tiers[place];
        let plane = solved.tiers.plane(tier, tier.facets[facet].index);
        let is_met = |corner: &&TierCorner| plane.distance(corner.at).abs() <= PASSES * scale;
        match &solved.outcomes[place] {
            TierOutcome::Failed(error) => Err(error.fault.clone().into()),
            TierOutcome::Solved if corners.iter().all(is_met) => Ok(()),
            _ => Err(CornerFault::CutAtOtherPlace),
        }
    }
}

impl Bench<'_> {
    /// Returns the planes of a tier at the angle at which one of its facets passes through corners, with that facet at its index.
    fn turned(
        &self,
        tier: &Tier,
        planes: &[Plane],
        facet: usize,
        corners: &[&TierCorner],
    ) -> Result<Vec<Plane>, MeetFault> {
        let places: Vec<DVec3> = corners.iter().map(|corner| corner.at).collect();
        let solution = self.through(tier, facet, planes[facet].normal, &places)?;
        Ok(self.planes_of(tier, facet, &solution))
    }

    /// Returns the first points of meets that mean a corner beside a facet. `planes` are those of the facet's tier.
    fn ways(&self, place: usize, planes: &[Plane], facet: usize, corner: &TierCorner) -> Vec<MeetPoint> {
        let lists: Vec<Vec<String>> =
            NAMES.flat_map(|count| self.lists(place, &corner.planes, count)).collect();
        let first = lists.iter().map(|names| MeetPoint::Corner(names.clone()));
        let later = (2..=MOST_REACHED).flat_map(|reached| {
            lists.iter().map(move |names| MeetPoint::LaterCorner { names: names.clone(), reached })
        });
        let simple = [MeetPoint::Centre { temporary: false }, MeetPoint::GirdlePoint];
        let same = SAME_CORNER * self.stone().scale();
        let is_meant = |point: &MeetPoint| {
            self.point(place, planes, facet, point).is_ok_and(|at| at.distance(corner.at) <= same)
        };
        simple.into_iter().chain(first).chain(later).filter(is_meant).take(MOST_WAYS).collect()
    }
}

/// Returns all ways to take one member of each list.
fn combined(lists: &[Vec<MeetPoint>]) -> Vec<Vec<MeetPoint>> {
    lists.iter().fold(vec![vec![]], |before, list| {
        let longer = |start: &Vec<MeetPoint>| {
            let start = start.clone();
            list.iter().map(move |point| start.iter().cloned().chain([point.clone()]).collect::<Vec<_>>())
        };
        before.iter().flat_map(longer).collect()
    })
}

#[cfg(test)]
mod tests {
    use super::super::super::tier_change::TierChange;
    use super::super::tests::brilliant;
    use super::*;
    use std::ops::Range;

    /// The greatest distance of a tier from a picked point, in lengths of the largest distance.
    const NEAR: f64 = 2e-5;

    /// Returns the corners that the tier at a place can be led through.
    fn beside(design: &Tiers, place: usize) -> Vec<TierCorner> {
        let all = design.corners_to_pick(place, 2).into_iter();
        all.filter(|(_, fault)| fault.is_none()).map(|(corner, _)| corner).collect()
    }

    /// Looks for sets of corners through which meets lead some tiers of a design. Follows up to `most` of them, and returns by how much
    /// each changed the angle and the index of its first facet.
    fn followed(design: &Tiers, places: Range<usize>, count: usize, most: usize) -> Vec<[f64; 2]> {
        let mut changes = vec![];
        for place in places {
            let own = &design.tiers[place];
            if own.facets.is_empty() || !(1.0..89.0).contains(&own.angle.abs()) {
                continue;
            }
            let corners = beside(design, place);
            let beside: Vec<&TierCorner> = corners.iter().filter(|corner| corner.facet == 0).collect();
            for set in combinations(beside.len(), count) {
                let picked: Vec<&TierCorner> = set.iter().map(|&k| beside[k]).collect();
                let Ok(meet) = design.meet_through(place, &picked) else { continue };
                assert!(matches!(&meet, Meet::Points(points) if points.len() == count), "{meet}");
                let moved = design.changed(TierChange::Meet(place, Some(meet))).tiers;
                let tier = &moved.tiers[place];
                let passes = |facet: usize| {
                    let plane = moved.plane(tier, tier.facets[facet].index);
                    picked.iter().all(|corner| plane.distance(corner.at).abs() < NEAR)
                };
                assert!((0..tier.facets.len()).any(passes), "{}: {set:?}", own.name());
                let index = tier.facets[0].index - own.facets[0].index;
                changes.push([tier.angle - own.angle, index]);
                if changes.len() >= most {
                    return changes;
                }
            }
        }
        changes
    }

    /// Returns all sets of `count` numbers below `of`.
    fn combinations(of: usize, count: usize) -> Vec<Vec<usize>> {
        let longer = |set: Vec<usize>| {
            let from = set.last().map_or(0, |last| last + 1);
            (from..of).map(move |next| set.iter().copied().chain([next]).collect())
        };
        (0..count).fold(vec![vec![]], |sets, _| sets.into_iter().flat_map(longer).collect())
    }

    /// Returns the brilliant with distances in the place of its meets, so that no tier follows another.
    fn free_brilliant() -> Tiers {
        let mut design = brilliant();
        design.tiers.iter_mut().for_each(|tier| tier.meet = None);
        design
    }

    #[test]
    fn a_tier_passes_through_two_corners_that_are_picked_at_an_angle_that_follows() {
        let design = free_brilliant();
        let changes = followed(&design, 0..design.tiers.len(), 2, 12);
        assert!(changes.len() >= 4, "{changes:?}");
        assert!(changes.iter().any(|[angle, _]| angle.abs() > 0.1), "{changes:?}");
        assert!(changes.iter().all(|[_, index]| *index == 0.0), "two corners keep the index: {changes:?}");
    }

    #[test]
    fn a_tier_passes_through_three_corners_at_an_angle_and_an_index_that_follow() {
        let design = free_brilliant();
        // A tier that was turned away is led back by three corners in which it met others.
        let led_back = (0..design.tiers.len()).find_map(|place| {
            let mut turned = design.clone();
            turned.tiers[place].angle *= 0.98;
            let changes = followed(&turned, place..place + 1, 3, 40);
            changes.into_iter().find(|[angle, _]| angle.abs() > 0.1)
        });
        assert!(led_back.is_some());
    }

    #[test]
    fn corners_in_one_line_and_tiers_that_are_not_there_have_no_meet() {
        let design = brilliant();
        let tier = design.tiers.iter().position(|tier| tier.name() == "A").unwrap();
        let corners = beside(&design, tier);
        assert!(!corners.is_empty() && corners.iter().all(|corner| corner.distance > 0.0));
        let one = &corners[0];
        assert_eq!(design.meet_through(tier, &[one, one, one]), Err(CornerFault::OneLine));
        assert!(beside(&design, 99).is_empty());
        assert_eq!(design.meet_through(99, &[one, one]), Err(CornerFault::NoFacets));
    }

    #[test]
    fn corners_that_do_not_go_together_have_a_reason_and_no_tier_leaves_its_side() {
        let design = free_brilliant();
        let mut kinds = std::collections::BTreeSet::new();
        for (place, own) in design.tiers.iter().enumerate() {
            let corners = beside(&design, place);
            let of_first: Vec<&TierCorner> = corners.iter().filter(|corner| corner.facet == 0).collect();
            for pair in combinations(of_first.len(), 2) {
                let picked: Vec<&TierCorner> = pair.iter().map(|&k| of_first[k]).collect();
                match design.meet_through(place, &picked) {
                    Ok(meet) => {
                        let moved = design.changed(TierChange::Meet(place, Some(meet))).tiers;
                        let up = |tier: &Tier| design.plane(tier, 0.0).normal.z.signum();
                        let is_upright = own.angle.abs() == 90.0;
                        assert!(is_upright || up(&moved.tiers[place]) == up(own), "{}", own.name());
                    }
                    Err(fault) => {
                        let said = fault.to_string();
                        assert!(said.len() > 20, "{fault:?}: {said}");
                        kinds.insert(said.split(' ').take(3).collect::<Vec<_>>().join(" "));
                    }
                }
            }
        }
        assert!(kinds.len() >= 2, "{kinds:?}");
    }
}
