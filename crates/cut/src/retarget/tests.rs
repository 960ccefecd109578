//! Tests of fitting designs to other materials: laws of both rules.

use super::*;
use crate::round_brilliant::MODERN;
use crate::side_scale::tests::square_of_tiers as tiers;
use crate::{Indexed, Tier};
use glam::DVec3;
use proptest::prelude::*;

fn design(cut: Cut, material: &str) -> Design {
    Design {
        name: "test".to_owned(),
        source: None,
        notes: None,
        material: named(material),
        diameter_mm: 6.5,
        cut,
    }
}

fn named(material: &str) -> MaterialRef {
    MaterialRef::Name(material.to_owned())
}

fn stone(design: &Design) -> Polytope {
    Polytope::from_planes(&design.facets().unwrap().into_iter().map(|(_, plane)| plane).collect::<Vec<_>>())
        .unwrap()
}

/// Asserts that both stones have the same facets and corners, and that the pavilion of the second is that of the first,
/// stretched by a factor about a height.
fn assert_stretched(old: &Polytope, new: &Polytope, level: f64, factor: f64) {
    assert_eq!(old.facets().len(), new.facets().len());
    for (a, b) in old.facets().iter().zip(new.facets()) {
        assert_eq!(a.outline.len(), b.outline.len(), "a facet has other corners");
    }
    let nearest = |point: DVec3| {
        new.vertices().iter().map(|corner| corner.distance(point)).fold(f64::INFINITY, f64::min)
    };
    let pavilion = old.facets().iter().filter(|facet| facet.plane.normal.z < -EXACT);
    let moved: Vec<u32> = pavilion.flat_map(|facet| facet.outline.clone()).collect();
    for (place, corner) in (0..).zip(old.vertices()) {
        let z = if moved.contains(&place) { level + factor * (corner.z - level) } else { corner.z };
        let off = nearest(corner.truncate().extend(z));
        assert!(off < 1e-9, "{corner} is not stretched to its place, by {off}");
    }
}

#[test]
fn a_tangent_ratio_keeps_every_meet_of_tiers_planes_and_brilliants() {
    let cut = Cut::Tiers(tiers());
    let planes = Cut::Planes(design(cut.clone(), "quartz").facets().unwrap());
    for cut in [cut, planes] {
        let old = design(cut, "quartz");
        let found = retarget(&old, named("sapphire"), RetargetRule::PavilionRatio(None)).unwrap();
        assert_eq!(found.main, "P1");
        assert!((found.factor - 1.0).abs() > 0.05, "{}", found.factor);
        let before = stone(&old);
        assert_stretched(&before, &stone(&found.design), Outline::of(&before).girdle_bottom, found.factor);
    }
    let old = design(Cut::RoundBrilliant(MODERN), "diamond");
    let found = retarget(&old, named("sapphire"), RetargetRule::PavilionRatio(Some(1.05))).unwrap();
    let level = -MODERN.girdle_thickness / 50.0;
    let (before, after) = (stone(&old), stone(&found.design));
    let deepest = |stone: &Polytope| stone.bounds().0.z;
    assert!((deepest(&after) - (level + 1.05 * (deepest(&before) - level))).abs() < 1e-12);
    assert_eq!(found.tiers.len(), 2, "mains and lower halves: {:?}", found.tiers);
    for tier in &found.tiers {
        let tan = |degrees: f64| degrees.to_radians().tan();
        assert!((tan(tier.after_deg) / tan(tier.before_deg) - 1.05).abs() < 1e-12, "{tier:?}");
    }
}

#[test]
fn tiers_that_stay_are_not_listed_as_changed() {
    let old = crate::FAMILIES.iter().find(|family| family.key == "oval").unwrap();
    let old = design(old.first.clone(), "diamond");
    let found = retarget(&old, named("sapphire"), RetargetRule::CriticalAngle).unwrap();
    assert!(
        !found.tiers.is_empty() && found.tiers.iter().all(|tier| tier.before_deg < 0.0),
        "{:?}",
        found.tiers
    );
}

#[test]
fn the_main_tier_keeps_its_margin_over_the_critical_angle_under_both_rules() {
    for cut in [Cut::Tiers(tiers()), Cut::RoundBrilliant(MODERN)] {
        for rule in [RetargetRule::CriticalAngle, RetargetRule::PavilionRatio(None)] {
            let found = retarget(&design(cut.clone(), "quartz"), named("spinel"), rule).unwrap();
            let [from, to] = found.critical_deg;
            let main = found.tiers.iter().find(|tier| tier.name == found.main).unwrap();
            let margins = [-main.before_deg - from, -main.after_deg - to];
            assert!((margins[0] - margins[1]).abs() < 1e-9, "{rule:?}: {margins:?}");
            assert!(from > to && found.factor < 1.0);
        }
    }
}

