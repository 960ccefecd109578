//! Strata of wavelength, by which a render samples the spectrum, and the colour of the light in each stratum.
//!
//! Colours are linear sRGB. Components of a stratum's colour may be negative, because it is more saturated than any screen;
//! only the sum over all strata is meant to be seen.

use super::illuminant::Illuminant;
use super::observer::{D65_WHITE, OBSERVER_NM, SRGB_FROM_XYZ, adaptation, matching, seen};
use glam::{DMat3, DVec3};
use std::{ops::RangeInclusive, sync::LazyLock};

/// The range of wavelengths in nm that is divided into strata.
///
/// Of an even spectrum, 0.08 % of the observer's response (x̄ + ȳ + z̄) lies outside this range; that light counts
/// toward the first and the last stratum.
pub const SAMPLED_NM: RangeInclusive<f64> = 390.0..=720.0;

/// The part of a stratum's share that depends only on its width. It keeps the outermost strata narrow where there are
/// many.
const EVEN: f64 = 0.1;

/// The wavelength at which red ends, and the width of that step, in nm. It is chosen together with [`BLUE_STEP`] so
/// that [`basis`] is positive everywhere.
const RED_STEP: (f64, f64) = (591.0, 6.0);

/// The wavelength at which blue ends, and the width of that step, in nm.
const BLUE_STEP: (f64, f64) = (489.0, 7.0);

/// A stratum: a range of wavelengths, which each pass samples at one wavelength.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stratum {
    /// The shortest wavelength in nm.
    pub from_nm: f64,
    /// The longest wavelength in nm.
    pub to_nm: f64,
    /// The linear sRGB of light in this range only, first of the key light, then of D65 times the red, the green and
    /// the blue [`basis`]. Components may be negative.
    ///
    /// Summed over all strata, the key light has Y = 1, and so have the three others together. A render multiplies
    /// the responses by the radiance at the wavelength [`Stratum::at`].
    pub response: [DVec3; 4],
}

impl Stratum {
    /// Returns the wavelength in nm at a part of the stratum, where 0 is `from_nm` and 1 is `to_nm`.
    pub fn at(&self, part: f64) -> f64 {
        self.from_nm + (self.to_nm - self.from_nm) * part
    }
}

/// The strata of a picture, each divided into shares, which its sample passes take in turn: with every pass a picture
/// samples other wavelengths, and after as many passes as there are shares it has sampled each share once.
#[derive(Debug, Clone, PartialEq)]
pub struct Strata {
    whole: Vec<Stratum>,
    /// The shares of all strata, stratum by stratum, from short wavelengths to long.
    shares: Vec<Stratum>,
    /// The share that each pass takes.
    turns: Vec<u32>,
}

/// The most shares of all strata together: with more, shares are so narrow that no eye distinguishes them.
const MOST_SHARES: u32 = 1024;

/// The number of evenly spread shares whose sum is white to 1 %.
const ENOUGH_SHARES: u64 = 48;

impl Strata {
    /// Divides the visible range as [`strata()`] does, and each of the `count` strata into `shares` parts of equal
    /// share. Where these are more than 1024 together, their number per stratum is divided by a whole number that
    /// divides it, where there is a suitable one, so that `shares` passes sample all of them equally often. With one
    /// share every pass stands for whole strata.
    pub fn new(count: u32, shares: u32, key: &Illuminant, adapted: bool) -> Self {
        let most = (MOST_SHARES / count.max(1)).max(1);
        let passes = shares.max(1);
        let least = passes.div_ceil(most);
        let times = (least..=2 * least).find(|times| passes.is_multiple_of(*times)).unwrap_or(least);
        let shares = passes / times;
        let whole = strata(count, key, adapted);
        let all = if shares == 1 { whole.clone() } else { strata(count * shares, key, adapted) };
        Self { whole, shares: all, turns: turns(shares) }
    }

    /// Divides the visible range as [`strata()`] does. Every pass samples only the middle wavelength of each stratum.
    pub fn of_middles(count: u32, key: &Illuminant, adapted: bool) -> Self {
        let whole = strata(count, key, adapted);
        let middle = |stratum: &Stratum| {
            let nm = stratum.at(0.5);
            Stratum { from_nm: nm, to_nm: nm, ..*stratum }
        };
        Self { shares: whole.iter().map(middle).collect(), whole, turns: vec![0] }
    }

