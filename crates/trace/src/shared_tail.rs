//! Follows the light that shared beams leave by single rays from the places where the beams end, as
//! [`tail`](super::tail) does for figures.

use super::beam::BeamEnd;
use super::ray::{ChainRoulette, Loss, PathLight, RayOptions, StoneTracer};
use super::tail::ROULETTE;
use brillianteer_math::{Polytope, point_in_polygon};
use brillianteer_scene::Medium;
use glam::{DVec2, DVec3};

/// Follows rays on from the ends of shared beams.
#[derive(Clone)]
pub struct SharedTail {
    tracer: StoneTracer,
    polarised: bool,
}

/// Light of a followed ray, at a point where it leaves the stone.
#[derive(Debug, Clone, Copy)]
pub struct SharedTailExit {
    /// The unit direction of the light, followed from the eye.
    pub direction: DVec3,
    /// The share of the light that leaves here, as if nothing were absorbed.
    pub share: f64,
    /// The length of the path inside the stone, from where the light entered.
    pub path: f64,
}

impl SharedTail {
    /// Prepares a stone; its medium is given with each ray.
    pub fn new(polytope: &Polytope, polarised: bool) -> Self {
        let options = RayOptions { polarised, ..RayOptions::default() };
        Self { tracer: StoneTracer::new(polytope, Medium::clear(1.0), options), polarised }
    }

    /// Follows one ray from the end of a beam through a medium, whose light begins at the index in the middle of the
    /// end's group, and calls `leave` for each exit. Returns the light that does not leave, and the length of the
    /// path inside the stone up to the ray's start.
    ///
    /// `spot` gives the place in the outline where the ray starts, and `luck` decides how long it is followed; all
    /// three numbers are from 0 to below 1. Where they are spread evenly, the mean over all rays is the distribution
    /// of the light.
    pub fn follow(
        &self,
        end: &BeamEnd,
        medium: &Medium,
        (spot, luck): (DVec2, f64),
        mut leave: impl FnMut(SharedTailExit),
    ) -> (Loss, f64) {
        let point = point_in_polygon(&end.outline, end.area, spot);
        let (origin, direction, path) = end.ray(point);
        let scale = 1.0 / end.weight;
        let light = if self.polarised {
            let fields = end.coherency.fields().map(|parts| parts.map(|part| part * scale.sqrt()));
            PathLight::of_fields(fields, end.s)
        } else {
            PathLight::Unpolarised(1.0)
        };
        let own = Medium { index: end.slant.index, ..*medium };
        let mut chances = ChainRoulette::new(ROULETTE, luck, &light, own.transmittance(path));
        let tracer = self.tracer.made_of(own);
        let loss = tracer.follow_inside((origin, direction), (light, path), chances.end.least, |met| {
            let factor = chances.meet(met.light, met.left, met.onward);
            if let Some(leaving) = met.leaving {
                let share = leaving.weight * factor;
                leave(SharedTailExit { direction: leaving.direction, share, path: met.path });
            }
        });
        (chances.loss(loss.bounces), path)
    }
}
