//! The figures of one view by exact beams, and an estimate of the light that the beams leave.
//!
//! The places of all light that is left are divided into strata of equal weight, with two rays in each, so that the
//! scatter within the strata gives the variance of the sum (W. G. Cochran, Sampling Techniques, 3rd ed. 1977, chapter
//! 5). Every number of a ray follows from its stratum and from the number of strata before, so that figures repeat on
//! any number of cores.

use super::figures::{Figures, Zones, by_summed_beams};
use brillianteer_base::{Stopped, Watch};
use brillianteer_math::Polytope;
use brillianteer_math::random_bits::{GAMMA, mixed, unit};
use brillianteer_trace::beam::SummedBeams;
use brillianteer_trace::tail::Tail;
use glam::DVec2;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// The number of strata of the first estimate, which shows how many are needed.
const FIRST: u64 = 128;

/// The greatest number of strata of the next estimate, as a multiple of all before, because the first ones show the
/// need only roughly.
const GROWTH: u64 = 7;

/// The number of strata after which no more are sampled, whatever the error is.
const MOST: u64 = 1 << 20;

/// The most strata that are sampled before the watch is called again.
const MOST_AT_ONCE: u64 = 1 << 14;

/// The number of strata that are sampled as one piece of work. It must not depend on the number of cores, since the
/// result must not.
const PIECE: u64 = 64;

/// The factor by which the standard error of areas may exceed that of light. The undecided area is much larger than
/// the light that is left, so the same error would take many times the rays.
const OF_AREAS: f64 = 10.0;

/// The factor by which more strata are taken than all estimates together demand, so that few are needed after them.
const SPARE: f64 = 1.03;

/// An estimate of the light that exact beams have left, by rays.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Estimate {
    /// Light of the rest that leaves the stone, by the band that it comes from, as a part of the silhouette.
    pub transmitted: Zones,
    /// The part of the silhouette that beams have left undecided, by the band of the strongest exit.
    pub strongest_exit_area: Zones,
    /// Light of the rest that is absorbed.
    pub absorbed: f64,
    /// Light of the rest that rays did not follow to its end either.
    pub unresolved: f64,
    /// The number of rays.
    pub rays: u64,
    /// The standard error of `absorbed`.
    pub absorbed_error: f64,
    /// The covariances of the errors of `transmitted`, row by row.
    covariance: Vec<f64>,
    /// The variances of the errors of `strongest_exit_area`.
    area_variance: Vec<f64>,
}

impl Estimate {
    /// Returns the standard error of the light of several bands together.
    pub fn standard_error_of(&self, bands: impl Iterator<Item = usize> + Clone) -> f64 {
        let n = self.transmitted.len();
        let pairs = bands.clone().flat_map(|i| bands.clone().map(move |j| (i, j)));
        pairs.map(|(i, j)| self.covariance[i * n + j]).sum::<f64>().max(0.0).sqrt()
    }

    /// Returns the standard error of the light of each band.
    pub fn standard_errors(&self) -> Zones {
        (0..self.transmitted.len()).map(|band| self.standard_error_of(std::iter::once(band))).collect()
    }

    /// Returns the standard error of the area of strongest exits of each band.
    pub fn area_errors(&self) -> Zones {
        self.area_variance.iter().map(|variance| variance.sqrt()).collect()
    }

    /// Returns the largest standard error of the light of any band.
    pub fn standard_error(&self) -> f64 {
        self.standard_errors().into_iter().fold(0.0, f64::max)
    }

    /// Returns the mean of two independent estimates, the second with this weight.
    fn and(self, other: Self, weight: f64) -> Self {
        let mean = |a: f64, b: f64| a * (1.0 - weight) + b * weight;
        let variance = |a: f64, b: f64| a * (1.0 - weight).powi(2) + b * weight.powi(2);
        let each = |of: &dyn Fn(f64, f64) -> f64, a: &[f64], b: &[f64]| {
            a.iter().zip(b).map(|(a, b)| of(*a, *b)).collect::<Vec<_>>()
        };
        Self {
            transmitted: each(&mean, &self.transmitted, &other.transmitted),
            strongest_exit_area: each(&mean, &self.strongest_exit_area, &other.strongest_exit_area),
            absorbed: mean(self.absorbed, other.absorbed),
            unresolved: mean(self.unresolved, other.unresolved),
            rays: self.rays + other.rays,
            absorbed_error: variance(self.absorbed_error.powi(2), other.absorbed_error.powi(2)).sqrt(),
            covariance: each(&variance, &self.covariance, &other.covariance),
            area_variance: each(&variance, &self.area_variance, &other.area_variance),
        }
    }

