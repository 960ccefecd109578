//! A pane that is drawn again and again: the results that depend on its shape alone are computed once.

use super::frost::{FIVE, FrostTap, THREE, blur};
use super::lighting::{Brightness, Normals, SurfaceLight};
use super::look_up::{LookThrough, planes};
use super::{GlassPane, LightFrom, PaneQuality};
use crate::Linear;
use brillianteer_scene::Panorama;
use glam::{DVec2, DVec4};
use pulp::Arch;
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

/// The background as seen through a prepared pane, before light falls on the pane.
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

/// A row of the pixels that a pane may cover. Each list has a number for each of these pixels.
#[derive(Debug, Clone, Default)]
pub(super) struct PaneRow {
    /// The part of the pixel that the pane covers, 0 to 1.
    pub cover: Vec<f32>,
    /// The shift to the right and down at which green light is looked up, pixels.
    pub shift: [Vec<f32>; 2],
    /// The further shift of the look-up by a unit of dispersion, pixels.
    pub apart: [Vec<f32>; 2],
    /// The standard deviation of the frost, pixels.
    pub blur: Vec<f32>,
    pub normals: Normals,
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

    /// Returns the first pixel, counted from that of the pane's corner; for panes that are far off, the largest
    /// number of the type.
    fn start(&self) -> [i64; 2] {
        [0, 1].map(|axis| i64::from(self.first[axis]).saturating_sub(self.corner[axis]))
    }
}

/// Returns the pane with only those numbers on which its shape depends: its corner within its pixel.
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

    /// Prepares a pane for a place in each pixel, 0 to 1 each way.
    pub(super) fn at(pane: &GlassPane, size: [u32; 2], place: DVec2) -> Self {
        let (shape, area) = (shape_of(pane), PaneArea::new(pane, size));
        let rows = 0..area.count[1];
        let rows = rows.into_par_iter().map(|row| PaneRow::new(&shape, &area, row, place)).collect();
        Self { shape, size, area, rows }
    }

    /// Returns whether another pane can be drawn by this one: its shape is the same, it has moved by whole pixels at most and
    /// covers as many pixels, and the picture has this size. Light and tint may differ.
    pub fn suits(&self, pane: &GlassPane, size: [u32; 2]) -> bool {
        let area = PaneArea::new(pane, size);
        let place = |area: &PaneArea| (area.start(), area.count);
        size == self.size && place(&area) == place(&self.area) && shape_of(pane) == self.shape
    }

    /// Moves the pane to where another one is that it [suits](Self::suits).
    pub fn moved_to(&mut self, pane: &GlassPane) {
        self.area = PaneArea::new(pane, self.size);
    }

    /// Looks up the part of a background, in the size of the picture, that is seen through the pane.
    pub fn through(&self, background: &Panorama) -> SeenThrough {
        let [across, down] = self.area.count.map(|count| count as usize);
        let mut colours = vec![[0.0; 3]; across * down];
        let taps: &[FrostTap] = if self.shape.quality == PaneQuality::High { &FIVE } else { &THREE };
        let (is_dispersed, arch) = (self.shape.dispersion > 0.0, Arch::new());
        let planes =
            if self.shape.frost > 0.0 && is_dispersed { planes(background) } else { Default::default() };
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
pub(super) fn laid(pixel: &mut [f32; 4], [r, g, b]: [f32; 3], cover: f32) {
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
                // Look-ups begin in the pixel's middle.
                to.shift[axis].push((shift[axis] + place[axis] - 0.5) as f32);
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

#[cfg(test)]
impl SeenThrough {
    /// Returns the greatest difference from the view through another pane of the same size.
    pub(super) fn apart(&self, other: &Self) -> f32 {
        let pairs = self.colours.iter().flatten().zip(other.colours.iter().flatten());
        pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pane_infinitely_far_off_has_no_pixels() {
        let corners = [-1e300, 1e300, f64::NEG_INFINITY, f64::NAN];
        for x in corners {
            let pane = GlassPane::clear(DVec2::new(x, 0.0), DVec2::splat(10.0), 2.0);
            let prepared = PreparedPane::new(&pane, [20; 2]);
            assert_eq!(prepared.area.count, [0; 2]);
            assert!(prepared.suits(&pane, [20; 2]) || !x.is_finite());
        }
    }
}
