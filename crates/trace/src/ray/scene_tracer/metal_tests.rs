//! Scenes with metal: all light is accounted for, chance changes no mean, and smooth normals change no outline.

use super::*;
use crate::environment::{Environment, EnvironmentMap};
use crate::ray::RayOptions;
use crate::sampling::Sampling;
use crate::solids::torus;
use brillianteer_base::unwatched;
use brillianteer_math::{Plane, Polytope, Pose, ShadedMesh, ShadedSurface};
use brillianteer_optics::{Metal, Strata, material, metal_reflectance};
use brillianteer_scene::{Film, Instance, Light, MetalInstance, Scene, View};
use glam::DVec3;
use num_complex::Complex64;
use std::sync::Arc;

const SIZE: u32 = 32;

/// A metal that absorbs next to nothing.
const PERFECT: Complex64 = Complex64::new(1.0, 1e9);

fn of(mesh: ShadedMesh, metal: Metal, roughness: f64) -> MetalInstance {
    MetalInstance { roughness, ..MetalInstance::new(&Arc::new(mesh), metal) }
}

/// Returns an octahedron with a table, of diamond.
fn gem() -> Instance {
    let sides = [-1.0, 1.0].map(|x| [-1.0, 1.0].map(|y| [-1.0, 1.0].map(|z| DVec3::new(x, y, z))));
    let sides = sides.into_iter().flatten().flatten().map(|n| Plane::new(n / n.length(), 0.6));
    let planes: Vec<Plane> = sides.chain([Plane::new(DVec3::Z, 0.4)]).collect();
    Instance::new(Polytope::from_planes(&planes).unwrap(), material("diamond").unwrap().clone())
}

/// The settings of a picture.
#[derive(Clone, Copy)]
struct Shot {
    passes: u32,
    first: u32,
    wavelengths: u32,
    by_chance: f64,
    /// The index of all metals, in place of their own.
    index: Option<Complex64>,
}

const ONE: Shot = Shot { passes: 1, first: 0, wavelengths: 1, by_chance: 0.0, index: None };

fn with<T>(scene: &Scene, light: &Light, backdrop: bool, work: impl FnOnce(&LitScene) -> T) -> T {
    let (map, view) = (EnvironmentMap::new(light, None), View { tilt: 0.4, azimuth: 0.3, ..View::default() });
    let (basis, eye) = (view.light_basis(), view.basis());
    let environment = Environment { map: &map, basis, eye, head: 0.0, backplate: None, backdrop };
    let options = RayOptions { polarised: true, most_bounces: 64, least_weight: 1e-4 };
    work(&LitScene { scene, environment, view: &view, film: Film::square(SIZE, 1.5), options })
}

fn taken(scene: &Scene, light: &Light, shot: Shot) -> Vec<RadiancePixel> {
    with(scene, light, false, |lit_scene| {
        let strata = Strata::new(shot.wavelengths, 1, &light.spectrum, true);
        let sampling = Sampling { by_chance: shot.by_chance, ..Sampling::of(shot.passes) };
        let mut image = ByRays::new(*lit_scene, 0..SIZE);
        for number in 0..shot.passes {
            let mut pass = sampling.pass(scene, &strata, shot.first + number);
            if let Some(index) = shot.index {
                pass.metals.iter_mut().flatten().for_each(|own| *own = index);
            }
            ProgressiveImage::<Stopped>::add_pass(&mut image, &pass, &unwatched).unwrap();
        }
        let mut pixels = vec![];
        ProgressiveImage::<Stopped>::each_pixel(&image, &mut |pixel| pixels.push(*pixel)).unwrap();
        pixels
    })
}

/// A stone in a ring that cuts into it.
fn ring(metal: Metal, roughness: f64) -> Scene {
    let metals = vec![of(torus((0.95, 0.25), (48, 24), true), metal, roughness)];
    Scene { instances: vec![gem()], metals, unit_mm: 3.0 }
}

/// Returns the means of light seen, absorbed and unresolved over the pixels that see a body, each by its share.
fn means(pixels: &[RadiancePixel]) -> [f64; 3] {
    let cover: f64 = pixels.iter().map(|pixel| pixel.cover).sum();
    let mean = |of: fn(&RadiancePixel) -> f64| pixels.iter().map(of).sum::<f64>() / cover;
    [mean(|p| p.colour.y), mean(|p| p.absorbed), mean(|p| p.unresolved)]
}

