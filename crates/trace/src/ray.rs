//! Point rays: each ray follows the light of one point through a chain of bounces, in f64, and finds the same light
//! as beams do.
//!
//! A convex stone never takes back a ray that has left it, so a ray needs no branching: at every facet a part of the
//! light leaves and the rest goes on. Solids that are not convex are in `tree`. Rays know nothing of outlines or
//! symmetry, and follow polarisation as two fields, where beams follow a coherency matrix. So where rays and beams
//! agree, they hardly agree by a shared mistake.

mod camera;
mod dispersed_ray;
mod exit_planes;
mod facets;
mod first_bodies;
mod frosted_facets;
mod frosted_light;
mod instance_tracer;
mod light;
mod lobe_luck;
mod loss;
mod metal_tracer;
mod path;
mod roulette;
mod scene_tracer;
mod search;
mod sight;
mod tree;

pub use self::camera::Camera;
use self::facets::{FacetSearch, Planes, SmoothFacets, SolidFacets, TriangleFacets, Wavy};
pub use self::first_bodies::FirstBodies;
use self::frosted_facets::{Arriving, FrostedFacets, Struck};
pub use self::instance_tracer::InstanceTracer;
pub(crate) use self::light::PathLight;
use self::light::SplitLight;
use self::lobe_luck::LobeLuck;
pub use self::loss::Loss;
use self::path::{ExitLight, SurfaceEvent};
pub use self::path::{Leaving, Path, Step};
pub use self::roulette::Roulette;
pub(crate) use self::roulette::{ChainEnd, ChainRoulette};
pub use self::scene_tracer::{ByRays, First, SceneTracer, WaitingRay};
pub use self::sight::{ProbeRay, SceneProbe, facet_at};
use self::tree::Inbound;
use crate::DispersedRay;
use crate::dispersed_ray::{Arrival, Refraction};
use brillianteer_math::SolidRef;
use brillianteer_optics::{FrostedSurface, cos_transmitted};
use brillianteer_scene::Medium;
use glam::DVec3;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// The limits up to which a ray is followed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct RayOptions {
    /// True where polarisation is followed; otherwise every surface meets unpolarised light.
    pub polarised: bool,
    /// The most bounces inside the stone.
    pub most_bounces: u32,
    /// The weight at which a ray ends, a share of the light that the eye receives: the ray is followed while more
    /// than this is left.
    pub least_weight: f64,
}

impl Default for RayOptions {
    fn default() -> Self {
        Self { polarised: true, most_bounces: 1000, least_weight: 1e-6 }
    }
}

/// Light that leaves the stone at a facet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Exit {
    /// The facet, by its index in the solid.
    pub facet: u32,
    /// The point where the light leaves.
    pub point: DVec3,
    /// The length of the path inside the stone, in girdle radii.
    pub path: f64,
    /// The unit direction in which the light leaves.
    pub direction: DVec3,
    /// The change of that direction over the range that the ray represents: the medium's spread of indices, and a
    /// stretch of the pixel.
    pub fan: DVec3,
    /// The displacement of the point over the same range.
    pub shift: DVec3,
    /// The share of the light from that direction that reaches the eye.
    pub weight: f64,
    /// The number of the bounce at which the light leaves, from 1; 0 for the glare of the outer surface.
    pub bounce: u32,
    /// True for the glare of the outer surface, which is light that was never inside.
    pub surface: bool,
    /// The side, in radians, of the square of directions that the exit represents, because frosted facets spread
    /// light; 0 for one direction.
    pub spread: f64,
}

/// A ray that is known to meet a stone (see [`meet`](StoneTracer::meet)).
#[derive(Debug, Clone, Copy)]
pub struct MeetingRay {
    /// The facet that the ray meets, and the distance from the ray's origin.
    pub met: (usize, f64),
    /// The ray, with its change over the range that it represents.
    pub ray: DispersedRay,
    /// The share of the light from that direction that reaches the eye.
    pub weight: f64,
    /// The chance by which weak light goes on in a solid that is not convex; `None` where all light is followed.
    pub roulette: Option<Roulette>,
    /// The polarisation of the light, at any weight above 0; `None` where the light is not polarised. Where the ray
    /// starts through the stone, the light is scaled to `weight`.
    light: Option<PathLight>,
    /// The random numbers by which frosted facets scatter the light; `None` where light that meets such a facet
    /// counts as unresolved.
    luck: Option<LobeLuck>,
}

