//! Finds meets in the geometry of a finished design: the corners of the stone so far through which each tier passes.

use super::super::tiers::{Tier, Tiers};
use super::meet::{Meet, MeetPoint};
use super::solve::{Bench, SolvedTiers, TierOutcome, cutting_order};
use super::stone::StoneCorner;

/// A tier passes through a point whose distance from it is at most this, in lengths of the largest distance. It is
/// half of the fifth digit that most files have, enlarged by the lean of facets.
pub(super) const PASSES: f64 = 2e-5;

/// The largest difference between directions that count as one; machines are set to about 1e-3.
const SAME_WAY: f64 = 1e-6;

/// The fewest and the most names of a corner in a meet.
pub(super) const NAMES: std::ops::RangeInclusive<usize> = 3..=6;

/// The number of times that meets are looked for again after all are followed. Each time, fewer tiers have none.
const MOST_TIMES: usize = 8;

/// The most lists of names that are tried for one corner.
const MOST_LISTS: usize = 60;

impl Tiers {
    /// Returns the design with meets that its geometry shows, for tiers without one. They are points through which
    /// the tier passes, and by which [`solved`](Self::solved) finds its distance again. All numbers stay.
    ///
    /// A meet that fits alone may choose another corner once all meets are followed together, because more facets
    /// have then been cut. Such meets are dropped, so that following the design moves no tier by a meet that nobody
    /// stated.
    pub fn with_found_meets(&self) -> Self {
        let mut design = self.clone();
        let mut bench = Bench::of(self);
        for place in cutting_order(self) {
            let tier = &self.tiers[place];
            if !tier.is_cut {
                continue;
            }
            if tier.meet.is_none() {
                design.tiers[place].meet = bench.found(place, tier);
            }
            bench.cut(place, tier);
        }
        let scale = bench.stone().scale();
        while design.drop_a_moving_meet(self, scale) {}
        design
    }

    /// Follows the meets of the design, and those that its geometry shows, and looks for more in what they make, until there are
    /// no more: exact points show meets that the rounded numbers of a file hide. Returns the design with all meets, before they
    /// are followed and after.
    pub fn with_found_meets_followed(&self) -> (Self, SolvedTiers) {
        let count = |tiers: &Self| tiers.tiers.iter().filter(|tier| tier.meet.is_some()).count();
        let mut met = self.with_found_meets();
        let mut solved = met.solved();
        for _ in 0..MOST_TIMES {
            let more = solved.tiers.with_found_meets();
            if count(&more) == count(&met) {
                break;
            }
            met.tiers.iter_mut().zip(more.tiers).for_each(|(tier, more)| tier.meet = more.meet);
            solved = met.solved();
        }
        (met, solved)
    }

    /// Returns the design with the meets that its instructions state, and then those that its geometry shows, for
    /// tiers without one. All numbers stay, even when the design is followed: see
    /// [`with_kept_stated_meets`](Self::with_kept_stated_meets).
    pub fn with_own_meets(&self) -> Self {
        let mut design = self.with_kept_stated_meets().with_found_meets();
        // A found meet moves its tier by no more than rounding, but a stated meet may pass such moves on, enlarged.
        let scale = Bench::of(self).stone().scale();
        while design.drop_a_moving_meet(self, scale) {}
        design
    }

    /// Drops the first meet that `before` does not have and that fails or moves its tier when all meets are followed.
    /// Returns whether there was such a meet.
    pub(super) fn drop_a_moving_meet(&mut self, before: &Self, scale: f64) -> bool {
        let solved = self.solved();
        let moves = |place: &usize| {
            let moved = (solved.tiers.tiers[*place].distance - before.tiers[*place].distance).abs();
            matches!(solved.outcomes[*place], TierOutcome::Failed(_)) || moved > PASSES * scale
        };
        let is_found =
            |place: &usize| before.tiers[*place].meet.is_none() && self.tiers[*place].meet.is_some();
        let Some(place) = (0..self.tiers.len()).filter(is_found).find(moves) else { return false };
        self.tiers[place].meet = None;
        true
    }
}

