//! Integrals of exp(-f) over a convex polygon or an edge, with f affine: the amount of light that is left in a beam
//! that is absorbed, and its centre.

use super::Affine;
use glam::DVec2;
use std::ops::{Add, Mul};

/// Triangles over which f varies by more than this are divided, so that the series below converges quickly.
const WIDEST: f64 = 1.0;

/// Where f exceeds its least value by this much, exp(-f) is below the rounding of the whole integral and is left out.
const NOTHING: f64 = 45.0;

/// The greatest number of times that a triangle is halved. If f still varies too much after that, it varies by more
/// than corners in f64 can resolve.
const MOST_HALVINGS: u32 = 100;

/// Returns the integral of exp(-f) over a convex polygon with counter-clockwise corners, to about 1e-15 of the whole.
pub fn integral_of_decay(corners: &[DVec2], f: Affine) -> f64 {
    let Some((&a, rest)) = corners.split_first() else { return 0.0 };
    let least = corners.iter().map(|&c| f.at(c)).fold(f64::INFINITY, f64::min);
    rest.windows(2).map(|w| triangle([a, w[0], w[1]], f, least + NOTHING, MOST_HALVINGS)).sum()
}

fn triangle(corners: [DVec2; 3], f: Affine, nothing: f64, halvings: u32) -> f64 {
    let values = corners.map(|c| f.at(c));
    let [a, b, c] = corners;
    match halves(corners, f, nothing, halvings) {
        Halving::Nothing => 0.0,
        Halving::Narrow => (b - a).perp_dot(c - a) * divided_difference(values),
        Halving::Wide(halves) => {
            halves.into_iter().map(|half| triangle(half, f, nothing, halvings - 1)).sum()
        }
    }
}

/// Adds the parts of a triangle over which f varies by little and exp(-f) is not negligible.
fn divide(corners: [DVec2; 3], f: Affine, nothing: f64, halvings: u32, parts: &mut Vec<[DVec2; 3]>) {
    match halves(corners, f, nothing, halvings) {
        Halving::Nothing => {}
        Halving::Narrow => parts.push(corners),
        Halving::Wide(halves) => {
            halves.into_iter().for_each(|half| divide(half, f, nothing, halvings - 1, parts));
        }
    }
}

/// The treatment of a triangle.
enum Halving {
    /// The triangle is left out, because exp(-f) is negligible in it.
    Nothing,
    /// The triangle is kept whole, because the series converges quickly.
    Narrow,
    /// The triangle is divided into these two.
    Wide([[DVec2; 3]; 2]),
}

#[inline(always)]
fn halves([a, b, c]: [DVec2; 3], f: Affine, nothing: f64, halvings: u32) -> Halving {
    let values = [f.at(a), f.at(b), f.at(c)];
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if low > nothing {
        return Halving::Nothing;
    }
    if high - low <= WIDEST || halvings == 0 {
        return Halving::Narrow;
    }
    // The edge along which f varies most is halved.
    let [p, q, r] = [[a, b, c], [b, c, a], [c, a, b]]
        .into_iter()
        .max_by(|x, y| (f.at(x[0]) - f.at(x[1])).abs().total_cmp(&(f.at(y[0]) - f.at(y[1])).abs()))
        .unwrap_or([a, b, c]);
    let middle = (p + q) / 2.0;
    Halving::Wide([[p, middle, r], [middle, q, r]])
}

/// Returns the divided difference of exp at the negatives of N values.
///
/// By the Hermite-Genocchi formula this is the mean of exp(-f) over a simplex with those values of f at its corners,
/// divided by (N - 1)!. A value that is given twice weights the mean by the coordinate of its corner, times (N - 1)!
/// / N!. The result is computed as a series in the complete homogeneous symmetric polynomials h_k, Σ h_k / (k + N -
/// 1)!.
fn divided_difference<const N: usize>(values: [f64; N]) -> f64 {
    let mean = values.iter().sum::<f64>() / N as f64;
    let mut factorial: f64 = (1..N).map(|k| k as f64).product();
    // h_k of the first value, of the first two values, and so on, each computed from the one before.
    let mut polynomials = [1.0; N];
    let mut sum = 1.0 / factorial;
    for k in 1..18 {
        let mut before = 0.0;
        for (own, value) in polynomials.iter_mut().zip(values) {
            *own = before + (mean - value) * *own;
            before = *own;
        }
        factorial *= (k + N - 1) as f64;
        sum += before / factorial;
    }
    sum * (-mean).exp()
}

/// An amount that is spread over a region of the image: its sum and its first moment, which is the sum times the
/// centre.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Moments {
    /// The sum of the amount over the region.
    pub sum: f64,
    /// The integral of the position, weighted by the amount.
    pub first: DVec2,
}

impl Add for Moments {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { sum: self.sum + other.sum, first: self.first + other.first }
    }
}