    /// Adds the zone after `k` to zone `k`.
    pub(super) fn join(&mut self, k: usize) {
        let n = self.transmitted.len();
        let of = |i: usize, j: usize| self.covariance[i * n + j];
        let kept: Vec<usize> = (0..n).filter(|&i| i != k + 1).collect();
        let group = |i: usize| if i == k { vec![k, k + 1] } else { vec![i] };
        let joined = kept.iter().flat_map(|&i| kept.iter().map(move |&j| (group(i), group(j))));
        let covariance =
            joined.map(|(a, b)| a.iter().flat_map(|&i| b.iter().map(move |&j| of(i, j))).sum()).collect();
        self.covariance = covariance;
        for zones in [&mut self.transmitted, &mut self.strongest_exit_area, &mut self.area_variance] {
            let next = zones.remove(k + 1);
            zones[k] += next;
        }
    }
}

/// Returns the figures of beams that were summed up, and adds an estimate of the light that they have left, whose standard
/// error is at most `standard_error` in each zone, a part of the silhouette's light. The areas of the strongest exits are
/// brought to ten times that, as a part of the silhouette. Errors are larger where two million rays do not suffice.
///
/// # Errors
/// Fails with [`Stopped`] when `watch` asks to stop.
pub fn by_beams_and_rays(
    polytope: &Polytope,
    summed: &SummedBeams,
    standard_error: f64,
    watch: Watch,
) -> Result<Figures, Stopped> {
    let mut figures = by_summed_beams(summed);
    let Some(tail) = Tail::new(polytope, summed) else { return Ok(figures) };
    let sampler = Sampler { tail: &tail, bands: summed.scope.bands.len() };
    let mut strata = FIRST;
    let mut all = sampler.estimate(strata, 0);
    loop {
        let area_error = all.area_errors().into_iter().fold(0.0, f64::max) / OF_AREAS;
        let excess = all.standard_error().max(area_error) / standard_error;
        if excess <= 1.0 || strata >= MOST {
            figures.take_in(all);
            return Ok(figures);
        }
        if watch(excess.powi(-2)).is_break() {
            return Err(Stopped);
        }
        let missing = (strata as f64 * (excess * excess * SPARE - 1.0)).ceil() as u64;
        let more = missing.clamp(strata / 8, GROWTH * strata).min(MOST_AT_ONCE);
        all = all.and(sampler.estimate(more, strata), more as f64 / (strata + more) as f64);
        strata += more;
    }
}

impl Figures {
    /// Adds an estimate to the exact figures.
    fn take_in(&mut self, mut estimate: Estimate) {
        let add = |to: &mut Zones, from: &Zones| to.iter_mut().zip(from).for_each(|(a, b)| *a += b);
        add(&mut self.transmitted, &estimate.transmitted);
        // The sum of all areas is known exactly, so the estimated ones are never more than the undecided area.
        let area = estimate.strongest_exit_area.iter().sum::<f64>();
        let excess = (area / self.strongest_exit_undecided).max(1.0);
        estimate.strongest_exit_area.iter_mut().for_each(|zone| *zone /= excess);
        add(&mut self.strongest_exit_area, &estimate.strongest_exit_area);
        self.absorbed += estimate.absorbed;
        self.strongest_exit_undecided = (self.strongest_exit_undecided - area / excess).max(0.0);
        self.standard_error = estimate.standard_error();
        self.estimate = Some(estimate);
    }
}

struct Sampler<'a> {
    tail: &'a Tail<'a>,
    /// The number of the scope's bands.
    bands: usize,
}

