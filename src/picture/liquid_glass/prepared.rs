//! A pane that is drawn again and again: what depends on its shape alone is computed once.

use super::frost::{CLEAR, FIVE, FrostTap, THREE, blur};
use super::lighting::{Brightness, Normals, SurfaceLight};
use super::parts::RED_AND_BLUE;
use super::{GlassPane, LightFrom, PaneQuality};
use crate::picture::Linear;
use crate::scene::Panorama;
use glam::{DVec2, DVec4, Vec4};
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;

/// A pane of liquid glass that is ready to be drawn in front of any background of one size and in any light.
#[derive(Debug, Clone)]
pub struct PreparedPane {
    /// The pane with its corner in the first pixel, and without light.
    shape: GlassPane,
    /// Width and height of the picture in pixels.
    size: [u32; 2],
    area: PaneArea,
    rows: Vec<PaneRow>,
}

/// What is seen through a prepared pane, before light falls on it.
#[derive(Debug, Clone, PartialEq)]
pub struct SeenThrough {
    /// The colours of the pixels that the pane may cover, row by row.
    colours: Vec<[f32; 3]>,
}

/// The pixels of a picture that a pane may cover.
#[derive(Debug, Clone, Copy, PartialEq)]
struct PaneArea {
    /// The first pixel, across and down.
    first: [u32; 2],
    /// The number of pixels, across and down.
    count: [u32; 2],
    /// The pixel of the pane's corner.
    corner: [i64; 2],
}

/// One row of the pixels that a pane may cover. Each list has a number for each of these pixels.
#[derive(Debug, Clone, Default)]
struct PaneRow {
    /// How much of the pixel the pane covers, 0 to 1.
    cover: Vec<f32>,
    /// How far to the right and down green light is looked up, pixels.
    shift: [Vec<f32>; 2],
    /// How far from there a unit of dispersion moves a look-up, pixels.
    apart: [Vec<f32>; 2],
    /// The standard deviation of the frost, pixels.
    blur: Vec<f32>,
    normals: Normals,
}

impl PaneArea {
    fn new(pane: &GlassPane, size: [u32; 2]) -> Self {
        let whole = DVec2::from(size.map(f64::from));
        let low = (pane.corner - 1.0).floor().clamp(DVec2::ZERO, whole).as_uvec2();
        let high = (pane.corner + pane.size + 1.0).ceil().clamp(DVec2::ZERO, whole).as_uvec2();
        let count = high.saturating_sub(low);
        let is_empty = count.min_element() == 0 || !pane.is_somewhere();
        let count = if is_empty { [0; 2] } else { count.to_array() };
        Self { first: low.to_array(), count, corner: pane.corner.floor().to_array().map(|x| x as i64) }
    }

    /// Returns the first pixel, counted from that of the pane's corner.
    fn start(&self) -> [i64; 2] {
        [0, 1].map(|axis| i64::from(self.first[axis]) - self.corner[axis])
    }
}

/// Returns what of a pane its shape depends on: its corner counts within its pixel.
fn shape_of(pane: &GlassPane) -> GlassPane {
    let pane = pane.effective();
    let corner = pane.corner - pane.corner.floor();
    GlassPane { corner, light: 0.0, light_from: LightFrom::default(), tint: DVec4::ZERO, ..pane }
}

impl PreparedPane {
    /// Prepares a pane for pictures of this size.
    pub fn new(pane: &GlassPane, size: [u32; 2]) -> Self {
        Self::at(pane, size, DVec2::splat(0.5))
    }

    /// Prepares a pane as it is seen at a place in each pixel, 0 to 1 each way.
    pub(super) fn at(pane: &GlassPane, size: [u32; 2], place: DVec2) -> Self {
        let (shape, area) = (shape_of(pane), PaneArea::new(pane, size));
        let rows = 0..area.count[1];
        let rows = rows.into_par_iter().map(|row| PaneRow::new(&shape, &area, row, place)).collect();
        Self { shape, size, area, rows }
    }

