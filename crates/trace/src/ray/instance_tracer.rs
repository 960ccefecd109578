//! Follows rays through one stone at its place in the world. Rays are carried into the frame of the stone's body, and
//! the light that leaves is carried back.

use super::{Exit, Loss, MeetingRay, PathLight, RayOptions, StoneTracer};
use crate::DispersedRay;
use brillianteer_math::{Ball, Pose};
use brillianteer_scene::{Instance, Medium};
use glam::DVec3;

/// The tracer of a stone's body, and the pose that carries the body into the world.
#[derive(Debug, Clone)]
pub struct InstanceTracer {
    tracer: StoneTracer,
    /// The pose; `None` where the body lies in the world as it was built. Its rays are then not carried, so that no
    /// digit changes.
    pose: Option<Pose>,
    /// A ball around the stone, in the world.
    ball: Ball,
}

impl InstanceTracer {
    /// Prepares the stones of a scene, each in the medium that `medium` gives; stones of one body share what is built for it.
    pub fn of_all(
        instances: &[Instance],
        options: RayOptions,
        medium: impl Fn(&Instance) -> Medium,
    ) -> Vec<Self> {
        let mut all: Vec<Self> = Vec::with_capacity(instances.len());
        for stone in instances {
            let solid = stone.body.solid();
            let twin = instances.iter().zip(&all).find(|(other, _)| other.body.solid().is_same(solid));
            let tracer = match twin {
                Some((_, twin)) => twin.tracer.made_of(medium(stone)),
                None => StoneTracer::new(solid, medium(stone), options),
            };
            let pose = Some(stone.pose).filter(|pose| *pose != Pose::STILL);
            all.push(Self { tracer, pose, ball: stone.solid().ball() });
        }
        all
    }

    /// Returns a tracer of the same stone in another medium.
    pub fn made_of(&self, medium: Medium) -> Self {
        Self { tracer: self.tracer.made_of(medium), ..self.clone() }
    }

    /// Returns whether light that has left never meets the stone again; see [`StoneTracer::is_convex`].
    pub fn is_convex(&self) -> bool {
        self.tracer.is_convex()
    }

    /// Returns whether the stone has frosted facets, at which chance decides the direction of the light.
    pub(super) fn is_frosted(&self) -> bool {
        self.tracer.is_frosted()
    }

    /// Returns whether a ray runs through the ball around the stone.
    pub(super) fn is_near(&self, (origin, direction): (DVec3, DVec3)) -> bool {
        self.ball.is_met(origin, direction)
    }

    /// Returns whether a part of the stone hides a point of its surface from the eye. `way` is that point and the
    /// unit direction to the eye.
    pub fn hides_itself(&self, way: (DVec3, DVec3)) -> bool {
        self.tracer.hides_itself(self.arriving(way))
    }

    /// Returns the facet and the distance at which a ray from outside enters; `None` where it misses.
    pub fn meet(&self, origin: DVec3, direction: DVec3) -> Option<(usize, f64)> {
        let (origin, direction) = self.arriving((origin, direction));
        let (facet, distance) = self.tracer.meet(origin, direction)?;
        Some((facet, distance * self.unit()))
    }

    /// Follows a ray through the stone as [`StoneTracer::follow_from`] does; all rays and exits are in the world.
    pub fn follow_from(
        &self,
        ray: &MeetingRay,
        is_taken: impl Fn(&Exit, f64) -> bool,
        mut leave: impl FnMut(Exit),
    ) -> Option<Loss> {
        self.follow_light(ray, is_taken, |exit, _| leave(exit))
    }

    /// Follows a ray as [`follow_from`](Self::follow_from) does. The second argument of `leave` computes the light of the
    /// exit, where it is needed; see [`StoneTracer::leaving_light`].
    pub(super) fn follow_light(
        &self,
        ray: &MeetingRay,
        is_taken: impl Fn(&Exit, f64) -> bool,
        mut leave: impl FnMut(Exit, &dyn Fn() -> Option<PathLight>),
    ) -> Option<Loss> {
        let (facet, distance) = ray.met;
        let own = self.own(&ray.ray);
        let light = ray.light.map(|light| light.carried(|v| self.own_vector(v)));
        let ray = MeetingRay { met: (facet, distance / self.unit()), ray: own, light, ..*ray };
        let is_taken = |exit: &Exit, distance: f64| is_taken(&self.outward(*exit), distance * self.unit());
        self.tracer.follow_light(&ray, &is_taken, &mut |exit, event| {
            let light = || Some(self.tracer.leaving_light(event, &exit)?.carried(|v| self.world_vector(v)));
            leave(self.outward(exit), &light);
        })
    }

    /// Rotates a vector of the world into the frame of the body.
    fn own_vector(&self, v: DVec3) -> DVec3 {
        self.pose.map_or(v, |pose| pose.turn.inverse() * v)
    }

    /// Rotates a vector of the body's frame into the world.
    fn world_vector(&self, v: DVec3) -> DVec3 {
        self.pose.map_or(v, |pose| pose.turn * v)
    }

    /// Returns the length in the world of the unit of the body's frame.
    fn unit(&self) -> f64 {
        self.pose.map_or(1.0, |pose| pose.scale)
    }

    /// Carries a ray into the frame of the body.
    fn arriving(&self, (origin, direction): (DVec3, DVec3)) -> (DVec3, DVec3) {
        let Some(pose) = &self.pose else { return (origin, direction) };
        (pose.unplace(origin), self.own_vector(direction))
    }

    /// Carries a ray, with its fan and its shift, into the frame of the body.
    fn own(&self, ray: &DispersedRay) -> DispersedRay {
        let Some(pose) = &self.pose else { return *ray };
        let (origin, direction) = self.arriving((ray.origin, ray.direction));
        let (fan, shift) = (self.own_vector(ray.fan), self.own_vector(ray.shift) / pose.scale);
        DispersedRay { origin, direction, fan, shift }
    }

    /// Carries light that leaves the body into the world.
    #[inline]
    fn outward(&self, exit: Exit) -> Exit {
        let Some(pose) = &self.pose else { return exit };
        Exit {
            point: pose.place(exit.point),
            path: exit.path * pose.scale,
            direction: self.world_vector(exit.direction),
            fan: self.world_vector(exit.fan),
            shift: self.world_vector(exit.shift) * pose.scale,
            ..exit
        }
    }
}
