//! Square and rectangular brilliants: a crown with stars, and a pavilion of chevrons.
//!
//! **Crown.** A first row has a facet on each side of the outline. From the corners of its upper edge, triangles rise
//! to the table's corners, which lie above the middles of the sides and above the outline's corners; stars fill the
//! gaps below the table's edges. Table, angles and the stars' azimuth determine everything (after Harding's
//! description of the princess crown: two mains of equal width a side, stars, corners).
//!
//! **Pavilion.** In the plane through the middle of a side and the axis, the profile is a convex line of straight pieces,
//! from the girdle down to the shoulder of the mains, and on to the culet. Each piece and a corner of the girdle give a
//! facet, so that all facets of half a side meet in that corner as in a fan, and those of both halves in the profile: chevrons.
//! The last piece belongs to the mains, which both neighbouring sides have in common, so that they form an X. Where the corners have
//! facets of their own, these end in the point where the innermost chevrons of both sides and the main meet. Every section
//! through the fan is the convex profile again, seen from the corner, so that the stone is convex. Both constructions are this
//! program's own.

use super::super::facet_net::{FacetNet, NoRoom};
use super::steps::{Rectangle, StepRows};
use glam::{DMat3, DVec2, DVec3};
use std::f64::consts::FRAC_1_SQRT_2;

const CHEVRONS: [&str; 5] = ["pavilion_side", "chevron_1", "chevron_2", "chevron_3", "chevron_4"];

/// The signs of the four quarters of a stone.
const QUARTERS: [DVec2; 4] =
    [DVec2::new(1.0, 1.0), DVec2::new(-1.0, 1.0), DVec2::new(-1.0, -1.0), DVec2::new(1.0, -1.0)];

impl Rectangle {
    /// Returns the girdle's corner at the end of the side at +x, in the first quarter.
    fn side_end(&self) -> DVec2 {
        DVec2::new(1.0, self.length - self.corner)
    }

    /// Returns the girdle's corner at the end of the side at +y, in the first quarter.
    fn end_end(&self) -> DVec2 {
        DVec2::new(1.0 - self.corner, self.length)
    }

    /// Returns the distance of the cut corners from the axis.
    pub fn corner_distance(&self) -> f64 {
        (1.0 + self.length - self.corner) * FRAC_1_SQRT_2
    }
}

/// Facets that are made in the first quarter of a stone and repeat in all four. `inside` is the height of a point
/// inside the stone.
#[derive(Debug)]
pub struct Quarters<'a> {
    pub net: &'a mut FacetNet,
    pub inside: f64,
}

impl Quarters<'_> {
    /// Adds the facet through three points, and its mirror images.
    ///
    /// # Errors
    /// Fails with the tier where the points give no plane.
    pub fn through(&mut self, tier: &'static str, points: [DVec3; 3]) -> Result<(), NoRoom> {
        for sign in QUARTERS {
            let image = points.map(|point| point * sign.extend(1.0));
            self.net.through(tier, image, DVec3::Z * self.inside)?;
        }
        Ok(())
    }

    /// Adds the facet through a point whose normal leans along +x or +y, and its mirror image.
    pub fn pair(&mut self, tier: &'static str, normal: DVec3, through: DVec3) {
        for sign in [QUARTERS[0], QUARTERS[2]] {
            self.net.plane(tier, normal * sign.extend(1.0), through * sign.extend(1.0));
        }
    }
}

/// A crown with stars.
#[derive(Debug, Clone, Copy)]
pub struct StarCrown {
    /// The table's part of the width, measured between its corners above the middles of the sides.
    pub table: f64,
    /// The tangents of the angles of the first and of the second main of a side.
    pub mains: [f64; 2],
    /// The angle by which the stars turn away from the sides, in radians, on a square.
    pub star_azimuth: f64,
    /// True where the facets of the corners are divided like those of the sides.
    pub has_divided_corners: bool,
}

