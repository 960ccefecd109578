//! Fast approximate antialiasing. It finds a finished picture's jagged edges by their contrast, follows each to both
//! ends, and smooths it by the part of each pixel that a straight edge there would cover (the method of T. Lottes,
//! FXAA, NVIDIA white paper, 2009). Edges are sought in encoded values, whose contrasts are those that people see;
//! pixels are mixed in linear light, in which an edge that covers half of a pixel has half of its light.

use crate::LUMINANCE;
use brillianteer_optics::{SrgbEncoder, linear_from_encoded};
use rayon::prelude::*;
use std::sync::LazyLock;

/// Contrast below which a pixel is left alone, in codes of full scale 1.
const LEAST_CONTRAST: f32 = 1.0 / 32.0;
/// Contrast below which a pixel is left alone, as a part of the brightest pixel around.
const LEAST_PART: f32 = 1.0 / 8.0;

/// The number of pixels for which an edge is followed to either side.
const FARTHEST: i32 = 12;

/// The greatest part of its neighbour that is mixed into a pixel that stands out alone.
const MOST_ALONE: f32 = 0.75;

/// Smooths the edges of a picture of `width` pixels a row, with encoded red, green, blue and cover, not premultiplied. A
/// picture that does not consist of whole rows is left as it is.
pub fn fxaa(rgba: &mut [u8], width: u32) {
    let width = width as usize;
    let (pixels, rest) = rgba.as_chunks::<4>();
    if width == 0 || !rest.is_empty() || pixels.len() % width != 0 {
        return;
    }
    let luma = pixels.iter().map(luma).collect();
    let picture = Picture { pixels, luma, width: width as i32, encoder: SrgbEncoder::new() };
    let smooth = (0..pixels.len() as i32)
        .into_par_iter()
        .flat_map_iter(|k| picture.smooth(k % picture.width, k / picture.width));
    let smooth: Vec<u8> = smooth.collect();
    rgba.copy_from_slice(&smooth);
}

/// Returns the brightness of a pixel over black, 0 to 1.
fn luma([r, g, b, cover]: &[u8; 4]) -> f32 {
    let parts = [r, g, b].into_iter().zip(LUMINANCE);
    parts.map(|(code, share)| f32::from(*code) * share).sum::<f32>() * f32::from(*cover) / (255.0 * 255.0)
}

struct Picture<'a> {
    pixels: &'a [[u8; 4]],
    luma: Vec<f32>,
    width: i32,
    encoder: SrgbEncoder,
}

impl Picture<'_> {
    /// Returns the place of the pixel at column `x` and row `y`; beyond the border, that of the nearest pixel on it.
    fn place(&self, x: i32, y: i32) -> usize {
        let height = self.pixels.len() as i32 / self.width;
        (y.clamp(0, height - 1) * self.width + x.clamp(0, self.width - 1)) as usize
    }

    fn luma(&self, x: i32, y: i32) -> f32 {
        self.luma[self.place(x, y)]
    }

    fn smooth(&self, x: i32, y: i32) -> [u8; 4] {
        let own = self.pixels[self.place(x, y)];
        let Some((part, [dx, dy])) = self.shift(x, y) else { return own };
        let other = self.pixels[self.place(x + dx, y + dy)];
        mixed(own, other, part, &self.encoder)
    }

    /// Returns the part of a neighbour that is to be mixed into a pixel, and the step to that neighbour. Returns
    /// `None` where there is too little contrast.
    fn shift(&self, x: i32, y: i32) -> Option<(f32, [i32; 2])> {
        let at = |dx: i32, dy: i32| self.luma(x + dx, y + dy);
        let middle = at(0, 0);
        let sides = [at(0, -1), at(0, 1), at(-1, 0), at(1, 0)];
        let most = sides.into_iter().fold(middle, f32::max);
        let least = sides.into_iter().fold(middle, f32::min);
        let range = most - least;
        if range < LEAST_CONTRAST.max(most * LEAST_PART) {
            return None;
        }
        let corners = [at(-1, -1), at(1, -1), at(-1, 1), at(1, 1)];
        // The second difference of brightness, summed for an edge along x and for one along y.
        let bend = |a: f32, b: f32, c: f32| (a + c - 2.0 * b).abs();
        let [up, down, left, right] = sides;
        let [up_left, up_right, down_left, down_right] = corners;
        let along_x =
            2.0 * bend(up, middle, down) + bend(up_left, left, down_left) + bend(up_right, right, down_right);
        let along_y =
            2.0 * bend(left, middle, right) + bend(up_left, up, up_right) + bend(down_left, down, down_right);
        let is_along_x = along_x >= along_y;
        let (before, after) = if is_along_x { (up, down) } else { (left, right) };
        let is_after = (after - middle).abs() > (before - middle).abs();
        let other = if is_after { after } else { before };
        let sign = if is_after { 1 } else { -1 };
        let (along, across) = if is_along_x { ([1, 0], [0, sign]) } else { ([0, 1], [sign, 0]) };
        let edge = Edge {
            from: [x, y],
            along,
            across,
            middle: 0.5 * (middle + other),
            step: (other - middle).abs() / 4.0,
        };
        let alone = (2.0 * sides.iter().sum::<f32>() + corners.iter().sum::<f32>()) / 12.0 - middle;
        // Beside a straight edge a third of the weights differ, and no pixel is isolated.
        let alone = (1.5 * alone.abs() / range - 0.5).clamp(0.0, 1.0);
        let alone = alone * MOST_ALONE;
        Some((self.cover(&edge, middle).max(alone), across))
    }

    /// Returns the part of a pixel that lies beyond a straight edge, drawn between the two ends of the edge that the
    /// pixel is at.
    fn cover(&self, edge: &Edge, luma: f32) -> f32 {
        let [(to_one, one), (to_other, other)] = [-1, 1].map(|way| self.end(edge, way));
        let (near, end) = if to_one < to_other { (to_one, one) } else { (to_other, other) };
        // The straight edge cuts the pixel only where the brightness at the nearer end changes toward the other
        // side's.
        if (end < 0.0) == (luma < edge.middle) {
            return 0.0;
        }
        0.5 - near / (to_one + to_other)
    }

    /// Follows an edge one way. Returns its length that way, in pixels, and the difference of the brightness at its
    /// end from the edge's middle.
    fn end(&self, edge: &Edge, way: i32) -> (f32, f32) {
        let mut off = 0.0;
        for k in 1..=FARTHEST {
            let [x, y] = [0, 1].map(|i| edge.from[i] + way * k * edge.along[i]);
            let there = self.luma(x + edge.across[0], y + edge.across[1]);
            off = 0.5 * (self.luma(x, y) + there) - edge.middle;
            if off.abs() >= edge.step {
                return (k as f32, off);
            }
        }
        (FARTHEST as f32, off)
    }
}

