//! Chains of bounces inside a body, with one chain in each lane.

use super::entering::enter;
use super::lanes::{Lanes, MOST_LANES, Vectors};
use super::optics::{Incidence, LEAST_COS, PacketLight, Reflection, s_axis};
use super::rays::{EnteringRay, InnerRay, InnerRays, PacketLoss, SingleRay, Travelled};
use super::{PacketHit, PacketSurface};
use crate::ray::RayOptions;
use pulp::{Simd, WithSimd};

/// The greatest component of a fan or a shift. A larger fan would cover more than the whole sphere, and a larger
/// shift more than the body, and each bounce may multiply them.
const WIDEST_FAN: f32 = 1e4;

/// The least random number of a ray. With a smaller one, the ray would be followed until no light is left.
const LEAST_LUCK: f32 = 1e-9;

/// The passage of rays through one body, from their entry until too little light is left.
pub(super) struct Passage<'a, P> {
    pub surface: &'a P,
    pub rays: &'a [EnteringRay],
    pub options: RayOptions,
    /// The weight below which light goes on only by chance, and counts for more where it does. It is 0 where all
    /// light is followed until its weight is at most the least weight of the options.
    pub threshold: f32,
    /// The list to which light that leaves is added.
    pub leaving: &'a mut Vec<SingleRay>,
    /// The list to which light that does not leave is added.
    pub losses: &'a mut Vec<PacketLoss>,
}

/// The ray in a lane and the number of its bounces; `None` where the lane is empty.
type Occupant = Option<(u32, u32)>;

impl<P: PacketSurface> WithSimd for Passage<'_, P> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        let mut inner = enter(simd, self.surface, self.rays, self.options.polarised, self.leaving);
        for (ray, entering) in inner.iter_mut().zip(self.rays) {
            self.draw(ray, entering.luck);
        }
        let absorbs = self.rays.iter().any(|ray| !ray.medium.is_clear());
        let mut lanes = InnerRays::dark(simd);
        let mut occupants: [Occupant; MOST_LANES] = [None; MOST_LANES];
        let mut next = 0;
        loop {
            let mut is_empty = true;
            for (lane, occupant) in occupants[..S::F32_LANES].iter_mut().enumerate() {
                while occupant.is_none() && next < inner.len() {
                    let ray = &inner[next];
                    next += 1;
                    *occupant = self.admitted(ray);
                    if occupant.is_some() {
                        lanes.set_lane(lane, ray);
                    }
                }
                is_empty &= occupant.is_none();
            }
            if is_empty {
                break;
            }
            let factor = lanes.factor();
            let before = [lanes.weight() * factor, lanes.absorbed];
            self.bounce(simd, (&mut lanes, factor), &occupants, absorbs);
            self.end(&mut lanes, &mut occupants, before);
        }
    }
}

