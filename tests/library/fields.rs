//! Compares glass shapes on the graphics card with point rays in f64: the same paths in and out, pixel by pixel.
#![cfg(feature = "gpu")]

use crate::common::pixels::{ALLOWED, Case, views};
use crate::common::shoot::{Shoot, apart, colour, differences};
use crate::common::*;
use brillianteer::math::{ImplicitForm, ImplicitSurface, Pose, SmoothSolid};
use brillianteer::optics::{Material, material};
use brillianteer::scene::{Instance, Light, Medium, View, light};
use brillianteer::trace::{
    gpu::{ByCard, GpuEnvironment, GpuError},
    ray::RayOptions,
};
use glam::{DQuat, DVec3};
use std::io::Write;

fn smooth(form: ImplicitForm) -> SmoothSolid {
    SmoothSolid::new(ImplicitSurface::new(form).unwrap())
}

/// Returns a view of a shape that is turned a little: rounding would decide whether a ray meets an edge that lies along the
/// view.
fn aside(view: &View) -> View {
    let turn = DQuat::from_rotation_x(0.31) * DQuat::from_rotation_y(-0.27) * DQuat::from_rotation_z(0.19);
    view.of_turned(turn)
}

fn plate(size: DVec3, edge: f64, (amplitude, wavelength): (f64, f64), phase: f64) -> ImplicitForm {
    ImplicitForm::Plate { size, edge, amplitude, wavelength, phase }
}

const CUBE: DVec3 = DVec3::splat(1.15);
const TILE: DVec3 = DVec3::new(1.7, 1.7, 0.3);

