//! The integral of exp(-f) over a convex polygon, f affine: how much light is left in a beam that is absorbed.

use super::Affine;
use glam::DVec2;

/// Triangles over which f varies by more than this are split, so that the series below converges quickly.
const WIDEST: f64 = 1.0;

/// Where f exceeds its least value by this, exp(-f) is below the rounding of the whole integral and is left out.
const NOTHING: f64 = 45.0;

/// How often a triangle is halved at most. If f still varies too much after that, it varies by more than corners in f64 can
/// tell apart.
const MOST_HALVINGS: u32 = 100;

/// Returns the integral of exp(-f) over a convex polygon with counter-clockwise corners, to about 1e-15 of the whole.
pub fn integral_of_decay(corners: &[DVec2], f: Affine) -> f64 {
    let Some((&a, rest)) = corners.split_first() else { return 0.0 };
    let least = corners.iter().map(|&c| f.at(c)).fold(f64::INFINITY, f64::min);
    rest.windows(2).map(|w| triangle([a, w[0], w[1]], f, least + NOTHING, MOST_HALVINGS)).sum()
}

fn triangle([a, b, c]: [DVec2; 3], f: Affine, nothing: f64, halvings: u32) -> f64 {
    let values = [f.at(a), f.at(b), f.at(c)];
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if low > nothing {
        return 0.0;
    }
    if high - low <= WIDEST || halvings == 0 {
        return (b - a).perp_dot(c - a) * divided_difference(values);
    }
    // Halve the edge along which f varies most.
    let [p, q, r] = [[a, b, c], [b, c, a], [c, a, b]]
        .into_iter()
        .max_by(|x, y| (f.at(x[0]) - f.at(x[1])).abs().total_cmp(&(f.at(y[0]) - f.at(y[1])).abs()))
        .unwrap_or([a, b, c]);
    let middle = (p + q) / 2.0;
    [[p, middle, r], [middle, q, r]].into_iter().map(|half| triangle(half, f, nothing, halvings - 1)).sum()
}

/// Returns the second divided difference of exp at the negatives of three values.
///
/// By the Hermite-Genocchi formula it is half the mean of exp(-f) over a triangle with those values of f at its corners. It
/// is computed as a series in the complete homogeneous symmetric polynomials h_k, Σ h_k / (k + 2)!.
fn divided_difference(values: [f64; 3]) -> f64 {
    let mean = values.iter().sum::<f64>() / 3.0;
    let [x, y, z] = values.map(|v| mean - v);
    // h_k(x), h_k(x, y) and h_k(x, y, z), each computed from the one before.
    let (mut one, mut two, mut three) = (1.0, 1.0, 1.0);
    let (mut sum, mut factorial) = (0.5, 2.0);
    for k in 1..18 {
        one *= x;
        two = one + y * two;
        three = two + z * three;
        factorial *= f64::from(k + 2);
        sum += three / factorial;
    }
    sum * (-mean).exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_constant_decay_is_the_area_times_it() {
        let square = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
        let got = integral_of_decay(&square, Affine::new(0.7, DVec2::ZERO));
        assert!((got - (-0.7_f64).exp()).abs() < 1e-15);
    }

    #[test]
    fn a_square_with_a_slope_has_the_integral_of_its_exponentials() {
        let square = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
        for (c, gx, gy) in
            [(0.3, 1e-9, 0.0), (0.1, 0.4, -0.2), (2.0, 3.0, -1.5), (0.0, 20.0, 35.0), (1.0, 3000.0, 40.0)]
        {
            let got = integral_of_decay(&square, Affine::new(c, DVec2::new(gx, gy)));
            let factor = |g: f64| if g == 0.0 { 1.0 } else { -(-g).exp_m1() / g };
            let expected = (-c).exp() * factor(gx) * factor(gy);
            assert!((got - expected).abs() < 2e-13 * expected, "{c} {gx} {gy}: {got} {expected}");
        }
    }

    #[test]
    fn the_steepest_decay_ends_and_is_the_strip_that_it_leaves() {
        let square = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
        for (slope, within) in [(1e3, 1e-6), (1e7, 1e-6), (1e12, 1e-6), (1e30, 1e-2)] {
            let found = integral_of_decay(&square, Affine::new(0.0, DVec2::X * slope));
            assert!((found * slope - 1.0).abs() < within, "{slope:e}: {found:e}");
        }
        assert!(integral_of_decay(&square, Affine::new(f64::NAN, DVec2::ZERO)).is_nan());
    }
}
