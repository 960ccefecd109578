//! Computes the light that pixels receive from a scene, by packets of rays.

use super::environment::{LookUp, LookUpRay, PacketEnvironment, StraightRay};
use super::outside::PacketInstance;
use super::rays::{EnteringRay, PacketMedium, SingleHit, SingleRay, Travelled};
use crate::DispersedRay;
use crate::coherency::Coherency;
use crate::ray::RayOptions;
use crate::sampling::{LitScene, RadiancePixel, SamplePass, colour};
use glam::DVec4;
use pulp::Arch;

/// Follows packets of rays through all bodies of a scene.
#[derive(Clone)]
pub(crate) struct PacketTracer<'a> {
    lit_scene: LitScene<'a>,
    instances: Vec<PacketInstance>,
    environment: PacketEnvironment<'a>,
    arch: Arch,
}

/// The greatest number of passages of light through bodies, one after the other; each entry into the same body
/// counts. Light that would enter once more counts as unresolved.
const MOST_PASSAGES: usize = 1000;

/// A bit that the number of an exit never has. It marks the random number that decides whether weak light enters
/// another body.
const ENTERS: u64 = 1 << 31;

/// A ray from the eye through a pixel.
#[derive(Debug, Clone, Copy)]
pub(crate) struct EyeRay {
    /// The column and the row of the pixel.
    pub pixel: [u32; 2],
    pub ray: DispersedRay,
}

/// Some pixels that are being traced, each with one ray from the eye.
struct Pixels<'a> {
    pass: &'a SamplePass,
    eye_rays: &'a [EyeRay],
    straight: Vec<StraightRay>,
    /// The light of each pixel and band, at the pixel's number times the number of bands, plus the band's number.
    light: Vec<DVec4>,
    lit: Vec<RadiancePixel>,
    /// The media of each body, band by band.
    media: Vec<Vec<PacketMedium>>,
}

/// The first body that a ray meets, and the place where it meets the body.
#[derive(Clone, Copy)]
struct FirstHit {
    body: usize,
    /// The distance along the ray to the body, in the world's unit.
    distance: f64,
    /// The ray in the body's frame.
    ray: SingleRay,
    met: SingleHit,
}

impl<'a> PacketTracer<'a> {
    /// The number of rays, over all bands, that fit in a processor's cache.
    pub const RAYS_AT_ONCE: usize = 1024;

