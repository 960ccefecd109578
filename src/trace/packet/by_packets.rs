//! What pixels see of convex bodies under light, by packets of rays.

use super::chain::Passage;
use super::planes::PacketPlanes;
use super::rays::{EnteringRay, LeavingRay, PacketLoss, PacketMedium};
use super::sky::{LookUp, PacketSky, SkyRay};
use crate::math::SolidRef;
use crate::trace::ray::{First, InstanceTracer, RayOptions, SceneTracer, WaitingRay};
use crate::trace::sampling::{LitScene, RadiancePixel, SamplePass};
use glam::{DVec3, DVec4};
use pulp::Arch;
use std::sync::Arc;

/// Follows packets of rays through all bodies of a scene.
#[derive(Clone)]
pub(in crate::trace) struct PacketTracer<'a> {
    lit_scene: LitScene<'a>,
    /// Finds where rays outside meet the bodies, in double precision.
    outside: SceneTracer,
    bodies: Vec<Arc<PacketPlanes>>,
    sky: PacketSky<'a>,
    arch: Arch,
}

/// A ray from the eye: a point and the unit direction in which it runs.
pub(in crate::trace) type EyeRay = (DVec3, DVec3);

/// Rays that are about to enter each body.
type Queues = Vec<Vec<EnteringRay>>;

/// Some pixels that are being traced, each with one ray from the eye.
struct Pixels<'a> {
    pass: &'a SamplePass,
    eye_rays: &'a [EyeRay],
    /// The light of each pixel and band: the pixel's number times the number of bands, and the band.
    light: Vec<DVec4>,
    lit: Vec<RadiancePixel>,
    media: Vec<Vec<PacketMedium>>,
}

impl<'a> PacketTracer<'a> {
    /// The number of rays, over all bands, for which a processor's cache has room.
    pub const RAYS_AT_ONCE: usize = 1024;

    /// Prepares the bodies of a scene; `None` where light that has left one of them may return.
    pub fn new(lit_scene: LitScene<'a>) -> Option<Self> {
        let instances = &lit_scene.scene.instances;
        let mut bodies: Vec<Arc<PacketPlanes>> = Vec::with_capacity(instances.len());
        for (place, instance) in instances.iter().enumerate() {
            let solid = instance.body.solid();
            let twin = instances[..place].iter().position(|other| other.body.solid().is_same(solid));
            bodies.push(match (twin, solid) {
                (Some(twin), _) => Arc::clone(&bodies[twin]),
                (None, SolidRef::Convex(polytope)) => Arc::new(PacketPlanes::new(polytope)),
                (None, SolidRef::Triangles(_) | SolidRef::Smooth(_)) => return None,
            });
        }
        Some(Self {
            lit_scene,
            outside: SceneTracer::new(&lit_scene),
            bodies,
            sky: PacketSky::new(&lit_scene.environment),
            arch: Arch::new(),
        })
    }

    /// Adds what pixels see, each along one ray from the eye, to their sums.
    pub fn see(&self, pass: &SamplePass, eye_rays: &[EyeRay], sums: &mut [RadiancePixel]) {
        let bands = pass.responses.len();
        let mut pixels = Pixels {
            pass,
            eye_rays,
            light: vec![DVec4::ZERO; eye_rays.len() * bands],
            lit: vec![RadiancePixel::default(); eye_rays.len()],
            media: pass.media.iter().map(|m| m.iter().map(PacketMedium::new).collect()).collect(),
        };
        let mut queues = self.entered_from_the_eye(&mut pixels);
        while queues.iter().any(|queue| !queue.is_empty()) {
            let mut next = vec![vec![]; self.bodies.len()];
            for (body, queue) in queues.iter().enumerate() {
                self.through(body, queue, &mut pixels, &mut next);
            }
            queues = next;
        }
        pixels.add_to(sums);
    }

