//! The ratios that cutters print on the sheet of a design.
//!
//! Source: the sheets that GemCad prints (R. Strickland, gemcad.com/lesson4.htm). For the height, GemCad adds 0.02 W
//! to P and C, as if every girdle were that thick; here the girdle is measured.

use super::facet_zones::FacetZones;
use super::outline::{AlongAxes, Outline};
use brillianteer_math::Polytope;
use serde::{Deserialize, Serialize};

/// The ratios and counts of a stone that stand at the top of a cutter's sheet.
///
/// All lengths are measured along the axes of the design: W is the smaller and L the larger of the stone's extents along x
/// and y, T and U are the extents of the table along x and y, P, G and C are the heights of pavilion, girdle and crown between
/// the girdle's edges as [`AlongAxes`] has them, and H is the whole height, P + G + C. Ratios have no unit and are 0 or more; without a table T
/// and U are 0.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SheetFigures {
    /// L/W; 1 or more.
    pub length_to_width: f64,
    /// T/W, which is T/L times L/W.
    pub table_to_width: f64,
    /// T/L; from 0 to 1.
    pub table_to_length: f64,
    /// U/W.
    pub table_across_to_width: f64,
    /// P/W.
    pub pavilion_to_width: f64,
    /// C/W.
    pub crown_to_width: f64,
    /// G/W, measured on the girdle's facets.
    pub girdle_to_width: f64,
    /// H/W = P/W + G/W + C/W.
    pub height_to_width: f64,
    /// P/H; from 0 to 1.
    pub pavilion_to_height: f64,
    /// C/H; from 0 to 1.
    pub crown_to_height: f64,
    /// Vol./W³: the volume in cubes of the width.
    pub volume_to_width_cubed: f64,
    /// The number of facets, without those of the girdle. Facets in one plane count once; faces of the block that closes
    /// an open design do not count.
    pub facets: usize,
    /// The number of facets of the girdle.
    pub girdle_facets: usize,
}

impl SheetFigures {
    /// Measures a stone that lies as in its design, with the names of its facets in their order.
    pub fn of(stone: &Polytope, names: &[String]) -> Self {
        let along = AlongAxes::of(stone, &Outline::of(stone));
        let (low, high) = stone.bounds();
        let width = (high - low).truncate().min_element();
        let [table, table_across] = along.table.map(|percent| percent / 100.0);
        let zones = FacetZones::of(stone);
        let count = |wanted: bool| {
            let all = stone.facets().iter().enumerate();
            let kinds = all.filter(|(_, facet)| zones.is_girdle(facet) == wanted);
            kinds.filter(|(k, _)| names.get(*k).is_none_or(|name| !is_of_block(name))).count()
        };
        Self {
            length_to_width: along.length_to_width,
            table_to_width: table,
            table_to_length: table / along.length_to_width,
            table_across_to_width: table_across,
            pavilion_to_width: along.pavilion_to_width,
            crown_to_width: along.crown_to_width,
            girdle_to_width: along.girdle_to_width,
            height_to_width: along.height_to_width,
            pavilion_to_height: along.pavilion_to_width / along.height_to_width,
            crown_to_height: along.crown_to_width / along.height_to_width,
            volume_to_width_cubed: stone.volume() / width.powi(3),
            facets: count(false),
            girdle_facets: count(true),
        }
    }