    /// Returns the whole strata, from short wavelengths to long.
    pub fn whole(&self) -> &[Stratum] {
        &self.whole
    }

    /// Returns the shares, one of each stratum, that the sample pass with this number takes. Their responses are
    /// multiplied by the number of shares, so that the mean over passes is that of whole strata.
    pub fn of_pass(&self, number: u32) -> impl Iterator<Item = Stratum> {
        let per = self.turns.len();
        let share = self.turns[number as usize % per] as usize;
        let times = per as f64;
        self.shares.chunks(per).map(move |shares| {
            let own = shares[share];
            Stratum { response: own.response.map(|colour| colour * times), ..own }
        })
    }

    /// Returns the number of the place in the pixel of the sample pass with this number. Places with neighbouring
    /// numbers have neighbouring shares.
    pub fn place(&self, number: u32) -> u32 {
        let per = self.turns();
        (number - number % per).wrapping_add(self.turns[(number % per) as usize])
    }

    /// Returns the number of passes after which each share has been taken once; 1 where every pass takes whole
    /// strata.
    pub fn turns(&self) -> u32 {
        self.turns.len() as u32
    }

    /// Returns whether white light has no visible tint after this many passes.
    pub fn is_white_after(&self, passes: u32) -> bool {
        self.turns.len() == 1 || self.whole.len() as u64 * u64::from(passes) >= ENOUGH_SHARES
    }

    /// Returns the response summed over all strata.
    pub fn response(&self) -> [DVec3; 4] {
        [0, 1, 2, 3].map(|channel| self.whole.iter().map(|stratum| stratum.response[channel]).sum())
    }
}

/// Returns the share of each stratum that each pass takes, where every stratum has this number of shares.
///
/// The binary digits of the share are those of the pass in the opposite order, as in J. G. van der Corput's sequence (1935),
/// so any first few passes are evenly spread over the strata. But the last digit is the parity of all digits of the pass:
/// so even and odd shares, whose places in the pixel are opposite, take turns.
fn turns(shares: u32) -> Vec<u32> {
    let digits = u32::BITS - shares.saturating_sub(1).leading_zeros();
    let share = |pass: u32| {
        let opposite = pass.reverse_bits() >> 1 >> (u32::BITS - 1 - digits);
        (opposite & !1) | (pass.count_ones() & 1)
    };
    (0..1 << digits).map(share).filter(|share| *share < shares).collect()
}

/// Returns the spectra of linear sRGB's red, green and blue at a wavelength in nm.
///
/// All lie within 0..=1 (the least is 0.0026, the greatest 0.989), and their sum is 1. Light with the spectrum D65 times
/// `colour.dot(basis(nm))` looks like `colour`.
pub fn basis(nm: f64) -> DVec3 {
    /// The matrix that mixes the shapes so that their colours are red, green and blue.
    static MIX: LazyLock<DMat3> = LazyLock::new(|| {
        let sight = Sight::new(&Illuminant::D65, false);
        let colours = [0, 1, 2].map(|k| {
            sight.rgb_from_xyz * sight.d65_gain * seen_all(|nm| Illuminant::D65.power(nm) * shapes(nm)[k])
        });
        DMat3::from_cols_array_2d(&colours.map(|colour| colour.to_array())).inverse().transpose()
    });
    *MIX * shapes(nm)
}

/// Divides the visible range into `count` strata (none for 0; 1 to 64 make sense), from short wavelengths to long.
///
/// All strata have the same share. Nine tenths of the share are x̄ + ȳ + z̄ within [`SAMPLED_NM`], and one tenth is
/// width. Where `adapted` is true, [`adaptation`] turns the white of `key` into (1, 1, 1); otherwise the white of D65
/// is (1, 1, 1).
pub fn strata(count: u32, key: &Illuminant, adapted: bool) -> Vec<Stratum> {
    let sight = Sight::new(key, adapted);
    let borders: Vec<f64> = (0..=count).map(|i| border(f64::from(i) / f64::from(count))).collect();
    borders.windows(2).map(|ends| sight.stratum(ends[0], ends[1])).collect()
}