impl<P: PacketSurface> Passage<'_, P> {
    /// Sets the weight at which a ray ends. Light below the threshold is followed as far as one random number decides
    /// (`ChainRoulette` in `trace/ray`).
    #[inline(always)]
    fn draw(&self, ray: &mut InnerRay, luck: f32) {
        if self.threshold > 0.0 {
            ray.threshold = self.threshold.min(ray.ray.light.weight());
            ray.least = luck.max(LEAST_LUCK) * ray.threshold;
        } else {
            ray.least = self.options.least_weight as f32;
        }
    }

    /// Returns the lane's occupant for a ray; `None` where the ray has too little light to be followed.
    #[inline(always)]
    fn admitted(&mut self, InnerRay { ray, least, .. }: &InnerRay) -> Occupant {
        let &SingleRay { light, travelled: Travelled { bounces, .. }, tag, .. } = ray;
        let weight = light.weight();
        if weight > *least && bounces < self.options.most_bounces {
            return Some((tag, bounces));
        }
        self.losses.push(PacketLoss { absorbed: 0.0, unresolved: weight, tag });
        None
    }

    /// Follows all rays to the next facet, where a part of their light leaves and the rest is reflected.
    #[inline(always)]
    fn bounce<S: Simd>(
        &mut self,
        simd: S,
        (rays, factor): (&mut InnerRays<S>, Lanes<S>),
        occupants: &[Occupant; MOST_LANES],
        absorbs: bool,
    ) {
        let PacketHit { distance, normal } = self.surface.exit(simd, rays.origin, rays.direction);
        let point = rays.origin + rays.direction * distance;
        rays.path = rays.path + distance;
        let cos_i = rays.direction.dot(normal);
        rays.shift = along_surface(rays.shift + rays.fan * distance, rays.direction, normal);
        let of_normal = P::IS_CURVED.then(|| -self.surface.turned(simd, point, rays.shift));
        if absorbs {
            absorb(rays, factor);
        }
        let surface = Reflection::of(cos_i, rays.index);
        if self.options.polarised {
            turn_to_plane_of_incidence(rays, normal);
        }
        let incidence = Incidence {
            direction: rays.direction,
            normal: -normal,
            cos_i,
            of_direction: rays.fan,
            of_normal,
        };
        let passed = rays.light.transmitted(&surface);
        let weight = passed.weight() * rays.left;
        let outward = incidence.refracted(rays.index, surface.cos_t);
        let fanned = incidence.refracted_change(rays.index, rays.spread, surface.cos_t);
        let fanned = if P::IS_CURVED { tamed(fanned) } else { fanned };
        for (lane, occupant) in occupants[..S::F32_LANES].iter().enumerate() {
            if let Some((tag, bounces)) = *occupant
                && weight.lane(lane) > 0.0
                && rays.path.lane(lane).is_finite()
            {
                let (left, path) = (rays.left.lane(lane), rays.path.lane(lane));
                let counts = left * factor.lane(lane);
                self.leaving.push(SingleRay {
                    origin: point.lane(lane),
                    direction: outward.lane(lane),
                    fan: fanned.lane(lane),
                    shift: rays.shift.lane(lane),
                    s: rays.s.lane(lane),
                    light: passed.lane(lane).times(counts),
                    travelled: Travelled { left, path, bounces: bounces + 1 },
                    tag,
                });
            }
        }
        rays.light = rays.light.reflected(&surface);
        if !self.options.polarised {
            rays.light = PacketLight::<Lanes<S>>::unpolarised(rays.light.weight());
        }
        let reflected_fan = incidence.reflected_change();
        rays.fan = if P::IS_CURVED { tamed(reflected_fan) } else { reflected_fan };
        rays.direction = incidence.reflected();
        rays.origin = point;
    }

    /// Counts the bounce, and empties the lanes of rays that end. `before` is the weighted light before the bounce,
    /// and the light absorbed until then.
    #[inline(always)]
    fn end<S: Simd>(
        &mut self,
        rays: &mut InnerRays<S>,
        occupants: &mut [Occupant; MOST_LANES],
        before: [Lanes<S>; 2],
    ) {
        let weights = rays.weight();
        let factors = rays.factor();
        for (lane, occupant) in occupants[..S::F32_LANES].iter_mut().enumerate() {
            let Some((tag, bounces)) = occupant else { continue };
            *bounces += 1;
            let (weight, absorbed) = (weights.lane(lane), rays.absorbed.lane(lane));
            // Rounding may let a ray slip out of the body at an edge. Such a ray has no place, and its remaining
            // light counts as unresolved.
            let has_slipped = !rays.path.lane(lane).is_finite() || !(weight + absorbed).is_finite();
            let is_caught = weight <= rays.least.lane(lane);
            if !has_slipped && !is_caught && *bounces < self.options.most_bounces {
                continue;
            }
            let [unresolved, absorbed] = if has_slipped {
                before.map(|light| light.lane(lane))
            } else if is_caught && rays.threshold.lane(lane) > 0.0 {
                [0.0, absorbed]
            } else {
                [weight * factors.lane(lane), absorbed]
            };
            self.losses.push(PacketLoss { absorbed, unresolved, tag: *tag });
            rays.set_lane(lane, &InnerRay::DARK);
            *occupant = None;
        }
    }
}

/// Describes polarised light by its fields perpendicular and parallel to the plane of incidence at a facet with this
/// normal.
#[inline(always)]
fn turn_to_plane_of_incidence<S: Simd>(rays: &mut InnerRays<S>, normal: Vectors<S>) {
    let across = s_axis(rays.direction, normal, rays.s);
    let sine = rays.direction.cross(rays.s).dot(across);
    rays.light = rays.light.turned(rays.s.dot(across), sine);
    rays.s = across;
}

