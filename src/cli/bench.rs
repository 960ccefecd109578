//! `bench`: measures how long each tracer takes for the same pictures on this machine, and which part of the work
//! limits a graphics card.

#[cfg(feature = "gpu")]
mod card_use;
mod report;

use super::console::{print, print_json, say};
use super::progress::WorkProgress;
use super::specimen::LoadedSpecimen;
use brillianteer_base::{Failure, unwatched};
use brillianteer_files::mesh_options::MeshOptions;
use brillianteer_math::Polytope;
use brillianteer_measure::{Bounds, STANDARD_ERROR};
use brillianteer_optics::line;
use brillianteer_render::{
    Backend, Card, FiguresProduct, Job, LightProduct, Product, Quality, Reading, RenderError, Renderer,
    ScopeProduct, Steps, Surroundings, Wanted,
};
use brillianteer_scene::{
    ASET_CONE, Backing, Film, Glare, Light, Medium, Scene, Scope, USUAL_BOUNCES, View, Viewpoint,
};
use brillianteer_trace::beam;
use brillianteer_trace::environment::{EnvironmentMap, Lighting};
use brillianteer_trace::ray::{Camera, RayOptions, StoneTracer};
use brillianteer_trace::sampling::SamplePass;
use clap::Args;
use glam::DVec2;
use report::{BenchReport, BenchRow, BenchTask, CardLine};
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

/// The share of the light that exact beams may leave unresolved.
const UNRESOLVED: f64 = 0.01;

/// The number of timed runs of each task, after one to warm up. Their median is the result.
const TIMES: usize = 5;

/// The time of a first run, in milliseconds, above which the task is not repeated.
const LONG_MS: f64 = 700.0;

/// The pictures in a scope: pixels along each side, with one ray each, and the most bounces of a ray.
const SCOPES: [(u32, u32); 2] = [(512, 7), (1024, 32)];

/// The picture under light: pixels along each side with a real graphics card and without one, the most bounces of a ray, and
/// the wavelengths of its single sample pass.
const LIT: ([u32; 2], u32, u32) = ([1024, 256], 32, 16);

/// The tilts at which figures are measured, degrees: without and with symmetry lost.
const TILTS: [f64; 2] = [0.0, 15.0];

/// The azimuth toward which the stone is tilted, degrees: in none of its mirror planes.
const AZIMUTH: f64 = 20.0;

