//! Develops a picture in linear light into one that screens can show.

use super::linear::LightRows;
use super::tone::{reachable, toned};
use super::{Bloom, Linear};
use brillianteer_optics::SrgbEncoder;
use brillianteer_scene::{Background, Tone};
use rayon::prelude::*;
use std::convert::Infallible;

/// The settings by which a picture is developed, in the order of the steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Develop {
    /// Exposure in stops, −40 to 40: light is multiplied by 2 to this power.
    pub exposure: f64,
    /// The glare that spreads the brightest light, after exposure.
    pub bloom: Option<Bloom>,
    /// The curve that brings light below 1.
    pub tone: Tone,
    /// The exposed light that [`Tone::Filmic`] shows as white, 0.1 to 1000.
    pub white: f64,
    /// The background behind the stones. It keeps its colour: neither exposure nor tone changes it.
    pub background: Background,
}

impl Default for Develop {
    fn default() -> Self {
        Self {
            exposure: 0.0,
            bloom: Some(Bloom::default()),
            tone: Tone::Neutral,
            white: 12.0,
            background: Background::Transparent,
        }
    }
}

/// The limit to which light is clamped, so that sums of it stay finite.
const BRIGHTEST: f32 = 1e12;

/// The most stops of exposure either way; beyond them there is nothing but black or white.
const MOST_STOPS: f64 = 40.0;

/// The number of pixels that are developed at once.
const AT_ONCE: u32 = 1 << 20;

/// Develops a picture to eight-bit sRGB: red, green, blue and cover, not premultiplied, row by row. Numbers out of their
/// range count as the nearer end of it, and light that is NaN as dark.
///
/// Light between two codes is rounded by a fixed pattern, so that the mean over neighbours is the light; the light of a code
/// itself, such as that of a plain background, is never changed.
///
/// Without a background, glare beside the stones has light but no cover, which eight-bit pictures cannot hold. There,
/// the cover is raised to the brightest encoded channel, so that over black the picture looks as it would have.
pub fn develop(mut picture: &Linear, manner: &Develop) -> Vec<u8> {
    let mut out = Vec::with_capacity(4 * picture.width as usize * picture.height as usize);
    let done = develop_rows(&mut picture, manner, |_, rgba| {
        out.append(rgba);
        Ok::<_, Infallible>(())
    });
    match done {
        Ok(()) => out,
        Err(never) => match never {},
    }
}

/// Develops a picture as [`develop`] does, some rows at a time, and calls `each` with them from top to bottom: with the
/// number of the first one, and their pixels.
///
/// # Errors
/// The errors of `each`, and those of reading the light.
pub fn develop_rows<L: LightRows, E: From<L::Error>>(
    light: &mut L,
    manner: &Develop,
    mut each: impl FnMut(u32, &mut Vec<u8>) -> Result<(), E>,
) -> Result<(), E> {
    let [width, height] = light.size();
    if width == 0 {
        return Ok(());
    }
    let gain = manner.gain();
    let glare = manner.bloom.map_or(Ok(None), |bloom| bloom.glare(light, |pixel| exposed(pixel, gain)))?;
    let encoder = SrgbEncoder::new();
    let step = (AT_ONCE / width).max(1);
    for first in (0..height).step_by(step as usize) {
        let pixels = light.rows(first..(first + step).min(height))?;
        let mut out = vec![0; 4 * pixels.len()];
        let rows = out.par_chunks_mut(4 * width as usize).zip(pixels.par_chunks(width as usize));
        rows.zip(first..height).for_each(|((codes, pixels), y)| {
            let mut row: Vec<_> = pixels.iter().map(|pixel| exposed(pixel, gain)).collect();
            if let Some(glare) = &glare {
                glare.add(y as usize, &mut row);
            }
            let behind = manner.background.row(y, height);
            for (x, (code, &pixel)) in codes.as_chunks_mut().0.iter_mut().zip(&row).enumerate() {
                *code = encoded(shown(pixel, manner), behind, dither(x as u32, y), &encoder);
            }
        });
        each(first, &mut out)?;
    }
    Ok(())
}

