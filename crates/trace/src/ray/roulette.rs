//! Russian roulette: weak light goes on only by chance, and counts for more where it does, so that the mean over all
//! chances is exact.

use super::light::PathLight;
use super::loss::Loss;
use brillianteer_math::random_bits::{mixed, unit};
use brillianteer_optics::Real;

/// The least random number of a chain. With a smaller one, the chain would be followed until no light is left.
const LEAST_LUCK: f64 = 1e-9;

/// The number of each ray's random numbers that are spread evenly over the rays of a pixel; further numbers are drawn
/// at random.
const EVEN: usize = 4;

/// The step of each of these numbers from one ray of the pixel to the next, in units of 2^-64: (√5 - 1)/2, √2 - 1,
/// √3 - 1 and (√13 - 3)/2. Multiples of one irrational number fill the interval from 0 to 1 evenly, and those of several
/// numbers fill the cube (R. D. Richtmyer, *The evaluation of definite integrals, and a quasi-Monte-Carlo method
/// based on the properties of algebraic numbers*, 1951). The continued fractions of these four begin with no large
/// number, so that gaps stay small for any number of rays.
const STEPS: [u64; EVEN] =
    [0x9e37_79b9_7f4a_7c15, 0x6a09_e667_f3bc_c908, 0xbb67_ae85_84ca_a73b, 0x4d82_b446_159f_3610];

/// The roulette of one ray: the weight below which light goes on by chance, and the random numbers that decide it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Roulette {
    /// The weight below which light goes on by chance, as a share of the light that the eye receives.
    threshold: f64,
    /// The seed, which differs from pixel to pixel.
    seed: u64,
    /// The number of the ray in its pixel.
    number: u64,
    drawn: usize,
}

/// The end of a chain of bounces, in any number type. Light below the threshold is followed only as far as one random
/// number decides, and light that leaves along the way counts for more.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ChainEnd<N> {
    /// The weight below which light goes on only by chance; 0 where all of it is followed.
    pub threshold: N,
    /// The weight at which the chain ends.
    pub least: N,
}

impl<N: Real> ChainEnd<N> {
    /// Returns the end of a chain that begins with this weight. `luck` is a random number from 0 to below 1.
    #[inline(always)]
    pub fn by_chance(threshold: N, luck: N, weight: N) -> Self {
        let threshold = threshold.min(weight);
        Self { threshold, least: luck.max(luck.constant(LEAST_LUCK)) * threshold }
    }

    /// Returns the factor by which light counts that has come so far with this weight: the inverse of the probability
    /// that a chain comes so far.
    #[inline(always)]
    pub fn factor(&self, weight: N) -> N {
        (self.threshold / weight.max(weight.constant(N::TINY))).max(weight.constant(1.0))
    }
}

impl<N: Real<Truth = bool>> ChainEnd<N> {
    /// Returns the weight that is unresolved where a chain has ended with this weight, which is 0 where chance has ended
    /// it.
    #[inline(always)]
    pub fn unresolved(&self, weight: N) -> N {
        let zero = weight.constant(0.0);
        let is_caught = zero.less(self.threshold) && !self.least.less(weight);
        if is_caught { zero } else { weight * self.factor(weight) }
    }
}

/// The roulette of one chain of bounces.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ChainRoulette {
    /// The weight at which the chain ends.
    pub end: ChainEnd<f64>,
    /// The weight of the light on the way to the next facet.
    before: f64,
    /// The share of that light that had not been absorbed at the last facet.
    left: f64,
    absorbed: f64,
}

/// Passes weights above a threshold, and as many of the weaker ones as together weigh the same; each of those then
/// weighs as much as the threshold. Successive weights are drawn systematically, so that their sum hardly changes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sieve {
    threshold: f64,
    /// The sum of the weak weights since the last of them that passed; `None` where no weak weight passes.
    level: Option<f64>,
}

/// The random decisions of one passage.
pub(super) struct PassageRoulette {
    pub chain: ChainRoulette,
    /// Decides which of the light that leaves is followed further.
    pub exits: Sieve,
}

impl PassageRoulette {
    /// Returns a roulette that follows all of this light until at most `least` of it is left.
    pub fn without_chance(least: f64, light: &PathLight, left: f64) -> Self {
        Self {
            chain: ChainRoulette {
                end: ChainEnd { threshold: 0.0, least },
                before: light.weight() * left,
                left,
                absorbed: 0.0,
            },
            exits: Sieve { threshold: f64::NEG_INFINITY, level: None },
        }
    }
}

impl Roulette {
    /// Returns the roulette of a ray. The pixel is given by column and row, and `number` counts the rays of the
    /// pixel.
    pub fn new(threshold: f64, [x, y]: [u32; 2], number: u64) -> Self {
        Self { threshold, seed: mixed(u64::from(x) << 32 | u64::from(y)), number, drawn: 0 }
    }

    /// Returns the roulette of light that leaves a stone by the exit with this number and meets another stone.
    pub fn beyond(&self, exit: u64) -> Self {
        Self { seed: mixed(self.seed ^ mixed(exit)), drawn: EVEN, ..*self }
    }

