//! Compares the graphics card with point rays in f64: the same chain of bounces, pixel by pixel.
#![cfg(feature = "gpu")]

use crate::common::pixels::*;
use crate::common::*;
use brillianteer::math::{Plane, Pose, Surface, TriangleMesh};
use brillianteer::scene::{Medium, Stone, View};
use brillianteer::trace::ray::RayOptions;
use glam::{DQuat, DVec3};
use std::path::PathBuf;
use std::sync::Arc;

/// Returns the stones of all cut files between planes, each with the views in which it is compared: round brilliants in all,
/// the others in one, each family in another.
fn shipped() -> Vec<(String, Stone, Vec<View>)> {
    let round: Vec<String> = round_brilliants().into_iter().map(|(name, _)| name).collect();
    let viewed = |(k, (name, path)): (usize, (String, PathBuf))| {
        let all = views().to_vec();
        let seen = if round.contains(&name) { all } else { vec![all[k % all.len()]] };
        (name, stone(&path), seen)
    };
    cut_files().into_iter().enumerate().map(viewed).collect()
}

#[test]
fn every_pixel_is_that_of_the_rays() {
    let Some(gpu) = card("every_pixel_is_that_of_the_rays") else { return };
    let media = [
        Medium::clear(2.4175),
        Medium { absorption: [0.1, 0.5], ..Medium::clear(1.77) },
        Medium::clear(1.54),
    ];
    let (mut left_out, mut all) = (0, 0);
    for (k, (name, stone, views)) in shipped().iter().enumerate() {
        for (view, medium) in views.iter().zip(media.iter().cycle().skip(k)) {
            let polarised = k % 3 != 0;
            let found = Case::new(&stone.polytope, *medium, view, polarised).compared(&gpu);
            assert!(found.largest <= ALLOWED, "{name}, {medium:?}, {view:?}: {:e}", found.largest);
            assert!(found.energy <= 1e-4, "{name}, {medium:?}, {view:?}: energy off by {:e}", found.energy);
            left_out += found.left_out;
            all += found.counted + found.left_out;
        }
    }
    assert!(left_out * 500 <= all, "{left_out} of {all} pixels are left out");
}

#[test]
fn a_stone_of_many_planes_is_traced_by_bunches_as_well() {
    let Some(gpu) = card("a_stone_of_many_planes_is_traced_by_bunches_as_well") else { return };
    let planes: Vec<Plane> = (0..2000)
        .map(|i| {
            let z: f64 = 1.0 - 2.0 * (f64::from(i) + 0.5) / 2000.0;
            Plane::from_slope(z.acos(), 2.399_963 * f64::from(i), 1.0)
        })
        .collect();
    let ball = nameless(&planes);
    assert!(ball.polytope.facets().len() > 1990);
    let (view, short) = (View::default(), |options| RayOptions { most_bounces: 12, ..options });
    let case = Case::new(&ball.polytope, Medium::clear(1.54), &view, true);
    let case = Case { options: short(case.options), twin_options: short(case.options), ..case };
    let found = case.compared(&gpu);
    // The facets are small, so that more pixels than in a gem lie near an edge at one of the bounces.
    assert!(
        found.largest <= ALLOWED && found.left_out < 50,
        "{:e}, {} left out",
        found.largest,
        found.left_out
    );
}

#[test]
fn the_comparison_sees_every_small_change() {
    let Some(gpu) = card("the_comparison_sees_every_small_change") else { return };
    let stone = built(&brilliant((56.0, 34.5, 40.8), (50.0, 77.0), 96));
    let steeper = built(&brilliant((56.0, 34.5, 40.9), (50.0, 77.0), 96));
    let (diamond, view) = (Medium::clear(2.4175), View { tilt: 0.13, azimuth: 0.4, ..View::default() });
    let case = || Case::new(&stone.polytope, diamond, &view, true);
    let shorter = RayOptions { most_bounces: 5, ..case().options };
    let plain = RayOptions { polarised: false, ..case().options };
    for (change, mutant) in [
        ("index", Case { twin_medium: Medium::clear(2.43), ..case() }),
        ("a plane", Case { twin: (&steeper.polytope).into(), ..case() }),
        (
            "bounces",
            Case { options: RayOptions { most_bounces: 6, ..shorter }, twin_options: shorter, ..case() },
        ),
        ("polarisation", Case { twin_options: plain, ..case() }),
        ("absorption", Case { twin_medium: Medium { absorption: [0.01; 2], ..diamond }, ..case() }),
    ] {
        let found = mutant.compared(&gpu);
        assert!(found.largest > 10.0 * ALLOWED, "{change}: only {:e}", found.largest);
    }
    let found = case().compared(&gpu);
    assert!(found.largest <= ALLOWED, "{:e}", found.largest);
}

