//! Step cuts on an outline of straight sides: rows of facets whose edges run level, parallel to the girdle.
//!
//! Between one level line and the next, each side moves inward at a steady rate of its own. With rates that bring all
//! sides to one line or point together, the level lines shrink evenly. The edges between the sides then run straight
//! from the girdle's corners to the ends of this line, as seen from above, and every row has a facet on every side.
//! The rates follow from the outline and this line (the keel): a side at the distance d with the normal n moves by d
//! minus the keel's reach along n. The profile is convex because each row is flatter than the row before. The
//! construction is this program's own.

use super::super::facet_net::{FacetNet, NoRoom};
use super::super::family_cut::FamilyCut;
use glam::{DVec2, DVec3};

const CROWN: [&str; 5] = ["crown_1", "crown_2", "crown_3", "crown_4", "crown_5"];
const PAVILION: [&str; 5] = ["pavilion_1", "pavilion_2", "pavilion_3", "pavilion_4", "pavilion_5"];

/// A straight side of the outline, seen from above. Lengths are in girdle radii.
#[derive(Debug, Clone, Copy)]
pub struct StepSide {
    /// The unit normal, outward.
    pub normal: DVec2,
    /// The distance from the origin.
    pub distance: f64,
    /// The distance by which the side moves inward in the crown while a side of rate 1 moves by 1.
    pub crown_rate: f64,
    /// The same distance in the pavilion.
    pub pavilion_rate: f64,
}

impl StepSide {
    /// Makes a side through a point. Level lines of the crown and of the pavilion shrink to segments along the width and
    /// length, of these half-lengths, about the origin.
    pub fn toward(normal: DVec2, through: DVec2, crown: DVec2, pavilion: DVec2) -> Self {
        let normal = normal.normalize_or(DVec2::X);
        let distance = normal.dot(through);
        let rate = |segment: DVec2| distance - normal.abs().dot(segment);
        Self { normal, distance, crown_rate: rate(crown), pavilion_rate: rate(pavilion) }
    }
}

impl StepSide {
    /// Returns all sides of an outline whose level lines shrink evenly. `quarter` holds those of the first quarter,
    /// each by its normal and a point; their mirror images are added. `size` is half of width and length.
    pub fn around(quarter: &[(DVec2, DVec2)], size: DVec2) -> Vec<Self> {
        let even = size - size.min_element();
        let mut all: Vec<Self> = vec![];
        for (normal, at) in quarter {
            for sign in [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)].map(DVec2::from) {
                let side = Self::toward(normal * sign, at * sign, even, even);
                if all.iter().all(|other| other.normal != side.normal) {
                    all.push(side);
                }
            }
        }
        all
    }
}

/// The rows of a crown or of a pavilion, equally wide seen from above.
#[derive(Debug, Clone, Copy)]
pub struct StepRows {
    /// The number of rows, 1 to 5.
    pub count: usize,
    /// The slope of all rows together, in degrees.
    pub slope: f64,
    /// The angle by which each row is steeper than the next, in degrees.
    pub step: f64,
    /// The distance by which a side of rate 1 moves inward over all rows.
    pub reach: f64,
}

impl StepRows {
    /// Returns the rows for count, slope and step from three places of a table.
    pub fn of(cut: &FamilyCut, [count, slope, step]: [usize; 3], reach: f64) -> Self {
        Self { count: cut[count] as usize, slope: cut[slope], step: cut[step], reach }
    }

    /// Returns the tangents of the rows' angles, the steepest first. Their mean is the tangent of the slope as a
    /// whole. `None` where the steps leave no room between level and upright.
    pub fn tangents(&self) -> Option<Vec<f64>> {
        let count = self.count.max(1);
        let spread = 0.5 * self.step * (count - 1) as f64;
        let at = |middle: f64| -> Vec<f64> {
            let angles = (0..count).map(|row| middle + spread - self.step * row as f64);
            angles.map(|angle| angle.to_radians().tan()).collect()
        };
        let wanted = self.slope.to_radians().tan();
        let excess = |middle: f64| at(middle).iter().sum::<f64>() / count as f64 - wanted;
        if count == 1 {
            return Some(vec![wanted]);
        }
        // The mean tangent rises with the middle angle, which lies between those at which the last row is level and
        // the first row is upright.
        let (mut low, mut high) = (spread, 90.0 - spread);
        if low >= high || excess(low) >= 0.0 {
            return None;
        }
        loop {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                return Some(at(low));
            }
            *(if excess(middle) < 0.0 { &mut low } else { &mut high }) = middle;
        }
    }

    /// Returns the height of all rows together, in girdle radii.
    pub fn height(&self) -> f64 {
        self.reach * self.slope.to_radians().tan()
    }

    /// Returns the tangent of the last row's angle; 0 where the steps leave no room, because that row would lie
    /// level.
    fn last_tangent(&self) -> f64 {
        self.tangents().and_then(|rows| rows.last().copied()).unwrap_or(0.0)
    }

    /// Adds a facet of each row on each side. The rows begin at the height `from`; `up` is 1 for a crown and -1 for a
    /// pavilion.
    fn add_to(
        &self,
        net: &mut FacetNet,
        tiers: [&'static str; 5],
        sides: &[StepSide],
        from: f64,
        up: f64,
    ) -> Result<(), NoRoom> {
        let rows = self.tangents().ok_or(NoRoom { tier: tiers[0] })?;
        let width = self.reach / rows.len() as f64;
        let mut height = from;
        for (row, (tier, tangent)) in tiers.into_iter().zip(rows).enumerate() {
            let inset = width * row as f64;
            for side in sides {
                let rate = if up > 0.0 { side.crown_rate } else { side.pavilion_rate };
                if rate <= 0.0 {
                    return Err(NoRoom { tier });
                }
                let edge = side.normal * (side.distance - rate * inset);
                net.plane(tier, (side.normal * tangent).extend(up * rate), edge.extend(height));
            }
            height += up * tangent * width;
        }
        Ok(())
    }

    /// Adds the table and the rows of a crown.
    ///
    /// # Errors
    /// Fails with the tier of the row that has no room.
    pub fn add_crown(&self, net: &mut FacetNet, sides: &[StepSide]) -> Result<(), NoRoom> {
        net.plane("table", DVec3::Z, DVec3::Z * self.height());
        self.add_to(net, CROWN, sides, 0.0, 1.0)
    }

    /// Adds the rows of a pavilion below a girdle of this thickness.
    ///
    /// # Errors
    /// Fails with the tier of the row that has no room.
    pub fn add_pavilion(&self, net: &mut FacetNet, sides: &[StepSide], thickness: f64) -> Result<(), NoRoom> {
        self.add_to(net, PAVILION, sides, -thickness, -1.0)
    }
}

