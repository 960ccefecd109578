//! Rays outside bodies, and the places where they meet the bodies of a scene.

use super::PacketSurface;
use super::chain::Passage;
use super::fields::PacketShape;
use super::lanes::Vectors;
use super::planes::PacketPlanes;
use super::rays::{EnteringRay, PacketLoss, SingleHit, SingleRay};
use crate::DispersedRay;
use crate::ray::RayOptions;
use brillianteer_math::{Ball, Pose, SolidRef};
use brillianteer_scene::Instance;
use glam::{Mat3, Vec3};
use pulp::{Arch, Simd, WithSimd};
use std::sync::Arc;

/// The surface of a body, in the body's frame.
#[derive(Clone)]
pub(super) enum PacketSolid {
    Planes(Arc<PacketPlanes>),
    Glass(PacketShape),
}

/// A body of a scene, with the pose that carries it into the world.
#[derive(Clone)]
pub(super) struct PacketInstance {
    solid: PacketSolid,
    /// True where light that has left the body may meet it again.
    branches: bool,
    pose: Pose,
    single: SinglePose,
    /// A ball around the body, in the world.
    ball: Ball,
    single_ball: SingleBall,
}

/// A [`Ball`] in single precision.
#[derive(Clone, Copy)]
struct SingleBall {
    middle: Vec3,
    radius: f32,
}

/// A bound on the part of a squared distance that single precision may lose.
const ROUNDING: f32 = 2e-6;

/// The greatest distance of a body from the middle of the world, in radii of the body. The rounding of its place is
/// then less than a ten-thousandth of its radius.
const FARTHEST: f64 = 1e3;

/// The distance before the middle of the ball around a body at which rays from the eye begin, in radii of the ball.
const ROUND_BALL: f64 = 1.01;

/// A [`Pose`] in single precision.
#[derive(Clone, Copy)]
struct SinglePose {
    at: Vec3,
    turn: Mat3,
    scale: f32,
}

impl From<Pose> for SinglePose {
    fn from(pose: Pose) -> Self {
        Self { at: pose.at.as_vec3(), turn: Mat3::from_quat(pose.turn.as_quat()), scale: pose.scale as f32 }
    }
}

impl PacketInstance {
    /// Prepares the bodies of a scene; `None` where one of them has triangles, or is too far away for single precision.
    pub fn of_all(instances: &[Instance]) -> Option<Vec<Self>> {
        let mut all: Vec<Self> = Vec::with_capacity(instances.len());
        for (place, instance) in instances.iter().enumerate() {
            let solid = instance.body.solid();
            let twin = instances[..place].iter().position(|other| other.body.solid().is_same(solid));
            let (solid, branches) = match (twin, solid) {
                (Some(twin), _) => (all[twin].solid.clone(), all[twin].branches),
                (None, SolidRef::Convex(polytope)) => {
                    (PacketSolid::Planes(Arc::new(PacketPlanes::new(polytope))), false)
                }
                (None, SolidRef::Smooth(smooth)) => {
                    let surface = smooth.field();
                    (PacketSolid::Glass(PacketShape::new(surface)), !surface.is_convex())
                }
                (None, SolidRef::Triangles(_)) => return None,
            };
            let (pose, ball) = (instance.pose, instance.solid().ball());
            if ball.middle.length() > FARTHEST * ball.radius {
                return None;
            }
            let single_ball =
                SingleBall { middle: ball.middle.as_vec3(), radius: ball.radius as f32 * (1.0 + ROUNDING) };
            all.push(Self { solid, branches, pose, single: pose.into(), ball, single_ball });
        }
        Some(all)
    }

    /// Returns whether a ray of the world may meet the body; `has_left` is true where the ray has just left the body.
    pub fn may_meet(&self, ray: &SingleRay, has_left: bool) -> bool {
        (!has_left || self.branches) && self.may_reach(ray)
    }

    /// Returns whether a ray of the world runs through the ball around the body, or might do so because of rounding.
    #[inline]
    fn may_reach(&self, ray: &SingleRay) -> bool {
        let SingleBall { middle, radius } = self.single_ball;
        let away = middle - ray.origin;
        let (along, square) = (away.dot(ray.direction), away.length_squared());
        along > -radius && square * (1.0 - ROUNDING) - along * along < radius * radius
    }

