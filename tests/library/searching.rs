//! A search moves the tiers of cutters' designs along their meets.
#![cfg(feature = "interchange")]

use super::corpus::files;
use brillianteer::base::{Stopped, unwatched};
use brillianteer::cut::{Cut, Design, FindingKind, MaterialRef, SMALL_FACET, SheetFigures, SmallestParts};
use brillianteer::io::{as_tiers, cut_file, design_file, library};
use brillianteer::measure::MeasureSettings;
use brillianteer::optics::line;
use brillianteer::render::{Sweep, SweepAxis, SweepKey, SweepValue, SweptStone, with_numbers};
use brillianteer::scene::{Specimen, Viewpoint};
use brillianteer::search::{DesignSearch, Goal, GoalMeasure, SearchOptions, SearchProgress, VariedNumber};
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// Real designs, where they are there.
const LIBRARY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data/asc/library");

/// Returns a cut of the program as tiers.
fn tiers(name: &str) -> Design {
    let design = cut_file::parse(library::cut(name).unwrap(), name).unwrap();
    let specimen = Specimen::new(design).unwrap();
    let tiers = as_tiers(&specimen).unwrap();
    Design { cut: Cut::Tiers(tiers), ..specimen.design }
}

/// Returns the numbers of facets and corners. A meet that opens becomes several corners.
fn counts(design: &Design) -> (usize, usize) {
    let specimen = Specimen::new(design.clone()).unwrap();
    let stone = specimen.stone().unwrap();
    (stone.polytope.facets().len(), stone.polytope.vertices().len())
}

#[test]
fn tiers_are_better_after_a_search_and_keep_every_meet() {
    let mut designs: Vec<(String, Design)> =
        ["tolkowsky", "single-cut", "hexagon"].map(|name| (name.to_owned(), tiers(name))).into();
    // Of the real designs every twenty-fifth.
    let real =
        files(&["asc"]).into_iter().filter(|file| file.starts_with(Path::new(LIBRARY))).step_by(25).take(10);
    designs.extend(real.map(|file| (file.display().to_string(), design_file::read(&file).unwrap().design)));
    let mut improved = 0;
    for (name, design) in &designs {
        let goal = Goal::of([("return-cos2".parse().unwrap(), 1.0)]);
        let options = SearchOptions {
            unresolved: 0.03,
            scattered: Some(16),
            climbs: 2,
            polarised: false,
            ..SearchOptions::default()
        };
        let search = DesignSearch::new(design, &goal, options, &unwatched)
            .unwrap_or_else(|why| panic!("{name}: {why}"));
        let outcome = search.run(&unwatched, &|_| {}).unwrap();
        let start = search.objective().start().total.middle();
        assert!(outcome.best.total.middle() > start + 0.002, "{name}: {start} {:?}", outcome.best.total);
        improved += 1;
        let objective = search.objective();
        let is_scale = |number: &&VariedNumber| matches!(number.key, SweepKey::Scale(_));
        let scales = objective.numbers().iter().filter(is_scale).count();
        println!(
            "{name}: {start:.3} before, {:.3} after {} designs; {} tiers and {scales} scales change, {} are held",
            outcome.best.total.middle(),
            outcome.appraised,
            objective.numbers().len() - scales,
            objective.held().len()
        );
        // A side moves as a whole where a tier of it cannot move alone.
        assert_eq!(scales > 0, !objective.held().is_empty(), "{name}");
        let [before, after] =
            [objective.design(), &outcome.design].map(|design| objective.miss_of_meets(design));
        assert!(after <= (1.1 * before).max(1e-9), "{name}: {before} {after}");
        assert_eq!(counts(objective.design()).0, counts(&outcome.design).0, "{name}");
        let Cut::Tiers(tiers) = &outcome.design.cut else { panic!("no tiers") };
        let solved = tiers.solved();
        assert_eq!(solved.errors().count(), 0, "{name}");
        for (own, solved) in tiers.tiers.iter().zip(&solved.tiers.tiers) {
            assert!((own.distance - solved.distance).abs() < 1e-9, "{name}: {}", own.name());
        }
    }
    assert_eq!(improved, designs.len(), "designs that are better");
}

