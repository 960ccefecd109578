//! Laws of a search.

use super::{
    AtLeastAtMost, DesignSearch, Goal, GoalMaterial, Objective, OneOrMore, SearchError, SearchOptions,
    SearchProgress, VariedNumber, estimated_classes,
};
use brillianteer_base::{Stopped, unwatched};
use brillianteer_cut::{
    Crown, Cut, CutClass, Design, Indexed, MaterialRef, Pavilion, RoundBrilliant, TOLKOWSKY, Tier, Tiers,
};
use brillianteer_measure::MeasureSettings;
use brillianteer_optics::line;
use brillianteer_render::{Sweep, SweepAxis, SweepKey, SweepValue, with_numbers};
use brillianteer_scene::{DomeLight, Viewpoint};
use std::ops::ControlFlow;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Options that are rough enough to be quick, and fine enough to distinguish hills.
const ROUGH: SearchOptions = SearchOptions {
    unresolved: 0.02,
    scattered: Some(24),
    climbs: 2,
    seed: 0,
    by_slopes: true,
    polarised: false,
    angle_step_deg: None,
};

fn brilliant(crown: f64, pavilion: f64) -> Design {
    Design {
        name: "brilliant".to_owned(),
        source: None,
        notes: None,
        material: MaterialRef::Index(2.417),
        diameter_mm: 6.5,
        cut: Cut::RoundBrilliant(RoundBrilliant {
            crown: Crown::Angle(crown),
            pavilion: Pavilion::Angle(pavilion),
            ..TOLKOWSKY
        }),
    }
}

fn goal(of: &[(&str, f64)]) -> Goal {
    let mut goal = Goal::of(of.iter().map(|(name, weight)| (name.parse().unwrap(), *weight)));
    goal.vary =
        [("crown_angle".to_owned(), [24.0, 40.0]), ("pavilion_angle".to_owned(), [38.0, 43.0])].into();
    goal
}

fn searched(design: &Design, goal: &Goal) -> (DesignSearch, super::SearchOutcome) {
    let search = DesignSearch::new(design, goal, ROUGH, &unwatched).unwrap();
    let outcome = search.run(&unwatched, &|_| {}).unwrap();
    (search, outcome)
}

/// Returns the best total of a map over crown and pavilion.
fn map_best(goal: &Goal, steps: usize, unresolved: f64) -> f64 {
    let values = |[from, to]: [f64; 2]| {
        let at = |k: usize| SweepValue::Number(from + (to - from) * k as f64 / steps as f64);
        (0..=steps).map(at).collect()
    };
    let axis =
        |(key, range): (&String, &[f64; 2])| SweepAxis { key: SweepKey::of(key), values: values(*range) };
    let sweep = Sweep {
        design: brilliant(34.0, 41.0),
        viewpoint: Viewpoint::default(),
        axes: goal.vary.iter().map(axis).collect(),
        settings: MeasureSettings {
            domes: goal.measure.iter().filter_map(|measure| measure.of.dome()).collect(),
            ..MeasureSettings::usual([1.0; 2])
        },
        wavelength_nm: line::SODIUM_D,
        unresolved,
        polarised: true,
    };
    let mut best = f64::NEG_INFINITY;
    let each = |_, found: Result<brillianteer_render::SweptStone, _>| {
        if let Ok(found) = found {
            let value = |measure: &super::GoalMeasure| {
                measure.weight * measure.of.of(&found.measures).unwrap().middle()
            };
            best = best.max(goal.measure.iter().map(value).sum());
        }
        Ok(())
    };
    sweep.run::<Stopped>(0..sweep.count(), &unwatched, each).unwrap();
    best
}

