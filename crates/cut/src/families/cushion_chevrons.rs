//! A pavilion of chevrons on a bulged outline. On each side, rows of facets in pairs run from near a corner to the
//! middle of the side and down toward the culet like a V, and each corner has one main. The four mains form an X.
//!
//! The rows of half a side share one point, the tip, on the edge of the corner's main. Each row goes through the tip
//! and two points of the line down the middle of the side, so that all rows meet in points. Between the tip and the
//! girdle, the first row adjoins the half facet of the corner at the place between two stations. The construction is
//! this program's own.

use super::super::facet_net::{FacetNet, NoRoom};
use super::girdle::{Girdle, GirdlePlace};
use glam::{DMat3, DVec3};

/// The tiers of the rows, from the girdle to the culet.
const TIERS: [&str; 4] = ["chevron_1", "chevron_2", "chevron_3", "chevron_4"];

/// The numbers of a pavilion of chevrons.
pub struct CushionChevrons<'a> {
    /// The outline, with mains at the middles of sides (even places) and at corners (odd places).
    pub girdle: &'a Girdle,
    /// The girdle's thickness.
    pub thickness: f64,
    /// The slopes of the lines down the middles of the sides, from the girdle to the culet: tangents of angles, one
    /// for each row, at sides whose distance from the axis is half the width.
    pub slopes: Vec<f64>,
    /// The depth of the tips, as a part of the pavilion's depth.
    pub tip: f64,
}

/// Half of a side, with the points that its facets go through.
struct HalfSide {
    /// The points down the middle of the side, from the girdle to the culet.
    middles: Vec<DVec3>,
    /// The place of the girdle between side and corner.
    between: DVec3,
    /// The place of the girdle at the corner.
    corner: DVec3,
    tip: DVec3,
}

impl CushionChevrons<'_> {
    /// Returns the depth of the pavilion, whose rows are equally wide as seen from below.
    pub fn depth(&self) -> f64 {
        self.slopes.iter().sum::<f64>() / self.slopes.len().max(1) as f64
    }

    /// Adds the pavilion.
    ///
    /// # Errors
    /// The tier whose points give no plane, or that cuts off points in which others meet.
    pub fn add_to(&self, net: &mut FacetNet) -> Result<(), NoRoom> {
        let inside = DVec3::NEG_Z * (0.5 * self.thickness);
        let around = self.girdle.mains().len();
        let sides = || self.girdle.mains().step_by(2);
        let (before, mut halves) = (net.count(), vec![]);
        for side in sides() {
            let (next, last) = (side + 1, side + around - 1);
            halves.push(self.half_side(side, next, side)?);
            halves.push(self.half_side(side, last, last)?);
        }
        for HalfSide { between, corner, tip, .. } in &halves {
            net.through("corner_half", [*tip, *corner, *between], inside)?;
        }
        for (row, tier) in TIERS.iter().enumerate().take(self.slopes.len()) {
            for HalfSide { middles, between, tip, .. } in &halves {
                let third = if row == 0 { between } else { tip };
                net.through(tier, [middles[row], middles[row + 1], *third], inside)?;
            }
        }
        for side in sides() {
            net.through("main", self.main(side + 1), inside)?;
        }
        // Rows that turn too far from one to the next, seen from the tip, cut it off, and no facets would meet there.
        let points = |half: &HalfSide| {
            let ends = [half.tip, half.between, half.corner];
            half.middles.iter().copied().chain(ends).collect::<Vec<_>>()
        };
        net.keep(before, &halves.iter().flat_map(points).collect::<Vec<_>>())
    }

    /// Returns a station's place on the lower edge of the girdle.
    fn edge(&self, place: usize) -> DVec3 {
        self.girdle.main(place).at.extend(-self.thickness)
    }

    /// Returns three points of a corner's main.
    fn main(&self, corner: usize) -> [DVec3; 3] {
        let GirdlePlace { normal, .. } = self.girdle.main(corner);
        let edge = self.edge(corner);
        [edge, edge + normal.perp().extend(0.0), DVec3::NEG_Z * (self.thickness + self.depth())]
    }

    /// Returns the half of a side toward a corner. `gap` is the number of the gap between side and corner.
    fn half_side(&self, side: usize, corner: usize, gap: usize) -> Result<HalfSide, NoRoom> {
        let (edge, rows) = (self.edge(side), self.slopes.len().max(1) as f64);
        let mut middles = vec![edge];
        let mut depth = self.thickness;
        for (row, slope) in self.slopes.iter().enumerate() {
            depth += slope / rows;
            let size = 1.0 - (row + 1) as f64 / rows;
            middles.push((edge.truncate() * size).extend(-depth));
        }
        let between = self.girdle.between(gap).extend(-self.thickness);
        let tip = self.tip([middles[0], middles[1], between], self.main(corner));
        let tip = tip.ok_or(NoRoom { tier: "corner_half" })?;
        Ok(HalfSide { middles, between, corner: self.edge(corner), tip })
    }

    /// Returns the point at the tips' depth where two planes meet, each given by three points.
    fn tip(&self, row: [DVec3; 3], main: [DVec3; 3]) -> Option<DVec3> {
        let normal = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a).normalize_or_zero();
        let (row_normal, main_normal) = (normal(row), normal(main));
        let planes = DMat3::from_cols(row_normal, main_normal, DVec3::Z).transpose();
        let depth = self.thickness + self.tip * self.depth();
        let offsets = DVec3::new(row_normal.dot(row[0]), main_normal.dot(main[0]), -depth);
        let tip = planes.inverse() * offsets;
        tip.is_finite().then_some(tip)
    }
}
