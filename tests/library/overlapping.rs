//! Checks copies that stand before one another: light goes through one and then through the next, so that the picture has
//! just the steps of brightness that surfaces give.

use crate::common::shoot::*;
use brillianteer::math::{ImplicitForm, ImplicitSurface, Plane, Polytope, Pose};
use brillianteer::optics::Material;
use brillianteer::picture::Linear;
use brillianteer::scene::{Body, Instance, Light, Panorama, Scene, View, light};
use glam::{DQuat, DVec3};

/// A shape whose copies overlap in the picture.
#[derive(Clone, Copy, PartialEq)]
enum Shape {
    Pill,
    Cube,
    /// A flat slab with sharp edges.
    Slab,
}

const SHAPES: [Shape; 2] = [Shape::Pill, Shape::Cube];

fn block(half: DVec3) -> Polytope {
    let sides = DVec3::AXES.into_iter().flat_map(|axis| {
        let offset = half.dot(axis);
        [Plane::new(axis, offset), Plane::new(-axis, offset)]
    });
    Polytope::from_planes(&sides.collect::<Vec<_>>()).unwrap()
}

fn body(shape: Shape) -> Body {
    match shape {
        Shape::Pill => {
            let form = ImplicitForm::Pill { size: DVec3::new(1.3, 0.6, 0.4), edge: 0.2 };
            ImplicitSurface::new(form).unwrap().into()
        }
        Shape::Cube => block(DVec3::splat(0.35)).into(),
        Shape::Slab => block(DVec3::new(0.6, 0.6, 0.05)).into(),
    }
}

fn stone(shape: Shape, index: f64, at: DVec3) -> Instance {
    let turn = match shape {
        Shape::Slab => DQuat::IDENTITY,
        _ => DQuat::from_euler(glam::EulerRot::XYZ, 0.5, 0.3, 0.2),
    };
    let material = Material::from_index("glass", index).unwrap();
    Instance::new(body(shape), material).moved(&Pose { at, ..Pose::turned(turn) })
}

/// Returns the nearer copy, of an index.
fn front(shape: Shape, index: f64) -> Instance {
    stone(shape, index, DVec3::new(0.15, 0.12, 0.6))
}

/// Returns the farther copy, of an index, which the nearer one covers in part.
fn rear(shape: Shape, index: f64) -> Instance {
    stone(shape, index, DVec3::new(-0.15, -0.12, -0.6))
}

/// Returns a photograph of soft bands in colour.
fn bands() -> Panorama {
    let side = 96_u32;
    let wave = |x: u32, period: f32| 0.5 + 0.4 * (x as f32 / period).sin();
    let pixel = |k: u32| {
        let (x, y) = (k % side, k / side);
        [wave(x, 5.0), wave(y, 4.0), wave(x + y, 7.0)]
    };
    Panorama { width: side, height: side, pixels: (0..side * side).map(pixel).collect() }
}

/// Returns a picture to take of these copies before the bands, seen straight on.
fn shoot(instances: Vec<Instance>, strength: f64) -> Shoot {
    let scene = Scene { instances, metals: vec![], unit_mm: 3.25 };
    let mut shoot = Shoot::of_stone(front(Shape::Cube, 1.5), light("dome").unwrap());
    (shoot.scene, shoot.strength, shoot.wavelengths) = (scene, strength, 3);
    (shoot.view, shoot.photo) = (View::default(), Some((bands(), 2.0)));
    shoot.options.least_weight = 1e-9;
    shoot
}

/// Returns the greatest difference of a pixel's colour between two pictures.
fn farthest(a: &Linear, b: &Linear) -> f64 {
    let apart = |(a, b): (&[f32; 4], &[f32; 4])| (colour(a) - colour(b)).abs().max_element();
    a.pixels.iter().zip(&b.pixels).map(apart).fold(0.0, f64::max)
}