#[test]
fn a_search_spoils_no_design_though_its_goal_does_not_say_so() {
    let rough = SearchOptions {
        unresolved: 0.03,
        scattered: Some(16),
        climbs: 1,
        polarised: false,
        ..SearchOptions::default()
    };
    for name in ["single-cut", "hexagon", "trillion"] {
        let design = tiers(name);
        let mut goal = Goal::of([("return-cos2".parse().unwrap(), 1.0)]);
        // Ranges that are wide enough to lose a crown.
        let wide = |number: VariedNumber| {
            let (least, most) = (0.4 * number.start, 2.0 * number.start);
            (number.key.to_string(), [least, most.min(if number.start > 89.0 { most } else { 88.0 })])
        };
        goal.vary = VariedNumber::usual(&design.cut).into_iter().map(wide).collect();
        let search = DesignSearch::new(&design, &goal, rough, &unwatched).unwrap();
        let outcome = search.run(&unwatched, &|_| {}).unwrap();
        assert!(outcome.keeps_limits, "{name}");
        for (kind, [before, after]) in outcome.findings() {
            assert!(after <= before, "{name}: {kind}: {before} before, {after} after");
        }
        let [before, after] = [search.objective().design(), &outcome.design].map(|design| {
            let specimen = Specimen::new(design.clone()).unwrap();
            let stone = specimen.stone().unwrap();
            let girdle = SheetFigures::of(&stone.polytope, stone.names()).girdle_to_width;
            (SmallestParts::of(&stone.polytope), girdle)
        });
        println!("{name}: {before:?}, then {after:?}, {}", outcome.best.total.middle());
        let least = SMALL_FACET.min(0.9 * before.0.facet_percent);
        assert!(after.0.facet_percent >= least - 1e-6, "{name}: {before:?}, {after:?}");
        assert!((after.1 - before.1).abs() <= 0.005 + 1e-9, "{name}: {before:?}, {after:?}");
        // The audit is part of the result.
        let own = Specimen::new(outcome.design.clone()).unwrap().audit().unwrap();
        assert_eq!(own, outcome.audits[1], "{name}");
        let small = outcome.audits[1].of_kind(FindingKind::SmallFacet).count();
        assert!(small <= outcome.audits[0].of_kind(FindingKind::SmallFacet).count(), "{name}");
    }
}

#[test]
fn angles_end_on_their_scale_also_when_a_search_is_stopped() {
    let is_enough = AtomicBool::new(false);
    let watch = |_: f64| match is_enough.load(Ordering::Relaxed) {
        true => ControlFlow::Break(()),
        false => ControlFlow::Continue(()),
    };
    let options = SearchOptions {
        unresolved: 0.02,
        polarised: false,
        angle_step_deg: Some(0.5),
        ..SearchOptions::default()
    };
    // So steep a stone is soon improved.
    let design = brilliant(39.0, 42.7);
    let search = DesignSearch::new(&design, &goal(&[("return-cos2", 1.0)]), options, &unwatched).unwrap();
    let start = search.objective().start().total.middle();
    let report = |progress: &SearchProgress| {
        let is_better = progress.best_total.is_some_and(|best| best > start + 0.01);
        is_enough.fetch_or(is_better && progress.appraised > 20, Ordering::Relaxed);
    };
    let outcome = search.run(&watch, &report).unwrap();
    assert!(outcome.was_stopped && outcome.best.total.middle() > start, "{outcome:?}");
    for value in &outcome.values {
        assert!((value / 0.5 - (value / 0.5).round()).abs() < 1e-6, "{:?}", outcome.values);
    }
}

#[test]
fn a_corner_that_opens_is_counted() {
    let mut design = tiers("tolkowsky");
    let before = counts(&design);
    let Cut::Tiers(tiers) = &mut design.cut else { panic!("no tiers") };
    let place = tiers.tiers.iter().position(|tier| tier.angle < -30.0).unwrap();
    tiers.tiers[place].angle += 1e-4;
    assert!(counts(&design).1 > before.1);
}

/// Returns a brilliant of diamond's index.
fn brilliant(crown: f64, pavilion: f64) -> Design {
    let mut design = cut_file::parse(library::cut("tolkowsky").unwrap(), "tolkowsky").unwrap();
    design.material = MaterialRef::Index(2.417);
    let keys = ["crown_angle", "pavilion_angle"].map(SweepKey::of);
    with_numbers(&design, keys.iter().zip([crown, pavilion])).unwrap()
}

fn goal(of: &[(&str, f64)]) -> Goal {
    let mut goal = Goal::of(of.iter().map(|(name, weight)| (name.parse().unwrap(), *weight)));
    goal.vary =
        [("crown_angle".to_owned(), [24.0, 40.0]), ("pavilion_angle".to_owned(), [38.0, 43.0])].into();
    goal
}

