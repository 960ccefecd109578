//! Light that goes from stone to stone keeps its polarisation.

use super::frosted_tests::gem;
use super::*;
use crate::environment::{Environment, EnvironmentMap};
use crate::ray::{RayOptions, StoneTracer};
use crate::sampling::Sampling;
use brillianteer_base::unwatched;
use brillianteer_math::{Plane, Polytope, Pose};
use brillianteer_optics::{Material, Strata, fresnel};
use brillianteer_scene::{Film, Instance, Light, Scene, View};
use glam::{DQuat, DVec3};
use num_complex::Complex64;

const INDEX: f64 = 1.5;

/// Pixels along each side of a picture.
const SIZE: u32 = 24;

/// Returns a plate of glass that is thin along z, where this pose carries it.
fn plate(half: f64, pose: Pose) -> Instance {
    let planes: Vec<Plane> = [DVec3::X, DVec3::Y, DVec3::Z]
        .into_iter()
        .zip([half, half, 0.05])
        .flat_map(|(axis, half)| [Plane::new(axis, half), Plane::new(-axis, half)])
        .collect();
    let glass = Material::from_index("glass", INDEX).unwrap();
    Instance::new(Polytope::from_planes(&planes).unwrap(), glass).moved(&pose)
}

/// Returns the share of light that passes two plates in turn. Each surface reflects the share `r`; the reflections are
/// summed in each plate and then between the two.
fn through_two_plates(r: f64) -> f64 {
    let once = (1.0 - r) * (1.0 - r) / (1.0 - r * r);
    let back = r + r * once;
    once * once / (1.0 - back * back)
}

/// Returns the share of a ray, inclined by `lean` to the normals of two parallel plates, that goes on below both, and the
/// share that is not followed.
fn passed(lean: f64, polarised: bool) -> (f64, f64) {
    // The frames of the plates differ, and no axis is special.
    let slant = DQuat::from_rotation_x(0.3) * DQuat::from_rotation_y(0.8);
    let pose = |height: f64, turn: DQuat, scale: f64| Pose {
        at: slant * DVec3::new(0.3, -0.2, height),
        turn: slant * turn,
        scale,
    };
    let plates = [
        plate(60.0, pose(0.4, DQuat::from_rotation_z(0.7), 1.0)),
        plate(90.0, pose(-0.4, DQuat::from_rotation_z(-1.1), 0.7)),
    ];
    let options = RayOptions { polarised, least_weight: 1e-9, ..RayOptions::default() };
    let tracer = SceneTracer {
        tracers: InstanceTracer::of_all(&plates, options, |_| Medium::clear(INDEX)),
        metals: vec![],
        least_weight: options.least_weight,
    };
    let direction = slant * DVec3::new(lean.sin(), 0.0, -lean.cos());
    let start = WaitingRay::from_eye(DispersedRay::new(direction * -9.0, direction));
    let mut below = 0.0;
    let first = tracer.first(&start).unwrap();
    let loss = tracer.follow(&start, &first, |ray| {
        below += if ray.ray.direction.dot(direction) > 0.99 { ray.weight } else { 0.0 };
    });
    (below, loss.unresolved)
}

#[test]
fn two_plates_pass_what_the_formula_says_of_each_polarisation() {
    // At a slant a plate passes p better than s, and the light behind it is mostly p.
    let lean = 0.9_f64;
    let surface = fresnel(lean.cos(), 1.0 / INDEX);
    let [s, p] = [surface.reflectance_s(), surface.reflectance_p()].map(through_two_plates);
    let (kept, forgotten) = (0.5 * (s + p), through_two_plates(surface.reflectance()));
    for (polarised, expected) in [(true, kept), (false, forgotten)] {
        let (below, unresolved) = passed(lean, polarised);
        assert!(unresolved < 1e-5, "{unresolved}");
        assert!((below - expected).abs() < unresolved + 1e-9, "{below} passes, not {expected}");
    }
    assert!((kept - forgotten).abs() > 0.01);
}

