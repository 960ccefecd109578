//! Paints a layer some rows at a time, so that a picture may be larger than memory.

use super::Rows;
use super::layer::Layer;
use crate::math::span;
use crate::scene::Film;
use crate::trace::{Stopped, Watch};
use glam::{DAffine2, DVec2};
use rayon::prelude::*;

/// Size of one piece of rows in bytes: enough to be worth a task, few enough to stay in a core's cache.
const PIECE: usize = 1 << 21;

/// The number of pieces painted in parallel before they are handed on.
const AT_ONCE: usize = 8;

/// A layer laid out on a film, ready to be painted.
struct Laid<'a> {
    layer: &'a Layer,
    film: Film,
    rows: u32,
    maps: Vec<DAffine2>,
    /// For each piece, the patches that touch it, as (copy, patch).
    pieces: Vec<Vec<(u16, u32)>>,
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
    let pieces: Vec<usize> = (0..laid.pieces.len()).collect();
    for some in pieces.chunks(AT_ONCE) {
        if watch(some[0] as f64 / pieces.len() as f64).is_break() {
            return Err(Stopped.into());
        }
        let painted: Vec<Rows> = some.par_iter().map(|&piece| laid.paint(piece)).collect();
        painted.iter().try_for_each(&mut each)?;
    }
    Ok(())
}

impl<'a> Laid<'a> {
    fn new(layer: &'a Layer, film: &Film) -> Self {
        let [across, down] = film.size;
        let row = (across as usize + 1) * layer.channels.len() * size_of::<f64>();
        let rows = ((PIECE / row).max(1) as u32).min(down);
        let count = down.div_ceil(rows) as usize;
        let maps: Vec<DAffine2> = layer.copies.iter().map(|&c| film.pixels_from_image(c)).collect();
        let mut pieces = vec![vec![]; count];
        for (k, map) in maps.iter().enumerate() {
            for (i, patch) in layer.patches.iter().enumerate() {
                let start = patch.corners.0 as usize;
                let corners = &layer.corners[start..start + patch.corners.1 as usize];
                let heights =
                    corners.iter().map(|&c| map.matrix2.x_axis.y * c.x + map.matrix2.y_axis.y * c.y);
                let (low, high) = span(heights);
                let piece = |y: f64| (((y + map.translation.y) / f64::from(rows)) as usize).min(count - 1);
                for touched in &mut pieces[piece(low)..=piece(high)] {
                    touched.push((k as u16, i as u32));
                }
            }
        }
        Self { layer, film: *film, rows, maps, pieces }
    }

    fn paint(&self, piece: usize) -> Rows {
        let first = piece as u32 * self.rows;
        let count = self.rows.min(self.film.size[1] - first);
        let mut rows = Rows::new(first, count, self.film.size[0], self.layer.channels.len());
        let mut polygon: Vec<DVec2> = vec![];
        for &(copy, patch) in &self.pieces[piece] {
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
