//! Tests for step cuts and chevron cuts: the number of facets that their counts make, and the shape of their rows.

use super::tests::{made, on_random_cuts, stone, tiers};
use super::*;
use crate::tier_stem;
use glam::{DVec2, DVec3};
use proptest::prelude::*;

/// The families of this file's kernels with the number of sides of their outlines.
const SIDES: [(&str, usize); 10] = [
    ("emerald", 8),
    ("asscher", 8),
    ("baguette", 4),
    ("tapered_baguette", 4),
    ("kite", 4),
    ("hexagon", 6),
    ("princess", 8),
    ("radiant", 8),
    ("barion", 8),
    ("cushion_barion", 16),
];

fn sides(family: &Family) -> Option<usize> {
    SIDES.into_iter().find(|(key, _)| *key == family.key).map(|(_, sides)| sides)
}

/// Returns the numbers of facets of the crown with its table, of the girdle, and of the pavilion without a culet.
fn expected(family: &Family, cut: &Cut) -> Option<[usize; 3]> {
    let sides = sides(family)?;
    let value = |key: &str| family.proportion(key).map_or(f64::NAN, |row| (row.get)(cut));
    let rows = |key: &str| value(key) as usize * sides;
    let chevrons = 4 * (2 * value("chevrons") as usize + 1) + 4;
    let girdle = if value("girdle_thickness") > 0.0 { sides } else { 0 };
    let [crown, pavilion] = match family.key {
        "princess" => [20, chevrons],
        "radiant" if value("crown_rows") == 0.0 => [24, chevrons + 4],
        "radiant" => [rows("crown_rows"), chevrons + 4],
        "barion" => [rows("crown_rows"), 28],
        "cushion_barion" => [rows("crown_rows"), 36],
        _ => [rows("crown_rows"), rows("pavilion_rows")],
    };
    Some([1 + crown, girdle, pavilion])
}

#[test]
fn every_count_makes_its_facets() {
    let counted = on_random_cuts(|family, cut| {
        let (Some(expected), Some((stone, _))) = (expected(family, cut), stone(cut)) else {
            return Ok(false);
        };
        let zone = |up: f64| {
            let facets = stone.facets().iter().map(|facet| facet.plane.normal.z);
            facets.filter(|z| if up == 0.0 { *z == 0.0 } else { z * up > 0.0 && *z > -1.0 }).count()
        };
        prop_assert_eq!([zone(1.0), zone(0.0), zone(-1.0)], expected, "{:?}", cut);
        Ok(true)
    });
    assert_eq!(counted.iter().filter(|(_, count)| *count >= 240).count(), SIDES.len(), "{counted:?}");
}

#[test]
fn the_facets_of_the_trade_are_those_of_first_cuts() {
    // Numbers of facets with table and girdle, without a culet except for the radiant; the sources are those of the
    // families.
    let trade = [
        ("emerald", 49 + 8),
        ("baguette", 17),
        ("princess", 57 + 4),
        ("radiant", 70),
        ("barion", 61),
        // This is the number of facets of PC 09.083, a barion cushion of 20 sides.
        ("cushion_barion", 101),
    ];
    for (key, facets) in trade {
        let (family, _) = made().find(|(family, _)| family.key == key).expect("it is a family");
        let (stone, names) = stone(&family.first).expect("the first cut is a stone");
        assert_eq!(stone.facets().len(), facets, "{key}: {:?}", tiers(&names));
    }
}

#[test]
fn rows_of_step_cuts_run_level_and_every_side_has_one() {
    on_random_cuts(|family, cut| {
        let Some(sides) = sides(family) else { return Ok(false) };
        let Some((stone, names)) = stone(cut) else { return Ok(false) };
        let is_step = |name: &str| {
            ["crown_", "pavilion_"].iter().any(|row| {
                name.strip_prefix(row).is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()))
            })
        };
        for (facet, name) in stone.facets().iter().zip(&names).filter(|(_, name)| is_step(name)) {
            let corners: Vec<DVec3> = stone.corners(facet).collect();
            let around = corners.iter().zip(corners.iter().cycle().skip(1));
            let level = around.filter(|(a, b)| (a.z - b.z).abs() < 1e-9 && a.distance(**b) > 1e-9).count();
            prop_assert!(level >= 1, "{name} has no level edge in {cut:?}");
        }
        let rows = tiers(&names).into_iter().filter(|(tier, _)| is_step(tier));
        for (tier, count) in rows {
            prop_assert_eq!(count, sides, "{}", tier);
        }
        Ok(true)
    });
}

