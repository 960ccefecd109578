//! The corners of a finished stone that a tier can be moved to, and the meet that says so.

use super::super::tiers::{Tier, Tiers};
use super::corner_fault::CornerFault;
use super::found::{NAMES, PASSES};
use super::meet::{Meet, MeetPoint};
use super::names::TierNames;
use super::reach::REACHABLE;
use super::solve::{Bench, TierOutcome, cutting_order};
use super::stone::{StoneCorner, StoneSide};
use brillianteer_math::Plane;
use glam::DVec3;

/// The most corners that are tried for the same names.
const MOST_REACHED: usize = 8;

/// The most meets that are followed through the whole design before a corner counts as one to which no meet leads.
pub(super) const MOST_FOLLOWED: usize = 12;

/// A corner of the stone to which a facet of a tier can be cut.
#[derive(Debug, Clone, PartialEq)]
pub struct TierCorner {
    /// The place of the corner, in the design's unit.
    pub at: DVec3,
    /// The distance of the tier whose facet passes through the corner, in the design's unit and without a sign.
    pub distance: f64,
    /// The place of that facet in its tier, from 0.
    pub facet: usize,
    /// The outward normals of the planes that meet at the corner.
    pub normals: Vec<DVec3>,
    /// The places of these planes on the bench, without those of the tier.
    pub(super) planes: Vec<usize>,
}

impl Tiers {
    /// Returns the corners to which the tier at a place can be cut, for each of its facets in the order in which the facet
    /// reaches them as it is cut deeper; none for a place past the last tier, and where the tier has no facets.
    ///
    /// They are corners of the stone of all tiers that do not follow this one by a meet, at the numbers that the design has. While
    /// the tier moves they stay. Those across the girdle are left out: cut to one, the tier would take the girdle away.
    pub fn tier_corners(&self, place: usize) -> Vec<TierCorner> {
        let Some(tier) = self.tiers.get(place) else { return vec![] };
        let bench = self.bench_without(place);
        let planes = bench.planes(tier, tier.angle);
        let of_facet = |facet: usize| {
            let normal = planes[facet].normal;
            let side = StoneSide::of(normal);
            let reached = bench.reached_corners(&planes, facet, |corner| !bench.is_across(corner, side));
            let distance = move |at: DVec3| normal.dot(at);
            let ahead = reached.into_iter().filter(move |corner| distance(corner.at) >= 0.0);
            ahead.map(|corner| bench.tier_corner(corner, &planes, facet)).collect::<Vec<_>>()
        };
        (0..planes.len()).flat_map(of_facet).collect()
    }

    /// Returns all corners of the stone of all tiers that do not follow the tier at a place by a meet, for a pick of `count` of
    /// them, 1 to 3. Each has the facet of the tier whose direction it lies farthest out in, and the fault that keeps the tier
    /// from it, if one is known before other corners are picked. None for a place past the last tier, and where the tier has no
    /// facets.
    pub fn corners_to_pick(&self, place: usize, count: usize) -> Vec<(TierCorner, Option<CornerFault>)> {
        let Some(tier) = self.tiers.get(place) else { return vec![] };
        let bench = self.bench_without(place);
        let planes = bench.planes(tier, tier.angle);
        let (stone, zone) = (bench.stone(), tier.zone());
        let supports: Vec<f64> = planes.iter().map(|plane| stone.support(plane.normal)).collect();
        let all = stone.corners().iter().filter_map(|corner| {
            let depth = |facet: &usize| planes[*facet].normal.dot(corner.at);
            let facet = (0..planes.len()).max_by(|a, b| depth(a).total_cmp(&depth(b)))?;
            let touches = depth(&facet) >= supports[facet] - REACHABLE * stone.scale();
            let fault = if bench.is_across(corner, StoneSide::of(planes[facet].normal)) {
                Some(CornerFault::Across { zone })
            } else if depth(&facet) <= 0.0 {
                Some(CornerFault::Behind)
            } else if count <= 1 && touches {
                Some(CornerFault::Touches)
            } else {
                None
            };
            Some((bench.tier_corner(corner, &planes, facet), fault))
        });
        all.collect()
    }

