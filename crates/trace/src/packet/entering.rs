//! The entry of light into a body: the glare of the surface, and the light that goes on inside.

use super::PacketSurface;
use super::lanes::{Lanes, Vectors};
use super::rays::{EnteringRay, InnerRay, SingleRay};
use crate::DispersedRay;
use crate::coherency::{Coherency, s_axis};
use crate::dispersed_ray::{Arrival, Refraction};
use brillianteer_optics::fresnel;
use glam::Vec3;
use pulp::Simd;

/// Splits the light of rays that enter: the glare is added to `leaving`, and the rays that go on inside are returned.
#[inline(always)]
pub(super) fn enter<S: Simd, P: PacketSurface>(
    simd: S,
    surface: &P,
    rays: &[EnteringRay],
    is_polarised: bool,
    leaving: &mut Vec<SingleRay>,
) -> Vec<InnerRay> {
    let mut inner = Vec::with_capacity(rays.len());
    for chunk in rays.chunks(S::F32_LANES) {
        let Split { s, back, glare, inward, inside } =
            Arrivals::of(simd, chunk).split(simd, surface, is_polarised);
        for (lane, EnteringRay { ray, medium, .. }) in chunk.iter().enumerate() {
            let (origin, shift, s) = (back.origin.lane(lane), back.shift.lane(lane), s.lane(lane));
            let light = glare.lane(lane);
            let (direction, fan) = (back.direction.lane(lane), back.fan.lane(lane));
            leaving.push(SingleRay { origin, direction, fan, shift, s, light, ..*ray });
            let light = inside.lane(lane);
            let (direction, fan) = (inward.direction.lane(lane), inward.fan.lane(lane));
            let ray = SingleRay { origin, direction, fan, shift, s, light, ..*ray };
            inner.push(InnerRay { ray, medium: *medium, ..InnerRay::DARK });
        }
    }
    inner
}

/// Rays that meet a surface from outside, one in each lane.
struct Arrivals<S: Simd> {
    ray: DispersedRay<Vectors<S>>,
    s: Vectors<S>,
    light: Coherency<Lanes<S>>,
    distance: Lanes<S>,
    normal: Vectors<S>,
    index: Lanes<S>,
    spread: Lanes<S>,
}

/// The two parts of the light of such rays: the glare, and the light that goes on inside.
struct Split<S: Simd> {
    s: Vectors<S>,
    back: DispersedRay<Vectors<S>>,
    glare: Coherency<Lanes<S>>,
    inward: DispersedRay<Vectors<S>>,
    inside: Coherency<Lanes<S>>,
}

impl<S: Simd> Arrivals<S> {
    #[inline(always)]
    fn of(simd: S, rays: &[EnteringRay]) -> Self {
        let none = Vectors::splat(simd, Vec3::ZERO);
        let up = Vectors::splat(simd, Vec3::Z);
        let (zero, one) = (Lanes::splat(simd, 0.0), Lanes::splat(simd, 1.0));
        let mut all = Self {
            ray: DispersedRay::along(-up, none),
            s: Vectors::splat(simd, Vec3::X),
            light: Coherency::dark(simd),
            distance: zero,
            normal: up,
            index: one,
            spread: zero,
        };
        for (lane, EnteringRay { ray, met, medium, .. }) in rays.iter().enumerate() {
            all.ray.set_lane(lane, ray);
            all.s.set_lane(lane, ray.s);
            all.light.set_lane(lane, &ray.light);
            all.distance.set_lane(lane, met.distance);
            all.normal.set_lane(lane, met.normal);
            all.index.set_lane(lane, medium.index);
            all.spread.set_lane(lane, medium.spread);
        }
        all
    }

    #[inline(always)]
    fn split<P: PacketSurface>(self, simd: S, surface: &P, is_polarised: bool) -> Split<S> {
        let Self { ray, normal, .. } = self;
        let point = ray.origin + ray.direction * self.distance;
        let cos_i = -ray.direction.dot(normal);
        let shift = ray.along_surface(self.distance, normal);
        let of_normal = surface.turned(simd, point, shift);
        let arrival = Arrival { point, normal, shift, of_normal };
        let eta = Lanes::splat(simd, 1.0) / self.index;
        let reflection = fresnel(cos_i, eta);
        let s = s_axis(ray.direction, normal, self.s);
        let mut light = self.light;
        if is_polarised {
            light = light.turned_to(s, self.s, ray.direction);
        }
        let (mut glare, mut inside) = (light.reflected(&reflection), light.transmitted(&reflection));
        if !is_polarised {
            (glare, inside) = (glare.unpolarised(), inside.unpolarised());
        }
        let into = Refraction {
            eta: [eta, -(self.spread * eta * eta)],
            cosines: (cos_i, reflection.cos_t_or_zero()),
        };
        let back = ray.reflected(&arrival, cos_i, true);
        Split { s, back, glare, inward: ray.refracted(&arrival, &into, true), inside }
    }
}
