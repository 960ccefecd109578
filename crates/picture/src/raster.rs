//! Paints polygons with exact area coverage: a pixel's value is the mean over its square, without sampling.
//!
//! Every edge adds, to the pixels that it crosses, the change of coverage that it makes along the row. A running sum
//! along the row then gives the coverage (the signed-area accumulation of FreeType and font-rs). The cost is
//! proportional to the length of a polygon's outline, not to its area.

use glam::DVec2;
use rayon::prelude::*;
use std::ops::{Add, AddAssign, Mul, Sub};

/// The value of a pixel: a number, or several numbers.
pub trait Value:
    Copy + Default + AddAssign + Add<Output = Self> + Sub<Output = Self> + Mul<f64, Output = Self>
{
}

impl<V: Copy + Default + AddAssign + Add<Output = V> + Sub<Output = V> + Mul<f64, Output = V>> Value for V {}

/// Some rows of a picture, with several channels.
#[derive(Debug, Clone)]
pub struct Rows<V = f64> {
    /// The first row's number in the picture.
    pub first: u32,
    /// The number of rows.
    pub count: u32,
    /// The number of pixels in a row.
    pub width: u32,
    /// The number of channels of a pixel.
    pub channels: usize,
    /// Values row by row, within a row channel by channel.
    values: Vec<V>,
}

impl<V: Value> Rows<V> {
    /// Builds empty rows.
    pub fn new(first: u32, count: u32, width: u32, channels: usize) -> Self {
        let values = vec![V::default(); (count as usize) * channels * Self::stride_of(width)];
        Self { first, count, width, channels, values }
    }

    /// Returns the number of values in a row: one more than pixels, since an edge on the last pixel's right side ends
    /// there.
    fn stride_of(width: u32) -> usize {
        width as usize + 1
    }

    /// Returns the values of one channel along row `y`, counted from the picture's top.
    pub fn row(&self, y: u32, channel: usize) -> &[V] {
        let start = self.start(y, channel);
        &self.values[start..start + self.width as usize]
    }

    /// Returns the values of one channel along row `y` for writing.
    pub fn row_mut(&mut self, y: u32, channel: usize) -> &mut [V] {
        let start = self.start(y, channel);
        &mut self.values[start..start + self.width as usize]
    }

    /// Calls `fill` for each row, on all cores, with the row's number counted from [`first`](Self::first) and its values:
    /// channel by channel, each with one value more than the row has pixels.
    pub fn fill_rows(&mut self, fill: impl Fn(usize, &mut [V]) + Sync)
    where
        V: Send,
    {
        let length = self.channels * Self::stride_of(self.width);
        self.values.par_chunks_mut(length.max(1)).enumerate().for_each(|(row, values)| fill(row, values));
    }

    fn start(&self, y: u32, channel: usize) -> usize {
        ((y - self.first) as usize * self.channels + channel) * Self::stride_of(self.width)
    }

    /// Adds the edges of a polygon, whose corners are in pixels, with this weight. Its corners may run either way
    /// round. The values have no meaning before [`summed`](Self::summed) has been called.
    pub fn add(&mut self, polygon: &[DVec2], channel: usize, weight: V) {
        let Some(&last) = polygon.last() else { return };
        let weight = if brillianteer_math::area(polygon) < 0.0 { weight * -1.0 } else { weight };
        let mut a = last;
        for &b in polygon {
            if a.y < b.y {
                self.edge(a, b, channel, weight * -1.0);
            } else if a.y > b.y {
                self.edge(b, a, channel, weight);
            }
            a = b;
        }
    }

    /// Adds one edge, which runs downward from `top` to `bottom`.
    fn edge(&mut self, top: DVec2, bottom: DVec2, channel: usize, weight: V) {
        let (first, end) = (f64::from(self.first), f64::from(self.first + self.count));
        let from = top.y.max(first);
        let to = bottom.y.min(end);
        if from >= to {
            return;
        }
        let slope = (bottom.x - top.x) / (bottom.y - top.y);
        let width = f64::from(self.width);
        let mut y = from;
        let mut x = top.x + (from - top.y) * slope;
        let mut row = from as u32;
        while y < to {
            let next = f64::from(row + 1).min(to);
            let x_next = x + (next - y) * slope;
            let start = self.start(row, channel);
            let line = &mut self.values[start..start + Self::stride_of(self.width)];
            let (left, right) = if x < x_next { (x, x_next) } else { (x_next, x) };
            let (start, end) = (left.clamp(0.0, width), right.clamp(0.0, width));
            let change = weight * (next - y);
            let per_pixel = if right > left { change * (1.0 / (right - left)) } else { V::default() };
            // Any part of the edge left of the picture acts on its left border; a part right of it changes nothing.
            if left < 0.0 {
                let beside = if right > 0.0 { per_pixel * -left } else { change };
                deposit(line, 0.0, 0.0, beside);
            }
            if right > 0.0 || left >= 0.0 {
                let inside = if left < 0.0 || right > width { per_pixel * (end - start) } else { change };
                deposit(line, start, end, inside);
            }
            (x, y) = (x_next, next);
            row += 1;
        }
    }

