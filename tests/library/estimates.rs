//! Compares figures whose rest is estimated by rays with figures that are certain.

use crate::common::*;
use brillianteer::base::unwatched;
use brillianteer::math::Polytope;
use brillianteer::measure::{Figures, by_beams, by_beams_and_rays, by_summed_beams};
use brillianteer::scene::{ASET_CONE, Backing, Band, Medium, Scope, View, Viewpoint};
use brillianteer::trace::beam::{self, BeamOptions, SumOptions, SummedBeams};

/// One stone, of its own proportions and material, at its own tilt.
struct Case {
    polytope: Polytope,
    medium: Medium,
    view: View,
    polarised: bool,
}

/// Returns a number from 0 to 1 for each number, spread evenly (the golden ratio's multiples).
fn spread(number: u32, step: f64) -> f64 {
    (f64::from(number) * step).fract()
}

fn case(number: u32) -> Case {
    let from = |low: f64, high: f64, step: f64| low + (high - low) * spread(number + 1, step);
    let [table, crown, pavilion] =
        [from(50.0, 64.0, 0.618), from(29.0, 38.0, 0.755), from(39.0, 43.0, 0.570)];
    let [star, lower] = [from(45.0, 60.0, 0.819), from(70.0, 85.0, 0.672)];
    let stone = built(&brilliant((table, crown, pavilion), (star, lower), 16));
    let index = [2.4175, 1.544, 1.77, 2.65, 2.16][number as usize % 5];
    let absorption = if number.is_multiple_of(3) { [0.02, 0.15] } else { [0.0; 2] };
    let tilt_deg = from(0.0, 35.0, 0.4656);
    let azimuth_deg = from(0.0, 360.0, 0.245);
    Case {
        polytope: stone.polytope,
        medium: Medium { absorption, ..Medium::clear(index) },
        view: Viewpoint { tilt_deg, azimuth_deg, ..Viewpoint::default() }.view(),
        polarised: number % 4 != 3,
    }
}

fn aset() -> Scope {
    Scope::aset(ASET_CONE, Backing::Black)
}

/// Returns figures by beams that leave at most `unresolved`, whose rest is estimated to a standard error.
fn estimated(case: &Case, unresolved: f64, standard_error: f64) -> Figures {
    let options = BeamOptions { unresolved, polarised: case.polarised, ..BeamOptions::default() };
    let summed = summed(case, &options, &aset(), Some(standard_error));
    by_beams_and_rays(&case.polytope, &summed, standard_error, &unwatched).unwrap()
}

fn summed(case: &Case, options: &BeamOptions, scope: &Scope, standard_error: Option<f64>) -> SummedBeams {
    let of = SumOptions { scope, standard_error };
    beam::sum_up(&case.polytope, case.medium, &case.view, options, of, &unwatched).unwrap()
}

/// Compares estimates with figures that are ten times as certain. Returns the sum of squared errors, in standard
/// errors, and the number of errors. Estimates outside the certain bounds fail the test.
fn chi_square(cases: std::ops::Range<u32>) -> (f64, u32) {
    const CERTAIN: f64 = 4e-3;
    const ERROR: f64 = 4e-4;
    let (mut sum, mut count) = (0.0, 0);
    for number in cases {
        let case = case(number);
        let rough = estimated(&case, 1.0, ERROR);
        let sure = estimated(&case, CERTAIN, ERROR / 10.0);
        let estimate = rough.estimate.as_ref().unwrap();
        let errors = estimate.standard_errors();
        assert!(errors.iter().all(|&error| error <= ERROR), "{number}: {errors:?}");
        let rest = sure.estimate.as_ref().unwrap();
        for (band, error) in errors.iter().enumerate() {
            let certain = sure.transmitted[band] - rest.transmitted[band];
            let found = rough.transmitted[band];
            let slack = 5.0 * error + 1e-12;
            let is_inside = (certain - slack..=certain + sure.unresolved + slack).contains(&found);
            assert!(is_inside, "{number}, band {band}: {found} is not {certain} to {}", sure.unresolved);
        }
        // The errors of one stone's bands depend on each other, so only one of them counts.
        let band = number as usize % errors.len();
        if errors[band] > 0.0 {
            sum += ((rough.transmitted[band] - sure.transmitted[band]) / errors[band]).powi(2);
            count += 1;
        }
        let absorbed = (rough.absorbed - sure.absorbed).abs();
        assert!(absorbed <= 5.0 * estimate.absorbed_error + 1e-4, "{number}: absorbed {absorbed}");
        let area = largest_difference(&rough.strongest_exit_area, &sure.strongest_exit_area);
        assert!(area < 8e-3, "{number}: areas differ by {area}");
    }
    (sum, count)
}

