//! Tests of the map of a measure and of the plot against tilt: the sweeps that they request, and the moves of the
//! design on the map.

use super::*;
use crate::model::measure_map::MapOptions;
use crate::model::motion::WaveCache;
use crate::model::ordering::Orders;
use crate::studio::SweptPoint;
use brillianteer_base::{Stopped, unwatched};
use brillianteer_cut::Cut;
use brillianteer_measure::MeasureName;
use std::sync::Arc;

/// Returns the numbers of the sweeps that are requested now.
fn ordered(bench: &Bench) -> Vec<u64> {
    let mut waves = WaveCache::default();
    let mut orders = Orders { model: &bench.model, waves: &mut waves, paper: Paper::default() };
    orders.all(&[]).sweeps.iter().map(|order| order.number).collect()
}

/// Measures the first points of the map that is wanted.
fn first_points(bench: &Bench, count: usize) -> (u64, Vec<SweptPoint>) {
    let order = bench.model.session.map.sweep.wanted().unwrap();
    let mut found = vec![];
    let points = order.points[..count].iter().copied();
    order
        .sweep
        .run::<Stopped>(points, &unwatched, |point, result| {
            found.push((point, Arc::new(result)));
            Ok(())
        })
        .unwrap();
    (order.number, found)
}

fn angles(bench: &Bench) -> [f64; 2] {
    let cut = &bench.model.document.work.design.cut;
    bench.model.session.map.options().unwrap().axes.each_ref().map(|axis| axis.value(cut).unwrap())
}

#[test]
fn a_map_is_ordered_while_it_is_open_and_a_click_on_it_is_a_step_that_undo_takes_back() {
    let mut bench = Bench::new();
    assert!(ordered(&bench).is_empty());
    bench.act(Command::Map);
    let number = ordered(&bench);
    assert_eq!(number.len(), 1);
    let before = bench.model.document.work.clone();
    // A drag is a row of moves, and one step.
    for to in [[41.0, 33.0], [41.2, 33.5], [41.3, 32.0]] {
        bench.act(Edit::Along(to));
        bench.end_frame(true);
        assert_eq!(ordered(&bench), number, "the map stays while the design moves on it");
    }
    bench.end_frame(false);
    assert_eq!(angles(&bench), [41.3, 32.0]);
    let radius = |bench: &Bench| bench.model.document.specimen().reach;
    assert!(radius(&bench) > 0.0 && bench.model.document.fault().is_none());
    bench.act(Command::Undo);
    assert_eq!(bench.model.document.work, before);
    assert_eq!(ordered(&bench), number);
    bench.act(Command::Redo);
    assert_eq!(angles(&bench), [41.3, 32.0]);
    bench.act(Command::Map);
    assert!(ordered(&bench).is_empty());
}

#[test]
fn points_of_a_map_that_a_change_beside_it_has_outdated_are_dropped() {
    let mut bench = Bench::new();
    bench.act(Command::Map);
    let (old, found) = first_points(&bench, 3);
    let mut cut = bench.model.document.work.design.cut.clone();
    cut.proportion("table").unwrap().set(&mut cut, 60.0);
    bench.act(Edit::Proportion("table", cut));
    assert_ne!(ordered(&bench), [old]);
    bench.act(Computed::Swept(old, found));
    assert!(bench.model.session.map.sweep.found().is_none());
    let (new, found) = first_points(&bench, 3);
    bench.act(Computed::Swept(new, found));
    assert!(bench.model.session.map.sweep.found().is_some_and(|found| found.answered == 3));
    // The map of the table is that of the design before the change.
    bench.act(Command::Undo);
    assert!(!bench.model.session.map.sweep.is_present());
}

#[test]
fn a_place_without_a_stone_leaves_the_design_and_says_why() {
    let mut bench = Bench::new();
    bench.act(Command::Map);
    let before = bench.model.document.work.clone();
    bench.act(Edit::Along([41.0, 89.0]));
    assert_eq!(bench.model.document.work, before);
    let said = bench.model.session.notes.said().unwrap_or_default();
    assert!(said.starts_with("The design stays: no stone there: "), "{said}");
    // A map that was never open moves nothing either.
    let mut other = Bench::new();
    other.act(Edit::Along([41.0, 33.0]));
    assert!(matches!(other.model.document.work.design.cut, Cut::RoundBrilliant(_)));
    assert_eq!(other.model.document.work, Bench::new().model.document.work);
}

#[test]
fn another_document_has_a_map_of_its_own_of_the_same_measure() {
    let mut bench = Bench::new();
    bench.act(Command::Map);
    let options = bench.model.session.map.options().unwrap().clone();
    bench.act(ViewAction::Map(MapOptions { measure: MeasureName::Fire, ..options }));
    let before = ordered(&bench);
    bench.act(FileAction::Ask(Then::Library("emerald".to_owned())));
    let options = bench.model.session.map.options().unwrap();
    assert_eq!(options.measure, MeasureName::Fire);
    let cut = &bench.model.document.work.design.cut;
    assert!(options.axes.iter().all(|axis| axis.value(cut).is_some()), "{options:?}");
    assert_ne!(ordered(&bench), before);
    // A stone that is not convex has no map.
    bench.act(FileAction::Ask(Then::Library("pill".to_owned())));
    assert!(ordered(&bench).is_empty());
}

#[test]
fn a_measure_of_what_an_eye_resolves_is_swept_anew_and_others_are_known_from_it() {
    let mut bench = Bench::new();
    bench.act(Command::Map);
    let options = bench.model.session.map.options().unwrap().clone();
    let choose = |bench: &mut Bench, measure: MeasureName| {
        bench.act(ViewAction::Map(MapOptions { measure, ..options.clone() }));
        ordered(bench)
    };
    let first = choose(&mut bench, MeasureName::Leakage);
    let eye = choose(&mut bench, MeasureName::PatchSize);
    let rocked = choose(&mut bench, MeasureName::Scintillation);
    assert!(first != eye && eye != rocked, "{first:?} {eye:?} {rocked:?}");
    assert_eq!(choose(&mut bench, MeasureName::PatchSize), rocked);
    assert_eq!(choose(&mut bench, MeasureName::Fire), rocked);
}

#[test]
fn a_measure_against_tilt_follows_the_stone() {
    let mut bench = Bench::new();
    let mut options = bench.model.session.tilt.options.clone();
    options.measure = Some(MeasureName::Leakage);
    bench.act(ViewAction::Tilt(options.clone()));
    let first = ordered(&bench);
    assert_eq!(first.len(), 1);
    bench.act(Edit::Name("another".into()));
    assert_eq!(ordered(&bench), first, "a name is no other stone");
    bench.act(Edit::Diameter(9.0));
    let second = ordered(&bench);
    assert!(second.len() == 1 && second != first);
    options.azimuths = Default::default();
    bench.act(ViewAction::Tilt(options));
    assert!(ordered(&bench).is_empty(), "without an azimuth there is no curve");
}