#[test]
fn a_ring_and_its_stone_account_for_all_light_of_a_white_world() {
    let white = Light::white();
    for roughness in [0.0, 0.3] {
        let pixels = taken(&ring(Metal::Gold, roughness), &white, Shot { passes: 2, ..ONE });
        assert!(pixels.iter().filter(|pixel| pixel.cover > 0.0).count() > 300);
        for pixel in &pixels {
            let all = pixel.colour.y + pixel.absorbed + pixel.unresolved;
            assert!((all - pixel.cover).abs() < 2e-3, "{pixel:?}");
        }
        let [_, absorbed, _] = means(&pixels);
        // Without the light that the metal absorbs, the sum would be too small.
        assert!(absorbed > 0.02, "{absorbed}");
    }
}

#[test]
fn metal_that_absorbs_nothing_vanishes_with_its_stone_in_a_white_world() {
    for roughness in [0.0, 0.2, 0.8] {
        let shot = Shot { passes: 64, by_chance: 0.1, index: Some(PERFECT), ..ONE };
        let pixels = taken(&ring(Metal::Silver, roughness), &Light::white(), shot);
        let [seen, absorbed, unresolved] = means(&pixels);
        assert!((seen - 1.0).abs() < 0.01 && absorbed.abs() < 0.01, "{roughness}: {seen} {absorbed}");
        assert!(unresolved < 5e-3, "{roughness}: {unresolved}");
        // No part of the picture gains light.
        let blocks = pixels.chunks(SIZE as usize * 4).map(means).filter(|[seen, ..]| seen.is_finite());
        blocks.for_each(|[seen, ..]| assert!(seen < 1.05, "{roughness}: {seen}"));
        let [gold, ..] =
            means(&taken(&ring(Metal::Gold, roughness), &Light::white(), Shot { index: None, ..shot }));
        assert!(gold < 0.98, "{gold}");
    }
}

#[test]
fn chance_changes_no_mean() {
    let scene = ring(Metal::Silver, 0.25);
    let light = Light { head: 0.0, ..Light::ring() };
    let shot = Shot { passes: 48, wavelengths: 1, ..ONE };
    let [all, ..] = means(&taken(&scene, &light, shot));
    let [by_chance, ..] = means(&taken(&scene, &light, Shot { by_chance: 0.1, ..shot }));
    assert!((by_chance / all - 1.0).abs() < 0.015, "{all} {by_chance}");
    let other = means(&taken(&ring(Metal::Platinum, 0.25), &light, Shot { by_chance: 0.1, ..shot }))[0];
    assert!((other / all - 1.0).abs() > 0.03, "{all} {other}");
}

#[test]
fn smooth_normals_never_change_an_outline() {
    let light = Light { head: 0.0, ..Light::ring() };
    let seen = |mesh: ShadedMesh| {
        let scene = Scene { instances: vec![], metals: vec![of(mesh, Metal::Gold, 0.1)], unit_mm: 3.0 };
        taken(&scene, &light, Shot { passes: 4, ..ONE })
    };
    let [smooth, flat] = [true, false].map(|is_smooth| seen(torus((0.9, 0.4), (9, 6), is_smooth)));
    assert!(smooth.iter().zip(&flat).all(|(a, b)| a.cover.to_bits() == b.cover.to_bits()));
    // The two pictures differ, and a finer mesh has another outline.
    let apart = smooth.iter().zip(&flat).filter(|(a, b)| a.colour.distance(b.colour) > 0.02).count();
    assert!(apart > 50, "{apart}");
    let finer = seen(torus((0.9, 0.4), (18, 12), true));
    assert!(smooth.iter().zip(&finer).any(|(a, b)| a.cover != b.cover));
    // No pixel of the metal is black, because a normal never loses light by sending it below the surface.
    let white = Scene {
        instances: vec![],
        metals: vec![of(torus((0.9, 0.4), (9, 6), true), Metal::Silver, 0.3)],
        unit_mm: 3.0,
    };
    let shot = Shot { passes: 16, ..ONE };
    for pixel in taken(&white, &Light::white(), shot).iter().filter(|pixel| pixel.cover > 0.0) {
        assert!(pixel.colour.y > 0.6 * pixel.cover, "{pixel:?}");
    }
}