impl StarCrown {
    /// Adds the table and all facets of the crown.
    ///
    /// # Errors
    /// Fails with the tier whose points give no plane.
    pub fn add_to(&self, net: &mut FacetNet, outline: &Rectangle, inside: f64) -> Result<(), NoRoom> {
        let width = 0.5 * (1.0 - self.table);
        let [break_height, rise] = self.mains.map(|tangent| tangent * width);
        let height = break_height + rise;
        let (length, table) = (outline.length, self.table);
        // The table's corner lies above the corner of the outline.
        let (sin, cos) = self.star_azimuth.sin_cos();
        let tip = DVec2::splat(table * cos / (cos + sin)) + DVec2::new(0.0, length - 1.0);
        let [far, near] = [outline.corner_distance(), FRAC_1_SQRT_2 * (tip.x + tip.y)];
        let part = if self.has_divided_corners { 0.5 } else { break_height / height };
        let corner = (far + (near - far) * part) / FRAC_1_SQRT_2;
        let on_break = |x: f64, y: f64| DVec3::new(x, y, break_height);
        let side = on_break(1.0 - width, corner - (1.0 - width));
        let end = on_break(corner - (length - width), length - width);
        let top = tip.extend(height);
        net.plane("table", DVec3::Z, DVec3::Z * height);
        let mut quarters = Quarters { net, inside };
        for (tier, tangent, inset, from) in
            [("main_1", self.mains[0], 0.0, 0.0), ("main_2", self.mains[1], width, break_height)]
        {
            let normal = |along: DVec2| (along * tangent).extend(1.0);
            quarters.pair(tier, normal(DVec2::X), DVec3::new(1.0 - inset, 0.0, from));
            quarters.pair(tier, normal(DVec2::Y), DVec3::new(0.0, length - inset, from));
        }
        let edge = [outline.side_end().extend(0.0), outline.end_end().extend(0.0)];
        if self.has_divided_corners {
            quarters.through("corner_1", [edge[0], edge[1], side])?;
            quarters.through("corner_2", [side, end, top])?;
        } else {
            quarters.through("corner", [edge[0], edge[1], top])?;
        }
        quarters.through("star", [DVec3::new(table, 0.0, height), top, side])?;
        quarters.through("star", [DVec3::new(0.0, length - 1.0 + table, height), top, end])
    }
}

/// A pavilion of chevrons.
#[derive(Debug, Clone, Copy)]
pub struct Chevrons {
    /// The number of rows of chevrons, 2 to 4.
    pub count: usize,
    /// The depth of the mains' point below the girdle.
    pub depth: f64,
    /// The angle by which each piece of the profile is steeper than the next, in degrees.
    pub step: f64,
    /// The part of the way from the middle to the girdle, along the middle of a side, to which the mains reach.
    pub shoulder: f64,
    /// How many degrees the facets at the corners would be steeper than the mains if they reached half of the way to the point; `None`
    /// where mains reach the corners.
    pub corner_step: Option<f64>,
    /// The part of the mains' way to their point at which the culet cuts them off; 0 is a point.
    pub culet: f64,
}