/// Sums over strata of the means of their two rays, and of the products of half their differences.
#[derive(Clone)]
struct Sums {
    means: Vec<f64>,
    products: Vec<f64>,
}

impl Sampler<'_> {
    /// Estimates by two rays in each of so many strata; `before` strata were sampled by other rays.
    fn estimate(&self, strata: u64, before: u64) -> Estimate {
        let bands = self.bands;
        let pieces: Vec<Sums> = (0..strata.div_ceil(PIECE))
            .into_par_iter()
            .map(|piece| self.piece(piece * PIECE..((piece + 1) * PIECE).min(strata), (strata, before)))
            .collect();
        let sums = pieces.into_iter().fold(Sums::new(bands), Sums::and);
        let n = strata as f64;
        let mean = |k: usize| sums.means[k] / n;
        let of_products = |k: usize| sums.products[k] / (n * n);
        // Where no ray has hit, the next one might have.
        let one_ray = |whole: f64| (whole / (2.0 * n)).powi(2);
        let [of_light, of_area] = self.tail.most_of_a_ray().map(one_ray);
        let covariance = |k: usize| {
            if k.is_multiple_of(bands + 1) { of_products(k).max(of_light) } else { of_products(k) }
        };
        let areas = bands * bands..bands * bands + bands;
        Estimate {
            transmitted: (0..bands).map(mean).collect(),
            strongest_exit_area: (bands..2 * bands).map(mean).collect(),
            absorbed: mean(2 * bands),
            unresolved: mean(2 * bands + 1),
            rays: 2 * strata,
            absorbed_error: of_products(bands * bands + bands).sqrt(),
            covariance: (0..bands * bands).map(covariance).collect(),
            area_variance: areas.map(|k| of_products(k).max(of_area)).collect(),
        }
    }

    fn piece(&self, range: std::ops::Range<u64>, (strata, before): (u64, u64)) -> Sums {
        let bands = self.bands;
        let mut sums = Sums::new(bands);
        let mut pair = [vec![0.0; 2 * bands + 2], vec![0.0; 2 * bands + 2]];
        for stratum in range {
            for (which, values) in (0..).zip(&mut pair) {
                self.ray((stratum, strata), 2 * (before + stratum) + which, values);
            }
            sums.add(&pair, bands);
        }
        sums
    }

    /// Writes to `values` the result of the ray with this number: light by bands, area by bands, absorbed light,
    /// unresolved light.
    fn ray(&self, (stratum, strata): (u64, u64), number: u64, values: &mut [f64]) {
        let bands = self.bands;
        values.fill(0.0);
        let [place, x, y, luck] = [0, 1, 2, 3].map(|k| unit(mixed((4 * number + k).wrapping_mul(GAMMA))));
        let place = (stratum as f64 + place) / strata as f64;
        let ray = self.tail.follow(place, DVec2::new(x, y), luck, |exit| values[exit.band] += exit.share);
        values[2 * bands] = ray.absorbed;
        values[2 * bands + 1] = ray.unresolved;
        values.iter_mut().for_each(|value| *value *= ray.light);
        if let Some(band) = ray.strongest {
            values[bands + band] = ray.area;
        }
    }
}

impl Sums {
    fn new(bands: usize) -> Self {
        Self { means: vec![0.0; 2 * bands + 2], products: vec![0.0; bands * bands + bands + 1] }
    }

    fn add(&mut self, [a, b]: &[Vec<f64>; 2], bands: usize) {
        self.means.iter_mut().zip(a.iter().zip(b)).for_each(|(sum, (a, b))| *sum += (a + b) / 2.0);
        let half = |k: usize| (a[k] - b[k]) / 2.0;
        for i in 0..bands {
            for j in 0..bands {
                self.products[i * bands + j] += half(i) * half(j);
            }
        }
        for k in bands..=2 * bands {
            self.products[bands * bands + k - bands] += half(k).powi(2);
        }
    }

    fn and(mut self, other: Self) -> Self {
        let add = |to: &mut [f64], from: &[f64]| to.iter_mut().zip(from).for_each(|(a, b)| *a += b);
        add(&mut self.means, &other.means);
        add(&mut self.products, &other.products);
        self
    }
}
