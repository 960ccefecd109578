//! Looks up the light around the bodies for many rays at once, in single precision. It is the twin of
//! `Environment::radiance` in `crates/trace/src/environment.rs` and of `shaders/environment.wgsl`.

use super::backplate::{PacketBackplate, by_channel};
use super::lanes::{Lanes, Vectors};
use super::rays::SingleRay;
use crate::environment::{Environment, EnvironmentMap, HEAD_EDGE, STILL, TEXEL_ANGLE, wrapped};
use brillianteer_optics::Vector;
use glam::{DVec4, IVec2, Vec2, Vec3, Vec4};
use pulp::{Simd, WithSimd};

/// A ray of light that has left all bodies.
#[derive(Debug, Clone, Copy)]
pub(super) struct LookUpRay {
    /// The place where the light left the last body, in the world.
    pub origin: Vec3,
    /// The direction in the middle of the wavelengths that the ray represents.
    pub direction: Vec3,
    /// The change of the direction over these wavelengths and a stretch of the pixel.
    pub fan: Vec3,
    /// The displacement of the origin over the same wavelengths and stretch.
    pub shift: Vec3,
    pub weight: f32,
    pub tag: u32,
}

impl LookUpRay {
    /// Returns the look-up for light that has left all bodies along a ray of the world.
    pub fn of(ray: &SingleRay, weight: f32, tag: u32) -> Self {
        let &SingleRay { origin, direction, fan, shift, .. } = ray;
        Self { origin, direction, fan, shift, weight, tag }
    }
}

/// A ray from the eye as it would go on without any body: a point near the middle of the world, the unit direction,
/// and the changes of both over the stretch of the pixel that the ray represents.
#[derive(Debug, Clone, Copy)]
pub(super) struct StraightRay {
    pub near: Vec3,
    pub direction: Vec3,
    pub fan: Vec3,
    pub shift: Vec3,
}

/// The environment of a picture in single precision.
#[derive(Clone)]
pub(super) struct PacketEnvironment<'a> {
    map: &'a EnvironmentMap,
    /// The axes of the light's frame in the world.
    axes: [Vec3; 3],
    lamps: Vec<Lamp>,
    /// The direction to the eye.
    eye: Vec3,
    /// The cosine of the half angle of the observer's head; `None` without a head.
    head: Option<f32>,
    backplate: Option<PacketBackplate<'a>>,
}

#[derive(Clone, Copy)]
struct Lamp {
    toward: Vec3,
    chord_squared: f32,
    radiance: Vec4,
}

/// A look-up of many rays; the light of each is added to `light` at the ray's tag.
pub(super) struct LookUp<'a> {
    pub environment: &'a PacketEnvironment<'a>,
    pub rays: &'a [LookUpRay],
    /// The straight ray of each pixel. The pixel of a ray is the ray's tag divided by the number of bands.
    pub straight: &'a [StraightRay],
    pub bands: usize,
    /// The share of refraction's change of direction that is followed; see
    /// [`SamplePass::mixed`](crate::sampling::SamplePass::mixed).
    pub strength: f32,
    pub light: &'a mut [DVec4],
}

impl<'a> PacketEnvironment<'a> {
    pub fn new(environment: &Environment<'a>) -> Self {
        let lamps = environment.map.lamps.iter().map(|lamp| Lamp {
            toward: lamp.toward.as_vec3(),
            chord_squared: lamp.chord_squared as f32,
            radiance: lamp.radiance.as_vec4(),
        });
        let basis = &environment.basis;
        Self {
            map: environment.map,
            axes: [basis.right, basis.up, basis.toward].map(|axis| axis.as_vec3()),
            lamps: lamps.collect(),
            eye: environment.eye.toward.as_vec3(),
            head: (environment.head > 0.0).then(|| environment.head.cos() as f32),
            backplate: PacketBackplate::of(environment),
        }
    }

    /// Returns vectors of the world as vectors in the light's frame.
    #[inline(always)]
    fn own<S: Simd>(&self, simd: S, v: Vectors<S>) -> Vectors<S> {
        let [right, up, toward] = &self.axes;
        Vectors([
            Vectors::splat(simd, *right).dot(v),
            Vectors::splat(simd, *up).dot(v),
            Vectors::splat(simd, *toward).dot(v),
        ])
    }