/// The factors and the matrix that turn spectral power into colour.
struct Sight<'a> {
    key: &'a Illuminant,
    /// The factor that gives the key light Y = 1.
    key_gain: f64,
    /// The factor that gives D65 Y = 1.
    d65_gain: f64,
    rgb_from_xyz: DMat3,
}

impl<'a> Sight<'a> {
    fn new(key: &'a Illuminant, adapted: bool) -> Self {
        // The white of D65 is adapted too, because the white of its spectrum and the white that sRGB prints differ in
        // the fifth decimal.
        let white = if adapted { key.white() } else { Illuminant::D65.white() };
        let gain = |light: &Illuminant| seen_all(|nm| light.power(nm)).y.recip();
        let rgb_from_xyz = SRGB_FROM_XYZ * adaptation(white, D65_WHITE);
        Self { key, key_gain: gain(key), d65_gain: gain(&Illuminant::D65), rgb_from_xyz }
    }

    fn stratum(&self, from_nm: f64, to_nm: f64) -> Stratum {
        // The first and the last stratum include the light beyond their ends.
        let from = if from_nm > *SAMPLED_NM.start() { from_nm } else { *OBSERVER_NM.start() };
        let to = if to_nm < *SAMPLED_NM.end() { to_nm } else { *OBSERVER_NM.end() };
        let key = self.key_gain * seen(from, to, |nm| self.key.power(nm));
        let [red, green, blue] =
            [0, 1, 2].map(|k| self.d65_gain * seen(from, to, |nm| Illuminant::D65.power(nm) * basis(nm)[k]));
        Stratum { from_nm, to_nm, response: [key, red, green, blue].map(|xyz| self.rgb_from_xyz * xyz) }
    }
}

/// Returns XYZ of a whole spectrum.
fn seen_all(spectrum: impl Fn(f64) -> f64) -> DVec3 {
    seen(*OBSERVER_NM.start(), *OBSERVER_NM.end(), spectrum)
}

/// Divides 1 into three overlapping parts, for long, middle and short wavelengths, by two logistic steps.
fn shapes(nm: f64) -> DVec3 {
    let rise = |(at, width): (f64, f64)| 1.0 / (1.0 + ((at - nm) / width).exp());
    let (not_blue, red) = (rise(BLUE_STEP), rise(RED_STEP));
    DVec3::new(not_blue * red, not_blue * (1.0 - red), 1.0 - not_blue)
}

/// Returns the wavelength in nm below which this part, 0..=1, of the total share lies.
fn border(part: f64) -> f64 {
    /// The share below every whole nm from the start of [`SAMPLED_NM`], 0 to 1.
    static BELOW: LazyLock<Vec<f64>> = LazyLock::new(shares_below);
    let upper = BELOW.partition_point(|below| *below < part).clamp(1, BELOW.len() - 1);
    let (low, high) = (BELOW[upper - 1], BELOW[upper]);
    SAMPLED_NM.start() + (upper - 1) as f64 + (part - low) / (high - low)
}

