//! `bench`: how long the tracers take for one and the same picture, on this machine.

use super::sampler::{Look, Sampler};
use super::specimen::Specimen;
use super::{Failure, json, print};
use crate::optics::line;
use crate::picture::Film;
use crate::picture::by_rays::Manner;
use crate::scene::{ASET_CONE, Backing, Medium, Scope, View};
use crate::trace::beam;
use crate::trace::ray::{Camera, Options, Tracer};
use crate::trace::unwatched;
use clap::Args;
use glam::DVec2;
use serde_json::{Value, json};
use std::path::Path;
use std::time::Instant;

/// Pixels along each side of the picture, a ray each.
const SIZE: u32 = 512;

/// How far its rays are followed.
const OPTIONS: Options = Options { polarised: true, most_bounces: 32, least_weight: 1e-4 };

/// What the beams leave unresolved.
const UNRESOLVED: f64 = 0.01;

/// Each task is done so often, after once to warm up; the median counts.
const TIMES: usize = 5;

#[derive(Debug, Args)]
pub struct Bench {
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl Bench {
    pub fn run(&self) -> Result<(), Failure> {
        let specimen = Specimen::load(Path::new("modern-ideal"))?;
        let (view, scope) = (View::default(), Scope::aset(ASET_CONE, Backing::Black));
        let medium = Medium::clear(specimen.material.index(line::SODIUM_D));
        let look = Look { specimen: &specimen, medium, view: &view, scope: &scope };
        let tests = plane_tests(look);
        let mut rows = vec![];
        for sampler in [Sampler::Rays, Sampler::on_card()] {
            if rows.iter().any(|row: &Value| row["tracer"] == sampler.name()) {
                continue;
            }
            let milliseconds = timed(|| picture(sampler, look))?;
            rows.push(json!({
                "tracer": sampler.name(),
                "by": sampler.told(),
                "ms": milliseconds,
                "plane_tests_per_second": tests / milliseconds * 1e3,
            }));
        }
        let options = beam::Options { unresolved: UNRESOLVED, ..beam::Options::default() };
        let beams =
            || Ok(beam::trace(&specimen.stone.polytope, medium, &view, &options, &unwatched).map(drop)?);
        let by = format!("exact beams, unresolved {UNRESOLVED}");
        rows.push(json!({ "tracer": "beam", "by": by, "ms": timed(beams)? }));
        let planes = specimen.stone.polytope.facets().len();
        let what = format!(
            "ASET of a modern ideal face up, {planes} planes, {SIZE} x {SIZE}, {} bounces at most, {} threads",
            OPTIONS.most_bounces,
            rayon::current_num_threads()
        );
        if self.json {
            return print(&json(&json!({ "task": what, "plane_tests": tests, "results": rows })));
        }
        let line = |row: &Value| {
            let rate = row["plane_tests_per_second"].as_f64().map(|r| format!("{:8.1} G/s", r / 1e9));
            format!(
                "{:>10.2} ms {:>12}  {}",
                row["ms"].as_f64().unwrap_or(f64::NAN),
                rate.unwrap_or_default(),
                row["by"].as_str().unwrap_or_default()
            )
        };
        let table: Vec<String> = rows.iter().map(line).collect();
        print(&format!("{what}\n{:>13} {:>12}\n{}", "a picture", "plane tests", table.join("\n")))
    }
}

/// Median of several runs, milliseconds.
fn timed(mut work: impl FnMut() -> Result<(), Failure>) -> Result<f64, Failure> {
    work()?;
    let mut times = vec![];
    for _ in 0..TIMES {
        let start = Instant::now();
        work()?;
        times.push(start.elapsed().as_secs_f64() * 1e3);
    }
    times.sort_by(f64::total_cmp);
    Ok(times[TIMES / 2])
}

fn film(look: Look) -> Film {
    Film::around(&look.specimen.stone.polytope, &look.view.basis(), SIZE)
}

fn picture(sampler: Sampler, look: Look) -> Result<(), Failure> {
    let manner = Manner { options: OPTIONS, per_side: 1 };
    sampler.rows(look, &film(look), &manner, &unwatched, |_| Ok(()))
}

/// How many planes are tested for the picture, if each ray tests all at each bounce.
fn plane_tests(look: Look) -> f64 {
    let polytope = &look.specimen.stone.polytope;
    let (camera, film) = (Camera::new(look.view, polytope), film(look));
    let tracer = Tracer::new(polytope, look.medium, OPTIONS);
    let pixels = (0..SIZE * SIZE).map(|k| DVec2::new(f64::from(k % SIZE), f64::from(k / SIZE)) + 0.5);
    let searches: f64 = pixels
        .map(|pixel| {
            let (origin, direction) = camera.ray(film.image_from_pixels(pixel));
            1.0 + f64::from(tracer.follow(origin, direction, |_| {}).map_or(0, |rest| rest.bounces))
        })
        .sum();
    searches * polytope.facets().len() as f64
}
