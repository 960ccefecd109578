//! Tests of meets, on a brilliant that is cut by them.

use super::super::tier_change::TierChange;
use super::super::tiers::{Indexed, Tier, TierZone, Tiers};
use super::*;

/// The tolerance of a distance that follows from others by a few steps of arithmetic, in lengths of about 1.
const EXACT: f64 = 1e-9;

pub(super) fn tier(name: &str, angle: f64, indices: &[f64], instructions: &str, distance: f64) -> Tier {
    let mut facets: Vec<Indexed> =
        indices.iter().map(|&index| Indexed { index, name: String::new() }).collect();
    facets[0].name = name.to_owned();
    Tier {
        angle,
        distance,
        instructions: instructions.to_owned(),
        meet: None,
        is_cut: true,
        frosting: 0.0,
        facets,
    }
}

pub(super) fn every(step: usize, first: f64) -> Vec<f64> {
    (0..96 / step).map(|k| (k * step) as f64 + first).collect()
}

/// Returns a round brilliant as cutters write it. Its free sizes are right, and its other distances are not.
pub(super) fn written() -> Tiers {
    let wrong = 0.9;
    let tiers = vec![
        tier("1", -43.0, &every(6, 3.0), "Cut to TCP", 0.75),
        tier("G1", -90.0, &every(6, 3.0), "Set size", 1.0),
        tier("2", -41.0, &every(12, 0.0), "Meet 1-1-g1", wrong),
        tier("A", 45.0, &every(6, 3.0), "Set girdle thickness", 0.76),
        tier("B", 37.0, &every(12, 0.0), "MP @ A, A, and girdle.", wrong),
        tier("C", 22.0, &every(12, 6.0), "(Meet A-B-A)", wrong),
        tier("T", 0.0, &[0.0], "meet b-C", wrong),
    ];
    let design = Tiers { gear: 96, symmetry: 8, mirror: true, tiers, ..Tiers::default() };
    design.with_stated_meets()
}

/// Returns the same design with its meets solved.
pub(super) fn brilliant() -> Tiers {
    let solved = written().solved();
    assert_eq!(solved.errors().collect::<Vec<_>>(), [] as [&MeetError; 0]);
    solved.tiers
}

fn distances(tiers: &Tiers) -> Vec<f64> {
    tiers.tiers.iter().map(|tier| tier.distance).collect()
}

#[track_caller]
pub(super) fn assert_near(found: &[f64], expected: &[f64]) {
    let apart = found.iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(found.len() == expected.len() && apart < EXACT, "{found:?} is not {expected:?}");
}

/// Returns the greatest distance of the other planes from the common point of the first three. Each facet is given by
/// its tier and its place in the tier.
fn apart(tiers: &Tiers, facets: &[(usize, usize)]) -> f64 {
    let planes: Vec<_> = facets
        .iter()
        .map(|&(tier, facet)| tiers.plane(&tiers.tiers[tier], tiers.tiers[tier].facets[facet].index))
        .collect();
    let normals = glam::DMat3::from_cols(planes[0].normal, planes[1].normal, planes[2].normal).transpose();
    let point = normals.inverse() * glam::DVec3::new(planes[0].offset, planes[1].offset, planes[2].offset);
    planes.iter().map(|plane| plane.distance(point).abs()).fold(0.0, f64::max)
}

/// Sets of facets that meet in the brilliant: mains with breaks and girdle, bezels likewise, and stars with breaks
/// and bezels.
const MEETING: [&[(usize, usize)]; 3] = [
    &[(0, 0), (1, 0), (2, 0), (1, 15)],
    &[(3, 0), (1, 0), (4, 0), (1, 15)],
    &[(3, 0), (3, 1), (5, 0), (4, 0)],
];

#[test]
fn a_brilliant_is_cut_by_its_instructions() {
    let design = brilliant();
    for facets in MEETING {
        assert!(apart(&design, facets) < EXACT, "{facets:?}: {}", apart(&design, facets));
    }
    assert!(apart(&written(), MEETING[0]) > 0.1, "the check sees what is not cut yet");
    let kept = [0, 1, 3].map(|place| design.tiers[place].distance);
    assert_eq!(kept, [0.75, 1.0, 0.76]);
}

#[test]
fn solving_a_solved_design_changes_nothing() {
    let design = brilliant();
    let again = design.solved();
    assert_near(&distances(&again.tiers), &distances(&design));
    let outcomes: Vec<bool> = again.outcomes.iter().map(|o| *o == TierOutcome::Solved).collect();
    assert_eq!(outcomes, [false, false, true, false, true, true, true]);
}