/// Returns the number of pixels that both copies cover wholly.
fn overlap(shape: Shape) -> usize {
    let cover = |stone: Instance| {
        let mut alone = shoot(vec![stone], 1.0);
        (alone.photo, alone.backdrop) = (None, false);
        alone.by_rays().0.pixels.iter().map(|pixel| pixel[3] > 0.999).collect::<Vec<_>>()
    };
    let (near, far) = (cover(front(shape, 1.5)), cover(rear(shape, 1.5)));
    near.iter().zip(&far).filter(|(near, far)| **near && **far).count()
}

/// Returns the two pictures of a scene: by rays in f64 and by packets in f32, with the rounding that each may have.
fn pictures(shoot: &Shoot) -> [(Linear, f64); 2] {
    [(shoot.by_rays().0, 1e-6), (shoot.by_packets().0, 2e-3)]
}

/// The strengths of refraction at which the program's presets show copies, and those between.
const STRENGTHS: [f64; 3] = [1.0, 0.5, 0.035];

#[test]
fn copies_of_air_before_one_another_show_the_background_as_it_is() {
    for shape in SHAPES {
        assert!(overlap(shape) > 150, "the copies overlap in the picture: {}", overlap(shape));
        for strength in STRENGTHS {
            let far_away = stone(shape, 1.5, DVec3::new(50.0, 0.0, 0.0));
            let bare = pictures(&shoot(vec![far_away], strength));
            let both = pictures(&shoot(vec![front(shape, 1.0), rear(shape, 1.0)], strength));
            for ((bare, rounding), (both, _)) in bare.iter().zip(&both) {
                assert!(farthest(bare, both) < *rounding, "{strength}: {}", farthest(bare, both));
            }
            // Glass would be seen.
            let other = shoot(vec![front(shape, 1.3), rear(shape, 1.0)], strength).by_rays().0;
            assert!(farthest(&bare[0].0, &other) > 5e-3, "{strength}: {}", farthest(&bare[0].0, &other));
        }
    }
}

#[test]
fn a_copy_of_air_hides_nothing_of_the_copy_behind_it() {
    for shape in SHAPES {
        for strength in STRENGTHS {
            let alone = pictures(&shoot(vec![rear(shape, 1.5)], strength));
            let both = pictures(&shoot(vec![front(shape, 1.0), rear(shape, 1.5)], strength));
            let apart = |a: &Linear, b: &Linear, rounding: f64| {
                let pairs = a.pixels.iter().zip(&b.pixels);
                pairs.filter(|(a, b)| (colour(a) - colour(b)).abs().max_element() > rounding).count()
            };
            for ((alone, rounding), (both, _)) in alone.iter().zip(&both) {
                // A border that light has crossed in air shifts it by rounding, which single pixels at edges show.
                let count = apart(alone, both, *rounding);
                println!("{strength}: {count} pixels differ, by up to {:.1e}", farthest(alone, both));
                assert!(count <= 20, "{strength}: {count} of {} pixels differ", both.pixels.len());
            }
            // Layers, in which each copy refracts the background alone, would end in steps along the front copy's border.
            let front_alone = shoot(vec![front(shape, 1.0)], strength).by_rays().0;
            let mut layers = alone[0].0.clone();
            let mut cover = shoot(vec![front(shape, 1.5)], strength);
            (cover.photo, cover.backdrop) = (None, false);
            for (k, covered) in cover.by_rays().0.pixels.iter().enumerate() {
                if covered[3] > 0.0 {
                    layers.pixels[k] = front_alone.pixels[k];
                }
            }
            let count = apart(&alone[0].0, &layers, 0.02);
            assert!(count > 100, "{strength}: layers differ in {count} pixels");
        }
    }
}