impl Develop {
    /// Returns the factor by which light is exposed.
    pub(super) fn gain(&self) -> f32 {
        self.exposure.clamp(-MOST_STOPS, MOST_STOPS).exp2() as f32
    }
}

/// Returns a pixel with its light exposed and its numbers within their ranges.
pub(super) fn exposed(&[r, g, b, cover]: &[f32; 4], gain: f32) -> [f32; 4] {
    let sane = |v: f32, least: f32, most: f32| if v.is_nan() { 0.0 } else { v.clamp(least, most) };
    let [r, g, b] = [r, g, b].map(|c| sane(c * gain, -BRIGHTEST, BRIGHTEST));
    [r, g, b, sane(cover, 0.0, 1.0)]
}

/// Returns a pixel as a screen can show it, by the tone curve.
pub(super) fn shown([r, g, b, cover]: [f32; 4], manner: &Develop) -> [f32; 4] {
    let white = 1000_f64.min(manner.white).max(0.1) as f32;
    let [r, g, b] = toned(manner.tone, reachable([r, g, b]), white);
    [r, g, b, cover]
}

/// Returns where between two codes the light of a pixel is rounded up, from 0.02 to 0.98, so that slow gradients show no
/// bands. Neighbours differ as much as possible: the pattern is J. Jimenez's interleaved gradient noise (*Next Generation
/// Post Processing in Call of Duty: Advanced Warfare*, SIGGRAPH courses 2014).
fn dither(x: u32, y: u32) -> f64 {
    let place = (0.067_110_56 * f64::from(x) + 0.005_837_15 * f64::from(y)).fract();
    0.02 + 0.96 * (52.982_918_9 * place).fract()
}

/// Encodes a pixel over the colour behind it, if there is one. `threshold` is that of the pixel's place.
fn encoded(pixel: [f32; 4], behind: Option<[f32; 3]>, threshold: f64, encoder: &SrgbEncoder) -> [u8; 4] {
    let opaque = |[r, g, b, _]: [f32; 4]| [r, g, b].map(|c| encoder.encode_dithered(f64::from(c), threshold));
    if let Some(colour) = behind {
        let [r, g, b] = opaque(laid_over(pixel, colour));
        return [r, g, b, 255];
    }
    let codes = opaque(pixel);
    let cover = ((pixel[3] * 255.0).round() as u8).max(codes[0]).max(codes[1]).max(codes[2]);
    let straight =
        |code: u8| ((u32::from(code) * 255 + u32::from(cover) / 2) / u32::from(cover).max(1)) as u8;
    let [r, g, b] = codes.map(straight);
    [r, g, b, cover]
}

