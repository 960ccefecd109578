//! What pixels see of a scene under light, by packets of rays.

use super::environment::{LookUp, LookUpRay, PacketEnvironment};
use super::optics::PacketLight;
use super::outside::PacketInstance;
use super::rays::{EnteringRay, PacketMedium, SingleHit, SingleRay, Travelled};
use crate::trace::sampling::{LitScene, RadiancePixel, SamplePass, colour};
use glam::{DVec3, DVec4, Vec3};
use pulp::Arch;

/// Follows packets of rays through all bodies of a scene.
#[derive(Clone)]
pub(in crate::trace) struct PacketTracer<'a> {
    lit_scene: LitScene<'a>,
    instances: Vec<PacketInstance>,
    environment: PacketEnvironment<'a>,
    arch: Arch,
}

/// The most passages of light through bodies, one after the other; each time that it enters the same body counts. Light that
/// would enter once more is unresolved.
const MOST_PASSAGES: usize = 1000;

/// A ray from the eye: a point and the unit direction in which it runs.
type EyeRay = (DVec3, DVec3);

/// Some pixels that are being traced, each with one ray from the eye.
struct Pixels<'a> {
    pass: &'a SamplePass,
    eye_rays: &'a [EyeRay],
    /// The light of each pixel and band: the pixel's number times the number of bands, and the band.
    light: Vec<DVec4>,
    lit: Vec<RadiancePixel>,
    /// Of each body, in each band.
    media: Vec<Vec<PacketMedium>>,
}

/// A body that a ray meets first, and where.
#[derive(Clone, Copy)]
struct FirstHit {
    body: usize,
    /// The distance to it, in the world's unit.
    distance: f64,
    /// The ray in the body's frame.
    ray: SingleRay,
    met: SingleHit,
}

impl<'a> PacketTracer<'a> {
    /// The number of rays, over all bands, for which a processor's cache has room.
    pub const RAYS_AT_ONCE: usize = 1024;

