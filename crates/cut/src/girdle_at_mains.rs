//! The girdle's edges where mains meet it: the places at which the trade measures the thickness of a girdle, and from which it
//! counts the height of the crown and the depth of the pavilion.
//!
//! Between the mains a girdle is scalloped, so its edges rise and fall. The upper edge is highest, and the lower one lowest,
//! at the mains of a brilliant and between two halves; these places are the hills of an edge.

use super::facet_zones::{EXACT, FacetZones};
use brillianteer_math::{Facet, Polytope};
use glam::{DVec2, DVec3};
use std::collections::BTreeSet;

/// Two heights that differ by less than this, in widths of the stone, are one. It is above the last digit of cutters' files.
const LEVEL: f64 = 2e-6;

/// A facet reaches the girdle if a corner of it lies nearer than this to one of the girdle's, in widths of the stone.
const REACHES: f64 = 1e-5;

/// A facet of a circle reaches the girdle as well if its plane, in the middle of its own side of the rim, lies beyond the girdle's
/// edge by less than this, in widths of the stone.
///
/// Mains meet the girdle in a point between two halves, which lean little from them: noise of 0.3 µm in a plane of a pavilion
/// lets its main end 20 µm short of the girdle, but lifts its plane there by no more than it is itself.
const LIFTED: f64 = 5e-4;

/// A girdle of so many upright facets stands for a circle; one of fewer is a polygon, whose sides often lie below mains.
const MANY: usize = 36;

/// A stone whose girdle is measured.
pub(super) struct MeasuredGirdle<'a> {
    pub stone: &'a Polytope,
    /// The middle of the outline.
    pub middle: DVec2,
    pub width: f64,
    /// The radius of the circle that holds the corners of a round outline; `None` for any other outline.
    pub radius: Option<f64>,
}

impl MeasuredGirdle<'_> {
    /// Returns the heights z of the girdle's edges at its hills, the lower first; `None` without upright facets, or where no
    /// leaning facets reach them, or where the girdle has no thickness between its hills.
    ///
    /// The girdle of a round stone is measured where the planes of the facets that reach it come lowest on its outline, each at
    /// its own azimuth. An outline of many sides counts as the circle that it stands for, so the number of girdle facets has no
    /// effect. The girdle of any other stone is measured at its corners.
    pub fn edges(&self) -> Option<(f64, f64)> {
        let zones = FacetZones::of(self.stone);
        let upright = || self.stone.facets().iter().filter(|facet| zones.is_girdle(facet));
        let corners: BTreeSet<u32> = upright().flat_map(|facet| facet.outline.iter().copied()).collect();
        let is_circle = upright().count() >= MANY;
        let hill = |sign: f64| {
            let leans = |facet: &&Facet| !zones.is_girdle(facet) && sign * facet.plane.normal.z > 0.0;
            let side: Vec<&Facet> = self.stone.facets().iter().filter(leans).collect();
            let along = match self.radius {
                Some(radius) => self.at_rim(&side, &corners, is_circle.then_some(radius)),
                None => self.at_corners(&side, &corners),
            };
            self.mean_of_hills(along.into_iter().map(|(azimuth, height)| (azimuth, sign * height)).collect())
        };
        let (lower, upper) = (-hill(-1.0)?, hill(1.0)?);
        (lower <= upper).then_some((lower, upper))
    }

    /// Returns the azimuths of the facets that reach the girdle, and the heights at which their planes meet the
    /// circle of this radius, or come lowest on the outline.
    fn at_rim(&self, side: &[&Facet], corners: &BTreeSet<u32>, radius: Option<f64>) -> Vec<(f64, f64)> {
        let vertices = self.stone.vertices();
        let near =
            |at: &DVec3| corners.iter().any(|k| vertices[*k as usize].distance(*at) < REACHES * self.width);
        let reaches = |facet: &Facet| {
            facet.outline.iter().any(|k| corners.contains(k)) || self.stone.corners(facet).any(|at| near(&at))
        };
        let leaning = || side.iter().copied().filter(|facet| facet.plane.normal.truncate().length() >= EXACT);
        let height_at = |facet: &Facet, rim: DVec2| {
            (facet.plane.offset - facet.plane.normal.truncate().dot(rim)) / facet.plane.normal.z
        };
        // Whether a plane meets the circle hardly beyond the edge that the planes have there.
        let is_near = |facet: &Facet, rim: DVec2| {
            let sign = facet.plane.normal.z.signum();
            let edge = leaning().map(|other| sign * height_at(other, rim)).fold(f64::INFINITY, f64::min);
            sign * height_at(facet, rim) - edge < LIFTED * self.width
        };
        let along = |facet: &Facet| {
            let across = facet.plane.normal.truncate();
            let height = match radius {
                Some(radius) => {
                    let rim = self.middle + across * (radius / across.length());
                    (reaches(facet) || is_near(facet, rim)).then(|| height_at(facet, rim))
                }
                None => {
                    let of_corners = corners.iter().map(|k| across.dot(vertices[*k as usize].truncate()));
                    let rim = of_corners.fold(f64::NEG_INFINITY, f64::max);
                    reaches(facet).then_some((facet.plane.offset - rim) / facet.plane.normal.z)
                }
            };
            Some((across.to_angle(), height?))
        };
        leaning().filter_map(along).collect()
    }

    /// Returns the azimuths and the heights of the corners in which facets of a side meet the girdle.
    fn at_corners(&self, side: &[&Facet], corners: &BTreeSet<u32>) -> Vec<(f64, f64)> {
        let of_side: BTreeSet<u32> = side.iter().flat_map(|facet| facet.outline.iter().copied()).collect();
        let at = |k: &u32| {
            let corner = self.stone.vertices()[*k as usize];
            ((corner.truncate() - self.middle).to_angle(), corner.z)
        };
        corners.intersection(&of_side).map(at).collect()
    }

    /// Returns the mean of the heights that no neighbour around the stone exceeds; `None` of an empty list.
    fn mean_of_hills(&self, mut along: Vec<(f64, f64)>) -> Option<f64> {
        along.sort_by(|a, b| a.0.total_cmp(&b.0));
        let heights: Vec<f64> = along.into_iter().map(|(_, height)| height).collect();
        let count = heights.len();
        let nearest = LEVEL * self.width;
        // The next height either way that differs decides, so that a level stretch is a hill as a whole.
        let is_hill = |place: usize| {
            [1, count - 1].into_iter().all(|step| {
                let others = (1..count).map(|far| heights[(place + far * step) % count]);
                let mut others = others.filter(|other| (other - heights[place]).abs() > nearest);
                others.next().is_none_or(|other| other < heights[place])
            })
        };
        let hills: Vec<f64> =
            (0..count).filter(|place| is_hill(*place)).map(|place| heights[place]).collect();
        (!hills.is_empty()).then(|| hills.iter().sum::<f64>() / hills.len() as f64)
    }
}
