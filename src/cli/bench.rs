//! `bench`: measures how long each tracer takes for the same pictures on this machine.

use super::plan::on_card;
use super::specimen::LoadedSpecimen;
use super::{Failure, json, print};
use crate::io::mesh_options::MeshOptions;
use crate::math::Polytope;
use crate::optics::{line, strata};
use crate::picture::by_rays::ScopeSampling;
use crate::picture::{ByBeams, Layer, paint};
use crate::scene::{ASET_CONE, Backing, Film, Glare, Instance, Light, Medium, Scene, Scope, View};
use crate::trace::environment::{Environment, EnvironmentMap};
use crate::trace::ray::{ByRays, Camera, RayOptions, StoneTracer};
use crate::trace::sampling::{LitScene, ProgressiveImage, SamplePass};
use crate::trace::{RayTracer, Subject, beam, unwatched};
use clap::Args;
use glam::DVec2;
use serde_json::{Value, json};
use std::path::Path;
use std::time::Instant;

/// The share of the light that exact beams may leave unresolved.
const UNRESOLVED: f64 = 0.01;

/// The number of timed runs of each task, after one to warm up. The median counts.
const TIMES: usize = 5;

/// The time of a first run, in milliseconds, above which the task is not repeated.
const LONG_MS: f64 = 700.0;

/// The pictures in a scope: pixels along each side, with one ray each, and the most bounces of a ray.
const SCOPES: [(u32, u32); 2] = [(512, 7), (1024, 32)];

/// The picture under light: pixels along each side with a real graphics card and without one, the most bounces of a ray, and
/// the wavelengths of its single sample pass.
const LIT: ([u32; 2], u32, u32) = ([1024, 256], 32, 16);

#[derive(Debug, Args)]
pub struct BenchArguments {
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// The time that one tracer took for a task.
struct Row {
    tracer: &'static str,
    by: String,
    milliseconds: f64,
}

/// A picture, and how long each tracer took for it.
struct Task {
    what: String,
    /// The number of planes tested for the picture, if each ray tests all planes at each bounce.
    plane_tests: f64,
    rows: Vec<Row>,
}

impl BenchArguments {
    pub fn run(&self) -> Result<(), Failure> {
        let specimen = LoadedSpecimen::load(Path::new("modern-ideal"), MeshOptions::default())?;
        let card = on_card();
        let threads = rayon::current_num_threads();
        if !self.json {
            print(&format!("modern ideal face up; {threads} threads"))?;
        }
        let mut tasks = vec![];
        let mut done = |task: Task| {
            tasks.push(task.json());
            if self.json { Ok(()) } else { print(&format!("\n{}", task.table())) }
        };
        for (size, bounces) in SCOPES {
            done(in_scope(&specimen, card, size, bounces)?)?;
        }
        done(under_light(&specimen, card)?)?;
        if !self.json {
            return Ok(());
        }
        print(&json(&json!({ "threads": threads, "card": card.description(), "tasks": tasks })))
    }
}

impl Task {
    /// Returns the planes tested per second; `None` for beams, which test no planes.
    fn rate(&self, row: &Row) -> Option<f64> {
        (row.tracer != "beam").then(|| self.plane_tests / row.milliseconds * 1e3)
    }

    fn json(&self) -> Value {
        let row = |row: &Row| json!({ "tracer": row.tracer, "by": row.by, "ms": row.milliseconds, "plane_tests_per_second": self.rate(row) });
        let rows: Vec<Value> = self.rows.iter().map(row).collect();
        json!({ "task": self.what, "plane_tests": self.plane_tests, "results": rows })
    }

