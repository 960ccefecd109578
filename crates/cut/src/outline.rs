//! The measures of a stone of any cut: length, width, the girdle's edges, depths and table.

use super::facet_zones::FacetZones;
use super::girdle_at_mains::MeasuredGirdle;
use brillianteer_math::{Calipers, Edge, Facet, Polytope, SolidRef, bounds, hull};
use glam::{DVec2, DVec3};
use serde::{Deserialize, Serialize};

/// A round outline's corners lie at least this part of the largest radius from its middle.
const ON_CIRCLE: f64 = 0.99;

/// The width of a round outline is at least this part of its diameter: midway between an octagon, which is 0.924 wide, and a
/// heptagon or decagon of 0.951, so that noise does not decide which is round.
pub(super) const ROUND: f64 = 0.937;

/// The part of the corners of the girdle's facets that lie beyond each of its edges.
///
/// A few corners reach far in a wavy girdle and are hardly representative. Depths published for GemCad's designs
/// leave out a tenth too, but of the corners of triangles into which facets fall by chance. So one design in a
/// hundred, whose tenth corner lies where its girdle steps, measures differently.
const EDGE: f64 = 0.1;

/// Corners of a facet nearer to one another than this, in widths of the stone, are one. Where more than three facets meet,
/// the last digit of a cutter's file splits their corner.
const SAME_CORNER: f64 = 1e-7;

/// The measures of a stone. They do not depend on how the stone is turned about its axis. Lengths are in the unit of the
/// stone.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Outline {
    /// The extent square to the width, seen along the axis.
    pub length: f64,
    /// The least distance between two parallel lines that hold the stone, seen along the axis. Where the outline is its own
    /// mirror image and this direction is oblique to it, as on a kite, it is the smaller of the extents along the mirror
    /// line and square to it. Of directions that are almost equally narrow, the longer one counts
    /// ([`Calipers::of_stone`]).
    pub width: f64,
    /// The length by which sizes and percentages are measured.
    ///
    /// For a round stone it is the diameter of the circle that holds the corners of its outline; for any other it is the
    /// width. A stone is round if all corners of its outline lie on that circle to within 1 % of its radius, and its width
    /// is at least 93.7 % of its diameter: one of ten sides is, one of eight is not.
    pub diameter: f64,
    /// The height z of the girdle's lower edge, below which a tenth of the corners of its facets lie. Cutters' ratios count
    /// from there.
    pub girdle_bottom: f64,
    /// The height z of the girdle's upper edge, above which a tenth of the corners of its facets lie.
    pub girdle_top: f64,
    /// The heights z of the girdle's lower and upper edge at the mains, from which the trade counts proportions: the mean of
    /// the places where the edge lies lower, or higher, than on either side. Those of the edges where the stone has no girdle.
    pub girdle_at_mains: [f64; 2],
    /// The height z of the lowest point.
    pub bottom: f64,
    /// The height z of the highest point.
    pub top: f64,
    /// Width and length of the table, measured in the same way as those of the stone; 0 without a table.
    pub table: [f64; 2],
    /// The greatest distance between two corners of the table, by which the trade gives the table of a round brilliant; 0
    /// without a table.
    pub table_corners: f64,
    /// The middle of the stone seen along the axis: the centroid of its outline's area.
    pub middle: DVec2,
}

impl Outline {
    /// Measures a stone.
    pub fn of(stone: &Polytope) -> Self {
        let (low, high) = stone.bounds();
        let across = high - low;
        // A solid so thin that rounding leaves no outline is measured along its axes.
        let outline = hull(stone.vertices().iter().map(|v| v.truncate()).collect());
        let Calipers { length, width, middle, .. } =
            Calipers::of_stone(&outline).unwrap_or_else(|| Calipers {
                length: across.max_element(),
                width: across.truncate().min_element(),
                across: DVec2::X,
                middle: ((low + high) / 2.0).truncate(),
            });
        let (girdle_bottom, girdle_top) = girdle(stone, SAME_CORNER * width);
        let facet = table(stone);
        let radius = round_diameter(&outline, middle, width).map(|diameter| diameter / 2.0);
        let at_mains = MeasuredGirdle { stone, middle, width, radius }.edges();
        let flat = |facet| hull(stone.corners(facet).map(DVec3::truncate).collect());
        let table = facet.and_then(|facet| Calipers::of_stone(&flat(facet)));
        Self {
            length,
            width,
            diameter: radius.map_or(width, |radius| 2.0 * radius),
            girdle_bottom,
            girdle_top,
            girdle_at_mains: at_mains.unwrap_or((girdle_bottom, girdle_top)).into(),
            bottom: low.z,
            top: high.z,
            table: table.map_or([0.0; 2], |found| [found.width, found.length]),
            table_corners: facet.map_or(0.0, |facet| farthest_apart(stone, facet)),
            middle,
        }
    }