/// An edge between a pixel and one of its neighbours.
struct Edge {
    from: [i32; 2],
    along: [i32; 2],
    across: [i32; 2],
    /// Mean brightness of the two pixels at the edge.
    middle: f32,
    /// The change of brightness at which the edge ends.
    step: f32,
}

/// The linear light of each code.
static LINEAR: LazyLock<[f32; 256]> =
    LazyLock::new(|| std::array::from_fn(|code| linear_from_encoded(code as f64 / 255.0) as f32));

/// Mixes a part of another pixel, 0 to 1, into a pixel, in linear light. Colours are weighted by their cover.
fn mixed(own: [u8; 4], other: [u8; 4], part: f32, encoder: &SrgbEncoder) -> [u8; 4] {
    let covers = [own[3], other[3]].map(f32::from);
    let shares = [covers[0] * (1.0 - part), covers[1] * part];
    let cover = shares[0] + shares[1];
    if cover <= 0.0 {
        return own;
    }
    let code = |k: usize| {
        let [own, other] = [own[k], other[k]].map(|code| LINEAR[usize::from(code)]);
        encoder.encode(f64::from((own * shares[0] + other * shares[1]) / cover))
    };
    [code(0), code(1), code(2), cover.round() as u8]
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIDE: i32 = 48;

    /// Draws a half plane, white above a line through the middle, each pixel sampled at `points` × `points` points.
    fn half_plane(slope: f64, points: u32) -> Vec<u8> {
        let pixel = |k: i32| {
            let (x, y) = (f64::from(k % SIDE), f64::from(k / SIDE));
            let at = |n: u32| (f64::from(n) + 0.5) / f64::from(points) - 0.5 * f64::from(SIDE);
            let over =
                (0..points * points).filter(|n| y + at(n / points) < slope * (x + at(n % points)) + 0.3);
            let code = SrgbEncoder::new().encode(over.count() as f64 / f64::from(points * points));
            [code, code, code, 255]
        };
        (0..SIDE * SIDE).flat_map(pixel).collect()
    }

    fn off(a: &[u8], b: &[u8]) -> f64 {
        let squares: f64 = a.iter().zip(b).map(|(a, b)| f64::from(a.abs_diff(*b)).powi(2)).sum();
        (squares / a.len() as f64).sqrt()
    }

    #[test]
    fn jagged_edges_come_nearer_to_true_ones() {
        for slope in [0.07, 0.2, 0.45, 0.9, -0.3, 2.5, -8.0] {
            let (rough, exact) = (half_plane(slope, 1), half_plane(slope, 8));
            let mut smooth = rough.clone();
            fxaa(&mut smooth, SIDE as u32);
            let part = off(&smooth, &exact) / off(&rough, &exact);
            assert!(part < 0.7, "{slope}: {part}");
        }
    }

    #[test]
    fn what_has_no_edges_or_straight_ones_stays() {
        let even = [200_u8, 90, 10, 255].repeat(30);
        let row = |y: usize| if y < 3 { [255; 4] } else { [0, 0, 0, 255] }.repeat(6);
        let straight: Vec<u8> = (0..6).flat_map(row).collect();
        let dim: Vec<u8> = (0..30).flat_map(|k| [100 + k % 3, 100, 100, 255]).collect();
        for picture in [even, straight, dim] {
            let mut smooth = picture.clone();
            fxaa(&mut smooth, 6);
            assert_eq!(smooth, picture);
        }
    }

    #[test]
    fn what_is_clear_brings_no_colour_along() {
        let red_left = |k: i32| if k % SIDE < 10 + k / SIDE / 3 { [255, 0, 0, 255] } else { [0, 255, 0, 0] };
        let mut picture: Vec<u8> = (0..SIDE * SIDE).flat_map(red_left).collect();
        let before = picture.clone();
        fxaa(&mut picture, SIDE as u32);
        assert_ne!(picture, before);
        assert!(picture.as_chunks::<4>().0.iter().all(|p| p[3] == 0 || p[..3] == [255, 0, 0]));
    }

    #[test]
    fn odd_sizes_are_left_alone() {
        for (bytes, width) in [(0, 0), (0, 3), (4, 0), (7, 1), (20, 2)] {
            let mut picture = vec![7; bytes];
            fxaa(&mut picture, width);
            assert!(picture == vec![7; bytes]);
        }
    }
}