impl Bench<'_> {
    /// Returns a meet that gives a tier the distance that it has; `None` where there is none.
    pub fn found(&self, place: usize, tier: &Tier) -> Option<Meet> {
        self.simple(place, tier).or_else(|| self.found_corner(place, tier))
    }

    /// Returns the meet at the centre point or at the level girdle that gives a tier the distance that it has; `None` where
    /// neither does.
    pub fn simple(&self, place: usize, tier: &Tier) -> Option<Meet> {
        let level = self.is_beside_girdle(tier).then_some(MeetPoint::LevelGirdle);
        let points = [MeetPoint::Centre { temporary: false }].into_iter().chain(level);
        let mut simple = points.map(|point| Meet::Points(vec![point]));
        simple.find(|meet| self.gives(place, tier, meet))
    }

    /// Returns whether the first facet of a tier meets a facet below or above it in a level line, where one of them
    /// is upright and both face the same way.
    fn is_beside_girdle(&self, tier: &Tier) -> bool {
        let Some(first) = tier.facets.first() else { return false };
        let normal = self.plane(tier, first.index).normal;
        let out = normal.truncate().normalize_or_zero();
        self.stone().planes().iter().any(|cut| {
            let other = cut.plane.normal;
            (other.z == 0.0) != (normal.z == 0.0)
                && (other.truncate().normalize_or_zero() - out).length() < SAME_WAY
        })
    }

    /// Returns whether a meet gives a tier the distance that it has.
    pub fn gives(&self, place: usize, tier: &Tier, meet: &Meet) -> bool {
        let mut followed = tier.clone();
        let outcome = self.follow(place, &mut followed, meet);
        outcome == Ok(TierOutcome::Solved)
            && (followed.distance - tier.distance).abs() <= PASSES * self.stone().scale()
    }

    /// Returns a meet at a corner that gives a tier the distance that it has; `None` where there is none.
    pub fn found_corner(&self, place: usize, tier: &Tier) -> Option<Meet> {
        let corners = self.passed(tier);
        let lists = |count: usize| {
            corners
                .iter()
                .flat_map(move |corner| self.lists(place, &corner.planes, count))
                .collect::<Vec<_>>()
        };
        let meets = NAMES.flat_map(lists).map(|names| Meet::Points(vec![MeetPoint::Corner(names)]));
        meets.into_iter().find(|meet| self.gives(place, tier, meet))
    }

    /// Returns the corners through which the first facet of a tier passes, beginning with the one nearest to the
    /// facet's middle line.
    pub fn passed(&self, tier: &Tier) -> Vec<&StoneCorner> {
        let Some(first) = tier.facets.first() else { return vec![] };
        let plane = self.plane(tier, first.index);
        let near = PASSES * self.stone().scale();
        let mut corners: Vec<&StoneCorner> =
            self.stone().corners().iter().filter(|corner| plane.distance(corner.at).abs() <= near).collect();
        let out = plane.normal.truncate().normalize_or_zero();
        let aside = |corner: &StoneCorner| out.perp_dot(corner.at.truncate()).abs();
        corners.sort_by(|a, b| aside(a).total_cmp(&aside(b)));
        corners
    }

    /// Returns lists of `count` names of facets that meet at a corner. `planes` are the places of the planes that
    /// meet there.
    pub fn lists(&self, place: usize, planes: &[usize], count: usize) -> Vec<Vec<String>> {
        let mut tiers: Vec<usize> = planes.iter().map(|&plane| self.stone().plane(plane).tier).collect();
        tiers.sort_unstable();
        let mut lists: Vec<Vec<usize>> = vec![];
        choose(&tiers, count, &mut vec![], &mut lists);
        lists.dedup();
        let name = |&tier: &usize| self.names().written(tier, place);
        lists.iter().map(|list| list.iter().map(name).collect()).collect()
    }
}

/// Lists the ways to choose `count` members of a sorted list, up to [`MOST_LISTS`].
fn choose(from: &[usize], count: usize, chosen: &mut Vec<usize>, lists: &mut Vec<Vec<usize>>) {
    if count == 0 {
        if !lists.contains(chosen) {
            lists.push(chosen.clone());
        }
        return;
    }
    for (at, &member) in from.iter().enumerate() {
        if lists.len() >= MOST_LISTS || from.len() - at < count {
            return;
        }
        chosen.push(member);
        choose(&from[at + 1..], count - 1, chosen, lists);
        chosen.pop();
    }
}