    /// Returns the ratios as a sheet lists them: symbol and value.
    pub fn ratios(&self) -> [(&'static str, f64); 11] {
        [
            ("L/W", self.length_to_width),
            ("T/W", self.table_to_width),
            ("T/L", self.table_to_length),
            ("U/W", self.table_across_to_width),
            ("P/W", self.pavilion_to_width),
            ("C/W", self.crown_to_width),
            ("G/W", self.girdle_to_width),
            ("H/W", self.height_to_width),
            ("P/H", self.pavilion_to_height),
            ("C/H", self.crown_to_height),
            ("Vol./W³", self.volume_to_width_cubed),
        ]
    }
}

/// Returns whether a facet of this name is a face of the block that closes an open design.
fn is_of_block(name: &str) -> bool {
    name.strip_prefix("block ").is_some_and(|number| number.parse::<u32>().is_ok())
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_math::Plane;
    use glam::{DVec2, DVec3};

    /// Azimuth in degrees and distance of the eight upright facets: 1.272 by 1, with cut corners.
    const SIDES: [(f64, f64); 8] = [
        (0.0, 0.636),
        (40.0, 0.72),
        (90.0, 0.5),
        (140.0, 0.72),
        (180.0, 0.636),
        (220.0, 0.72),
        (270.0, 0.5),
        (320.0, 0.72),
    ];

    /// The levels of the example, as height and the part of the outline that is left there: three rows of the crown, the
    /// girdle of 0.02, five rows of the pavilion. The higher `bulge`, the fuller the stone.
    fn levels(bulge: f64) -> Vec<DVec2> {
        let crown =
            [0.0, 0.4, 0.75, 1.0].map(|t: f64| DVec2::new(0.26 - 0.24 * t, 1.0 - 0.375 * (1.0 - t.sqrt())));
        let pavilion = (0..=5).map(|k| {
            let t = f64::from(k) / 5.0;
            DVec2::new(-0.649 * t, 1.0 - t.powf(bulge))
        });
        crown.into_iter().chain(pavilion).collect()
    }

    /// Builds the example of the printed sheet: 1.272 long, its table 0.625 of that, crown 0.24, girdle 0.02, pavilion
    /// 0.649, and two small facets at the ends of the pavilion.
    fn example(bulge: f64) -> Vec<Plane> {
        let levels = levels(bulge);
        let mut planes = vec![Plane::new(DVec3::Z, 0.26)];
        for (azimuth, reach) in SIDES {
            let out = DVec2::from_angle(azimuth.to_radians());
            let row = |pair: &[DVec2]| {
                let edge = (pair[1] - pair[0]) * DVec2::new(1.0, reach);
                let normal = (out * -edge.x).extend(edge.y).normalize_or_zero();
                Plane::new(normal, normal.dot((out * reach * pair[0].y).extend(pair[0].x)))
            };
            let rows: Vec<Plane> = levels.windows(2).map(row).collect();
            if azimuth.rem_euclid(180.0) == 0.0 {
                let bevel = (rows[5].normal + rows[6].normal).normalize_or_zero();
                let edge = (out * reach * levels[6].y).extend(levels[6].x);
                planes.push(Plane::new(bevel, bevel.dot(edge) - 0.001));
            }
            planes.extend(rows);
        }
        planes
    }

    fn figures(planes: &[Plane]) -> SheetFigures {
        SheetFigures::of(&Polytope::from_planes(planes).unwrap(), &[])
    }

    /// Returns the example with the bulge that gives the printed volume.
    fn of_the_printed_volume() -> (f64, SheetFigures) {
        let (mut slim, mut full) = (1.0, 4.0);
        for _ in 0..60 {
            let middle = (slim + full) / 2.0;
            let is_slim = figures(&example(middle)).volume_to_width_cubed < 0.526;
            *(if is_slim { &mut slim } else { &mut full }) = middle;
        }
        (slim, figures(&example(slim)))
    }

    /// Returns whether a number prints as these three decimals, apart from the rounding of the numbers from which it
    /// is computed.
    fn prints(value: f64, printed: f64) -> bool {
        (value - printed).abs() <= 0.001
    }

    #[test]
    fn the_sheet_that_gemcad_prints_is_reproduced() {
        let (bulge, found) = of_the_printed_volume();
        let printed = [
            ("L/W", 1.272),
            ("T/W", 0.795),
            ("T/L", 0.625),
            ("P/W", 0.649),
            ("C/W", 0.240),
            ("G/W", 0.020),
            ("H/W", 0.909),
            ("P/H", 0.714),
            ("C/H", 0.264),
            ("Vol./W³", 0.526),
        ];
        for (symbol, value) in printed {
            let ours = found.ratios().into_iter().find(|(name, _)| *name == symbol).unwrap().1;
            assert!(prints(ours, value), "{symbol}: {ours}, not {value}");
            assert!(!prints(1.01 * ours + 0.002, value), "{symbol}: the comparison cannot fail");
        }
        assert_eq!((found.facets, found.girdle_facets, found.facets + found.girdle_facets), (67, 8, 75));
        // The volume is that of frustums of one outline, less the two bevels.
        let outline: Vec<Plane> = SIDES
            .iter()
            .map(|&(azimuth, reach)| Plane::new(DVec2::from_angle(azimuth.to_radians()).extend(0.0), reach))
            .chain([Plane::new(DVec3::Z, 1.0), Plane::new(DVec3::NEG_Z, 0.0)])
            .collect();
        let area = Polytope::from_planes(&outline).unwrap().volume();
        let frustum = |pair: &[DVec2]| {
            let ([a, b], height) = ([pair[0].y, pair[1].y], pair[0].x - pair[1].x);
            height / 3.0 * (a * a + a * b + b * b)
        };
        let volume = area * levels(bulge).windows(2).map(frustum).sum::<f64>();
        assert!((volume - found.volume_to_width_cubed).abs() < 1e-3, "{volume} {found:?}");
    }

    #[test]
    fn heights_add_up_and_ratios_of_one_length_agree() {
        for bulge in [1.0, 1.7, 3.0] {
            let found = figures(&example(bulge));
            let sum = found.pavilion_to_width + found.girdle_to_width + found.crown_to_width;
            let pairs = [
                (sum, found.height_to_width),
                (found.pavilion_to_width / found.height_to_width, found.pavilion_to_height),
                (found.crown_to_width / found.height_to_width, found.crown_to_height),
                (found.table_to_length * found.length_to_width, found.table_to_width),
            ];
            assert!(pairs.iter().all(|(a, b)| (a - b).abs() < 1e-12), "{found:?}");
        }
    }

    #[test]
    fn faces_of_the_block_are_no_facets() {
        let planes: Vec<(String, Plane)> = crate::Tiers::block().collect();
        let names: Vec<String> = planes.iter().map(|(name, _)| name.clone()).collect();
        let planes: Vec<Plane> = planes.into_iter().map(|(_, plane)| plane).collect();
        let stone = Polytope::from_planes(&planes).unwrap();
        let counted = |names: &[String]| {
            let found = SheetFigures::of(&stone, names);
            (found.facets, found.girdle_facets)
        };
        assert_eq!((counted(&names), counted(&[])), ((0, 0), (2, 4)));
        assert!(!is_of_block("block main 1"));
    }
}
