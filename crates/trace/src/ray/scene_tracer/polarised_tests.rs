//! Light that goes from stone to stone keeps its polarisation.

use super::*;
use crate::environment::{Environment, EnvironmentMap};
use crate::ray::RayOptions;
use crate::sampling::Sampling;
use brillianteer_base::unwatched;
use brillianteer_math::{Plane, Polytope, Pose};
use brillianteer_optics::{Material, Strata, fresnel};
use brillianteer_scene::{Film, Instance, Light, Scene, View};
use glam::{DQuat, DVec3};

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

/// Returns the light of each pixel of a picture of two plates, whose planes of incidence cross, by rays in f64 or by
/// packets.
fn seen(in_f64: bool, polarised: bool) -> Vec<DVec3> {
    let lean = |height: f64, turn: DQuat| Pose { at: DVec3::Z * height, turn, scale: 1.0 };
    let instances = vec![
        plate(1.4, lean(0.8, DQuat::from_rotation_z(0.2) * DQuat::from_rotation_x(0.95))),
        plate(1.4, lean(-0.8, DQuat::from_rotation_z(0.9) * DQuat::from_rotation_y(0.95))),
    ];
    let scene = Scene { instances, metals: vec![], unit_mm: 3.25 };
    let light = Light { head: 0.0, ..Light::studio() };
    let (map, view) =
        (EnvironmentMap::new(&light, None), View { tilt: 0.1, azimuth: 0.3, ..View::default() });
    let (basis, eye) = (view.light_basis(), view.basis());
    let environment = Environment { map: &map, basis, eye, head: 0.0, backplate: None, backdrop: true };
    let options = RayOptions { polarised, most_bounces: 32, least_weight: 1e-5 };
    let film = Film::square(SIZE, 0.5);
    let lit_scene = LitScene { scene: &scene, environment, view: &view, film, options };
    let strata = Strata::new(1, 1, &light.spectrum, true);
    let mut image = if in_f64 { ByRays::in_f64(lit_scene, 0..SIZE) } else { ByRays::new(lit_scene, 0..SIZE) };
    let pass = Sampling::of(1).pass(&scene, &strata, 0);
    ProgressiveImage::<Stopped>::add_pass(&mut image, &pass, &unwatched).unwrap();
    let mut pixels = vec![];
    ProgressiveImage::<Stopped>::each_pixel(&image, &mut |pixel| pixels.push(pixel.colour)).unwrap();
    pixels
}

#[test]
fn rays_and_packets_see_the_same_through_crossed_plates() {
    let (rays, brightest) =
        (seen(true, true), |all: &[DVec3]| all.iter().map(|c| c.max_element()).fold(0.0, f64::max));
    let scale = brightest(&rays);
    let apart = |other: &[DVec3]| {
        let differences = rays.iter().zip(other).map(|(a, b)| (a - b).abs().max_element() / scale);
        differences.filter(|&difference| difference > 1e-4).count()
    };
    // At the plates' edges rounding decides which way a ray takes.
    let found = apart(&seen(false, true));
    assert!(found * 50 < rays.len(), "{found} of {} pixels differ", rays.len());
    assert!(apart(&seen(false, false)) * 2 > rays.len());
}
