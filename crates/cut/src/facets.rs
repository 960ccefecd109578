//! The planes of the round brilliant, tier by tier, from its closed form.
//!
//! A tier is given by a slope, the azimuth of its first facet and an offset, as in the facet table of docs/optics.md. A
//! pavilion facet at the angle b from the girdle plane has the slope π - b.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::proportions::{HALF_AZIMUTH, Proportions, STAR_AZIMUTH};
use brillianteer_math::Plane;

/// Returns every facet's name and plane, in the order of the tiers.
pub(super) fn round_brilliant(p: &Proportions) -> Vec<(String, Plane)> {
    let mut facets = vec![("table".to_owned(), Plane::new(DVec3::Z, p.crown_height()))];
    facets.extend(crown(p));
    if p.girdle > 0.0 {
        facets.extend(girdle(p.girdle_facets));
    }
    facets.extend(pavilion(p));
    if p.culet > 0.0 {
        facets.push(("culet".to_owned(), Plane::new(DVec3::NEG_Z, p.girdle + p.pavilion_depth())));
    }
    facets
}

fn crown(p: &Proportions) -> impl Iterator<Item = (String, Plane)> {
    let [bezel, star, upper] = [p.tan_crown, p.tan_star(), p.tan_upper()].map(f64::atan);
    let star_offset = p.table * STAR_AZIMUTH.cos() * star.sin() + p.crown_height() * star.cos();
    tier("bezel", 8, 0.0, bezel, bezel.sin())
        .chain(tier("star", 8, STAR_AZIMUTH, star, star_offset))
        .chain(tier("upper_half", 16, HALF_AZIMUTH, upper, HALF_AZIMUTH.cos() * upper.sin()))
}

/// The normals are written without a slope, so that their z is exactly 0.
fn girdle(count: u32) -> impl Iterator<Item = (String, Plane)> {
    let offset = (PI / f64::from(count)).cos();
    (0..count).map(move |k| {
        let (sin, cos) = ((f64::from(k) + 0.5) * TAU / f64::from(count)).sin_cos();
        (format!("girdle {}", k + 1), Plane::new(DVec3::new(cos, sin, 0.0), offset))
    })
}

fn pavilion(p: &Proportions) -> impl Iterator<Item = (String, Plane)> {
    let [lower, main] = [p.tan_lower(), p.tan_pavilion].map(f64::atan);
    let lower_offset = HALF_AZIMUTH.cos() * lower.sin() + p.girdle * lower.cos();
    let main_offset = main.sin() + p.girdle * main.cos();
    tier("lower_half", 16, HALF_AZIMUTH, PI - lower, lower_offset).chain(tier(
        "main",
        8,
        0.0,
        PI - main,
        main_offset,
    ))
}

/// Returns `count` facets of one slope and offset, spaced evenly around the axis from the azimuth `first`. Angles are in
/// radians.
fn tier(
    name: &str,
    count: u32,
    first: f64,
    slope: f64,
    offset: f64,
) -> impl Iterator<Item = (String, Plane)> {
    (0..count).map(move |k| {
        let azimuth = first + f64::from(k) * TAU / f64::from(count);
        (format!("{name} {}", k + 1), Plane::from_slope(slope, azimuth, offset))
    })
}

#[cfg(test)]
mod tests {
    use super::super::round_brilliant::{MODERN, RoundBrilliant};
    use super::*;
    use crate::random;
    use proptest::prelude::*;

    /// Tolerance for the rounding of a few sines and divisions, in stones up to a few radii deep.
    const EXACT: f64 = 1e-12;

    fn at(azimuth: f64, radius: f64, z: f64) -> DVec3 {
        DVec3::new(radius * azimuth.cos(), radius * azimuth.sin(), z)
    }

