//! Tests for every family whose facets a function makes: random numbers make stones, and errors name limits.

use super::super::outline::diameter;
use super::*;
use crate::{FamilySolid, ProportionError, tier_stem};
use brillianteer_base::Unit;
use brillianteer_math::{Calipers, Plane, Polytope, bounds, hull};
use glam::DVec3;
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRng, TestRunner};
use std::collections::BTreeMap;

/// Returns the families that this folder makes.
pub(super) fn made() -> impl Iterator<Item = (&'static Family, FamilyCut)> {
    FAMILIES.into_iter().filter_map(|family| match &family.first {
        Cut::Family(cut) => Some((family, *cut)),
        _ => None,
    })
}

/// Returns the cut whose numbers lie at these parts of their usual ranges.
fn at(family: &'static Family, parts: &[f64]) -> Cut {
    let mut cut = family.first.clone();
    for (row, part) in family.editable().zip(parts) {
        let [least, most] = row.usual;
        row.set(&mut cut, least + (most - least) * part);
    }
    cut
}

/// Runs a check on 300 cuts of each family at random numbers inside their usual ranges. Returns, for each family, the
/// number of cuts that make a stone.
pub(super) fn on_random_cuts(
    check: impl Fn(&'static Family, &Cut) -> Result<bool, TestCaseError>,
) -> Vec<(&'static str, u32)> {
    let mut counts = vec![];
    for (family, _) in made() {
        let config = Config { cases: 300, failure_persistence: None, ..Config::default() };
        let rng = TestRng::deterministic_rng(config.rng_algorithm);
        let made = std::cell::Cell::new(0);
        let parts = prop::collection::vec(0.0..=1.0, family.editable().count());
        let result = TestRunner::new_with_rng(config, rng).run(&parts, |parts| {
            made.set(made.get() + u32::from(check(family, &at(family, &parts))?));
            Ok(())
        });
        assert_eq!(result, Ok(()), "{}", family.key);
        counts.push((family.key, made.get()));
    }
    counts
}

/// The properties of a stone that the tests use, whether it is convex or not.
pub(super) struct Solid {
    pub vertices: Vec<DVec3>,
    /// The planes of the facets, with their names.
    pub facets: Vec<(String, Plane)>,
    /// The number of facets of each tier.
    pub tiers: BTreeMap<String, usize>,
    pub volume: f64,
    /// The extents along x, y and z.
    pub size: DVec3,
}

impl Solid {
    /// Makes the stone of a cut; `None` where its numbers cross a limit.
    pub fn of(cut: &Cut) -> Option<Self> {
        let Cut::Family(family_cut) = cut else { return None };
        let (planes, names, vertices, volume) = match family_cut.solid().ok()? {
            FamilySolid::Mesh(mesh) => {
                let names = mesh.facet_names().into_iter().map(str::to_owned).collect();
                (mesh.planes().to_vec(), names, mesh.vertices().to_vec(), mesh.volume())
            }
            FamilySolid::Convex(stone, names) => {
                (stone.planes().collect(), names, stone.vertices().to_vec(), stone.volume())
            }
        };
        assert_eq!(names.len(), planes.len(), "{} has facets without names", family_cut.family.key);
        let facets: Vec<_> = names.into_iter().zip(planes).collect();
        let mut tiers = BTreeMap::new();
        facets.iter().for_each(|(name, _)| *tiers.entry(tier_stem(name).to_owned()).or_default() += 1);
        let (low, high) = bounds(vertices.iter().copied());
        Some(Self { vertices, facets, tiers, volume, size: high - low })
    }

    /// Returns the number of facets of each tier except girdle and culet.
    fn lasting_tiers(&self) -> Vec<(&str, usize)> {
        let tiers = self.tiers.iter().map(|(tier, count)| (tier.as_str(), *count));
        tiers.filter(|(tier, _)| !["girdle", "culet"].contains(tier)).collect()
    }
}

/// Returns a convex stone with the names of its facets; `None` where the numbers of the cut cross a limit.
pub(super) fn stone(cut: &Cut) -> Option<(Polytope, Vec<String>)> {
    let Cut::Family(cut) = cut else { return None };
    let (names, planes): (Vec<_>, Vec<_>) = cut.facets().ok()?.into_iter().unzip();
    let stone = Polytope::from_planes(&planes).expect("a checked net is closed");
    let names = stone.facets().iter().map(|facet| names[facet.source].clone()).collect();
    Some((stone, names))
}

/// Counts the facets of each tier except the girdle.
pub(super) fn tiers(names: &[String]) -> BTreeMap<&str, usize> {
    let mut tiers = BTreeMap::new();
    for name in names.iter().map(|name| tier_stem(name)).filter(|name| *name != "girdle") {
        *tiers.entry(name).or_default() += 1;
    }
    tiers
}

/// Returns the number of facets without girdle and culet that the counts of a cut require; `None` for families that
/// have their own tests of it.
fn counted(family: &Family, cut: &Cut) -> Option<f64> {
    let count = |key: &str| family.proportion(key).map_or(f64::NAN, |row| (row.get)(cut));
    match family.key {
        "portuguese" => Some(1.0 + count("facets") * (count("crown_rows") + count("pavilion_rows"))),
        "briolette" => Some(count("facets") * (count("upper_rows") + count("lower_rows"))),
        "rose" => Some(1.0 + count("sides") * if count("rows") == 1.0 { 1.0 } else { 4.0 }),
        _ => None,
    }
}

#[test]
fn at_random_numbers_a_family_makes_a_stone_or_names_its_limit() {
    let made = on_random_cuts(|_, cut| match cut.check() {
        Ok(()) => {
            let solid = Solid::of(cut).expect("it was checked");
            prop_assert!(solid.volume > 0.0 && solid.facets.iter().all(|(name, _)| !name.is_empty()));
            Ok(true)
        }
        Err(error) => {
            let Some(limit) = error.limit() else { return Err(TestCaseError::fail(error.to_string())) };
            prop_assert!(!limit.tier.is_empty() || limit.reason.len() > 8, "{error}");
            Ok(false)
        }
    });
    // Usual ranges are those that designers use, so most of them must fit together.
    assert!(made.iter().all(|(_, count)| *count >= 240), "{made:?}");
}

#[test]
fn length_to_width_is_as_given_and_half_the_diameter_is_one() {
    on_random_cuts(|family, cut| {
        let Some(Solid { size, vertices, .. }) = Solid::of(cut) else { return Ok(false) };
        let expected = family.proportion("length_to_width").map_or(f64::NAN, |row| (row.get)(cut));
        if !expected.is_nan() {
            let found = match family.key {
                // A drop is long along its axis, and its width is its diameter.
                "briolette" => size.z / 2.0,
                // The length of a trillion follows, and is measured as that of any stone.
                "trillion" => size.x / size.y,
                _ => size.y / size.x,
            };
            prop_assert!((found - expected).abs() < 1e-9, "{found} for {expected}");
        }
        // A stone that is read from another format is measured by its hull, and must have the same size.
        let outline = hull(vertices.iter().map(|corner| corner.truncate()).collect());
        let Some(Calipers { width, middle, .. }) = Calipers::of_stone(&outline) else { return Ok(false) };
        let diameter = diameter(&outline, middle, width);
        prop_assert!((diameter - 2.0).abs() < 1e-9, "{diameter} in {size}");
        Ok(true)
    });
}

#[test]
fn every_stone_has_the_facets_of_its_first_cut_and_its_mirror_symmetry() {
    let first = |family: &Family| Solid::of(&family.first).expect("the first cut is a stone");
    let firsts: BTreeMap<&str, Solid> = made().map(|(family, _)| (family.key, first(family))).collect();
    on_random_cuts(|family, cut| {
        let Some(solid) = Solid::of(cut) else { return Ok(false) };
        if !family.editable().any(|row| row.unit == Unit::Count) {
            prop_assert_eq!(solid.lasting_tiers(), firsts[family.key].lasting_tiers());
        }
        if let Some(expected) = counted(family, cut) {
            let count: usize = solid.lasting_tiers().into_iter().map(|(_, count)| count).sum();
            prop_assert_eq!(count as f64, expected, "{:?}", solid.lasting_tiers());
        }
        for corner in &solid.vertices {
            let mirrored = DVec3::new(-corner.x, corner.y, corner.z);
            let near = solid.vertices.iter().any(|other| other.distance(mirrored) < 1e-7);
            prop_assert!(near, "{corner} has no mirror image");
        }
        Ok(true)
    });
}

#[test]
fn impossible_numbers_name_a_limit_that_makes_a_stone() {
    let mut checked = 0;
    for (family, _) in made() {
        for row in family.editable().filter(|row| row.unit != Unit::Count) {
            for value in [-40.0, 0.0, 96.0, 150.0, 1e7] {
                let mut cut = family.first.clone();
                row.set(&mut cut, value);
                let Err(error) = cut.check() else { continue };
                let (ProportionError::TooLarge(limit) | ProportionError::TooSmall(limit)) = error else {
                    panic!("{error}")
                };
                if limit.inclusive && limit.row == row {
                    row.set(&mut cut, limit.limit);
                    assert!(
                        cut.check().is_ok() || !limit.tier.is_empty() || cut.check() != Err(error),
                        "{error}"
                    );
                }
                checked += 1;
            }
        }
    }
    assert!(checked > 20, "{checked}");
}

#[test]
fn every_family_is_in_one_group() {
    for family in FAMILIES {
        let groups = GROUPS.iter().filter(|(_, families)| families.contains(&family.key));
        assert_eq!(groups.count(), 1, "{}", family.key);
    }
}

#[test]
fn facets_are_named_by_tier() {
    for (family, cut) in made() {
        let solid = Solid::of(&Cut::Family(cut)).unwrap();
        let has_table = !["briolette", "rose"].contains(&family.key);
        assert_eq!(solid.tiers.contains_key("table"), has_table, "{}", family.key);
        let mut girdle = solid.facets.iter().filter(|(_, plane)| plane.normal.z.abs() < 1e-9);
        assert!(girdle.all(|(name, _)| name.starts_with("girdle")), "{}", family.key);
    }
}

#[test]
fn counts_make_as_many_facets_as_they_say() {
    let tests = [
        ("oval", "mains_per_quarter", 3.0, "main", 12),
        ("cushion", "mains_per_quarter", 4.0, "bezel", 16),
        ("marquise", "mains_per_quarter", 4.0, "main", 16),
        ("pear", "mains_per_quarter", 3.0, "star", 12),
        ("trillion", "mains_per_side", 3.0, "main", 9),
        ("heart", "mains_per_half", 6.0, "bezel", 13),
        ("modified_cushion", "rows", 2.0, "chevron_2", 8),
        ("modified_cushion", "rows", 4.0, "chevron_4", 8),
    ];
    for (key, row, value, tier, expected) in tests {
        let family = Family::of_key(key).unwrap();
        let mut cut = family.first.clone();
        family.proportion(row).unwrap().set(&mut cut, value);
        assert_eq!(Solid::of(&cut).unwrap().tiers[tier], expected, "{key} {row} {value}");
    }
}

#[test]
fn a_heart_has_a_cleft_and_others_are_convex() {
    for (family, _) in made() {
        let solid = Solid::of(&family.first).unwrap();
        let beyond = |plane: &Plane| solid.vertices.iter().any(|corner| plane.distance(*corner) > 1e-6);
        let overtopped = solid.facets.iter().filter(|(_, plane)| beyond(plane)).count();
        assert_eq!(overtopped > 0, family.key == "heart", "{}: {overtopped}", family.key);
    }
}
