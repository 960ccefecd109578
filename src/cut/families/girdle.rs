//! The girdle's outline of a fancy cut: a convex curve, divided where facets meet on it.

use super::super::facet_net::FacetNet;
use glam::{DVec2, DVec3};
use std::ops::Range;

/// A place on the outline, seen from above. Lengths are in girdle radii.
#[derive(Debug, Clone, Copy)]
pub struct Station {
    /// The point of the outline.
    pub at: DVec2,
    /// The unit normal of the outline there, outward. Where the outline has a corner, it lies between those of both sides.
    pub normal: DVec2,
}

/// A closed outline, counter-clockwise, with a main facet at every second station.
///
/// Stations alternate between those where a main touches the outline and those where two half facets part. Between two
/// stations the girdle has a number of upright facets, whose edges stand on the curve.
pub struct Girdle {
    stations: Vec<Station>,
    /// The corners of the girdle from each station to the next, without the latter.
    corners: Vec<Vec<DVec2>>,
}

impl Girdle {
    /// Divides a curve into stations. `curve` takes the way around, from 0 to 1, to a place; equal parts of this way lie
    /// between the stations of `mains` main facets, and each part between stations has `upright` girdle facets.
    pub fn new(mains: usize, upright: usize, curve: impl Fn(f64) -> Station) -> Self {
        let (mains, upright) = (mains.max(2), upright.max(1));
        let way = |station: usize, corner: usize| {
            (station as f64 + corner as f64 / upright as f64) / (2 * mains) as f64
        };
        Self {
            stations: (0..2 * mains).map(|station| curve(way(station, 0))).collect(),
            corners: (0..2 * mains)
                .map(|station| (0..upright).map(|corner| curve(way(station, corner)).at).collect())
                .collect(),
        }
    }

    /// Returns the places of the mains.
    pub fn mains(&self) -> Range<usize> {
        0..self.stations.len() / 2
    }

    /// Returns the station of a main; numbers run on around the outline.
    pub fn main(&self, number: usize) -> Station {
        self.stations[2 * number % self.stations.len()]
    }

    /// Returns the point between a main and the next, where two halves part.
    pub fn between(&self, number: usize) -> DVec2 {
        self.stations[(2 * number + 1) % self.stations.len()].at
    }

    /// Adds the upright facets.
    pub fn add_to(&self, net: &mut FacetNet) {
        let corners: Vec<DVec2> = self.corners.iter().flatten().copied().collect();
        for (corner, next) in corners.iter().zip(corners.iter().cycle().skip(1)) {
            let along = *next - *corner;
            net.plane("girdle", DVec3::new(along.y, -along.x, 0.0), corner.extend(0.0));
        }
    }
}