    /// Returns the length of the unit of the body's frame in the world.
    pub fn unit(&self) -> f32 {
        self.single.scale
    }

    /// Carries a ray from the eye into the frame of the body, in double precision, because the eye may be far away.
    /// The ray begins near the body; the second number is the distance from the eye to that beginning, in the world's
    /// unit. `None` where the ray misses.
    pub fn seen(&self, ray: &SingleRay, from_eye: &DispersedRay) -> Option<(SingleRay, f64)> {
        let &DispersedRay { origin: eye, direction, .. } = from_eye;
        if !self.ball.is_met(eye, direction) {
            return None;
        }
        let before = ((self.ball.middle - eye).dot(direction) - self.ball.radius * ROUND_BALL).max(0.0);
        let back = self.pose.turn.inverse();
        let near = from_eye.ahead(before);
        let own = SingleRay {
            origin: self.pose.unplace(near.origin).as_vec3(),
            direction: (back * direction).as_vec3(),
            fan: (back * near.fan).as_vec3(),
            shift: (back * near.shift / self.pose.scale).as_vec3(),
            s: (back * ray.s.as_dvec3()).as_vec3(),
            ..*ray
        };
        Some((own, before))
    }

    /// Carries a ray of the world into the frame of the body.
    pub fn arriving(&self, ray: &SingleRay) -> SingleRay {
        let SinglePose { at, turn, scale } = self.single;
        let back = turn.transpose();
        SingleRay {
            origin: back * (ray.origin - at) / scale,
            direction: back * ray.direction,
            fan: back * ray.fan,
            shift: back * ray.shift / scale,
            s: back * ray.s,
            ..*ray
        }
    }

    /// Carries a ray of the body's frame into the world.
    pub fn departing(&self, ray: &SingleRay) -> SingleRay {
        let SinglePose { at, turn, scale } = self.single;
        SingleRay {
            origin: turn * ray.origin * scale + at,
            direction: turn * ray.direction,
            fan: turn * ray.fan,
            shift: turn * ray.shift * scale,
            s: turn * ray.s,
            ..*ray
        }
    }

    /// Returns the places where rays of the body's frame enter the body.
    pub fn entries(&self, arch: Arch, rays: &[SingleRay]) -> Vec<SingleHit> {
        match &self.solid {
            PacketSolid::Planes(planes) => arch.dispatch(Entries { surface: &**planes, rays }),
            PacketSolid::Glass(shape) => arch.dispatch(Entries { surface: shape, rays }),
        }
    }

    /// Follows rays through the body. Returns the light that leaves, in the body's frame, and the light that does not
    /// leave.
    pub fn passage(
        &self,
        arch: Arch,
        rays: &[EnteringRay],
        (options, threshold): (RayOptions, f32),
    ) -> (Vec<SingleRay>, Vec<PacketLoss>) {
        let (mut outer, mut lost) = (vec![], vec![]);
        let (leaving, losses) = (&mut outer, &mut lost);
        match &self.solid {
            PacketSolid::Planes(planes) => {
                arch.dispatch(Passage { surface: &**planes, rays, options, threshold, leaving, losses });
            }
            PacketSolid::Glass(shape) => {
                arch.dispatch(Passage { surface: shape, rays, options, threshold, leaving, losses });
            }
        }
        (outer, lost)
    }
}

/// A search for the points where rays enter a body.
struct Entries<'a, P> {
    surface: &'a P,
    rays: &'a [SingleRay],
}

impl<P: PacketSurface> WithSimd for Entries<'_, P> {
    type Output = Vec<SingleHit>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Vec<SingleHit> {
        let mut found = Vec::with_capacity(self.rays.len());
        for chunk in self.rays.chunks(S::F32_LANES) {
            let mut origin = Vectors::splat(simd, Vec3::NAN);
            let mut direction = origin;
            for (lane, ray) in chunk.iter().enumerate() {
                origin.set_lane(lane, ray.origin);
                direction.set_lane(lane, ray.direction);
            }
            let met = self.surface.entry(simd, origin, direction);
            for lane in 0..chunk.len() {
                found.push(SingleHit { distance: met.distance.lane(lane), normal: met.normal.lane(lane) });
            }
        }
        found
    }
}