    /// Returns the light of the map at a place, 0 to 1 along each side, averaged over this many texels.
    fn at(&self, at: Vec2, texels: f32) -> Vec4 {
        let level = texels.max(1.0).log2().min((self.map.levels.len() - 1) as f32);
        let (fine, part) = (level as usize, level.fract());
        let whole = self.level(at, fine);
        if part <= 0.0 {
            return whole;
        }
        whole + (self.level(at, fine + 1) - whole) * part
    }

    /// Interpolates one level of the map.
    fn level(&self, at: Vec2, level: usize) -> Vec4 {
        let size = (self.map.side >> level) as i32;
        let p = at * size as f32 - 0.5;
        let base = p.floor();
        let (part, base) = (p - base, base.as_ivec2());
        let texels = &self.map.levels[level];
        let texel = |p: IVec2| Vec4::from_array(texels[(p.y * size + p.x) as usize]);
        let is_inside = base.min_element() >= 0 && base.max_element() < size - 1;
        let corners = [IVec2::ZERO, IVec2::X, IVec2::Y, IVec2::ONE].map(|step| base + step);
        let [a, b, c, d] =
            if is_inside { corners.map(texel) } else { corners.map(|p| texel(wrapped(p, size))) };
        let (low, high) = (a + (b - a) * part.x, c + (d - c) * part.x);
        low + (high - low) * part.y
    }
}

impl WithSimd for LookUp<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        for chunk in self.rays.chunks(S::F32_LANES) {
            let mut ray = LookUpLanes {
                origin: Vectors::splat(simd, Vec3::ZERO),
                direction: Vectors::splat(simd, Vec3::Z),
                fan: Vectors::splat(simd, Vec3::ZERO),
                shift: Vectors::splat(simd, Vec3::ZERO),
            };
            for (lane, one) in chunk.iter().enumerate() {
                ray.origin.set_lane(lane, one.origin);
                ray.direction.set_lane(lane, one.direction);
                ray.fan.set_lane(lane, one.fan);
                ray.shift.set_lane(lane, one.shift);
            }
            if self.strength < 1.0 {
                ray = self.mixed(simd, chunk, ray);
            }
            self.look_up(simd, chunk, ray);
        }
    }
}

/// The rays along which light is looked up, one in each lane.
#[derive(Clone, Copy)]
struct LookUpLanes<S: Simd> {
    origin: Vectors<S>,
    direction: Vectors<S>,
    fan: Vectors<S>,
    shift: Vectors<S>,
}

impl LookUp<'_> {
    /// Returns the rays along which light is looked up below full strength. It is the twin of `SamplePass::mixed`.
    #[inline(always)]
    fn mixed<S: Simd>(&self, simd: S, chunk: &[LookUpRay], own: LookUpLanes<S>) -> LookUpLanes<S> {
        let (mut near, mut straight, mut fan, mut shift) = (own.origin, own.direction, own.fan, own.shift);
        for (lane, ray) in chunk.iter().enumerate() {
            let from_eye = self.straight[ray.tag as usize / self.bands];
            near.set_lane(lane, from_eye.near);
            straight.set_lane(lane, from_eye.direction);
            fan.set_lane(lane, from_eye.fan);
            shift.set_lane(lane, from_eye.shift);
        }
        let strength = Lanes::splat(simd, self.strength);
        let ahead = (own.origin - near).dot(straight);
        let (beside, moved) = (near + straight * ahead, shift + fan * ahead);
        let between = straight + (own.direction - straight) * strength;
        let per = strength.all(1.0) / between.length_squared().sqrt();
        let goes_on = own.direction.dot(straight).is_positive();
        LookUpLanes {
            origin: Vectors::select(goes_on, beside + (own.origin - beside) * strength, own.origin),
            direction: Vectors::select(goes_on, between * per, own.direction),
            fan: Vectors::select(goes_on, (fan + (own.fan - fan) * strength) * per, own.fan),
            shift: Vectors::select(goes_on, moved + (own.shift - moved) * strength, own.shift),
        }
    }

    /// Adds the light of rays: that of the backplate, and that of the environment for the rest of their wavelengths.
    #[inline(always)]
    fn look_up<S: Simd>(&mut self, simd: S, chunk: &[LookUpRay], ray: LookUpLanes<S>) {
        let mut beside = Lanes::splat(simd, 1.0);
        if let Some(backplate) = &self.environment.backplate {
            let seen = backplate.seen(simd, ray.origin, ray.direction, [ray.fan, ray.shift]);
            beside = beside - seen.share;
            for (lane, one) in chunk.iter().enumerate() {
                let light = by_channel(seen.light[lane]) * (seen.share.lane(lane) * one.weight);
                self.light[one.tag as usize] += light.as_dvec4();
            }
            if !beside.is_positive().any() {
                return;
            }
        }
        let environment = self.environment;
        let own = FannedLight {
            direction: environment.own(simd, ray.direction),
            fan: environment.own(simd, ray.fan),
        };
        let fanned = own.fan.length_squared().sqrt();
        let lamps = own.lamps(simd, &environment.lamps);
        let (x, y) = octahedral(own.direction);
        let texels =
            fanned * Lanes::splat(simd, (f64::from(environment.map.side as u32) / TEXEL_ANGLE) as f32);
        let clear = environment.beside_the_head(simd, ray.direction, fanned) * beside;
        for (lane, one) in chunk.iter().enumerate() {
            if clear.lane(lane) <= 0.0 {
                continue;
            }
            let at = Vec2::new(x.lane(lane), y.lane(lane));
            let lit =
                Vec4::new(lamps[0].lane(lane), lamps[1].lane(lane), lamps[2].lane(lane), lamps[3].lane(lane));
            let seen = (environment.at(at, texels.lane(lane)) + lit) * (clear.lane(lane) * one.weight);
            self.light[one.tag as usize] += seen.as_dvec4();
        }
    }
}

