//! The entry of light into a body: the glare of the surface, and the light that goes on inside.

use super::PacketSurface;
use super::chain::along_surface;
use super::lanes::{Lanes, Vectors};
use super::optics::{Incidence, PacketLight, Reflection, s_axis};
use super::rays::{EnteringRay, InnerRay, SingleRay};
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
        let Split { point, shift, s, back, fanned_back, glare, inward, fanned, inside } =
            Arrivals::of(simd, chunk).split(simd, surface, is_polarised);
        for (lane, EnteringRay { ray, medium, .. }) in chunk.iter().enumerate() {
            let (point, shift, s) = (point.lane(lane), shift.lane(lane), s.lane(lane));
            let light = glare.lane(lane);
            let (direction, fan) = (back.lane(lane), fanned_back.lane(lane));
            leaving.push(SingleRay { origin: point, direction, fan, shift, s, light, ..*ray });
            let light = inside.lane(lane);
            let (direction, fan) = (inward.lane(lane), fanned.lane(lane));
            let ray = SingleRay { origin: point, direction, fan, shift, s, light, ..*ray };
            inner.push(InnerRay { ray, medium: *medium, ..InnerRay::DARK });
        }
    }
    inner
}

/// Rays that meet a surface from outside, one in each lane.
struct Arrivals<S: Simd> {
    origin: Vectors<S>,
    direction: Vectors<S>,
    fan: Vectors<S>,
    shift: Vectors<S>,
    s: Vectors<S>,
    light: PacketLight<Lanes<S>>,
    distance: Lanes<S>,
    normal: Vectors<S>,
    index: Lanes<S>,
    spread: Lanes<S>,
}

/// The two parts of the light of such rays: the glare, and the light that goes on inside.
struct Split<S: Simd> {
    point: Vectors<S>,
    shift: Vectors<S>,
    s: Vectors<S>,
    back: Vectors<S>,
    fanned_back: Vectors<S>,
    glare: PacketLight<Lanes<S>>,
    inward: Vectors<S>,
    fanned: Vectors<S>,
    inside: PacketLight<Lanes<S>>,
}

impl<S: Simd> Arrivals<S> {
    #[inline(always)]
    fn of(simd: S, rays: &[EnteringRay]) -> Self {
        let none = Vectors::splat(simd, Vec3::ZERO);
        let up = Vectors::splat(simd, Vec3::Z);
        let (zero, one) = (Lanes::splat(simd, 0.0), Lanes::splat(simd, 1.0));
        let mut all = Self {
            origin: none,
            direction: -up,
            fan: none,
            shift: none,
            s: Vectors::splat(simd, Vec3::X),
            light: PacketLight::dark(simd),
            distance: zero,
            normal: up,
            index: one,
            spread: zero,
        };
        for (lane, EnteringRay { ray, met, medium, .. }) in rays.iter().enumerate() {
            all.origin.set_lane(lane, ray.origin);
            all.direction.set_lane(lane, ray.direction);
            all.fan.set_lane(lane, ray.fan);
            all.shift.set_lane(lane, ray.shift);
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
        let Self { direction, normal, fan, .. } = self;
        let point = self.origin + direction * self.distance;
        let cos_i = -direction.dot(normal);
        let shift = along_surface(self.shift + fan * self.distance, direction, normal);
        let of_normal = P::IS_CURVED.then(|| surface.turned(simd, point, shift));
        let eta = Lanes::splat(simd, 1.0) / self.index;
        let reflection = Reflection::of(cos_i, eta);
        let s = s_axis(direction, normal, self.s);
        let mut light = self.light;
        if is_polarised {
            light = light.turned(self.s.dot(s), direction.cross(self.s).dot(s));
        }
        let (mut glare, mut inside) = (light.reflected(&reflection), light.transmitted(&reflection));
        if !is_polarised {
            glare = PacketLight::<Lanes<S>>::unpolarised(glare.weight());
            inside = PacketLight::<Lanes<S>>::unpolarised(inside.weight());
        }
        let incidence = Incidence { direction, normal, cos_i, of_direction: fan, of_normal };
        Split {
            point,
            shift,
            s,
            back: incidence.reflected(),
            fanned_back: incidence.reflected_change(),
            glare,
            inward: incidence.refracted(eta, reflection.cos_t),
            fanned: incidence.refracted_change(eta, -(self.spread * eta * eta), reflection.cos_t),
            inside,
        }
    }
}
