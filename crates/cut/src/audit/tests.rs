//! Tests of audits: known findings of real designs, laws, and stones with one fault each.

use super::*;
use crate::round_brilliant::{MODERN, RoundBrilliant};
use crate::{Indexed, Tier, Tiers};
use brillianteer_math::{Plane, Polytope, Pose};
use glam::{DQuat, DVec3};
use proptest::prelude::*;

type Named = Vec<(String, Plane)>;

fn audited(facets: &Named, tiers: Option<&Tiers>, critical_deg: Option<f64>) -> Audit {
    let planes: Vec<Plane> = facets.iter().map(|(_, plane)| *plane).collect();
    let given: Vec<String> = facets.iter().map(|(name, _)| name.clone()).collect();
    let stone = Polytope::from_planes(&planes).unwrap();
    let names: Vec<String> = stone.facets().iter().map(|facet| given[facet.source].clone()).collect();
    Audit::of(&AuditSubject { stone: &stone, names: &names, planes: &given, tiers, critical_deg })
}

fn brilliant() -> Named {
    MODERN.facets().unwrap()
}

/// Returns the plane of this name.
fn plane<'a>(facets: &'a mut Named, name: &str) -> &'a mut Plane {
    &mut facets.iter_mut().find(|(other, _)| other == name).unwrap().1
}

fn tier(angle: f64, distance: f64, first: &[f64], steps: u32) -> Tier {
    let gear = 96.0;
    let step = gear / f64::from(steps);
    let indices = first.iter().flat_map(|index| (0..steps).map(move |k| index + step * f64::from(k)));
    let facets = indices.map(|index| Indexed { index, name: String::new() }).collect();
    Tier { angle, distance, instructions: String::new(), meet: None, is_cut: true, frosting: 0.0, facets }
}

/// Returns the design PC 01.338 of R. Long and N. Steele, *Facet Design* V (1984), as a list of planes. Its table lies lower
/// by a part of the width.
fn eight_main_highlight(deeper: f64) -> Named {
    let width = 2.0 * 0.99144;
    let tiers = Tiers {
        gear: 96,
        offset: 48.0,
        symmetry: 8,
        mirror: true,
        tiers: vec![
            tier(37.00, 0.60181, &[0.0], 8),
            tier(41.00, 0.65045, &[2.0, 10.0], 8),
            tier(43.94, 0.68801, &[6.0], 8),
            tier(23.00, 0.50486, &[6.0], 8),
            tier(0.0, 0.32590 - deeper * width, &[48.0], 1),
            tier(-43.00, 0.71100, &[0.0], 8),
            tier(-44.00, 0.71724, &[2.0, 10.0], 8),
            tier(-44.53, 0.72352, &[6.0], 8),
            tier(-90.00, 0.99144, &[2.0, 6.0, 10.0], 8),
        ],
        ..Tiers::default()
    };
    tiers.facets()
}

#[test]
fn eight_main_highlight_has_no_split_meet_and_eight_with_a_table_half_a_percent_deeper() {
    assert_eq!(audited(&eight_main_highlight(0.0), None, None), Audit::default());
    let deeper = audited(&eight_main_highlight(0.005), None, None);
    assert_eq!(deeper.of_kind(FindingKind::SplitMeet).count(), 8);
    assert_eq!(deeper.findings.len(), 8, "{deeper:?}");
    for finding in &deeper.findings {
        assert!(finding.facets.iter().any(|name| name == "T"), "{finding:?}");
        let [a, b] = finding.points[..] else { panic!("two places are expected: {finding:?}") };
        assert!((100.0 * a.distance(b) / (2.0 * 0.99144) - finding.size).abs() < 0.02, "{finding:?}");
        assert!(finding.size < finding.threshold && finding.threshold == SPLIT_MEET);
    }
}