#[test]
fn slabs_before_one_another_dim_as_a_pile_of_plates_does() {
    // Stokes, Proceedings of the Royal Society 11, 545 (1862): m surfaces of reflectance r let (1 - r) / (1 + (m - 1) r) through.
    let index = 1.6_f64;
    let r = ((index - 1.0) / (index + 1.0)).powi(2);
    let through = |surfaces: f64| (1.0 - r) / (1.0 + (surfaces - 1.0) * r);
    let mut pile = shoot(vec![front(Shape::Slab, index), rear(Shape::Slab, index)], 1.0);
    // All is dark but a white page behind the slabs.
    pile.light.dome.clear();
    pile.photo = Some((Panorama { width: 4, height: 4, pixels: vec![[1.0; 3]; 16] }, 2.0));
    pile.options.most_bounces = 200;
    let (picture, _) = pile.by_rays();
    // A line from the lower left to the upper right crosses the rear slab, both, and the front slab.
    let at = |place: f64| {
        let pixel = |x: f64| ((x / 1.1 + 1.0) * 0.5 * f64::from(SIZE)) as u32;
        let (x, y) = (pixel(place), SIZE - 1 - pixel(place));
        colour(&picture.pixels[(y * SIZE + x) as usize])
    };
    let borders = [-0.72, -0.45, 0.45, 0.72];
    let levels = [1.0, through(2.0), through(4.0), through(2.0), 1.0];
    let white = at(-0.95);
    assert!((white - 1.0).abs().max_element() < 1e-3, "{white}");
    let (mut seen, mut steps) = ([0; 3], 0);
    for k in -100..=100 {
        let place = f64::from(k) * 0.01;
        if borders.iter().any(|border: &f64| (place - border).abs() < 0.04) {
            steps += 1;
            continue;
        }
        let expected = levels[borders.iter().filter(|border| place > **border).count()];
        let found = at(place) / white;
        assert!((found - expected).abs().max_element() < 1e-4, "{place}: {found} instead of {expected}");
        seen[levels.iter().position(|level| *level == expected).unwrap()] += 1;
    }
    assert!(seen.iter().all(|count| *count > 15) && steps < 40, "{seen:?}");
    // Neither the rear slab left out nor its light counted twice would pass.
    assert!((through(2.0) - through(4.0)) > 0.05 && (through(2.0).powi(2) - through(4.0)).abs() > 5e-3);
}

#[test]
fn copies_before_one_another_are_white_in_a_white_furnace() {
    for shape in [Shape::Pill, Shape::Cube, Shape::Slab] {
        for strength in STRENGTHS {
            let mut furnace = shoot(vec![front(shape, 1.5), rear(shape, 1.5)], strength);
            (furnace.light, furnace.photo) = (Light::white(), None);
            furnace.options.most_bounces = 1000;
            for ((picture, remainder), rounding) in [(furnace.by_rays(), 1e-5), (furnace.by_packets(), 1e-3)]
            {
                let mean = picture.pixels.iter().map(colour).sum::<DVec3>() / picture.pixels.len() as f64;
                let lost = remainder.unresolved;
                assert!(lost < 5e-3, "{lost} unresolved");
                assert!(
                    (mean - 1.0).abs().max_element() < 3.0 * lost + rounding,
                    "{strength}: {mean}, {lost}"
                );
                // No pixel is brighter than the furnace.
                let brightest = picture.pixels.iter().map(|p| colour(p).max_element()).fold(0.0, f64::max);
                assert!(brightest < 1.0 + 10.0 * rounding, "{strength}: {brightest}");
            }
        }
    }
}

#[test]
fn steps_at_the_border_of_a_copy_vanish_with_its_index() {
    // Along a line across the border of the nearer copy, before the other one.
    let line = |picture: &Linear| {
        let row = |k: u32| colour(&picture.pixels[(SIZE / 2 * SIZE + k) as usize]);
        (0..SIZE).map(row).collect::<Vec<_>>()
    };
    for shape in SHAPES {
        let alone = line(&shoot(vec![rear(shape, 1.5)], 1.0).by_rays().0);
        let off = |index: f64| {
            let both = line(&shoot(vec![front(shape, index), rear(shape, 1.5)], 1.0).by_rays().0);
            let mut all: Vec<f64> =
                both.iter().zip(&alone).map(|(a, b)| (*a - *b).abs().max_element()).collect();
            all.sort_by(f64::total_cmp);
            // At a border light grazes, and at a facet's edge behind it changes sides: single pixels.
            all[all.len() - 4]
        };
        let (weak, weaker) = (off(1.01), off(1.00001));
        println!("steps of {weak:.1e} at an index of 1.01, of {weaker:.1e} at 1.00001");
        assert!(weaker < 1e-3 && weaker < 0.02 * weak, "{weak} {weaker}");
    }
}
