//! The benchmarks that docs/performance.md reports: `cargo bench`. They run on one core, so that figures of different
//! machines can be compared.

use brillianteer::base::{Stopped, unwatched};
use brillianteer::cut::{Crown, Cut, LowerHalf, MaterialRef, Pavilion, RoundBrilliant, TierChange};
use brillianteer::io::{WriteError, as_tiers, cut_file, library, write_png};
use brillianteer::measure::{MeasureName, MeasureSettings, by_beams_and_rays};
use brillianteer::optics::{Strata, line, material};
use brillianteer::picture::{ByBeams, Layer, Palette, paint, spectral::expose};
use brillianteer::render::{Sweep, SweepKey};
use brillianteer::scene::{
    ASET_CONE, Backing, Film, Glare, Instance, Light, Medium, Scene, Scope, Specimen, Stone, View, Viewpoint,
};
use brillianteer::trace::{
    beam,
    environment::{Environment, EnvironmentMap},
    ray,
    sampling::{LitScene, Sampling},
};
use criterion::{Criterion, criterion_group, criterion_main};
use glam::DVec2;
use std::hint::black_box;

#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

const DIAMOND: Medium = Medium::clear(2.4175);

fn modern_ideal(girdle_thickness: f64) -> Stone {
    let cut = RoundBrilliant {
        table: 56.0,
        crown: Crown::Angle(34.5),
        pavilion: Pavilion::Angle(40.8),
        star_length: 50.0,
        lower_half: LowerHalf::Radial(77.0),
        girdle_thickness,
        girdle_facets: 96,
        culet: 0.0,
    };
    Stone::new(&cut.facets().expect("valid proportions")).expect("a closed stone")
}

fn beams(stone: &Stone, tilt_deg: f64, unresolved: f64) -> beam::Beams {
    let view = View { tilt: tilt_deg.to_radians(), azimuth: 0.2, ..View::default() };
    let options = beam::BeamOptions { unresolved, ..beam::BeamOptions::default() };
    beam::trace(&stone.polytope, DIAMOND, &view, &options, &unwatched).expect("unwatched")
}

fn beam_tracing(c: &mut Criterion) {
    let stone = modern_ideal(3.0);
    c.bench_function("beams: face up, 1 % unresolved (goal 5 ms)", |b| b.iter(|| beams(&stone, 0.0, 0.01)));
    c.bench_function("beams: face up, 0.1 % unresolved (goal 60 ms)", |b| {
        b.iter(|| beams(&stone, 0.0, 0.001))
    });
    c.bench_function("beams: tilted 15 degrees, 1 % unresolved (goal 60 ms)", |b| {
        b.iter(|| beams(&stone, 15.0, 0.01));
    });
}

fn figures(c: &mut Criterion) {
    let stone = modern_ideal(3.0);
    let scope = Scope::aset(ASET_CONE, Backing::Black);
    let mut run = |name: &str, tilt_deg: f64, standard_error: f64| {
        let view = View { tilt: tilt_deg.to_radians(), azimuth: 0.2, ..View::default() };
        let options = beam::BeamOptions { unresolved: 1.0, ..beam::BeamOptions::default() };
        c.bench_function(name, |b| {
            b.iter(|| {
                let polytope = &stone.polytope;
                let of = beam::SumOptions { scope: &scope, standard_error: Some(standard_error) };
                let summed =
                    beam::sum_up(polytope, DIAMOND, &view, &options, of, &unwatched).expect("unwatched");
                by_beams_and_rays(polytope, &summed, standard_error, &unwatched).expect("unwatched")
            });
        });
    };
    run("figures: face up, standard error 1e-4 (goal 3 ms)", 0.0, 1e-4);
    run("figures: tilted 15 degrees, standard error 1e-4 (goal 60 ms)", 15.0, 1e-4);
    run("figures: tilted 15 degrees, standard error 1e-3", 15.0, 1e-3);
}

fn energy_picture(c: &mut Criterion) {
    let stone = modern_ideal(3.0);
    let folder = tempfile::tempdir().expect("a folder for temporary files");
    let path = folder.path().join("energy.png");
    let scope = Scope::aset(ASET_CONE, Backing::Black);
    c.bench_function("picture: 1024 PNG of energy, all told (goal 150 ms)", |b| {
        b.iter(|| {
            let beams = beams(&stone, 0.0, 0.001);
            let film = Film::around(&stone.polytope, &beams.view, 1024);
            let palette = Palette::of(&scope);
            write_png(&path, (1024, 1024), "", |png| {
                paint(
                    &Layer::energy(&beams, &scope, Glare::Included),
                    &film,
                    &unwatched,
                    |rows| -> Result<(), WriteError> {
                        let mut pixels = Vec::new();
                        (rows.first..rows.first + rows.count)
                            .for_each(|y| palette.encode(rows, 0, y, &mut pixels));
                        png.push(&pixels)
                    },
                )
            })
        });
    });
}