    /// Returns the names of the planes through a point, without their numbers. The point must lie inside all planes but the
    /// girdle's.
    fn meeting(facets: &[(String, Plane)], point: DVec3) -> Vec<String> {
        let tolerance = EXACT * point.length().max(1.0);
        for (name, plane) in facets.iter().filter(|(name, _)| !name.starts_with("girdle")) {
            assert!(plane.distance(point) < tolerance, "{point} lies outside {name}");
        }
        let touching = facets.iter().filter(|(_, plane)| plane.distance(point).abs() < tolerance);
        touching
            .map(|(name, _)| name.trim_end_matches(|c: char| c.is_ascii_digit()).trim().to_owned())
            .collect()
    }

    fn names(facets: &[(String, Plane)]) -> Vec<&str> {
        facets.iter().map(|(name, _)| name.as_str()).collect()
    }

    #[test]
    fn a_brilliant_of_sixteen_girdle_facets_has_seventy_three_and_a_culet_is_one_more() {
        let stone = RoundBrilliant { girdle_facets: 16, ..MODERN };
        assert_eq!(stone.facets().unwrap().len(), 73);
        let with_culet = RoundBrilliant { culet: 1.0, ..stone }.facets().unwrap();
        assert_eq!(with_culet.len(), 74);
        assert_eq!(with_culet[73].0, "culet");
        assert_eq!(with_culet[73].1.normal, DVec3::NEG_Z);
    }

    #[test]
    fn facets_are_named_by_tier_and_numbered_from_one() {
        let facets = RoundBrilliant { girdle_facets: 16, ..MODERN }.facets().unwrap();
        let names = names(&facets);
        let first = ["table", "bezel 1", "star 1", "upper_half 1", "girdle 1", "lower_half 1", "main 1"];
        let last = ["bezel 8", "star 8", "upper_half 16", "girdle 16", "lower_half 16", "main 8"];
        assert!(first.iter().chain(&last).all(|name| names.contains(name)), "{names:?}");
        let unique: std::collections::BTreeSet<_> = names.iter().collect();
        assert_eq!(unique.len(), names.len());
    }

    #[test]
    fn a_girdle_without_thickness_has_no_facets() {
        let facets = RoundBrilliant { girdle_thickness: 0.0, ..MODERN }.facets().unwrap();
        assert!(names(&facets).iter().all(|name| !name.starts_with("girdle")));
    }

    #[test]
    fn the_offsets_are_those_of_the_facet_table() {
        let facets = MODERN.facets().unwrap();
        let offset = |name: &str| facets.iter().find(|(found, _)| found == name).unwrap().1.offset;
        let (c, p, g) = (34.5_f64.to_radians(), 40.8_f64.to_radians(), 0.06);
        let star = 21.8702020280_f64.to_radians();
        let upper = 40.9726505767_f64.to_radians();
        let lower = 41.9903233148_f64.to_radians();
        let [th, h] = [22.5_f64, 11.25].map(|degrees| degrees.to_radians().cos());
        let hc = 0.302403621784;
        let expected = [
            ("table", hc),
            ("bezel 3", c.sin()),
            ("star 5", 0.56 * th * star.sin() + hc * star.cos()),
            ("upper_half 7", h * upper.sin()),
            ("girdle 9", (180.0_f64 / 96.0).to_radians().cos()),
            ("lower_half 11", h * lower.sin() + g * lower.cos()),
            ("main 4", p.sin() + g * p.cos()),
        ];
        for (name, value) in expected {
            assert!((offset(name) - value).abs() < 1e-9, "{name}: {} is not {value}", offset(name));
        }
    }

