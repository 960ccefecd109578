//! Paints a layer some rows at a time, so that a picture may be larger than memory.

use super::Rows;
use super::layer::Layer;
use brillianteer_base::{Stopped, Watch};
use brillianteer_math::span;
use brillianteer_scene::Film;
use glam::{DAffine2, DVec2};
use rayon::prelude::*;
use std::ops::Range;

/// Size of one piece of rows in bytes: enough to be worth a task, few enough to stay in a core's cache.
const PIECE: usize = 1 << 21;

/// The number of pieces painted in parallel before they are handed on.
const AT_ONCE: usize = 8;

/// The number of pieces whose patches are listed at once: a multiple of [`AT_ONCE`]. A large picture has thousands of pieces,
/// and its lists would take more memory than its rows.
const LISTED: usize = 128;

/// A layer laid out on a film, ready to be painted.
struct Laid<'a> {
    layer: &'a Layer,
    film: Film,
    rows: u32,
    maps: Vec<DAffine2>,
    /// The first and the last piece that each patch touches, copy by copy.
    touched: Vec<(u32, u32)>,
}

/// Paints a layer from top to bottom and calls `each` with every piece of rows, in order.
///
/// A pixel's values are means over its area. The last channel is the stone's cover, 0 outside and 1 inside.
///
/// # Errors
/// The errors of `each`, and [`Stopped`], converted into `E`, when `watch` stops the work.
pub fn paint<E: From<Stopped>>(
    layer: &Layer,
    film: &Film,
    watch: Watch,
    mut each: impl FnMut(&Rows) -> Result<(), E>,
) -> Result<(), E> {
    let laid = Laid::new(layer, film);
    let count = laid.count();
    for first in (0..count).step_by(LISTED) {
        let listed = laid.listed(first..(first + LISTED).min(count));
        for (first, some) in (first..).step_by(AT_ONCE).zip(listed.chunks(AT_ONCE)) {
            if watch(first as f64 / count as f64).is_break() {
                return Err(Stopped.into());
            }
            let painted: Vec<Rows> = some
                .par_iter()
                .zip(first..first + some.len())
                .map(|(list, piece)| laid.paint(piece, list))
                .collect();
            painted.iter().try_for_each(&mut each)?;
        }
    }
    Ok(())
}

impl<'a> Laid<'a> {
    fn new(layer: &'a Layer, film: &Film) -> Self {
        let [across, down] = film.size;
        let row = (across as usize + 1) * layer.channels.len() * size_of::<f64>();
        let rows = ((PIECE / row).max(1) as u32).min(down);
        let last = down.div_ceil(rows) - 1;
        let maps: Vec<DAffine2> = layer.copies.iter().map(|&c| film.pixels_from_image(c)).collect();
        let mut touched = Vec::with_capacity(maps.len() * layer.patches.len());
        for map in &maps {
            for patch in &layer.patches {
                let start = patch.corners.0 as usize;
                let corners = &layer.corners[start..start + patch.corners.1 as usize];
                let heights =
                    corners.iter().map(|&c| map.matrix2.x_axis.y * c.x + map.matrix2.y_axis.y * c.y);
                let (low, high) = span(heights);
                let piece = |y: f64| (((y + map.translation.y) / f64::from(rows)) as u32).min(last);
                touched.push((piece(low), piece(high)));
            }
        }
        Self { layer, film: *film, rows, maps, touched }
    }

    /// Returns the number of pieces.
    fn count(&self) -> usize {
        self.film.size[1].div_ceil(self.rows) as usize
    }

    /// Returns the patches that touch each of some pieces, as (copy, patch), in the order in which they are painted.
    fn listed(&self, pieces: Range<usize>) -> Vec<Vec<(u16, u32)>> {
        let mut lists = vec![vec![]; pieces.len()];
        let patches = self.layer.patches.len().max(1);
        for (place, &(low, high)) in self.touched.iter().enumerate() {
            let from = (low as usize).max(pieces.start) - pieces.start;
            let to = (high as usize + 1).min(pieces.end).saturating_sub(pieces.start);
            if from < to {
                let patch = ((place / patches) as u16, (place % patches) as u32);
                lists[from..to].iter_mut().for_each(|list| list.push(patch));
            }
        }
        lists
    }

    fn paint(&self, piece: usize, touching: &[(u16, u32)]) -> Rows {
        let first = piece as u32 * self.rows;
        let count = self.rows.min(self.film.size[1] - first);
        let mut rows = Rows::new(first, count, self.film.size[0], self.layer.channels.len());
        let mut polygon: Vec<DVec2> = vec![];
        for &(copy, patch) in touching {
            let patch = self.layer.patches[patch as usize];
            let (start, n) = (patch.corners.0 as usize, patch.corners.1 as usize);
            let map = self.maps[copy as usize];
            polygon.clear();
            polygon.extend(self.layer.corners[start..start + n].iter().map(|&c| map.transform_point2(c)));
            rows.add(&polygon, patch.channel as usize, patch.weight);
        }
        rows.summed()
    }
}
