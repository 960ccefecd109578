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
}

impl GirdlePlace {
    /// Returns the place of an outline that is larger by a factor.
    pub fn scaled(self, factor: f64) -> Self {
        Self { at: factor * self.at, ..self }
    }
}

/// An outline, counter-clockwise, with a main facet at every second station: closed, or the half on the side of +x of an
/// outline that its mirror image completes.
///
/// Stations alternate between those where a main touches the outline and those where two half facets part. Between two
/// stations the girdle has a number of upright facets. They touch the curve in their middles, so that length and width are
/// the distances of opposite facets.
pub struct Girdle {
    stations: Vec<GirdlePlace>,
    /// The places where upright facets touch the curve.
    upright: Vec<GirdlePlace>,
    /// Whether the outline is one half, whose first and last stations lie at x = 0.
    is_half: bool,
}

impl Girdle {
    /// Divides a curve into stations. `curve` takes the way around, from 0 to 1, to a place; equal parts of this way lie
    /// between the stations of `mains` main facets, and `upright` girdle facets belong to each station.
    pub fn new(mains: usize, upright: usize, curve: impl Fn(f64) -> GirdlePlace) -> Self {
        let (stations, upright) = (2 * mains.max(2), upright.max(1));
        let places = |count: usize| (0..count).map(|place| curve(place as f64 / count as f64)).collect();
        Self { stations: places(stations), upright: places(stations * upright), is_half: false }
    }

    /// Divides one half of an outline, on the side of +x: `curve` begins and ends at x = 0, with a main at both ends, and
    /// this leaves `gaps` gaps between mains.
    pub fn half(gaps: usize, upright: usize, curve: impl Fn(f64) -> GirdlePlace) -> Self {
        let (steps, upright) = (2 * gaps.max(2), upright.max(1));
        let places = |count: usize| (0..=count).map(|place| curve(place as f64 / count as f64)).collect();
        Self { stations: places(steps), upright: places(steps * upright), is_half: true }
    }

    /// Adds an upright facet that touches the outline at a place, so that the outline reaches no farther there.
    pub fn touch(&mut self, place: GirdlePlace) {
        self.upright.push(place);
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
        for GirdlePlace { at, normal } in &self.upright {
            net.plane("girdle", normal.extend(0.0), at.extend(0.0));
        }
    }
}
