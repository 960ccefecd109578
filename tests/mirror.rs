//! The graphics card against point rays in f64: the same chain of bounces, pixel by pixel.
#![cfg(feature = "gpu")]
#![allow(clippy::unwrap_used, reason = "a test fails by it")]

mod common;
#[path = "common/solids.rs"]
mod solids;

use brillianteer::math::{Plane, Shell, SolidRef, Surface};
use brillianteer::scene::{Film, Medium, Projection, Scope, Side, Stone, View};
use brillianteer::trace::gpu::{Gpu, GpuError, Seen, Shot};
use brillianteer::trace::ray::{Camera, Exit, Options, Tracer};
use brillianteer::trace::{Stopped, unwatched};
use common::*;
use glam::{DQuat, DVec2, DVec3};
use std::sync::Arc;

const SIZE: u32 = 96;

/// How far a pixel may be off, of full scale.
const ALLOWED: f64 = 1e-3;

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

/// What one ray sees, in the order of [`numbers`].
fn by_ray(
    tracer: &Tracer,
    camera: &Camera,
    (scope, view): (&Scope, &View),
    at: DVec2,
    comes_back: bool,
) -> [f64; 19] {
    let mut seen = [0.0; 19];
    let (origin, direction) = camera.ray(at);
    let met = tracer.meet(origin, direction);
    let is_taken = |_: &Exit, _| !comes_back;
    let way = (direction, DVec3::ZERO);
    let follow = |met| {
        tracer.follow_from(met, origin, way, 1.0, is_taken, |exit| {
            let band = scope.band(exit.direction, view.zenith());
            seen[if exit.surface { 8 } else { 0 } + band] += exit.weight;
        })
    };
    let rest = met.and_then(follow);
    if let Some(rest) = rest {
        (seen[16], seen[17], seen[18]) = (rest.absorbed, rest.unresolved, 1.0);
    }
    seen
}

fn numbers(seen: &Seen) -> [f64; 19] {
    let all = seen.transmitted.iter().chain(&seen.surface).chain(&seen.rest[..3]);
    let mut numbers = [0.0; 19];
    numbers.iter_mut().zip(all).for_each(|(n, &v)| *n = f64::from(v));
    numbers
}

fn differ(a: &[f64; 19], b: &[f64; 19]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// How a card's picture compares with the rays': pixels that count, those left out, and the largest difference.
struct Comparison {
    counted: usize,
    left_out: usize,
    largest: f64,
    energy: f64,
}

/// Where rays this far beside the pixel's, or through a stone of so little another index, see something else, an edge or
/// a critical angle is too near for f32, and the pixel may be left out.
const HAIR: f64 = 3e-5;
const OTHER_INDEX: f64 = 1e-5;

/// What is compared: a view of a stone, in f64 and, `twin`, on the card.
struct Case<'a> {
    solid: SolidRef<'a>,
    twin: SolidRef<'a>,
    medium: Medium,
    twin_medium: Medium,
    view: &'a View,
    options: Options,
    twin_options: Options,
    /// Whether rays that leave are followed when they meet the stone again.
    comes_back: bool,
}

impl<'a> Case<'a> {
    fn new(solid: impl Into<SolidRef<'a>>, medium: Medium, view: &'a View, polarised: bool) -> Self {
        let solid = solid.into();
        let options = Options { polarised, most_bounces: 64, least_weight: 1e-4 };
        Self {
            solid,
            twin: solid,
            medium,
            twin_medium: medium,
            view,
            options,
            twin_options: options,
            comes_back: true,
        }
    }

