//! Tests of the class estimated after GIA: against a transcription of its charts, where the machine has one, and
//! against laws that any such estimate must obey.

use brillianteer::cut::{
    BrilliantProportions, ClassEstimate, Crown, CutClass, LowerHalf, PUBLISHED_RANGES, Pavilion,
    RoundBrilliant,
};
use brillianteer::measure::{brilliant_proportions, facet_deviations};
use brillianteer::scene::Stone;
use proptest::prelude::*;

/// Notes beside the checkout that hold a transcription of GIA's charts. The charts are under copyright, so no copy of them is here.
const NOTES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/facts/scores.md");

/// The tables, percent, of the transcription, and the number of its rows (pavilion angles) and columns (crown angles).
const TABLES: std::ops::RangeInclusive<u32> = 50..=67;
const ROWS: usize = 22;
const COLUMNS: usize = 37;

/// Returns the proportions for which GIA's charts hold.
fn charted(table: f64, crown_angle: f64, pavilion_angle: f64) -> BrilliantProportions {
    BrilliantProportions {
        table,
        crown_angle,
        pavilion_angle,
        star_length: 55.0,
        lower_half_length: 80.0,
        girdle_thickness: 3.0,
        crown_height: (50.0 - 0.5 * table) * crown_angle.to_radians().tan(),
    }
}

/// Returns the classes of one row, written as lengths of runs, each with the letter of its class.
fn row(text: &str) -> Option<Vec<CutClass>> {
    let mut classes = vec![];
    for run in text.split_inclusive(|c: char| c.is_ascii_alphabetic()) {
        let (length, letter) = run.split_at(run.len() - 1);
        let class = CutClass::ALL["evgfp".find(letter)?];
        classes.extend(std::iter::repeat_n(class, length.parse().ok()?));
    }
    (classes.len() == COLUMNS).then_some(classes)
}

/// Returns the proportions of every cell of the transcription with its class; `None` without the notes.
fn transcription() -> Option<Vec<(BrilliantProportions, CutClass)>> {
    let Ok(notes) = std::fs::read_to_string(NOTES) else {
        println!("SKIPPED: {NOTES} is not there, so no estimate is compared with GIA's charts");
        return None;
    };
    let mut cells = vec![];
    for table in TABLES {
        let start = format!("{table}: ");
        let rows = notes.lines().filter_map(|line| line.strip_prefix(&start));
        let rows = rows.map(|line| line.split_whitespace().map(row).collect::<Option<Vec<_>>>());
        let rows = rows.flatten().find(|rows| rows.len() == ROWS);
        let rows = rows.unwrap_or_else(|| panic!("{NOTES} has no rows for the table {table}"));
        for (i, classes) in rows.into_iter().enumerate() {
            for (j, class) in classes.into_iter().enumerate() {
                let (pavilion, crown) = (38.8 + 0.2 * i as f64, 22.0 + 0.5 * j as f64);
                cells.push((charted(f64::from(table), crown, pavilion), class));
            }
        }
    }
    Some(cells)
}

#[test]
fn estimates_agree_with_a_transcription_of_the_charts_as_often_as_documented() {
    let Some(cells) = transcription() else { return };
    let (mut same, mut called, mut excellent, mut both) = (0_u32, 0_u32, 0_u32, 0_u32);
    for (proportions, class) in &cells {
        let found = ClassEstimate::after_gia(proportions).class;
        let [is_called, is_excellent] = [found, *class].map(|class| class == CutClass::Excellent);
        same += u32::from(found == *class);
        called += u32::from(is_called);
        excellent += u32::from(is_excellent);
        both += u32::from(is_called && is_excellent);
        let apart = (found as i32 - *class as i32).abs();
        assert!(apart <= 1, "{proportions:?} is {class}, and {found} is estimated");
    }
    println!("{same} of {} agree; EX: {both} of {excellent} found, {called} called so", cells.len());
    // These numbers stand in docs/optics.md.
    assert_eq!((cells.len(), same, called, excellent, both), (14_652, 13_669, 487, 478, 455));
}

#[test]
fn no_range_of_a_single_proportion_refuses_what_the_charts_allow() {
    let Some(cells) = transcription() else { return };
    for (proportions, class) in &cells {
        for range in &PUBLISHED_RANGES {
            let allowed = range.class(range.rounded((range.get)(proportions)));
            assert!(allowed <= *class, "{}: {proportions:?} is {class}, not {allowed}", range.key);
        }
    }
}

