//! Pseudorandom numbers that are computed from other numbers, so that the result does not depend on the order of
//! work.

/// Returns a number whose bits look random and that differs for each input: the output function of SplitMix64 (G. L.
/// Steele, D. Lea and C. H. Flood, "Fast Splittable Pseudorandom Number Generators", OOPSLA 2014) after one step of
/// `GAMMA`.
pub fn mixed(number: u64) -> u64 {
    let z = number.wrapping_add(GAMMA);
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// The step of SplitMix64 from one number of a sequence to the next.
pub const GAMMA: u64 = 0x9e37_79b9_7f4a_7c15;

/// Returns a number from 0 to below 1 from random bits.
pub fn unit(bits: u64) -> f64 {
    (bits >> 11) as f64 / (1_u64 << 53) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_those_of_the_published_generator() {
        // The first three numbers of SplitMix64 with the seed 1234567.
        let found = [0_u64, 1, 2].map(|k| mixed(1_234_567_u64.wrapping_add(k.wrapping_mul(GAMMA))));
        assert_eq!(found, [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423]);
    }

    #[test]
    fn units_are_even_from_0_to_below_1() {
        assert!(unit(0) == 0.0 && unit(u64::MAX) < 1.0);
        let mean = (0..10_000).map(|k| unit(mixed(k))).sum::<f64>() / 1e4;
        assert!((mean - 0.5).abs() < 0.01, "{mean}");
    }
}