    /// Returns the depth from the girdle's lower edge at the mains to the lowest point.
    pub fn pavilion_depth(&self) -> f64 {
        self.girdle_at_mains[0] - self.bottom
    }

    /// Returns the thickness of the girdle at the mains.
    pub fn girdle_thickness(&self) -> f64 {
        self.girdle_at_mains[1] - self.girdle_at_mains[0]
    }

    /// Returns the height from the girdle's upper edge at the mains to the highest point.
    pub fn crown_height(&self) -> f64 {
        self.top - self.girdle_at_mains[1]
    }
}

/// The ratios that cutters' diagrams print of a stone. GemCad measures along the axes of the design, whichever way the stone
/// lies. W is the smaller of the stone's extents along x and y.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct AlongAxes {
    /// L/W: the larger of the stone's extents along x and y, divided by the smaller.
    pub length_to_width: f64,
    /// T/W and U/W: the table's extents along x and y, in percent of the smaller extent of the stone; 0 without a table.
    pub table: [f64; 2],
    /// P/W: the depth of the pavilion below [the girdle's edge](Outline::girdle_bottom).
    pub pavilion_to_width: f64,
    /// G/W: the height between the girdle's edges.
    pub girdle_to_width: f64,
    /// C/W: the height of the crown above [the girdle's edge](Outline::girdle_top).
    pub crown_to_width: f64,
    /// H/W = P/W + G/W + C/W.
    pub height_to_width: f64,
}

impl AlongAxes {
    /// Measures a stone that lies as in its design and has this outline.
    pub fn of(stone: &Polytope, outline: &Outline) -> Self {
        let (low, high) = stone.bounds();
        let across = (high - low).truncate();
        let table = table(stone).map_or(DVec2::ZERO, |facet| {
            let (low, high) = bounds(stone.corners(facet));
            (high - low).truncate()
        });
        let width = across.min_element();
        Self {
            length_to_width: across.max_element() / width,
            table: (100.0 / width * table).to_array(),
            pavilion_to_width: (outline.girdle_bottom - outline.bottom) / width,
            girdle_to_width: (outline.girdle_top - outline.girdle_bottom) / width,
            crown_to_width: (outline.top - outline.girdle_top) / width,
            height_to_width: (outline.top - outline.bottom) / width,
        }
    }
}

/// Returns the table, the largest where a measured stone has several.
fn table(stone: &Polytope) -> Option<&Facet> {
    let zones = FacetZones::of(stone);
    let tables = stone.facets().iter().filter(|facet| zones.is_table(facet));
    tables.max_by(|a, b| farthest_apart(stone, a).total_cmp(&farthest_apart(stone, b)))
}

/// Returns the diameter of an outline of this middle and width, as defined at [`Outline::diameter`].
pub(super) fn diameter(outline: &[DVec2], middle: DVec2, width: f64) -> f64 {
    round_diameter(outline, middle, width).unwrap_or(width)
}

/// Returns the diameter of the circle that holds the corners of an outline of this middle and width; `None` unless the
/// outline is round as defined at [`Outline::diameter`].
pub fn round_diameter(outline: &[DVec2], middle: DVec2, width: f64) -> Option<f64> {
    let radii = || outline.iter().map(|corner| corner.distance(middle));
    let (least, most) = (radii().fold(f64::INFINITY, f64::min), radii().fold(0.0, f64::max));
    let is_round = least >= ON_CIRCLE * most && width >= ROUND * 2.0 * most;
    is_round.then_some(2.0 * most)
}

/// Returns the greatest distance between two corners of a facet.
fn farthest_apart(stone: &Polytope, facet: &Facet) -> f64 {
    let corners: Vec<DVec3> = stone.corners(facet).collect();
    let apart = corners.iter().flat_map(|a| corners.iter().map(|b| a.distance_squared(*b)));
    apart.fold(0.0, f64::max).sqrt()
}

