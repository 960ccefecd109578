//! Draws pictures of functions with smooth edges: one sample in each pixel, and more where neighbours differ.

use brillianteer_optics::LUMINANCE;
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use std::ops::Range;

/// The places of the samples in a pixel where neighbours differ, no two in one row or column.
const PLACES: [DVec2; 4] =
    [DVec2::new(0.125, 0.375), DVec2::new(0.375, 0.875), DVec2::new(0.625, 0.125), DVec2::new(0.875, 0.625)];

/// The footprint of each of these, as a share of the pixel.
const SHARE: f64 = 0.6;

/// The greatest difference in brightness of neighbours that get one sample, on a scale from 0 to 1.
const EVEN: f64 = 0.06;

/// The light at the middle of the scale of brightness.
const MIDDLE: f64 = 0.3;

/// Draws some rows of a picture, one after the other. `sample` returns the light at a place, in pixels from the first corner
/// of the whole picture, averaged over a share of a pixel.
pub(super) fn drawn(
    [width, height]: [usize; 2],
    rows: Range<usize>,
    sample: impl Fn(DVec2, f64) -> DVec3 + Sync,
) -> Vec<DVec3> {
    // Edges are smoothed by the rows beside them.
    let (above, below) = (rows.start.saturating_sub(1), (rows.end + 1).min(height));
    let height = below - above;
    let corner = |k: usize| DVec2::new((k % width) as f64, (above + k / width) as f64);
    let first: Vec<DVec3> =
        (0..width * height).into_par_iter().map(|k| sample(corner(k) + 0.5, 1.0)).collect();
    let shades: Vec<f32> = first.iter().map(|&light| shade(light)).collect();
    let differs = |k: usize| {
        let (x, y) = (k % width, k / width);
        let beside = [k - usize::from(x > 0), k + usize::from(x + 1 < width)];
        let over = [k - if y > 0 { width } else { 0 }, k + if y + 1 < height { width } else { 0 }];
        let all = beside.into_iter().chain(over).map(|k| shades[k]);
        let (low, high) = all.fold((shades[k], shades[k]), |(low, high), s| (low.min(s), high.max(s)));
        f64::from(high - low) > EVEN
    };
    let light = |k: usize| {
        if !differs(k) {
            return first[k];
        }
        PLACES.iter().map(|&place| sample(corner(k) + place, SHARE)).sum::<DVec3>() / PLACES.len() as f64
    };
    ((rows.start - above) * width..(rows.end - above) * width).into_par_iter().map(light).collect()
}

/// Returns the brightness of light on a scale that ends at 1.
fn shade(light: DVec3) -> f32 {
    let luminance = light.dot(DVec3::from_array(LUMINANCE.map(f64::from)));
    (luminance / (luminance + MIDDLE)) as f32
}