    fn compared(&self, gpu: &Gpu) -> Comparison {
        let (scope, solid, view) = (aset(), self.solid, self.view);
        let camera = Camera::new(view, solid);
        let film = Film::reaching(camera.reach(solid).unwrap(), SIZE);
        let film = Film { centre: DVec2::new(0.03, -0.02), ..film };
        let shot = Shot {
            solid: self.twin,
            medium: self.twin_medium,
            view,
            scope: &scope,
            film,
            per_side: 1,
            shift: DVec2::splat(0.5),
            options: self.twin_options,
        };
        let tracer = |factor: f64| {
            let medium = Medium { index: self.medium.index * factor, ..self.medium };
            Tracer::new(solid, medium, self.options)
        };
        let [exact, denser, rarer] = [1.0, 1.0 + OTHER_INDEX, 1.0 - OTHER_INDEX].map(tracer);
        let mut result = Comparison { counted: 0, left_out: 0, largest: 0.0, energy: 0.0 };
        let each = |first: u32, seen: &[Seen]| -> Result<(), Failed> {
            for (k, seen) in seen.iter().enumerate() {
                let pixel = DVec2::new(f64::from(k as u32 % SIZE), f64::from(first + k as u32 / SIZE));
                let at = film.image_from_pixels(pixel + 0.5);
                let look = |tracer, at| by_ray(tracer, &camera, (&scope, view), at, self.comes_back);
                let (found, expected) = (numbers(seen), look(&exact, at));
                result.energy = result.energy.max((found[..18].iter().sum::<f64>() - found[18]).abs());
                let off = differ(&found, &expected);
                let beside =
                    [DVec2::X, DVec2::Y, -DVec2::X, -DVec2::Y].map(|step| (&exact, at + step * HAIR));
                let near = beside.into_iter().chain([(&denser, at), (&rarer, at)]);
                if off > ALLOWED && near.into_iter().any(|(t, at)| differ(&look(t, at), &expected) > ALLOWED)
                {
                    result.left_out += 1;
                } else {
                    result.counted += 1;
                    result.largest = result.largest.max(off);
                }
            }
            Ok(())
        };
        gpu.scope(&shot, &unwatched, each).unwrap();
        assert_eq!(result.counted + result.left_out, (SIZE * SIZE) as usize);
        result
    }
}

fn views() -> [View; 6] {
    let tilted = |tilt, azimuth| View { tilt, azimuth, ..View::default() };
    [
        View::default(),
        tilted(0.13, 0.4),
        tilted(0.5, 2.0),
        View { side: Side::Culet, ..tilted(0.2, 1.1) },
        View { projection: Projection::Perspective { distance: 6.0 }, ..tilted(0.1, 0.7) },
        View { projection: Projection::Perspective { distance: 1000.0 }, ..View::default() },
    ]
}

fn shipped() -> Vec<(String, Stone)> {
    cut_files().into_iter().map(|(name, path)| (name, stone(&path))).collect()
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
    for (k, (name, stone)) in shipped().iter().enumerate() {
        for (view, medium) in views().iter().zip(media.iter().cycle().skip(k)) {
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
    let (view, short) = (View::default(), |options| Options { most_bounces: 12, ..options });
    let case = Case::new(&ball.polytope, Medium::clear(1.54), &view, true);
    let case = Case { options: short(case.options), twin_options: short(case.options), ..case };
    let found = case.compared(&gpu);
    // Facets are small, so that more pixels than in a gem lie near an edge of one of the bounces.
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
    let shorter = Options { most_bounces: 5, ..case().options };
    let plain = Options { polarised: false, ..case().options };
    for (change, mutant) in [
        ("index", Case { twin_medium: Medium::clear(2.43), ..case() }),
        ("a plane", Case { twin: (&steeper.polytope).into(), ..case() }),
        (
            "bounces",
            Case { options: Options { most_bounces: 6, ..shorter }, twin_options: shorter, ..case() },
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

fn shell((vertices, triangles): solids::Triangles) -> Arc<Shell> {
    // Turned a little: edges that lie along the rays of a view would be met or missed by rounding.
    let shell = Shell::new(Surface::new(vertices, triangles)).unwrap();
    Arc::new(shell.moved(1.0, DQuat::from_rotation_x(0.11) * DQuat::from_rotation_y(-0.07), DVec3::ZERO))
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
        let shell = shell(solid);
        for (i, (view, medium)) in views().iter().zip(media.iter().cycle().skip(k)).enumerate() {
            let found = Case::new(&shell, *medium, view, (i + k) % 3 != 0).compared(&gpu);
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
    let shell = Arc::new(Shell::of_polytope(&stone.polytope));
    let view = View { tilt: 0.13, azimuth: 0.4, ..View::default() };
    let short = Options { most_bounces: 24, polarised: true, least_weight: 1e-4 };
    let case = Case::new(&stone.polytope, Medium::clear(2.4175), &view, true);
    let found = Case { twin: (&shell).into(), options: short, twin_options: short, ..case }.compared(&gpu);
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
    let whole = shell(solids::star());
    let mut bent = whole.surface().clone();
    bent.vertices.iter_mut().for_each(|v| *v *= DVec3::new(1.0, 1.001, 1.0));
    let bent = Arc::new(Shell::new(bent).unwrap());
    let (diamond, view) = (Medium::clear(2.4175), View { tilt: 0.5, azimuth: 1.4, ..View::default() });
    let case = || Case::new(&whole, diamond, &view, true);
    let plain = Options { polarised: false, ..case().options };
    let shorter = Options { most_bounces: 5, ..case().options };
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