#[test]
fn slopes_of_an_appraisal_are_the_weighed_gradients_of_its_measures() {
    let mut goal = goal(&[("return-cos2", 1.0), ("return-cos3+glare", -0.3)]);
    goal.measure[0].tilt = Some(OneOrMore::More(vec![0.0, 5.0]));
    goal.measure[1].at_most = Some(0.9);
    let limit = |at_least, at_most| AtLeastAtMost { at_least, at_most };
    goal.limit.insert("height_to_width".to_owned(), limit(Some(0.4), Some(0.7)));
    goal.limit.insert("above_critical".to_owned(), limit(Some(1.0), None));
    let design = brilliant(33.0, 40.9);
    let objective = Objective::new(&design, &goal, true, (0.01, 0.01), &unwatched).unwrap();
    let places = objective.start_places();
    let slopes = objective.appraise(&places, 0.01, true, &unwatched).unwrap().slopes.unwrap();
    let ranges = [16.0, 5.0];
    let keys = ["crown_angle", "pavilion_angle"].map(SweepKey::of);
    let gradient = |name: &str, tilt_deg| {
        let domes = vec![DomeLight::of(2.0), DomeLight::of(3.0)];
        let sweep = Sweep {
            design: design.clone(),
            viewpoint: Viewpoint { tilt_deg, ..Viewpoint::default() },
            axes: vec![],
            settings: MeasureSettings { domes, ..MeasureSettings::usual([1.0; 2]) },
            wavelength_nm: line::SODIUM_D,
            unresolved: 0.01,
            polarised: true,
        };
        sweep.gradient(&keys, &[name.parse().unwrap()], &unwatched).unwrap().gradients.remove(0).per
    };
    let (flat, tilted) = (gradient("return-cos2", 0.0), gradient("return-cos2", 5.0));
    let glare = gradient("return-cos3+glare", 0.0);
    let step = 1e-3;
    for number in 0..2 {
        let total = ranges[number] * (0.5 * (flat[number] + tilted[number]) - 0.3 * glare[number]);
        assert!((slopes.total[number] - total).abs() < 1e-9 * total.abs(), "{number}: {slopes:?} {total}");
        // The greatest value of a measure is limited, then the angle, then both ends of the height.
        let mut moved = [places.clone(), places.clone()];
        moved[0][number] -= step;
        moved[1][number] += step;
        let [below, above] =
            moved.map(|places| objective.appraise(&places, 0.05, false, &unwatched).unwrap().slacks);
        let limited = -ranges[number] * glare[number];
        assert!((slopes.slacks[0][number] - limited).abs() < 1e-9 * limited.abs());
        for k in 1..4 {
            let slack = (above[k] - below[k]) / (2.0 * step);
            assert!((slopes.slacks[k][number] - slack).abs() < 1e-4, "{number} {k}: {slopes:?} {slack}");
        }
    }
    assert!(slopes.slacks[2][0] > 0.05 && slopes.slacks[3][0] < -0.05 && slopes.slacks[1][1] > 4.9);
}

/// A percent of the height of a side is one of the design as it was given, wherever the search has come.
#[test]
fn slopes_by_a_scale_are_those_of_the_scaled_design_by_the_percent_of_the_given_one() {
    let planes = |design: Design| Design { cut: Cut::Planes(design.facets().unwrap()), ..design };
    let given = planes(brilliant(33.0, 40.9));
    let keys = ["crown_scale", "pavilion_scale"].map(SweepKey::of);
    let scaled = with_numbers(&given, keys.iter().zip([104.0, 102.0])).unwrap();
    let slopes = |design: &Design, values: [f64; 2]| {
        let mut goal = Goal::of([("return-cos2".parse().unwrap(), 1.0)]);
        goal.vary = keys.iter().map(|key| (key.to_string(), [90.0, 110.0])).collect();
        let objective = Objective::new(design, &goal, true, (0.05, 0.05), &unwatched).unwrap();
        assert!(objective.numbers().len() == 2 && objective.has_slopes(), "a number is held");
        let places = values.map(|value| (value - 90.0) / 20.0);
        objective.appraise(&places, 0.01, true, &unwatched).unwrap().slopes.unwrap().total
    };
    let (there, here) = (slopes(&given, [104.0, 102.0]), slopes(&scaled, [100.0; 2]));
    for ((there, here), factor) in there.iter().zip(&here).zip([1.04, 1.02]) {
        assert!((there * factor - here).abs() < 1e-6 * here.abs() && here.abs() > 1e-3, "{there} {here}");
    }
}