impl PacketEnvironment<'_> {
    /// Returns the share of the light that passes the observer's head. The edge of the head's shadow is as wide as
    /// the fan.
    #[inline(always)]
    fn beside_the_head<S: Simd>(&self, simd: S, direction: Vectors<S>, fanned: Lanes<S>) -> Lanes<S> {
        let (zero, one) = (Lanes::splat(simd, 0.0), Lanes::splat(simd, 1.0));
        let Some(head) = self.head else { return one };
        let cosine = direction.dot(Vectors::splat(simd, self.eye));
        let edge = fanned.max(Lanes::splat(simd, HEAD_EDGE as f32));
        let beside = (Lanes::splat(simd, head) - cosine) / edge + Lanes::splat(simd, 0.5);
        beside.max(zero).min(one)
    }
}

/// Directions in the light's frame, and their fans.
struct FannedLight<S: Simd> {
    direction: Vectors<S>,
    fan: Vectors<S>,
}

impl<S: Simd> FannedLight<S> {
    /// Returns the light of the lamps by channel; each lamp counts by the share of the fan that lies inside its disc.
    #[inline(always)]
    fn lamps(&self, simd: S, lamps: &[Lamp]) -> [Lanes<S>; 4] {
        let (zero, one, half) = (Lanes::splat(simd, 0.0), Lanes::splat(simd, 1.0), Lanes::splat(simd, 0.5));
        let still = Lanes::splat(simd, STILL as f32);
        let square = self.fan.length_squared();
        let is_fanned = still.less(square);
        let per_square = one / square.max(still);
        let mut light = [zero; 4];
        for lamp in lamps {
            let from_middle = self.direction - Vectors::splat(simd, lamp.toward);
            let chord_squared = Lanes::splat(simd, lamp.chord_squared);
            // The distance is computed from the nearest point, because the difference of large squares has no digits
            // in single precision.
            let nearest = is_fanned.select(-from_middle.dot(self.fan) * per_square, zero);
            let inside = chord_squared - (from_middle + self.fan * nearest).length_squared();
            let is_inside = inside.is_positive();
            if !is_inside.any() {
                continue;
            }
            let chord = (inside.max(zero) * per_square).sqrt();
            let along = ((nearest + chord).min(half) - (nearest - chord).max(-half)).max(zero);
            let share = is_inside.select(is_fanned.select(along, one), zero);
            for (light, radiance) in light.iter_mut().zip(lamp.radiance.to_array()) {
                *light = *light + share * Lanes::splat(simd, radiance);
            }
        }
        light
    }
}

/// Returns the places in the map of directions, 0 to 1 along each side.
#[inline(always)]
fn octahedral<S: Simd>(d: Vectors<S>) -> (Lanes<S>, Lanes<S>) {
    let one = d[0].all(1.0);
    let per = one / (d[0].abs() + d[1].abs() + d[2].abs());
    let (x, y) = (d[0] * per, d[1] * per);
    let below = d[2].is_negative();
    let (folded_x, folded_y) = (one - y.abs(), one - x.abs());
    let x = below.select(x.is_negative().select(-folded_x, folded_x), x);
    let y = below.select(y.is_negative().select(-folded_y, folded_y), y);
    (x * 0.5 + 0.5, y * 0.5 + 0.5)
}
