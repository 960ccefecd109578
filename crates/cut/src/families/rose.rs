//! The rose cut: a flat base and a dome of triangles.
//!
//! With one row the dome is a pyramid. With two rows, a star of triangles around the point stands on a ring; below
//! each of its sides hangs a triangle with its tip on the girdle, and two more triangles fill each gap. Six sides
//! make the Dutch rose of 24 = 6 + 18. The trade counts triangles in threes: 3, 6, 12, 24. The first cut has the
//! angles of PC 45.063 (Double Holland Rose, 36.5, 34, 30), whose height is 32 percent of the width; the trade also
//! quotes about half of the width.

use super::super::facet_net::{FacetNet, NoRoom};
use super::super::family::BoundAt::{Fixed, Of};
use super::super::family::{Bound, Family, Proportion};
use super::super::family_cut::FamilyCut;
use super::super::shape::Cut;
use super::alternating::{corner_radius, direction};
use super::rows;
use glam::DVec3;
use std::f64::consts::PI;

const SIDES: usize = 0;
const ROWS: usize = 1;
const HEIGHT: usize = 2;
const STAR: usize = 3;
const STAR_ANGLE: usize = 4;
const GIRDLE: usize = 5;

/// The family of the rose cut.
pub static ROSE: Family = Family {
    key: "rose",
    name: "Rose cut",
    first: FamilyCut::first(&ROSE, &[6.0, 2.0, 32.43, 30.82, 30.0, 1.0]),
    net: Some(net),
    depth: Some(depth),
    proportions: &[
        Proportion {
            meaning: "The number of triangles that meet in the point; 3 and 6 are usual.",
            ..rows::count::<SIDES>(
                "sides",
                "Sides",
                [3.0, 8.0],
                ["the fewest sides of an outline", "the most sides allowed"],
            )
        },
        Proportion {
            meaning: "The number of rows: 1 is a pyramid of triangles; 2 is a star of triangles with three below each, which makes 12 for 3 sides and 24 for 6.",
            ..rows::count::<ROWS>(
                "rows",
                "Rows",
                [1.0, 2.0],
                ["a pyramid", "a star and the triangles around it"],
            )
        },
        Proportion {
            meaning: "The height of the dome from the girdle's upper edge to the point.",
            least: Bound::at(Fixed(2.0), "the flattest dome allowed"),
            most: Bound::at(Fixed(300.0), "the highest dome allowed"),
            ..rows::of_width::<HEIGHT>("height", "Height", [25.0, 60.0])
        },
        Proportion {
            meaning: "The width of the star around the point, from corner to opposite corner. A pyramid has no star.",
            least: Bound::at(Fixed(5.0), "the smallest star allowed"),
            most: Bound::at(Fixed(90.0), "the largest star allowed"),
            ..rows::of_width::<STAR>("star", "Star", [25.0, 70.0])
        },
        Proportion {
            meaning: "The angle between the star's triangles and the girdle plane. A pyramid has no star.",
            most: Bound::before(Of(steepest_star), "where the dome would be a pyramid"),
            ..rows::slope::<STAR_ANGLE>("star_angle", "Star angle", [10.0, 30.0])
        },
        rows::girdle_thickness::<GIRDLE>(),
        Proportion {
            meaning: "The height of the whole stone. Setting it scales the dome: its height and the tangent of the star's angle change by \
                      one factor; the girdle stays.",
            ..rows::total_depth([26.0, 61.0], &["height", "star_angle"])
        },
    ],
};

/// Returns the slope, in degrees, of a cone as high as the dome that stands on the girdle's corners. Steeper stars
/// would leave no dome.
fn steepest_star(cut: &Cut) -> f64 {
    match cut {
        Cut::Family(cut) if cut[ROWS] > 1.0 => {
            (cut[HEIGHT] / 50.0 / RoseCorners::of(cut).edge).atan().to_degrees()
        }
        _ => 90.0,
    }
}

/// The corners of a rose cut. Lengths are in girdle radii; heights are above the girdle's upper edge.
struct RoseCorners {
    sides: usize,
    /// The number of the girdle's corners.
    corners: usize,
    /// The radius of the girdle's corners.
    edge: f64,
    point: DVec3,
    /// The radius of the star's corners.
    star: f64,
    /// The height of the star's corners.
    shoulder: f64,
}

impl RoseCorners {
    fn of(cut: &FamilyCut) -> Self {
        let sides = cut[SIDES] as usize;
        let corners = if cut[ROWS] > 1.0 { 2 * sides } else { sides };
        let (height, star) = (cut[HEIGHT] / 50.0, cut[STAR] / 100.0);
        let middle = star * (PI / sides as f64).cos();
        let shoulder = height - middle * cut[STAR_ANGLE].to_radians().tan();
        Self { sides, corners, edge: corner_radius(corners), point: DVec3::Z * height, star, shoulder }
    }

    /// Returns a corner of the girdle, at this many half sides from the middle of the first star triangle.
    fn girdle(&self, half_sides: usize) -> DVec3 {
        (direction(2 * self.sides, half_sides as f64) * self.edge).extend(0.0)
    }

    /// Returns the star's corner at one end of a side; `half_sides` is odd.
    fn shoulder(&self, half_sides: usize) -> DVec3 {
        (direction(2 * self.sides, half_sides as f64) * self.star).extend(self.shoulder)
    }
}

fn depth(cut: &FamilyCut) -> f64 {
    (cut[HEIGHT] + cut[GIRDLE]) / 50.0
}

fn net(cut: &FamilyCut) -> Result<FacetNet, NoRoom> {
    let dome = RoseCorners::of(cut);
    let thickness = cut[GIRDLE] / 50.0;
    // The point is inside the dome, at a quarter of its height.
    let inside = dome.point * 0.25;
    let mut net = FacetNet::default();
    for side in 0..dome.sides {
        let (middle, [left, right]) = (2 * side, [2 * side + 2 * dome.sides - 1, 2 * side + 1]);
        if dome.corners == dome.sides {
            net.through("star", [dome.point, dome.girdle(left), dome.girdle(right)], inside)?;
            continue;
        }
        let corners = [left, right].map(|end| dome.shoulder(end));
        net.through("star", [dome.point, corners[0], corners[1]], inside)?;
        net.through("middle", [dome.girdle(middle), corners[0], corners[1]], inside)?;
        for (end, corner) in [left, right].into_iter().zip(corners) {
            net.through("edge", [dome.girdle(middle), dome.girdle(end), corner], inside)?;
        }
    }
    if thickness > 0.0 {
        for side in 0..dome.corners {
            let step = 2 * dome.sides / dome.corners;
            let ends =
                if step == 1 { [side, side + 1] } else { [2 * side + 2 * dome.sides - 1, 2 * side + 1] };
            let [a, b] = ends.map(|end| dome.girdle(end));
            net.plane("girdle", (a + b).truncate().extend(0.0), a);
        }
    }
    net.plane("base", DVec3::NEG_Z, DVec3::NEG_Z * thickness);
    Ok(net)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_cut_has_the_angles_of_the_double_holland_rose() {
        let Cut::Family(first) = ROSE.first else { panic!("a family's cut") };
        for (name, plane) in net(&first).unwrap().named() {
            let angle = plane.normal.z.acos().to_degrees();
            let printed = match name.split(' ').next() {
                Some("star") => 30.0,
                Some("middle") => 34.0,
                Some("edge") => 36.5,
                _ => angle,
            };
            assert!((angle - printed).abs() < 0.02, "{name}: {angle} for {printed}");
        }
    }
}