impl Chevrons {
    /// Adds all facets below a girdle of this thickness.
    ///
    /// # Errors
    /// Fails with the tier whose planes leave no room.
    pub fn add_to(&self, net: &mut FacetNet, outline: &Rectangle, thickness: f64) -> Result<(), NoRoom> {
        let mut quarters = Quarters { net, inside: -0.5 * thickness };
        let below = |depth: f64| -thickness - depth;
        let far = outline.corner_distance();
        let slope = (self.depth / far).atan().to_degrees();
        let count = 1 + usize::from(self.corner_step.is_some());
        let corner = StepRows { count, slope, step: self.corner_step.unwrap_or(0.0), reach: far };
        let main = corner
            .tangents()
            .and_then(|rows| rows.last().copied())
            .ok_or(NoRoom { tier: "pavilion_corner" })?;
        let (side, end) = (outline.side_end().extend(below(0.0)), outline.end_end().extend(below(0.0)));
        let point = DVec3::Z * below(self.depth);
        let level = DVec3::new(-1.0, 1.0, 0.0);
        let mains = [point, point + level, point + DVec3::new(FRAC_1_SQRT_2, FRAC_1_SQRT_2, main)];
        let profile = |size: f64| self.profile(size, main, far / FRAC_1_SQRT_2);
        let mut innermost = vec![mains];
        for (from, way, points) in
            [(side, DVec3::X, profile(1.0)?), (end, DVec3::Y, profile(outline.length)?)]
        {
            let at = |[out, depth]: [f64; 2]| way * out + DVec3::Z * below(depth);
            let [.., a, b] = points[..] else { return Err(NoRoom { tier: CHEVRONS[1] }) };
            innermost.push([from, at(a), at(b)]);
            for (piece, pair) in points.windows(2).enumerate() {
                let [a, b] = [at(pair[0]), at(pair[1])];
                if piece == 0 {
                    let drop = a.z - b.z;
                    quarters.pair(CHEVRONS[0], way * drop - DVec3::Z * (a - b).dot(way), a);
                } else {
                    quarters.through(CHEVRONS[self.count + 1 - piece], [from, a, b])?;
                }
            }
        }
        if self.corner_step.is_some() {
            // A tip that is not farther in than the corner, and deeper, would make facets that lean outward.
            let corner = side.truncate().element_sum();
            let is_inside = |tip: &DVec3| tip.z < side.z && tip.truncate().element_sum() < corner;
            let tip = meeting(&innermost).filter(is_inside).ok_or(NoRoom { tier: "pavilion_corner" })?;
            quarters.through("pavilion_corner", [side, end, tip])?;
        }
        quarters.through("main", mains)?;
        if self.culet > 0.0 {
            quarters.net.plane("culet", DVec3::NEG_Z, DVec3::Z * below(self.depth * (1.0 - self.culet)));
        }
        Ok(())
    }

    /// Returns the profile in the middle of a side of half the stone's size across it, from the girdle to the mains' shoulder,
    /// as distances from the axis and depths below the girdle. `main` is the tangent of the mains' angle; `edge` is where the
    /// level line through both ends of a cut corner crosses the middle of the side.
    fn profile(&self, size: f64, main: f64, edge: f64) -> Result<Vec<[f64; 2]>, NoRoom> {
        let shoulder = self.shoulder * size;
        let reach = size - shoulder;
        let depth = self.depth - shoulder * main * FRAC_1_SQRT_2;
        let slope = (depth / reach).atan().to_degrees();
        let rows = StepRows { count: self.count + 1, slope, step: self.step, reach };
        let tangents = rows.tangents().ok_or(NoRoom { tier: CHEVRONS[1] })?;
        let width = reach / tangents.len() as f64;
        // The innermost chevron has to be steeper than the mains, and to leave the corners of the girdle to their facets.
        let inner = tangents[tangents.len() - 1];
        if inner <= main * FRAC_1_SQRT_2 || shoulder + depth / inner >= edge {
            return Err(NoRoom { tier: CHEVRONS[1] });
        }
        let mut at = [size, 0.0];
        let mut points = vec![at];
        for tangent in tangents {
            at = [at[0] - width, at[1] + tangent * width];
            points.push(at);
        }
        Ok(points)
    }
}

/// Returns the point where planes meet, each given by three points; `None` where three planes share no one point.
fn meeting(planes: &[[DVec3; 3]]) -> Option<DVec3> {
    let [first, second, third] = planes else { return None };
    let normals = [first, second, third].map(|[a, b, c]| (b - a).cross(c - a).normalize_or_zero());
    let offset = |k: usize| normals[k].dot(planes[k][0]);
    let point = DMat3::from_cols(normals[0], normals[1], normals[2]).transpose().inverse()
        * DVec3::new(offset(0), offset(1), offset(2));
    point.is_finite().then_some(point)
}