#[test]
fn crown_and_pavilion_are_as_steep_as_given() {
    on_random_cuts(|family, cut| {
        if !matches!(family.key, "emerald" | "asscher" | "baguette" | "hexagon") {
            return Ok(false);
        }
        let value = |key: &str| family.proportion(key).map_or(f64::NAN, |row| (row.get)(cut));
        let [table, crown, girdle, pavilion] =
            ["table", "crown_angle", "girdle_thickness", "pavilion_angle"].map(value);
        let Some((stone, _)) = stone(cut) else { return Ok(false) };
        let (low, high) = stone.bounds();
        let slope = |percent: f64, angle: f64| percent / 100.0 * angle.to_radians().tan();
        prop_assert!((high.z - slope(100.0 - table, crown)).abs() < 1e-9, "{high}");
        prop_assert!((-low.z - girdle / 50.0 - slope(100.0, pavilion)).abs() < 1e-9, "{low}");
        Ok(true)
    });
}

#[test]
fn chevrons_fan_out_from_the_corners_of_the_girdle() {
    on_random_cuts(|family, cut| {
        if family.proportion("chevrons").is_none() {
            return Ok(false);
        }
        let Some((stone, names)) = stone(cut) else { return Ok(false) };
        let value = |key: &str| family.proportion(key).map_or(f64::NAN, |row| (row.get)(cut));
        let (length, corner) = (value("length_to_width"), value("corner") / 50.0);
        let below = -value("girdle_thickness") / 50.0;
        let ends = [DVec2::new(1.0, length - corner), DVec2::new(1.0 - corner, length)];
        for (facet, name) in stone.facets().iter().zip(&names).filter(|(_, name)| name.starts_with("chevron"))
        {
            let corners: Vec<DVec3> = stone.corners(facet).collect();
            let meets = |end: &DVec2| {
                corners
                    .iter()
                    .any(|at| at.abs().truncate().distance(*end) < 1e-9 && (at.z - below).abs() < 1e-9)
            };
            prop_assert!(ends.iter().any(meets), "{name}: {corners:?}");
        }
        Ok(true)
    });
}

#[test]
fn both_ends_of_a_stone_are_alike_but_for_kites_and_tapered_baguettes() {
    on_random_cuts(|family, cut| {
        if sides(family).is_none() {
            return Ok(false);
        }
        let Some((stone, _)) = stone(cut) else { return Ok(false) };
        let turned = |corner: &DVec3| DVec3::new(corner.x, -corner.y, corner.z);
        let has = |at: DVec3| stone.vertices().iter().any(|other| other.distance(at) < 1e-7);
        let alike = stone.vertices().iter().map(turned).all(has);
        // A kite whose shoulder is in its middle is a lozenge, which random numbers never make.
        prop_assert_eq!(alike, !matches!(family.key, "kite" | "tapered_baguette"), "{:?}", cut);
        Ok(true)
    });
}

#[test]
fn facets_between_points_have_no_other_corners() {
    // A facet that another facet cuts, where it should only touch it, would have one corner more.
    let corners = [
        ("star", 3),
        ("main_2", 3),
        ("corner_2", 3),
        ("pavilion_side", 3),
        ("chevron_4", 3),
        ("chevron_3", 3),
        ("chevron_2", 3),
        ("lower_half", 3),
        ("half_moon", 5),
        ("end_moon", 3),
    ];
    on_random_cuts(|family, cut| {
        if !matches!(family.key, "princess" | "radiant" | "barion" | "cushion_barion") {
            return Ok(false);
        }
        let Some((stone, names)) = stone(cut) else { return Ok(false) };
        for (facet, name) in stone.facets().iter().zip(&names) {
            let Some((_, expected)) = corners.iter().find(|(tier, _)| *tier == tier_stem(name)) else {
                continue;
            };
            let found: Vec<DVec3> = stone.corners(facet).collect();
            let next = found.iter().cycle().skip(1);
            let count = found.iter().zip(next).filter(|(a, b)| a.distance(**b) > 1e-7).count();
            prop_assert_eq!(count, *expected, "{} of {:?}", name, cut);
        }
        Ok(true)
    });
}
