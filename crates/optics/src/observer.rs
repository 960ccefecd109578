//! The CIE 1931 2 degree observer, which is the eye of colorimetry; sRGB's primaries; and adaptation to a white.
//!
//! Sources: CIE 15:2004, table T.4 (5 nm); IEC 61966-2-1:1999 for primaries and white; K. M. Lam, *Metamerism and Colour
//! Constancy* (1985) for the matrix of Bradford. A vector holds X, Y, Z or linear red, green, blue, in that order.

use glam::{DMat3, DVec3};
use std::ops::RangeInclusive;

/// The range of wavelengths in nm that the observer's table covers; outside it the observer sees nothing.
pub const OBSERVER_NM: RangeInclusive<f64> = 380.0..=780.0;

/// The step between two rows of the observer's table, in nm.
const STEP_NM: f64 = 5.0;

/// The colour-matching function x̄.
const X: [f64; 81] = [
    0.001368, 0.002236, 0.004243, 0.00765, 0.01431, 0.02319, 0.04351, 0.07763, 0.13438, 0.21477, 0.2839,
    0.3285, 0.34828, 0.34806, 0.3362, 0.3187, 0.2908, 0.2511, 0.19536, 0.1421, 0.09564, 0.05795, 0.03201,
    0.0147, 0.0049, 0.0024, 0.0093, 0.0291, 0.06327, 0.1096, 0.1655, 0.22575, 0.2904, 0.3597, 0.43345,
    0.51205, 0.5945, 0.6784, 0.7621, 0.8425, 0.9163, 0.9786, 1.0263, 1.0567, 1.0622, 1.0456, 1.0026, 0.9384,
    0.85445, 0.7514, 0.6424, 0.5419, 0.4479, 0.3608, 0.2835, 0.2187, 0.1649, 0.1212, 0.0874, 0.0636, 0.04677,
    0.0329, 0.0227, 0.01584, 0.011359, 0.008111, 0.00579, 0.004106, 0.002899, 0.002049, 0.00144, 0.001,
    0.00069, 0.000476, 0.000332, 0.000235, 0.000166, 0.000117, 0.000083, 0.000059, 0.000042,
];

/// The colour-matching function ȳ.
const Y: [f64; 81] = [
    0.000039, 0.000064, 0.00012, 0.000217, 0.000396, 0.00064, 0.00121, 0.00218, 0.004, 0.0073, 0.0116,
    0.01684, 0.023, 0.0298, 0.038, 0.048, 0.06, 0.0739, 0.09098, 0.1126, 0.13902, 0.1693, 0.20802, 0.2586,
    0.323, 0.4073, 0.503, 0.6082, 0.71, 0.7932, 0.862, 0.91485, 0.954, 0.9803, 0.99495, 1.0, 0.995, 0.9786,
    0.952, 0.9154, 0.87, 0.8163, 0.757, 0.6949, 0.631, 0.5668, 0.503, 0.4412, 0.381, 0.321, 0.265, 0.217,
    0.175, 0.1382, 0.107, 0.0816, 0.061, 0.04458, 0.032, 0.0232, 0.017, 0.01192, 0.00821, 0.005723, 0.004102,
    0.002929, 0.002091, 0.001484, 0.001047, 0.00074, 0.00052, 0.000361, 0.000249, 0.000172, 0.00012,
    0.000085, 0.00006, 0.000042, 0.00003, 0.000021, 0.000015,
];

/// The colour-matching function z̄.
const Z: [f64; 81] = [
    0.00645, 0.01055, 0.02005, 0.03621, 0.06785, 0.1102, 0.2074, 0.3713, 0.6456, 1.03905, 1.3856, 1.62296,
    1.74706, 1.7826, 1.77211, 1.7441, 1.6692, 1.5281, 1.28764, 1.0419, 0.81295, 0.6162, 0.46518, 0.3533,
    0.272, 0.2123, 0.1582, 0.1117, 0.07825, 0.05725, 0.04216, 0.02984, 0.0203, 0.0134, 0.00875, 0.00575,
    0.0039, 0.00275, 0.0021, 0.0018, 0.00165, 0.0014, 0.0011, 0.001, 0.0008, 0.0006, 0.00034, 0.00024,
    0.00019, 0.0001, 0.00005, 0.00003, 0.00002, 0.00001, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
    0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
];

/// The XYZ of sRGB's white, with Y = 1: the chromaticity (.3127, .3290) of IEC 61966-2-1.
pub const D65_WHITE: DVec3 = DVec3::new(0.3127 / 0.3290, 1.0, 0.3583 / 0.3290);