#[test]
fn a_shift_turns_every_pavilion_tier_by_the_same_angle_and_leaves_crown_and_girdle() {
    let old = design(Cut::Tiers(tiers()), "sapphire");
    let found = retarget(&old, named("quartz"), RetargetRule::CriticalAngle).unwrap();
    let [from, to] = found.critical_deg;
    let names: Vec<&str> = found.tiers.iter().map(|tier| tier.name.as_str()).collect();
    assert_eq!(names, ["P1", "P2", "P3"]);
    for tier in &found.tiers {
        assert!((tier.before_deg - tier.after_deg - (to - from)).abs() < 1e-9, "{tier:?}");
    }
    let (Cut::Tiers(before), Cut::Tiers(after)) = (&old.cut, &found.design.cut) else { panic!() };
    for (a, b) in before.tiers.iter().zip(&after.tiers).filter(|(a, _)| a.angle >= 0.0 || a.angle == -90.0) {
        assert_eq!(a, b);
    }
    assert!(
        found
            .design
            .notes
            .as_deref()
            .unwrap()
            .starts_with("Fitted from sapphire to quartz by the difference")
    );
}

#[test]
fn tiers_that_share_a_name_are_listed_each_with_its_own_angle() {
    let mut repeated = tiers();
    repeated.tiers[1].facets.iter_mut().for_each(|facet| facet.name = "P1".to_owned());
    let old = design(Cut::Tiers(repeated), "sapphire");
    let found = retarget(&old, named("quartz"), RetargetRule::CriticalAngle).unwrap();
    let rows: Vec<(&str, usize, f64)> =
        found.tiers.iter().map(|tier| (tier.name.as_str(), tier.facets, tier.before_deg.round())).collect();
    assert_eq!(rows, [("P1", 4, -42.0), ("P1", 4, -55.0), ("P3", 4, -44.0)]);
}

#[test]
fn a_pavilion_tier_that_is_given_beyond_90_degrees_stays_in_the_pavilion() {
    let plain = design(Cut::Tiers(tiers()), "sapphire");
    let mut beyond = tiers();
    beyond.tiers[0].angle = 180.0 - 42.0;
    let beyond = design(Cut::Tiers(beyond), "sapphire");
    let normal = |old: &Design| {
        let found = retarget(old, named("quartz"), RetargetRule::CriticalAngle).unwrap();
        found.design.facets().unwrap()[0].1.normal
    };
    assert!(normal(&beyond).distance(normal(&plain)) < 1e-12, "{} {}", normal(&beyond), normal(&plain));
}

/// Returns a brilliant whose mains meet its breaks at the girdle's corners.
fn meeting() -> Tiers {
    let tier =
        |name: &str, angle: f64, (first, step): (usize, usize), distance: f64, instructions: &str| Tier {
            angle,
            distance,
            instructions: instructions.to_owned(),
            meet: None,
            is_cut: true,
            frosting: 0.0,
            facets: (first..96)
                .step_by(step)
                .map(|index| Indexed { index: index as f64, name: name.to_owned() })
                .collect(),
        };
    let tiers = vec![
        tier("1", -43.0, (3, 6), 0.75, "Cut to TCP"),
        tier("G1", -90.0, (3, 6), 1.0, "Set size"),
        tier("2", -41.0, (0, 12), 0.9, "Meet 1-1-G1"),
        tier("A", 45.0, (3, 6), 0.76, "Set girdle thickness"),
        tier("T", 0.0, (0, 96), 0.5, ""),
    ];
    let design = Tiers { gear: 96, symmetry: 8, mirror: true, tiers, ..Tiers::default() };
    Tiers { tiers: design.with_stated_meets().solved().tiers.tiers, ..design }
}

#[test]
fn a_shift_keeps_the_meets_of_tiers_that_state_or_show_them() {
    let meeting = meeting();
    let mut silent = meeting.clone();
    for tier in &mut silent.tiers {
        (tier.meet, tier.instructions) = (None, String::new());
    }
    for cut in [meeting, silent] {
        let old = design(Cut::Tiers(cut), "quartz");
        let corners = stone(&old).vertices().len();
        for material in ["sapphire", "diamond"] {
            let found = retarget(&old, named(material), RetargetRule::CriticalAngle).unwrap();
            assert_eq!(stone(&found.design).vertices().len(), corners, "{material}: {:?}", found.notes);
            let (Cut::Tiers(before), Cut::Tiers(after)) = (&old.cut, &found.design.cut) else { panic!() };
            let shift = found.tiers[0].after_deg - found.tiers[0].before_deg;
            for (a, b) in before.tiers.iter().zip(&after.tiers) {
                let expected = if a.angle < 0.0 && a.angle > -90.0 { a.angle + shift } else { a.angle };
                assert!((b.angle - expected).abs() < 1e-9, "{a:?} {b:?}");
                assert_eq!((&a.meet, &a.instructions), (&b.meet, &b.instructions));
            }
            // Turned about the girdle alone, the tiers of two angles miss one another.
            let Cut::Tiers(mut open) = found.design.cut.clone() else { panic!() };
            open.tiers[2].distance *= 1.001;
            let open = Design { cut: Cut::Tiers(open), ..found.design };
            assert!(stone(&open).vertices().len() != corners, "the comparison cannot fail");
        }
    }
}