/// A tier that varies beside the scale of its side does not follow it, so that there are no slopes.
#[test]
fn a_scale_beside_a_tier_of_its_side_has_no_slopes() {
    let tier = |angle: f64, distance: f64, teeth: &[f64], name: &str| Tier {
        angle,
        distance,
        instructions: String::new(),
        meet: None,
        is_cut: true,
        frosting: 0.0,
        facets: teeth.iter().map(|&index| Indexed { index, name: name.to_owned() }).collect(),
    };
    let four = [0.0, 24.0, 48.0, 72.0];
    let tiers = vec![
        tier(-42.0, 0.7, &four, "P"),
        tier(-90.0, 1.0, &four, "G"),
        tier(35.0, 0.75, &four, "C"),
        tier(0.0, 0.4, &[0.0], "T"),
    ];
    let cut = Cut::Tiers(Tiers { gear: 96, symmetry: 4, mirror: true, tiers, ..Tiers::default() });
    let design = Design { cut, ..brilliant(33.0, 40.9) };
    let has_slopes = |other: &str, range: [f64; 2]| {
        let mut goal = Goal::of([("return-cos2".parse().unwrap(), 1.0)]);
        goal.vary = [("pavilion_scale".to_owned(), [90.0, 110.0]), (other.to_owned(), range)].into();
        let objective = Objective::new(&design, &goal, true, (0.05, 0.05), &unwatched).unwrap();
        assert_eq!(objective.numbers().len(), 2, "{other} is held");
        objective.has_slopes()
    };
    assert!(has_slopes("crown_scale", [90.0, 110.0]) && has_slopes("tier:C", [30.0, 40.0]));
    assert!(!has_slopes("tier:P", [38.0, 46.0]) && !has_slopes("distance:P", [0.6, 0.8]));
}

#[test]
fn a_search_finds_the_hill_from_wherever_it_starts() {
    let goal = goal(&[("return-cos2", 1.0)]);
    let best = map_best(&goal, 8, 0.02);
    for (crown, pavilion) in [(24.5, 38.5), (39.0, 42.5)] {
        let (search, outcome) = searched(&brilliant(crown, pavilion), &goal);
        // Both leave 2 % of the light open, in which the middle is uncertain.
        assert!(outcome.best.total.middle() > best - 0.01, "{best}: {outcome:?}");
        assert!(outcome.keeps_limits && !outcome.was_stopped);
        let start = search.objective().start().total.middle();
        assert!(outcome.best.total.middle() > start + 0.01, "{start}: {:?}", outcome.best.total);
        let rises = outcome.curve.windows(2).all(|pair| pair[0].total < pair[1].total);
        assert!(rises && outcome.curve.len() > 1, "{:?}", outcome.curve);
        // The design is the one that was appraised.
        let Cut::RoundBrilliant(cut) = &outcome.design.cut else { panic!("another cut") };
        let pavilion = outcome.values[1];
        assert!(matches!(cut.pavilion, Pavilion::Angle(angle) if (angle - pavilion).abs() < 1e-12));
    }
}

#[test]
fn angles_end_on_the_scale_of_a_machine_and_lose_little() {
    let goal = goal(&[("return-cos2", 1.0)]);
    let design = brilliant(34.53, 40.77);
    let of = |angle_step_deg: Option<f64>| {
        let options = SearchOptions { angle_step_deg, ..ROUGH };
        let search = DesignSearch::new(&design, &goal, options, &unwatched).unwrap();
        let start = search.objective().start().total.middle();
        (search.run(&unwatched, &|_| {}).unwrap(), start)
    };
    let (free, start) = of(None);
    for step in [0.1, 0.25] {
        let (snapped, _) = of(Some(step));
        for value in &snapped.values {
            let steps = value / step;
            assert!((steps - steps.round()).abs() < 1e-6, "{value} is no multiple of {step}");
        }
        let [free, snapped] = [&free, &snapped].map(|outcome| outcome.best.total.middle() - start);
        assert!(snapped > 0.8 * free && free > 0.01, "{snapped} instead of {free}");
    }
    assert!(free.values.iter().any(|value| (value * 10.0 - (value * 10.0).round()).abs() > 1e-3));
}

#[test]
fn a_search_that_names_no_number_leaves_outline_and_girdle_as_they_are() {
    let usual = |name: &str| {
        let cut = &brillianteer_cut::FAMILIES.iter().find(|family| family.key == name).unwrap().first;
        let keys =
            |all: Vec<VariedNumber>| -> Vec<String> { all.iter().map(|n| n.key.to_string()).collect() };
        (keys(VariedNumber::usual(cut)), keys(VariedNumber::given_by(cut)))
    };
    let (usual_ones, given) = usual("emerald");
    for held in ["length_to_width", "corner", "girdle_thickness"] {
        assert!(!usual_ones.contains(&held.to_owned()) && given.contains(&held.to_owned()), "{held}");
    }
    for free in ["table", "crown_angle", "crown_step", "pavilion_angle", "pavilion_step", "keel"] {
        assert!(usual_ones.contains(&free.to_owned()), "{free}: {usual_ones:?}");
    }
    assert!(
        usual("oval").0.contains(&"table".to_owned()) && !usual("oval").0.contains(&"fullness".to_owned())
    );
}