#[test]
fn a_brilliant_has_no_finding_and_in_glass_only_what_leaks() {
    assert_eq!(audited(&brilliant(), None, Some(24.43)), Audit::default());
    let glass = audited(&brilliant(), None, Some(41.8));
    let kinds: Vec<FindingKind> = glass.findings.iter().map(|finding| finding.kind).collect();
    assert_eq!(kinds, [FindingKind::BelowCritical], "{glass:?}");
    let leak = &glass.findings[0];
    assert!((leak.size - 40.8).abs() < 1e-9 && leak.threshold == 41.8 && leak.facets.len() == 8, "{leak:?}");
}

#[test]
fn a_bezel_that_is_cut_too_shallow_splits_its_meets_and_leaves_the_symmetry() {
    let mut facets = brilliant();
    plane(&mut facets, "bezel 3").offset += 0.004;
    let audit = audited(&facets, None, None);
    assert!(audit.of_kind(FindingKind::SplitMeet).count() > 0, "{audit:?}");
    let off: Vec<&Finding> = audit.of_kind(FindingKind::Symmetry).collect();
    assert_eq!(off.len(), 1, "{audit:?}");
    assert_eq!(off[0].facets, ["bezel 3"]);
    assert!((off[0].size - 0.2).abs() < 0.01, "0.004 of a width of 2: {}", off[0].size);
}

#[test]
fn a_corner_in_the_middle_of_a_side_is_no_split_meet_and_one_beside_the_middle_is() {
    let family = crate::Family::of_key("modified_cushion").unwrap();
    let crate::Cut::Family(made) = &family.first else { panic!() };
    let mut facets = made.facets().unwrap();
    // Two chevrons part below the middle of a girdle facet.
    let apart = |audit: &Audit| {
        let is_there = |finding: &&Finding| {
            ["chevron_1 3", "chevron_1 4"].iter().all(|name| finding.facets.iter().any(|own| own == name))
                && finding.facets.iter().any(|own| own.starts_with("girdle"))
        };
        audit.of_kind(FindingKind::SplitMeet).filter(is_there).count()
    };
    assert_eq!(apart(&audited(&facets, None, None)), 0);
    plane(&mut facets, "chevron_1 3").offset += 0.004;
    let aside = audited(&facets, None, None);
    assert!(apart(&aside) > 0, "{aside:?}");
}

#[test]
fn an_outline_off_its_symmetry_is_told_from_a_facet() {
    let mut facets = brilliant();
    plane(&mut facets, "girdle 7").offset -= 0.005;
    let audit = audited(&facets, None, None);
    let off: Vec<&Finding> = audit.of_kind(FindingKind::Outline).collect();
    assert!(off.len() == 1 && off[0].facets == ["girdle 7"], "{audit:?}");
}

#[test]
fn a_stone_that_is_nearly_as_long_as_wide_keeps_its_own_symmetry() {
    let mut nearly = 0;
    for family in crate::FAMILIES {
        let Some(row) = family.proportion("length_to_width").filter(|row| row.give.is_some()) else {
            continue;
        };
        for thousandths in 1..=12 {
            let mut cut = family.first.clone();
            row.set(&mut cut, 1.0 + 0.5e-3 * f64::from(thousandths));
            let crate::Cut::Family(made) = &cut else { continue };
            let Ok(facets) = made.facets() else { continue };
            let audit = audited(&facets, None, None);
            let off = [FindingKind::Outline, FindingKind::Symmetry]
                .into_iter()
                .flat_map(|kind| audit.of_kind(kind));
            assert_eq!(off.count(), 0, "{} {thousandths}: {audit:?}", family.key);
            nearly += 1;
        }
    }
    assert!(nearly > 100, "{nearly}");
}

#[test]
fn a_facet_off_the_symmetry_of_a_nearly_square_stone_is_found() {
    let family = crate::Family::of_key("cushion").unwrap();
    let mut cut = family.first.clone();
    family.proportion("length_to_width").unwrap().set(&mut cut, 1.001);
    let crate::Cut::Family(made) = &cut else { panic!() };
    let mut facets = made.facets().unwrap();
    plane(&mut facets, "bezel 3").offset -= 0.02;
    let audit = audited(&facets, None, None);
    let off: Vec<&Finding> = audit.of_kind(FindingKind::Symmetry).collect();
    assert!(off.len() == 1 && off[0].facets == ["bezel 3"], "{audit:?}");
}