proptest! {
    #[test]
    fn an_estimate_is_never_better_than_its_worst_limit_and_tells_what_is_near(
        table in 40.0..75.0_f64,
        crown in 18.0..44.0_f64,
        pavilion in 36.0..45.0_f64,
        (star, lower) in (30.0..75.0_f64, 50.0..95.0_f64),
        girdle in 0.0..12.0_f64,
    ) {
        let stone = BrilliantProportions {
            star_length: star,
            lower_half_length: lower,
            girdle_thickness: girdle,
            ..charted(table, crown, pavilion)
        };
        let found = ClassEstimate::after_gia(&stone);
        let worst = found.limits.iter().map(|limit| limit.class).max();
        prop_assert_eq!(worst, Some(found.class));
        for limit in &found.limits {
            let Some(range) = PUBLISHED_RANGES.iter().find(|range| range.key == limit.key) else { continue };
            let off = limit.rounded.unwrap() - limit.measured.unwrap();
            prop_assert!(off.abs() <= range.step * 0.500_01, "{:?}", limit);
        }
        for near in &found.nearby {
            prop_assert!(near.class != found.class);
            let range = PUBLISHED_RANGES.iter().find(|range| range.key == near.key).unwrap();
            let off = (near.rounded - (range.get)(&stone)).abs() / range.step;
            prop_assert!((0.49..0.601).contains(&off), "{near:?}");
        }
    }
}

#[test]
fn values_are_rounded_as_reports_round_them_and_a_border_is_told() {
    let class = |stone: &BrilliantProportions| ClassEstimate::after_gia(stone).class;
    let ideal = charted(57.0, 34.5, 40.8);
    assert_eq!(class(&ideal), CutClass::Excellent);
    // Crowns are rounded to half a degree and halves go up: 31.25 is 31.5. Lower halves of 67.5 % are 70 %.
    for (lower, expected) in
        [(65.0, CutClass::VeryGood), (67.4, CutClass::VeryGood), (67.5, CutClass::Excellent)]
    {
        let stone = BrilliantProportions { lower_half_length: lower, ..ideal };
        assert_eq!(class(&stone), expected, "{lower}");
    }
    let found = ClassEstimate::after_gia(&BrilliantProportions { lower_half_length: 67.4, ..ideal });
    let near: Vec<_> = found.nearby.iter().map(|near| (near.key, near.rounded, near.class)).collect();
    assert_eq!(near, [("lower_half_length", 70.0, CutClass::Excellent)]);
    let far = ClassEstimate::after_gia(&BrilliantProportions { lower_half_length: 66.0, ..ideal });
    assert!(far.nearby.is_empty(), "{far:?}");
    // A steep crown over a steep pavilion is worse than either alone.
    assert!(class(&charted(57.0, 36.5, 41.8)) > class(&charted(57.0, 33.0, 41.8)));
    assert!(class(&charted(57.0, 36.5, 41.8)) > class(&charted(57.0, 36.0, 40.8)));
    assert_eq!(class(&charted(75.0, 34.5, 40.8)), CutClass::Poor);
}

/// Returns the designs at the corners of the ranges of GIA's classes: the ends of those of F, or where there are none, one
/// step beyond those of VG.
fn corners_of_the_ranges() -> Vec<RoundBrilliant> {
    let ends = |key: &str| {
        let range = PUBLISHED_RANGES.iter().find(|range| range.key == key).unwrap();
        let widest = range.classes.iter().rev().find(|[least, _]| least.is_finite()).unwrap();
        let beyond = if range.classes[3][0].is_finite() { 0.0 } else { range.step };
        [widest[0] - beyond, widest[1] + beyond]
    };
    let keys =
        ["table", "crown_angle", "pavilion_angle", "star_length", "lower_half_length", "girdle_thickness"];
    let corner = |number: usize| {
        let at = |place: usize| ends(keys[place])[number >> place & 1];
        RoundBrilliant {
            table: at(0),
            crown: Crown::Angle(at(1)),
            pavilion: Pavilion::Angle(at(2)),
            star_length: at(3),
            lower_half: LowerHalf::Radial(at(4)),
            girdle_thickness: at(5),
            girdle_facets: 96,
            culet: 0.0,
        }
    };
    (0..1 << keys.len()).map(corner).collect()
}

#[test]
fn every_corner_of_the_published_ranges_has_its_proportions_deviations_and_class() {
    let mut flattest = f64::INFINITY;
    for design in corners_of_the_ranges() {
        let stone = Stone::new(&design.facets().unwrap()).unwrap();
        let deviations = facet_deviations(&stone).unwrap_or_else(|why| panic!("{design:?}: {why}"));
        assert!(deviations.iter().all(|class| class.slope_spread_deg < 1e-9), "{design:?}");
        let (found, given) = (brilliant_proportions(&stone).unwrap(), BrilliantProportions::of(&design));
        for range in &PUBLISHED_RANGES {
            let [found, given] = [&found, &given].map(|of| (range.get)(of));
            assert!((found - given).abs() < 1e-6, "{} {found} {given}: {design:?}", range.key);
        }
        assert_eq!(ClassEstimate::after_gia(&found).class, ClassEstimate::after_gia(&given).class);
        flattest = flattest.min(design.derived().unwrap().star_angle);
    }
    assert!(flattest < 2.0, "no corner has flat stars: {flattest}");
}