#[test]
fn limits_of_geometry_are_kept() {
    let mut goal = goal(&[("return-cos2", 1.0)]);
    let design = brilliant(34.0, 41.0);
    let (_, free) = searched(&design, &goal);
    goal.limit.insert("height_to_width".to_owned(), AtLeastAtMost { at_least: None, at_most: Some(0.57) });
    let (search, held) = searched(&design, &goal);
    let height = |outcome: &super::SearchOutcome| outcome.best.figures[0].1;
    assert!(held.keeps_limits && height(&held) <= 0.57 + 1e-9, "{held:?}");
    let (of_free, of_held) = (free.best.total.middle(), held.best.total.middle());
    assert!(of_held < of_free - 1e-3, "limits cost something: {of_free} {of_held} {:?}", free.values);
    assert!(held.best.total.middle() >= search.objective().start().total.middle());
}

/// A low crown returns more light, and is a class or two below the best.
#[test]
fn a_search_lowers_the_estimated_class_only_where_it_may() {
    let mut goal = goal(&[("return-cos2", 1.0)]);
    let design = Design { material: MaterialRef::Name("diamond".to_owned()), ..brilliant(34.5, 40.8) };
    goal.vary.remove("pavilion_angle");
    let classes = |goal: &Goal| {
        let (search, outcome) = searched(&design, goal);
        assert!(outcome.best.total.middle() > search.objective().start().total.middle(), "{outcome:?}");
        estimated_classes(&search, &outcome).unwrap()
    };
    let [before, after] = classes(&goal);
    assert!(before == CutClass::Excellent && after == before, "{before} {after}");
    goal.limit.insert("lower_class".to_owned(), AtLeastAtMost { at_least: None, at_most: Some(4.0) });
    let [before, after] = classes(&goal);
    assert!(after > before, "{before} {after}");
}

/// A goal of the most leakage loses all return, unless a limit keeps the return.
#[test]
fn what_may_not_be_lost_is_kept() {
    let mut goal = goal(&[("leakage", 1.0), ("return-even", 0.0)]);
    let design = brilliant(34.0, 41.0);
    let (search, free) = searched(&design, &goal);
    let start = search.objective().start().values[1].value;
    assert!(start.least - free.best.values[1].value.least > 0.04, "{:?}", free.best.values);
    goal.measure[1].may_lose = Some(0.02);
    let (_, held) = searched(&design, &goal);
    // Beside what may be lost, both figures leave 2 % open.
    assert!(held.best.values[1].value.least > start.least - 0.02 - 0.02, "{:?}", held.best.values);
    assert!(held.best.total.middle() < free.best.total.middle());
}

/// With three numbers the search climbs by slopes as well.
#[test]
fn a_search_by_slopes_is_better_than_its_start_and_about_as_good_as_one_without() {
    let mut goal = goal(&[("return-cos2", 1.0)]);
    goal.vary.insert("table".to_owned(), [50.0, 62.0]);
    let design = brilliant(34.0, 41.0);
    let [with, without] = [true, false].map(|by_slopes| {
        let options = SearchOptions { by_slopes, ..ROUGH };
        let search = DesignSearch::new(&design, &goal, options, &unwatched).unwrap();
        assert!(search.objective().has_slopes());
        search.run(&unwatched, &|_| {}).unwrap()
    });
    let start =
        Objective::new(&design, &goal, false, (0.005, 0.005), &unwatched).unwrap().start().total.middle();
    let [with, without] = [with, without].map(|outcome| outcome.best.total.middle());
    assert!(with > start + 0.02 && without > start + 0.02, "{start} {with} {without}");
    assert!((with - without).abs() < 0.02, "{with} {without}");
}

#[test]
fn a_limit_that_nothing_keeps_leaves_the_design_as_it_is() {
    let mut goal = goal(&[("return-cos2", 1.0)]);
    goal.measure[0].at_least = Some(0.99);
    let design = brilliant(34.0, 41.0);
    let (_, outcome) = searched(&design, &goal);
    assert!(!outcome.keeps_limits && outcome.design == design && outcome.curve.is_empty());
}