    /// Prepares the bodies of a scene; `None` where one of them has triangles or frosted facets, is of metal, or is
    /// too far away for single precision.
    pub fn new(lit_scene: LitScene<'a>) -> Option<Self> {
        if !lit_scene.scene.metals.is_empty() || lit_scene.scene.is_frosted() {
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

    /// Adds the light of pixels, each along one ray from the eye, to their sums.
    pub fn see(&self, pass: &SamplePass, eye_rays: &[EyeRay], sums: &mut [RadiancePixel]) {
        let bands = pass.responses.len();
        let mut pixels = Pixels {
            pass,
            eye_rays,
            straight: eye_rays.iter().map(EyeRay::straight).collect(),
            light: vec![DVec4::ZERO; eye_rays.len() * bands],
            lit: vec![RadiancePixel::default(); eye_rays.len()],
            media: pass.media.iter().map(|m| m.iter().map(PacketMedium::new).collect()).collect(),
        };
        let mut queues = self.seen_first(&mut pixels);
        for passage in 1..=MOST_PASSAGES as u64 {
            if queues.iter().all(Vec::is_empty) {
                break;
            }
            let mut next = vec![vec![]; self.instances.len()];
            for (body, queue) in queues.iter().enumerate().filter(|(_, queue)| !queue.is_empty()) {
                self.pass_through((body, queue), passage, &mut pixels, &mut next);
            }
            queues = next;
        }
        for entering in queues.iter().flatten() {
            pixels.lit[entering.ray.tag as usize / bands].unresolved +=
                f64::from(entering.ray.light.weight());
        }
        pixels.add_to(sums);
    }

    /// Returns the number of the body that each ray from the eye meets first; `None` where it meets none.
    pub fn first_bodies(&self, eye_rays: &[EyeRay]) -> Vec<Option<u32>> {
        let first = self.first_from_eye(eye_rays);
        first.into_iter().map(|hit| hit.map(|hit| hit.body as u32)).collect()
    }

    fn first_from_eye(&self, eye_rays: &[EyeRay]) -> Vec<Option<FirstHit>> {
        let rays: Vec<SingleRay> = (0..).zip(eye_rays).map(|(tag, ray)| eye_ray(ray, tag)).collect();
        let seen =
            |instance: &PacketInstance, _, place: usize| instance.seen(&rays[place], &eye_rays[place].ray);
        self.first(rays.len(), seen)
    }

    /// Returns, body by body, the rays that enter the body straight from the eye.
    fn seen_first(&self, pixels: &mut Pixels) -> Vec<Vec<EnteringRay>> {
        let mut queues = vec![vec![]; self.instances.len()];
        let bands = pixels.pass.responses.len();
        let first = self.first_from_eye(pixels.eye_rays);
        for (pixel, first) in first.into_iter().enumerate() {
            let backdrop = self.lit_scene.environment.backdrop;
            if first.is_some() || backdrop {
                pixels.lit[pixel].cover = 1.0;
            }
            match first {
                Some(FirstHit { body, ray, met, .. }) => {
                    // The ray meets the body at the same point at all wavelengths.
                    let tags = (pixel * bands) as u32..;
                    queues[body].extend(pixels.media[body].iter().zip(tags).map(|(&medium, tag)| {
                        EnteringRay { ray: SingleRay { tag, ..ray }, met, medium, luck: pixels.luck(tag, 0) }
                    }));
                }
                None if backdrop => {
                    let seen = self.lit_scene.environment.radiance_around(&pixels.eye_rays[pixel].ray, 0.0);
                    pixels.lit[pixel].colour = colour(&pixels.pass.whole, seen);
                }
                None => {}
            }
        }
        queues
    }

    /// Returns the first body that each of some rays meets. `arriving` carries a ray, given by its number, into the
    /// frame of a body. Its second result is the distance at which the carried ray begins, from the ray's origin in
    /// the world. `None` where the ray cannot meet the body.
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

    /// Follows rays through one body; `passage` is the number of this passage of their light. Light that meets a body
    /// next is added to `next`, and all other light is looked up in the environment.
    fn pass_through(
        &self,
        (body, queue): (usize, &[EnteringRay]),
        passage: u64,
        pixels: &mut Pixels,
        next: &mut [Vec<EnteringRay>],
    ) {
        let instance = &self.instances[body];
        let threshold = pixels.threshold(self.lit_scene.options);
        let (mut leaving, losses) = instance.passage(self.arch, queue, (self.lit_scene.options, threshold));
        let bands = pixels.pass.responses.len();
        for loss in losses {
            let lit = &mut pixels.lit[loss.tag as usize / bands];
            lit.absorbed += f64::from(loss.absorbed);
            lit.unresolved += f64::from(loss.unresolved);
        }
        leaving.iter_mut().for_each(|ray| *ray = instance.departing(ray));
        let from = Departure { body, passage };
        if passage > 1 {
            self.go_on(from, &leaving, pixels, next);
            return;
        }
        // The glare of rays from the eye comes first, band by band, and takes the same path in all bands.
        let (glare, rest) = leaving.split_at(queue.len());
        let meets = self.shared(from, glare, pixels);
        self.go_on(from, &meets, pixels, next);
        self.go_on(from, rest, pixels, next);
    }

    /// Adds the light of the first glare of pixels, looked up once for all bands of each pixel. Returns the glare
    /// that meets another body.
    fn shared(&self, from: Departure, glare: &[SingleRay], pixels: &mut Pixels) -> Vec<SingleRay> {
        let bands = pixels.pass.responses.len();
        let first = |place: usize| glare[place * bands];
        let all = glare.len() / bands;
        let onward = |instance: &PacketInstance, other, place: usize| {
            let ray = first(place);
            instance.may_meet(&ray, other == from.body).then(|| (instance.arriving(&ray), 0.0))
        };
        let (mut to_look_up, mut meets) = (vec![], vec![]);
        for (place, met) in self.first(all, onward).into_iter().enumerate() {
            let (ray, own) = (first(place), place * bands..(place + 1) * bands);
            match met {
                None => to_look_up.push(LookUpRay::of(&ray, 1.0, place as u32)),
                Some(_) => meets.extend_from_slice(&glare[own]),
            }
        }
        let straight: Vec<_> =
            (0..all).map(|place| pixels.straight[first(place).tag as usize / bands]).collect();
        let mut seen = vec![DVec4::ZERO; all];
        self.look_up(&to_look_up, (&straight, 1), pixels.pass.strength, &mut seen);
        for ray in to_look_up {
            let place = ray.tag as usize;
            for own in &glare[place * bands..(place + 1) * bands] {
                pixels.light[own.tag as usize] += seen[place] * f64::from(own.light.weight());
            }
        }
        meets
    }

    /// Adds light that meets a body next to `next`, and looks up all other light in the environment.
    fn go_on(
        &self,
        from: Departure,
        leaving: &[SingleRay],
        pixels: &mut Pixels,
        next: &mut [Vec<EnteringRay>],
    ) {
        let (bands, options) = (pixels.pass.responses.len(), self.lit_scene.options);
        let threshold = pixels.threshold(options);
        let mut to_look_up: Vec<LookUpRay> = Vec::with_capacity(leaving.len());
        // Most light passes by all other bodies: a search among them costs far more than their balls.
        let passes_by = |ray: &&SingleRay| {
            let mut bodies = self.instances.iter().enumerate();
            !bodies.any(|(other, instance)| instance.may_meet(ray, other == from.body))
        };
        let (free, near): (Vec<&SingleRay>, Vec<&SingleRay>) = leaving.iter().partition(passes_by);
        to_look_up.extend(free.into_iter().map(|ray| LookUpRay::of(ray, ray.light.weight(), ray.tag)));
        let onward = |instance: &PacketInstance, other, place: usize| {
            let ray = near[place];
            instance.may_meet(ray, other == from.body).then(|| (instance.arriving(ray), 0.0))
        };
        for (ray, first) in near.iter().zip(self.first(near.len(), onward)) {
            let (tag, weight) = (ray.tag as usize, ray.light.weight());
            match first {
                None => to_look_up.push(LookUpRay::of(ray, weight, ray.tag)),
                Some(FirstHit { body: then, mut ray, met, .. }) => {
                    // The exits of one ray differ in the number of bounces before them.
                    let exit = from.passage << 32 | u64::from(ray.travelled.bounces);
                    if threshold <= 0.0 && f64::from(weight) <= options.least_weight {
                        pixels.lit[tag / bands].unresolved += f64::from(weight);
                        continue;
                    }
                    if weight < threshold {
                        if pixels.luck(ray.tag, exit | ENTERS) * threshold >= weight {
                            continue;
                        }
                        ray.light = ray.light.times(threshold / weight);
                    }
                    let luck = pixels.luck(ray.tag, exit);
                    if then != from.body {
                        ray.travelled = Travelled::NONE;
                    }
                    let medium = pixels.media[then][tag % bands];
                    next[then].push(EnteringRay { ray, met, medium, luck });
                }
            }
        }
        let strength = pixels.pass.strength;
        self.look_up(&to_look_up, (&pixels.straight, bands), strength, &mut pixels.light);
    }

    /// Adds the light from around all bodies along each ray, at the ray's tag. The straight ray of a tag is that of
    /// its pixel, where each pixel has `bands` tags.
    fn look_up(
        &self,
        rays: &[LookUpRay],
        (straight, bands): (&[StraightRay], usize),
        strength: f64,
        light: &mut [DVec4],
    ) {
        let (environment, strength) = (&self.environment, strength as f32);
        self.arch.dispatch(LookUp { environment, rays, straight, bands, strength, light });
    }
}

/// The body that light has left, and the number of the passage that ended there.
#[derive(Clone, Copy)]
struct Departure {
    body: usize,
    passage: u64,
}

fn eye_ray(EyeRay { ray, .. }: &EyeRay, tag: u32) -> SingleRay {
    let direction = ray.direction.as_vec3();
    SingleRay {
        origin: ray.origin.as_vec3(),
        direction,
        fan: ray.fan.as_vec3(),
        shift: ray.shift.as_vec3(),
        s: direction.any_orthonormal_vector(),
        light: Coherency::of_weight(1.0),
        travelled: Travelled::NONE,
        tag,
    }
}

impl EyeRay {
    /// Returns the ray from near the middle of the world on, where single precision suffices.
    fn straight(&self) -> StraightRay {
        let near = self.ray.ahead(-self.ray.origin.dot(self.ray.direction));
        StraightRay {
            near: near.origin.as_vec3(),
            direction: near.direction.as_vec3(),
            fan: near.fan.as_vec3(),
            shift: near.shift.as_vec3(),
        }
    }
}

impl Pixels<'_> {
    /// Returns the weight below which light goes on only by chance; 0 where all light is followed. Light whose weight
    /// is at most the least weight goes on by chance as well, instead of ending there.
    fn threshold(&self, options: RayOptions) -> f32 {
        let by_chance = self.pass.by_chance;
        if by_chance > 0.0 { by_chance.max(options.least_weight) as f32 } else { 0.0 }
    }

    /// Returns the random number that decides how far the light of a ray is followed in a passage. `passage` is 0 for
    /// the first passage and a different number for each further one.
    fn luck(&self, tag: u32, passage: u64) -> f32 {
        let bands = self.pass.responses.len();
        let (pixel, band) = (tag as usize / bands, tag as usize % bands);
        self.pass.roulette(self.eye_rays[pixel].pixel, band).map_or(0.0, |roulette| {
            let mut own = if passage == 0 { roulette } else { roulette.beyond(passage) };
            own.draw() as f32
        })
    }

    /// Adds the light, converted to colours, to the sums of the pixels.
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
