//! Scales of colours that stand for numbers.

use super::Code;
use std::f64::consts::TAU;

/// Ten colours of viridis at equal distances: S. van der Walt and N. Smith, 2015, of matplotlib, in the public domain
/// (CC0). Equal steps along it look equally large, also in grey and to people who do not see red or green.
const VIRIDIS: [u32; 10] = [
    0x44_01_54, 0x48_28_78, 0x3e_49_89, 0x31_68_8e, 0x26_82_8e, 0x1f_9e_89, 0x35_b7_79, 0x6d_cd_59,
    0xb4_de_2c, 0xfd_e7_25,
];

/// The part of a turn by which each hue differs from the one before: the golden section keeps it farthest from all hues
/// before.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// Returns the colour of viridis for 0 to 1, interpolated linearly between its colours; beyond, those of its ends.
pub(super) fn viridis(part: f64) -> Code {
    let at = part.clamp(0.0, 1.0) * (VIRIDIS.len() - 1) as f64;
    let below = (at as usize).min(VIRIDIS.len() - 2);
    let [low, high] = [below, below + 1].map(|k| VIRIDIS[k].to_be_bytes());
    let between =
        |c: usize| f64::from(low[c]) + (f64::from(high[c]) - f64::from(low[c])) * (at - below as f64);
    [1, 2, 3].map(|c| between(c).round() as u8)
}

/// Returns a colour for a facet: its hue is far from those of facets with near numbers, and it is mild, neither dark nor
/// bright.
pub(super) fn distinct(stone: usize, facet: u32) -> Code {
    let hue = TAU * (f64::from(facet) * GOLDEN + stone as f64 * GOLDEN / 7.0).fract();
    let channel = |shift: f64| 140.0 + 100.0 * (hue - shift * TAU / 3.0).cos();
    [0.0, 1.0, 2.0].map(|shift| channel(shift).round() as u8)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::luminance;
    use brillianteer_optics::linear_from_encoded;

    #[test]
    fn viridis_begins_and_ends_as_published_and_grows_brighter_all_the_way() {
        assert_eq!(viridis(-1.0), [0x44, 0x01, 0x54]);
        assert_eq!(viridis(f64::INFINITY), [0xfd, 0xe7, 0x25]);
        // The middle of matplotlib's table of 256, #21918c.
        viridis(0.5).iter().zip([0x21, 0x91, 0x8c]).for_each(|(a, b)| assert!(a.abs_diff(b) <= 3));
        let bright = |k| {
            luminance(viridis(f64::from(k) / 64.0).map(|c| linear_from_encoded(f64::from(c) / 255.0) as f32))
        };
        assert!((0..64).all(|k| bright(k) < bright(k + 1)));
    }

    #[test]
    fn facets_with_near_numbers_have_colours_of_their_own() {
        let apart = |a: Code, b: Code| a.iter().zip(b).map(|(a, b)| a.abs_diff(b)).max().unwrap();
        for facet in 0..200 {
            assert!((1..8).all(|k| apart(distinct(0, facet), distinct(0, facet + k)) > 20), "{facet}");
            assert!(apart(distinct(0, facet), distinct(1, facet)) > 20);
        }
    }
}
