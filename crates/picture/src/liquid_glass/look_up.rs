//! Looks rows of pixels up in the background behind a pane, in single precision.

use super::frost::{CLEAR, FIVE, FrostTap, THREE};
use super::parts::RED_AND_BLUE;
use super::prepared::PaneRow;
use brillianteer_scene::Panorama;
use glam::Vec4;
use pulp::{Simd, WithSimd};

/// Returns red, green and blue of a picture, each of all pixels.
pub(super) fn planes(picture: &Panorama) -> [Vec<f32>; 3] {
    let channel = |channel: usize| picture.pixels.iter().map(|pixel| pixel[channel]).collect();
    let ((red, green), blue) = rayon::join(|| rayon::join(|| channel(0), || channel(1)), || channel(2));
    [red, green, blue]
}

/// Looks a row of pixels up in the background.
pub(super) struct LookThrough<'a> {
    pub row: &'a PaneRow,
    /// The first pixel of the row in the picture.
    pub start: [u32; 2],
    pub background: &'a Panorama,
    pub planes: &'a [Vec<f32>; 3],
    pub is_dispersed: bool,
    pub taps: &'a [FrostTap],
    pub to: &'a mut [[f32; 3]],
}

impl WithSimd for LookThrough<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { row, start: [left, y], background, planes, is_dispersed, taps, to } = self;
        let ground = Ground {
            pixels: &background.pixels,
            planes,
            size: [background.width as i32, background.height as i32],
        };
        for (k, to) in to.iter_mut().enumerate() {
            if row.cover[k] <= 0.0 {
                continue;
            }
            let at = [left as i32 + k as i32, y as i32];
            let (shift, blur) = ([row.shift[0][k], row.shift[1][k]], row.blur[k]);
            let taps = if blur > 0.0 { taps } else { &CLEAR };
            if !is_dispersed {
                *to = ground.colour(at, shift, blur, taps);
                continue;
            }
            let apart = [row.apart[0][k], row.apart[1][k]];
            let parts = [RED_AND_BLUE[0] as f32, 0.0, RED_AND_BLUE[1] as f32];
            for (channel, part) in parts.into_iter().enumerate() {
                let by = [shift[0] + apart[0] * part, shift[1] + apart[1] * part];
                let together = match taps.len() {
                    5 => ground.five(at, by, channel, blur),
                    3 => ground.three(at, by, channel, blur),
                    _ => None,
                };
                to[channel] = match together {
                    Some(mean) => mean,
                    None => ground.channel(at, by, channel, blur, taps),
                };
            }
        }
    }
}

/// A background whose pixels are interpolated. Its functions take no closures, which would be compiled apart, without the
/// instructions that the processor has.
struct Ground<'a> {
    pixels: &'a [[f32; 3]],
    /// Red, green and blue, each of all pixels; empty where they are not needed.
    planes: &'a [Vec<f32>; 3],
    /// Width and height in pixels.
    size: [i32; 2],
}

/// The weights of four columns or rows, of which the second is the last before a place: in the place, and in the mean of two
/// places beside it.
struct BesideAndOn {
    on: Vec4,
    beside: Vec4,
}

impl BesideAndOn {
    #[inline(always)]
    fn new(part: f32, reach: f32) -> Self {
        let from_place = Vec4::new(-1.0, 0.0, 1.0, 2.0) - part;
        let on = (Vec4::ONE - from_place.abs()).max(Vec4::ZERO);
        let after = (Vec4::ONE - (from_place - reach).abs()).max(Vec4::ZERO);
        let before = (Vec4::ONE - (from_place + reach).abs()).max(Vec4::ZERO);
        Self { on, beside: 0.5 * (after + before) }
    }
}