#[test]
fn light_enters_a_stone_at_the_weight_of_its_ray_whatever_weight_its_polarisation_is_given_at() {
    let tracer = StoneTracer::new(&gem(|_| 0.0), Medium::clear(2.4), RayOptions::default());
    let ray = DispersedRay::new(DVec3::new(0.05, 0.02, 5.0), DVec3::NEG_Z);
    let met = tracer.meet(ray.origin, ray.direction).unwrap();
    let exits = |light: Option<PathLight>| {
        let meeting = MeetingRay { weight: 0.5, light, ..MeetingRay::from_eye(met, ray) };
        let mut exits = vec![];
        let rest = tracer.follow_from(&meeting, |_, _| false, |exit| exits.push(exit.weight)).unwrap();
        exits.push(rest.unresolved);
        exits
    };
    let (own, other) = (exits(None), exits(Some(PathLight::of_eye(ray.direction, 3.0, true))));
    assert!(own.len() > 5 && (own.iter().sum::<f64>() - 0.5).abs() < 1e-12, "{own:?}");
    assert!(own.iter().zip(&other).all(|(a, b)| (a - b).abs() < 1e-15), "{other:?}");
}

/// Makes other light of the light that goes from a stone to another body.
type Carry = fn(PathLight) -> Option<PathLight>;

/// Returns both fields with other components.
fn each(light: PathLight, other: fn([Complex64; 2]) -> [Complex64; 2]) -> Option<PathLight> {
    Some(light.of_other_fields(|fields| fields.map(other)))
}

/// Returns light of the same powers along s and p whose fields along s and along p have nothing to do with each other.
fn without_phases(light: PathLight) -> Option<PathLight> {
    Some(light.of_other_fields(|[a, b]| {
        let [s, p] = [0, 1].map(|k| (a[k].norm_sqr() + b[k].norm_sqr()).sqrt());
        [[s.into(), Complex64::ZERO], [Complex64::ZERO, p.into()]]
    }))
}

impl SceneTracer {
    /// Follows a ray as `follow` does, where `carry` makes other light of all light that goes to another body.
    fn follow_with(
        &self,
        start: &WaitingRay,
        first: &First,
        carry: Carry,
        mut leave: impl FnMut(&WaitingRay),
    ) {
        let mut waiting = vec![];
        let mut next = Some((*start, first.0));
        while let Some((ray, first)) = next {
            let known = waiting.len();
            self.onward(&ray, first, &mut waiting, &mut leave);
            waiting[known..].iter_mut().for_each(|(ray, _)| ray.light = ray.light.and_then(carry));
            next = waiting.pop();
        }
    }
}

impl ByRays<'_> {
    /// Faults in the way in which light goes from stone to stone.
    pub(crate) const FAULTS: [(&'static str, Carry); 5] = [
        ("no polarisation", |_| None),
        ("no phases", without_phases),
        ("the sign of both phases", |light| each(light, |[s, p]| [s, -p])),
        ("the sign of the part across", |light| each(light, |parts| parts.map(|part| part.conj()))),
        ("s and p exchanged", |light| each(light, |[s, p]| [p, -s])),
    ];

    /// Returns the pixels of one pass in f64, without what is absorbed or left, where `carry` makes other light of all
    /// light that goes to another body.
    pub(crate) fn seen_with(&self, pass: &SamplePass, carry: Carry) -> Vec<RadiancePixel> {
        let RayTracer::Single(tracer) = &self.tracer else { panic!("these are rays in f64") };
        let bands = tracer.made_of(pass);
        let pixels = self.rows.clone().flat_map(|y| (0..self.lit_scene.film.size[0]).map(move |x| [x, y]));
        let seen = |pixel: [u32; 2]| {
            let straight = self.eye_ray(pass, pixel);
            let start = WaitingRay::from_eye(straight);
            let Some(first) = bands[0].first(&start) else { return self.see(&bands, pass, pixel) };
            let mut lit = RadiancePixel { cover: 1.0, ..RadiancePixel::default() };
            for (tracer, response) in bands.iter().zip(&pass.responses) {
                let mut light = DVec4::ZERO;
                let leave = |ray: &WaitingRay| light += self.arriving(ray, &straight, pass);
                tracer.follow_with(&start, &first, carry, leave);
                lit.colour += colour(response, light);
            }
            lit
        };
        pixels.map(seen).collect()
    }
}

