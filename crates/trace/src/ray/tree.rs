//! The path of a ray through a solid that is not convex: light that leaves may enter again.
//!
//! Every passage, from entry until too little light is left, is the chain of bounces that a convex stone has. Light
//! that leaves and meets the solid again waits, with its polarisation, and is followed in the same way, the strongest
//! first. Without roulette, light weaker than the least weight is not followed and counts as unresolved, so that all
//! shares still add up to 1. With roulette, weak light is followed by chance: the shares add up to 1 in the mean, and
//! only the limits on bounces and passages leave light unresolved.

use super::facets::FacetSearch;
use super::light::PathLight;
use super::lobe_luck::LobeLuck;
use super::path::SurfaceEvent;
use super::roulette::{PassageRoulette, Roulette};
use super::{Exit, Loss, StoneTracer};
use crate::DispersedRay;

/// The most passages of one ray that are followed; light that waits after so many is unresolved.
const MOST_PASSAGES: usize = 1000;

/// Light outside that is about to enter the solid.
#[derive(Clone, Copy)]
pub(super) struct Inbound {
    pub met: (usize, f64),
    pub ray: DispersedRay,
    /// The light without absorption.
    pub light: PathLight,
    /// The share that has not been absorbed.
    pub left: f64,
    /// The length of the path inside so far.
    pub path: f64,
    /// The number of bounces inside so far.
    pub bounce: u32,
    /// The random numbers, as in [`MeetingRay`](super::MeetingRay).
    pub luck: Option<LobeLuck>,
}

impl Inbound {
    fn weight(&self) -> f64 {
        self.light.weight() * self.left
    }
}

impl StoneTracer {
    /// Follows light into a solid, and all light that leaves it and enters again, except where `is_taken` returns
    /// true for an exit and a distance, because another body is nearer. `None` where the ray runs along the first
    /// facet.
    pub(super) fn branch<F: FacetSearch>(
        &self,
        facets: &F,
        start: Inbound,
        mut roulette: Option<Roulette>,
        is_taken: &dyn Fn(&Exit, f64) -> bool,
        leave: &mut dyn FnMut(Exit, &SurfaceEvent),
    ) -> Option<Loss> {
        let mut rest = Loss::default();
        let mut waiting: Vec<Inbound> = vec![];
        let mut next = start;
        for number in 0..MOST_PASSAGES {
            let mut chances = match &mut roulette {
                Some(roulette) => roulette.passage(&next.light, next.left),
                None => PassageRoulette::without_chance(self.options.least_weight, &next.light, next.left),
            };
            let passed = self.passage(facets, next, chances.chain.end.least, |meeting| {
                let factor = chances.chain.meet(meeting.light, meeting.left, meeting.onward);
                let Some(mut exit) = meeting.exit() else { return };
                let own = exit.weight;
                let Some(weight) = chances.exits.pass(own * factor) else { return };
                exit.weight = weight;
                let met = facets.again(exit.facet as usize, exit.point, exit.direction);
                let Some(met) = met.filter(|met| !is_taken(&exit, met.1)) else {
                    return leave(exit, &meeting);
                };
                if roulette.is_some() || weight > self.options.least_weight {
                    waiting.extend(self.inbound(&meeting, &exit, met, weight / own));
                } else {
                    rest.unresolved += weight;
                }
            });
            match passed {
                Some(passed) => rest = rest.and(&chances.chain.loss(passed.bounces)),
                None if number == 0 => return None,
                None => rest.unresolved += next.weight(),
            }
            let Some(strongest) = strongest(&waiting) else { break };
            next = waiting.swap_remove(strongest);
            if number + 1 == MOST_PASSAGES {
                rest.unresolved += next.weight();
            }
        }
        rest.unresolved += waiting.iter().map(Inbound::weight).sum::<f64>();
        Some(rest)
    }

    /// Returns light that leaves and enters again, `factor` times as strong.
    fn inbound(
        &self,
        meeting: &SurfaceEvent,
        exit: &Exit,
        met: (usize, f64),
        factor: f64,
    ) -> Option<Inbound> {
        let &Exit { point: origin, direction, fan, shift, path, bounce, .. } = exit;
        let light = meeting.onward_outside(self.medium.index)?;
        let light = if factor == 1.0 { light } else { light.scaled(factor) };
        let ray = DispersedRay { origin, direction, fan, shift };
        Some(Inbound { met, ray, light, left: meeting.left, path, bounce, luck: None })
    }
}

fn strongest(waiting: &[Inbound]) -> Option<usize> {
    let weights = waiting.iter().map(Inbound::weight).enumerate();
    weights.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(k, _)| k)
}

#[cfg(test)]
mod tests;
