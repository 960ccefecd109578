//! Finds the corners of the stone so far to which a facet can be cut, and the order in which it reaches them.

use super::super::tiers::Tier;
use super::meet::Meet;
use super::solve::{Bench, SAME_DEPTH};
use super::stone::{StoneCorner, StoneSide};
use brillianteer_math::Plane;
use glam::DVec3;

/// A corner this much below the highest, in lengths of the largest distance, is one that a facet can be cut to.
pub(super) const REACHABLE: f64 = 1e-6;

impl Bench<'_> {
    /// Returns whether two upright facets meet at a corner on a side.
    pub fn is_girdle_corner(&self, corner: &StoneCorner, side: Option<StoneSide>) -> bool {
        let sides =
            || corner.planes.iter().map(|&plane| StoneSide::of(self.stone().plane(plane).plane.normal));
        sides().filter(Option::is_none).count() >= 2 && (side.is_none() || sides().any(|other| other == side))
    }

    /// Returns whether facets of all these tiers meet at a corner, with a different facet for each.
    pub fn is_corner_of(&self, corner: &StoneCorner, meant: &[Vec<usize>]) -> bool {
        let mut is_taken = vec![false; corner.planes.len()];
        meant.iter().all(|tiers| {
            let free =
                corner.planes.iter().enumerate().position(|(at, &plane)| {
                    !is_taken[at] && tiers.contains(&self.stone().plane(plane).tier)
                });
            free.inspect(|&at| is_taken[at] = true).is_some()
        })
    }

    /// Returns the corners that fit, in the order in which a facet reaches them as it is cut deeper, one for each
    /// depth. When the facet reaches such a corner, the other facets of the tier, cut to the same distance, leave the
    /// corner on the stone.
    pub fn reached(&self, planes: &[Plane], facet: usize, fits: impl Fn(&StoneCorner) -> bool) -> Vec<DVec3> {
        let normal = planes[facet].normal;
        let mut places: Vec<DVec3> =
            self.reached_corners(planes, facet, fits).into_iter().map(|corner| corner.at).collect();
        let same = SAME_DEPTH * self.stone().scale();
        places.dedup_by(|next, before| normal.dot(*before - *next) <= same);
        places
    }

    /// Returns all corners that fit, in the order in which a facet reaches them; see [`reached`](Self::reached).
    pub fn reached_corners(
        &self,
        planes: &[Plane],
        facet: usize,
        fits: impl Fn(&StoneCorner) -> bool,
    ) -> Vec<&StoneCorner> {
        let (normal, scale) = (planes[facet].normal, self.stone().scale());
        let highest = self.stone().support(normal) - REACHABLE * scale;
        let is_left = |at: DVec3, depth: f64| {
            planes.iter().all(|plane| plane.normal.dot(at) <= depth + SAME_DEPTH * scale)
        };
        let can_be_reached = |corner: &&StoneCorner| {
            let depth = normal.dot(corner.at);
            depth < highest && is_left(corner.at, depth) && fits(corner)
        };
        let mut corners: Vec<&StoneCorner> = self.stone().corners().iter().filter(can_be_reached).collect();
        corners.sort_by(|a, b| normal.dot(b.at).total_cmp(&normal.dot(a.at)));
        corners
    }

    /// Returns the number of corners, at different depths, that fit the names of a meet for the first facet of a
    /// tier. With several points it is the largest number, and it is 0 where the meet names no corner.
    pub fn choices(&self, place: usize, tier: &Tier, meet: &Meet) -> usize {
        let Meet::Points(points) = meet else { return 0 };
        let planes = self.planes(tier, tier.angle);
        let Some(first) = planes.first() else { return 0 };
        let count = |(named, _): (&[String], usize)| {
            let meant = self.meant(place, named).ok()?;
            let reached = self.reached(&planes, 0, |corner| self.is_corner_of(corner, &meant));
            Some(reached.iter().filter(|at| first.normal.dot(**at) > 0.0).count())
        };
        points.iter().filter_map(|point| point.named().and_then(count)).max().unwrap_or(0)
    }
}