#[test]
fn errors_of_estimates_are_as_large_as_they_claim() {
    let (sum, count) = chi_square(0..24);
    // The quantiles 0.0005 and 0.9995 of the chi-square distribution with 24 degrees of freedom.
    assert!(count == 24 && (7.5..53.5).contains(&sum), "the squares of {count} errors add up to {sum}");
}

#[test]
#[ignore = "takes minutes: 200 stones, tilts and materials"]
fn errors_of_estimates_of_200_stones_are_as_large_as_they_claim() {
    let (sum, count) = chi_square(0..200);
    println!("the squares of {count} errors add up to {sum}");
    // The quantiles 0.0005 and 0.9995 of the chi-square distribution with 200 degrees of freedom.
    assert!(count > 190 && (140.6..273.0).contains(&sum), "the squares of {count} errors add up to {sum}");
}

#[test]
fn an_estimate_does_not_depend_on_the_number_of_cores() {
    let case = case(3);
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| estimated(&case, 1.0, 1e-3))
    };
    let alone = on(1);
    assert!(alone.estimate.is_some() && alone == on(3));
}

#[test]
fn an_estimate_that_is_split_at_the_horizon_joins_to_the_same_zone() {
    let case = case(1);
    let options = BeamOptions { unresolved: 0.1, ..BeamOptions::default() };
    let band = |name: &str, from, colour| Band { name: name.into(), from, colour };
    let bands =
        vec![band("below", -90.0, [0; 3]), band("red", -20.0, [255, 0, 0]), band("blue", 60.0, [0, 0, 255])];
    let wide = Scope { name: "wide".into(), bands };
    let measured = brillianteer::measure::measured(&wide, 2.42, "beam", |scope| {
        by_beams_and_rays(&case.polytope, &summed(&case, &options, scope, None), 1.0, &unwatched)
    });
    let joined = measured.unwrap().figures;
    let whole = summed(&case, &options, &wide, None);
    let plain = by_beams_and_rays(&case.polytope, &whole, 1.0, &unwatched).unwrap();
    let [a, b] = [&joined, &plain].map(|figures| figures.estimate.clone().unwrap());
    assert_eq!(a.rays, b.rays);
    assert!(largest_difference(&a.transmitted, &b.transmitted) < 1e-12);
    assert!(largest_difference(&a.standard_errors(), &b.standard_errors()) < 1e-12);
    assert!(largest_difference(&whole.sums.surface, &joined.surface) < 1e-12);
}

#[test]
fn figures_without_a_tree_have_the_digits_of_those_with_one() {
    for number in 0..6 {
        let case = case(number);
        // So many beams that most are dropped on the way.
        let options = BeamOptions { unresolved: 1.5e-2, polarised: case.polarised, ..BeamOptions::default() };
        let (polytope, medium, view) = (&case.polytope, case.medium, &case.view);
        let tree = beam::trace(polytope, medium, view, &options, &unwatched).unwrap();
        let summed = summed(&case, &options, &aset(), None);
        assert!(number > 0 || summed.open.len() < tree.len() / 3, "{} of {}", summed.open.len(), tree.len());
        assert_eq!(by_summed_beams(&summed), by_beams(&tree, &aset()), "stone {number}");
    }
}
