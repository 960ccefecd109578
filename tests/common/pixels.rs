//! Compares pictures by a card with pictures by rays in f64, pixel by pixel.

use super::aset;
use brillianteer::base::{Stopped, unwatched};
use brillianteer::math::SolidRef;
use brillianteer::scene::{Film, Medium, Projection, Scope, Side, View};
use brillianteer::trace::{
    DispersedRay, ScopeShot,
    gpu::{Gpu, GpuError, ScopePixel},
    ray::{Camera, Exit, MeetingRay, RayOptions, StoneTracer},
};
use glam::DVec2;

pub const SIZE: u32 = 96;

/// The largest allowed difference of a pixel, as a fraction of full scale.
pub const ALLOWED: f64 = 1e-3;

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

/// Traces one ray, and returns its readings in the order of [`numbers`].
fn by_ray(
    tracer: &StoneTracer,
    camera: &Camera,
    (scope, view): (&Scope, &View),
    at: DVec2,
    comes_back: bool,
) -> [f64; 19] {
    let mut seen = [0.0; 19];
    let (origin, direction) = camera.ray(at);
    let met = tracer.meet(origin, direction);
    let is_taken = |_: &Exit, _| !comes_back;
    let follow = |met| {
        tracer.follow_from(
            &MeetingRay::from_eye(met, DispersedRay::new(origin, direction)),
            is_taken,
            |exit| {
                let band = scope.band(exit.direction, view.zenith());
                seen[if exit.surface { 8 } else { 0 } + band] += exit.weight;
            },
        )
    };
    let rest = met.and_then(follow);
    if let Some(rest) = rest {
        (seen[16], seen[17], seen[18]) = (rest.absorbed, rest.unresolved, 1.0);
    }
    seen
}

fn numbers(seen: &ScopePixel) -> [f64; 19] {
    let all =
        seen.transmitted.iter().chain(&seen.surface).chain([&seen.absorbed, &seen.unresolved, &seen.hit]);
    let mut numbers = [0.0; 19];
    numbers.iter_mut().zip(all).for_each(|(n, &v)| *n = f64::from(v));
    numbers
}

fn differ(a: &[f64; 19], b: &[f64; 19]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// A comparison of a card's picture with that of the rays: pixels that count, those left out, and the largest difference.
pub struct Comparison {
    pub counted: usize,
    pub left_out: usize,
    pub largest: f64,
    pub energy: f64,
}

/// Shifts of a ray, and of the index, for the search for delicate pixels. Where a ray shifted by this much, or a stone with
/// an index changed by this much, gives a different reading, an edge or a critical angle is too near for f32, and the pixel
/// may be left out.
const HAIR: f64 = 3e-5;
const OTHER_INDEX: f64 = 1e-5;

/// A view of a stone to compare: `solid` is traced in f64 and `twin` on the card.
pub struct Case<'a> {
    pub solid: SolidRef<'a>,
    pub twin: SolidRef<'a>,
    pub medium: Medium,
    pub twin_medium: Medium,
    pub view: &'a View,
    pub options: RayOptions,
    pub twin_options: RayOptions,
    /// True where rays that leave are followed when they meet the stone again.
    pub comes_back: bool,
}

impl<'a> Case<'a> {
    pub fn new(solid: impl Into<SolidRef<'a>>, medium: Medium, view: &'a View, polarised: bool) -> Self {
        let solid = solid.into();
        let options = RayOptions { polarised, most_bounces: 64, least_weight: 1e-4 };
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

    pub fn compared(&self, gpu: &Gpu) -> Comparison {
        let (scope, solid, view) = (aset(), self.solid, self.view);
        let camera = Camera::new(view, solid);
        let film = Film::reaching(camera.reach(solid).unwrap(), SIZE);
        let film = Film { centre: DVec2::new(0.03, -0.02), ..film };
        let shot = ScopeShot {
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
            StoneTracer::new(solid, medium, self.options)
        };
        let [exact, denser, rarer] = [1.0, 1.0 + OTHER_INDEX, 1.0 - OTHER_INDEX].map(tracer);
        let mut result = Comparison { counted: 0, left_out: 0, largest: 0.0, energy: 0.0 };
        let each = |first: u32, seen: &[ScopePixel]| -> Result<(), Failed> {
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

pub fn views() -> [View; 6] {
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