#[test]
fn there_and_back_is_where_it_began() {
    for rule in [RetargetRule::CriticalAngle, RetargetRule::PavilionRatio(None)] {
        let old = design(Cut::Tiers(tiers()), "quartz");
        let there = retarget(&old, named("diamond"), rule).unwrap().design;
        let back = retarget(&there, named("quartz"), rule).unwrap().design;
        let (Cut::Tiers(before), Cut::Tiers(after)) = (&old.cut, &back.cut) else { panic!() };
        for (a, b) in before.tiers.iter().zip(&after.tiers) {
            assert!((a.angle - b.angle).abs() < 1e-9, "{rule:?}: {} {}", a.angle, b.angle);
        }
    }
}

#[test]
fn a_factor_of_the_crown_changes_the_crown_alone() {
    let old = design(Cut::Tiers(tiers()), "quartz");
    let found = retarget(&old, named("quartz"), RetargetRule::CrownRatio(0.8)).unwrap();
    let names: Vec<&str> = found.tiers.iter().map(|tier| tier.name.as_str()).collect();
    assert_eq!(names[0], "C");
    let height = |design: &Design| Outline::of(&stone(design)).crown_height();
    assert!((height(&found.design) / height(&old) - 0.8).abs() < 1e-9);
}

#[test]
fn what_cannot_be_fitted_says_why() {
    let old = design(Cut::RoundBrilliant(MODERN), "diamond");
    let told = |material: MaterialRef, rule| retarget(&old, material, rule).unwrap_err().to_string();
    let ratio = RetargetRule::PavilionRatio;
    assert!(told(MaterialRef::Index(1.0), ratio(None)).contains("no critical angle"));
    assert!(told(named("ruby"), ratio(Some(f64::NAN))).starts_with("the factor NaN must be from 0.1"));
    assert!(told(named("unobtainium"), ratio(None)).contains("unknown material"));
    let mut steep = tiers();
    steep.tiers[1].angle = -85.0;
    let steep = design(Cut::Tiers(steep), "diamond");
    let error = retarget(&steep, named("quartz"), RetargetRule::CriticalAngle).unwrap_err().to_string();
    assert!(
        error.starts_with("tier 'P2' would go from 85.00 to ") && error.contains("tangent ratio"),
        "{error}"
    );
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 32, ..ProptestConfig::default() })]

    #[test]
    fn random_brilliants_as_planes_and_by_proportions_are_stretched_alike(
        given in crate::random::proportions(),
        factor in 0.8..1.2_f64,
    ) {
        // A girdle that is thick everywhere, so that crown and pavilion do not meet.
        let given = RoundBrilliant { girdle_thickness: 60.0, ..given };
        let old = design(Cut::RoundBrilliant(given), "diamond");
        let Ok(facets) = old.facets() else { return Ok(()) };
        let planes = design(Cut::Planes(facets), "diamond");
        let rule = RetargetRule::PavilionRatio(Some(factor));
        let (Ok(a), Ok(b)) = (retarget(&old, named("diamond"), rule), retarget(&planes, named("diamond"), rule)) else {
            return Ok(());
        };
        for ((_, a), (_, b)) in a.design.facets().unwrap().iter().zip(&b.design.facets().unwrap()) {
            prop_assert!(a.normal.distance(b.normal) < 1e-9, "{a:?} {b:?}");
        }
    }
}

#[test]
fn a_shift_of_angles_solves_the_meets_that_tiers_keep() {
    let mut given = tiers();
    // The breaks set the girdle line, and the corners are cut to the points where the breaks meet the mains.
    given.tiers[1].distance = 0.80;
    given.tiers[3].distance = 1.45;
    given.tiers[4].angle = -56.0;
    for (name, place, words) in [("P2", 1, "Level girdle"), ("P3", 4, "Meet P1-P2")] {
        assert_eq!(given.tiers[place].name(), name);
        given.tiers[place].meet = given.meet_in_words(place, words);
        assert!(given.tiers[place].meet.is_some());
    }
    let solved = given.solved();
    let failed: Vec<String> = solved.errors().map(ToString::to_string).collect();
    assert!(failed.is_empty(), "{failed:?}");
    let old = design(Cut::Tiers(solved.tiers.clone()), "quartz");
    let found = retarget(&old, named("spinel"), RetargetRule::CriticalAngle).unwrap();
    let Cut::Tiers(now) = &found.design.cut else { panic!() };
    let off = |a: &Tiers, b: &Tiers| {
        let pairs = a.tiers.iter().zip(&b.tiers);
        pairs.map(|(a, b)| (a.distance - b.distance).abs()).fold(0.0, f64::max)
    };
    assert!(off(now, &now.solved().tiers) < 1e-12);
    let says = |found: &Retargeted, words: &str| found.notes.iter().any(|note| note.contains(words));
    assert!(says(&found, "solved anew") && !says(&found, "open by a little"));
}
