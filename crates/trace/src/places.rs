//! The places of the rays of sample passes in their pixels, and the stretch of the pixel that each ray represents.
//!
//! Each place is followed by the one opposite to it, on the other side of the pixel's middle. The places with even
//! numbers fill the upper half of the pixel by the first two dimensions of I. M. Sobol's sequence (1967), the second with
//! the direction numbers of S. Joe and F. Kuo (2008). The numbers are those of the shares of each band of wavelengths, from
//! short to long ([`Strata::place`](brillianteer_optics::Strata::place)). So any two neighbouring shares lie in different
//! halves of the pixel, the mean place of a few neighbouring shares is near the middle, and each part of a pixel is sampled
//! in about all wavelengths. Nothing is random, so the same picture always gives the same result.

use glam::DVec2;
use std::f64::consts::PI;

/// The number of bits of a coordinate.
const BITS: u32 = 32;

/// The direction numbers of the second dimension: those of the polynomial x + 1.
const DIRECTIONS: [u32; BITS as usize] = directions();

/// The step of the golden ratio's sequence, in half turns. Any number of its directions are spread evenly.
const STEP_OF_DIRECTION: f64 = 0.618_033_988_749_894_8;

/// The least length of the stretch of a pixel that a ray represents, in pixels.
const LEAST_STRETCH: f64 = 0.125;

/// Returns direction numbers by the recurrence of the primitive polynomial x + 1.
const fn directions() -> [u32; BITS as usize] {
    let mut m = 1_u64;
    let mut all = [0; BITS as usize];
    let mut k = 0;
    while k < BITS as usize {
        all[k] = (m << (BITS as usize - 1 - k)) as u32;
        m ^= m << 1;
        k += 1;
    }
    all
}

/// Returns both coordinates of the point of Sobol's sequence with this number, 0 to below 1.
fn sobol(number: u32) -> DVec2 {
    let second =
        DIRECTIONS.iter().enumerate().filter(|(k, _)| number >> k & 1 == 1).fold(0, |x, (_, v)| x ^ v);
    DVec2::new(f64::from(second), f64::from(number.reverse_bits())) / f64::from(BITS).exp2()
}

/// Returns the place with this number in a pixel of `count` places. Both coordinates are 0 to 1, the mean of all places is
/// the middle of the pixel, and neither coordinate is taken twice. Places beyond the last lie between the others.
pub fn place_in_pixel(number: u32, count: u32) -> DVec2 {
    let count = count.max(1);
    if number >= count {
        return (sobol(number) + 0.5 / f64::from(count)).fract();
    }
    if number == count - 1 && count % 2 == 1 {
        return DVec2::splat(0.5);
    }
    let cell = f64::from(count).recip();
    let upper = (sobol(number / 2) + cell * DVec2::new(0.5, 1.0)).fract() * DVec2::new(1.0, 0.5);
    if number.is_multiple_of(2) { upper } else { 1.0 - upper }
}

/// Returns the stretch of its pixel that the ray at the place with this number represents, in a pixel of `count` places, in
/// pixels to the right and down. Its length is the distance between that many places in a pixel, so that
/// together the rays cover the whole pixel, or less where it would leave the pixel. Its direction turns from place to
/// place. That of the first place is horizontal, so that mirror images stay mirror images.
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
            assert!(low > 0.0 && high < 1.0, "{count}: {low} to {high}");
        }
        assert_eq!(place_in_pixel(0, 1), DVec2::splat(0.5));
        assert!((64..100).all(|number| place_in_pixel(number, 64).cmplt(DVec2::ONE).all()));
    }

    #[test]
    fn places_and_wavelengths_are_spread_evenly_together() {
        // The boxes divide spectrum, width and height of a pixel of 64 places, whose numbers are those of its shares.
        let boxes = |bits: [u32; 3]| {
            let mut boxes = vec![0; 1 << bits.iter().sum::<u32>()];
            for k in 0..64 {
                let place = place_in_pixel(k, 64);
                let at = [f64::from(k) / 64.0, place.x, place.y];
                let place = at
                    .iter()
                    .zip(bits)
                    .fold(0, |sum, (at, bits)| (sum << bits) + (at * f64::from(1 << bits)) as usize);
                boxes[place] += 1;
            }
            boxes
        };
        for bits in [[6, 0, 0], [0, 6, 0], [0, 0, 6], [5, 0, 1], [4, 1, 1], [3, 0, 3], [2, 2, 2]] {
            assert_eq!(boxes(bits), vec![1; 64], "{bits:?}");
        }
    }

    #[test]
    fn neighbouring_shares_lie_around_the_middle_of_the_pixel() {
        // The mean of `width` neighbours, and where they would lie without each other's opposites.
        let off = |width: u32, place: &dyn Fn(u32) -> DVec2| {
            let mean = |first: u32| {
                let sum: DVec2 = (first..first + width).map(place).sum();
                (sum / f64::from(width) - 0.5).length_squared()
            };
            ((0..=64 - width).map(mean).sum::<f64>() / f64::from(65 - width)).sqrt()
        };
        for (width, most) in [(2, 0.18), (3, 0.14), (4, 0.09)] {
            let (own, plain) =
                (off(width, &|k| place_in_pixel(k, 64)), off(width, &|k| sobol(k) + 1.0 / 128.0));
            assert!(own < most && own < plain, "{width}: {own}, {plain} without opposites");
        }
        assert!(
            (0..32)
                .all(|j| (place_in_pixel(2 * j, 64) + place_in_pixel(2 * j + 1, 64) - 1.0).length() < 1e-12)
        );
    }

    #[test]
    fn stretches_are_as_long_as_places_are_apart_and_point_everywhere() {
        for count in [1, 8, 64, 1000] {
            let length = (1.0 / f64::from(count)).sqrt().max(LEAST_STRETCH);
            let squares = (0..count).map(|number| {
                let along = stretch_of_pixel(number, count);
                let place = place_in_pixel(number, count);
                let ends = [place - 0.5 * along, place + 0.5 * along];
                assert!(ends.iter().all(|end| end.min_element() > -1e-9 && end.max_element() < 1.0 + 1e-9));
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