fn mesh((vertices, triangles): solids::Triangles) -> Arc<TriangleMesh> {
    // The turn keeps edges away from the view's direction, where rounding would decide whether rays meet them.
    let mesh = TriangleMesh::new(Surface::new(vertices, triangles)).unwrap();
    Arc::new(mesh.reframed(&Pose::turned(DQuat::from_rotation_x(0.11) * DQuat::from_rotation_y(-0.07))))
}

#[test]
fn solids_that_are_not_convex_look_as_by_rays() {
    let Some(gpu) = card("solids_that_are_not_convex_look_as_by_rays") else { return };
    let media = [
        Medium::clear(2.4175),
        Medium { absorption: [0.1, 0.5], ..Medium::clear(1.77) },
        Medium::clear(1.54),
        Medium::clear(1.0),
    ];
    let solids = [("heart", solids::heart()), ("star", solids::star()), ("clasp", solids::clasp(0.4))];
    let (mut left_out, mut all) = (0, 0);
    for (k, (name, solid)) in solids.into_iter().enumerate() {
        let mesh = mesh(solid);
        for (i, (view, medium)) in views().iter().zip(media.iter().cycle().skip(k)).enumerate() {
            let found = Case::new(&mesh, *medium, view, (i + k) % 3 != 0).compared(&gpu);
            assert!(found.largest <= ALLOWED, "{name}, {medium:?}, {view:?}: {:e}", found.largest);
            assert!(found.energy <= 1e-4, "{name}, {medium:?}, {view:?}: energy off by {:e}", found.energy);
            left_out += found.left_out;
            all += found.counted + found.left_out;
        }
    }
    assert!(left_out * 500 <= all, "{left_out} of {all} pixels are left out");
}

#[test]
fn a_brilliant_of_triangles_looks_as_that_of_planes_on_the_card_too() {
    let Some(gpu) = card("a_brilliant_of_triangles_looks_as_that_of_planes_on_the_card_too") else { return };
    let stone = built(&brilliant((56.0, 34.5, 40.8), (50.0, 77.0), 16));
    let mesh = Arc::new(TriangleMesh::of_polytope(&stone.polytope));
    let view = View { tilt: 0.13, azimuth: 0.4, ..View::default() };
    let short = RayOptions { most_bounces: 24, polarised: true, least_weight: 1e-4 };
    let case = Case::new(&stone.polytope, Medium::clear(2.4175), &view, true);
    let found = Case { twin: (&mesh).into(), options: short, twin_options: short, ..case }.compared(&gpu);
    assert!(
        found.largest <= ALLOWED && found.left_out < 20,
        "{:e}, {} left out",
        found.largest,
        found.left_out
    );
}

#[test]
fn the_comparison_of_triangles_sees_every_small_change() {
    let Some(gpu) = card("the_comparison_of_triangles_sees_every_small_change") else { return };
    let whole = mesh(solids::star());
    let mut bent = whole.surface().clone();
    bent.vertices.iter_mut().for_each(|v| *v *= DVec3::new(1.0, 1.001, 1.0));
    let bent = Arc::new(TriangleMesh::new(bent).unwrap());
    let (diamond, view) = (Medium::clear(2.4175), View { tilt: 0.5, azimuth: 1.4, ..View::default() });
    let case = || Case::new(&whole, diamond, &view, true);
    let plain = RayOptions { polarised: false, ..case().options };
    let shorter = RayOptions { most_bounces: 5, ..case().options };
    for (change, mutant) in [
        ("index", Case { twin_medium: Medium::clear(2.43), ..case() }),
        ("a corner", Case { twin: (&bent).into(), ..case() }),
        ("polarisation", Case { twin_options: plain, ..case() }),
        ("bounces", Case { twin_options: shorter, ..case() }),
        ("absorption", Case { twin_medium: Medium { absorption: [0.02; 2], ..diamond }, ..case() }),
        ("light that enters again", Case { comes_back: false, ..case() }),
    ] {
        let found = mutant.compared(&gpu);
        assert!(found.largest > 10.0 * ALLOWED, "{change}: only {:e}", found.largest);
    }
    let found = case().compared(&gpu);
    assert!(found.largest <= ALLOWED, "{:e}", found.largest);
}