    /// Returns the rays that enter bodies straight from the eye.
    fn entered_from_the_eye(&self, pixels: &mut Pixels) -> Queues {
        let mut queues = vec![vec![]; self.bodies.len()];
        let bands = pixels.pass.responses.len();
        for (pixel, &eye_ray) in pixels.eye_rays.iter().enumerate() {
            let start = WaitingRay::from_eye(eye_ray);
            let first = self.outside.first(&start);
            if first.is_some() || self.lit_scene.environment.backdrop {
                pixels.lit[pixel].cover = 1.0;
            }
            let Some(first) = first else {
                if self.lit_scene.environment.backdrop {
                    let seen = pixels.pass.seen(&self.lit_scene.environment, &start, eye_ray);
                    pixels.light[pixel * bands..][..bands].fill(seen);
                }
                continue;
            };
            // The ray meets the first body at the same point in all wavelengths.
            let entering = self.entering(&start, &first, pixels.media[first.stone()][0], 0);
            let rays = pixels.media[first.stone()].iter().zip(pixel * bands..);
            queues[first.stone()]
                .extend(rays.map(|(&medium, tag)| EnteringRay { medium, tag: tag as u32, ..entering }));
        }
        queues
    }

    /// Returns a ray that is about to enter the body that it meets first.
    fn entering(&self, ray: &WaitingRay, first: &First, medium: PacketMedium, tag: u32) -> EnteringRay {
        let arrival = self.outside.arrival(ray, first);
        EnteringRay {
            point: arrival.point.as_vec3(),
            normal: arrival.normal.as_vec3(),
            direction: arrival.direction.as_vec3(),
            sweep: arrival.sweep.as_vec3(),
            shift: arrival.shift.as_vec3(),
            of_normal: arrival.of_normal.as_vec3(),
            weight: ray.weight as f32,
            medium,
            tag,
        }
    }

    /// Follows rays through one body. Light that meets another one next is put into `next`; all else is looked up.
    fn through(&self, body: usize, queue: &[EnteringRay], pixels: &mut Pixels, next: &mut Queues) {
        let (mut leaving, mut losses): (Vec<LeavingRay>, Vec<PacketLoss>) = (vec![], vec![]);
        let options: RayOptions = self.lit_scene.options;
        self.arch.dispatch(Passage {
            surface: &*self.bodies[body],
            rays: queue,
            options,
            leaving: &mut leaving,
            losses: &mut losses,
        });
        let bands = pixels.pass.responses.len();
        for loss in losses {
            let lit = &mut pixels.lit[loss.tag as usize / bands];
            lit.absorbed += f64::from(loss.absorbed);
            lit.unresolved += f64::from(loss.unresolved);
        }
        let tracer: &InstanceTracer = self.outside.instance(body);
        let mut skyward: Vec<SkyRay> = Vec::with_capacity(leaving.len());
        for ray in leaving {
            let (tag, pixel) = (ray.tag as usize, ray.tag as usize / bands);
            let [point, direction, sweep] = [ray.point, ray.direction, ray.sweep].map(glam::Vec3::as_dvec3);
            let (origin, direction, sweep) = tracer.in_world((point, direction, sweep));
            let ray = WaitingRay::leaving(body, (origin, direction, sweep), f64::from(ray.weight));
            match self.outside.first(&ray) {
                None => {
                    let (from, direction, sweep) = pixels.pass.looked_up(&ray, pixels.eye_rays[pixel]);
                    match self.lit_scene.environment.photograph(from, direction) {
                        Some(seen) => pixels.light[tag] += seen * ray.weight,
                        None => skyward.push(SkyRay {
                            direction: direction.as_vec3(),
                            sweep: sweep.as_vec3(),
                            weight: ray.weight as f32,
                            tag: tag as u32,
                        }),
                    }
                }
                Some(first) if ray.weight > options.least_weight => {
                    let medium = pixels.media[first.stone()][tag % bands];
                    next[first.stone()].push(self.entering(&ray, &first, medium, tag as u32));
                }
                Some(_) => pixels.lit[pixel].unresolved += ray.weight,
            }
        }
        self.arch.dispatch(LookUp { sky: &self.sky, rays: &skyward, light: &mut pixels.light });
    }
}

impl Pixels<'_> {
    /// Adds the light, as colours, to the sums of the pixels.
    fn add_to(self, sums: &mut [RadiancePixel]) {
        let bands = self.pass.responses.len();
        let share = 1.0 / bands as f64;
        for ((sum, lit), light) in sums.iter_mut().zip(&self.lit).zip(self.light.chunks(bands)) {
            for (response, light) in self.pass.responses.iter().zip(light) {
                sum.colour += response.iter().zip(light.to_array()).map(|(&c, l)| c * l).sum::<DVec3>();
            }
            sum.cover += lit.cover;
            sum.unresolved += lit.unresolved * share;
            sum.absorbed += lit.absorbed * share;
        }
    }
}