    /// Turns the changes that edges have added into coverage.
    pub fn summed(mut self) -> Self {
        for line in self.values.chunks_exact_mut(Self::stride_of(self.width)) {
            let mut sum = V::default();
            for value in line {
                sum += *value;
                *value = sum;
            }
        }
        self
    }
}

/// Spreads a change of coverage over the pixels between `left` and `right`, where an edge crosses one row.
#[inline]
fn deposit<V: Value>(line: &mut [V], left: f64, right: f64, change: V) {
    let first = left as usize;
    let last = right as usize;
    if first == last {
        // The edge stays within one pixel. Of that pixel, the part right of the edge's middle is covered; of the next, all.
        let middle = (left + right) / 2.0 - first as f64;
        line[first] += change * (1.0 - middle);
        if let Some(next) = line.get_mut(first + 1) {
            *next += change * middle;
        }
        return;
    }
    // The edge crosses pixels. The coverage right of it, summed up to each pixel's end, is a quadratic.
    let per = change * (0.5 / (right - left));
    let covered = |end: f64| per * ((end - left) * (end - left));
    let mut done = V::default();
    let mut reached = V::default();
    for (pixel, value) in line.iter_mut().enumerate().take(last + 1).skip(first) {
        let end = (pixel + 1) as f64;
        // The integral of the coverage up to `end`; past the edge's right end it grows linearly.
        let integral = if end < right { covered(end) } else { covered(right) + change * (end - right) };
        let mean = integral - reached;
        *value += mean - done;
        (done, reached) = (mean, integral);
    }
    if let Some(next) = line.get_mut(last + 1) {
        *next += change - done;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_math::{Affine, area, clip};

    fn painted(polygon: &[DVec2], width: u32) -> Rows {
        let mut rows = Rows::new(0, width, width, 1);
        rows.add(polygon, 0, 1.0);
        rows.summed()
    }

    /// Returns the part of a pixel that the polygon covers, by clipping.
    fn covered(polygon: &[DVec2], x: u32, y: u32) -> f64 {
        let (x, y) = (f64::from(x), f64::from(y));
        let sides = [(x, DVec2::X), (-x - 1.0, DVec2::NEG_X), (y, DVec2::Y), (-y - 1.0, DVec2::NEG_Y)];
        let mut part = polygon.to_vec();
        let mut out = vec![];
        for (offset, normal) in sides {
            clip(&part, Affine::new(-offset, normal), &mut out);
            std::mem::swap(&mut part, &mut out);
        }
        area(&part).abs()
    }

    #[test]
    fn every_pixel_holds_the_area_that_clipping_finds() {
        for k in 0..60 {
            let turn = DVec2::from_angle(0.1 + f64::from(k));
            let shape =
                [DVec2::new(-5.3, -0.2), DVec2::new(1.0, -4.4), DVec2::new(6.1, 0.3), DVec2::new(0.4, 2.9)];
            let mut polygon =
                shape.map(|p| turn.rotate(p) * (0.1 + 0.02 * f64::from(k)) + DVec2::new(8.3, 7.9));
            if k % 2 == 1 {
                polygon.reverse();
            }
            let rows = painted(&polygon, 16);
            for y in 0..16 {
                for x in 0..16 {
                    let (got, expected) = (rows.row(y, 0)[x as usize], covered(&polygon, x, y));
                    assert!(
                        (got - expected).abs() < 1e-12,
                        "shape {k}, pixel {x} {y}: {got}, not {expected}"
                    );
                }
            }
        }
    }

    #[test]
    fn what_hangs_over_the_rows_painted_is_left_out() {
        let square =
            [DVec2::new(2.0, -3.0), DVec2::new(4.0, -3.0), DVec2::new(4.0, 9.0), DVec2::new(2.0, 9.0)];
        let mut rows = Rows::new(1, 2, 8, 1);
        rows.add(&square, 0, 0.5);
        let rows = rows.summed();
        assert_eq!(rows.row(1, 0), [0.0, 0.0, 0.5, 0.5, 0.0, 0.0, 0.0, 0.0]);
        assert_eq!(rows.row(2, 0), rows.row(1, 0));
    }

    #[test]
    fn a_polygon_that_hangs_over_the_borders_is_cut_there() {
        let triangle = [DVec2::new(-2.0, 0.0), DVec2::new(6.0, 0.0), DVec2::new(-2.0, 1.0)];
        let mut rows = Rows::new(0, 1, 4, 1);
        rows.add(&triangle, 0, 1.0);
        let rows = rows.summed();
        for (x, &covered) in rows.row(0, 0).iter().enumerate() {
            let exact = (6.0 - (x as f64 + 0.5)) / 8.0;
            assert!((covered - exact).abs() < 1e-15, "pixel {x}: {covered}, not {exact}");
        }
    }
}