#[test]
fn a_compromise_weighs_every_material_and_tilt() {
    let mut goal = goal(&[("return-cos2", 1.0)]);
    let materials = ["quartz", "sapphire"].map(|name| GoalMaterial::Name(name.to_owned()));
    let materials = materials.into_iter().chain([GoalMaterial::Index(2.16)]).collect();
    goal.measure[0].material = Some(OneOrMore::More(materials));
    goal.measure[0].tilt = Some(OneOrMore::More(vec![0.0, 10.0]));
    goal.measure[0].may_lose = Some(0.0);
    // Only the limits of the goal, none of the shape.
    goal.new_findings = true;
    let objective = Objective::new(&brilliant(34.0, 41.0), &goal, false, (0.02, 0.02), &unwatched).unwrap();
    let start = objective.start();
    assert_eq!(start.values.len(), 6);
    let mean: f64 = start.values.iter().map(|value| value.value.middle() / 6.0).sum();
    assert!((start.total.middle() - mean).abs() < 1e-12);
    assert_eq!(start.slacks.len(), 6);
    assert!(start.slacks.iter().all(|slack| slack.abs() < 1e-12), "{:?}", start.slacks);
    let different =
        |a: usize, b: usize| (start.values[a].value.middle() - start.values[b].value.middle()).abs();
    assert!(different(0, 2) > 1e-3 && different(0, 1) > 1e-3);
}

#[test]
fn a_search_that_is_stopped_hands_out_the_best_so_far() {
    let search =
        DesignSearch::new(&brilliant(26.0, 42.5), &goal(&[("return-cos2", 1.0)]), ROUGH, &unwatched).unwrap();
    let asked = AtomicUsize::new(0);
    let seen: Mutex<Vec<f64>> = Mutex::default();
    let report = |progress: &SearchProgress| {
        assert!((0.0..=1.0).contains(&progress.part));
        seen.lock().unwrap().extend(progress.new_best.as_ref().and(progress.best_total));
    };
    let watch = |_: f64| {
        let found_better = seen.lock().unwrap().len() > 1;
        asked.fetch_add(1, Ordering::Relaxed);
        if found_better { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let outcome = search.run(&watch, &report).unwrap();
    assert!(outcome.was_stopped && asked.load(Ordering::Relaxed) > 1);
    assert_eq!(outcome.curve.len(), seen.lock().unwrap().len());
    assert!(outcome.best.total.middle() >= search.objective().start().total.middle());
    let whole = search.run(&unwatched, &|_| {}).unwrap();
    // A search that was stopped does not measure its design again more finely.
    assert!(outcome.best.total.error() > 1.5 * whole.best.total.error(), "{outcome:?} {whole:?}");
    assert!(!whole.was_stopped && whole.appraised > outcome.appraised);
}

#[test]
fn what_cannot_be_sought_is_refused() {
    let refused = |change: fn(&mut Goal)| {
        let mut goal = goal(&[("return-cos2", 1.0)]);
        change(&mut goal);
        let design = brilliant(34.0, 41.0);
        Objective::new(&design, &goal, true, (0.05, 0.05), &unwatched).err().expect("a refusal").to_string()
    };
    let range = |goal: &mut Goal, key: &str| goal.vary.insert(key.to_owned(), [1.0, 2.0]);
    for (told, words) in [
        (refused(|goal| goal.measure.clear()), "at least one [[measure]]"),
        (refused(|goal| goal.vary = [("crown_angle".into(), [36.0, 38.0])].into()), "widen the range"),
        (refused(|goal| goal.vary = [("tilt".into(), [0.0, 1.0])].into()), "no number of a design"),
        (refused(|goal| goal.vary = [("crown_angel".into(), [30.0, 38.0])].into()), "no such proportion"),
        (refused(|goal| goal.vary = [("tier:P1".into(), [30.0, 38.0])].into()), "no tiers"),
        (
            refused(|goal| {
                let limit = AtLeastAtMost { at_least: Some(1.0), at_most: None };
                goal.limit.insert("weight".into(), limit);
            }),
            "there is no such figure; the design has above_critical",
        ),
    ] {
        assert!(told.contains(words), "{told}");
    }
    let mut culet = goal(&[("return-cos2", 1.0)]);
    range(&mut culet, "culet");
    assert!(Objective::new(&brilliant(34.0, 41.0), &culet, true, (0.05, 0.05), &unwatched).is_err());
    let mut planes = brilliant(34.0, 41.0);
    planes.cut = Cut::Planes(planes.facets().unwrap());
    let free = Goal::of([("return-cos2".parse().unwrap(), 1.0)]);
    let found = Objective::new(&planes, &free, true, (0.05, 0.05), &unwatched);
    assert!(!matches!(found, Err(SearchError::Stopped)));
}