    /// Returns the meet that cuts the tier at a place to one of its [corners](Self::tier_corners), or why no meet gives it this
    /// distance once all are followed.
    ///
    /// A corner on the axis is the centre point, and the level girdle is named where the tier lies beside the girdle. For other
    /// corners the meet lists the tiers that meet there.
    pub fn meet_at(&self, place: usize, corner: &TierCorner) -> Result<Meet, CornerFault> {
        let own = self.tiers.get(place).ok_or(CornerFault::NoFacets)?;
        let distance = corner.distance.copysign(own.distance);
        let tier = Tier { distance, meet: None, is_cut: true, ..own.clone() };
        let bench = self.bench_without(place);
        let mut meets: Vec<Meet> = bench.simple(place, &tier).into_iter().collect();
        let lists: Vec<Vec<String>> =
            NAMES.flat_map(|count| bench.lists(place, &corner.planes, count)).collect();
        meets.extend(lists.iter().map(|names| Meet::Points(vec![MeetPoint::Corner(names.clone())])));
        let later = |reached| {
            let meet = |names: &Vec<String>| MeetPoint::LaterCorner { names: names.clone(), reached };
            lists.iter().map(meet).map(|point| Meet::Points(vec![point])).collect::<Vec<_>>()
        };
        meets.extend((2..=MOST_REACHED).flat_map(later));
        let given: Vec<Meet> =
            meets.into_iter().filter(|meet| bench.gives(place, &tier, meet)).take(MOST_FOLLOWED).collect();
        let fault =
            if given.is_empty() { CornerFault::NoName { number: 0 } } else { CornerFault::CutAtOtherPlace };
        given.into_iter().find(|meet| self.leads_to(place, &tier, meet)).ok_or(fault)
    }

    /// Returns the next corner at another depth that the first facet of a tier can be cut to, deeper or less deep than it is now,
    /// with the meet that says so; `None` where no corner follows to which a meet leads.
    pub fn next_meet(&self, place: usize, is_deeper: bool) -> Option<Meet> {
        let now = self.tiers.get(place)?.distance.abs();
        let scale = Bench::of(self).stone().scale();
        let corners = self.tier_corners(place).into_iter().filter(|corner| corner.facet == 0);
        let beyond = |corner: &TierCorner| {
            if is_deeper {
                now - corner.distance > PASSES * scale
            } else {
                corner.distance - now > PASSES * scale
            }
        };
        let mut next: Vec<TierCorner> = corners.filter(beyond).collect();
        let apart = |corner: &TierCorner| (corner.distance - now).abs();
        next.sort_by(|a, b| apart(a).total_cmp(&apart(b)));
        next.iter().find_map(|corner| self.meet_at(place, corner).ok())
    }

    /// Returns whether a tier has its distance by a meet once all meets of the design are followed.
    fn leads_to(&self, place: usize, tier: &Tier, meet: &Meet) -> bool {
        let mut design = self.clone();
        design.tiers[place] = Tier { meet: Some(meet.clone()), ..tier.clone() };
        let scale = Bench::of(self).stone().scale();
        let solved = design.solved();
        solved.outcomes[place] == TierOutcome::Solved
            && (solved.tiers.tiers[place].distance - tier.distance).abs() <= PASSES * scale
    }

    /// Returns a bench on which all tiers are cut but the one at a place and those that follow it.
    pub(super) fn bench_without(&self, place: usize) -> Bench<'_> {
        let follows = self.followers(place);
        let mut bench = Bench::of(self);
        for other in cutting_order(self) {
            if self.tiers[other].is_cut && !follows[other] {
                bench.cut(other, &self.tiers[other]);
            }
        }
        bench
    }

    /// Returns for each tier whether it moves with the one at a place: that tier itself, those whose meets name it or are solved
    /// on the stone that it shapes, and those that follow these.
    fn followers(&self, place: usize) -> Vec<bool> {
        let names = TierNames::of(self);
        let mut follows = vec![false; self.tiers.len()];
        // A tier is cut after those that it names.
        for other in cutting_order(self) {
            follows[other] = other == place
                || match &self.tiers[other].meet {
                    Some(Meet::Points(points)) => points.iter().any(|point| match point.named() {
                        Some((named, _)) => {
                            let meant = |name: &String| names.meant(name, other);
                            named.iter().flat_map(meant).any(|tier| follows[tier])
                        }
                        None => follows.contains(&true),
                    }),
                    Some(Meet::CentreAngle(_)) => follows.contains(&true),
                    Some(Meet::Given(_)) | None => false,
                };
        }
        follows
    }
}

impl Bench<'_> {
    /// Returns whether a corner lies across the girdle from a side: only facets that lean to the other side meet there.
    fn is_across(&self, corner: &StoneCorner, side: Option<StoneSide>) -> bool {
        let side_of = |&plane: &usize| StoneSide::of(self.stone().plane(plane).plane.normal);
        side.is_some()
            && corner.planes.iter().all(|plane| side_of(plane).is_some_and(|other| Some(other) != side))
    }

    /// Returns a corner as one of a facet of a tier; `planes` are those of the tier.
    fn tier_corner(&self, corner: &StoneCorner, planes: &[Plane], facet: usize) -> TierCorner {
        let normals = corner.planes.iter().map(|&plane| self.stone().plane(plane).plane.normal).collect();
        let distance = planes[facet].normal.dot(corner.at);
        TierCorner { at: corner.at, distance, facet, normals, planes: corner.planes.clone() }
    }
}