/// Returns the share below every whole nm, by trapezoids of 1 nm, which are exact because the observer is linear in
/// between.
fn shares_below() -> Vec<f64> {
    let (start, width) = (*SAMPLED_NM.start(), SAMPLED_NM.end() - SAMPLED_NM.start());
    let sum = |nm: f64| matching(nm).element_sum();
    let mut seen_below = vec![0.0];
    for low in (0..width as u32).map(|step| start + f64::from(step)) {
        seen_below.push(seen_below[seen_below.len() - 1] + 0.5 * (sum(low) + sum(low + 1.0)));
    }
    let all = seen_below[seen_below.len() - 1];
    let share = |(step, seen): (usize, f64)| (1.0 - EVEN) * (seen / all) + EVEN * (step as f64 / width);
    seen_below.into_iter().enumerate().map(share).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIGHTS: [Illuminant; 6] = [
        Illuminant::D65,
        Illuminant::A,
        Illuminant::E,
        Illuminant::Daylight(4000.0),
        Illuminant::Daylight(5000.0),
        Illuminant::Daylight(25000.0),
    ];

    fn sums(strata: &[Stratum]) -> [DVec3; 4] {
        [0, 1, 2, 3].map(|k| strata.iter().map(|stratum| stratum.response[k]).sum())
    }

    fn assert_near(value: DVec3, expected: DVec3, within: f64) {
        assert!(value.abs_diff_eq(expected, within), "{value} is not {expected}");
    }

    #[test]
    fn passes_beyond_the_most_shares_see_all_alike() {
        // 100 passes of 16 strata would be 1,600 shares.
        for (count, passes, shares) in [(16, 100, 50), (16, 64, 64), (64, 64, 16), (3, 1000, 250)] {
            let strata = Strata::new(count, passes, &Illuminant::D65, true);
            let shares_of: Vec<_> =
                (0..passes).map(|pass| strata.of_pass(pass).next().unwrap().from_nm).collect();
            let first = shares_of[0];
            assert_eq!(shares_of.iter().position(|nm| *nm == first), Some(0));
            assert_eq!(
                shares_of.iter().skip(1).position(|nm| *nm == first),
                (passes > shares).then_some(shares as usize - 1)
            );
            let seen =
                (0..passes).flat_map(|pass| strata.of_pass(pass)).map(|s| s.response[0]).sum::<DVec3>();
            let off = seen / f64::from(passes) - strata.response()[0];
            assert!(off.abs().max_element() < 1e-12, "{count}, {passes}: {off}");
        }
    }

    #[test]
    fn strata_tile_the_range_without_gaps() {
        for count in 1..=64 {
            let strata = strata(count, &Illuminant::E, true);
            assert_eq!(strata.len(), count as usize);
            assert_eq!((strata[0].from_nm, strata[strata.len() - 1].to_nm), (390.0, 720.0));
            assert!(strata.iter().all(|stratum| stratum.from_nm < stratum.to_nm));
            assert!(strata.windows(2).all(|pair| pair[0].to_nm == pair[1].from_nm));
        }
        assert!(strata(0, &Illuminant::E, true).is_empty());
    }

    #[test]
    fn the_shares_of_all_passes_are_the_strata() {
        for (count, shares) in [(1, 5), (3, 1), (3, 32), (8, 100), (64, 64)] {
            let strata = Strata::new(count, shares, &Illuminant::A, true);
            let passes = shares.min(MOST_SHARES / count);
            let mut taken: Vec<Vec<Stratum>> = vec![vec![]; count as usize];
            for number in 0..passes {
                strata.of_pass(number).zip(&mut taken).for_each(|(share, taken)| taken.push(share));
            }
            assert_eq!(strata.of_pass(passes).collect::<Vec<_>>(), strata.of_pass(0).collect::<Vec<_>>());
            for (whole, mut taken) in strata.whole().iter().zip(taken) {
                taken.sort_by(|a, b| a.from_nm.total_cmp(&b.from_nm));
                assert!((taken[0].from_nm - whole.from_nm).abs() < 1e-9);
                assert!(taken.windows(2).all(|pair| pair[0].to_nm == pair[1].from_nm));
                for channel in 0..4 {
                    let sum: DVec3 = taken.iter().map(|share| share.response[channel]).sum();
                    assert_near(sum / f64::from(passes), whole.response[channel], 1e-9);
                }
            }
            assert_near(strata.response()[0], DVec3::ONE, 1e-9);
        }
    }

    #[test]
    fn the_first_few_passes_are_nearly_white() {
        let off = |count, shares, passes| {
            let strata = Strata::new(count, shares, &Illuminant::D65, true);
            let light = (0..passes).flat_map(|number| strata.of_pass(number).collect::<Vec<_>>());
            let white = light.map(|share| share.response[0]).sum::<DVec3>() / f64::from(passes);
            (strata.is_white_after(passes), (white - DVec3::ONE).abs().max_element())
        };
        for (count, shares) in [(3, 64), (3, 4), (8, 64), (16, 64), (16, 4), (32, 8), (64, 16)] {
            for passes in [1, 2, 4, 8, 16, 32].into_iter().filter(|passes| *passes <= shares) {
                let (is_white, off) = off(count, shares, passes);
                assert!(!is_white || off < 0.01, "{count} strata, {passes} of {shares} passes: {off}");
            }
        }
        assert!(off(3, 64, 1).1 > 0.3, "single shares are coloured");
        assert!(off(3, 1, 1).0, "whole strata are white together");
    }

    #[test]
    fn strata_have_equal_shares() {
        let all = matching_between(390.0, 720.0);
        for stratum in strata(16, &Illuminant::D65, true) {
            let seen = matching_between(stratum.from_nm, stratum.to_nm) / all;
            let share = 0.9 * seen + 0.1 * (stratum.to_nm - stratum.from_nm) / 330.0;
            assert!((share - 1.0 / 16.0).abs() < 1e-4, "{share}");
        }
        let outside = matching_between(380.0, 390.0) + matching_between(720.0, 780.0);
        assert!(outside / matching_between(380.0, 780.0) < 8.5e-4);
    }

    fn matching_between(from_nm: f64, to_nm: f64) -> f64 {
        seen(from_nm, to_nm, |_| 1.0).element_sum()
    }

    #[test]
    fn a_part_of_a_stratum_is_a_wavelength() {
        let stratum = strata(8, &Illuminant::D65, true)[3];
        assert_eq!((stratum.at(0.0), stratum.at(1.0)), (stratum.from_nm, stratum.to_nm));
        assert_eq!(stratum.at(0.5), 0.5 * (stratum.from_nm + stratum.to_nm));
    }

    #[test]
    fn in_an_adapted_eye_every_key_is_white() {
        for count in 1..=64 {
            for light in &LIGHTS {
                assert_near(sums(&strata(count, light, true))[0], DVec3::ONE, 1e-9);
            }
        }
    }

    #[test]
    fn under_d65_the_basis_is_red_green_and_blue() {
        for count in 1..=64 {
            for adapted in [false, true] {
                let [key, colours @ ..] = sums(&strata(count, &Illuminant::D65, adapted));
                assert_near(key, DVec3::ONE, 1e-9);
                assert!(
                    DMat3::from_cols_array_2d(&colours.map(Into::into)).abs_diff_eq(DMat3::IDENTITY, 1e-9)
                );
            }
        }
    }

    #[test]
    fn the_number_of_strata_changes_no_sum() {
        for light in &LIGHTS {
            for adapted in [false, true] {
                let whole = sums(&strata(1, light, adapted));
                for count in [2, 7, 64] {
                    let parts = sums(&strata(count, light, adapted));
                    (0..4).for_each(|k| assert_near(parts[k], whole[k], 1e-9));
                }
            }
        }
    }

    #[test]
    fn in_an_eye_not_adapted_a_lamp_is_warm() {
        let colour = sums(&strata(16, &Illuminant::A, false))[0];
        assert!(colour.x > 1.0 && colour.x > colour.y && colour.y > colour.z && colour.z > 0.0, "{colour}");
        assert_near(colour, SRGB_FROM_XYZ * Illuminant::A.white(), 3e-4);
    }

    #[test]
    fn the_basis_is_positive_and_adds_up_to_1() {
        let all: Vec<DVec3> = (3600..=8300).map(|nm| basis(f64::from(nm) / 10.0)).collect();
        assert!(all.iter().all(|basis| (basis.element_sum() - 1.0).abs() < 1e-12));
        let least = all.iter().map(|basis| basis.min_element()).fold(f64::INFINITY, f64::min);
        let greatest = all.iter().map(|basis| basis.max_element()).fold(0.0, f64::max);
        assert!((least - 0.0026).abs() < 5e-5 && (greatest - 0.989).abs() < 5e-4, "{least} to {greatest}");
    }

    #[test]
    fn any_colour_comes_back_from_its_spectrum() {
        let to_rgb = SRGB_FROM_XYZ * adaptation(Illuminant::D65.white(), D65_WHITE);
        let white = seen_all(|nm| Illuminant::D65.power(nm)).y;
        for colour in [DVec3::new(0.2, 0.5, 0.9), DVec3::new(1.0, 0.0, 0.3), DVec3::new(-0.1, 3.0, 0.0)] {
            let xyz = seen_all(|nm| Illuminant::D65.power(nm) * colour.dot(basis(nm)));
            assert_near(to_rgb * xyz / white, colour, 1e-9);
        }
    }
}
