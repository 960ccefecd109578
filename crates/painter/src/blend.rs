//! Arithmetic on pixels: four bytes each, red lowest, then green, blue and alpha; colours are multiplied by their alpha.
//!
//! Colours are mixed as their stored sRGB bytes, as egui's other painters do. Two channels are computed at a time, each in
//! the low half of 16 bits.

/// A pixel: red in the lowest byte, then green, blue, alpha.
pub type Pixel = u32;

/// The mask for two channels of a pixel, which clears the other two.
const HALF: u32 = 0x00ff_00ff;

/// Half of the last digit of two channels, added for rounding.
const ROUND: u32 = 0x0080_0080;

/// The largest weight that [`mixed`] takes.
pub const WHOLE: u32 = 256;

/// Returns a colour as a pixel.
pub fn pixel(colour: egui::Color32) -> Pixel {
    u32::from_le_bytes(colour.to_array())
}

/// Returns the alpha of a pixel, 0 to 255.
#[inline(always)]
pub fn alpha(of: Pixel) -> u32 {
    of >> 24
}

/// Returns a pixel times `part` / 255, rounded to the nearest; `part` is 255 at most.
#[inline(always)]
pub fn scaled(of: Pixel, part: u32) -> Pixel {
    let times = |half: u32| {
        let product = half * part + ROUND;
        // The nearest of n / 255 is (m + m / 256) / 256 with m = n + 128, for n up to 255².
        ((product + ((product >> 8) & HALF)) >> 8) & HALF
    };
    times(of & HALF) | (times((of >> 8) & HALF) << 8)
}

/// Returns the product of two pixels, channel by channel.
#[inline(always)]
pub fn product(a: Pixel, b: Pixel) -> Pixel {
    if a == u32::MAX {
        return b;
    }
    // Letters are white pixels with some coverage as their alpha.
    let coverage = alpha(b);
    if b == coverage * 0x0101_0101 {
        return scaled(a, coverage);
    }
    let (a, b) = (a.to_le_bytes(), b.to_le_bytes());
    let one = |k: usize| {
        let product = u32::from(a[k]) * u32::from(b[k]) + 128;
        ((product + (product >> 8)) >> 8) as u8
    };
    u32::from_le_bytes([one(0), one(1), one(2), one(3)])
}

/// Returns the colour of one pixel laid over another. A sum beyond white is cut off.
#[inline(always)]
pub fn over(front: Pixel, back: Pixel) -> Pixel {
    let rest = scaled(back, 255 - alpha(front));
    let sum = |a: u32, b: u32| {
        let sum = a + b;
        (sum | (((sum >> 8) & 0x0001_0001) * 255)) & HALF
    };
    let (low, high) = (sum(front & HALF, rest & HALF), sum((front >> 8) & HALF, (rest >> 8) & HALF));
    low | (high << 8)
}

/// Returns a mixture of two pixels. `weight`, 0 to [`WHOLE`], is that of `b`.
#[inline(always)]
pub fn mixed(a: Pixel, b: Pixel, weight: u32) -> Pixel {
    let mix = |a: u32, b: u32| ((a * (WHOLE - weight) + b * weight + ROUND) >> 8) & HALF;
    mix(a & HALF, b & HALF) | (mix((a >> 8) & HALF, (b >> 8) & HALF) << 8)
}

/// Lays one colour over a row of pixels.
pub fn lay(colour: Pixel, row: &mut [Pixel]) {
    match alpha(colour) {
        255 => row.fill(colour),
        0 if colour == 0 => {}
        _ => row.iter_mut().for_each(|back| *back = over(colour, *back)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the channels of a pixel as real numbers.
    fn real(of: Pixel) -> [f64; 4] {
        of.to_le_bytes().map(f64::from)
    }

    fn some_pixels() -> impl Iterator<Item = Pixel> {
        // A linear congruential sequence, which varies all bytes.
        std::iter::successors(Some(0x9e37_79b9_u32), |n| {
            Some(n.wrapping_mul(0x85eb_ca6b).wrapping_add(0x1234_5671))
        })
        .take(4000)
        .chain([0, u32::MAX, 0xff00_0000, 0x00ff_ffff, 0x8080_8080])
    }

    #[test]
    fn pixels_are_scaled_and_multiplied_to_the_nearest_byte() {
        for (a, b) in some_pixels().zip(some_pixels().skip(7)) {
            let part = b & 255;
            let nearest = real(a).map(|c| (c * f64::from(part) / 255.0).round() as u8);
            assert_eq!(scaled(a, part), u32::from_le_bytes(nearest));
            let each: [u8; 4] = std::array::from_fn(|k| (real(a)[k] * real(b)[k] / 255.0).round() as u8);
            assert_eq!(product(a, b), u32::from_le_bytes(each), "{a:08x} {b:08x}");
        }
    }

    #[test]
    fn a_pixel_over_another_hides_what_its_alpha_says_and_never_wraps() {
        for (a, b) in some_pixels().zip(some_pixels().skip(11)) {
            let rest = 255.0 - real(a)[3];
            let each: [u8; 4] =
                std::array::from_fn(|k| (real(a)[k] + (real(b)[k] * rest / 255.0).round()).min(255.0) as u8);
            assert_eq!(over(a, b), u32::from_le_bytes(each), "{a:08x} over {b:08x}");
        }
    }

    #[test]
    fn a_mixture_lies_between_its_parts() {
        for (a, b) in some_pixels().zip(some_pixels().skip(5)) {
            assert_eq!(mixed(a, b, 0), a);
            assert_eq!(mixed(a, b, WHOLE), b);
            let weight = a & 255;
            let each: [u8; 4] = std::array::from_fn(|k| {
                let w = f64::from(weight) / 256.0;
                (real(a)[k] * (1.0 - w) + real(b)[k] * w + 0.5).floor() as u8
            });
            assert_eq!(mixed(a, b, weight), u32::from_le_bytes(each));
        }
    }
}