/// Adds an upright facet on each side.
pub fn add_girdle(net: &mut FacetNet, sides: &[StepSide], thickness: f64) {
    if thickness > 0.0 {
        for side in sides {
            net.plane("girdle", side.normal.extend(0.0), (side.normal * side.distance).extend(0.0));
        }
    }
}

/// The profile of a step cut, seen from the side. Lengths are in girdle radii.
#[derive(Debug, Clone, Copy)]
pub struct StepProfile {
    pub crown: StepRows,
    /// The girdle's thickness.
    pub thickness: f64,
    pub pavilion: StepRows,
    /// The distance by which a side of rate 1 still moves inward below the rows of the pavilion, where the last row
    /// continues.
    pub below: f64,
}

impl StepProfile {
    /// Returns the height of the whole stone.
    pub fn depth(&self) -> f64 {
        let Self { crown, thickness, pavilion, below } = self;
        let below = if *below > 0.0 { below * pavilion.last_tangent() } else { 0.0 };
        crown.height() + thickness + pavilion.height() + below
    }
}

/// The places, in the table of a family, of the numbers that make the profile of a step cut.
#[derive(Debug, Clone, Copy)]
pub struct StepPlaces {
    /// The place of the table's width.
    pub table: usize,
    /// The places of the crown's count, slope and step.
    pub crown: [usize; 3],
    /// The places of the pavilion's count, slope and step.
    pub pavilion: [usize; 3],
    /// The place of the girdle's thickness.
    pub girdle: usize,
}

impl StepPlaces {
    /// Returns the rows of crown and pavilion, and the girdle between them. Sides move inward by `reach` in the pavilion.
    pub fn profile(&self, cut: &FamilyCut, reach: f64) -> StepProfile {
        let crown = StepRows::of(cut, self.crown, 1.0 - cut[self.table] / 100.0);
        let pavilion = StepRows::of(cut, self.pavilion, reach);
        StepProfile { crown, thickness: cut[self.girdle] / 50.0, pavilion, below: 0.0 }
    }
}

/// Makes all facets of a step cut.
///
/// # Errors
/// Fails with the tier that has no room.
pub fn net(sides: &[StepSide], profile: StepProfile) -> Result<FacetNet, NoRoom> {
    let StepProfile { crown, thickness, pavilion, .. } = profile;
    let mut net = FacetNet::default();
    crown.add_crown(&mut net, sides)?;
    add_girdle(&mut net, sides, thickness);
    pavilion.add_pavilion(&mut net, sides, thickness)?;
    Ok(net)
}

/// A rectangle of half the width 1, with or without its corners.
#[derive(Debug, Clone, Copy)]
pub struct Rectangle {
    /// Half of the length.
    pub length: f64,
    /// The length that a corner cuts off each side; 0 leaves sharp corners.
    pub corner: f64,
    /// The keel's length as a part of the length of a keel between ends as steep as the sides.
    pub keel: f64,
}

impl Rectangle {
    /// Returns half of the shorter side, which is the distance that sides move inward until they meet.
    pub fn reach(&self) -> f64 {
        self.length.min(1.0)
    }

    /// Makes all facets of a step cut on this outline, whose numbers stand at these places.
    ///
    /// # Errors
    /// Fails with the tier that has no room.
    pub fn net(&self, cut: &FamilyCut, places: &StepPlaces) -> Result<FacetNet, NoRoom> {
        net(&self.sides(), places.profile(cut, self.reach()))
    }

    /// Returns the sides, counter-clockwise from +x.
    pub fn sides(&self) -> Vec<StepSide> {
        let Self { length, corner, keel } = *self;
        let size = DVec2::new(1.0, length);
        let even = size - self.reach();
        let to = |normal: DVec2, through: DVec2| StepSide::toward(normal, through, even, even * keel);
        let (across, along) = (DVec2::new(1.0, 0.0), DVec2::new(0.0, 1.0));
        let signs =
            [DVec2::new(1.0, 1.0), DVec2::new(-1.0, 1.0), DVec2::new(-1.0, -1.0), DVec2::new(1.0, -1.0)];
        let straight = [across, along, -across, -along];
        let quarter = |(main, sign): (DVec2, DVec2)| {
            let cut = (corner > 0.0).then(|| to(sign, sign * size - DVec2::new(0.0, sign.y * corner)));
            [Some(to(main, main * size)), cut].into_iter().flatten()
        };
        straight.into_iter().zip(signs).flat_map(quarter).collect()
    }
}
