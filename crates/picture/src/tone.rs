//! Tone curves, which compress light of any brightness to the range of a screen.

use super::linear::luminance;
use brillianteer_scene::Tone;

/// The light at which compression begins (Khronos PBR Neutral).
const COMPRESSED_FROM: f32 = 0.8;
/// The rate at which bright colours lose their saturation (Khronos PBR Neutral).
const DESATURATION: f32 = 0.15;

/// Coefficients a to e of Narkowicz's fit: (a x² + b x) / (c x² + d x + e).
const FILM: [f32; 5] = [2.51, 0.03, 2.43, 0.59, 0.14];

/// The light at which the fit reaches 1: the greater root of (a − c) x² + (b − d) x − e.
const FILM_IS_WHITE: f32 = 7.241_62;

/// Returns the screen's values, each channel from 0 to 1, for linear light that is not below 0, by a tone curve. `white` is
/// the light that [`Tone::Filmic`] shows as white; the other curves do not use it.
pub fn toned(tone: Tone, light: [f32; 3], white: f32) -> [f32; 3] {
    match tone {
        Tone::Linear => light.map(|c| c.min(1.0)),
        Tone::Neutral => neutral(light),
        Tone::Filmic => light.map(|c| film(c * (FILM_IS_WHITE / white))),
    }
}

/// Applies the Khronos PBR Neutral tone mapper (Khronos Group, 3D Commerce, 2024) without its toe. The toe takes off
/// the 4 % that common surfaces reflect, but a diamond reflects 17 %, and the contrast of a gem depends on its dark
/// light.
fn neutral(light: [f32; 3]) -> [f32; 3] {
    let peak = light[0].max(light[1]).max(light[2]);
    if peak < COMPRESSED_FROM {
        return light;
    }
    let room = 1.0 - COMPRESSED_FROM;
    let shown = 1.0 - room * room / (peak + room - COMPRESSED_FROM);
    let white = 1.0 - 1.0 / (DESATURATION * (peak - shown) + 1.0);
    light.map(|c| {
        let scaled = c * (shown / peak);
        (scaled + (shown - scaled) * white).clamp(0.0, 1.0)
    })
}

/// Applies the curve of K. Narkowicz, "ACES Filmic Tone Mapping Curve" (2016).
fn film(x: f32) -> f32 {
    let x = x.min(FILM_IS_WHITE);
    let [a, b, c, d, e] = FILM;
    (x * (a * x + b) / (x * (c * x + d) + e)).min(1.0)
}

/// Returns the nearest colour of the same luminance and hue that sRGB's primaries can mix: grey is added just until no
/// channel is below 0.
///
/// Spectral light lies outside the primaries' triangle until it has been summed, so pass the sum.
pub fn reachable(light: [f32; 3]) -> [f32; 3] {
    let least = light[0].min(light[1]).min(light[2]);
    if least >= 0.0 {
        return light;
    }
    let y = luminance(light);
    if y.is_nan() || y <= 0.0 {
        return [0.0; 3];
    }
    let part = y / (y - least);
    light.map(|c| (y + (c - y) * part).max(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    const TONES: [Tone; 3] = [Tone::Linear, Tone::Neutral, Tone::Filmic];

    #[test]
    fn every_curve_begins_at_black_rises_and_keeps_grey_grey() {
        for tone in TONES {
            assert_eq!(toned(tone, [0.0; 3], 12.0), [0.0; 3]);
            let mut before = 0.0;
            for k in 0..=4000 {
                let light = 1e-4 * (f32::from(k as u16) * 0.005).exp();
                let [r, g, b] = toned(tone, [light; 3], 12.0);
                assert!(r == g && g == b, "{tone:?} colours grey {light}");
                // The tolerance is two roundings, as the curves nearly touch 1 for a long stretch.
                assert!(r >= before - 2.5e-7 && r <= 1.0, "{tone:?} falls at {light}: {before} to {r}");
                before = r;
            }
            assert!(before > 0.99, "{tone:?} ends at {before}");
        }
    }

    #[test]
    fn neutral_leaves_what_a_screen_can_show_and_the_hue() {
        assert_eq!(toned(Tone::Neutral, [0.79, 0.3, 0.0], 1.0), [0.79, 0.3, 0.0]);
        let [r, g, b] = toned(Tone::Neutral, [4.0, 2.0, 1.0], 1.0);
        // The middle channel keeps its relative place between the two others.
        assert!(r < 1.0 && ((g - b) / (r - b) - 1.0 / 3.0).abs() < 1e-5);
        let just = toned(Tone::Neutral, [COMPRESSED_FROM; 3], 1.0)[0];
        assert!((just - COMPRESSED_FROM).abs() < 1e-6, "a step at {just}");
    }

    #[test]
    fn film_is_white_at_its_white_point() {
        for white in [1.0, 4.0, 12.0] {
            assert!((toned(Tone::Filmic, [white; 3], white)[0] - 1.0).abs() < 1e-5);
            assert!(toned(Tone::Filmic, [white * 0.9; 3], white)[0] < 0.999);
        }
    }

    #[test]
    fn colours_out_of_reach_keep_their_luminance_and_lose_what_is_negative() {
        for light in [[-0.3, 0.8, 0.1], [1.4, -0.2, -0.1], [0.2, -0.05, 3.0], [5.0, -1.0, 0.0]] {
            let shown = reachable(light);
            assert!(shown.iter().all(|&c| c >= 0.0), "{shown:?}");
            assert!(shown.iter().any(|&c| c < 1e-6), "{shown:?} is greyer than it need be");
            assert!((luminance(shown) - luminance(light)).abs() < 1e-6 * luminance(light).max(1.0));
        }
        assert_eq!(reachable([0.0, 0.5, 9.0]), [0.0, 0.5, 9.0]);
        assert_eq!(reachable([-1.0, 0.1, 0.0]), [0.0; 3]);
    }
}