/// The pixels around a place: two in each of two rows, and the offset of the place from the first of them.
struct Around<'a> {
    high: [&'a [f32; 3]; 2],
    low: [&'a [f32; 3]; 2],
    part: [f32; 2],
}

impl<'a> Ground<'a> {
    /// Returns the pixels around a place that is some pixels from the middle of a pixel. Beyond the edge the edge's own
    /// count.
    #[inline(always)]
    fn around(&self, at: [i32; 2], by: [f32; 2]) -> Around<'a> {
        let base = [by[0].floor(), by[1].floor()];
        let [width, height] = self.size;
        let (x, y) = (at[0].saturating_add(base[0] as i32), at[1].saturating_add(base[1] as i32));
        let part = [by[0] - base[0], by[1] - base[1]];
        if x >= 0 && y >= 0 && x < width - 1 && y < height - 1 {
            let first = y as usize * width as usize + x as usize;
            let below = first + width as usize;
            if let ([a, b, ..], [c, d, ..]) = (&self.pixels[first..], &self.pixels[below..]) {
                return Around { high: [a, b], low: [c, d], part };
            }
        }
        let (last, lowest) = (width - 1, height - 1);
        let (left, right) = (x.clamp(0, last) as usize, x.saturating_add(1).clamp(0, last) as usize);
        let high = y.clamp(0, lowest) as usize * width as usize;
        let low = y.saturating_add(1).clamp(0, lowest) as usize * width as usize;
        let pixels = self.pixels;
        let (high, low) =
            ([&pixels[high + left], &pixels[high + right]], [&pixels[low + left], &pixels[low + right]]);
        Around { high, low, part }
    }

    /// Returns one channel of the mean of the five samples of frost around a place, where all of them lie within a pixel of
    /// it and inside the picture; else `None`.
    ///
    /// With a the interpolation's weights of four columns or rows in the middle and b the mean of those at both samples
    /// beside it, the samples add up to ((a + b) a' + a b') / 3: four pixels at a time, and not twenty one by one.
    #[inline(always)]
    fn five(&self, at: [i32; 2], by: [f32; 2], channel: usize, blur: f32) -> Option<f32> {
        let reach = blur * FIVE[1].at[0];
        let base = [by[0].floor(), by[1].floor()];
        let x = at[0].saturating_add(base[0] as i32).saturating_sub(1);
        let y = at[1].saturating_add(base[1] as i32).saturating_sub(1);
        let [width, height] = self.size;
        if reach > 1.0 || x < 0 || y < 0 || x >= width - 3 || y >= height - 3 {
            return None;
        }
        let columns = BesideAndOn::new(by[0] - base[0], reach);
        let rows = BesideAndOn::new(by[1] - base[1], reach);
        let (on, beside) = (rows.on.to_array(), rows.beside.to_array());
        let plane = &self.planes[channel];
        let mut first = y as usize * width as usize + x as usize;
        let (mut high, mut low) = (Vec4::ZERO, Vec4::ZERO);
        for row in 0..4 {
            let four = Vec4::from_slice(&plane[first..first + 4]);
            high += four * on[row];
            low += four * beside[row];
            first += width as usize;
        }
        Some((high.dot(columns.on + columns.beside) + low.dot(columns.on)) / 3.0)
    }

    /// Returns one channel of the mean of the three samples of frost around a place, where all of them lie within a pixel
    /// of it and inside the picture; else `None`. With the weights of [`five`](Self::five), they add up to
    /// (2 a + b) / 3 in each of two rows.
    #[inline(always)]
    fn three(&self, at: [i32; 2], by: [f32; 2], channel: usize, blur: f32) -> Option<f32> {
        let reach = blur * THREE[1].at[0];
        let base = [by[0].floor(), by[1].floor()];
        let x = at[0].saturating_add(base[0] as i32).saturating_sub(1);
        let y = at[1].saturating_add(base[1] as i32);
        let [width, height] = self.size;
        if reach > 1.0 || x < 0 || y < 0 || x >= width - 3 || y >= height - 1 {
            return None;
        }
        let columns = BesideAndOn::new(by[0] - base[0], reach);
        let (plane, first) = (&self.planes[channel], y as usize * width as usize + x as usize);
        let high = Vec4::from_slice(&plane[first..first + 4]);
        let below = first + width as usize;
        let low = Vec4::from_slice(&plane[below..below + 4]);
        let between = high + (low - high) * (by[1] - base[1]);
        Some(between.dot(2.0 * columns.on + columns.beside) / 3.0)
    }

    /// Returns one channel of the mean of the background around a place.
    #[inline(always)]
    fn channel(&self, at: [i32; 2], by: [f32; 2], channel: usize, blur: f32, taps: &[FrostTap]) -> f32 {
        let mut sum = 0.0;
        for tap in taps {
            let Around { high: [a, b], low: [c, d], part } =
                self.around(at, [by[0] + tap.at[0] * blur, by[1] + tap.at[1] * blur]);
            sum += tap.weight * mixed([a[channel], b[channel], c[channel], d[channel]], part);
        }
        sum
    }

    /// Returns the mean of the background around a place.
    #[inline(always)]
    fn colour(&self, at: [i32; 2], by: [f32; 2], blur: f32, taps: &[FrostTap]) -> [f32; 3] {
        let mut sum = [0.0; 3];
        for tap in taps {
            let Around { high: [a, b], low: [c, d], part } =
                self.around(at, [by[0] + tap.at[0] * blur, by[1] + tap.at[1] * blur]);
            for channel in 0..3 {
                sum[channel] += tap.weight * mixed([a[channel], b[channel], c[channel], d[channel]], part);
            }
        }
        sum
    }
}

#[inline(always)]
fn mixed([a, b, c, d]: [f32; 4], [across, down]: [f32; 2]) -> f32 {
    let (high, low) = (a + (b - a) * across, c + (d - c) * across);
    high + (low - high) * down
}
