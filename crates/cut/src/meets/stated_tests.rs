//! Tests of instructions that may mean several points.

use super::super::tiers::Tiers;
use super::names::TierNames;
use super::tests::{assert_near, brilliant, every, tier, written};
use super::*;

#[test]
fn what_words_may_mean_begins_with_what_they_say() {
    let read = |text: &str| -> Vec<String> {
        let mut design = written();
        design.tiers[4].instructions = text.to_owned();
        words::stated(&design)[4].iter().map(Meet::to_string).collect()
    };
    let cases: [(&str, &[&str]); 9] = [
        ("Level girdle & meet @ A", &["Meet a", "Level girdle"]),
        ("PCP, MP @ A - G1", &["Meet a-g1", "Cut to centre point"]),
        ("Size stone and meet @ A", &["Meet a", "Set size"]),
        ("Form PCP", &["Cut to centre point", "New centre point below old"]),
        ("New centre point below old", &["New centre point below old"]),
        ("Flat side, girdle not level", &[]),
        ("Meet P1-P1-G1", &["Meet p1-p1-g1", "Meet c1-c1-g1"]),
        ("MP A-A & A-G1", &["Meet a-a; Meet a-g1", "Meet a-a", "Meet a-g1"]),
        ("Meet A, A and 1, G1", &["Meet a-a; Meet 1-g1", "Meet a-a", "Meet 1-g1"]),
    ];
    for (text, expected) in cases {
        assert_eq!(read(text), expected, "{text}");
    }
}

/// Returns a design of sixteen pavilion facets under two sides of a bar. The ends of the bar meet two pavilion facets
/// and a side at one of three places.
fn bar(end: f64) -> Tiers {
    let tiers = vec![
        tier("1", -43.0, &every(6, 3.0), "Cut to TCP", 0.7),
        tier("G1", -90.0, &[0.0, 48.0], "Set size", 1.0),
        tier("G2", -90.0, &[24.0, 72.0], "Meet 1-1-G1", end),
    ];
    Tiers { gear: 96, symmetry: 2, mirror: true, tiers, ..Tiers::default() }
}

#[test]
fn of_corners_with_the_same_names_the_one_beside_the_tier_is_meant() {
    for (teeth, said) in [
        (18.0, "Meet 1-1-G1"),
        (12.0, "Meet 1-1-G1 (reached as number 2)"),
        (6.0, "Meet 1-1-G1 (reached as number 3)"),
    ] {
        let end = (teeth / 96.0 * std::f64::consts::TAU).tan();
        let mut design = bar(end).with_stated_meets();
        assert_eq!(design.tiers[2].meet.as_ref().map(Meet::to_string).as_deref(), Some(said));
        design.tiers[2].distance = 3.0;
        let solved = design.solved();
        assert_near(&[solved.tiers.tiers[2].distance], &[end]);
        assert_eq!(solved.choices, [0, 0, 3], "the names are ambiguous");
    }
    let far = bar(0.7).with_stated_meets();
    assert_eq!(
        far.tiers[2].meet.as_ref().map(Meet::to_string).as_deref(),
        Some("Meet 1-1-G1"),
        "the letter stands"
    );
}

#[test]
fn a_corner_beyond_the_last_is_an_error() {
    let mut design = bar(1.0);
    let names = ["1", "1", "G1"].map(str::to_owned).to_vec();
    design.tiers[2].meet = Some(Meet::Points(vec![MeetPoint::LaterCorner { names, reached: 99 }]));
    let said = design.solved().errors().map(ToString::to_string).collect::<Vec<_>>();
    assert_eq!(
        said,
        ["tier 3 'G2': 1, 1, G1 meet in fewer than 99 points that this tier can reach on the stone so far"]
    );
}

#[test]
fn the_reading_that_gives_the_distance_is_taken() {
    let plain = brilliant();
    let taken = |place: usize, text: &str| {
        let mut design = plain.clone();
        design.tiers.iter_mut().for_each(|tier| tier.meet = None);
        design.tiers[place].instructions = text.to_owned();
        design.with_stated_meets().tiers[place].meet.as_ref().map(Meet::to_string)
    };
    assert_eq!(taken(4, "Meet P1-P1-G1").as_deref(), Some("Meet c1-c1-G1"), "the crown has a tier 1 as well");
    assert_eq!(taken(2, "Meet 1-1-g1. Form PCP").as_deref(), Some("Meet 1-1-G1"));
    assert_eq!(taken(2, "Form PCP").as_deref(), Some("New centre point below old"));
    assert_eq!(
        taken(4, "Set size & meet @ 1-2").as_deref(),
        Some("Set size"),
        "no such corner is on the crown"
    );
}

#[test]
fn a_crown_that_is_listed_first_waits_for_the_girdle() {
    let mut design = brilliant();
    design.tiers.rotate_left(3);
    design.tiers[0].meet =
        Some(Meet::Points(vec![MeetPoint::Corner(["1", "1", "G1"].map(str::to_owned).to_vec())]));
    let order = solve::cutting_order(&design);
    let at = |name: &str| order.iter().position(|&place| design.tiers[place].name() == name);
    assert!(at("G1") < at("A") && at("A") < at("B") && at("B") < at("C") && at("C") < at("T"), "{order:?}");
}

#[test]
fn a_girdle_of_another_name_is_numbered() {
    let mut design = brilliant();
    design.tiers[1].facets[0].name = "C9".to_owned();
    let names = TierNames::of(&design);
    assert_eq!([names.meant("g1", 2), names.meant("g2", 2)], [vec![1], vec![]]);
}

#[test]
fn stated_meets_that_the_numbers_bear_out_are_kept_and_others_dropped() {
    let solved = brilliant();
    let mut bare = solved.clone();
    bare.tiers.iter_mut().for_each(|tier| tier.meet = None);
    let kept = bare.with_kept_stated_meets();
    let words = |tiers: &Tiers| -> Vec<Option<String>> {
        tiers
            .tiers
            .iter()
            .map(|tier| tier.meet.as_ref().map(|meet| meet.to_string().to_uppercase()))
            .collect()
    };
    assert_eq!(words(&kept), words(&solved));
    // Names are written as their tiers have them: the instruction says "meet b-C".
    let table = kept.tiers.last().unwrap().meet.as_ref().unwrap().to_string();
    assert!(table.contains('B') && !table.contains('b'), "{table}");
    // A tier that is not cut gets no meet, because nothing shows whether it would move.
    let mut muted = bare.clone();
    muted.tiers.last_mut().unwrap().is_cut = false;
    assert_eq!(muted.with_kept_stated_meets().tiers.last().unwrap().meet, None);
    // A table that is cut deeper than its instruction states loses that meet alone, and nothing moves.
    bare.tiers.last_mut().unwrap().distance *= 0.9;
    let other = bare.with_kept_stated_meets();
    assert_eq!(other.tiers.last().unwrap().meet, None);
    assert_eq!(words(&other)[..6], words(&solved)[..6]);
    let moved = other.solved().tiers;
    for (moved, own) in moved.tiers.iter().zip(&bare.tiers) {
        assert_near(&[moved.distance], &[own.distance]);
    }
}