#[test]
fn a_turned_gear_and_another_unit_change_nothing_else() {
    let (design, plain) = (written(), distances(&brilliant()));
    let mut turned = design.clone();
    turned.offset = 17.5;
    turned.tiers.iter_mut().flat_map(|tier| &mut tier.facets).for_each(|facet| facet.index += 17.5);
    assert_near(&distances(&turned.solved().tiers), &plain);
    let mut scaled = design;
    scaled.tiers.iter_mut().for_each(|tier| tier.distance *= 30.0);
    let shrunk: Vec<f64> = distances(&scaled.solved().tiers).iter().map(|distance| distance / 30.0).collect();
    assert_near(&shrunk, &plain);
}

#[test]
fn every_later_meet_follows_an_edit() {
    let design = brilliant();
    for (place, angle) in [(0, -44.0), (3, 44.0), (4, 36.0), (2, -40.5)] {
        let edited = design.changed(TierChange::Setting(place, angle, design.tiers[place].distance));
        assert_eq!(edited.errors().count(), 0, "{:?}", edited.outcomes);
        assert!(distances(&edited.tiers) != distances(&design));
        for facets in MEETING {
            assert!(apart(&edited.tiers, facets) < EXACT, "{place}: {facets:?}");
        }
    }
    let moved = design.changed(TierChange::Setting(4, design.tiers[4].angle, 0.7));
    assert_eq!((moved.tiers.tiers[4].distance, &moved.tiers.tiers[4].meet), (0.7, &None));
    let mut indices: Vec<f64> = design.tiers[5].facets.iter().map(|facet| facet.index).collect();
    indices[1] = 21.0;
    let turned = design.changed(TierChange::Indices(5, indices));
    assert_eq!(turned.tiers.tiers[5].facets[1].index, 21.0);
    assert!(matches!(turned.outcomes[5], TierOutcome::Failed(_)), "{:?}", turned.outcomes[5]);
    assert_eq!(design.changed(TierChange::Setting(99, 1.0, 1.0)).tiers, design);
}

fn corner(names: &[&str]) -> MeetPoint {
    MeetPoint::Corner(names.iter().map(|&name| name.to_owned()).collect())
}

#[test]
fn two_points_give_the_angle() {
    let mut design = brilliant();
    design.tiers.truncate(5);
    design.tiers.insert(4, tier("PC", 30.0, &every(12, 6.0), "", 0.6));
    // The bezels go through the girdle's corners and the preform's centre point, whatever their angle was.
    for angle in [37.0, 20.0] {
        design.tiers[5].angle = angle;
        design.tiers[5].meet =
            Some(Meet::Points(vec![corner(&["A", "A", "G1"]), MeetPoint::Centre { temporary: true }]));
        let solved = design.solved();
        assert_eq!(solved.errors().count(), 0, "{:?}", solved.outcomes);
        let bezel = &solved.tiers.tiers[5];
        let top = 0.6 / 30f64.to_radians().cos();
        let (radius, height) = (1.0 / 11.25f64.to_radians().cos(), 0.76 * 2f64.sqrt() - 1.0);
        let expected = (top - height).atan2(radius).to_degrees();
        assert_near(&[bezel.angle, bezel.distance], &[expected, top * expected.to_radians().cos()]);
    }
}

#[test]
fn an_angle_beyond_90_degrees_is_that_of_a_facet_of_the_other_side() {
    let mut design = brilliant();
    design.tiers.truncate(5);
    design.tiers.insert(4, tier("PC", 30.0, &every(12, 6.0), "", 0.6));
    let points = vec![corner(&["A", "A", "G1"]), MeetPoint::Centre { temporary: true }];
    design.tiers[5].meet = Some(Meet::Points(points));
    let plain = design.solved().tiers;
    // The same facets, given as facets of the pavilion that lean over.
    design.tiers[5].angle = -(180.0 - design.tiers[5].angle);
    assert_eq!(design.tiers[5].zone(), TierZone::Crown);
    let found = design.solved().tiers;
    let plane = |tiers: &Tiers| tiers.plane(&tiers.tiers[5], 12.0);
    assert!(plane(&found).normal.distance(plane(&plain).normal) < EXACT, "{:?}", found.tiers[5]);
    assert_near(&[found.tiers[5].distance], &[plain.tiers[5].distance]);
}