/// Returns the heights z of the girdle's edges, the lower first. Corners nearer to one another than `nearest` count once.
fn girdle(stone: &Polytope, nearest: f64) -> (f64, f64) {
    let zones = FacetZones::of(stone);
    let upright = stone.facets().iter().filter(|facet| zones.is_girdle(facet));
    let mut levels: Vec<f64> = upright.flat_map(|facet| corner_levels(stone, facet, nearest)).collect();
    if levels.is_empty() {
        levels = knife_edge(stone);
    }
    levels.sort_by(f64::total_cmp);
    let aside = (EDGE * levels.len() as f64).ceil() as usize;
    match levels.len().checked_sub(aside + 1) {
        Some(last) => (levels[aside.min(last)], levels[last.max(aside)]),
        // Only a solid without an edge between facets that face up and down leads here, and no closed solid is one.
        None => (0.0, 0.0),
    }
}

/// Returns the heights z of a facet's corners. Corners nearer to one another than `nearest` count once.
fn corner_levels(stone: &Polytope, facet: &Facet, nearest: f64) -> Vec<f64> {
    let corners: Vec<DVec3> = stone.corners(facet).collect();
    let next = corners.iter().cycle().skip(1);
    let apart = corners.iter().zip(next).filter(|(corner, next)| corner.distance(**next) >= nearest);
    apart.map(|(corner, _)| corner.z).collect()
}

/// Returns the heights z of the corners where crown and pavilion meet.
fn knife_edge(stone: &Polytope) -> Vec<f64> {
    let is_rim = |edge: &Edge| edge.normals.iter().filter(|normal| normal.z > 0.0).count() == 1;
    let edges = SolidRef::from(stone).edges().into_iter().filter(is_rim);
    edges.flat_map(|edge| edge.ends.map(|corner| corner.z)).collect()
}

#[cfg(test)]
mod tests {
    use super::super::round_brilliant::{MODERN, RoundBrilliant};
    use super::*;
    use brillianteer_math::{Plane, Pose};

    fn stone(given: RoundBrilliant) -> Polytope {
        let planes: Vec<Plane> = given.facets().unwrap().into_iter().map(|(_, plane)| plane).collect();
        Polytope::from_planes(&planes).unwrap()
    }

    #[test]
    fn a_brilliant_measures_what_it_was_made_to() {
        for girdle_facets in [16, 24, 64, 96, 101, 128] {
            let measured = Outline::of(&stone(RoundBrilliant { girdle_facets, ..MODERN }));
            let derived = MODERN.derived().unwrap();
            // The table is an octagon, whose corners lie on a circle of the table's size.
            let flats = MODERN.table / 100.0 * (std::f64::consts::PI / 8.0).cos();
            assert!((measured.table[0] / 2.0 - flats).abs() < 1e-12, "{measured:?}");
            assert!((measured.table_corners / 2.0 - MODERN.table / 100.0).abs() < 1e-12, "{measured:?}");
            let depths = [measured.crown_height(), measured.girdle_thickness(), measured.pavilion_depth()];
            let given = [derived.crown_height, MODERN.girdle_thickness, derived.pavilion_depth];
            for (depth, given) in depths.into_iter().zip(given) {
                assert!(
                    (depth / 2.0 - given / 100.0).abs() < 1e-12,
                    "{girdle_facets}: {measured:?} {derived:?}"
                );
            }
            // Opposite to a side of an odd number lies a corner.
            let side = (std::f64::consts::PI / f64::from(girdle_facets)).cos();
            let across = side + if girdle_facets % 2 == 0 { side } else { 1.0 };
            assert!((measured.width - across).abs() < 1e-12, "{girdle_facets}: {measured:?}");
            assert!(girdle_facets % 2 == 1 || (measured.length - across).abs() < 1e-12, "{measured:?}");
            assert!((measured.diameter - 2.0).abs() < 1e-12, "{measured:?}");
            let depth = measured.top - measured.bottom;
            assert!((depth / 2.0 - derived.total_depth / 100.0).abs() < 1e-12);
        }
    }

    /// Planes that noise has moved a little let mains end short of the girdle.
    #[test]
    fn mains_that_noise_has_moved_measure_the_girdle_all_the_same() {
        let mut next = crate::solids::noise(5);
        for _ in 0..20 {
            let planes = RoundBrilliant { girdle_facets: 96, ..MODERN }.facets().unwrap().into_iter();
            let moved = planes.map(|(_, plane)| Plane { offset: plane.offset + 1e-4 * next(), ..plane });
            let measured = Outline::of(&Polytope::from_planes(&moved.collect::<Vec<_>>()).unwrap());
            let thickness = 50.0 * measured.girdle_thickness();
            assert!((thickness - MODERN.girdle_thickness).abs() < 0.05, "{thickness}");
        }
    }