#[test]
fn bits_do_not_depend_on_the_number_of_threads() {
    let (scene, light) = (ring(Metal::Gold, 0.3), Light { head: 0.0, ..Light::ring() });
    let shot = Shot { passes: 2, wavelengths: 3, by_chance: 0.1, ..ONE };
    let on = |threads: usize, shot: Shot| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| taken(&scene, &light, shot))
    };
    let bits = |pixels: Vec<RadiancePixel>| {
        pixels.iter().flat_map(|p| p.colour.to_array().map(f64::to_bits)).collect::<Vec<_>>()
    };
    let alone = bits(on(1, shot));
    assert_eq!(alone, bits(on(3, shot)));
    assert_ne!(alone, bits(on(1, Shot { first: 2, ..shot })));
}

#[test]
fn a_mirror_shows_what_lies_in_its_direction_in_the_colour_of_its_metal() {
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let points = corners.map(|[x, y]| DVec3::new(x, y, 0.0)).to_vec();
    let plate =
        ShadedMesh::new(ShadedSurface { points, corners: vec![[0, 1, 2], [0, 2, 3]], normals: vec![] })
            .unwrap();
    let mirror = Scene { instances: vec![], metals: vec![of(plate, Metal::Gold, 0.0)], unit_mm: 3.0 };
    let light = Light { head: 0.0, ..Light::ring() };
    let found = taken(&mirror, &light, Shot { wavelengths: 8, ..ONE });
    with(&mirror, &light, false, |lit_scene| {
        let strata = Strata::new(8, 1, &light.spectrum, true);
        let pass = Sampling::of(1).pass(&mirror, &strata, 0);
        let (_, direction) = Camera::reaching(lit_scene.view, mirror.reach()).ray(DVec2::ZERO);
        let back = direction.with_z(-direction.z);
        let seen = lit_scene.environment.radiance(DVec3::ZERO, back, DVec3::ZERO);
        let reflected = |metal: Metal| {
            let band = |(s, response): (&brillianteer_optics::Stratum, _)| {
                let [of_s, of_p] = metal_reflectance(-direction.z, metal.index(s.at(0.5)));
                colour(response, seen * (0.5 * (of_s + of_p)))
            };
            strata.of_pass(0).collect::<Vec<_>>().iter().zip(&pass.responses).map(band).sum::<DVec3>()
        };
        let middle = found[(SIZE * SIZE / 2 + SIZE / 2) as usize].colour;
        assert!(middle.distance(reflected(Metal::Gold)) < 1e-9 * middle.length(), "{middle}");
        assert!(middle.distance(reflected(Metal::Silver)) > 0.1 * middle.length());
        assert!(middle.x > middle.y && middle.y > 1.5 * middle.z, "{middle}");
    });
}

#[test]
fn metal_hides_what_is_behind_it() {
    let above = Pose { at: DVec3::Z * 2.0, ..Pose::STILL };
    let lid = || of(torus((0.3, 0.3), (24, 12), true), Metal::Gold, 0.1);
    let seen = |metals: Vec<MetalInstance>| {
        let scene = Scene { instances: vec![gem()], metals, unit_mm: 3.0 };
        let view = View::default();
        with(&scene, &Light::white(), false, |lit_scene| {
            let probe = super::super::SceneProbe::new(&LitScene { view: &view, ..*lit_scene });
            let middle = f64::from(SIZE) / 2.0;
            (
                probe.through(middle + 2.0, middle).map(|ray| ray.stone),
                probe.is_hidden(0, DVec3::new(0.2, 0.0, 0.4)),
            )
        })
    };
    assert_eq!(seen(vec![]), (Some(0), false));
    assert_eq!(seen(vec![lid().moved(&above)]), (None, true));
    let below = Pose { at: DVec3::Z * -2.0, ..Pose::STILL };
    assert_eq!(seen(vec![lid().moved(&below)]), (Some(0), false));
}
