//! Light that enters a body: the surface's glare, and what goes on inside.

use super::lanes::{Lanes, Vectors};
use super::optics::{Coherency, Meeting, Reflection, s_axis};
use super::rays::{EnteringRay, InnerRay, LeavingRay};
use glam::Vec3;
use pulp::Simd;

/// Splits the light of rays that enter: glare is put into `leaving`, and what goes on inside is returned.
#[inline(always)]
pub(super) fn enter<S: Simd>(
    simd: S,
    rays: &[EnteringRay],
    (is_polarised, is_curved): (bool, bool),
    leaving: &mut Vec<LeavingRay>,
) -> Vec<InnerRay> {
    let mut inner = Vec::with_capacity(rays.len());
    for chunk in rays.chunks(S::F32_LANES) {
        let entered = Entered::of(simd, chunk, is_curved);
        for (lane, ray) in chunk.iter().enumerate() {
            let [glare, inside] = entered.lane(lane, is_polarised);
            leaving.push(LeavingRay {
                point: ray.point,
                direction: entered.back.lane(lane),
                sweep: entered.swept_back.lane(lane),
                weight: glare.ss + glare.pp,
                tag: ray.tag,
            });
            inner.push(InnerRay {
                origin: ray.point,
                direction: entered.inward.lane(lane),
                sweep: entered.swept.lane(lane),
                shift: ray.shift,
                s: entered.s.lane(lane),
                light: inside,
                medium: ray.medium,
                tag: ray.tag,
            });
        }
    }
    inner
}

/// What becomes of the rays of one packet.
struct Entered<S: Simd> {
    back: Vectors<S>,
    swept_back: Vectors<S>,
    inward: Vectors<S>,
    swept: Vectors<S>,
    s: Vectors<S>,
    glare: Coherency<Lanes<S>>,
    inside: Coherency<Lanes<S>>,
}

impl<S: Simd> Entered<S> {
    #[inline(always)]
    fn of(simd: S, rays: &[EnteringRay], is_curved: bool) -> Self {
        let none = Vectors::all(simd, Vec3::ZERO);
        let up = Vectors::all(simd, Vec3::Z);
        let (mut direction, mut normal, mut of_direction, mut of_normal) = (-up, up, none, none);
        let (mut weight, mut index, mut spread) =
            (Lanes::all(simd, 0.0), Lanes::all(simd, 1.0), Lanes::all(simd, 0.0));
        for (lane, ray) in rays.iter().enumerate() {
            direction.set_lane(lane, ray.direction);
            normal.set_lane(lane, ray.normal);
            of_direction.set_lane(lane, ray.sweep);
            of_normal.set_lane(lane, ray.of_normal);
            weight.set_lane(lane, ray.weight);
            index.set_lane(lane, ray.medium.index);
            spread.set_lane(lane, ray.medium.spread);
        }
        let cos_i = -direction.dot(normal);
        let eta = Lanes::all(simd, 1.0) / index;
        let meeting = Meeting {
            direction,
            normal,
            cos_i,
            of_direction,
            of_normal: if is_curved { Some(of_normal) } else { None },
        };
        let surface = Reflection::of(cos_i, eta);
        let light = Coherency::unpolarised(weight);
        Self {
            back: meeting.reflected(),
            swept_back: meeting.reflected_change(),
            inward: meeting.refracted(eta, surface.cos_t),
            swept: meeting.refracted_change(eta, -(spread * eta * eta), surface.cos_t),
            s: s_axis(direction, normal, Vectors::all(simd, Vec3::X)),
            glare: light.reflected(&surface),
            inside: light.transmitted(&surface),
        }
    }

    /// Returns the glare and the light inside in a lane.
    #[inline(always)]
    fn lane(&self, lane: usize, is_polarised: bool) -> [Coherency<f32>; 2] {
        [self.glare.lane(lane, is_polarised), self.inside.lane(lane, is_polarised)]
    }
}

impl<S: Simd> Coherency<Lanes<S>> {
    #[inline(always)]
    fn lane(&self, lane: usize, is_polarised: bool) -> Coherency<f32> {
        let (ss, pp) = (self.ss.lane(lane), self.pp.lane(lane));
        if is_polarised {
            return Coherency { ss, pp, re: self.re.lane(lane), im: self.im.lane(lane) };
        }
        let half = 0.5 * (ss + pp);
        Coherency { ss: half, pp: half, re: 0.0, im: 0.0 }
    }
}
