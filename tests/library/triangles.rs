//! Checks solids of triangles: a convex one gives the same results as its planes, and one that is not convex accounts for
//! all light.

use crate::common::solids::{Triangles, clasp, heart, star};
use crate::common::*;
use brillianteer::base::{Stopped, unwatched};
use brillianteer::math::{Pose, SolidRef, Surface, TriangleMesh};
use brillianteer::measure;
use brillianteer::optics::{Material, Strata, material};
use brillianteer::picture::{
    ByBeams, Linear, Rows, by_rays,
    spectral::{Remainder, expose},
};
use brillianteer::scene::{Body, Film, Glare, Instance, Light, Medium, Scene, View, light};
use brillianteer::trace::{
    ScopeShot, beam,
    environment::{Environment, EnvironmentMap},
    ray::{ByRays, Camera, RayOptions, facet_at},
    sampling::{LitScene, Sampling},
};
use glam::{DQuat, DVec2, DVec3};
use std::sync::Arc;

const SIZE: u32 = 48;

fn mesh((vertices, triangles): Triangles) -> Arc<TriangleMesh> {
    Arc::new(TriangleMesh::new(Surface::new(vertices, triangles)).unwrap())
}

fn options() -> RayOptions {
    RayOptions { polarised: true, most_bounces: 64, least_weight: 1e-4 }
}

fn view() -> View {
    View { tilt: 0.2, azimuth: 0.4, ..View::default() }
}

/// Does work with a lit scene of stones in one world.
fn taken<T>(stones: Vec<Instance>, light: &Light, work: impl FnOnce(&LitScene) -> T) -> T {
    let scene = Scene { instances: stones, metals: vec![], unit_mm: 3.25 };
    let (sky, view) = (EnvironmentMap::new(light, None), view());
    let environment = Environment {
        map: &sky,
        basis: view.light_basis(),
        eye: view.basis(),
        head: 0.0,
        backplate: None,
        backdrop: false,
    };
    let film = Film::square(SIZE, 1.1);
    work(&LitScene { scene: &scene, environment, view: &view, film, options: options() })
}

fn by_rays_of(stones: Vec<Instance>, light: &Light) -> (Linear, Remainder) {
    sampled(stones, light, Sampling::of(1))
}

fn sampled(stones: Vec<Instance>, light: &Light, sampling: Sampling) -> (Linear, Remainder) {
    taken(stones, light, |lit_scene| {
        let strata = Strata::new(2, 1, &light.spectrum, true);
        let prepare = |rows| Ok::<_, Stopped>(ByRays::new(*lit_scene, rows));
        expose(lit_scene, (&strata, sampling), SIZE, prepare, &unwatched).unwrap()
    })
}

/// A sampling of one pass in which weak light goes on by chance.
fn by_chance() -> Sampling {
    Sampling { by_chance: 0.1, ..Sampling::of(1) }
}

/// Counts the pixels that differ by more than rounding, and those that show anything.
fn apart(a: &Linear, b: &Linear) -> (usize, usize) {
    let off = |(a, b): (&[f32; 4], &[f32; 4])| (0..4).any(|i| (a[i] - b[i]).abs() > 1e-4);
    (
        a.pixels.iter().zip(&b.pixels).filter(|&p| off(p)).count(),
        a.pixels.iter().filter(|p| p[3] > 0.0).count(),
    )
}

#[test]
fn a_brilliant_of_triangles_has_the_figures_and_pictures_of_its_planes() {
    let stone = built(&brilliant((56.0, 34.5, 40.8), (50.0, 77.0), 16));
    let mesh = Arc::new(TriangleMesh::of_polytope(&stone.polytope));
    let medium = Medium { absorption: [0.1, 0.2], ..Medium::clear(2.4175) };
    let (view, scope, manner) = (view(), aset(), (options(), 24));
    let planes = measure::by_rays(&stone.polytope, medium, &view, &scope, manner, &unwatched).unwrap();
    let triangles = measure::by_rays(&mesh, medium, &view, &scope, manner, &unwatched).unwrap();
    // Rounding decides which way a ray along an edge goes.
    assert!(largest_difference(&row(&planes), &row(&triangles)) < 1e-3, "{planes:?} {triangles:?}");
    assert!((triangles.sum() - 1.0).abs() < 1e-9);
    assert!((planes.silhouette_area / triangles.silhouette_area - 1.0).abs() < 0.02);
    let film = Film::reaching(Camera::new(&view, &mesh).reach(&mesh).unwrap(), SIZE);
    let (view, scope, shift, options) = (&view, &scope, DVec2::splat(0.5), options());
    let rows = |solid: SolidRef| {
        let mut all: Vec<Rows> = vec![];
        let each = |rows: &Rows| -> Result<(), Stopped> {
            all.push(rows.clone());
            Ok(())
        };
        let shot = ScopeShot { solid, medium, view, scope, film, per_side: 1, shift, options };
        by_rays::trace(&shot, Glare::Included, &unwatched, each).unwrap();
        let channels = 2 * scope.bands.len() + 1;
        let row = |r: &Rows, y: u32| (0..channels).flat_map(|c| r.row(y, c).to_vec()).collect::<Vec<_>>();
        all.iter()
            .flat_map(|r| (r.first..r.first + r.count).flat_map(|y| row(r, y)).collect::<Vec<_>>())
            .collect()
    };
    let (a, b): (Vec<f64>, Vec<f64>) = (rows((&stone.polytope).into()), rows((&mesh).into()));
    let off = a.iter().zip(&b).filter(|(a, b)| (*a - *b).abs() > 1e-6).count();
    assert!(a.len() == b.len() && off * 1000 < a.len(), "{off} of {}", a.len());
    let diamond = material("diamond").unwrap();
    let light = light("studio").unwrap();
    let of = |body: Body| by_rays_of(vec![Instance::new(body, diamond.clone())], &light);
    let ((a, _), (b, _)) = (of(stone.polytope.clone().into()), of(mesh.into()));
    let (off, all) = apart(&a, &b);
    assert!(all > 500 && off * 200 < all, "{off} of {all}");
}

