//! The girdle's outline of a fancy cut: a convex curve, divided where facets meet on it.

use super::super::facet_net::FacetNet;
use glam::DVec2;
use std::ops::Range;

/// A place on the outline, seen from above. Lengths are in girdle radii.
#[derive(Debug, Clone, Copy)]
pub struct GirdlePlace {
    /// The point of the outline.
    pub at: DVec2,
    /// The unit normal of the outline there, outward. Where the outline has a corner, it lies between those of both sides.
    pub normal: DVec2,
    /// Whether the outline has a corner there.
    pub is_corner: bool,
}

/// How many upright facets lie between a corner of the outline and the next station. Beside a main that touches the outline,
/// half of one belongs to it.
const UPRIGHT: usize = 4;

/// An outline, counter-clockwise, with a main facet at every second station: closed, or the half on the side of +x of an
/// outline that its mirror image completes.
///
/// Stations alternate between those where a main touches the outline and those where two half facets part. Between two
/// stations the girdle has a number of upright facets. One touches the curve where a main does, so that length and width are
/// the distances of opposite facets. Where halves part, and where the outline has a corner, two meet in a point of the curve:
/// all facets that come together there end in one point. The others meet in points of the curve as well.
pub struct Girdle {
    stations: Vec<GirdlePlace>,
    /// The upright facets, each by a point and its normal.
    upright: Vec<(DVec2, DVec2)>,
    /// Whether the outline is one half, whose first and last stations lie at x = 0.
    is_half: bool,
}

impl Girdle {
    /// Divides a curve into stations. `curve` takes the way around, from 0 to 1, to a place; equal parts of this way lie
    /// between the stations of `mains` main facets.
    pub fn new(mains: usize, curve: impl Fn(f64) -> GirdlePlace) -> Self {
        Self::divided(2 * mains.max(2), false, curve)
    }

    /// Divides one half of an outline, on the side of +x: `curve` begins and ends at x = 0, with a main at both ends, and
    /// this leaves `gaps` gaps between mains. The outline has a corner at both ends.
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

    /// Returns the places of the mains.
    pub fn mains(&self) -> Range<usize> {
        0..self.stations.len().div_ceil(2)
    }

    /// Returns the places between a main and the next, each by the number of the first.
    pub fn gaps(&self) -> Range<usize> {
        0..self.stations.len() / 2
    }

    /// Returns the station of a main; numbers run on around the outline.
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

/// Returns where upright facets meet on the curve, as parts of the way from a main to the next place where halves part. At a main
/// that touches the outline the first lies half a facet away, because one facet touches the curve at the main itself. The last is
/// the place where halves part.
fn corner_ways(main: GirdlePlace) -> impl Iterator<Item = f64> {
    let (count, first) = if main.is_corner { (UPRIGHT, 0.0) } else { (UPRIGHT - 1, 0.5) };
    (0..=count).map(move |number| (first + number as f64) / (first + count as f64))
}
