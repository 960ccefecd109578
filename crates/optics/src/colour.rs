//! The sRGB encoding. Linear light is encoded once, at the end, for a file or a screen; the inverse decodes it again.
//!
//! Source: IEC 61966-2-1:1999, §5.2 (its two-piece curve, with its printed constants).

use glam::DVec3;

/// A colour as linear light in the sRGB primaries, with white at (1, 1, 1). Components may exceed 1 until they are
/// encoded.
pub type LinearRgb = DVec3;

/// The shares of linear sRGB's red, green and blue in luminance (IEC 61966-2-1:1999).
pub const LUMINANCE: [f32; 3] = [0.2126, 0.7152, 0.0722];

/// Encodes one linear component; 0..=1 maps to 0..=1, and nothing is clamped.
pub fn encoded_from_linear(linear: f64) -> f64 {
    if linear <= 0.0031308 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// Decodes one component to linear light; the inverse of [`encoded_from_linear`].
pub fn linear_from_encoded(encoded: f64) -> f64 {
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

/// The number of steps of [`SrgbEncoder`]'s table.
///
/// The narrowest code is 1 / (12.92 · 255) = 1 / 3294.6 of linear light wide, so the code changes at most once within a
/// step. A power of two makes finding the step free of rounding.
const STEPS: usize = 4096;

/// Encodes linear light in 8 bits without computing a power.
///
/// A component takes a look-up and a comparison; the result is that of the formula, rounded, for every input. The
/// encoder should be made once and kept: it has 6 kB, which fit in the nearest cache.
#[derive(Debug, Clone)]
pub struct SrgbEncoder {
    /// The code at the lower end of each step.
    code: [u8; STEPS],
    /// The least linear value of each code; beyond code 255 NaN, which no value reaches.
    least: [f64; 257],
    /// The linear value of each code.
    exact: [f64; 256],
}

impl SrgbEncoder {
    /// Makes an encoder and fills its tables.
    pub fn new() -> Self {
        let mut least = [f64::NAN; 257];
        (0..=255_u8).for_each(|code| least[usize::from(code)] = least_linear(code));
        let code = std::array::from_fn(|step| rounded(step as f64 / STEPS as f64));
        let exact = std::array::from_fn(|code| linear_from_encoded(code as f64 / 255.0));
        Self { code, least, exact }
    }

    /// Returns the 8-bit code of a linear component: [`encoded_from_linear`] clamped to 0..=1, times 255, rounded. NaN gives
    /// 0.
    #[inline]
    pub fn encode(&self, linear: f64) -> u8 {
        // The cast saturates: a negative value or NaN lands in the first step, too bright a value in the last.
        let step = ((linear * STEPS as f64) as usize).min(STEPS - 1);
        let code = self.code[step];
        code + u8::from(linear >= self.least[usize::from(code) + 1])
    }

    /// Returns the 8-bit code of a linear component as [`encode`](Self::encode) does, but rounded up where the component lies
    /// more than `threshold` of the way from one code to the next, in linear light; `threshold` is above 0 and below 1.
    /// The light of a code keeps that code.
    #[inline]
    pub fn encode_dithered(&self, linear: f64, threshold: f64) -> u8 {
        let near = self.encode(linear);
        let below = near - u8::from(near > 0 && linear < self.exact[usize::from(near)]);
        let [low, high] = [below, below.saturating_add(1)].map(|code| self.exact[usize::from(code)]);
        below + u8::from(below < 255 && linear - low > threshold * (high - low))
    }

    /// Returns the three codes of a colour.
    #[inline]
    pub fn encode_rgb(&self, colour: LinearRgb) -> [u8; 3] {
        colour.to_array().map(|linear| self.encode(linear))
    }
}

impl Default for SrgbEncoder {
    fn default() -> Self {
        Self::new()
    }
}

/// Computes the code by the rounded formula, from which the tables are made.
fn rounded(linear: f64) -> u8 {
    (encoded_from_linear(linear).clamp(0.0, 1.0) * 255.0).round() as u8
}

/// Returns the least linear value >= 0 that rounds to `code`. The inverse formula gives all but its last bits, which
/// are found by trial.
fn least_linear(code: u8) -> f64 {
    let mut linear = linear_from_encoded((f64::from(code) - 0.5).max(0.0) / 255.0);
    while linear > 0.0 && rounded(linear) >= code {
        linear = linear.next_down();
    }
    while rounded(linear) < code {
        linear = linear.next_up();
    }
    linear
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn encoding_and_decoding_undo_each_other() {
        for step in 0..=10_000 {
            let value = f64::from(step) / 10_000.0;
            // The standard's rounded constants leave a step of 3e-8 where the two pieces meet.
            assert!((linear_from_encoded(encoded_from_linear(value)) - value).abs() < 1e-7);
        }
        assert_eq!(encoded_from_linear(0.0), 0.0);
        assert!((encoded_from_linear(1.0) - 1.0).abs() < 1e-15);
        assert!((encoded_from_linear(0.214_041_140_482_232_55) - 0.5).abs() < 1e-12);
    }

    #[test]
    fn the_table_agrees_with_the_formula_around_every_8_bit_boundary() {
        let encoder = SrgbEncoder::new();
        for code in 1..=255_u8 {
            let least = least_linear(code);
            assert_eq!((encoder.encode(least), encoder.encode(least.next_down())), (code, code - 1));
            let mut below = least;
            let mut above = least;
            for _ in 0..100 {
                assert_eq!(encoder.encode(above), rounded(above), "{above:e}");
                assert_eq!(encoder.encode(below), rounded(below), "{below:e}");
                (below, above) = (below.next_down(), above.next_up());
            }
        }
    }

    #[test]
    fn the_table_agrees_with_the_formula_at_every_step_and_between() {
        let encoder = SrgbEncoder::new();
        for i in 0..1_000_003 {
            let linear = f64::from(i) / 1_000_000.0;
            assert_eq!(encoder.encode(linear), rounded(linear), "{linear}");
        }
        for linear in (0..=STEPS).map(|step| step as f64 / STEPS as f64) {
            assert_eq!(encoder.encode(linear), rounded(linear));
            assert_eq!(encoder.encode(linear.next_down()), rounded(linear.next_down()));
        }
    }

    #[test]
    fn every_code_survives_decoding_and_encoding() {
        let encoder = SrgbEncoder::new();
        for code in 0..=255_u8 {
            assert_eq!(encoder.encode(linear_from_encoded(f64::from(code) / 255.0)), code);
        }
    }

    #[test]
    fn light_out_of_range_is_clamped() {
        let encoder = SrgbEncoder::new();
        for dark in [-1.0, -f64::MIN_POSITIVE, -0.0, f64::NEG_INFINITY, f64::NAN] {
            assert_eq!(encoder.encode(dark), 0);
        }
        for bright in [1.0, 1.0_f64.next_up(), 1e300, f64::INFINITY] {
            assert_eq!(encoder.encode(bright), 255);
        }
        assert_eq!(encoder.encode_rgb(LinearRgb::new(-1.0, 1.0, 0.5)), [0, 255, 188]);
    }
}
