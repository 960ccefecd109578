//! Rows of equal facets. Each row is turned by half a step against the row before, and all corners meet in points.
//!
//! Corners lie on rings around the axis, from the girdle's corners to those of the last ring. The rings' radii shrink
//! by one ratio q. A facet of the first row stands on a side of the girdle. Each further facet is a kite, whose lower
//! corner, side corners and tip lie on three successive rings. A kite is flat where these corners lie on one line as
//! seen from the side. This fixes all heights except for one common factor. With c the cosine of half a step, the
//! tangents of the slopes shrink by (c - q) / (1 - q c) from row to row. The construction is this program's own;
//! printed Portuguese cuts (PC 01.028A, B, C) have rings whose ratios differ by a few percent.

use super::super::facet_net::FacetNet;
use super::super::outline::ROUND;
use glam::DVec2;
use std::f64::consts::{FRAC_PI_2, PI};

/// The most rows that one half of a stone may have.
pub const MOST_ROWS: usize = 7;

/// The names of the rows of a crown, from the girdle.
const CROWN_ROWS: [&str; MOST_ROWS] =
    ["crown_row_1", "crown_row_2", "crown_row_3", "crown_row_4", "crown_row_5", "crown_row_6", "crown_row_7"];

/// The names of the rows of a pavilion, from the girdle.
const PAVILION_ROWS: [&str; MOST_ROWS] = [
    "pavilion_row_1",
    "pavilion_row_2",
    "pavilion_row_3",
    "pavilion_row_4",
    "pavilion_row_5",
    "pavilion_row_6",
    "pavilion_row_7",
];

/// The rows of one half of a stone. Lengths are in girdle radii.
#[derive(Debug, Clone, Copy)]
pub struct AlternatingRows {
    /// The number of facets in a row.
    pub facets: usize,
    /// The number of rows, at least 2.
    pub count: usize,
    /// The radius of the last ring, on which the tips of the last row but one lie.
    pub inner: f64,
}

/// The half of a stone on one side of the girdle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StoneHalf {
    /// The half above the girdle.
    Crown,
    /// The half below the girdle.
    Pavilion,
}

impl AlternatingRows {
    /// Returns half a step between neighbouring facets, in radians.
    fn half_step(&self) -> f64 {
        PI / self.facets as f64
    }

    /// Returns the ratio of the radii of neighbouring rings.
    fn shrinking(&self) -> f64 {
        (self.inner / corner_radius(self.facets)).powf(1.0 / (self.count - 1) as f64)
    }

    /// Returns the radius of a ring; ring 0 has the corners of the girdle.
    fn radius(&self, ring: usize) -> f64 {
        corner_radius(self.facets) * self.shrinking().powi(ring as i32)
    }

    /// Returns the tangent of a row's slope where that of the first is 1; 0 or less where the rows leave no room.
    pub fn flattening(&self, row: usize) -> f64 {
        let (q, c) = (self.shrinking(), self.half_step().cos());
        ((c - q) / (1.0 - q * c)).max(0.0).powi(row as i32)
    }

    /// Returns the flattening of the last row.
    pub fn last_flattening(&self) -> f64 {
        self.flattening(self.count - 1)
    }

    /// Returns the height of a ring above the girdle, where the tangent of the first row's slope is 1.
    fn height(&self, ring: usize) -> f64 {
        let c = self.half_step().cos();
        let rise = |row: usize| match row {
            0 => self.radius(0) * c - self.radius(1),
            row => self.flattening(row) * (self.radius(row - 1) - self.radius(row) * c),
        };
        match ring {
            0 => 0.0,
            1 => rise(0),
            ring => rise(0) + (2..=ring).map(rise).sum::<f64>(),
        }
    }

    /// Returns the height of the last ring, where the tangent of the first row's slope is 1.
    pub fn last_ring(&self) -> f64 {
        self.height(self.count - 1)
    }

    /// Returns the height of the point in which the last row meets, where the tangent of the first row's slope is 1.
    pub fn point(&self) -> f64 {
        self.height(self.count - 2) + self.last_flattening() * self.radius(self.count - 2)
    }

    /// Adds the facets, row by row from the girdle, at most [`MOST_ROWS`] of them. `edge` is the height of the girdle's edge,
    /// and `slope` the tangent of the first row's slope.
    pub fn add_to(&self, net: &mut FacetNet, half: StoneHalf, edge: f64, slope: f64) {
        let (up, tiers) = match half {
            StoneHalf::Crown => (1.0, CROWN_ROWS),
            StoneHalf::Pavilion => (-1.0, PAVILION_ROWS),
        };
        for (row, tier) in tiers.iter().take(self.count).enumerate() {
            let tangent = slope * self.flattening(row);
            // The point is the lower end of the facet at the facet's own azimuth: the middle of a girdle's side, or a
            // corner of a ring.
            let (radius, height) = match row {
                0 => (self.radius(0) * self.half_step().cos(), 0.0),
                row => (self.radius(row - 1), slope * self.height(row - 1)),
            };
            for facet in 0..self.facets {
                let out = direction(self.facets, facet as f64 + 0.5 * (row % 2) as f64);
                let at = (out * radius).extend(edge + up * height);
                net.plane(tier, (out * tangent).extend(up), at);
            }
        }
    }
}