    fn table(&self) -> String {
        let line = |row: &Row| {
            let rate = self.rate(row).map(|r| format!("{:.1} G/s", r / 1e9)).unwrap_or_default();
            format!("\n{:>10.2} ms {rate:>12}  {}", row.milliseconds, row.by)
        };
        let rows: String = self.rows.iter().map(line).collect();
        format!("{}\n{:>13} {:>12}{rows}", self.what, "a picture", "plane tests")
    }
}

/// Times `work` and returns the median of several runs, or the first run where it is long, in milliseconds.
fn timed(mut work: impl FnMut() -> Result<(), Failure>) -> Result<f64, Failure> {
    let mut once = || {
        let start = Instant::now();
        work().map(|()| start.elapsed().as_secs_f64() * 1e3)
    };
    let first = once()?;
    if first > LONG_MS {
        return Ok(first);
    }
    let mut times = (0..TIMES).map(|_| once()).collect::<Result<Vec<f64>, Failure>>()?;
    times.sort_by(f64::total_cmp);
    Ok(times[TIMES / 2])
}

fn options(most_bounces: u32) -> RayOptions {
    RayOptions { polarised: true, most_bounces, least_weight: 1e-4 }
}

/// Times an ASET picture by every tracer. For beams the time includes painting.
fn in_scope(specimen: &LoadedSpecimen, card: RayTracer, size: u32, bounces: u32) -> Result<Task, Failure> {
    let (view, scope) = (View::default(), Scope::aset(ASET_CONE, Backing::Black));
    let medium = Medium::clear(specimen.material.index(line::SODIUM_D));
    let look = Subject { specimen, medium, view: &view, scope: &scope };
    let polytope = polytope(specimen)?;
    let film = Film::around(polytope, &view.basis(), size);
    let manner = ScopeSampling { options: options(bounces), per_side: 1, glare: Glare::Included };
    let mut rows = vec![];
    for sampler in samplers(card) {
        let picture = || sampler.rows(look, &film, &manner, &unwatched, |_| Ok(()));
        rows.push(Row { tracer: sampler.name(), by: sampler.description(), milliseconds: timed(picture)? });
    }
    let options = beam::BeamOptions { unresolved: UNRESOLVED, ..beam::BeamOptions::default() };
    let beams = || {
        let beams = beam::trace(polytope, medium, &view, &options, &unwatched)?;
        paint(&Layer::energy(&beams, &scope, Glare::Included), &film, &unwatched, |_| Ok::<_, Failure>(()))
    };
    let by = format!("exact beams, unresolved {UNRESOLVED}");
    rows.push(Row { tracer: "beam", by, milliseconds: timed(beams)? });
    let planes = polytope.facets().len();
    let what = format!("ASET, {planes} planes, {size} x {size}, {bounces} bounces at most");
    Ok(Task { what, plane_tests: plane_tests(polytope, &film, medium, bounces), rows })
}

fn polytope(specimen: &LoadedSpecimen) -> Result<&Polytope, Failure> {
    let told = |why| Failure::Usage(format!("{}: {why}", specimen.path));
    Ok(&specimen.stone().map_err(told)?.polytope)
}

/// Returns the ray tracers to compare: the processor, and the card where there is one.
fn samplers(card: RayTracer<'_>) -> Vec<RayTracer<'_>> {
    if card.name() == RayTracer::Rays.name() { vec![card] } else { vec![RayTracer::Rays, card] }
}

/// Times a picture of a diamond under small lamps, in one sample pass of many wavelengths, by every tracer.
fn under_light(specimen: &LoadedSpecimen, card: RayTracer) -> Result<Task, Failure> {
    let ([with_card, without], bounces, wavelengths) = LIT;
    let size = if card.is_quick() { with_card } else { without };
    let light = Light::lamps_on_dome();
    let (sky, view) = (EnvironmentMap::new(&light, None), View::default());
    let polytope = polytope(specimen)?;
    let stone = Instance::of(&specimen.body, specimen.material.clone(), &specimen.design.name);
    let setting = Scene { instances: vec![stone], unit_mm: specimen.design.diameter_mm / 2.0 };
    let film = Film::around(polytope, &view.basis(), size);
    let basis = view.light_basis();
    let lit_scene = LitScene {
        scene: &setting,
        environment: Environment {
            map: &sky,
            basis,
            eye: view.basis(),
            head: 0.0,
            backplate: None,
            backdrop: false,
        },
        view: &view,
        film,
        options: options(bounces),
    };
    let strata = strata(wavelengths, &light.spectrum, true);
    let look = SamplePass::new(&setting, &strata, 0);
    let mut rows = vec![];
    for sampler in samplers(card) {
        let mut exposure = exposure(sampler, &lit_scene, strata.len())?;
        let milliseconds = timed(|| exposure.add_pass(&look, &unwatched))?;
        rows.push(Row { tracer: sampler.name(), by: sampler.description(), milliseconds });
    }
    let options = beam::BeamOptions { unresolved: UNRESOLVED, ..beam::BeamOptions::default() };
    if let Some(mut exposure) = ByBeams::new(lit_scene, options) {
        let milliseconds = timed(|| exposure.add_pass(&look, &unwatched))?;
        rows.push(Row { tracer: "beam", by: format!("exact beams, unresolved {UNRESOLVED}"), milliseconds });
    }
    let tests: f64 = look.media[0].iter().map(|&medium| plane_tests(polytope, &film, medium, bounces)).sum();
    let what = format!(
        "diamond under eight lamps, {} planes, {size} x {size}, {bounces} bounces at most, {wavelengths} wavelengths",
        polytope.facets().len()
    );
    Ok(Task { what, plane_tests: tests, rows })
}

fn exposure<'a>(
    sampler: RayTracer<'a>,
    lit_scene: &LitScene<'a>,
    #[cfg_attr(not(feature = "gpu"), expect(unused_variables, reason = "the card wants to know"))]
    bands: usize,
) -> Result<Box<dyn ProgressiveImage<Failure> + 'a>, Failure> {
    let rows = 0..lit_scene.film.size[1];
    match sampler {
        RayTracer::Rays => Ok(Box::new(ByRays::new(*lit_scene, rows))),
        #[cfg(feature = "gpu")]
        RayTracer::Card(gpu) => {
            use crate::trace::gpu::{ByCard, GpuEnvironment};
            let around = GpuEnvironment::new(gpu, &lit_scene.environment);
            Ok(Box::new(ByCard::new(gpu, lit_scene, &around, rows, bands)?))
        }
    }
}

/// Returns how many planes are tested for a picture, if each ray tests all planes at each bounce. The count is extrapolated
/// from the pixels of every eighth row and column.
fn plane_tests(polytope: &Polytope, film: &Film, medium: Medium, bounces: u32) -> f64 {
    const STEP: u32 = 8;
    let camera = Camera::new(&View::default(), polytope);
    let tracer = StoneTracer::new(polytope, medium, options(bounces));
    let side = film.size[0] / STEP;
    let pixels = (0..side * side).map(|k| DVec2::new(f64::from(k % side), f64::from(k / side)) + 0.5);
    let searches: f64 = pixels
        .map(|pixel| {
            let (origin, direction) = camera.ray(film.image_from_pixels(pixel * f64::from(STEP)));
            1.0 + f64::from(tracer.follow(origin, direction, |_| {}).map_or(0, |rest| rest.bounces))
        })
        .sum();
    searches * f64::from(STEP * STEP) * polytope.facets().len() as f64
}
