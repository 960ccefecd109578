//! Stones with frosted facets neither add nor lose light, and tracers that do not follow scattered light report it as
//! unresolved.

use super::*;
use crate::environment::{Environment, EnvironmentMap};
use crate::ray::{RayOptions, StoneTracer};
use crate::sampling::Sampling;
use brillianteer_base::unwatched;
use brillianteer_math::{Plane, Polytope, Pose};
use brillianteer_optics::{Absorption, Material, Strata, material};
use brillianteer_scene::{Film, Instance, Light, Scene, View};
use glam::{DQuat, DVec3};

const SIZE: u32 = 24;

/// Returns an octahedron with a table, whose planes are frosted as `of_plane` says; the table is plane 8.
pub(super) fn gem(of_plane: impl Fn(usize) -> f64) -> Polytope {
    let sides = [-1.0, 1.0].map(|x| [-1.0, 1.0].map(|y| [-1.0, 1.0].map(|z| DVec3::new(x, y, z))));
    let sides = sides.into_iter().flatten().flatten().map(|n| Plane::new(n / n.length(), 0.6));
    let planes: Vec<Plane> = sides.chain([Plane::new(DVec3::Z, 0.4)]).collect();
    Polytope::from_planes(&planes).unwrap().frosted(of_plane)
}

fn taken(gem: Polytope, material: &Material, light: &Light, passes: u32) -> Vec<RadiancePixel> {
    taken_of(vec![Instance::new(gem, material.clone())], light, passes)
}

fn taken_of(instances: Vec<Instance>, light: &Light, passes: u32) -> Vec<RadiancePixel> {
    let scene = Scene { instances, metals: vec![], unit_mm: 3.0 };
    let (map, view) = (EnvironmentMap::new(light, None), View { tilt: 0.4, azimuth: 0.3, ..View::default() });
    let (basis, eye) = (view.light_basis(), view.basis());
    let environment = Environment { map: &map, basis, eye, head: 0.0, backplate: None, backdrop: false };
    let options = RayOptions { polarised: true, most_bounces: 1000, least_weight: 1e-6 };
    let lit_scene =
        LitScene { scene: &scene, environment, view: &view, film: Film::square(SIZE, 1.3), options };
    let strata = Strata::new(1, 1, &light.spectrum, true);
    let mut image = ByRays::new(lit_scene, 0..SIZE);
    for number in 0..passes {
        let pass = Sampling::of(passes).pass(&scene, &strata, number);
        ProgressiveImage::<Stopped>::add_pass(&mut image, &pass, &unwatched).unwrap();
    }
    let mut pixels = vec![];
    ProgressiveImage::<Stopped>::each_pixel(&image, &mut |pixel| pixels.push(*pixel)).unwrap();
    pixels
}

fn mean(pixels: &[RadiancePixel], of: fn(&RadiancePixel) -> f64) -> f64 {
    let cover: f64 = pixels.iter().map(|pixel| pixel.cover).sum();
    assert!(cover > 80.0, "{cover}");
    pixels.iter().map(of).sum::<f64>() / cover
}

/// A material that absorbs much.
fn dark() -> Material {
    let mut dark = material("diamond").unwrap().clone();
    let grey = Absorption::new(vec![(550.0, 0.05)]).unwrap();
    dark.absorption = [grey.clone(), grey];
    dark
}

#[test]
fn frosted_stones_account_for_all_light_of_a_white_world() {
    let (white, diamond, dark) = (Light::white(), material("diamond").unwrap(), dark());
    let finishes: [&dyn Fn(usize) -> f64; 4] =
        [&|_| 0.5, &|_| 1.0, &|plane| if plane == 8 { 0.3 } else { 0.0 }, &|plane| (plane % 2) as f64 * 0.7];
    for (number, finish) in finishes.into_iter().enumerate() {
        for material in [diamond, &dark] {
            let pixels = taken(gem(finish), material, &white, 4);
            for pixel in &pixels {
                let all = pixel.colour.y + pixel.absorbed + pixel.unresolved;
                assert!((all - pixel.cover).abs() < 2e-3, "{number}: {pixel:?}");
            }
            let unresolved = mean(&pixels, |pixel| pixel.unresolved);
            assert!(unresolved < 1e-3, "{number}: {unresolved}");
            assert_eq!(mean(&pixels, |pixel| pixel.absorbed) > 0.01, !std::ptr::eq(material, diamond));
        }
    }
}

#[test]
fn frosted_stones_beside_others_account_for_all_light_of_a_white_world() {
    let (white, dark) = (Light::white(), dark());
    let stone = |frosting: f64, height: f64, turn: f64| {
        let pose = Pose { at: DVec3::Z * height, turn: DQuat::from_rotation_y(turn), scale: 0.8 };
        Instance::new(gem(|plane| (plane % 3) as f64 * frosting), dark.clone()).moved(&pose)
    };
    for (number, frosting) in [[0.4, 0.4], [0.3, 0.0], [0.0, 0.5]].into_iter().enumerate() {
        let pixels = taken_of(vec![stone(frosting[0], 0.7, 0.3), stone(frosting[1], -0.7, -0.5)], &white, 4);
        for pixel in &pixels {
            let all = pixel.colour.y + pixel.absorbed + pixel.unresolved;
            assert!((all - pixel.cover).abs() < 2e-3, "{number}: {pixel:?}");
        }
        assert!(
            mean(&pixels, |pixel| pixel.unresolved) < 2e-3 && mean(&pixels, |pixel| pixel.absorbed) > 0.02
        );
    }
}

#[test]
fn a_frosted_stone_shows_another_picture_than_a_polished_one_and_chance_hardly_changes_it() {
    // Parts of this world shine more than others, so that directions matter.
    let light = Light::studio();
    let diamond = material("diamond").unwrap();
    let of = |frosting: f64, passes: u32| taken(gem(|_| frosting), diamond, &light, passes);
    let [polished, frosted, again] = [of(0.0, 8), of(0.6, 64), of(0.6, 65)];
    let off = |a: &[RadiancePixel], b: &[RadiancePixel]| {
        let all = a.iter().zip(b).map(|(a, b)| (a.colour.y - b.colour.y).abs()).sum::<f64>();
        all / a.iter().map(|pixel| pixel.colour.y).sum::<f64>()
    };
    assert!(off(&frosted, &polished) > 0.2, "{}", off(&frosted, &polished));
    assert!(off(&frosted, &again) < 0.05, "{}", off(&frosted, &again));
}

#[test]
fn without_luck_all_light_that_meets_a_frosted_facet_is_unresolved() {
    let medium = Medium::clear(2.4);
    for (frosted, bottom) in [(gem(|plane| if plane == 8 { 0.5 } else { 0.0 }), false), (gem(|_| 0.5), true)]
    {
        let tracer = StoneTracer::new(&frosted, medium, RayOptions::default());
        let (mut light, mut exits) = (0.0, 0);
        let rest = tracer.follow(DVec3::new(0.05, 0.02, 5.0), DVec3::NEG_Z, |exit| {
            light += exit.weight;
            exits += 1;
        });
        assert_eq!((rest.unwrap().unresolved, exits), (1.0, 0), "the table is frosted");
        if bottom {
            continue;
        }
        // From below, light is reflected and passed by the polished facets before it reaches the table.
        let rest =
            tracer.follow(DVec3::new(0.05, 0.02, -5.0), DVec3::Z, |exit| light += exit.weight).unwrap();
        assert!(rest.unresolved > 0.03 && light > 0.05, "{rest:?} {light}");
        assert!((rest.unresolved + light - 1.0).abs() < 1e-9);
    }
}
