//! The closed form of the round brilliant. Lengths are in girdle radii, slopes are tangents.
//!
//! Symbols and formulas are those of docs/optics.md: t table, s star, l lower half (radial), g girdle, q culet, c crown
//! angle and p pavilion angle. Every length is a ratio of radii, so t = table / 100 while g = 2 girdle_thickness / 100.

use std::f64::consts::{FRAC_PI_8, PI, TAU};

use serde::{Deserialize, Serialize};

use super::round_brilliant::{Crown, LowerHalf, Pavilion, RoundBrilliant};

/// th, the azimuth from a bezel to its star, radians: a sixteenth of the circle.
pub(super) const STAR_AZIMUTH: f64 = FRAC_PI_8;
/// h, the azimuth from a bezel to its half facet, radians.
pub(super) const HALF_AZIMUTH: f64 = FRAC_PI_8 / 2.0;

/// The numbers that follow from the given proportions. Lengths are in percent of the girdle diameter, angles in
/// degrees from the girdle plane.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Derived {
    /// The angle of the bezels, degrees.
    pub crown_angle: f64,
    /// The height from the girdle's upper edge to the table, percent.
    pub crown_height: f64,
    /// The angle of the mains, degrees.
    pub pavilion_angle: f64,
    /// The depth from the girdle's lower edge to the culet, percent.
    pub pavilion_depth: f64,
    /// The angle of the stars, degrees.
    pub star_angle: f64,
    /// The angle of the upper halves, degrees.
    pub upper_half_angle: f64,
    /// The angle of the lower halves, degrees.
    pub lower_half_angle: f64,
    /// The length of the lower halves seen along the axis, percent of the way from girdle to centre.
    pub lower_half_length: f64,
    /// The length of the lower halves seen from the side, percent of the depth from the girdle to the point in which
    /// the mains meet.
    pub lower_half_length_vertical: f64,
    /// The girdle's thickness in its valleys, percent: at the girdle corner nearest to the middle of a half facet.
    ///
    /// It is zero or less where upper and lower halves meet in a knife edge. It equals that of a round girdle when the
    /// number of girdle facets is a multiple of 32.
    pub girdle_thickness_valley: f64,
    /// The depth from table to culet, percent.
    pub total_depth: f64,
}

impl Derived {
    /// Returns the numbers by their keys, in the order of their fields.
    pub fn by_key(&self) -> [(&'static str, f64); 11] {
        [
            ("crown_angle", self.crown_angle),
            ("crown_height", self.crown_height),
            ("pavilion_angle", self.pavilion_angle),
            ("pavilion_depth", self.pavilion_depth),
            ("star_angle", self.star_angle),
            ("upper_half_angle", self.upper_half_angle),
            ("lower_half_angle", self.lower_half_angle),
            ("lower_half_length", self.lower_half_length),
            ("lower_half_length_vertical", self.lower_half_length_vertical),
            ("girdle_thickness_valley", self.girdle_thickness_valley),
            ("total_depth", self.total_depth),
        ]
    }
}

/// The variables of the closed form. Facets and warnings are made only of checked ones.
#[derive(Debug, Clone, Copy)]
pub(super) struct Proportions {
    pub table: f64,
    pub star: f64,
    pub lower: f64,
    pub girdle: f64,
    pub culet: f64,
    pub tan_crown: f64,
    pub tan_pavilion: f64,
    pub girdle_facets: u32,
}

impl Proportions {
    /// Converts percent and degrees to radii and tangents, without any check.
    pub fn unchecked(given: &RoundBrilliant) -> Self {
        let (table, culet) = (given.table / 100.0, given.culet / 100.0);
        let tan_crown = match given.crown {
            Crown::Angle(degrees) => degrees.to_radians().tan(),
            Crown::Height(percent) => percent / 50.0 / (1.0 - table),
        };
        let tan_pavilion = match given.pavilion {
            Pavilion::Angle(degrees) => degrees.to_radians().tan(),
            Pavilion::Depth(percent) => percent / 50.0 / (1.0 - culet),
        };
        let lower = match given.lower_half {
            LowerHalf::Radial(percent) => percent / 100.0,
            LowerHalf::Vertical(percent) => 1.0 - (1.0 - percent / 100.0) / STAR_AZIMUTH.cos(),
        };
        Self {
            table,
            star: given.star_length / 100.0,
            lower,
            girdle: given.girdle_thickness / 50.0,
            culet,
            tan_crown,
            tan_pavilion,
            girdle_facets: given.girdle_facets,
        }
    }

    /// Returns hc, the height of the table above the girdle.
    pub fn crown_height(&self) -> f64 {
        (1.0 - self.table) * self.tan_crown
    }

    /// Returns the depth from the girdle's lower edge to the culet.
    pub fn pavilion_depth(&self) -> f64 {
        (1.0 - self.culet) * self.tan_pavilion
    }

