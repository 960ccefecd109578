//! The girdle's outline of a fancy cut: a convex curve, which is divided where facets meet on it.

use super::super::facet_net::FacetNet;
use glam::DVec2;
use std::ops::Range;

/// A place on the outline, seen from above. Lengths are in girdle radii.
#[derive(Debug, Clone, Copy)]
pub struct GirdlePlace {
    /// The point of the outline.
    pub at: DVec2,
    /// The outward unit normal of the outline there. At a corner of the outline, it lies between the normals of both
    /// sides.
    pub normal: DVec2,
    /// True where the outline has a corner.
    pub is_corner: bool,
}

/// The number of upright facets between a corner of the outline and the next station. Where a main touches the outline,
/// three and a half take their place: half of the facet at the main, and three more.
const UPRIGHT: usize = 4;

/// An outline, counter-clockwise, with a main at every second station. It is closed, or it is the half on the side of
/// +x of an outline that its mirror image completes.
///
/// Stations alternate between those where a main touches the outline and those where two half facets part. Between
/// two stations the girdle has several upright facets. At a main, one of them touches the curve, so that length and
/// width are the distances of opposite facets. Where halves part, and where the outline has a corner, two upright
/// facets meet in a point of the curve, in which all facets there end. The other upright facets meet in points of the
/// curve as well.
pub struct Girdle {
    stations: Vec<GirdlePlace>,
    /// The upright facets, each by a point and its normal.
    upright: Vec<(DVec2, DVec2)>,
    /// True where the outline is one half, whose first and last stations lie at x = 0.
    is_half: bool,
}

impl Girdle {
    /// Divides a curve into stations. `curve` returns the place at a part of the way around, from 0 to 1; equal parts
    /// of this way lie between the stations of `mains` main facets.
    pub fn new(mains: usize, curve: impl Fn(f64) -> GirdlePlace) -> Self {
        Self::divided(2 * mains.max(2), false, curve)
    }

    /// Divides one half of an outline, on the side of +x, with `gaps` gaps between mains. `curve` begins and ends at
    /// x = 0, with a main at both ends. The outline has a corner at both ends.
    pub fn half(gaps: usize, curve: impl Fn(f64) -> GirdlePlace) -> Self {
        Self::divided(2 * gaps.max(2), true, curve)
    }

    fn divided(steps: usize, is_half: bool, curve: impl Fn(f64) -> GirdlePlace) -> Self {
        let place = |step: f64| curve(step / steps as f64);
        let stations = (0..steps + usize::from(is_half)).map(|step| place(step as f64)).collect();
        let mut girdle = Self { stations, upright: vec![], is_half };
        for step in (0..steps).step_by(2) {
            let (main, next) = (girdle.main(step / 2), girdle.main(step / 2 + 1));
            if !main.is_corner {
                girdle.upright.push((main.at, main.normal));
            }
            let ends = [step as f64, (step + 2) as f64];
            let mut corners: Vec<DVec2> = corner_ways(main).map(|way| place(ends[0] + way).at).collect();
            let back: Vec<DVec2> = corner_ways(next).map(|way| place(ends[1] - way).at).collect();
            corners.extend(back.iter().rev().skip(1));
            let sides = corners.windows(2).map(|ends| (ends[0], -(ends[1] - ends[0]).perp()));
            girdle.upright.extend(sides);
        }
        girdle
    }

    /// Returns a net without facets for a stone with this outline.
    pub fn empty_net(&self) -> FacetNet {
        if self.is_half { FacetNet::half() } else { FacetNet::default() }
    }

    /// Returns the numbers of the mains.
    pub fn mains(&self) -> Range<usize> {
        0..self.stations.len().div_ceil(2)
    }

    /// Returns the numbers of the gaps between a main and the next; a gap has the number of its first main.
    pub fn gaps(&self) -> Range<usize> {
        0..self.stations.len() / 2
    }

    /// Returns the station of a main; numbers continue around the outline.
    pub fn main(&self, number: usize) -> GirdlePlace {
        self.stations[2 * number % self.stations.len()]
    }

    /// Returns the point between a main and the next, where two halves part.
    pub fn between(&self, number: usize) -> DVec2 {
        self.stations[(2 * number + 1) % self.stations.len()].at
    }

    /// Adds the upright facets.
    pub fn add_to(&self, net: &mut FacetNet) {
        for (at, normal) in &self.upright {
            net.plane("girdle", normal.extend(0.0), at.extend(0.0));
        }
    }
}

/// Returns the places where upright facets meet on the curve, as parts of the way from a main to the next place where
/// halves part. At a main that touches the outline, the first place is half a facet away, because one facet touches
/// the curve at the main itself. The last place is the one where halves part.
fn corner_ways(main: GirdlePlace) -> impl Iterator<Item = f64> {
    let (count, first) = if main.is_corner { (UPRIGHT, 0.0) } else { (UPRIGHT - 1, 0.5) };
    (0..=count).map(move |number| (first + number as f64) / (first + count as f64))
}