/// Returns the best total of a map over crown and pavilion, and the seconds that the map took. As in a search, the best places are
/// measured again four times finer.
fn map_best(goal: &Goal, steps: usize, unresolved: f64) -> (f64, f64) {
    let begun = Instant::now();
    let values = |[from, to]: [f64; 2]| {
        let at = |k: usize| SweepValue::Number(from + (to - from) * k as f64 / steps as f64);
        (0..=steps).map(at).collect()
    };
    let axis =
        |(key, range): (&String, &[f64; 2])| SweepAxis { key: SweepKey::of(key), values: values(*range) };
    let mut sweep = Sweep {
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
    let total = |found: &SweptStone| -> f64 {
        let value = |measure: &GoalMeasure| measure.weight * measure.of.of(&found.measures).unwrap().middle();
        goal.measure.iter().map(value).sum()
    };
    let mut totals = vec![];
    let each = |point, found: Result<SweptStone, _>| {
        totals.extend(found.ok().map(|found| (total(&found), point)));
        Ok(())
    };
    sweep.run::<Stopped>(0..sweep.count(), &unwatched, each).unwrap();
    let seconds = begun.elapsed().as_secs_f64();
    totals.sort_by(|a, b| b.0.total_cmp(&a.0));
    sweep.unresolved *= 0.25;
    let finely = totals.iter().take(40).map(|(_, point)| total(&sweep.point(*point, 1, &unwatched).unwrap()));
    (finely.fold(f64::NEG_INFINITY, f64::max), seconds)
}

/// The time is that of a map of 65 by 65 points at the same bound, in the same run.
#[test]
#[ignore = "prints figures and times for a person to read"]
fn random_starts_against_a_fine_map() {
    for of in
        [&[("return-cos2", 1.0)][..], &[("return-even", 1.0)], &[("return-even@15", 1.0), ("leakage", -1.0)]]
    {
        let goal = goal(of);
        let (best, seconds) = map_best(&goal, 64, SearchOptions::default().unresolved);
        let found: Vec<(f64, f64)> = (0..20)
            .map(|seed| random_start(&goal, SearchOptions { seed, ..SearchOptions::default() }))
            .collect();
        let missing = |total: f64| 100.0 * (1.0 - total / best);
        let mut misses: Vec<f64> = found.iter().map(|(total, _)| missing(*total)).collect();
        misses.sort_by(f64::total_cmp);
        let reached = misses.iter().filter(|miss| **miss < 0.1).count();
        let longest = found.iter().map(|(_, time)| time / seconds).fold(0.0, f64::max);
        println!(
            "{of:?}: the map has {best:.5} after {seconds:.1} s; {reached} of 20 reach it, the middle one misses {:.3} %, the \
             worst {:.3} %; the longest takes {longest:.3} of the map's time",
            misses[10], misses[19]
        );
    }
}

/// All numbers of a brilliant, with slopes and without them.
#[test]
#[ignore = "prints figures and times for a person to read"]
fn slopes_against_none() {
    let mut goal = Goal::of([("return-cos2".parse().unwrap(), 1.0), ("leakage".parse().unwrap(), -1.0)]);
    for (key, range) in [
        ("table", [50.0, 64.0]),
        ("crown_angle", [24.0, 40.0]),
        ("pavilion_angle", [38.0, 43.0]),
        ("star_length", [40.0, 60.0]),
        ("lower_half_length", [70.0, 88.0]),
    ] {
        goal.vary.insert(key.to_owned(), range);
    }
    for by_slopes in [true, false] {
        let found: Vec<(f64, f64)> = (0..6)
            .map(|seed| random_start(&goal, SearchOptions { seed, by_slopes, ..SearchOptions::default() }))
            .collect();
        println!("by slopes {by_slopes}: total and seconds {found:.4?}");
    }
}

/// Searches from a random brilliant, and returns the total and the seconds that it took.
fn random_start(goal: &Goal, options: SearchOptions) -> (f64, f64) {
    let at = |k: f64| f64::fract(0.37 + options.seed as f64 * (0.618 + 0.31 * k));
    let start = brilliant(24.0 + 16.0 * at(0.0), 38.0 + 5.0 * at(1.0));
    let begun = Instant::now();
    let search = DesignSearch::new(&start, goal, options, &unwatched).unwrap();
    let found = search.run(&unwatched, &|_| {}).unwrap();
    (found.best.total.middle(), begun.elapsed().as_secs_f64())
}