    /// Returns the sieve for light that leaves a body and meets another. It uses the random numbers of exit 0, so
    /// `beyond` must not be called with 0.
    pub(super) fn sieve(&self) -> Sieve {
        let luck = self.beyond(0).draw();
        Sieve { threshold: self.threshold, level: Some(luck * self.threshold) }
    }

    /// Draws the random numbers of a passage that begins with this light, of which absorption has left the share
    /// `left`.
    pub(super) fn passage(&mut self, light: &PathLight, left: f64) -> PassageRoulette {
        let threshold = self.threshold;
        PassageRoulette {
            chain: ChainRoulette::new(threshold, self.draw(), light, left),
            exits: Sieve { threshold, level: Some(self.draw() * threshold) },
        }
    }

    /// Returns the next number, from 0 to below 1.
    pub(crate) fn draw(&mut self) -> f64 {
        let k = self.drawn;
        self.drawn += 1;
        let own = mixed(self.seed.wrapping_add(k as u64));
        let bits = match STEPS.get(k) {
            Some(step) => own.wrapping_add(step.wrapping_mul(self.number)),
            None => mixed(own ^ mixed(self.number)),
        };
        unit(bits)
    }
}

impl ChainRoulette {
    /// Returns the roulette of a chain that begins with this light, of which absorption has left the share `left`.
    /// `luck` is a random number from 0 to below 1.
    pub fn new(threshold: f64, luck: f64, light: &PathLight, left: f64) -> Self {
        let before = light.weight() * left;
        Self { end: ChainEnd::by_chance(threshold, luck, before), before, left, absorbed: 0.0 }
    }

    /// Records a facet, and returns the factor by which light that leaves there counts. `light` arrives at the facet,
    /// absorption has left the share `left` of it, and the weight `onward` goes on.
    #[inline]
    pub fn meet(&mut self, light: &PathLight, left: f64, onward: f64) -> f64 {
        let factor = self.end.factor(self.before);
        if left < self.left {
            self.absorbed += light.weight() * (self.left - left) * factor;
            self.left = left;
        }
        self.before = onward;
        factor
    }

    /// Returns the loss of a chain that has ended after this many bounces.
    pub fn loss(&self, bounces: u32) -> Loss {
        Loss { absorbed: self.absorbed, unresolved: self.end.unresolved(self.before), bounces }
    }
}

impl Sieve {
    /// Returns the weight with which light of this weight goes on; `None` where it does not go on.
    #[inline]
    pub fn pass(&mut self, weight: f64) -> Option<f64> {
        if weight > self.threshold {
            return Some(weight);
        }
        let level = self.level.as_mut()?;
        *level += weight;
        (*level >= self.threshold).then(|| {
            *level -= self.threshold;
            self.threshold
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sieve_lets_each_weight_through_as_often_as_it_says() {
        let weights = [0.03, 0.2, 0.07, 0.0, 0.011, 0.1, 0.05];
        let (mut sums, count) = ([0.0; 7], 20_000);
        for k in 0..count {
            let mut sieve =
                Sieve { threshold: 0.1, level: Some(0.1 * (f64::from(k) + 0.5) / f64::from(count)) };
            let passed = weights.map(|weight| sieve.pass(weight));
            assert_eq!((passed[1], passed[3], passed[5]), (Some(0.2), None, Some(0.1)));
            assert!(passed.iter().flatten().all(|&weight| weight >= 0.1));
            // The weights that pass add up to the weights put in, except for less than one threshold.
            let off = passed.iter().flatten().sum::<f64>() - weights.iter().sum::<f64>();
            assert!(off.abs() < 0.1 + 1e-12, "{off}");
            sums.iter_mut()
                .zip(passed)
                .for_each(|(sum, weight)| *sum += weight.unwrap_or(0.0) / f64::from(count));
        }
        for (sum, weight) in sums.iter().zip(weights) {
            assert!((sum - weight).abs() < 1e-5, "{sum} for {weight}");
        }
    }

    #[test]
    fn the_numbers_of_a_pixels_rays_are_spread_evenly_and_differ_from_pixel_to_pixel() {
        let rays = 256;
        for k in 0..6 {
            let numbers = |x: u32| {
                let of_ray = |number: u64| {
                    let mut roulette = Roulette::new(0.1, [x, 7], number);
                    (0..=k).map(|_| roulette.draw()).last().unwrap_or(1.0)
                };
                (0..rays).map(of_ray).collect::<Vec<f64>>()
            };
            let own = numbers(3);
            assert!(own.iter().all(|number| (0.0..1.0).contains(number)));
            // The largest gap between numbers that are spread evenly is a few times the mean gap; between random
            // numbers it is larger.
            let gap = |mut numbers: Vec<f64>| {
                numbers.sort_by(f64::total_cmp);
                numbers.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max) * rays as f64
            };
            assert_eq!(gap(own.clone()) < 3.0, k < EVEN, "{k}: {}", gap(own.clone()));
            let mean = own.iter().zip(numbers(4)).map(|(a, b)| (a - b).abs()).sum::<f64>() / rays as f64;
            assert!(mean > 0.01, "{k}: {mean}");
        }
    }
}