/// Lays a premultiplied pixel over an opaque colour.
fn laid_over([r, g, b, cover]: [f32; 4], colour: [f32; 3]) -> [f32; 4] {
    let bare = 1.0 - cover;
    [r + bare * colour[0], g + bare * colour[1], b + bare * colour[2], 1.0]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cover_hides_what_lies_behind() {
        assert_eq!(laid_over([0.3, 0.2, 0.1, 1.0], [1.0; 3]), [0.3, 0.2, 0.1, 1.0]);
        assert_eq!(laid_over([0.0; 4], [0.5; 3]), [0.5, 0.5, 0.5, 1.0]);
    }
    use brillianteer_optics::linear_from_encoded;

    fn one(pixel: [f32; 4], manner: &Develop) -> [u8; 4] {
        let out = develop(&Linear { width: 1, height: 1, pixels: vec![pixel] }, manner);
        [out[0], out[1], out[2], out[3]]
    }

    #[test]
    fn grey_stays_grey_and_a_stop_doubles_it() {
        let manner = Develop { bloom: None, tone: Tone::Linear, ..Develop::default() };
        let stop = Develop { exposure: 1.0, ..manner };
        for k in 0..=50 {
            let light = f32::from(k as u8) / 100.0;
            let [r, g, b, a] = one([light, light, light, 1.0], &stop);
            assert!(r == g && g == b && a == 255);
            assert_eq!(one([2.0 * light, 2.0 * light, 2.0 * light, 1.0], &manner), [r, g, b, a]);
        }
    }

    #[test]
    fn a_background_shows_in_its_own_colour() {
        let background = "#336699".parse().unwrap();
        let manner = Develop { exposure: 3.0, tone: Tone::Filmic, background, ..Develop::default() };
        assert_eq!(one([0.0; 4], &manner), [0x33, 0x66, 0x99, 255]);
        assert_eq!(one([0.0, 0.0, 0.0, 1.0], &manner), [0, 0, 0, 255]);
    }

    #[test]
    fn over_black_a_transparent_picture_looks_like_an_opaque_one() {
        let clear = Develop { bloom: None, ..Develop::default() };
        let black = Develop { background: Background::Plain([0.0; 3]), ..clear };
        for pixel in
            [[0.2, 0.1, 0.0, 0.0], [0.5, 0.5, 0.5, 0.5], [0.01, 0.0, 0.03, 0.1], [2.0, 0.1, 0.3, 1.0]]
        {
            let ([r, g, b, a], opaque) = (one(pixel, &clear), one(pixel, &black));
            for (code, expected) in [r, g, b].into_iter().zip(opaque) {
                let seen = f64::from(code) * f64::from(a) / 255.0;
                assert!((seen - f64::from(expected)).abs() <= 0.5, "{pixel:?}: {seen}, not {expected}");
            }
        }
        assert_eq!(one([0.0; 4], &clear), [0; 4]);
    }

    #[test]
    fn a_slow_gradient_keeps_its_mean_and_the_light_of_a_code_keeps_its_code() {
        let manner = Develop { bloom: None, tone: Tone::Linear, ..Develop::default() };
        let code_light = |code: u8| linear_from_encoded(f64::from(code) / 255.0) as f32;
        let plane = |light: f32| {
            let picture = Linear { width: 64, height: 64, pixels: vec![[light, light, light, 1.0]; 64 * 64] };
            develop(&picture, &manner)
        };
        for code in 0..=255 {
            assert!(plane(code_light(code)).chunks(4).all(|pixel| pixel[0] == code), "{code}");
        }
        for part in [0.1, 0.25, 0.4, 0.5, 0.7, 0.9] {
            for code in [3_u8, 20, 90, 200] {
                let [low, high] = [code, code + 1].map(code_light);
                let codes = plane(low + part * (high - low));
                let light =
                    codes.chunks(4).map(|pixel| f64::from(code_light(pixel[0]))).sum::<f64>() / 4096.0;
                let found = (light - f64::from(low)) / f64::from(high - low);
                assert!((found - f64::from(part)).abs() < 0.03, "{code}, {part}: {found}");
                // No square of four by four pixels has one code alone in the middle between two.
                let row = |k: usize| &codes[4 * 64 * k..4 * 64 * k + 16];
                let of_square: Vec<_> = (0..4).flat_map(|k| row(k).chunks(4).map(|pixel| pixel[0])).collect();
                let is_mixed = of_square.contains(&code) && of_square.contains(&(code + 1));
                assert!(is_mixed || (part - 0.5).abs() > 0.3, "{code}, {part}");
            }
        }
    }

    #[test]
    fn no_numbers_break_it() {
        let odd = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1e38, 1e38, f32::MIN_POSITIVE];
        let pixels: Vec<_> =
            (0..36).map(|k| [odd[k % 6], odd[k / 6], odd[(k + 3) % 6], odd[k % 5]]).collect();
        let picture = Linear { width: 7, height: 9, pixels };
        for v in [0.0, 1.0, -1.0, 1e300, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let bloom = Bloom { strength: v, radius: v, streaks: 5, streak_length: v, threshold: v };
            for tone in [Tone::Linear, Tone::Neutral, Tone::Filmic] {
                let manner =
                    Develop { exposure: v, white: v, tone, bloom: Some(bloom), ..Develop::default() };
                assert_eq!(develop(&picture, &manner).len(), 7 * 9 * 4);
            }
        }
        for (width, height) in [(0, 0), (0, 5), (5, 0)] {
            assert!(develop(&Linear::new(width, height), &Develop::default()).is_empty());
        }
    }
}
