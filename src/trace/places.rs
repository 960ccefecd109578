//! The places of the rays of sample passes in their pixels, and the stretch of the pixel that each ray represents.
//!
//! The places are points of I. M. Sobol's sequence (1967), with the direction numbers of S. Joe and F. Kuo (2008).
//! They take the second and the third dimension of the sequence; the first, which is van der Corput's, orders the
//! wavelengths ([`Strata`](crate::optics::Strata)). So the passes of a picture are spread evenly over pixel and
//! spectrum together, and each part of a pixel is sampled in about all wavelengths. Nothing is random, so the same
//! picture always gives the same result.

use glam::DVec2;
use std::f64::consts::PI;

/// The number of bits of a coordinate.
const BITS: u32 = 32;

/// The direction numbers of both coordinates.
const DIRECTIONS: [[u32; BITS as usize]; 2] = [directions([1, 3], 1), directions([1, 3], 2)];

/// The step of the golden ratio's sequence, in half turns. Any number of its directions are spread evenly.
const STEP_OF_DIRECTION: f64 = 0.618_033_988_749_894_8;

/// The least length of the stretch of a pixel that a ray represents, in pixels.
const LEAST_STRETCH: f64 = 0.125;

/// Returns direction numbers by the recurrence of the primitive polynomial x + 1 (degree 1) or x² + x + 1 (degree 2).
const fn directions(first: [u32; 2], degree: usize) -> [u32; BITS as usize] {
    let mut m = [0_u64; BITS as usize];
    let mut all = [0; BITS as usize];
    let mut k = 0;
    while k < BITS as usize {
        m[k] = if k < degree {
            first[k] as u64
        } else if degree == 1 {
            m[k - 1] << 1 ^ m[k - 1]
        } else {
            m[k - 1] << 1 ^ m[k - 2] << 2 ^ m[k - 2]
        };
        all[k] = (m[k] << (BITS as usize - 1 - k)) as u32;
        k += 1;
    }
    all
}

/// Returns a coordinate of the point with this number, in units of 2⁻³².
fn coordinate(directions: &[u32; BITS as usize], number: u32) -> u32 {
    directions.iter().enumerate().filter(|(k, _)| number >> k & 1 == 1).fold(0, |x, (_, v)| x ^ v)
}

/// Returns the mean of a coordinate over the first `count` points.
fn mean(directions: &[u32; BITS as usize], count: u32) -> f64 {
    // The numbers are divided into blocks of 2^k that begin at multiples of 2^k. In each block the first k bits of
    // the coordinate take every value once, and the other bits are those of the block's first number.
    let unit = f64::from(BITS).exp2().recip();
    let block = |k: u32| {
        let first = if k + 1 < BITS { count >> (k + 1) << (k + 1) } else { 0 };
        let size = f64::from(k).exp2();
        let rest = (u64::from(coordinate(directions, first)) & ((1 << (BITS - k)) - 1)) as f64 * unit;
        size * (0.5 - 0.5 / size + rest)
    };
    let sum: f64 = (0..BITS).filter(|k| count >> k & 1 == 1).map(block).sum();
    sum / f64::from(count)
}

/// Returns the place of the rays of a sample pass in their pixels, in a picture of `count` passes. Both coordinates
/// are 0 to 1, or beyond that by less than 0.02. The mean of all places is the middle of the pixel. Passes beyond the
/// last take places between those of the others.
pub fn place_in_pixel(number: u32, count: u32) -> DVec2 {
    let place = DIRECTIONS.each_ref().map(|directions| {
        let at = f64::from(coordinate(directions, number)) / f64::from(BITS).exp2();
        let moved = at + 0.5 - mean(directions, count.max(1));
        if number < count { moved } else { moved.rem_euclid(1.0) }
    });
    place.into()
}

/// Returns the stretch of its pixel that a ray of a sample pass represents, in a picture of `count` passes, in pixels
/// to the right and down. Its length is the distance between the places of that many rays in a pixel, so that
/// together the rays cover the whole pixel, or less where it would leave the pixel. Its direction turns from pass to
/// pass. That of the first pass is horizontal, so that mirror images stay mirror images.
pub fn stretch_of_pixel(number: u32, count: u32) -> DVec2 {
    let length = f64::from(count.max(1)).sqrt().recip().max(LEAST_STRETCH);
    let stretch = DVec2::from_angle(PI * (STEP_OF_DIRECTION * f64::from(number)).fract()) * length;
    let place = place_in_pixel(number, count);
    let room = (2.0 * place.min(1.0 - place).max(DVec2::ZERO) / stretch.abs().max(DVec2::splat(1e-12)))
        .min_element();
    stretch * room.min(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_middle_of_all_places_is_that_of_the_pixel() {
        for count in (1..=130).chain([1000, 65_535, 65_536]) {
            let places = (0..count).map(|number| place_in_pixel(number, count));
            let middle = places.clone().sum::<DVec2>() / f64::from(count);
            assert!((middle - 0.5).length() < 1e-9, "{count}: {middle}");
            let [low, high] = [
                places.clone().reduce(DVec2::min).unwrap().min_element(),
                places.reduce(DVec2::max).unwrap().max_element(),
            ];
            assert!(low > -0.02 && high < 1.02, "{count}: {low} to {high}");
        }
        assert_eq!(place_in_pixel(0, 1), DVec2::splat(0.5));
    }

    #[test]
    fn places_and_wavelengths_are_spread_evenly_together() {
        // Of 64 passes, each of 64 equal boxes of pixel and spectrum holds one to within the sequence's quality (t = 1): each of
        // the 32 twice as large boxes holds two.
        let passes = (0..64_u32).map(|k| {
            let at = place_in_pixel(k, 64);
            [f64::from(k.reverse_bits()) / f64::from(BITS).exp2(), at.x, at.y]
        });
        let passes: Vec<_> = passes.collect();
        for [a, b, c] in [
            [5, 0, 0],
            [0, 5, 0],
            [0, 0, 5],
            [2, 2, 1],
            [1, 2, 2],
            [2, 1, 2],
            [3, 1, 1],
            [1, 3, 1],
            [1, 1, 3],
        ] {
            let mut boxes = [0; 32];
            for pass in &passes {
                let [i, j, k] = [(pass[0], a), (pass[1], b), (pass[2], c)]
                    .map(|(x, bits)| (x * f64::from(1 << bits)) as usize);
                boxes[(i << (b + c)) + (j << c) + k] += 1;
            }
            assert_eq!(boxes, [2; 32], "{a}, {b}, {c}");
        }
    }

    #[test]
    fn stretches_are_as_long_as_places_are_apart_and_point_everywhere() {
        for count in [1, 8, 64, 1000] {
            let length = (1.0 / f64::from(count)).sqrt().max(LEAST_STRETCH);
            let squares = (0..count).map(|number| {
                let along = stretch_of_pixel(number, count);
                let place = place_in_pixel(number, count);
                let ends = [place - 0.5 * along, place + 0.5 * along];
                assert!(ends.iter().all(|end| end.min_element() > -0.02 && end.max_element() < 1.02));
                assert!(along.length() < length + 1e-12);
                along * along
            });
            let mean = squares.sum::<DVec2>() / f64::from(count) / (length * length);
            let all = mean.element_sum();
            assert!(
                all > 0.3 && (count == 1 || (mean / all - 0.5).abs().max_element() < 0.2),
                "{count}: {mean}"
            );
        }
    }
}
