//! Tests of rays that represent a stretch of their pixel: their light is the mean over the stretch, the same by all
//! tracers and in the mean over many passes, and with less noise over few passes.

use crate::common::shoot::*;
use brillianteer::math::{ImplicitForm, ImplicitSurface, Pose, SmoothSolid};
use brillianteer::optics::Material;
use brillianteer::picture::Linear;
use brillianteer::scene::{Body, Instance, Light, Medium, Panorama, Projection, View};
use brillianteer::trace::ray::{Camera, Exit, InstanceTracer, MeetingRay, RayOptions};
use glam::{DQuat, DVec2, DVec3};

/// The width and height of the picture behind the body, in pixels.
const ACROSS: u32 = 256;

/// Returns a body of glass.
fn body(form: ImplicitForm) -> Body {
    Body::Glass(SmoothSolid::new(ImplicitSurface::new(form).unwrap()))
}

/// Returns a pill, a rounded block and a wavy plate, each with its name.
fn shapes() -> [(&'static str, ImplicitForm); 3] {
    let plate = ImplicitForm::Plate {
        size: DVec3::new(1.5, 1.4, 0.3),
        edge: 0.05,
        amplitude: 0.04,
        wavelength: 0.9,
        phase: 0.3,
    };
    [
        ("pill", ImplicitForm::Pill { size: DVec3::new(1.7, 0.8, 0.6), edge: 0.3 }),
        ("block", ImplicitForm::Block { size: DVec3::splat(1.1), edge: 0.25 }),
        ("plate", plate),
    ]
}

/// Returns a picture of a body, turned and seen from nearby, in front of a pattern whose light at each of its pixels `behind`
/// gives.
fn shoot(form: ImplicitForm, behind: impl Fn(u32, u32) -> f32) -> Shoot {
    let glass = Material::from_index("glass", 1.5).unwrap();
    let pose = Pose { at: DVec3::new(0.05, -0.02, 0.1), turn: DQuat::from_rotation_y(0.3), scale: 0.9 };
    let dark = Light { dome: vec![], ..Light::white() };
    let mut shoot = Shoot::of_stone(Instance::new(body(form), glass).moved(&pose), dark);
    let pixels = (0..ACROSS * ACROSS).map(|k| [behind(k % ACROSS, k / ACROSS); 3]).collect();
    shoot.photo = Some((Panorama { width: ACROSS, height: ACROSS, pixels }, 1.0));
    shoot.view.projection = Projection::Perspective { distance: 6.0 };
    (shoot.samples, shoot.wavelengths, shoot.options.most_bounces) = (8, 1, 6);
    shoot
}

/// A pattern of squares a few pixels wide, dark and bright, which rims shrink to less than a pixel of the picture.
fn squares(x: u32, y: u32) -> f32 {
    if (x / 4 + y / 4).is_multiple_of(2) { 1.0 } else { 0.1 }
}

/// A pattern without detail.
fn waves(x: u32, y: u32) -> f32 {
    1.0 + 0.5 * (x as f32 * 0.05).sin() + 0.4 * (y as f32 * 0.06).cos()
}

/// Returns the root of the mean square of the difference of two pictures.
fn rmse(a: &Linear, b: &Linear) -> f64 {
    let square = |(a, b): (&[f32; 4], &[f32; 4])| (colour(a) - colour(b)).length_squared() / 3.0;
    let sum: f64 = a.pixels.iter().zip(&b.pixels).map(square).sum();
    (sum / a.pixels.len() as f64).sqrt()
}

#[test]
fn a_stretch_of_a_pixel_leaves_every_shape_as_wide_as_its_ends_are_apart() {
    let (view, options) = (View { tilt: 0.4, azimuth: 0.7, ..View::default() }, RayOptions::default());
    let view = View { projection: Projection::Perspective { distance: 5.0 }, ..view };
    let pose = Pose { at: DVec3::new(0.1, -0.2, 0.3), turn: DQuat::from_rotation_x(0.7), scale: 1.3 };
    for (name, form) in shapes() {
        let stone = Instance::new(body(form), Material::from_index("glass", 1.5).unwrap()).moved(&pose);
        let tracer = &InstanceTracer::of_all(&[stone], RayOptions { most_bounces: 4, ..options }, |_| {
            Medium::clear(1.5)
        })[0];
        let camera = Camera::reaching(&view, 3.0);
        let exits = |p: DVec2, by: DVec2| -> Option<Vec<Exit>> {
            let ray = camera.ray_along(p, by);
            let met = tracer.meet(ray.origin, ray.direction)?;
            let mut exits = vec![];
            tracer.follow_from(&MeetingRay::from_eye(met, ray), |_, _| false, |exit| exits.push(exit));
            Some(exits)
        };
        let (mut all, mut off) = (0, 0);
        for k in 0..600 {
            let p = (DVec2::new(0.754_877_666_2, 0.569_840_291) * f64::from(k)).fract() * 2.0 - 1.0;
            let by = DVec2::from_angle(f64::from(k)) * 1e-5;
            let [a, b, c] =
                [exits(p - 0.5 * by, DVec2::ZERO), exits(p, by), exits(p + 0.5 * by, DVec2::ZERO)];
            let (Some(a), Some(b), Some(c)) = (a, b, c) else { continue };
            for exit in &b {
                let same = |e: &&Exit| e.bounce == exit.bounce && e.point.distance(exit.point) < 1e-3;
                let (Some(from), Some(to)) = (a.iter().find(same), c.iter().find(same)) else { continue };
                all += 1;
                let [turn, way] =
                    [to.direction - from.direction, to.point - from.point].map(|v| v / by.length());
                let [fan, shift] = [exit.fan, exit.shift].map(|v| v / by.length());
                let is_off = (fan - turn).length() > 1e-3 * turn.length().max(1.0)
                    || (shift - way).length() > 1e-3 * way.length().max(1.0);
                off += u32::from(is_off);
            }
        }
        // Where a path passes close to an edge, its ends differ more.
        assert!(all > 300 && off * 50 < all, "{name}: {off} of {all}");
    }
}

#[test]
fn packets_see_the_same_stretch_of_what_hangs_behind() {
    for (name, form) in shapes() {
        for strength in [1.0, 0.3] {
            let own = Shoot { strength, ..shoot(form, squares) };
            let (single, packets) = (own.by_rays().0, own.by_packets().0);
            let points = Shoot { stretches: false, ..own }.by_packets().0;
            let (found, mutant) = (rmse(&single, &packets), rmse(&single, &points));
            println!("{name}, strength {strength}: {found:.5}, without stretches {mutant:.5}");
            assert!(found < 0.2 * mutant, "{name}, strength {strength}: {found}, not {mutant}");
        }
    }
}

#[cfg(feature = "gpu")]
#[test]
fn the_card_sees_the_same_stretch_of_what_hangs_behind() {
    let Some(gpu) = crate::common::card("the_card_sees_the_same_stretch_of_what_hangs_behind") else {
        return;
    };
    for (name, form) in shapes() {
        for strength in [1.0, 0.3] {
            let own = Shoot { strength, size: 40, ..shoot(form, squares) };
            let (single, card) = (own.by_rays().0, own.by_card(&gpu).0);
            let points = Shoot { stretches: false, ..own }.by_card(&gpu).0;
            let (found, mutant) = (rmse(&single, &card), rmse(&single, &points));
            println!("{name}, strength {strength}: {found:.5}, without stretches {mutant:.5}");
            assert!(found < 0.2 * mutant, "{name}, strength {strength}: {found}, not {mutant}");
        }
    }
}

/// Returns for each pixel of a picture whether its middle shows the rim of the body, where rays from the eye meet it
/// at more than 60 degrees from its normal.
fn rims(shoot: &Shoot, form: ImplicitForm) -> Vec<bool> {
    let (stone, surface) = (&shoot.scene.instances[0], ImplicitSurface::new(form).unwrap());
    let tracer =
        &InstanceTracer::of_all(std::slice::from_ref(stone), shoot.options, |_| Medium::clear(1.5))[0];
    shoot.with(|lit_scene| {
        let camera = Camera::reaching(lit_scene.view, lit_scene.scene.reach());
        let is_rim = |k: u32| {
            let at = DVec2::new(f64::from(k % shoot.size), f64::from(k / shoot.size)) + 0.5;
            let (origin, direction) = camera.ray(lit_scene.film.image_from_pixels(at));
            let Some((_, distance)) = tracer.meet(origin, direction) else { return false };
            let normal = stone.pose.turn * surface.normal(stone.pose.unplace(origin + direction * distance));
            -direction.dot(normal) < 0.5
        };
        (0..shoot.size * shoot.size).map(is_rim).collect()
    })
}

#[test]
fn the_mean_over_many_passes_stays_and_few_passes_have_less_noise_at_rims() {
    for (name, form) in shapes() {
        let taken = |pattern: fn(u32, u32) -> f32, samples: u32, stretches: bool| {
            Shoot { samples, stretches, ..shoot(form, pattern) }.by_packets().0
        };
        let many = [false, true].map(|stretches| taken(waves, 256, stretches));
        let off = rmse(&many[0], &many[1]);
        let [own, other] = many.map(|picture| picture.pixels.iter().map(colour).sum::<DVec3>());
        let mean = (own / other - 1.0).abs().max_element();
        assert!(mean < 5e-4, "{name}: the mean of a pattern without detail changes by {mean}");
        // At the rims of plates the bend of the surface is felt within a stretch.
        assert!(off < 6e-3, "{name}: a pattern without detail changes by {off}");
        let (exact, rims) = (taken(squares, 512, false), rims(&shoot(form, squares), form));
        let at_rims = |picture: &Linear| {
            let pixels =
                picture.pixels.iter().zip(&rims).map(|(p, &is_rim)| if is_rim { *p } else { [0.0; 4] });
            Linear { pixels: pixels.collect(), ..*picture }
        };
        let noise = |stretches| rmse(&at_rims(&taken(squares, 8, stretches)), &at_rims(&exact));
        let (points, stretched) = (noise(false), noise(true));
        let count = rims.iter().filter(|rim| **rim).count();
        println!(
            "{name}: smooth {off:.5}, mean {mean:.6}; {count} pixels of rims are {:.3} as noisy",
            stretched / points
        );
        assert!(count > 30 && stretched < 0.8 * points, "{name}: {stretched}, not below {points}");
    }
}