fn forms() -> [(&'static str, ImplicitForm); 9] {
    [
        ("ball", ImplicitForm::Pill { size: DVec3::splat(1.5), edge: 0.75 }),
        ("pill", ImplicitForm::Pill { size: DVec3::new(2.0, 0.575, 0.31), edge: 0.155 }),
        ("upright pill", ImplicitForm::Pill { size: DVec3::new(0.6, 1.8, 0.8), edge: 0.1 }),
        ("cube", ImplicitForm::Block { size: CUBE, edge: 0.22 }),
        ("sharp block", ImplicitForm::Block { size: DVec3::new(0.5, 1.15, 1.65), edge: 0.0 }),
        ("sharp prism", ImplicitForm::Prism { size: DVec3::new(1.965, 0.745, 0.585), edge: 0.0 }),
        ("prism", ImplicitForm::Prism { size: DVec3::new(1.6, 0.9, 0.8), edge: 0.08 }),
        ("rippled plate", plate(TILE, 0.0525, (0.02, 0.4), 0.7)),
        ("wavy plate", plate(TILE, 0.0525, (0.1, 1.5), 0.3)),
    ]
}

/// The most bounces in comparisons of single pixels. A curved surface spreads neighbouring rays two- to tenfold at a bounce,
/// and their rounding errors with them: after more bounces f32 has no digits left in some pixels. Whole paths are compared
/// under light, in blocks of pixels.
const BOUNCES: u32 = 6;

#[test]
fn glass_looks_as_by_rays() {
    let Some(gpu) = card("glass_looks_as_by_rays") else { return };
    let media = [
        Medium::clear(2.4175),
        Medium { absorption: [0.1, 0.5], ..Medium::clear(1.77) },
        Medium::clear(1.54),
    ];
    let (mut left_out, mut all) = (0, 0);
    for (k, (name, form)) in forms().into_iter().enumerate() {
        let smooth = smooth(form);
        for (i, (view, medium)) in views().iter().zip(media.iter().cycle().skip(k)).enumerate() {
            let view = &aside(view);
            let case = Case::new(&smooth, *medium, view, (i + k) % 3 != 0);
            let options = RayOptions { most_bounces: BOUNCES, ..case.options };
            let found = Case { options, twin_options: options, ..case }.compared(&gpu);
            assert!(found.largest <= ALLOWED, "{name}, {medium:?}, {view:?}: {:e}", found.largest);
            assert!(found.energy <= 1e-4, "{name}, {medium:?}, {view:?}: energy off by {:e}", found.energy);
            left_out += found.left_out;
            all += found.counted + found.left_out;
        }
    }
    assert!(left_out * 500 <= all, "{left_out} of {all} pixels are left out");
}

#[test]
fn the_comparison_of_glass_sees_every_small_change() {
    let Some(gpu) = card("the_comparison_of_glass_sees_every_small_change") else { return };
    let view = aside(&View { tilt: 0.5, azimuth: 1.4, ..View::default() });
    let glass = Medium::clear(1.54);
    let cube = smooth(ImplicitForm::Block { size: CUBE, edge: 0.22 });
    let rounder = smooth(ImplicitForm::Block { size: CUBE, edge: 0.2205 });
    let wavy = smooth(plate(TILE, 0.05, (0.1, 1.5), 0.3));
    let later = smooth(plate(TILE, 0.05, (0.1, 1.5), 0.302));
    let higher = smooth(plate(TILE, 0.05, (0.1005, 1.5), 0.3));
    for (name, smooth, changed) in
        [("cube", &cube, [&rounder, &rounder]), ("plate", &wavy, [&later, &higher])]
    {
        let case = || {
            let case = Case::new(smooth, glass, &view, true);
            let options = RayOptions { most_bounces: BOUNCES, ..case.options };
            Case { options, twin_options: options, ..case }
        };
        let plain = RayOptions { polarised: false, ..case().options };
        let shorter = RayOptions { most_bounces: 3, ..case().options };
        for (change, mutant) in [
            ("index", Case { twin_medium: Medium::clear(1.541), ..case() }),
            ("shape", Case { twin: changed[0].into(), ..case() }),
            ("shape", Case { twin: changed[1].into(), ..case() }),
            ("polarisation", Case { twin_options: plain, ..case() }),
            (
                "bounces",
                Case { options: RayOptions { most_bounces: 4, ..shorter }, twin_options: shorter, ..case() },
            ),
            ("absorption", Case { twin_medium: Medium { absorption: [0.01; 2], ..glass }, ..case() }),
        ] {
            let found = mutant.compared(&gpu);
            assert!(found.largest > 10.0 * ALLOWED, "{name}, {change}: only {:e}", found.largest);
        }
        let found = case().compared(&gpu);
        assert!(found.largest <= ALLOWED, "{name}: {:e}", found.largest);
    }
    let case = Case { comes_back: false, ..Case::new(&wavy, glass, &view, true) };
    let found = case.compared(&gpu);
    assert!(found.largest > 10.0 * ALLOWED, "light that enters again: only {:e}", found.largest);
}

fn posed(form: ImplicitForm, turn: DQuat, at: DVec3) -> Instance {
    let glass = Material::from_index("glass", 1.6).unwrap();
    Instance::new(ImplicitSurface::new(form).unwrap(), glass).moved(&Pose { at, ..Pose::turned(turn) })
}

fn pill(middle: DVec3) -> Instance {
    let turn = DQuat::from_rotation_x(0.5) * DQuat::from_rotation_z(0.4);
    let form = ImplicitForm::Pill { size: DVec3::new(1.5, 0.7, 0.5), edge: 0.2 };
    posed(form, turn, middle)
}

fn small_plate(middle: DVec3, phase: f64) -> Instance {
    let (size, edge) = (DVec3::new(1.5, 1.5, 0.25), 0.05);
    let form = ImplicitForm::Plate { size, edge, amplitude: 0.06, wavelength: 1.1, phase };
    posed(form, DQuat::from_rotation_y(0.2), middle)
}

fn lit(stone: Instance, material_name: &str, light_name: &str, most_bounces: u32) -> Shoot {
    let stone = Instance { material: material(material_name).unwrap().clone(), ..stone };
    let mut shoot = Shoot::of_stone(stone, light(light_name).unwrap());
    (shoot.samples, shoot.options.most_bounces, shoot.size) = (4, most_bounces, 40);
    shoot
}

/// A pill in front of a plate whose wave begins at the pill.
fn pill_and_plate(phase: f64, most_bounces: u32) -> Shoot {
    let mut both = lit(pill(DVec3::new(0.1, 0.1, 0.6)), "quartz", "studio", most_bounces);
    both.scene.instances.push(small_plate(DVec3::new(-0.1, -0.2, -0.3), phase));
    both
}

#[test]
fn the_card_shows_glass_as_rays_do() {
    let Some(gpu) = card("the_card_shows_glass_as_rays_do") else { return };
    // In a wave, rounding decides which pixel shows a lamp's glint, and one glint is a tenth of the light of its block. So one
    // of the 25 blocks may differ by more than the others. After more than three bounces there would be more such blocks, so
    // a plate with more bounces is under broad light.
    let assert_alike = |shoot: Shoot, what: &str| {
        let found = differences(&shoot.by_rays().0, &shoot.by_card(&gpu).0);
        assert!(found[0] < 0.03 && found[1] < 0.005, "{what}: {:?}", &found[..4]);
    };
    for (material, name) in [("quartz", "lamps"), ("diamond", "studio")] {
        assert_alike(lit(pill(DVec3::ZERO), material, name, BOUNCES), &format!("a pill of {material}"));
        for (name, bounces) in [(name, 3), ("dome", BOUNCES)] {
            let plate = lit(small_plate(DVec3::ZERO, 0.4), material, name, bounces);
            assert_alike(plate, &format!("a plate of {material} in the light {name}"));
        }
    }
    assert_alike(pill_and_plate(0.4, BOUNCES), "a pill before a plate");
    let by_rays = pill_and_plate(0.4, BOUNCES).by_rays().0;
    let found = differences(&by_rays, &pill_and_plate(0.45, BOUNCES).by_card(&gpu).0);
    assert!(found[1] > 0.01, "another wave: {:?}", &found[..4]);
}

#[test]
fn whole_ways_through_glass_bring_as_much_light_on_the_card() {
    let Some(gpu) = card("whole_ways_through_glass_bring_as_much_light_on_the_card") else { return };
    for shoot in [
        lit(pill(DVec3::ZERO), "quartz", "dome", 64),
        lit(small_plate(DVec3::ZERO, 0.4), "quartz", "dome", 64),
        pill_and_plate(0.4, 64),
    ] {
        let shoot = Shoot { samples: 8, ..shoot };
        let (by_rays, by_card) = (shoot.by_rays().0, shoot.by_card(&gpu).0);
        let count = by_rays.pixels.len() as f64;
        let brightest = (by_rays.pixels.iter().map(colour).sum::<DVec3>() / count).max_element();
        let differences = || by_rays.pixels.iter().zip(&by_card.pixels).map(|(a, b)| colour(a) - colour(b));
        let mean = differences().sum::<DVec3>() / count;
        let scatter = differences().map(|d| (d - mean) * (d - mean)).sum::<DVec3>() / count;
        // Single rays differ by rounding after many bounces. Their mean may be off by as much as chance makes it.
        let chance = (scatter / count).map(f64::sqrt);
        let excess = (mean.abs() - 4.0 * chance).max_element() / brightest;
        let largest = chance.max_element() / brightest;
        assert!(excess < 0.001 && largest < 0.003, "means are off by {mean}, by chance {chance}");
        let found = apart(&by_rays, &by_card);
        assert!(found < 0.02, "a block is off by {found}");
    }
}

/// Times one pass of each shape, by the number of wavelengths.
#[test]
#[ignore = "tells times"]
fn how_long_glass_takes() {
    let Some(gpu) = card("how_long_glass_takes") else { return };
    let stone = built(&brilliant((56.0, 34.5, 40.8), (50.0, 77.0), 64)).polytope;
    let glass = |k: usize| lit(posed(forms()[k].1, DQuat::IDENTITY, DVec3::ZERO), "quartz", "studio", 64);
    let shapes = [
        ("pill", glass(1)),
        ("cube", glass(3)),
        ("prism", glass(6)),
        ("plate", glass(8)),
        ("brilliant", Shoot::new(&stone, "diamond", light("studio").unwrap())),
    ];
    for (name, mut shoot) in shapes {
        (shoot.samples, shoot.size, shoot.wavelengths) = (1, 192, 1);
        shoot.by_card(&gpu);
        for wavelengths in [3, 8, 16, 32, 64] {
            shoot.wavelengths = wavelengths;
            let ms = |work: &dyn Fn()| {
                let start = std::time::Instant::now();
                work();
                start.elapsed().as_secs_f64() * 1e3
            };
            let [single, packets] = [ms(&|| drop(shoot.by_rays())), ms(&|| drop(shoot.by_packets()))];
            let card = ms(&|| drop(shoot.by_card(&gpu)));
            writeln!(
                std::io::stderr(),
                "| {name} | {wavelengths} | {single:.0} | {packets:.0} | {card:.0} |"
            )
            .unwrap();
        }
    }
}

#[test]
fn glass_in_a_furnace_is_white_on_the_card() {
    let Some(gpu) = card("glass_in_a_furnace_is_white_on_the_card") else { return };
    let block = ImplicitForm::Block { size: DVec3::splat(0.9), edge: 0.1 };
    let prism = ImplicitForm::Prism { size: DVec3::new(1.2, 0.8, 0.8), edge: 0.06 };
    let ball = ImplicitForm::Pill { size: DVec3::splat(1.4), edge: 0.7 };
    let turn = DQuat::from_rotation_x(0.5) * DQuat::from_rotation_y(0.4);
    let convex = [block, prism, ball].map(|form| posed(form, turn, DVec3::ZERO));
    for stone in convex.into_iter().chain([pill(DVec3::ZERO), small_plate(DVec3::ZERO, 0.4)]) {
        let form = stone.body.clone();
        let material = material("quartz").unwrap().clone();
        let mut shoot = Shoot::of_stone(Instance { material, ..stone }, Light::white());
        shoot.options.least_weight = 1e-5;
        let (picture, remainder) = shoot.by_card(&gpu);
        let mean = picture.pixels.iter().map(colour).sum::<DVec3>() / picture.pixels.len() as f64;
        let missing = (1.0 - mean).abs().max_element();
        assert!(remainder.unresolved < 0.01, "{form:?}: {remainder:?}");
        assert!(missing < 3.0 * remainder.unresolved + 1e-4, "{form:?}: {missing}, {remainder:?}");
    }
}

#[test]
fn glass_beside_a_stone_is_not_for_the_card() {
    let Some(gpu) = card("glass_beside_a_stone_is_not_for_the_card") else { return };
    let stone = built(&brilliant((56.0, 34.5, 40.8), (50.0, 77.0), 16)).polytope;
    let mut shoot = Shoot::new(&stone, "diamond", light("dome").unwrap());
    shoot.scene.instances.push(pill(DVec3::X * 3.0));
    shoot.with(|lit_scene| {
        let around = GpuEnvironment::new(&gpu, &lit_scene.environment).unwrap();
        let refused = ByCard::new(&gpu, lit_scene, &around, 0..8, 3).err();
        assert_eq!(refused, Some(GpuError::MixedKinds));
    });
}
