//! The light that a stone sends upward under an even sky, in all directions.

use brillianteer_math::SolidRef;
use brillianteer_scene::{Lean, Medium, View};
use brillianteer_trace::ray::{Camera, RayOptions, StoneTracer};
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::f64::consts::{PI, TAU};

/// The number of lattices whose scatter gives the standard error.
const LATTICES: u32 = 8;

/// The number of rays in one piece of work.
const PIECE: u32 = 4096;

/// The steps of a lattice in four dimensions that fills space evenly: powers of the root above 1 of x⁵ = x + 1 (M. Roberts,
/// 2018, R sequences).
const STEPS: [f64; 4] =
    [0.856_674_883_854_502_9, 0.733_891_856_627_125_4, 0.628_706_721_038_087, 0.538_597_257_223_699_1];

/// A number by sampling, with its standard error.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SampledNumber {
    /// The number.
    pub value: f64,
    /// Its standard error.
    pub standard_error: f64,
}

/// Returns the light that leaves a stone upward under an even hemisphere of light, without glare, where light that
/// leaves at the angle θ from the axis is weighted by cosᵖ θ. The unit is the light, weighted alike, that a white
/// sheet of a round stone's outline sends.
///
/// With p = 2 it is the weighted light return of T. S. Hemphill, I. M. Reinitz, M. L. Johnson and J. E. Shigley,
/// *Modeling the appearance of the round brilliant cut diamond*, Gems & Gemology 34 (1998), as far as its definition
/// is known (docs/optics.md, "Measures"); they use another unit.
///
/// Light is reversible, so rays come from eyes at all angles, `rays` of them on each of eight lattices. The same input gives the
/// same number.
pub fn hemisphere_return<'a>(
    solid: impl Into<SolidRef<'a>>,
    medium: Medium,
    power: f64,
    (options, rays): (RayOptions, u32),
) -> SampledNumber {
    let solid = solid.into();
    let tracer = StoneTracer::new(solid, medium, options);
    let lattice = |number: u32| {
        let pieces = (0..rays.div_ceil(PIECE)).into_par_iter();
        let piece = |piece: u32| {
            let numbers = piece * PIECE..((piece + 1) * PIECE).min(rays);
            numbers.map(|ray| returned((&tracer, solid), power, number * rays + ray)).sum::<f64>()
        };
        let sums: Vec<f64> = pieces.map(piece).collect();
        sums.into_iter().sum::<f64>() / f64::from(rays)
    };
    let values: Vec<f64> = (0..LATTICES).map(lattice).collect();
    let n = f64::from(LATTICES);
    let value = values.iter().sum::<f64>() / n;
    let scatter = values.iter().map(|each| (each - value).powi(2)).sum::<f64>();
    SampledNumber { value, standard_error: (scatter / (n * (n - 1.0))).sqrt() }
}

/// Returns the light that one ray of a number stands for.
fn returned((tracer, solid): (&StoneTracer, SolidRef), power: f64, number: u32) -> f64 {
    let [x, y, height, turn] = STEPS.map(|step| (0.5 + step * f64::from(number)).fract());
    // Eyes are spread evenly over the hemisphere: equal steps of height have equal areas.
    let view = View { tilt: height.acos(), azimuth: turn * TAU, lean: Lean::Eye, ..View::default() };
    let camera = Camera::new(&view, solid);
    let Some(half) = camera.reach(solid) else { return 0.0 };
    let (origin, direction) = camera.ray((DVec2::new(x, y) * 2.0 - 1.0) * half);
    let (mut light, mut is_glare) = (0.0, true);
    tracer.follow(origin, direction, |exit| {
        if !is_glare && exit.direction.dot(DVec3::Z) >= 0.0 {
            light += exit.weight;
        }
        is_glare = false;
    });
    // A sheet of radius 1 sends ∫ cosᵖ θ · π cos θ dΩ = 2π² / (p + 2).
    let of_sheet = 2.0 * PI * PI / (power + 2.0);
    light * height.powf(power) * (2.0 * half).powi(2) * TAU / of_sheet
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_math::{Plane, Polytope};

    #[test]
    fn a_flat_plate_lets_nothing_return_but_what_its_back_reflects() {
        // A wide plate of index n reflects R once at its back; both surfaces together return, inside, what a stack of two
        // does: (1 - R)² R / (1 - R²). At p large, only light near the axis counts, where R is known.
        let sides = (0..64).map(|k| {
            let angle = TAU * (f64::from(k) + 0.5) / 64.0;
            Plane::new(DVec3::new(angle.cos(), angle.sin(), 0.0), 1.0)
        });
        let planes: Vec<Plane> =
            sides.chain([Plane::new(DVec3::Z, 0.001), Plane::new(-DVec3::Z, 0.001)]).collect();
        let plate = Polytope::from_planes(&planes).unwrap();
        let (index, power) = (1.5, 200.0);
        let reflectance = (0.5_f64 / 2.5).powi(2);
        let expected = (1.0 - reflectance).powi(2) * reflectance / (1.0 - reflectance.powi(2));
        let options = RayOptions::default();
        let found = hemisphere_return(&plate, Medium::clear(index), power, (options, 200_000));
        let error = 4.0 * found.standard_error + 0.02 * expected;
        assert!((found.value - expected).abs() < error, "{found:?} is not {expected}");
        assert!(found.standard_error < 0.1 * expected, "{found:?}");
    }
}