#[test]
fn a_plane_that_never_touches_the_stone_is_named_and_one_that_closes_it_is_not() {
    let mut facets = brilliant();
    facets.push(("spare 1".to_owned(), Plane::new(DVec3::X, 1.5)));
    facets.push(("spare 2".to_owned(), Plane::new(DVec3::Y, 1.5)));
    let audit = audited(&facets, None, None);
    let unused: Vec<&Finding> = audit.of_kind(FindingKind::UnusedPlane).collect();
    assert!(unused.len() == 1 && unused[0].facets == ["spare 1", "spare 2"], "{audit:?}");
    let planes: Vec<Plane> = facets.iter().map(|(_, plane)| *plane).collect();
    let stone = Polytope::from_planes(&planes).unwrap();
    let given: Vec<String> = brilliant().into_iter().map(|(name, _)| name).collect();
    let of_design =
        AuditSubject { stone: &stone, names: &[], planes: &given, tiers: None, critical_deg: None };
    assert_eq!(Audit::of(&of_design).of_kind(FindingKind::UnusedPlane).count(), 0);
}

#[test]
fn a_girdle_is_uneven_where_its_meets_are_and_not_where_it_dips() {
    let mut facets = brilliant();
    let name = |k: usize| format!("upper_half {k}");
    for k in 1..=4 {
        // Two neighbours on either side of a bezel, so that one meet of the girdle lies lower.
        plane(&mut facets, &name(k)).offset -= 0.012;
    }
    let audit = audited(&facets, None, None);
    let uneven: Vec<&Finding> = audit.of_kind(FindingKind::UnevenGirdle).collect();
    assert_eq!(uneven.len(), 1, "{audit:?}");
    let [low, high] = uneven[0].points[..] else { panic!() };
    assert!((50.0 * (high.z - low.z) - uneven[0].size).abs() < 0.05, "{uneven:?}");
}

#[test]
fn a_left_over_facet_is_small_and_thin() {
    let mut facets = brilliant();
    // A facet between star and bezel whose plane just reaches the edge between them.
    let (star, bezel) = (*plane(&mut facets, "star 1"), *plane(&mut facets, "bezel 1"));
    let normal = (star.normal + bezel.normal).try_normalize().unwrap();
    let stone = Polytope::from_planes(&facets.iter().map(|(_, plane)| *plane).collect::<Vec<_>>()).unwrap();
    let reach = stone.vertices().iter().map(|corner| corner.dot(normal)).fold(f64::MIN, f64::max);
    facets.push(("left over".to_owned(), Plane::new(normal, reach - 5e-4)));
    let audit = audited(&facets, None, None);
    for kind in [FindingKind::SmallFacet, FindingKind::ThinFacet] {
        let names: Vec<&String> = audit.of_kind(kind).flat_map(|finding| &finding.facets).collect();
        assert_eq!(names, ["left over"], "{kind}");
    }
}

#[test]
fn a_symmetry_that_the_file_states_and_the_facets_lack_is_one_finding() {
    let stated = |symmetry, mirror| Tiers { gear: 96, symmetry, mirror, ..Tiers::default() };
    let facets = brilliant();
    // The brilliant's bezel 1 lies at +x, so that its mirrors run through index 0 too.
    assert_eq!(audited(&facets, Some(&stated(8, true)), None), Audit::default());
    let audit = audited(&facets, Some(&stated(3, false)), None);
    let kinds: Vec<FindingKind> = audit.findings.iter().map(|finding| finding.kind).collect();
    assert_eq!(kinds, [FindingKind::StatedSymmetry], "{audit:?}");
    assert!(audit.findings[0].size < MOST_KEEP);
}