    /// Whether this is what a pane needs that may have moved by whole pixels, or that is in another light.
    pub fn suits(&self, pane: &GlassPane, size: [u32; 2]) -> bool {
        let area = PaneArea::new(pane, size);
        let place = |area: &PaneArea| (area.start(), area.count);
        size == self.size && place(&area) == place(&self.area) && shape_of(pane) == self.shape
    }

    /// Moves the pane to where another one is that it [suits](Self::suits).
    pub fn moved_to(&mut self, pane: &GlassPane) {
        self.area = PaneArea::new(pane, self.size);
    }

    /// Looks up what of a background, in the size of the picture, is seen through the pane.
    pub fn through(&self, background: &Panorama) -> SeenThrough {
        let [across, down] = self.area.count.map(|count| count as usize);
        let mut colours = vec![[0.0; 3]; across * down];
        let taps: &[FrostTap] = if self.shape.quality == PaneQuality::High { &FIVE } else { &THREE };
        let (is_dispersed, arch) = (self.shape.dispersion > 0.0, Arch::new());
        let planes = match self.shape.frost > 0.0 && is_dispersed && taps.len() == FIVE.len() {
            true => planes(background),
            false => Default::default(),
        };
        let lines = colours.par_chunks_mut(across.max(1)).zip(&self.rows).enumerate();
        lines.for_each(|(y, (to, row))| {
            let start = [self.area.first[0], self.area.first[1] + y as u32];
            arch.dispatch(LookThrough { row, start, background, planes: &planes, is_dispersed, taps, to });
        });
        SeenThrough { colours }
    }

    /// Draws the pane with the light and the tint of one that it [suits](Self::suits): over a background, or without one
    /// alone, premultiplied by cover.
    pub fn lit(&self, pane: &GlassPane, seen: &SeenThrough, background: Option<&Panorama>) -> Linear {
        self.composed(&seen.colours, Some(SurfaceLight::new(&pane.effective())), background)
    }

    /// Adds the colours that the pane shows in its light to sums of the same pixels.
    pub(super) fn add_to(&self, sums: &mut Vec<[f32; 3]>, pane: &GlassPane, background: &Panorama) {
        let mut seen = self.through(background).colours;
        let light = SurfaceLight::new(&pane.effective());
        let lines = seen.par_chunks_mut(self.area.count[0].max(1) as usize).zip(&self.rows);
        lines.for_each(|(line, row)| row.add_light(line, &light));
        sums.resize(seen.len(), [0.0; 3]);
        let pairs = sums.par_iter_mut().zip(&seen);
        pairs.for_each(|(sum, seen)| sum.iter_mut().zip(seen).for_each(|(sum, seen)| *sum += seen));
    }

    /// Lays the pixels that the pane covers over a background, or over nothing.
    pub(super) fn composed(
        &self,
        colours: &[[f32; 3]],
        light: Option<SurfaceLight>,
        background: Option<&Panorama>,
    ) -> Linear {
        let mut picture = Linear::new(self.size[0], self.size[1]);
        let PaneArea { first: [left, top], count: [across, down], .. } = self.area;
        let [width, left, top, across, down] =
            [self.size[0], left, top, across, down].map(|side| side as usize);
        let lines = picture.pixels.par_chunks_mut(width.max(1)).enumerate();
        lines.for_each(|(y, line)| {
            if let Some(background) = background {
                let own = background.pixels.iter().skip(y * width);
                line.iter_mut().zip(own).for_each(|(to, &[r, g, b])| *to = [r, g, b, 1.0]);
            }
            let Some(row) = y.checked_sub(top).filter(|row| *row < down) else {
                return;
            };
            let mut own = colours[row * across..(row + 1) * across].to_vec();
            if let Some(light) = &light {
                self.rows[row].add_light(&mut own, light);
            }
            let covers = own.iter().zip(&self.rows[row].cover);
            line[left..].iter_mut().zip(covers).for_each(|(to, (&own, &cover))| laid(to, own, cover));
        });
        picture
    }
}