/// Renders of a tilted brilliant at 64 wavelengths: beams of each wavelength alone, and beams that they share.
fn renders(c: &mut Criterion) {
    let view = View { tilt: 15_f64.to_radians(), azimuth: 20_f64.to_radians(), ..View::default() };
    let light = Light::studio();
    let map = EnvironmentMap::new(&light, None);
    let (basis, eye, head) = (view.light_basis(), view.basis(), light.head.to_radians());
    let environment = Environment { map: &map, basis, eye, head, backplate: None, backdrop: false };
    let diamond = material("diamond").expect("a material of the program").clone();
    let instances = vec![Instance::new(modern_ideal(3.0).polytope, diamond)];
    let scene = Scene { instances, metals: vec![], unit_mm: 3.25 };
    let (film, options) = (Film::square(600, 1.06), ray::RayOptions::default());
    let lit_scene = LitScene { scene: &scene, environment, view: &view, film, options };
    let strata = Strata::new(16, 4, &light.spectrum, true);
    let beams = beam::BeamOptions { unresolved: 2e-3, most_beams: 100_000, ..beam::BeamOptions::default() };
    for (name, is_apart) in [("wavelengths apart", true), ("shared beams (goal a tenth)", false)] {
        c.bench_function(&format!("render: tilted 15 degrees, 600 squared, 64 wavelengths, {name}"), |b| {
            b.iter(|| {
                let prepare = |rows| {
                    let image = ByBeams::of_rows(lit_scene, beams, rows).expect("beams apply");
                    Ok::<_, Stopped>(if is_apart { image.apart() } else { image })
                };
                expose(&lit_scene, (&strata, Sampling::of(4)), 600, prepare, &unwatched)
            });
        });
    }
}

fn rays(c: &mut Criterion) {
    let stone = modern_ideal(0.0);
    assert_eq!(stone.polytope.facets().len(), 57);
    let camera = ray::Camera::new(&View::default(), &stone.polytope);
    let mut run = |name: &str, polarised: bool| {
        let options = ray::RayOptions { polarised, most_bounces: 12, least_weight: 0.0 };
        let tracer = ray::StoneTracer::new(&stone.polytope, DIAMOND, options);
        c.bench_function(name, |b| {
            b.iter(|| {
                let mut sum = 0.0;
                for i in 0..512 * 512 {
                    let p = DVec2::new(f64::from(i % 512), f64::from(i / 512)) / 256.0 - 1.0;
                    let (origin, direction) = camera.ray(p);
                    tracer.follow(origin, direction, |exit| sum += exit.weight);
                }
                black_box(sum)
            });
        });
    };
    run("rays: 12 bounces, 57 planes, 512 squared, unpolarised (goal 200 ms)", false);
    run("rays: 12 bounces, 57 planes, 512 squared, polarised", true);
}

fn geometry(c: &mut Criterion) {
    let planes: Vec<_> = modern_ideal(3.0).polytope.planes().collect();
    c.bench_function("polytope: a brilliant of 153 planes", |b| {
        b.iter(|| brillianteer::math::Polytope::from_planes(black_box(&planes)));
    });
}

/// An edit of a tier of 193 facets: the meets are followed, and the stone is built anew. The goal is 5 ms together.
fn edits(c: &mut Criterion) {
    let text = library::cut("portuguese").expect("it comes with the program");
    let mut design = cut_file::parse(text, "portuguese").expect("it is a cut");
    let given = Specimen::new(design.clone()).expect("a stone");
    let tiers = as_tiers(&given).expect("a stone between planes").with_own_meets();
    let main = tiers.tiers.iter().position(|tier| (-80.0..0.0).contains(&tier.angle)).expect("a pavilion");
    let (angle, distance) = (tiers.tiers[main].angle, tiers.tiers[main].distance);
    let mut turned = 0.0;
    let mut edited = || {
        turned = if turned < 0.04 { turned + 0.001 } else { 0.0 };
        tiers.changed(TierChange::Setting(main, angle + turned, distance))
    };
    c.bench_function("tiers: an edit of 193 facets, meets followed", |b| b.iter(&mut edited));
    c.bench_function("tiers: an edit of 193 facets, meets followed and stone built (goal 5 ms)", |b| {
        b.iter(|| {
            design.cut = Cut::Tiers(edited().tiers);
            Specimen::new(design.clone()).expect("a stone")
        });
    });
}

/// One figure of a design without and with its gradient by seven numbers. Both make the stone and trace it.
fn gradients(c: &mut Criterion) {
    let mut design =
        cut_file::parse(library::cut("modern-ideal").expect("a cut"), "modern-ideal").expect("a cut");
    design.material = MaterialRef::Index(2.4175);
    let name: MeasureName = "return-cos2".parse().expect("a measure");
    let sweep = |tilt_deg: f64| Sweep {
        design: design.clone(),
        viewpoint: Viewpoint { tilt_deg, azimuth_deg: 11.0, ..Viewpoint::default() },
        axes: vec![],
        settings: MeasureSettings {
            domes: name.dome().into_iter().collect(),
            ..MeasureSettings::usual([1.0; 2])
        },
        wavelength_nm: line::SODIUM_D,
        unresolved: 0.002,
        polarised: true,
    };
    let keys: Vec<SweepKey> =
        ["table", "crown_angle", "pavilion_angle", "star_length", "lower_half_length", "girdle_thickness"]
            .into_iter()
            .map(SweepKey::of)
            .chain([SweepKey::Index])
            .collect();
    for (how, tilt_deg) in [("face up", 0.0), ("tilted 15 degrees", 15.0)] {
        let sweep = sweep(tilt_deg);
        c.bench_function(&format!("measures: {how}, 0.2 % unresolved"), |b| {
            b.iter(|| sweep.point(0, 1, &unwatched).expect("a stone"));
        });
        c.bench_function(&format!("gradient: {how}, by 7 numbers (goal 4 times the measures)"), |b| {
            b.iter(|| sweep.gradient(&keys, &[name], &unwatched).expect("a stone"));
        });
    }
}

fn on_one_core() -> Criterion {
    // This fails only where a pool exists already, and then that pool is used.
    let _ = rayon::ThreadPoolBuilder::new().num_threads(1).build_global();
    Criterion::default().sample_size(20)
}

criterion_group! { name = light; config = on_one_core(); targets = beam_tracing, figures, energy_picture, renders, rays, geometry, edits, gradients }
criterion_main!(light);
