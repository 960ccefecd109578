//! Parity of polarised light in pictures: the card and the rays in f64 give it the same axes, in each stone and from
//! stone to stone.

use super::card;
use super::rings::{ParityShot, askew, assert_same, dark, differences, gem};
use crate::ray::ByRays;
use brillianteer_math::{Plane, Polytope, Pose};
use brillianteer_scene::{Instance, Light, Scene, View};
use glam::{DQuat, DVec3};
use std::f64::consts::FRAC_PI_2;

/// Returns the convex solid of three pairs of planes across the axes, at these distances from the origin.
fn block(halves: [f64; 3]) -> Polytope {
    let sides = DVec3::AXES.into_iter().zip(halves);
    let planes: Vec<Plane> =
        sides.flat_map(|(axis, half)| [Plane::new(axis, half), Plane::new(-axis, half)]).collect();
    Polytope::from_planes(&planes).unwrap()
}

/// Returns a picture, in a white world, of a cube of glass that is turned and faces the eye with a side.
fn cube(turn: DQuat, eye: DQuat) -> ParityShot {
    let pose = Pose { at: DVec3::ZERO, turn, scale: 0.7 };
    let instances = vec![Instance { pose, ..Instance::new(block([1.0; 3]), dark(1.5, 0.02)) }];
    let scene = Scene { instances, metals: vec![], unit_mm: 3.25 };
    ParityShot { light: Light::white(), view: View { turn: eye, ..View::default() }, ..ParityShot::of(scene) }
}

#[test]
fn a_turned_facet_seen_square_on_is_as_bright_on_the_card_as_to_the_rays() {
    let Some(gpu) = card("a_turned_facet_seen_square_on_is_as_bright_on_the_card_as_to_the_rays") else {
        return;
    };
    let turns = [DQuat::from_rotation_x(FRAC_PI_2), DQuat::from_rotation_y(FRAC_PI_2)];
    // The image's x axis lies along x and along y of the world.
    let eyes = [DQuat::IDENTITY, DQuat::from_rotation_z(FRAC_PI_2)];
    for (turn, eye) in turns.into_iter().flat_map(|turn| eyes.map(|eye| (turn, eye))) {
        let shot = cube(turn, eye);
        let exact = shot.by_rays();
        let seen: Vec<f64> = exact.iter().filter(|p| p.cover > 0.0).map(|p| p.colour.y).collect();
        assert!(seen.len() > 500 && seen.iter().all(|&y| y > 0.5), "{} pixels", seen.len());
        assert_same(&format!("{turn}, {eye}"), &differences(&exact, &shot.by_card(&gpu)));
    }
}

/// Returns two plates of glass, one behind the other, which light passes at a slant. Their planes of incidence cross, so
/// that the second passes little of what the first has passed best.
fn crossed_plates() -> ParityShot {
    let body = block([1.0, 1.0, 0.05]);
    let plate = |at: DVec3, turn: DQuat| Instance {
        pose: Pose { at, turn: askew() * turn, scale: 0.8 },
        ..Instance::new(body.clone(), dark(1.5, 0.02))
    };
    let instances = vec![
        plate(DVec3::new(0.0, 0.2, 0.6), DQuat::from_rotation_x(1.3)),
        plate(DVec3::new(0.0, -0.2, -0.6), DQuat::from_rotation_y(0.9)),
    ];
    let scene = Scene { instances, metals: vec![], unit_mm: 3.25 };
    ParityShot { wavelengths: 2, backdrop: true, ..ParityShot::of(scene) }
}

#[test]
fn light_that_goes_from_stone_to_stone_keeps_its_polarisation_on_the_card() {
    let name = "light_that_goes_from_stone_to_stone_keeps_its_polarisation_on_the_card";
    let Some(gpu) = card(name) else { return };
    let (shot, on_card) = (crossed_plates(), crossed_plates().by_card(&gpu));
    assert_same("crossed plates", &differences(&shot.by_rays(), &on_card));
    let (fault, carry) = ByRays::FAULTS[0];
    let found = differences(&shot.by_rays_with(carry), &on_card);
    assert!(found.blocks > 0.02, "{fault}: {found:?}");
}

/// Returns two stones, one behind the other, that reflect much light totally before it leaves them.
fn two_gems() -> ParityShot {
    let stone = |height: f64, turn: DQuat, scale: f64| Instance {
        pose: Pose { at: DVec3::Z * height, turn: askew() * turn, scale },
        ..Instance::new(gem(), dark(2.4, 0.001))
    };
    let instances = vec![
        stone(1.0, DQuat::from_rotation_x(0.5) * DQuat::from_rotation_y(-0.3), 1.2),
        stone(-1.6, DQuat::from_rotation_y(0.7) * DQuat::from_rotation_z(0.4), 2.4),
    ];
    let scene = Scene { instances, metals: vec![], unit_mm: 3.25 };
    ParityShot { wavelengths: 1, light: Light { head: 0.0, ..Light::studio() }, ..ParityShot::of(scene) }
}

#[test]
fn the_card_notices_every_fault_of_light_that_goes_from_stone_to_stone() {
    let Some(gpu) = card("the_card_notices_every_fault_of_light_that_goes_from_stone_to_stone") else {
        return;
    };
    let (shot, on_card) = (two_gems(), two_gems().by_card(&gpu));
    let found = differences(&shot.by_rays(), &on_card);
    assert_same("two gems", &found);
    assert!(found.fine < 0.01, "two gems: {found:?}");
    for (fault, carry) in ByRays::FAULTS {
        let found = differences(&shot.by_rays_with(carry), &on_card);
        assert!(found.fine > 0.08, "{fault}: {found:?}");
    }
}