/// Lays a colour with this cover over a pixel, premultiplied.
fn laid(pixel: &mut [f32; 4], [r, g, b]: [f32; 3], cover: f32) {
    // Written as a sum, so that a colour over its own stays the same to the bit.
    pixel.iter_mut().zip([r, g, b, 1.0]).for_each(|(own, new)| *own += (new - *own) * cover);
}

impl PaneRow {
    fn new(pane: &GlassPane, area: &PaneArea, row: u32, place: DVec2) -> Self {
        let [left, top] = area.start();
        let (outline, unit) = (pane.outline(), pane.unit());
        let mut to = Self::default();
        for x in 0..area.count[0] {
            let pixel = DVec2::new((left + i64::from(x)) as f64, (top + i64::from(row)) as f64);
            let own = pane.own(pixel + place);
            let dome = outline.dome(own);
            let (shift, apart) = pane.shifts_on(&dome);
            to.cover.push(pane.cover(pixel + 0.5) as f32);
            for axis in 0..2 {
                to.shift[axis].push(shift[axis] as f32);
                to.apart[axis].push(apart[axis] as f32);
            }
            to.blur.push((blur(own, &dome, pane.frost) * unit) as f32);
            let normal = dome.normal.to_array();
            to.normals.0.iter_mut().zip(normal).for_each(|(to, part)| to.push(part as f32));
        }
        to
    }

    /// Adds the light of the surface to a row of colours.
    fn add_light(&self, colours: &mut [[f32; 3]], light: &SurfaceLight) {
        if light.colour.max_element() <= 0.0 {
            return;
        }
        let mut bright = vec![0.0; colours.len()];
        Arch::new().dispatch(Brightness { light: *light, normals: &self.normals, to: &mut bright });
        let own = light.colour.to_array();
        for (colour, bright) in colours.iter_mut().zip(bright) {
            colour.iter_mut().zip(own).for_each(|(colour, own)| *colour += own * bright);
        }
    }
}

/// Returns red, green and blue of a picture, each of all pixels.
fn planes(picture: &Panorama) -> [Vec<f32>; 3] {
    let channel = |channel: usize| picture.pixels.iter().map(|pixel| pixel[channel]).collect();
    let ((red, green), blue) = rayon::join(|| rayon::join(|| channel(0), || channel(1)), || channel(2));
    [red, green, blue]
}

/// Looks a row of pixels up in the background.
struct LookThrough<'a> {
    row: &'a PaneRow,
    /// The first pixel of the row in the picture.
    start: [u32; 2],
    background: &'a Panorama,
    planes: &'a [Vec<f32>; 3],
    is_dispersed: bool,
    taps: &'a [FrostTap],
    to: &'a mut [[f32; 3]],
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
            let is_five = blur > 0.0 && taps.len() == FIVE.len();
            let taps = if blur > 0.0 { taps } else { &CLEAR };
            if !is_dispersed {
                *to = ground.colour(at, shift, blur, taps);
                continue;
            }
            let apart = [row.apart[0][k], row.apart[1][k]];
            let parts = [RED_AND_BLUE[0] as f32, 0.0, RED_AND_BLUE[1] as f32];
            for (channel, part) in parts.into_iter().enumerate() {
                let by = [shift[0] + apart[0] * part, shift[1] + apart[1] * part];
                let five = if is_five { ground.five(at, by, channel, blur) } else { None };
                to[channel] = match five {
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

/// The pixels around a place: two in each of two rows, and how far the place is from the first to the others.
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

    /// Returns one channel of the mean of what is seen around a place.
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

    /// Returns the mean of what is seen around a place.
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

#[cfg(test)]
impl SeenThrough {
    /// Returns the greatest difference from what is seen through another pane of the same size.
    pub(super) fn apart(&self, other: &Self) -> f32 {
        let pairs = self.colours.iter().flatten().zip(other.colours.iter().flatten());
        pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
    }
}