    /// Returns the depth from table to culet.
    pub fn total_depth(&self) -> f64 {
        self.crown_height() + self.girdle + self.pavilion_depth()
    }

    /// Returns r_s and z_s, the radius and height of the stars' lower tips.
    pub fn star_tip(&self) -> (f64, f64) {
        let edge = self.table * STAR_AZIMUTH.cos();
        let radius = edge + self.star * (1.0 - edge);
        (radius, self.tan_crown * (1.0 - radius * STAR_AZIMUTH.cos()))
    }

    /// Returns the slope of the stars, which pass through the table's edge and the star tip.
    pub fn tan_star(&self) -> f64 {
        let (radius, _) = self.star_tip();
        self.tan_crown * (radius * STAR_AZIMUTH.cos() - self.table)
            / (radius - self.table * STAR_AZIMUTH.cos())
    }

    /// Returns the slope of the upper halves, which pass through the star tip and the girdle's chord over 22.5 degrees.
    pub fn tan_upper(&self) -> f64 {
        let (radius, height) = self.star_tip();
        height / (HALF_AZIMUTH.cos() * (1.0 - radius))
    }

    /// Returns the slope of the lower halves, which pass through their tip on the mains and the girdle's chord over 22.5
    /// degrees.
    pub fn tan_lower(&self) -> f64 {
        self.tan_pavilion * self.lower_vertical() / (self.lower * HALF_AZIMUTH.cos())
    }

    /// Returns the length of the lower halves seen from the side, as a fraction of the depth at which the mains meet.
    pub fn lower_vertical(&self) -> f64 {
        1.0 - (1.0 - self.lower) * STAR_AZIMUTH.cos()
    }

    /// Returns the difference of the girdle's thickness at the bezels and in its valleys.
    ///
    /// The halves pass through the girdle's chord. They stand clear of it most at the girdle corner nearest to their own
    /// azimuth.
    pub fn valley_depth(&self) -> f64 {
        let corners = HALF_AZIMUTH / TAU * f64::from(self.girdle_facets);
        let nearest =
            (0..16).map(|k| f64::from(2 * k + 1) * corners).map(|corner| (corner - corner.round()).abs());
        let off = nearest.fold(0.5, f64::min) * TAU / f64::from(self.girdle_facets);
        (off.cos() - HALF_AZIMUTH.cos()) * (self.tan_upper() + self.tan_lower())
    }

    /// Returns the radius of the girdle's outline at an azimuth in radians; 1 at the outline's corners.
    pub fn girdle_radius(&self, azimuth: f64) -> f64 {
        let half_facet = PI / f64::from(self.girdle_facets);
        let off_middle = azimuth.rem_euclid(2.0 * half_facet) - half_facet;
        half_facet.cos() / off_middle.cos()
    }