/// Returns two plates whose planes of incidence cross.
fn crossed_plates() -> Scene {
    let lean = |height: f64, turn: DQuat| Pose { at: DVec3::Z * height, turn, scale: 1.0 };
    let instances = vec![
        plate(1.4, lean(0.8, DQuat::from_rotation_z(0.2) * DQuat::from_rotation_x(0.95))),
        plate(1.4, lean(-0.8, DQuat::from_rotation_z(0.9) * DQuat::from_rotation_y(0.95))),
    ];
    Scene { instances, metals: vec![], unit_mm: 3.25 }
}

/// Returns two stones, one behind the other, that reflect much light totally before it leaves them.
fn two_gems() -> Scene {
    let glass = Material::from_index("glass", 2.4).unwrap();
    let stone = |height: f64, turn: DQuat, scale: f64| {
        Instance::new(gem(|_| 0.0), glass.clone()).moved(&Pose { at: DVec3::Z * height, turn, scale })
    };
    let instances = vec![
        stone(0.5, DQuat::from_rotation_x(0.5) * DQuat::from_rotation_y(-0.3), 0.6),
        stone(-0.8, DQuat::from_rotation_y(0.7) * DQuat::from_rotation_z(0.4), 1.2),
    ];
    Scene { instances, metals: vec![], unit_mm: 3.25 }
}

/// Returns the results of `take` for a picture of a scene in studio light, and for one pass of it.
fn pictured<T>(scene: &Scene, take: impl FnOnce(LitScene, &SamplePass) -> T) -> T {
    let light = Light { head: 0.0, ..Light::studio() };
    let (map, view) =
        (EnvironmentMap::new(&light, None), View { tilt: 0.1, azimuth: 0.3, ..View::default() });
    let (basis, eye) = (view.light_basis(), view.basis());
    let environment = Environment { map: &map, basis, eye, head: 0.0, backplate: None, backdrop: true };
    let options = RayOptions { polarised: true, most_bounces: 32, least_weight: 1e-5 };
    let film = Film::square(SIZE, 0.5);
    let strata = Strata::new(1, 1, &light.spectrum, true);
    let pass = Sampling::of(1).pass(scene, &strata, 0);
    take(LitScene { scene, environment, view: &view, film, options }, &pass)
}

fn pixels(mut image: ByRays, pass: &SamplePass) -> Vec<RadiancePixel> {
    ProgressiveImage::<Stopped>::add_pass(&mut image, pass, &unwatched).unwrap();
    let mut pixels = vec![];
    ProgressiveImage::<Stopped>::each_pixel(&image, &mut |pixel| pixels.push(*pixel)).unwrap();
    pixels
}

/// Returns the share of pixels that differ by more than 1e-4 of the brightest.
fn apart(a: &[RadiancePixel], b: &[RadiancePixel]) -> f64 {
    let scale = a.iter().map(|pixel| pixel.colour.max_element()).fold(0.0, f64::max);
    let far = a.iter().zip(b).filter(|(a, b)| (a.colour - b.colour).abs().max_element() > 1e-4 * scale);
    far.count() as f64 / a.len() as f64
}

#[test]
fn rays_and_packets_see_the_same_from_stone_to_stone_and_notice_every_fault_between_them() {
    for (scene, faults) in [(crossed_plates(), &ByRays::FAULTS[..1]), (two_gems(), &ByRays::FAULTS)] {
        pictured(&scene, |lit_scene, pass| {
            let rays = ByRays::in_f64(lit_scene, 0..SIZE);
            let own = rays.seen_with(pass, Some);
            assert_eq!(apart(&own, &pixels(ByRays::in_f64(lit_scene, 0..SIZE), pass)), 0.0);
            // At edges rounding decides which way a ray takes.
            let packets = pixels(ByRays::new(lit_scene, 0..SIZE), pass);
            assert!(apart(&own, &packets) < 0.01, "{} of the pixels differ", apart(&own, &packets));
            for (fault, carry) in faults {
                let found = apart(&rays.seen_with(pass, *carry), &packets);
                assert!(found > 0.08, "{fault}: {found} of the pixels differ");
            }
        });
    }
}
