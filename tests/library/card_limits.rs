//! Tests that work beyond the limits of a graphics card is refused before anything is copied to the card, and that
//! the card goes on working.
#![cfg(feature = "gpu")]

use crate::common::shoot::Shoot;
use crate::common::*;
use brillianteer::base::unwatched;
use brillianteer::math::{Plane, Polytope, SolidRef};
use brillianteer::render::RenderError;
use brillianteer::scene::{
    ASET_CONE, Backing, Film, MOST_LAMPS, Medium, Mipmap, Panorama, Scene, Scope, View, light,
};
use brillianteer::trace::{
    ScopeShot,
    environment::{Backplate, Disc, Environment, EnvironmentMap},
    gpu::{ByCard, Gpu, GpuEnvironment, GpuError, MOST_WAVELENGTHS},
    ray::RayOptions,
    sampling::LitScene,
};
use glam::{DVec2, DVec3, DVec4};
use std::io::Write;

/// The number of pixels across a picture that is wider than any card takes.
const WIDE: u32 = 100_000;

/// The number of facets with which a software driver follows fewer bounces than a picture needs.
const MANY: u32 = 5200;

#[test]
fn pictures_beyond_the_limits_of_a_card_are_refused_and_do_not_lose_it() {
    let Some(gpu) = card("pictures_beyond_the_limits_of_a_card_are_refused_and_do_not_lose_it") else {
        return;
    };
    let stone = built(&brilliant((56.0, 34.5, 40.8), (50.0, 77.0), 16)).polytope;
    Shoot::new(&stone, "diamond", light("dome").unwrap()).with(|lit_scene| {
        let around = GpuEnvironment::new(&gpu, &lit_scene.environment).unwrap();
        let refused =
            |scene: &LitScene, wavelengths| ByCard::new(&gpu, scene, &around, 0..8, wavelengths).err();
        let nothing = Scene { instances: vec![], metals: vec![], unit_mm: 1.0 };
        let empty = LitScene { scene: &nothing, ..*lit_scene };
        assert_eq!(refused(&empty, 3), Some(GpuError::NoStones));
        for count in [0, MOST_WAVELENGTHS + 1] {
            let wanted = GpuError::Wavelengths { count, most: MOST_WAVELENGTHS };
            assert!(!wanted.is_lost());
            assert_eq!(refused(lit_scene, count), Some(wanted));
        }
        refuse_environments(&gpu, &lit_scene.environment);
        assert_eq!(refused(lit_scene, MOST_WAVELENGTHS), None, "the card is lost");
    });
}

/// Checks that too many lamps and too wide a backplate are refused.
fn refuse_environments(gpu: &Gpu, environment: &Environment) {
    let lamp = Disc { toward: DVec3::Z, chord_squared: 1e-4, radiance: DVec4::ONE };
    let count = MOST_LAMPS + 1;
    let map = EnvironmentMap { lamps: vec![lamp; count], ..environment.map.clone() };
    let error = GpuEnvironment::new(gpu, &Environment { map: &map, ..*environment }).err().unwrap();
    assert_eq!(error, GpuError::TooManyLamps { count, most: MOST_LAMPS });
    let wide = Panorama { width: WIDE, height: 1, pixels: vec![[0.5; 3]; WIDE as usize] };
    let picture = Mipmap::new(wide);
    let backplate = Some(Backplate { picture: &picture, distance: 3.0, width: 2.0 });
    let error = GpuEnvironment::new(gpu, &Environment { backplate, ..*environment }).err().unwrap();
    assert!(matches!(error, GpuError::PictureTooLarge { width: WIDE, height: 1, .. }), "{error}");
    assert!(!error.is_lost());
}

/// Returns a stone whose facets touch a ball, on a spiral.
fn round(facets: u32) -> Polytope {
    let plane = |k: u32| {
        let z = 1.0 - 2.0 * (f64::from(k) + 0.5) / f64::from(facets);
        let (sin, cos) = (2.399_963 * f64::from(k)).sin_cos();
        let across = (1.0 - z * z).sqrt();
        Plane { normal: DVec3::new(across * cos, across * sin, z), offset: 1.0 }
    };
    Polytope::from_planes(&(0..facets).map(plane).collect::<Vec<_>>()).unwrap()
}

#[test]
fn scopes_refuse_a_software_card_that_follows_too_few_bounces() {
    let test = "scopes_refuse_a_software_card_that_follows_too_few_bounces";
    let Some(gpu) = card(test) else { return };
    if !gpu.is_software() {
        let _ = writeln!(std::io::stderr(), "SKIPPED {test}: a real card has no limit");
        return;
    }
    let (stone, scope) = (round(MANY), Scope::aset(ASET_CONE, Backing::Black));
    let shot = ScopeShot {
        solid: SolidRef::Convex(&stone),
        medium: Medium::clear(2.4),
        view: &View::default(),
        scope: &scope,
        film: Film::square(8, 1.1),
        per_side: 1,
        shift: DVec2::splat(0.5),
        options: RayOptions::default(),
    };
    let refused = gpu.scope::<RenderError>(&shot, &unwatched, |_, _| Ok(())).err().unwrap();
    let RenderError::Card(error) = refused else { panic!("{refused}") };
    assert!(matches!(error, GpuError::TooFewBounces { stones: 1, bounces: 1..12, .. }), "{error}");
}