    /// Returns the proportions in percent and degrees, as people write them.
    pub fn derived(&self) -> Derived {
        let degrees = |tangent: f64| tangent.atan().to_degrees();
        let percent = |radii: f64| 50.0 * radii;
        Derived {
            crown_angle: degrees(self.tan_crown),
            crown_height: percent(self.crown_height()),
            pavilion_angle: degrees(self.tan_pavilion),
            pavilion_depth: percent(self.pavilion_depth()),
            star_angle: degrees(self.tan_star()),
            upper_half_angle: degrees(self.tan_upper()),
            lower_half_angle: degrees(self.tan_lower()),
            lower_half_length: 100.0 * self.lower,
            lower_half_length_vertical: 100.0 * self.lower_vertical(),
            girdle_thickness_valley: percent(self.girdle - self.valley_depth()),
            total_depth: percent(self.total_depth()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::round_brilliant::MODERN;
    use super::*;
    use crate::random;
    use proptest::prelude::*;

    /// Table, crown, pavilion and lower half; then the crown height, the pavilion depth, the angles of star, upper and lower
    /// half, and the radius and height of the star tip, from docs/optics.md.
    const WORKED: [([f64; 4], [f64; 7]); 2] = [
        (
            [53.0, 34.5, 40.75, 75.0],
            [
                16.1511025271,
                43.0827563257,
                23.0697227837,
                40.5782132333,
                42.0133954137,
                0.7448280761,
                0.2143413402,
            ],
        ),
        (
            [56.0, 34.5, 40.8, 77.0],
            [
                15.1201810892,
                43.1588422614,
                21.8702020280,
                40.9726505767,
                41.9903233148,
                0.7586862691,
                0.2055418753,
            ],
        ),
    ];

    fn bent(table: f64, crown: f64, pavilion: f64, lower: f64) -> RoundBrilliant {
        RoundBrilliant {
            table,
            crown: Crown::Angle(crown),
            pavilion: Pavilion::Angle(pavilion),
            lower_half: LowerHalf::Radial(lower),
            ..MODERN
        }
    }

    #[test]
    fn the_worked_tables_hold_to_one_part_in_a_billion() {
        for ([table, crown, pavilion, lower], expected) in WORKED {
            let given = bent(table, crown, pavilion, lower);
            let derived = given.derived().unwrap();
            let (radius, height) = Proportions::unchecked(&given).star_tip();
            let found = [
                derived.crown_height,
                derived.pavilion_depth,
                derived.star_angle,
                derived.upper_half_angle,
                derived.lower_half_angle,
                radius,
                height,
            ];
            for (found, expected) in found.into_iter().zip(expected) {
                assert!((found - expected).abs() < 1e-9, "{found} is not {expected}");
            }
        }
    }

    #[test]
    fn a_round_girdles_valley_is_thinner_by_the_two_worked_depths() {
        let chord = 1.0 - HALF_AZIMUTH.cos();
        let proportions = Proportions::unchecked(&MODERN);
        assert!((50.0 * chord * proportions.tan_upper() - 0.8344).abs() < 5e-5);
        assert!((50.0 * chord * proportions.tan_lower() - 0.8648).abs() < 5e-5);
        for (count, tolerance) in [(64, 1e-12), (96, 1e-12), (128, 1e-12), (80, 0.07), (127, 0.01)] {
            let derived = RoundBrilliant { girdle_facets: count, ..MODERN }.derived().unwrap();
            let round = 3.0 - 50.0 * chord * (proportions.tan_upper() + proportions.tan_lower());
            assert!((derived.girdle_thickness_valley - round).abs() < tolerance, "{count}: {derived:?}");
        }
    }

    #[test]
    fn sixteen_girdle_facets_have_no_valley() {
        let derived = RoundBrilliant { girdle_facets: 16, ..MODERN }.derived().unwrap();
        assert!((derived.girdle_thickness_valley - 3.0).abs() < 1e-12);
    }

    #[test]
    fn the_girdles_outline_has_its_corners_at_radius_one() {
        let proportions = Proportions::unchecked(&RoundBrilliant { girdle_facets: 24, ..MODERN });
        assert!((proportions.girdle_radius(0.0) - 1.0).abs() < 1e-15);
        assert!(
            (proportions.girdle_radius(22.5_f64.to_radians()) - 7.5_f64.to_radians().cos()).abs() < 1e-15
        );
    }

    #[test]
    fn a_culet_takes_its_share_of_the_depth() {
        let whole = MODERN.derived().unwrap();
        let cut = RoundBrilliant { culet: 10.0, ..MODERN }.derived().unwrap();
        assert!((cut.pavilion_depth - 0.9 * whole.pavilion_depth).abs() < 1e-12);
        assert_eq!(cut.lower_half_angle, whole.lower_half_angle);
        assert!((cut.total_depth - (cut.crown_height + 3.0 + cut.pavilion_depth)).abs() < 1e-12);
    }

    proptest! {
        #[test]
        fn either_member_of_each_pair_gives_the_same_stone(given in random::proportions()) {
            let derived = given.derived().unwrap();
            let by_lengths = RoundBrilliant {
                crown: Crown::Height(derived.crown_height),
                pavilion: Pavilion::Depth(derived.pavilion_depth),
                lower_half: LowerHalf::Vertical(derived.lower_half_length_vertical),
                ..given
            };
            let by_angles = RoundBrilliant {
                crown: Crown::Angle(derived.crown_angle),
                pavilion: Pavilion::Angle(derived.pavilion_angle),
                lower_half: LowerHalf::Radial(derived.lower_half_length),
                ..given
            };
            for other in [by_lengths.derived().unwrap(), by_angles.derived().unwrap()] {
                prop_assert!((other.crown_angle - derived.crown_angle).abs() < 1e-10);
                prop_assert!((other.total_depth - derived.total_depth).abs() < 1e-10 * derived.total_depth);
                prop_assert!((other.lower_half_angle - derived.lower_half_angle).abs() < 1e-10);
            }
        }

        #[test]
        fn angles_grow_from_star_to_bezel_to_upper_half_and_from_main_to_lower_half(
            given in random::proportions(),
        ) {
            let derived = given.derived().unwrap();
            prop_assert!(0.0 < derived.star_angle && derived.star_angle < derived.crown_angle);
            prop_assert!(derived.crown_angle < derived.upper_half_angle && derived.upper_half_angle < 90.0);
            prop_assert!(derived.pavilion_angle < derived.lower_half_angle && derived.lower_half_angle < 90.0);
        }

        #[test]
        fn no_girdle_is_thinner_than_a_round_one_in_its_valleys(given in random::proportions()) {
            let round = RoundBrilliant { girdle_facets: 32, ..given }.derived().unwrap();
            prop_assert!(
                given.derived().unwrap().girdle_thickness_valley >= round.girdle_thickness_valley - 1e-9
            );
        }
    }
}
