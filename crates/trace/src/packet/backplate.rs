//! The picture behind the bodies, for packets of rays in single precision. It is the twin of `Backplate::at` in
//! `crates/trace/src/environment/backplate.rs` and of `photo_at` in `shaders/environment.wgsl`.

use super::lanes::{Lanes, MOST_LANES, Vectors};
use crate::environment::{ALONG, Backplate, Environment};
use brillianteer_scene::Mipmap;
use glam::{Vec2, Vec3, Vec4};
use pulp::Simd;

/// The least stretch across the picture, in pixels, which prevents divisions by 0.
const LEAST_STRETCH: f32 = 1e-20;

/// The least height above the picture, which prevents divisions by 0.
const LEAST_HEIGHT: f32 = 1e-20;

/// A picture on a plane behind the bodies, with its axes in pixels.
#[derive(Clone)]
pub(super) struct PacketBackplate<'a> {
    picture: &'a Mipmap,
    /// The width and the height of the picture in pixels.
    size: Vec2,
    /// The directions across and down the picture; their length is the number of pixels per world unit.
    across: Vec3,
    down: Vec3,
    /// The unit direction to the eye.
    toward: Vec3,
    /// The distance of the plane behind the origin.
    distance: f32,
}

/// The light of the picture along each ray.
pub(super) struct SeenStretch<S: Simd> {
    /// The share of the wavelengths of each ray that meets the picture, 0 to 1.
    pub share: Lanes<S>,
    /// The mean light of that share: red, green and blue.
    pub light: [Vec3; MOST_LANES],
}

/// Rays that run to the plane of the picture, in pixels of the picture.
struct Projection<S: Simd> {
    start: [Lanes<S>; 2],
    way: [Lanes<S>; 2],
    turn: [Lanes<S>; 2],
    height: Lanes<S>,
    speed: Lanes<S>,
    faster: Lanes<S>,
}

impl<S: Simd> Projection<S> {
    /// Returns the speed at which the rays approach the plane at a part of their fan, from -0.5 to 0.5.
    #[inline(always)]
    fn speed_at(&self, part: Lanes<S>) -> Lanes<S> {
        self.speed + self.faster * part
    }

    /// Returns the places where the rays meet the picture at a part of their fan, in pixels from the middle of the
    /// first.
    #[inline(always)]
    fn place(&self, part: Lanes<S>) -> [Lanes<S>; 2] {
        let far = self.height / self.speed_at(part).max(part.all(ALONG as f32));
        [
            self.start[0] + (self.way[0] + self.turn[0] * part) * far,
            self.start[1] + (self.way[1] + self.turn[1] * part) * far,
        ]
    }
}

impl<'a> PacketBackplate<'a> {
    /// Converts the backplate of an environment; `None` where it has none.
    pub fn of(environment: &Environment<'a>) -> Option<Self> {
        let Backplate { picture, distance, width } = environment.backplate?;
        let (eye, whole) = (&environment.eye, picture.picture());
        let scale = f64::from(whole.width) / width;
        Some(Self {
            picture,
            size: Vec2::new(whole.width as f32, whole.height as f32),
            across: (eye.right * scale).as_vec3(),
            down: (eye.up * -scale).as_vec3(),
            toward: eye.toward.as_vec3(),
            distance: distance as f32,
        })
    }

    /// Returns the light of the picture along rays of the world, as the mean over the fan and the shift of each.
    #[inline(always)]
    pub fn seen<S: Simd>(
        &self,
        simd: S,
        from: Vectors<S>,
        direction: Vectors<S>,
        [fan, shift]: [Vectors<S>; 2],
    ) -> SeenStretch<S> {
        let (zero, one, half) = (Lanes::splat(simd, 0.0), Lanes::splat(simd, 1.0), Lanes::splat(simd, 0.5));
        let along = one.all(ALONG as f32);
        let fan = self.fan_onto_plane(simd, from, direction, [fan, shift]);
        let rays = self.projected(simd, from, direction, fan);
        // The part of the fan that runs toward the plane.
        let (low, high) = (rays.speed_at(-half), rays.speed_at(half));
        let comes = zero.less(rays.height) & along.less(low.max(high));
        let (first, last) = (meets(along, low, high) - half, half - meets(along, high, low));
        let (start, end) = (rays.place(first), rays.place(last));
        let [enters, leaves] = self.inside(&start, &end);
        // The line is seen in perspective, so parts of its length are converted to parts of the fan. Where a fan is
        // wide, rounding may take all of a low speed, hence the limit.
        let speeds = [rays.speed_at(first).max(along), rays.speed_at(last).max(along)];
        let begin = first + (last - first) * of_fan(enters, speeds);
        let finish = first + (last - first) * of_fan(leaves, speeds);
        let (dx, dy) = (end[0] - start[0], end[1] - start[1]);
        let straight = (dx * dx + dy * dy).sqrt();
        let stays = straight.at_most(zero);
        let is_in = comes & enters.at_most(leaves) & straight.less(one.all(f32::INFINITY));
        let share = is_in.select(stays.select(one, (finish - begin).max(zero).min(one)), zero);
        let light = self.mean(&rays, &share, [begin, finish], straight * (leaves - enters));
        SeenStretch { share, light }
    }