#[derive(Debug, Args)]
pub struct BenchArguments {
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl BenchArguments {
    pub fn run(&self) -> Result<(), Failure> {
        let specimen = LoadedSpecimen::load(Path::new("modern-ideal"), &MeshOptions::default())?;
        let has_card = has_card();
        let threads = rayon::current_num_threads();
        if !self.json {
            print(&format!("modern ideal; {threads} threads{}", card_peak()?))?;
        }
        // Tables show how far it is; JSON comes in the end.
        let progress = self.json.then(|| WorkProgress::new("timing the tracers"));
        let mut tasks = vec![];
        let mut done = |task: BenchTask| -> Result<(), Failure> {
            if !self.json {
                print(&format!("\n{}", task.table()))?;
            }
            tasks.push(task);
            if let Some(progress) = &progress {
                // The progress never asks to stop.
                let _ = progress.watch()(tasks.len() as f64 / (SCOPES.len() + 1 + TILTS.len()) as f64);
            }
            Ok(())
        };
        for (size, bounces) in SCOPES {
            done(in_scope(&specimen, size, bounces)?)?;
        }
        done(under_light(&specimen, has_card)?)?;
        for tilt_deg in TILTS {
            done(figures(&specimen, tilt_deg)?)?;
        }
        drop(progress);
        if !self.json {
            return Ok(());
        }
        let card = Card::Machine.any().map_or("point rays".to_owned(), |card| card.description());
        print_json(&BenchReport { threads, card, tasks })
    }
}

/// Times `work`. Returns the median of several runs in milliseconds, or the first run where it is long, and the
/// number of runs.
fn timed(mut work: impl FnMut() -> Result<(), Failure>) -> Result<(f64, usize), Failure> {
    let mut once = || {
        let start = Instant::now();
        work().map(|()| start.elapsed().as_secs_f64() * 1e3)
    };
    let first = once()?;
    if first > LONG_MS {
        return Ok((first, 1));
    }
    let mut times = (0..TIMES).map(|_| once()).collect::<Result<Vec<f64>, Failure>>()?;
    times.sort_by(f64::total_cmp);
    Ok((times[TIMES / 2], TIMES + 1))
}

/// Returns in words the measured peaks of the machine's card; empty where there is none.
#[cfg(feature = "gpu")]
fn card_peak() -> Result<String, Failure> {
    let card = Card::Machine.any().ok();
    let gpu = card.as_ref().and_then(Backend::gpu);
    gpu.map_or(Ok(String::new()), |gpu| Ok(card_use::peak_line(gpu, &card_use::peak(gpu)?)))
}

/// Returns nothing: this build uses no card.
#[cfg(not(feature = "gpu"))]
fn card_peak() -> Result<String, Failure> {
    Ok(String::new())
}

/// Times a picture by a tracer; for a card, also describes the parts of its time.
#[cfg(feature = "gpu")]
fn timed_by(
    backend: &Backend,
    load: &Load,
    mut work: impl FnMut() -> Result<(), Failure>,
) -> Result<(f64, Option<CardLine>), Failure> {
    let Some(gpu) = backend.gpu() else { return Ok((timed(work)?.0, None)) };
    let peak = card_use::peak(gpu)?;
    // The first picture also compiles its shader, which takes a driver up to some seconds, once.
    work()?;
    gpu.take_totals();
    let (milliseconds, runs) = timed(work)?;
    let load = (load.plane_tests, load.busy_lanes(gpu.lanes()));
    let line = card_use::line(&peak, &gpu.take_totals(), (runs, milliseconds / 1e3), load);
    Ok((milliseconds, Some(line)))
}

/// Times a picture by a tracer.
#[cfg(not(feature = "gpu"))]
fn timed_by(
    _backend: &Backend,
    _load: &Load,
    work: impl FnMut() -> Result<(), Failure>,
) -> Result<(f64, Option<CardLine>), Failure> {
    Ok((timed(work)?.0, None))
}

fn options(most_bounces: u32) -> RayOptions {
    RayOptions { polarised: true, most_bounces, least_weight: 1e-4 }
}

/// The tracers that are compared.
const TRACERS: [Wanted; 3] = [Wanted::Rays, Wanted::Card, Wanted::Beams];

/// Returns whether the machine has a real graphics card. Prints a note where it has none at all.
fn has_card() -> bool {
    match Card::Machine.any() {
        Ok(card) => card.is_quick(),
        Err(why) => {
            say(&format!("note: {why}: tracing by rays on the processor"));
            false
        }
    }
}

/// Times a job by each tracer that there is, from its planning to the finished picture.
fn rows(job: &Job, load: &Load) -> Result<Vec<BenchRow>, Failure> {
    let row = |tracer: Wanted| {
        // Exact beams have no limit of bounces; the renderer would refuse a job that sets one.
        let bounces = if tracer == Wanted::Beams { USUAL_BOUNCES } else { job.quality.rays.most_bounces };
        let quality = Quality { tracer, rays: options(bounces), ..job.quality };
        let job = Job { quality, ..job.clone() };
        let plan = Renderer::new(Card::Machine).plan(&job).map_err(RenderError::from)?;
        if plan.no_card.is_some() {
            return Ok(None);
        }
        // Each run has a renderer of its own, since one that has run already would reuse the beams.
        let picture = || {
            let rendered = Renderer::new(Card::Machine).run(&job, &unwatched, &mut |_| Ok::<_, Failure>(()));
            rendered.map(|_| ())
        };
        let unresolved =
            if plan.backend.is_beams() { format!(", unresolved {UNRESOLVED}") } else { String::new() };
        let by = plan.backend.description() + &unresolved;
        let (milliseconds, card) = timed_by(&plan.backend, load, picture)?;
        Ok(Some(BenchRow::new(plan.backend.name(), by, milliseconds, card)))
    };
    TRACERS.into_iter().filter_map(|tracer| row(tracer).transpose()).collect()
}

fn quality(bounces: u32) -> Quality {
    let beams = beam::BeamOptions { unresolved: UNRESOLVED, ..beam::BeamOptions::default() };
    Quality {
        tracer: Wanted::Quickest,
        beams,
        standard_error: None,
        rays: options(bounces),
        samples: Some(1),
    }
}

/// Times an ASET picture by every tracer.
fn in_scope(specimen: &LoadedSpecimen, size: u32, bounces: u32) -> Result<BenchTask, Failure> {
    let medium = Medium::clear(specimen.material.index(line::SODIUM_D));
    let polytope = polytope(specimen)?;
    let film = Film::around(polytope, &View::default().basis(), size);
    let scope = Scope::aset(ASET_CONE, Backing::Black);
    let product = ScopeProduct { scope, medium, glare: Glare::Included, readings: vec![Reading::Energy] };
    let (scene, product) = (Arc::new(Scene::alone(specimen)), Product::Scope(product));
    let job = Job { scene, view: View::default(), film, product, quality: quality(bounces) };
    let planes = polytope.facets().len();
    let what = format!("ASET, {planes} planes, {size} x {size}, {bounces} bounces at most");
    let load = Load::new(polytope, film, &[medium], bounces);
    Ok(BenchTask::new(what, load.plane_tests, rows(&job, &load)?))
}

fn polytope(specimen: &LoadedSpecimen) -> Result<&Polytope, Failure> {
    let refused = |why| Failure::Usage(format!("{}: {why}", specimen.path));
    Ok(&specimen.stone().map_err(refused)?.polytope)
}

/// Times a picture of a diamond under small lamps, in one sample pass of many wavelengths, by every tracer.
fn under_light(specimen: &LoadedSpecimen, has_card: bool) -> Result<BenchTask, Failure> {
    let ([with_card, without], bounces, wavelengths) = LIT;
    let size = if has_card { with_card } else { without };
    let light = Light::lamps_on_dome();
    let map = EnvironmentMap::new(&light, None);
    let lighting = Arc::new(Lighting { light, map, warnings: vec![] });
    let polytope = polytope(specimen)?;
    let film = Film::around(polytope, &View::default().basis(), size);
    let product = LightProduct {
        surroundings: Surroundings { head: 0.0, ..Surroundings::of(lighting) },
        wavelengths,
        adapted: true,
        strength: 1.0,
        jitter: true,
        steps: Steps::Passes { first: 0, hidden: 0 },
    };
    let strata = product.strata(1);
    let (scene, product) = (Arc::new(Scene::alone(specimen)), Product::Light(product));
    let pass = SamplePass::new(&scene, &strata, 0);
    let load = Load::new(polytope, film, &pass.media[0], bounces);
    let job = Job { scene, view: View::default(), film, product, quality: quality(bounces) };
    let what = format!(
        "diamond under eight lamps, {} planes, {size} x {size}, {bounces} bounces at most, {wavelengths} wavelengths",
        polytope.facets().len()
    );
    Ok(BenchTask::new(what, load.plane_tests, rows(&job, &load)?))
}

/// Times the figures of a stone in the ASET by beams, whose rest is estimated by rays.
fn figures(specimen: &LoadedSpecimen, tilt_deg: f64) -> Result<BenchTask, Failure> {
    let medium = Medium::clear(specimen.material.index(line::SODIUM_D));
    let product = FiguresProduct { scope: Scope::aset(ASET_CONE, Backing::Black), medium };
    let (scene, product) = (Arc::new(Scene::alone(specimen)), Product::Figures(product));
    let view = Viewpoint { tilt_deg, azimuth_deg: AZIMUTH, ..Viewpoint::default() }.view();
    let quality = Quality::of_figures(&Bounds::default(), Wanted::Beams);
    let job = Job { scene, view, film: Film::NONE, product, quality };
    let (milliseconds, _) = timed(|| {
        let done = Renderer::default().run(&job, &unwatched, &mut |_| Ok::<_, Failure>(()));
        done.map(|_| ())
    })?;
    let by = format!("exact beams and rays, standard error {STANDARD_ERROR}");
    let what = format!("figures, tilted {tilt_deg} degrees, {} planes", polytope(specimen)?.facets().len());
    Ok(BenchTask::new(what, 0.0, vec![BenchRow::new("beam", by, milliseconds, None)]))
}

/// The work that a picture is for a tracer that tests all planes at each bounce.
struct Load {
    /// The number of planes tested, extrapolated from the pixels of every eighth row and column.
    plane_tests: f64,
    /// The number of searches of each ray in a workgroup, row by row, at the middle wavelength; every eighth
    /// workgroup each way is sampled.
    #[cfg(feature = "gpu")]
    groups: Vec<[f64; 64]>,
}

impl Load {
    /// Follows some rays of a picture face up at these wavelengths' media.
    fn new(polytope: &Polytope, film: Film, media: &[Medium], bounces: u32) -> Self {
        const STEP: u32 = 8;
        let camera = Camera::new(&View::default(), polytope);
        let searches = |medium: Medium| {
            let tracer = StoneTracer::new(polytope, medium, options(bounces));
            let camera = &camera;
            move |pixel: DVec2| {
                let (origin, direction) = camera.ray(film.image_from_pixels(pixel));
                1.0 + f64::from(tracer.follow(origin, direction, |_| {}).map_or(0, |rest| rest.bounces))
            }
        };
        let side = film.size[0] / STEP;
        let place = |k: u32| DVec2::new(f64::from(k % side), f64::from(k / side));
        let of_medium = |&medium: &Medium| -> f64 {
            (0..side * side).map(|k| (place(k) + 0.5) * f64::from(STEP)).map(searches(medium)).sum()
        };
        let all: f64 = media.iter().map(of_medium).sum();
        #[cfg(feature = "gpu")]
        let groups = {
            let of_middle = media.get(media.len() / 2).map(|&medium| searches(medium));
            let group = |k: u32| {
                let pixel = |n: u32| {
                    place(k) * f64::from(STEP) + DVec2::new(f64::from(n % 8), f64::from(n / 8)) + 0.5
                };
                std::array::from_fn(|n| of_middle.as_ref().map_or(1.0, |search| search(pixel(n as u32))))
            };
            (0..side * side).filter(|k| k % side % 8 == 3 && k / side % 8 == 3).map(group).collect()
        };
        let plane_tests = all * f64::from(STEP * STEP) * polytope.facets().len() as f64;
        Self {
            plane_tests,
            #[cfg(feature = "gpu")]
            groups,
        }
    }

    /// Returns the mean part of lanes, above 0, that still follow a ray where this number of lanes run in step until
    /// the last ray ends.
    #[cfg(feature = "gpu")]
    fn busy_lanes(&self, lanes: u32) -> f64 {
        let (mut busy, mut all) = (0.0, 0.0);
        for subgroup in self.groups.iter().flat_map(|group| group.chunks((lanes as usize).clamp(1, 64))) {
            busy += subgroup.iter().sum::<f64>();
            all += subgroup.len() as f64 * subgroup.iter().copied().fold(0.0, f64::max);
        }
        if all > 0.0 { busy / all } else { 1.0 }
    }
}
