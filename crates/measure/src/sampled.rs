//! The figures of one view, sampled with point rays on the processor or a graphics card. They are slower than exact
//! beams and have a sampling error, but they check the beams independently.

use super::figures::Figures;
use brillianteer_base::{Stopped, Watch};
use brillianteer_math::SolidRef;
#[cfg(feature = "gpu")]
use brillianteer_scene::Film;
use brillianteer_scene::{Medium, Scope, View};
#[cfg(feature = "gpu")]
use brillianteer_trace::ScopeShot;
#[cfg(feature = "gpu")]
use brillianteer_trace::gpu::{Gpu, GpuError, ScopePixel};
use brillianteer_trace::ray::{Camera, Exit, Loss, RayOptions, StoneTracer};
use glam::DVec2;
use rayon::prelude::*;

/// The number of lattices, each with its own shift. The scatter of their results gives the standard error, which comes
/// out somewhat too large because the shifts are spread evenly.
const LATTICES: u32 = 8;

/// Sums over the points of one lattice, or of one row of it.
#[derive(Clone)]
struct Tally {
    hits: u32,
    surface: Vec<f64>,
    transmitted: Vec<f64>,
    strongest: Vec<f64>,
    undecided: f64,
    absorbed: f64,
    unresolved: f64,
}

/// Samples the figures under a scope with point rays, on `LATTICES` shifted lattices of `side` × `side` points.
///
/// In a perspective view, the figures are fractions of the silhouette as the eye sees it. An eye that is not in front
/// of the whole stone sees nothing, and all its figures are 0. The same input gives the same figures. `side` is from
/// 1 to 16,384.
///
/// # Errors
/// Fails with [`Stopped`] when `watch` stops the work.
pub fn by_rays<'a>(
    solid: impl Into<SolidRef<'a>>,
    medium: Medium,
    view: &View,
    scope: &Scope,
    (options, side): (RayOptions, u32),
    watch: Watch,
) -> Result<Figures, Stopped> {
    let solid = solid.into();
    let tracer = StoneTracer::new(solid, medium, options);
    let camera = Camera::new(view, solid);
    let zenith = view.zenith();
    over_lattices((solid, side), view, scope, watch, |half, shift, _| {
        // Rows run downward, as in a picture.
        let point = |i: u32, j: u32| {
            let across = (DVec2::new(f64::from(i), f64::from(j)) + shift) / f64::from(side) * 2.0 - 1.0;
            DVec2::new(across.x, -across.y)
        };
        let row = |j: u32| {
            let mut tally = Tally::new(scope.bands.len());
            for i in 0..side {
                let (origin, direction) = camera.ray(point(i, j) * half);
                let mut strongest = (0.0, None);
                let rest = tracer.follow(origin, direction, |exit| {
                    let band = scope.band(exit.direction, zenith);
                    tally.add(&exit, band);
                    if !exit.surface && exit.weight > strongest.0 {
                        strongest = (exit.weight, Some(band));
                    }
                });
                tally.close(rest, strongest);
            }
            tally
        };
        let rows: Vec<Tally> = (0..side).into_par_iter().map(row).collect();
        Ok(rows.into_iter().fold(Tally::new(scope.bands.len()), Tally::joined))
    })
}

/// Samples the same figures as [`by_rays`] on a graphics card.
///
/// # Errors
/// Fails with [`Stopped`] when `watch` stops the work, or a [`GpuError`], each turned into `E`.
#[cfg(feature = "gpu")]
pub fn by_gpu<'a, E: From<Stopped> + From<GpuError>>(
    gpu: &Gpu,
    solid: impl Into<SolidRef<'a>>,
    medium: Medium,
    view: &View,
    scope: &Scope,
    (options, side): (RayOptions, u32),
    watch: Watch,
) -> Result<Figures, E> {
    let solid = solid.into();
    over_lattices((solid, side), view, scope, watch, |half, shift, done| {
        let film = Film::square(side, half);
        let shot = ScopeShot { solid, medium, view, scope, film, per_side: 1, shift, options };
        let mut tally = Tally::new(scope.bands.len());
        gpu.scope(&shot, &|_| watch(done), |_, pixels| -> Result<(), E> {
            pixels.iter().for_each(|seen| tally.take_in(seen));
            Ok(())
        })?;
        Ok(tally)
    })
}

