//! The random numbers that decide by which microscopic mirror a metal reflects a ray, and how a frosted facet
//! scatters it. They are the same in all bands of wavelengths, so that chance adds no colours.

use brillianteer_math::random_bits::{mixed, unit};

/// The step of each number from one sample pass to the next, in units of 2^-64: √7 - 2, √6 - 2 and (√21 - 3)/2. They are
/// chosen like the roulette's steps, and no sum of whole multiples of all of them is a whole number.
const STEPS: [u64; 3] = [0xa54f_f53a_5f1d_36f1, 0x7311_c281_2425_cfa0, 0xca91_d722_a3d0_a666];

/// A constant that keeps the numbers here independent of the roulette's, which are made of the same pixels.
const SALT: u64 = 0x6d65_7461_6c6c_7563;

/// The random numbers of one path.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct LobeLuck {
    /// The seed of the numbers. It differs for each pixel, and for each path that the light takes from the pixel.
    seed: u64,
    /// The number of the sample pass.
    number: u64,
    /// True where numbers of the path have been drawn before. Further numbers are drawn at random; the first are
    /// spread evenly over the passes.
    is_later: bool,
}

impl LobeLuck {
    /// Returns the random numbers of a pixel's ray in a sample pass.
    pub fn new([x, y]: [u32; 2], number: u32) -> Self {
        let pixel = mixed(u64::from(x) << 32 | u64::from(y));
        Self { seed: mixed(pixel ^ SALT), number: number.into(), is_later: false }
    }

    /// Returns the random numbers of light that leaves a stone by the exit with this number.
    pub fn beyond(&self, exit: u64) -> Self {
        Self { seed: mixed(self.seed ^ mixed(exit)), ..*self }
    }

    /// Returns the random numbers of a path that has already drawn some numbers through another copy.
    pub fn later(&self) -> Self {
        Self { is_later: true, ..*self }
    }

    /// Returns an endless supply of random numbers from 0 to below 1, independent of those of [`draw`](Self::draw).
    pub fn numbers(&self) -> impl FnMut() -> f64 + use<> {
        let Self { seed, number, .. } = *self;
        let mut place = STEPS.len() as u64;
        move || {
            place += 1;
            unit(mixed(mixed(seed.wrapping_add(place)) ^ mixed(number)))
        }
    }

    /// Returns three numbers from 0 to below 1, and the state after them.
    pub fn draw(&self) -> ([f64; 3], Self) {
        let number = |k: usize| {
            let own = mixed(self.seed.wrapping_add(k as u64));
            unit(if self.is_later {
                mixed(own ^ mixed(self.number))
            } else {
                own.wrapping_add(STEPS[k].wrapping_mul(self.number))
            })
        };
        let later = Self { seed: mixed(self.seed ^ SALT), is_later: true, ..*self };
        ([number(0), number(1), number(2)], later)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_numbers_of_a_pixel_fill_the_cube_evenly_and_later_ones_at_random() {
        let rays = 512;
        // The cube is divided into four by four by four boxes; numbers that are spread evenly put 8 of 512 into each.
        let boxes = |later: bool| {
            let mut counts = [0_i32; 64];
            for number in 0..rays {
                let (first, next) = LobeLuck::new([3, 8], number).draw();
                let numbers = if later { next.draw().0 } else { first };
                let [a, b, c] = numbers.map(|x| (4.0 * x) as usize);
                counts[16 * a + 4 * b + c] += 1;
            }
            let mean = rays as i32 / 64;
            counts.iter().map(|count| (count - mean).pow(2)).sum::<i32>()
        };
        // At random, each count differs from the mean by about the root of the mean.
        assert!(boxes(false) < 200 && boxes(true) > 250, "{} {}", boxes(false), boxes(true));
    }
}