/// The matrix from XYZ to linear sRGB, which takes [`D65_WHITE`] to (1, 1, 1).
///
/// It follows from the primaries (.64, .33), (.30, .60), (.15, .06). IEC 61966-2-1 prints it rounded to 4 decimals.
pub const SRGB_FROM_XYZ: DMat3 = DMat3::from_cols_array(&[
    3.2409699419045226,
    -0.9692436362808796,
    0.05563007969699363,
    -1.537383177570094,
    1.8759675015077204,
    -0.2039769588889765,
    -0.49861076029300344,
    0.0415550574071756,
    1.0569715142428784,
]);

/// The matrix from XYZ to Bradford's sharpened cone responses.
const BRADFORD: DMat3 =
    DMat3::from_cols_array(&[0.8951, -0.7502, 0.0389, 0.2664, 1.7135, -0.0685, -0.1614, 0.0367, 1.0296]);

/// Returns the colour-matching functions x̄, ȳ, z̄ at a wavelength in nm, >= 0, with ȳ at most 1.
///
/// They are interpolated linearly between the table's rows, and 0 beyond [`OBSERVER_NM`].
pub fn matching(nm: f64) -> DVec3 {
    DVec3::from_array([&X[..], &Y, &Z].map(|table| sampled(table, *OBSERVER_NM.start(), STEP_NM, nm)))
}

/// Returns XYZ of a spectrum between two wavelengths: the integral of `spectrum(nm)` times [`matching`] over nm.
///
/// The integral is computed by Gauss's rule of three points, from one whole nm to the next and to the borders. This
/// is exact for a spectrum of straight lines with corners at whole nm. The result is additive as well: the parts of a
/// range add up to the range.
pub fn seen(from_nm: f64, to_nm: f64, spectrum: impl Fn(f64) -> f64) -> DVec3 {
    let (mut low, end) = (from_nm.max(*OBSERVER_NM.start()), to_nm.min(*OBSERVER_NM.end()));
    let at = |nm: f64| spectrum(nm) * matching(nm);
    let mut sum = DVec3::ZERO;
    while low < end {
        let high = (low.floor() + 1.0).min(end);
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
        let aside = 0.6_f64.sqrt() * half;
        sum += half / 9.0 * (5.0 * at(middle - aside) + 8.0 * at(middle) + 5.0 * at(middle + aside));
        low = high;
    }
    sum
}

/// Returns the matrix that adapts XYZ to a change of the eye's white from `from_white` to `to_white`.
///
/// The matrix takes `from_white` to `to_white`, and scales Bradford's cone responses in between (J. von Kries, 1902).
/// The whites are in XYZ, with all components > 0 and Y = 1.
pub fn adaptation(from_white: DVec3, to_white: DVec3) -> DMat3 {
    let gains = (BRADFORD * to_white) / (BRADFORD * from_white);
    BRADFORD.inverse() * DMat3::from_diagonal(gains) * BRADFORD
}

