//! The light that shared beams leave, followed by single rays from the places where the beams end, as the
//! [`tail`](super::tail) of figures is.

use super::beam::BeamEnd;
use super::ray::{ChainRoulette, Loss, PathLight, RayOptions, StoneTracer};
use super::tail::ROULETTE;
use crate::math::{Polytope, point_in_polygon};
use crate::scene::Medium;
use glam::{DVec2, DVec3};

/// Follows rays on from the ends of shared beams.
#[derive(Clone)]
pub struct SharedTail {
    tracer: StoneTracer,
    polarised: bool,
}

impl SharedTail {
    /// Prepares a stone; its medium is given with each ray.
    pub fn new(polytope: &Polytope, polarised: bool) -> Self {
        let options = RayOptions { polarised, ..RayOptions::default() };
        Self { tracer: StoneTracer::new(polytope, Medium::clear(1.0), options), polarised }
    }

    /// Follows one ray from the end of a beam, as light of a medium goes on, and calls `leave` with the direction and the
    /// share of each exit. Shares are parts of the light that goes on where nothing has been absorbed.
    ///
    /// `spot` says where in the outline it starts and `luck` how long it is followed; all are from 0 to below 1. Where they are
    /// spread evenly, the mean of all rays is what becomes of the light.
    pub fn follow(
        &self,
        end: &BeamEnd,
        medium: &Medium,
        (spot, luck): (DVec2, f64),
        mut leave: impl FnMut(DVec3, f64),
    ) -> Loss {
        let point = point_in_polygon(&end.outline, end.area, spot);
        let (origin, direction, path) = end.ray(point);
        let scale = 1.0 / end.weight;
        let light = match self.polarised {
            true => {
                let fields = end.coherency.fields().map(|parts| parts.map(|part| part * scale.sqrt()));
                PathLight::of_fields(fields, end.s)
            }
            false => PathLight::Unpolarised(1.0),
        };
        let own = Medium { index: end.slant.index, ..*medium };
        let mut chances = ChainRoulette::new(ROULETTE, luck, &light, own.transmittance(path));
        let tracer = self.tracer.made_of(own);
        let loss = tracer.follow_inside((origin, direction), (light, path), chances.least, |met| {
            let factor = chances.meet(met.light, met.left, met.onward);
            if let Some(leaving) = met.leaving {
                leave(leaving.direction, leaving.weight * factor);
            }
        });
        chances.loss(loss.bounces)
    }
}