    /// Returns fans by which rays cover, to first order, the same stretches of the picture's plane as by their fans
    /// and shifts together. It is the twin of the function with the same name in
    /// `crates/trace/src/environment/backplate.rs`.
    #[inline(always)]
    fn fan_onto_plane<S: Simd>(
        &self,
        simd: S,
        from: Vectors<S>,
        direction: Vectors<S>,
        [fan, shift]: [Vectors<S>; 2],
    ) -> Vectors<S> {
        let toward = Vectors::splat(simd, self.toward);
        let height = toward.dot(from) + self.distance;
        let along = shift * -toward.dot(direction) + direction * toward.dot(shift);
        // The limit does not matter for rays that do not approach the plane, because they do not see it.
        fan + along * (height.all(1.0) / height.max(height.all(LEAST_HEIGHT)))
    }

    #[inline(always)]
    fn projected<S: Simd>(
        &self,
        simd: S,
        from: Vectors<S>,
        direction: Vectors<S>,
        fan: Vectors<S>,
    ) -> Projection<S> {
        let (across, down) = (Vectors::splat(simd, self.across), Vectors::splat(simd, self.down));
        let toward = Vectors::splat(simd, self.toward);
        let middle = self.size * 0.5 - 0.5;
        Projection {
            start: [across.dot(from) + middle.x, down.dot(from) + middle.y],
            way: [across.dot(direction), down.dot(direction)],
            turn: [across.dot(fan), down.dot(fan)],
            height: toward.dot(from) + self.distance,
            speed: -toward.dot(direction),
            faster: -toward.dot(fan),
        }
    }

    /// Returns the parts, 0 to 1, of lines at which they enter the picture and leave it. Where a line misses, the
    /// first part is the greater.
    #[inline(always)]
    fn inside<S: Simd>(&self, start: &[Lanes<S>; 2], end: &[Lanes<S>; 2]) -> [Lanes<S>; 2] {
        let mut parts = [start[0].all(0.0), start[0].all(1.0)];
        for axis in 0..2 {
            let size = self.size[axis];
            let way = end[axis] - start[axis];
            let way = way.abs().max(way.all(LEAST_STRETCH)).times_sign_of(way);
            let (a, b) = ((-start[axis] - 0.5) / way, (-start[axis] + (size - 0.5)) / way);
            parts = [parts[0].max(a.min(b)), parts[1].min(a.max(b))];
        }
        parts
    }

    /// Returns the mean light along the stretch of each ray whose share is not 0, as [`Mipmap::along`] does.
    /// `lengths` are the lengths of the stretches in pixels.
    #[inline(always)]
    fn mean<S: Simd>(
        &self,
        rays: &Projection<S>,
        share: &Lanes<S>,
        [begin, finish]: [Lanes<S>; 2],
        lengths: Lanes<S>,
    ) -> [Vec3; MOST_LANES] {
        let mut light = [Vec3::ZERO; MOST_LANES];
        let mut levels = [0; MOST_LANES];
        let (mut per, mut most) = (begin.all(0.0), 0);
        let mut taps = [0_u32; MOST_LANES];
        for lane in 0..S::F32_LANES {
            if !share.lane(lane).is_normal() {
                continue;
            }
            (levels[lane], taps[lane]) = self.picture.taps(lengths.lane(lane));
            per.set_lane(lane, 1.0 / taps[lane] as f32);
            most = most.max(taps[lane]);
        }
        for tap in 0..most {
            let part = begin + (finish - begin) * (per * (tap as f32 + 0.5));
            let [x, y] = rays.place(part);
            for lane in 0..S::F32_LANES {
                if tap < taps[lane] {
                    light[lane] += self.picture.near(levels[lane], Vec2::new(x.lane(lane), y.lane(lane)));
                }
            }
        }
        for (light, per) in light.iter_mut().zip(per.as_slice()) {
            *light *= *per;
        }
        light
    }
}

/// Returns the part of a fan at which rays begin to run toward the plane, counted from the end with speed `of` toward
/// the end with speed `other`; 0 where the whole fan runs toward the plane.
#[inline(always)]
fn meets<S: Simd>(along: Lanes<S>, of: Lanes<S>, other: Lanes<S>) -> Lanes<S> {
    along.less(of).select(of.all(0.0), (along - of) / (other - of))
}

/// Returns the part of a fan that corresponds to a part of its line across the picture, from the speeds at both ends.
#[inline(always)]
fn of_fan<S: Simd>(line: Lanes<S>, [slow, fast]: [Lanes<S>; 2]) -> Lanes<S> {
    let (near, far) = (line * slow, (line.all(1.0) - line) * fast);
    near / (near + far)
}

/// Returns the light of a photograph by channel; it has none in the channel of the key illuminant.
#[inline(always)]
pub(super) fn by_channel(light: Vec3) -> Vec4 {
    Vec4::new(0.0, light.x, light.y, light.z)
}