#[test]
fn a_white_furnace_is_white_around_solids_that_are_not_convex() {
    for (name, solid) in [("heart", heart()), ("star", star()), ("clasp", clasp(0.4))] {
        for index in [1.0, 1.54, 2.4175] {
            let stone = Instance::new(mesh(solid.clone()), Material::from_index("glass", index).unwrap());
            let white = Light { head: 0.0, ..light("white").unwrap() };
            let (picture, rest) = by_rays_of(vec![stone], &white);
            let seen: Vec<DVec3> = picture
                .pixels
                .iter()
                .filter(|p| p[3] > 0.0)
                .map(|p| DVec3::new(p[0].into(), p[1].into(), p[2].into()))
                .collect();
            let mean = seen.iter().sum::<DVec3>() / seen.len() as f64;
            assert!(rest.unresolved < 2e-3, "{name}, {index}: {rest:?}");
            let most = 3.0 * rest.unresolved + 1e-6;
            assert!((mean - 1.0).abs().max_element() < most, "{name}, {index}: {mean}, {rest:?}");
        }
    }
}

#[test]
fn a_white_furnace_is_white_in_the_mean_where_weak_light_goes_on_by_chance() {
    let white = Light { head: 0.0, ..light("white").unwrap() };
    for (name, solid) in [("heart", heart()), ("star", star()), ("clasp", clasp(0.4))] {
        let stone = Instance::new(mesh(solid), material("diamond").unwrap().clone());
        let (picture, rest) = sampled(vec![stone], &white, by_chance());
        let seen: Vec<f64> = picture.pixels.iter().filter(|p| p[3] > 0.0).map(|p| p[1].into()).collect();
        let count = seen.len() as f64;
        let mean = seen.iter().sum::<f64>() / count;
        let variance = seen.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (count - 1.0);
        let error = (variance / count).sqrt();
        // Only what is left after the most bounces is unresolved; the error is small enough to notice a percent.
        assert!(rest.unresolved < 1e-3 && error < 0.003, "{name}: {rest:?}, {error}");
        assert!((mean - 1.0).abs() < 4.0 * error + rest.unresolved, "{name}: {mean} ± {error}");
    }
}

#[test]
fn chance_is_the_same_on_any_number_of_cores_and_another_in_each_pass() {
    let stone = || vec![Instance::new(mesh(star()), material("diamond").unwrap().clone())];
    let light = light("studio").unwrap();
    let on = |cores: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(cores).build().unwrap();
        pool.install(|| sampled(stone(), &light, by_chance()))
    };
    let (one, two) = (on(1), on(2));
    assert_eq!((&one.0.pixels, one.1), (&two.0.pixels, two.1));
    assert_ne!(one.0.pixels, by_rays_of(stone(), &light).0.pixels);
    let numbers = [0, 1].map(|pass| {
        [0, 1].map(|band| {
            taken(stone(), &light, |lit_scene| {
                by_chance()
                    .pass(lit_scene.scene, &Strata::new(2, 1, &light.spectrum, true), pass)
                    .roulette([3, 5], band)
            })
        })
    });
    let [[a, b], [c, d]] = numbers;
    assert!(a.is_some() && a != b && a != c && b != c && c != d);
}