/// Runs `see` for each lattice and sums up the tallies. `see` receives half the side of the film, the shift of the
/// lattice within its cells (0 to 1), and the part of the work that is done.
fn over_lattices<E: From<Stopped>>(
    (solid, side): (SolidRef, u32),
    view: &View,
    scope: &Scope,
    watch: Watch,
    mut see: impl FnMut(f64, DVec2, f64) -> Result<Tally, E>,
) -> Result<Figures, E> {
    let known = match solid {
        SolidRef::Convex(polytope) => Some(polytope.silhouette_area(view.basis().toward)),
        SolidRef::Triangles(_) => None,
        SolidRef::Smooth(smooth) => smooth.field().silhouette_area(view.basis().toward),
    };
    let Some(half) = Camera::new(view, solid).reach(solid) else {
        let none = vec![Tally::new(scope.bands.len()); LATTICES as usize];
        return Ok(summary(&none, known.unwrap_or(0.0)));
    };
    let mut lattices = Vec::with_capacity(LATTICES as usize);
    for k in 0..LATTICES {
        let done = f64::from(k) / f64::from(LATTICES);
        if watch(done).is_break() {
            return Err(Stopped.into());
        }
        // Roberts's R2 sequence spreads the shifts evenly; it is not random, so that figures repeat.
        let shift = DVec2::new(0.754_877_666_246_693, 0.569_840_290_998_053) * f64::from(k + 1);
        lattices.push(see(half, shift - shift.floor(), done)?);
    }
    // The outline of triangles is known only by the rays that meet them.
    let hits: u32 = lattices.iter().map(|t| t.hits).sum();
    let each = (2.0 * half / f64::from(side)).powi(2) / f64::from(LATTICES);
    Ok(summary(&lattices, known.unwrap_or(f64::from(hits) * each)))
}

impl Tally {
    fn new(bands: usize) -> Self {
        let zones = vec![0.0; bands];
        Self {
            hits: 0,
            surface: zones.clone(),
            transmitted: zones.clone(),
            strongest: zones,
            undecided: 0.0,
            absorbed: 0.0,
            unresolved: 0.0,
        }
    }

    fn add(&mut self, exit: &Exit, band: usize) {
        let zones = if exit.surface { &mut self.surface } else { &mut self.transmitted };
        zones[band] += exit.weight;
    }

    fn close(&mut self, rest: Option<Loss>, (weight, strongest): (f64, Option<usize>)) {
        if let Some(rest) = rest {
            self.hits += 1;
            self.absorbed += rest.absorbed;
            self.unresolved += rest.unresolved;
            match strongest {
                Some(band) if rest.unresolved <= weight => self.strongest[band] += 1.0,
                _ => self.undecided += 1.0,
            }
        }
    }

    #[cfg(feature = "gpu")]
    fn take_in(&mut self, seen: &ScopePixel) {
        let add = |to: &mut [f64], from: &[f32]| {
            to.iter_mut().zip(from).for_each(|(a, &b)| *a += f64::from(b));
        };
        if seen.hit > 0.0 {
            self.hits += 1;
            add(&mut self.surface, &seen.surface);
            add(&mut self.transmitted, &seen.transmitted);
            self.absorbed += f64::from(seen.absorbed);
            self.unresolved += f64::from(seen.unresolved);
            self.undecided += f64::from(seen.undecided);
            if seen.undecided == 0.0 {
                add(&mut self.strongest, &seen.strongest);
            }
        }
    }

    fn joined(mut self, other: Self) -> Self {
        let add = |to: &mut Vec<f64>, from: &[f64]| to.iter_mut().zip(from).for_each(|(a, b)| *a += b);
        add(&mut self.surface, &other.surface);
        add(&mut self.transmitted, &other.transmitted);
        add(&mut self.strongest, &other.strongest);
        self.hits += other.hits;
        self.undecided += other.undecided;
        self.absorbed += other.absorbed;
        self.unresolved += other.unresolved;
        self
    }
}

fn summary(lattices: &[Tally], silhouette_area: f64) -> Figures {
    let all = lattices.iter().cloned().reduce(Tally::joined).unwrap_or_else(|| Tally::new(0));
    let share = |x: &f64| x / f64::from(all.hits.max(1));
    let error = |pick: fn(&Tally) -> &Vec<f64>| {
        let each = |band: usize| lattices.iter().map(move |t| pick(t)[band] / f64::from(t.hits.max(1)));
        (0..pick(&all).len()).map(|band| standard_error(each(band))).fold(0.0, f64::max)
    };
    Figures {
        silhouette_area,
        surface: all.surface.iter().map(share).collect(),
        transmitted: all.transmitted.iter().map(share).collect(),
        strongest_exit_area: all.strongest.iter().map(share).collect(),
        strongest_exit_undecided: share(&all.undecided),
        absorbed: share(&all.absorbed),
        unresolved: share(&all.unresolved),
        beams: all.hits as usize,
        estimate: None,
        standard_error: error(|t| &t.surface).max(error(|t| &t.transmitted)).max(error(|t| &t.strongest)),
    }
}

/// Returns the standard error of the mean of independent values.
fn standard_error(values: impl Iterator<Item = f64> + Clone) -> f64 {
    let n = values.clone().count() as f64;
    let mean = values.clone().sum::<f64>() / n;
    let variance = values.map(|v| (v - mean).powi(2)).sum::<f64>() / (n - 1.0);
    (variance / n).sqrt()
}