    #[test]
    fn a_stone_measures_the_same_however_it_is_turned_about_its_axis() {
        // A rectangle of 2 by 1.3 with a table that is turned against it, cut off at one corner.
        let sides = [(0.0, 1.0), (90.0, 0.65), (180.0, 1.0), (270.0, 0.65), (40.0, 1.1)];
        let upright = |(azimuth, offset): (f64, f64)| {
            Plane::new(DVec2::from_angle(azimuth.to_radians()).extend(0.0), offset)
        };
        let leaning = |k: u32| Plane::from_slope(0.7, 0.3 + f64::from(k) * 1.1, 0.9);
        let levels = [Plane::new(DVec3::Z, 0.6), Plane::new(DVec3::NEG_Z, 0.5)];
        let planes: Vec<Plane> =
            sides.map(upright).into_iter().chain((0..6).map(leaning)).chain(levels).collect();
        let stone = Polytope::from_planes(&planes).unwrap();
        let plain = Outline::of(&stone);
        assert!((plain.width - 1.3).abs() < 1e-12 && (plain.length - 2.0).abs() < 1e-12, "{plain:?}");
        assert_eq!(plain.diameter, plain.width);
        assert!(plain.table[0] > 0.1 && plain.table[1] > 1.01 * plain.table[0], "{plain:?}");
        let moved = |angle| Outline::of(&stone.reframed(&Pose::turned(glam::DQuat::from_rotation_z(angle))));
        for step in 1..40 {
            let again = moved(0.31 * f64::from(step));
            let pairs = [
                (again.width, plain.width),
                (again.length, plain.length),
                (again.table[0], plain.table[0]),
                (again.table[1], plain.table[1]),
            ];
            assert!(pairs.iter().all(|(a, b)| (a - b).abs() < 1e-12), "{step}: {again:?} {plain:?}");
        }
        // GemCad's figures do depend on the turn; if they did not, this test would show nothing.
        let along = |stone: &Polytope| AlongAxes::of(stone, &Outline::of(stone)).length_to_width;
        let turned = along(&stone.reframed(&Pose::turned(glam::DQuat::from_rotation_z(0.5))));
        assert!((turned - along(&stone)).abs() > 0.1);
    }

    #[test]
    fn a_corner_that_rounding_splits_counts_once() {
        let box_of = |last: f64| {
            let normals = [
                DVec3::X,
                DVec3::NEG_X,
                DVec3::Y,
                DVec3::NEG_Y,
                DVec3::Z,
                DVec3::NEG_Z,
                DVec3::new(1.0, 0.0, 1.0),
            ];
            let planes =
                normals.map(|normal| Plane::new(normal, if normal.length() > 1.0 { last } else { 1.0 }));
            Polytope::from_planes(&planes.map(|plane| plane.normalized().unwrap())).unwrap()
        };
        let corners = |stone: &Polytope, nearest: f64| {
            let side = stone.facets().iter().find(|facet| facet.plane.normal == DVec3::Y).unwrap();
            corner_levels(stone, side, nearest).len()
        };
        assert_eq!(corners(&box_of(1.5), 1e-7), 5);
        let split = box_of(2.0 - 1e-8);
        assert_eq!((corners(&split, 0.0), corners(&split, 1e-7)), (5, 4));
    }

    #[test]
    fn a_stone_without_a_girdle_is_measured_from_its_knife_edge() {
        let normals = [[1.0, 0.0], [-1.0, 0.0], [0.0, 2.0], [0.0, -2.0]];
        let planes =
            normals.iter().flat_map(|[x, y]| [1.0, -0.5].map(|z| Plane::new(DVec3::new(*x, *y, z), 1.0)));
        let unit: Vec<Plane> = planes.filter_map(|plane| plane.normalized()).collect();
        let measured = Outline::of(&Polytope::from_planes(&unit).unwrap());
        assert!((measured.length - 2.0).abs() < 1e-12 && (measured.width - 1.0).abs() < 1e-12);
        assert!(
            (measured.crown_height() - 1.0).abs() < 1e-12 && (measured.pavilion_depth() - 2.0).abs() < 1e-12
        );
        assert_eq!(measured.table, [0.0; 2]);
    }
}