/// Reads a table with even steps at a wavelength: linear between samples, 0 beyond the ends.
pub(super) fn sampled(table: &[f64], start_nm: f64, step_nm: f64, nm: f64) -> f64 {
    let place = (nm - start_nm) / step_nm;
    let last = table.len() - 1;
    if !(0.0..=last as f64).contains(&place) {
        return 0.0;
    }
    let below = (place as usize).min(last - 1);
    let part = place - below as f64;
    table[below] * (1.0 - part) + table[below + 1] * part
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the fit by several lobes of C. Wyman, P.-P. Sloan and P. Shirley, JCGT 2(2), 1 (2013).
    fn fitted(nm: f64) -> DVec3 {
        let lobe = |mean: f64, below: f64, above: f64| {
            let sigma = if nm < mean { below } else { above };
            (-0.5 * ((nm - mean) / sigma).powi(2)).exp()
        };
        DVec3::new(
            0.362 * lobe(442.0, 16.0, 26.7) + 1.056 * lobe(599.8, 37.9, 31.0)
                - 0.065 * lobe(501.1, 20.4, 26.2),
            0.821 * lobe(568.8, 46.9, 40.5) + 0.286 * lobe(530.9, 16.3, 31.1),
            1.217 * lobe(437.0, 11.8, 36.0) + 0.681 * lobe(459.0, 26.0, 13.8),
        )
    }

    #[test]
    fn the_table_adds_up_to_the_sums_that_the_cie_prints() {
        let sums = [&X[..], &Y, &Z].map(|table| table.iter().sum::<f64>());
        for (sum, printed) in sums.into_iter().zip([21.371524, 21.371327, 21.371540]) {
            assert!((sum - printed).abs() < 1e-5, "{sum} is not {printed}");
        }
    }

    #[test]
    fn the_table_has_the_printed_values_and_straight_lines_between() {
        for (nm, printed) in [
            (380.0, [0.001368, 0.000039, 0.00645]),
            (450.0, [0.3362, 0.038, 1.77211]),
            (500.0, [0.0049, 0.323, 0.272]),
            (555.0, [0.51205, 1.0, 0.00575]),
            (557.5, [0.553275, 0.9975, 0.004825]),
            (600.0, [1.0622, 0.631, 0.0008]),
            (650.0, [0.2835, 0.107, 0.0]),
            (700.0, [0.011359, 0.004102, 0.0]),
            (780.0, [0.000042, 0.000015, 0.0]),
            (379.9, [0.0; 3]),
            (780.1, [0.0; 3]),
            (f64::NAN, [0.0; 3]),
        ] {
            assert!(
                (matching(nm) - DVec3::from_array(printed)).length() < 1e-9,
                "at {nm} nm: {}",
                matching(nm)
            );
        }
    }

    #[test]
    fn the_table_is_near_the_published_fit_at_every_wavelength() {
        for nm in (360..=830).map(f64::from) {
            let off = (matching(nm) - fitted(nm)).abs().max_element();
            assert!(off <= 0.05, "off by {off} at {nm} nm");
        }
    }

    #[test]
    fn integrals_add_up_wherever_they_are_cut() {
        let spectrum = |nm: f64| 1.0 + (nm / 100.0).sin();
        let whole = seen(380.0, 780.0, |nm| nm);
        let [from, to] = [400.3, 611.7].map(|cut| seen(0.0, cut, |nm| nm) + seen(cut, 1e3, |nm| nm));
        assert!((from - whole).length() < 1e-9 && (to - whole).length() < 1e-9);
        let cut = seen(380.0, 512.34, spectrum) + seen(512.34, 780.0, spectrum);
        assert!((cut - seen(380.0, 780.0, spectrum)).length() < 1e-9);
        assert_eq!(seen(600.0, 500.0, spectrum), DVec3::ZERO);
        // Trapezoids are exact over straight lines: 5 nm times the sums, less half of either end.
        assert!((seen(380.0, 780.0, |_| 1.0).y - 5.0 * (21.371327 - 0.000027)).abs() < 1e-9);
    }

    #[test]
    fn the_matrix_follows_from_the_primaries_and_the_white() {
        let xyz = |x: f64, y: f64| DVec3::new(x / y, 1.0, (1.0 - x - y) / y);
        let primaries = DMat3::from_cols(xyz(0.64, 0.33), xyz(0.30, 0.60), xyz(0.15, 0.06));
        let from_rgb = primaries * DMat3::from_diagonal(primaries.inverse() * D65_WHITE);
        assert!(SRGB_FROM_XYZ.abs_diff_eq(from_rgb.inverse(), 1e-12));
        assert!((SRGB_FROM_XYZ * D65_WHITE).abs_diff_eq(DVec3::ONE, 1e-12));
        // IEC 61966-2-1 prints the matrix to 4 decimals.
        let printed = [3.2406, -0.9689, 0.0557, -1.5372, 1.8758, -0.2040, -0.4986, 0.0415, 1.0570];
        assert!(SRGB_FROM_XYZ.abs_diff_eq(DMat3::from_cols_array(&printed), 5e-4));
    }

    #[test]
    fn adaptation_carries_white_to_white_and_back() {
        let a = DVec3::new(1.0985, 1.0, 0.35585);
        let there = adaptation(a, D65_WHITE);
        assert!((there * a).abs_diff_eq(D65_WHITE, 1e-12));
        assert!((adaptation(D65_WHITE, a) * there).abs_diff_eq(DMat3::IDENTITY, 1e-12));
        assert!(adaptation(a, a).abs_diff_eq(DMat3::IDENTITY, 1e-12));
        // B. Lindbloom prints the matrix from D65 to D50.
        let d50 = DVec3::new(0.96422, 1.0, 0.82521);
        let printed = [
            1.0478112, 0.0295424, -0.0092345, 0.0228866, 0.9904844, 0.0150436, -0.0501270, -0.0170491,
            0.7521316,
        ];
        let lindbloom = DMat3::from_cols_array(&printed);
        assert!(adaptation(DVec3::new(0.95047, 1.0, 1.08883), d50).abs_diff_eq(lindbloom, 1e-6));
    }
}