/// Removes the light that is absorbed on the way to the facet, and counts it times this factor.
#[inline(always)]
fn absorb<S: Simd>(rays: &mut InnerRays<S>, factor: Lanes<S>) {
    let mut after = rays.left;
    for lane in 0..S::F32_LANES {
        let [o, e] = [rays.absorption[0].lane(lane), rays.absorption[1].lane(lane)];
        let path = rays.path.lane(lane);
        after.set_lane(lane, 0.5 * ((-o * path).exp() + (-e * path).exp()));
    }
    rays.absorbed = rays.absorbed + rays.light.weight() * (rays.left - after) * factor;
    rays.left = after;
}

/// Returns the displacements along the surface of the points where rays meet it, when the rays move by `by` there.
#[inline(always)]
pub(super) fn along_surface<S: Simd>(
    by: Vectors<S>,
    direction: Vectors<S>,
    normal: Vectors<S>,
) -> Vectors<S> {
    let speed = direction.dot(normal);
    let divisor = speed.abs().max(speed.all(LEAST_COS)).turned_as(speed);
    tamed(by - direction * (normal.dot(by) / divisor))
}

/// Returns the vectors, scaled down so that no component exceeds `WIDEST_FAN`.
#[inline(always)]
fn tamed<S: Simd>(v: Vectors<S>) -> Vectors<S> {
    let most = v[0].abs().max(v[1].abs()).max(v[2].abs()).max(v[0].all(1e-30));
    v * (most.all(WIDEST_FAN) / most).min(most.all(1.0))
}

#[cfg(test)]
mod tests {
    use super::super::rays::{PacketMedium, SingleHit};
    use super::*;
    use glam::Vec3;
    use pulp::Arch;

    /// A slab whose upper face is missed from inside, as rounding may miss a facet at an edge.
    struct OpenSlab;

    impl PacketSurface for OpenSlab {
        const IS_CURVED: bool = false;

        fn entry<S: Simd>(&self, simd: S, _: Vectors<S>, direction: Vectors<S>) -> PacketHit<S> {
            PacketHit { distance: direction[0].all(1.0), normal: Vectors::splat(simd, Vec3::Z) }
        }

        fn exit<S: Simd>(&self, simd: S, _: Vectors<S>, direction: Vectors<S>) -> PacketHit<S> {
            let (one, never) = (direction[0].all(1.0), direction[0].all(f32::INFINITY));
            let distance = direction[2].is_negative().select(one, never);
            PacketHit { distance, normal: Vectors::splat(simd, Vec3::NEG_Z) }
        }

        fn turned<S: Simd>(&self, _: S, _: Vectors<S>, by: Vectors<S>) -> Vectors<S> {
            by
        }
    }

    #[test]
    fn light_that_slips_out_of_a_body_is_unresolved() {
        for (polarised, absorption) in [(false, 0.0), (true, 0.0), (false, 0.7), (true, 0.7)] {
            let medium = PacketMedium { index: 1.5, spread: 0.0, absorption: [absorption; 2] };
            let down = SingleRay { direction: Vec3::NEG_Z, ..InnerRay::DARK.ray };
            let ray = SingleRay { light: PacketLight::<f32>::unpolarised(1.0), ..down };
            let met = SingleHit { distance: 1.0, normal: Vec3::Z };
            let rays = [EnteringRay { ray, met, medium, luck: 0.0 }; 3];
            let options = RayOptions { polarised, ..RayOptions::default() };
            let (mut leaving, mut losses) = (vec![], vec![]);
            let passage = Passage {
                surface: &OpenSlab,
                rays: &rays,
                options,
                threshold: 0.0,
                leaving: &mut leaving,
                losses: &mut losses,
            };
            Arch::new().dispatch(passage);
            // The leaving light is the glare and the light that leaves below; the rest goes up, where there is no
            // facet.
            assert_eq!((leaving.len(), losses.len()), (6, 3));
            let r = 0.04_f32;
            let inside = (1.0 - r) * (-absorption).exp();
            for loss in &losses {
                assert!((loss.unresolved - inside * r).abs() < 1e-6, "{loss:?}");
                assert!((loss.absorbed - (1.0 - r) * (1.0 - (-absorption).exp())).abs() < 1e-6, "{loss:?}");
            }
            let out: f32 = leaving.iter().map(|ray| ray.light.weight()).sum();
            assert!((out - 3.0 * (r + inside * (1.0 - r))).abs() < 1e-5, "{out}");
        }
    }
}