impl Mul<f64> for Moments {
    type Output = Self;

    fn mul(self, by: f64) -> Self {
        Self { sum: self.sum * by, first: self.first * by }
    }
}

/// Returns the integral of exp(-f) over a convex polygon with counter-clockwise corners, and its first moment.
pub fn moments_of_decay(corners: &[DVec2], f: Affine) -> Moments {
    let Some((&a, rest)) = corners.split_first() else { return Moments::default() };
    let nothing = corners.iter().map(|&c| f.at(c)).fold(f64::INFINITY, f64::min) + NOTHING;
    let mut parts = vec![];
    for w in rest.windows(2) {
        divide([a, w[0], w[1]], f, nothing, MOST_HALVINGS, &mut parts);
    }
    let of_part = |part: [DVec2; 3]| {
        let [x, y, z] = part.map(|c| f.at(c));
        let twice_area = (part[1] - part[0]).perp_dot(part[2] - part[0]);
        let at = |k: usize, value| part[k] * divided_difference([x, y, z, value]);
        Moments { sum: divided_difference([x, y, z]), first: at(0, x) + at(1, y) + at(2, z) } * twice_area
    };
    parts.into_iter().map(of_part).fold(Moments::default(), Add::add)
}

/// Returns the integral of exp(-f) along the edge from a to b, and its first moment.
pub fn moments_along_edge(a: DVec2, b: DVec2, f: Affine) -> Moments {
    // The integral begins at the end where f is least, so that no exponential overflows.
    let (a, b) = if f.at(a) <= f.at(b) { (a, b) } else { (b, a) };
    let fall = f.at(b) - f.at(a);
    // The integrals of exp(-fall t) and t exp(-fall t) over t from 0 to 1.
    let [even, weighed] = if fall <= WIDEST {
        [divided_difference([0.0, fall]), divided_difference([0.0, fall, fall])]
    } else {
        let even = -(-fall).exp_m1() / fall;
        [even, (even - (-fall).exp()) / fall]
    };
    Moments { sum: even, first: a * even + (b - a) * weighed } * ((-f.at(a)).exp() * a.distance(b))
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

    #[test]
    fn moments_are_those_of_a_fine_grid_and_their_sum_is_the_integral() {
        let corners = [(0.1, -0.2), (0.9, 0.1), (1.1, 0.8), (0.3, 0.9)].map(|(x, y)| DVec2::new(x, y));
        for (c, gx, gy) in [(0.2, 0.0, 0.0), (0.1, 0.4, -0.7), (3.0, -4.0, 2.5), (0.0, 30.0, -8.0)] {
            let f = Affine::new(c, DVec2::new(gx, gy));
            let found = moments_of_decay(&corners, f);
            let whole = integral_of_decay(&corners, f);
            assert!((found.sum - whole).abs() <= 1e-14 * whole, "{gx} {gy}");
            // The first moment is minus the derivative of the integral by the gradient.
            let by = |h: DVec2| integral_of_decay(&corners, Affine::new(c, f.gradient + h));
            for axis in [DVec2::X, DVec2::Y] {
                let h = 1e-4;
                let near = by(axis * -h) - by(axis * h);
                let far = by(axis * (-2.0 * h)) - by(axis * (2.0 * h));
                let expected = (8.0 * near - far) / (12.0 * h);
                assert!((found.first.dot(axis) - expected).abs() < 1e-10 * whole, "{gx} {gy} {axis}");
            }
        }
    }

    #[test]
    fn moments_along_an_edge_are_those_of_a_sum_of_many_points() {
        let (a, b) = (DVec2::new(0.2, -0.1), DVec2::new(1.0, 0.7));
        for (c, gx, gy) in
            [(0.2, 0.0, 0.0), (0.1, 0.4, -0.7), (3.0, -4.0, 2.5), (0.0, 30.0, 8.0), (0.0, -0.6, -0.6)]
        {
            let f = Affine::new(c, DVec2::new(gx, gy));
            // Simpson's rule.
            let count = 4000;
            let mut expected = Moments::default();
            for k in 0..=count {
                let at = a.lerp(b, f64::from(k) / f64::from(count));
                let weight = if k == 0 || k == count { 1.0 } else { f64::from(2 + 2 * (k % 2)) };
                let here = weight * (-f.at(at)).exp();
                expected = expected + Moments { sum: here, first: at * here };
            }
            let expected = expected * (a.distance(b) / (3.0 * f64::from(count)));
            for found in [moments_along_edge(a, b, f), moments_along_edge(b, a, f)] {
                assert!((found.sum - expected.sum).abs() < 1e-9 * expected.sum, "{gx} {gy}");
                assert!(found.first.distance(expected.first) < 1e-9 * expected.sum, "{gx} {gy}");
            }
        }
    }
}
