//! Chooses, among the possible meanings of an instruction, the one that agrees with the design's own numbers.

use super::super::tiers::{Tier, Tiers};
use super::found::PASSES;
use super::meet::{Meet, MeetPoint};
use super::solve::{AGREE, Bench, SAME_DEPTH, TierOutcome, cutting_order};
use super::stone::StoneCorner;
use super::words;

/// The most corners that are tried for the same names.
const MOST_REACHED: usize = 12;

impl Tiers {
    /// Returns the design with the meets that its instructions state. Tiers that have a meet keep it, and all numbers
    /// stay.
    ///
    /// Where words fit several points, the tier's own distance decides. Of several readings, the first that gives
    /// this distance is taken. Where other facets meet at the corner as well, they are added to its names. Of several
    /// corners with the same names, the number of the right one is stored ([`MeetPoint::LaterCorner`]). Where no
    /// reading comes near the distance, the literal reading stands, unless the words also leave a size to the cutter. Names
    /// are written as in their tiers.
    pub fn with_stated_meets(&self) -> Self {
        let readings = words::stated(self);
        let mut design = self.clone();
        for (tier, readings) in design.tiers.iter_mut().zip(&readings) {
            tier.meet = tier.meet.take().or(readings.first().cloned());
        }
        let given = design.clone();
        let mut bench = Bench::of(&given);
        for place in cutting_order(&given) {
            let tier = &given.tiers[place];
            if !tier.is_cut {
                continue;
            }
            if self.tiers[place].meet.is_none() {
                design.tiers[place].meet = bench.meant_by(place, tier, &readings[place]);
            }
            bench.cut(place, tier);
        }
        for (place, tier) in
            design.tiers.iter_mut().enumerate().filter(|(k, _)| self.tiers[*k].meet.is_none())
        {
            tier.meet.iter_mut().for_each(|meet| words::name_as_written(meet, bench.names(), place));
        }
        design
    }

    /// Returns the design with those of the stated meets that agree with its numbers: followed together, they move no
    /// tier. Tiers that have a meet keep it, and all numbers stay.
    pub fn with_kept_stated_meets(&self) -> Self {
        let mut design = self.with_stated_meets();
        // Before a tier is cut, nothing shows whether its meet would move it.
        for (tier, own) in design.tiers.iter_mut().zip(&self.tiers).filter(|(tier, _)| !tier.is_cut) {
            tier.meet.clone_from(&own.meet);
        }
        let scale = Bench::of(self).stone().scale();
        while design.drop_a_moving_meet(self, scale) {}
        design
    }
}

impl Bench<'_> {
    /// Returns the reading of an instruction that agrees with the tier's own distance, or else the literal reading.
    fn meant_by(&self, place: usize, tier: &Tier, readings: &[Meet]) -> Option<Meet> {
        let first = readings.first()?;
        if matches!(first, Meet::Given(_)) || self.miss(place, tier, first).is_some_and(|miss| miss <= PASSES)
        {
            return Some(first.clone());
        }
        let mut others: Vec<Meet> = readings.to_vec();
        for reading in readings {
            if let Meet::Points(points) = reading
                && let [MeetPoint::Corner(names)] = &points[..]
            {
                others.extend(self.named_more(place, tier, names));
                let later = |reached| MeetPoint::LaterCorner { names: names.clone(), reached };
                let most = self.choices(place, tier, reading).min(MOST_REACHED);
                others.extend((2..=most).map(|reached| Meet::Points(vec![later(reached)])));
            }
        }
        let missed: Vec<f64> =
            others.iter().map(|meet| self.miss(place, tier, meet).unwrap_or(f64::INFINITY)).collect();
        let near =
            [PASSES, SAME_DEPTH, AGREE].iter().find_map(|most| missed.iter().position(|miss| miss <= most));
        let chosen = readings.last().filter(|last| matches!(last, Meet::Given(_)));
        near.map(|at| others[at].clone()).or_else(|| chosen.or(Some(first)).cloned())
    }

    /// Returns the distance by which a meet moves a tier, in lengths of the largest distance; `None` for a size that
    /// the cutter chooses, and where the meet cannot be followed.
    fn miss(&self, place: usize, tier: &Tier, meet: &Meet) -> Option<f64> {
        let mut followed = tier.clone();
        match self.follow(place, &mut followed, meet) {
            Ok(TierOutcome::Solved | TierOutcome::Sets) => {
                Some((followed.distance - tier.distance).abs() / self.stone().scale())
            }
            _ => None,
        }
    }

    /// Returns a meet with more names than these, for a corner where they meet, that gives the tier its distance;
    /// `None` where there is no such corner.
    fn named_more(&self, place: usize, tier: &Tier, named: &[String]) -> Option<Meet> {
        let meet = |names: Vec<String>| Meet::Points(vec![MeetPoint::Corner(names)]);
        let meant = self.meant(place, named).ok()?;
        let corners = self.passed(tier).into_iter().filter(|corner| self.is_corner_of(corner, &meant));
        let mut lists = corners.flat_map(|corner| {
            let spare = self.beyond(corner, &meant);
            (1..=spare.len()).map(move |count| spare[..count].to_vec()).collect::<Vec<_>>()
        });
        lists.find_map(|more| {
            let more = more.iter().map(|&tier| self.names().written(tier, place));
            Some(meet(named.iter().cloned().chain(more).collect()))
                .filter(|meet| self.gives(place, tier, meet))
        })
    }

    /// Returns the tiers of the facets that meet at a corner, without one facet for each name.
    fn beyond(&self, corner: &StoneCorner, meant: &[Vec<usize>]) -> Vec<usize> {
        let mut tiers: Vec<usize> =
            corner.planes.iter().map(|&plane| self.stone().plane(plane).tier).collect();
        for named in meant {
            if let Some(at) = tiers.iter().position(|tier| named.contains(tier)) {
                tiers.remove(at);
            }
        }
        tiers
    }
}