#[test]
fn three_points_give_the_index() {
    let side = |name: &str, index: f64| tier(name, -90.0, &[index], "", 1.0);
    let mut tiers = vec![side("N", 0.0), side("E", 24.0), side("S", 48.0), side("W", 72.0)];
    tiers.extend([tier("T", 0.0, &[0.0], "", 0.5), tier("B", -0.0, &[0.0], "", 0.5)]);
    let corners = [corner(&["N", "E", "B"]), corner(&["N", "W", "T"]), corner(&["S", "E", "T"])];
    let meet = Some(Meet::Points(corners.to_vec()));
    tiers.push(Tier { meet, ..tier("K", 50.0, &[106.0], "", 0.9) });
    let design = Tiers { gear: 96, symmetry: 1, tiers, ..Tiers::default() };
    let solved = design.solved();
    assert_eq!(solved.errors().count(), 0, "{:?}", solved.outcomes);
    let cut = &solved.tiers.tiers[6];
    let slope = 0.5f64.sqrt().atan();
    // The index stays on the same turn of the gear.
    assert_near(
        &[cut.angle, cut.facets[0].index, cut.distance],
        &[slope.to_degrees(), 108.0, 0.5 * slope.cos()],
    );
}

#[test]
fn what_is_missing_or_not_cut_yet_is_said() {
    let said = |place: usize, meet: Meet| {
        let mut design = brilliant();
        design.tiers[place].meet = Some(meet);
        let solved = design.solved();
        let TierOutcome::Failed(error) = &solved.outcomes[place] else { panic!("{:?}", solved.outcomes) };
        assert_eq!(solved.tiers.tiers[place].distance, design.tiers[place].distance);
        error.to_string()
    };
    let at = |names: &[&str]| Meet::Points(vec![corner(names)]);
    assert_eq!(
        said(4, at(&["1", "2", "A"])),
        "tier 5 'B': 1, 2 and A meet in no point that this tier can reach on the stone so far"
    );
    assert_eq!(said(4, at(&["A", "X9"])), "tier 5 'B': no tier is called X9; name a tier of the design");
    assert_eq!(
        said(1, Meet::Points(vec![MeetPoint::Centre { temporary: true }])),
        "tier 2 'G1': an upright facet passes through no centre point; give another meet"
    );
    assert_eq!(
        said(2, Meet::CentreAngle(40.0)),
        "tier 3 '2': a centre-point angle is for girdle facets; give another meet"
    );
    let mut flat = written();
    flat.tiers[1].meet = Some(Meet::CentreAngle(40.0));
    flat.tiers
        .push(Tier { meet: Some(Meet::CentreAngle(1e-311)), ..tier("G2", -90.0, &every(6, 0.0), "", 1.1) });
    let solved = flat.solved();
    assert!(solved.errors().any(|error| matches!(error.fault, MeetFault::TooFar { .. })), "{solved:?}");
    assert_eq!(solved.tiers.tiers[7].distance, 1.1);
    let mut circle = brilliant();
    circle.tiers[3].meet = Some(at(&["A", "B"]));
    circle.tiers[3].meet = Some(at(&["B", "B", "G1"]));
    circle.tiers[4].meet = Some(at(&["A", "A", "G1"]));
    let solved = circle.solved();
    assert!(
        solved.errors().any(|error| matches!(error.fault, MeetFault::NotCutYet { .. })),
        "{:?}",
        solved.outcomes
    );
}

#[test]
fn a_tier_that_meets_one_listed_later_is_cut_after_it() {
    let mut design = written();
    design.tiers.swap(4, 5);
    let solved = design.solved();
    assert_eq!(solved.errors().count(), 0, "{:?}", solved.outcomes);
    let mut plain = distances(&brilliant());
    plain.swap(4, 5);
    assert_near(&distances(&solved.tiers), &plain);
}