/// Adds the upright facets of a girdle, one below each facet of the first row.
pub fn add_girdle(net: &mut FacetNet, facets: usize) {
    for facet in 0..facets {
        let out = direction(facets, facet as f64);
        let distance = corner_radius(facets) * (PI / facets as f64).cos();
        net.plane("girdle", out.extend(0.0), (out * distance).extend(0.0));
    }
}

/// Returns the direction at a number of `count` equal steps. Step 0 lies along y, so that the stone is its own mirror
/// image in the plane of y and z for any count.
pub fn direction(count: usize, place: f64) -> DVec2 {
    let quarters = 4.0 * place / count as f64;
    // Quarters are exact, so that the extents of stones are exact.
    match quarters.rem_euclid(4.0) {
        0.0 => DVec2::Y,
        1.0 => DVec2::NEG_X,
        2.0 => DVec2::NEG_Y,
        3.0 => DVec2::X,
        quarters => DVec2::from_angle(FRAC_PI_2 * (1.0 + quarters)),
    }
}

/// Returns the radius of the corners of a regular polygon whose [diameter](crate::Outline::diameter) is 2: it is
/// 1 where the polygon counts as round, and otherwise gives the polygon a width of 2.
pub fn corner_radius(sides: usize) -> f64 {
    let inner = (PI / sides as f64).cos();
    let width = if sides.is_multiple_of(2) { 2.0 * inner } else { 1.0 + inner };
    if width >= 2.0 * ROUND { 1.0 } else { 2.0 / width.max(f64::MIN_POSITIVE) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_math::Polytope;

    /// The angles of PC 01.028A in degrees, row by row from the girdle, and the radius of its last ring: those of the
    /// pavilion, then those of the crown.
    const PRINTED: [(&[f64], f64); 2] =
        [(&[60.0, 56.0, 52.0, 48.0, 44.0, 40.0], 0.264), (&[52.0, 45.0, 40.0, 35.0, 30.0], 0.4585)];

    #[test]
    fn rows_of_a_printed_portuguese_are_found_within_two_degrees() {
        for (angles, inner) in PRINTED {
            let rows = AlternatingRows { facets: 16, count: angles.len(), inner };
            for (row, angle) in angles.iter().enumerate() {
                let found = (angles[0].to_radians().tan() * rows.flattening(row)).atan().to_degrees();
                assert!((found - angle).abs() < 2.0, "row {row}: {found} for {angle}");
            }
        }
    }

    #[test]
    fn every_corner_of_the_rings_is_a_point_where_the_stone_has_a_corner() {
        for (facets, count) in [(8, 2), (9, 3), (16, 5), (32, 7)] {
            let rows = AlternatingRows { facets, count, inner: 0.3 };
            let mut net = FacetNet::default();
            rows.add_to(&mut net, StoneHalf::Crown, 0.0, 1.5);
            rows.add_to(&mut net, StoneHalf::Pavilion, 0.0, 0.5);
            let planes: Vec<_> = net.named().into_iter().map(|(_, plane)| plane).collect();
            let stone = Polytope::from_planes(&planes).unwrap();
            // The girdle's ring belongs to both sides, and the stone ends in two points.
            assert_eq!(stone.vertices().len(), facets * (2 * count - 1) + 2, "{facets} by {count}");
            for ring in 0..count {
                let out = direction(facets, 0.5 * ((ring + 1) % 2) as f64);
                let at: glam::DVec3 = (out * rows.radius(ring)).extend(1.5 * rows.height(ring));
                let nearest = stone.vertices().iter().map(|corner| corner.distance(at)).fold(1.0, f64::min);
                assert!(nearest < 1e-9, "ring {ring} of {facets} by {count}: {nearest}");
            }
        }
    }

    #[test]
    fn outlines_are_two_wide_at_their_narrowest_or_round() {
        for (sides, radius) in [(4, 2.0_f64.sqrt()), (6, 1.0 / (PI / 6.0).cos()), (8, 1.0 / (PI / 8.0).cos())]
        {
            assert!((corner_radius(sides) - radius).abs() < 1e-12, "{sides}");
        }
        // The least width of a triangle is its height.
        assert!((corner_radius(3) * 1.5 - 2.0).abs() < 1e-12);
        assert_eq!([7, 9, 10, 16].map(corner_radius), [1.0; 4]);
    }
}