    /// Prepares the bodies of a scene; `None` where one of them has triangles or is of metal.
    pub fn new(lit_scene: LitScene<'a>) -> Option<Self> {
        if !lit_scene.scene.metals.is_empty() {
            return None;
        }
        let instances = PacketInstance::of_all(&lit_scene.scene.instances)?;
        Some(Self {
            lit_scene,
            instances,
            environment: PacketEnvironment::new(&lit_scene.environment),
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
        let mut queues = self.seen_first(&mut pixels);
        for _ in 0..MOST_PASSAGES {
            if queues.iter().all(Vec::is_empty) {
                break;
            }
            let mut next = vec![vec![]; self.instances.len()];
            for (body, queue) in queues.iter().enumerate().filter(|(_, queue)| !queue.is_empty()) {
                self.pass_through(body, queue, &mut pixels, &mut next);
            }
            queues = next;
        }
        for entering in queues.iter().flatten() {
            pixels.lit[entering.ray.tag as usize / bands].unresolved +=
                f64::from(entering.ray.light.weight());
        }
        pixels.add_to(sums);
    }

    /// Returns, body by body, the rays that enter it straight from the eye.
    fn seen_first(&self, pixels: &mut Pixels) -> Vec<Vec<EnteringRay>> {
        let mut queues = vec![vec![]; self.instances.len()];
        let bands = pixels.pass.responses.len();
        let rays: Vec<SingleRay> = (0..).zip(pixels.eye_rays).map(|(tag, ray)| eye_ray(*ray, tag)).collect();
        let seen =
            |instance: &PacketInstance, _, place: usize| instance.seen(&rays[place], pixels.eye_rays[place]);
        let first = self.first(rays.len(), seen);
        for (pixel, first) in first.into_iter().enumerate() {
            let backdrop = self.lit_scene.environment.backdrop;
            if first.is_some() || backdrop {
                pixels.lit[pixel].cover = 1.0;
            }
            match first {
                Some(FirstHit { body, ray, met, .. }) => {
                    // The ray meets the body at the same point in all wavelengths.
                    let tags = (pixel * bands) as u32..;
                    queues[body].extend(
                        pixels.media[body].iter().zip(tags).map(|(&medium, tag)| EnteringRay {
                            ray: SingleRay { tag, ..ray },
                            met,
                            medium,
                        }),
                    );
                }
                None if backdrop => {
                    let (origin, direction) = pixels.eye_rays[pixel];
                    let seen = self.lit_scene.environment.radiance(origin, direction, DVec3::ZERO);
                    pixels.lit[pixel].colour = colour(&pixels.pass.whole, seen);
                }
                None => {}
            }
        }
        queues
    }

    /// Returns the bodies that some rays meet first. `arriving` carries a ray, given by its number, into the frame of a body,
    /// where it begins at a distance from its origin in the world; `None` where it cannot meet the body.
    fn first(
        &self,
        count: usize,
        arriving: impl Fn(&PacketInstance, usize, usize) -> Option<(SingleRay, f64)>,
    ) -> Vec<Option<FirstHit>> {
        let mut first: Vec<Option<FirstHit>> = vec![None; count];
        for (body, instance) in self.instances.iter().enumerate() {
            let (mut places, mut own) = (vec![], vec![]);
            for place in 0..count {
                if let Some((ray, before)) = arriving(instance, body, place) {
                    places.push((place, before));
                    own.push(ray);
                }
            }
            let met = instance.entries(self.arch, &own);
            for (((place, before), ray), met) in places.into_iter().zip(own).zip(met) {
                let distance = before + f64::from(met.distance * instance.unit());
                if distance.is_finite() && first[place].is_none_or(|first| distance < first.distance) {
                    first[place] = Some(FirstHit { body, distance, ray, met });
                }
            }
        }
        first
    }

    /// Follows rays through one body. Light that meets a body next is put into `next`; all else is looked up.
    fn pass_through(
        &self,
        body: usize,
        queue: &[EnteringRay],
        pixels: &mut Pixels,
        next: &mut [Vec<EnteringRay>],
    ) {
        let instance = &self.instances[body];
        let (mut leaving, losses) = instance.passage(self.arch, queue, self.lit_scene.options);
        let bands = pixels.pass.responses.len();
        for loss in losses {
            let lit = &mut pixels.lit[loss.tag as usize / bands];
            lit.absorbed += f64::from(loss.absorbed);
            lit.unresolved += f64::from(loss.unresolved);
        }
        leaving.iter_mut().for_each(|ray| *ray = instance.departing(ray));
        let mut to_look_up: Vec<LookUpRay> = Vec::with_capacity(leaving.len());
        let onward = |instance: &PacketInstance, other, place: usize| {
            let ray = &leaving[place];
            instance.may_meet(ray, other == body).then(|| (instance.arriving(ray), 0.0))
        };
        for (ray, first) in leaving.iter().zip(self.first(leaving.len(), onward)) {
            let (tag, weight) = (ray.tag as usize, ray.light.weight());
            match first {
                None => to_look_up.extend(self.looked_up(ray, pixels)),
                Some(FirstHit { body: then, mut ray, met, .. })
                    if f64::from(weight) > self.lit_scene.options.least_weight =>
                {
                    if then != body {
                        ray.travelled = Travelled::NONE;
                    }
                    next[then].push(EnteringRay { ray, met, medium: pixels.media[then][tag % bands] });
                }
                Some(_) => pixels.lit[tag / bands].unresolved += f64::from(weight),
            }
        }
        self.arch.dispatch(LookUp {
            environment: &self.environment,
            rays: &to_look_up,
            light: &mut pixels.light,
        });
    }

    /// Returns for what light that has left all bodies is looked up; `None` where all of it comes from the photograph behind
    /// them, whose light is added at once.
    fn looked_up(&self, ray: &SingleRay, pixels: &mut Pixels) -> Option<LookUpRay> {
        let (tag, weight) = (ray.tag as usize, ray.light.weight());
        let straight = pixels.eye_rays[tag / pixels.pass.responses.len()];
        let own = (ray.origin.as_dvec3(), ray.direction.as_dvec3(), ray.sweep.as_dvec3());
        let (from, direction, sweep) = pixels.pass.mixed(straight, own);
        let mut beside = 1.0;
        if let Some(seen) = self.lit_scene.environment.photograph(from, direction, sweep) {
            pixels.light[tag] += seen.light * f64::from(weight);
            beside -= seen.share as f32;
        }
        let ray = LookUpRay {
            direction: direction.as_vec3(),
            sweep: sweep.as_vec3(),
            weight: weight * beside,
            tag: ray.tag,
        };
        (beside > 0.0).then_some(ray)
    }
}

fn eye_ray((origin, direction): EyeRay, tag: u32) -> SingleRay {
    let direction = direction.as_vec3();
    SingleRay {
        origin: origin.as_vec3(),
        direction,
        sweep: Vec3::ZERO,
        shift: Vec3::ZERO,
        s: direction.any_orthonormal_vector(),
        light: PacketLight::<f32>::unpolarised(1.0),
        travelled: Travelled::NONE,
        tag,
    }
}

impl Pixels<'_> {
    /// Adds the light, as colours, to the sums of the pixels.
    fn add_to(self, sums: &mut [RadiancePixel]) {
        let bands = self.pass.responses.len();
        let share = 1.0 / bands as f64;
        for ((sum, lit), light) in sums.iter_mut().zip(&self.lit).zip(self.light.chunks(bands)) {
            sum.colour += lit.colour;
            for (response, light) in self.pass.responses.iter().zip(light) {
                sum.colour += colour(response, *light);
            }
            sum.cover += lit.cover;
            sum.unresolved += lit.unresolved * share;
            sum.absorbed += lit.absorbed * share;
        }
    }
}