#[test]
fn girdles_are_cut_level_and_by_the_centre_angle() {
    let sides = [0.0, 48.0];
    let ends = [24.0, 72.0];
    let tiers = vec![
        tier("PF1", -40.0, &sides, "TCP", 0.7),
        tier("PF2", -35.0, &ends, "\"", 0.9),
        tier("G1", -90.0, &sides, "CAM 40°", 0.8),
        tier("G2", -90.0, &ends, "CAM 35º", 0.9),
        tier("P1", -60.0, &sides, "Level girdle", 0.9),
        tier("P2", -50.0, &ends, "level Girdle.", 0.9),
    ];
    let design = Tiers { gear: 96, symmetry: 2, mirror: true, tiers, ..Tiers::default() };
    let solved = design.with_stated_meets().solved();
    assert_eq!(solved.errors().count(), 0, "{:?}", solved.outcomes);
    let [pf1, pf2, g1, g2, p1, p2] = solved.tiers.tiers.try_into().unwrap();
    let (height, depth) = (0.8 * 40f64.to_radians().tan(), 0.7 / 40f64.to_radians().cos());
    assert_near(
        &[pf2.distance, g2.distance],
        &[depth * 35f64.to_radians().cos(), height / 35f64.to_radians().tan()],
    );
    assert_eq!((pf1.distance, g1.distance), (0.7, 0.8));
    let line = |tier: &Tier, girdle: &Tier| {
        let (sin, cos) = tier.angle.abs().to_radians().sin_cos();
        (tier.distance - sin * girdle.distance) / cos
    };
    assert_near(&[line(&p1, &g1), line(&p2, &g2)], &[depth - height; 2]);
}

#[test]
fn the_geometry_of_a_cut_stone_shows_its_meets() {
    let mut design = brilliant();
    design.tiers.iter_mut().for_each(|tier| tier.meet = None);
    let found = design.with_found_meets();
    let names: Vec<String> =
        found.tiers.iter().map(|t| t.meet.as_ref().map(Meet::to_string).unwrap_or_default()).collect();
    assert_eq!(names[2], "Meet 1-1-G1");
    assert_eq!([&names[0], &names[1], &names[3]], ["", "", ""], "sizes are nobody's meets");
    assert!(names[4..].iter().all(|name| name.starts_with("Meet ")), "{names:?}");
    let mut forgotten = found.clone();
    for place in [2, 4, 5, 6] {
        forgotten.tiers[place].distance = 0.95;
    }
    assert_near(&distances(&forgotten.solved().tiers), &distances(&design));
}

#[test]
fn instructions_are_read_as_cutters_write_them() {
    let read = |text: &str| {
        let mut design = written();
        design.tiers.iter_mut().for_each(|tier| tier.meet = None);
        design.tiers[4].instructions = text.to_owned();
        // The test reads only the words, and not the meets that the geometry adds.
        words::stated(&design)[4].first().map(Meet::to_string)
    };
    for (text, expected) in [
        ("Meet A-A-G1", "Meet a-a-g1"),
        ("MP@ A - G1.", "Meet a-g1"),
        ("MEET @ A & G1", "Meet a-g1"),
        ("Meet (A-A-girdle). Level girdle", "Meet a-a-girdle"),
        ("A-A-G1", "Meet a-a-g1"),
        ("Meet A-A-G1 and 1-1-G1", "Meet a-a-g1; Meet 1-1-g1"),
        ("Level Girdle", "Level girdle"),
        ("Straight & level girdle line", "Level girdle"),
        ("Cut to PCP", "Cut to centre point"),
        ("Cut to centerpoint", "Cut to centre point"),
        ("Meet A at PCP", "Cut to centre point"),
        ("Form TCP", "Cut to temporary centre point"),
        ("CAM 41.7 deg", "Cut to temporary centre point"),
        ("GMP.", "Meet girdle point"),
        ("Meet the girdle", "Meet girdle point"),
        ("Fix girdle width, level girdle", "Set girdle thickness"),
        ("Set size of stone", "Set size"),
        ("\"", "Set girdle thickness"),
    ] {
        assert_eq!(read(text).as_deref(), Some(expected), "{text}");
    }
    for text in ["", "Mains", "Frosted", "Cut to the line, leave unpolished", "Step"] {
        assert_eq!(read(text), None, "{text}");
    }
}

#[test]
fn an_instruction_that_is_written_reads_back() {
    let names = ["a", "a", "g1"].map(str::to_owned).to_vec();
    let words = MeetPoint::IN_WORDS.map(|(_, point)| Meet::Points(vec![point]));
    let sizes = GivenSize::IN_WORDS.map(|(_, size)| Meet::Given(size));
    let corners = [
        Meet::Points(vec![MeetPoint::LaterCorner { names: names.clone(), reached: 2 }]),
        Meet::Points(vec![MeetPoint::Corner(names.clone())]),
        Meet::Points(vec![MeetPoint::Corner(names.clone()), MeetPoint::Corner(names)]),
    ];
    for meet in words.into_iter().chain(sizes).chain(corners) {
        let mut design = written();
        design.tiers[4].instructions = meet.to_string();
        assert_eq!(words::stated(&design)[4].first(), Some(&meet));
    }
}