impl MeetingRay {
    /// Returns a ray from the eye.
    pub fn from_eye(met: (usize, f64), ray: DispersedRay) -> Self {
        Self { met, ray, weight: 1.0, roulette: None, light: None, luck: None }
    }
}

/// Follows single rays through one stone.
#[derive(Debug, Clone)]
pub struct StoneTracer {
    shape: SolidFacets,
    /// The frosted facets; `None` where all facets are polished.
    frosted: Option<Arc<FrostedFacets>>,
    medium: Medium,
    options: RayOptions,
}

impl StoneTracer {
    /// Prepares a stone for tracing.
    pub fn new<'a>(solid: impl Into<SolidRef<'a>>, medium: Medium, options: RayOptions) -> Self {
        let solid = solid.into();
        let frosted = FrostedFacets::of(solid).map(Arc::new);
        let shape = match solid {
            SolidRef::Convex(polytope) => SolidFacets::Planes(Arc::new(Planes::new(polytope))),
            SolidRef::Triangles(mesh) => SolidFacets::Triangles(TriangleFacets::new(mesh)),
            SolidRef::Smooth(smooth) if smooth.field().is_convex() => {
                SolidFacets::Smooth(SmoothFacets(*smooth.field()))
            }
            SolidRef::Smooth(smooth) => SolidFacets::Wavy(Wavy(*smooth.field())),
        };
        Self { shape, frosted, medium, options }
    }

    /// Returns a tracer of the same stone in another medium.
    pub fn made_of(&self, medium: Medium) -> Self {
        Self { medium, ..self.clone() }
    }

    /// Returns whether light that has left never meets the stone again. The result is false for all solids of
    /// triangles, even convex ones, because it is not known of them.
    pub fn is_convex(&self) -> bool {
        matches!(self.shape, SolidFacets::Planes(_) | SolidFacets::Smooth(_))
    }

    /// Returns whether a part of the stone hides a point of its surface from the eye. `way` is that point and the
    /// unit direction to the eye.
    pub fn hides_itself(&self, way: (DVec3, DVec3)) -> bool {
        match &self.shape {
            SolidFacets::Planes(_) | SolidFacets::Smooth(_) => false,
            SolidFacets::Triangles(triangles) => triangles.hides(way),
            SolidFacets::Wavy(wavy) => wavy.hides(way),
        }
    }

    /// Follows a ray from a point outside, and calls `leave` for the surface's glare and for each exit. `None` where
    /// the ray misses the stone.
    pub fn follow(&self, origin: DVec3, direction: DVec3, leave: impl FnMut(Exit)) -> Option<Loss> {
        let met = self.meet(origin, direction)?;
        self.follow_from(
            &MeetingRay::from_eye(met, DispersedRay::new(origin, direction)),
            |_, _| false,
            leave,
        )
    }

    /// Follows a ray that may have left another stone. `None` where the ray runs along the facet.
    ///
    /// Light that would enter this stone again after some distance leaves it for good where `is_taken` returns true,
    /// because another body is nearer.
    pub fn follow_from(
        &self,
        ray: &MeetingRay,
        is_taken: impl Fn(&Exit, f64) -> bool,
        mut leave: impl FnMut(Exit),
    ) -> Option<Loss> {
        self.follow_light(ray, &is_taken, &mut |exit, _| leave(exit))
    }

    /// Follows a ray as [`follow_from`](Self::follow_from) does. `leave` also receives the event at which the light
    /// leaves, which knows its polarisation ([`leaving_light`](Self::leaving_light)).
    pub(super) fn follow_light(
        &self,
        ray: &MeetingRay,
        is_taken: &dyn Fn(&Exit, f64) -> bool,
        leave: &mut dyn FnMut(Exit, &SurfaceEvent),
    ) -> Option<Loss> {
        // One chain is compiled for all callers, not one for each closure: an exit costs far less than the bounce before it.
        let start = self.start(ray);
        match &self.shape {
            SolidFacets::Planes(planes) => self.chain(&**planes, start, leave),
            SolidFacets::Smooth(smooth) => self.chain(smooth, start, leave),
            SolidFacets::Triangles(triangles) => self.branch(triangles, start, ray.roulette, is_taken, leave),
            SolidFacets::Wavy(wavy) => self.branch(wavy, start, ray.roulette, is_taken, leave),
        }
    }

    /// Follows light from a point inside a stone until at most `least_weight` of it is left, and calls `meets` for
    /// each facet. `path` is the length of the path so far; the light begins with the share that absorption has left
    /// along it. Light that leaves is not followed.
    pub(super) fn follow_inside(
        &self,
        (origin, direction): (DVec3, DVec3),
        (light, path): (PathLight, f64),
        least_weight: f64,
        meets: impl FnMut(SurfaceEvent),
    ) -> Loss {
        let ray = DispersedRay { origin, direction, fan: DVec3::ZERO, shift: DVec3::ZERO };
        let left = self.medium.transmittance(path);
        let inside = Inbound { met: (0, 0.0), ray, light, left, path, bounce: 0, luck: None };
        match &self.shape {
            SolidFacets::Planes(planes) => self.bounce(&**planes, inside, least_weight, meets),
            SolidFacets::Triangles(triangles) => self.bounce(triangles, inside, least_weight, meets),
            SolidFacets::Smooth(smooth) => self.bounce(smooth, inside, least_weight, meets),
            SolidFacets::Wavy(wavy) => self.bounce(wavy, inside, least_weight, meets),
        }
    }

    /// Follows light through a solid that never takes back light that has left it.
    fn chain<F: FacetSearch>(
        &self,
        facets: &F,
        start: Inbound,
        leave: &mut dyn FnMut(Exit, &SurfaceEvent),
    ) -> Option<Loss> {
        self.passage(facets, start, self.options.least_weight, |meeting| {
            if let Some(exit) = meeting.exit() {
                leave(exit, &meeting);
            }
        })
    }

    /// Returns the light of a ray that is about to enter.
    fn start(&self, meeting: &MeetingRay) -> Inbound {
        let &MeetingRay { met, ray, weight, light, luck, .. } = meeting;
        let light = match light {
            Some(light) => light.scaled_to(weight),
            None => PathLight::of_eye(ray.direction, weight, self.options.polarised),
        };
        Inbound { met, ray, light, left: 1.0, path: 0.0, bounce: 0, luck }
    }

    /// Follows light through the stone, from the facet where it enters until at most `least_weight` of it is left,
    /// and calls `meets` for each facet. All results of rays come from this one loop.
    fn passage<F: FacetSearch>(
        &self,
        facets: &F,
        inbound: Inbound,
        least_weight: f64,
        mut meets: impl FnMut(SurfaceEvent),
    ) -> Option<Loss> {
        let Inbound { met: (facet, distance), ray, left, path, bounce, .. } = inbound;
        let direction = ray.direction;
        let arrival = ray.arrival(facets, facet, distance);
        let Arrival { point, normal, .. } = arrival;
        let eta = 1.0 / self.medium.index;
        if let Some(surface) = self.frosted_surface(facet) {
            return Some(self.enter_frosted(
                (facets, surface),
                (point, normal),
                inbound,
                least_weight,
                meets,
            ));
        }
        let cos_i = -direction.dot(normal);
        let cos_t = cos_transmitted(cos_i, eta)?;
        let SplitLight { reflected: glare, passed: light } = inbound.light.split(direction, normal, eta);
        let of_eta = -self.medium.spread * eta * eta;
        let inward =
            ray.refracted(&arrival, &Refraction { eta: [eta, of_eta], cosines: (cos_i, cos_t) }, true);
        let back = ray.reflected(&arrival, cos_i, true);
        meets(SurfaceEvent {
            facet: facet as u32,
            point,
            normal,
            path,
            left,
            bounce,
            arriving: direction,
            light: &inbound.light,
            leaving: Some(ExitLight {
                direction: back.direction,
                fan: back.fan,
                shift: back.shift,
                weight: glare.weight() * left,
                spread: 0.0,
            }),
            onward: light.weight() * left,
        });
        Some(self.bounce(facets, Inbound { ray: inward, light, ..inbound }, least_weight, meets))
    }

    /// Returns the surface of a facet that is frosted; `None` where it is polished.
    fn frosted_surface(&self, facet: usize) -> Option<FrostedSurface> {
        self.frosted.as_ref()?.of_facet(facet)
    }

    /// Follows light inside the stone. Its ray begins at the point where the light has entered.
    fn bounce<F: FacetSearch>(
        &self,
        facets: &F,
        inside: Inbound,
        least_weight: f64,
        mut meets: impl FnMut(SurfaceEvent),
    ) -> Loss {
        let Inbound { mut ray, mut light, mut left, mut path, mut luck, .. } = inside;
        let mut rest = Loss { bounces: inside.bounce, ..Loss::default() };
        let mut remaining = light.weight() * left;
        // A ray that has no fan here, in a medium without spread, has none at the next facet either.
        let is_fanned = self.medium.spread != 0.0 || ray.is_fanned();
        while remaining > least_weight && rest.bounces < self.options.most_bounces {
            let (direction, index) = (ray.direction, self.medium.index);
            let Some((facet, distance)) = facets.next(ray.origin, direction) else { break };
            let arrival = ray.arrival(facets, facet, distance);
            let Arrival { point, normal, .. } = arrival;
            let cos_i = normal.dot(direction);
            path += distance;
            if !self.medium.is_clear() {
                let after = self.medium.transmittance(path);
                rest.absorbed += light.weight() * (left - after);
                left = after;
            }
            if let Some(surface) = self.frosted_surface(facet) {
                rest.bounces += 1;
                let arriving = Arriving { facet: facet as u32, point, normal, direction, path, left, light };
                match self.leave_frosted(surface, &arriving, rest.bounces, &mut luck, &mut meets) {
                    Struck::Inward(scattered, of_scattered) => {
                        (ray, light) = (scattered, of_scattered);
                        remaining = light.weight() * left;
                        continue;
                    }
                    Struck::Outward => remaining = 0.0,
                    Struck::Unresolved => remaining = light.weight() * left,
                }
                break;
            }
            let SplitLight { reflected: onward, passed } = light.split(direction, normal, index);
            let within = arrival.turned_over();
            let leaving = cos_transmitted(cos_i, index).map(|cos_t| {
                let out = Refraction { eta: [index, self.medium.spread], cosines: (cos_i, cos_t) };
                let DispersedRay { direction, fan, shift, .. } = ray.refracted(&within, &out, is_fanned);
                ExitLight { direction, fan, shift, weight: passed.weight() * left, spread: 0.0 }
            });
            rest.bounces += 1;
            remaining = onward.weight() * left;
            meets(SurfaceEvent {
                facet: facet as u32,
                point,
                normal,
                path,
                left,
                bounce: rest.bounces,
                arriving: direction,
                light: &light,
                leaving,
                onward: remaining,
            });
            (ray, light) = (ray.reflected(&within, cos_i, is_fanned), onward);
        }
        Loss { unresolved: remaining, ..rest }
    }

    /// Returns the polarisation of the light of an exit at this event, at the weight without absorption and chance;
    /// `None` where there is none that matters: where polarisation is not followed, and beyond a frosted facet.
    pub(super) fn leaving_light(&self, event: &SurfaceEvent, exit: &Exit) -> Option<PathLight> {
        if !self.options.polarised || exit.spread > 0.0 {
            return None;
        }
        event.onward_outside(self.medium.index)
    }

    /// Returns the facet and the distance at which a ray from outside enters; `None` where it misses.
    pub fn meet(&self, origin: DVec3, direction: DVec3) -> Option<(usize, f64)> {
        self.shape.entry(origin, direction)
    }
}