#[test]
fn a_stone_in_the_gap_of_another_is_seen_there() {
    // The same two stones, with the clasp as triangles and as three bars side by side. Only touching surfaces differ, and
    // with the index of air they change nothing. A dark cube in the gap is seen through the clasp.
    let air = Material::from_index("air", 1.0).unwrap();
    let mut dark = air.clone();
    dark.absorption = [(); 2].map(|()| brillianteer::optics::Absorption::new(vec![(550.0, 1e3)]).unwrap());
    let square = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)].map(|p| DVec2::from(p) * 0.3);
    let cube = Instance::new(mesh(solids::extruded(&square, 0.3)), dark)
        .moved(&Pose { at: DVec3::new(0.3, 0.02, 0.0), ..Pose::turned(DQuat::from_rotation_x(0.2)) });
    let turn = Pose::turned(DQuat::from_rotation_x(1.3));
    let (clasp, cube) = (Instance::new(mesh(clasp(0.4)), air).moved(&turn), cube.moved(&turn));
    let light = light("white").unwrap();
    let alone = by_rays_of(vec![cube.clone()], &light).0;
    let both = by_rays_of(vec![clasp, cube], &light).0;
    let dark = |p: &Linear| p.pixels.iter().map(|p| p[3] > 0.0 && p[1] < 0.01).collect::<Vec<_>>();
    let (alone, both) = (dark(&alone), dark(&both));
    let (off, all) =
        (alone.iter().zip(&both).filter(|(a, b)| a != b).count(), alone.iter().filter(|d| **d).count());
    assert!(all > 100 && off * 50 < all, "{off} of {all}");
}

#[test]
fn exact_beams_say_that_they_do_not_apply_to_triangles() {
    let body = Body::from(mesh(heart()));
    let error = body.stone().unwrap_err().to_string();
    assert!(
        error.contains("exact beams and drawings are for convex stones") && error.contains("use rays"),
        "{error}"
    );
    let stone = Instance::new(body, material("diamond").unwrap().clone());
    let refused = taken(vec![stone], &light("studio").unwrap(), |lit_scene| {
        let facet = facet_at(lit_scene, 0.5 * f64::from(SIZE), 0.5 * f64::from(SIZE));
        assert!(facet.is_some_and(|(stone, facet)| stone == 0 && facet < 100), "{facet:?}");
        ByBeams::new(*lit_scene, beam::BeamOptions::default()).is_none()
    });
    assert!(refused);
}

#[cfg(feature = "gpu")]
mod by_card {
    use super::*;
    use brillianteer::trace::gpu::{ByCard, Gpu, GpuEnvironment, GpuError};

    #[derive(Debug)]
    #[expect(dead_code, reason = "what went wrong is printed by its Debug")]
    struct Failed(String);

    impl From<GpuError> for Failed {
        fn from(error: GpuError) -> Self {
            Self(error.to_string())
        }
    }

    impl From<Stopped> for Failed {
        fn from(error: Stopped) -> Self {
            Self(error.to_string())
        }
    }

    fn by_card_of(gpu: &Gpu, stones: Vec<Instance>, light: &Light) -> (Linear, Remainder) {
        taken(stones, light, |lit_scene| {
            let strata = Strata::new(2, 1, &light.spectrum, true);
            let around = GpuEnvironment::new(gpu, &lit_scene.environment).unwrap();
            let prepare = |rows| Ok::<_, Failed>(ByCard::new(gpu, lit_scene, &around, rows, 2)?);
            expose(lit_scene, (&strata, Sampling::of(1)), SIZE, prepare, &unwatched).unwrap()
        })
    }

    #[test]
    fn stones_of_triangles_look_under_light_as_by_rays() {
        let Some(gpu) = card("stones_of_triangles_look_under_light_as_by_rays") else { return };
        let stone = |solid, name: &str| {
            let turn = DQuat::from_rotation_x(0.11) * DQuat::from_rotation_y(-0.07);
            Instance::new(mesh(solid), material(name).unwrap().clone()).moved(&Pose::turned(turn))
        };
        let brilliant = built(&brilliant((56.0, 34.5, 40.8), (50.0, 77.0), 16)).polytope;
        let planes = Instance::new(brilliant, material("quartz").unwrap().clone()).moved(&Pose {
            at: DVec3::new(0.35, 0.03, 0.0),
            turn: DQuat::from_rotation_x(1.1),
            scale: 0.3,
        });
        let scenes = [
            vec![stone(heart(), "diamond")],
            vec![stone(star(), "ruby")],
            // A brilliant in the clasp's gap, so that light goes to and fro between the two.
            vec![stone(clasp(0.4), "quartz"), planes],
        ];
        let light = light("dome").unwrap();
        for (k, scene) in scenes.into_iter().enumerate() {
            let (rays, rest) = by_rays_of(scene.clone(), &light);
            let (card, card_rest) = by_card_of(&gpu, scene, &light);
            let scale = rays.pixels.iter().map(|p| p[1]).fold(0.0, f32::max);
            let off = |(a, b): (&[f32; 4], &[f32; 4])| (0..4).any(|i| (a[i] - b[i]).abs() > 0.005 * scale);
            let apart = rays.pixels.iter().zip(&card.pixels).filter(|&p| off(p)).count();
            let all = rays.pixels.iter().filter(|p| p[3] > 0.0).count();
            assert!(all > 300 && apart * 50 < all, "{k}: {apart} of {all}");
            assert!((rest.unresolved - card_rest.unresolved).abs() < 1e-3, "{k}: {rest:?} {card_rest:?}");
            assert!((rest.absorbed - card_rest.absorbed).abs() < 1e-3, "{k}: {rest:?} {card_rest:?}");
        }
    }
}