    proptest! {
        #[test]
        fn the_crown_meets_point_to_point(given in random::proportions(), k in 0_u32..8) {
            let facets = given.facets().unwrap();
            let p = Proportions::unchecked(&given);
            let bezel = f64::from(k) * TAU / 8.0;
            let corner = meeting(&facets, at(bezel, p.table, p.crown_height()));
            prop_assert_eq!(corner, ["table", "bezel", "star", "star"]);
            let (radius, height) = p.star_tip();
            let tip = meeting(&facets, at(bezel + STAR_AZIMUTH, radius, height));
            let outline = tip.iter().filter(|name| *name != "girdle").map(String::as_str);
            prop_assert_eq!(outline.collect::<Vec<_>>(), ["bezel", "bezel", "star", "upper_half", "upper_half"]);
        }

        #[test]
        fn halves_and_bezels_meet_at_the_girdles_edges(given in random::proportions(), k in 0_u32..8) {
            let given = RoundBrilliant { girdle_facets: 16 * (1 + k), girdle_thickness: 3.0, ..given };
            let facets = given.facets().unwrap();
            let bezel = f64::from(k) * TAU / 8.0;
            let upper = meeting(&facets, at(bezel, 1.0, 0.0));
            prop_assert_eq!(upper, ["bezel", "upper_half", "upper_half", "girdle", "girdle"]);
            let lower = meeting(&facets, at(bezel, 1.0, -0.06));
            prop_assert_eq!(lower, ["girdle", "girdle", "lower_half", "lower_half", "main"]);
            let between = meeting(&facets, at(bezel + STAR_AZIMUTH, 1.0, 0.0));
            prop_assert_eq!(between, ["upper_half", "upper_half", "girdle", "girdle"]);
        }

        #[test]
        fn the_pavilion_meets_point_to_point(given in random::proportions(), k in 0_u32..8) {
            let facets = RoundBrilliant { culet: 0.0, ..given }.facets().unwrap();
            let p = Proportions::unchecked(&RoundBrilliant { culet: 0.0, ..given });
            // The given depth reaches to the culet, so the same depth without a culet makes another pavilion.
            let apex = meeting(&facets, at(0.0, 0.0, -p.girdle - p.tan_pavilion));
            prop_assert_eq!(apex, ["main"; 8]);
            let tip = at(
                STAR_AZIMUTH + f64::from(k) * TAU / 8.0,
                1.0 - p.lower,
                -p.girdle - p.tan_pavilion * p.lower_vertical(),
            );
            let tip = meeting(&facets, tip);
            let outline = tip.iter().filter(|name| *name != "girdle").map(String::as_str);
            prop_assert_eq!(outline.collect::<Vec<_>>(), ["lower_half", "lower_half", "main", "main"]);
        }

        #[test]
        fn the_culet_is_as_wide_as_it_is_written(given in random::proportions()) {
            let given = RoundBrilliant { culet: given.culet.max(0.5), ..given };
            let facets = given.facets().unwrap();
            let p = Proportions::unchecked(&given);
            let flat = at(0.0, given.culet / 100.0, -p.girdle - p.pavilion_depth());
            let on = |name: &str| facets.iter().find(|(found, _)| found == name).unwrap().1.distance(flat);
            prop_assert!(on("culet").abs() < EXACT * 10.0 && on("main 1").abs() < EXACT * 10.0);
        }

        #[test]
        fn normals_are_unit_vectors(given in random::proportions()) {
            for (name, plane) in given.facets().unwrap() {
                prop_assert!((plane.normal.length() - 1.0).abs() < 1e-15 * 4.0, "{name}");
            }
        }

        #[test]
        fn multiples_of_eight_keep_the_eightfold_mirrors(given in random::proportions(), m in 2_u32..=16) {
            let facets = RoundBrilliant { girdle_facets: 8 * m, ..given }.facets().unwrap();
            let mirrored = |normal: DVec3| {
                let (sin, cos) = (2.0 * STAR_AZIMUTH).sin_cos();
                DVec3::new(cos * normal.x + sin * normal.y, sin * normal.x - cos * normal.y, normal.z)
            };
            for (name, plane) in &facets {
                let image = mirrored(plane.normal);
                let found = facets.iter().any(|(_, other)| {
                    other.normal.abs_diff_eq(image, 1e-13) && (other.offset - plane.offset).abs() < 1e-13
                });
                prop_assert!(found, "{name} has no mirror image");
            }
        }
    }
}