#[test]
fn counts_have_the_keys_of_the_kinds_also_where_nothing_is_found() {
    for kind in FindingKind::ALL {
        assert_eq!(serde_json::to_value(kind).unwrap(), kind.key());
    }
    let audit = audited(&eight_main_highlight(0.005), None, Some(50.0));
    let counted = CountedAudit::from(audit.clone());
    assert_eq!(counted.counts.values().sum::<usize>(), audit.findings.len());
    assert!(counted.counts.len() == FindingKind::ALL.len() && counted.counts["unused_plane"] == 0);
}

#[test]
fn findings_come_back_from_json() {
    let audit = audited(&eight_main_highlight(0.005), None, Some(50.0));
    assert!(audit.findings.len() > 8);
    let text = serde_json::to_string(&audit).unwrap();
    assert!(
        text.contains("\"kind\":\"split_meet\"") && text.contains("\"unit\":\"percent_of_width\""),
        "{text}"
    );
    let back: Audit = serde_json::from_str(&text).unwrap();
    assert_eq!(back.findings.len(), audit.findings.len());
    assert_eq!(back.findings[0].facets, audit.findings[0].facets);
}

/// Returns the findings of an audit in a form that does not depend on the frame: the kind of each finding, and its
/// size in millionths of the threshold's unit.
fn told(audit: &Audit) -> Vec<(FindingKind, i64)> {
    let mut told: Vec<(FindingKind, i64)> =
        audit.findings.iter().map(|finding| (finding.kind, (1e6 * finding.size).round() as i64)).collect();
    told.sort_unstable();
    told
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    #[test]
    fn an_audit_does_not_depend_on_the_stones_size_or_turn(
        given in crate::random::proportions(),
        turn in 0.0..6.3_f64,
        scale in 0.1..10.0_f64,
    ) {
        let given = RoundBrilliant { girdle_facets: 64, ..given };
        let facets = given.facets().unwrap();
        let planes: Vec<Plane> = facets.iter().map(|(_, plane)| *plane).collect();
        let stone = Polytope::from_planes(&planes).unwrap();
        let names: Vec<String> = stone.facets().iter().map(|facet| facets[facet.source].0.clone()).collect();
        let pose = Pose { turn: DQuat::from_rotation_z(turn), scale, ..Pose::STILL };
        let moved = stone.reframed(&pose);
        let audit = |stone: &Polytope| {
            let subject = AuditSubject { stone, names: &names, planes: &[], tiers: None, critical_deg: Some(30.0) };
            Audit::of(&subject)
        };
        let (plain, turned) = (told(&audit(&stone)), told(&audit(&moved)));
        prop_assert_eq!(plain.len(), turned.len());
        for (a, b) in plain.iter().zip(&turned) {
            prop_assert!(a.0 == b.0 && (a.1 - b.1).abs() <= 2, "{:?} {:?}", a, b);
        }
    }

    #[test]
    fn every_size_crosses_its_threshold_and_every_place_lies_on_the_stone(
        given in crate::random::proportions(),
        lift in -0.01..0.01_f64,
    ) {
        let mut facets = given.facets().unwrap();
        plane(&mut facets, "main 1").offset += lift;
        let planes: Vec<Plane> = facets.iter().map(|(_, plane)| *plane).collect();
        let Ok(stone) = Polytope::from_planes(&planes) else { return Ok(()) };
        let audit = audited(&facets, None, Some(42.0));
        for finding in &audit.findings {
            let above = matches!(
                finding.kind,
                FindingKind::UnevenGirdle | FindingKind::Outline | FindingKind::Symmetry | FindingKind::UnusedPlane
            );
            prop_assert!((finding.size > finding.threshold) == above && finding.size >= 0.0, "{finding:?}");
            prop_assert!(!finding.facets.is_empty());
            for point in &finding.points {
                let out = stone.planes().map(|plane| plane.distance(*point)).fold(f64::MIN, f64::max);
                prop_assert!(out.abs() < 0.003, "{out} {finding:?}");
            }
        }
    }
}
