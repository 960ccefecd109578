//! The map of a measure and the plot against tilt, as a person uses them.

use super::fitting::pick;
use super::*;
use brillianteer_measure::MeasureName;
use brillianteer_session::model::Model;
use egui::{Role, pos2, vec2};

/// The number of points of the first complete level: 5 x 5.
const COARSE: usize = 25;

/// Opens an editor of a large window with a map of the first cut whose coarse places are known.
fn opened() -> Bench {
    let mut bench = Bench::sized(Setup::default(), vec2(1400.0, 1000.0));
    bench.settle();
    bench.choose("View", "Map of a measure");
    known(&mut bench, COARSE);
    bench
}

/// Runs frames until so many places of the present map are known.
fn known(bench: &mut Bench, count: usize) {
    bench.wait(|editor| {
        let sweep = &editor.model.session.map.sweep;
        sweep.is_present() && sweep.found().is_some_and(|found| found.answered >= count)
    });
}

const MAP: &str = "Map: Return, even light over Pavilion angle and Crown angle";

/// Returns a point of the map, in parts of the way across and up the whole picture.
fn point(bench: &Bench, [x, y]: [f32; 2]) -> egui::Pos2 {
    let rect = bench.harness.get_by_role_and_label(Role::Image, MAP).rect();
    pos2(rect.left() + x * rect.width(), rect.bottom() - y * rect.height())
}

fn values(model: &Model) -> [f64; 2] {
    let cut = &model.document.work.design.cut;
    model.session.map.options().unwrap().axes.each_ref().map(|axis| axis.value(cut).unwrap())
}

#[test]
fn a_double_click_on_the_name_of_an_end_sets_it_as_the_map_began() {
    let mut bench = opened();
    let ends = |bench: &Bench| bench.editor().model.session.map.options().unwrap().axes[0].ends;
    let before = ends(&bench);
    let changed = format!("{:.2}", before[0] + 0.25);
    bench.type_number("Least across", &changed);
    assert!(ends(&bench) != before);
    super::row_defaults::double_click_name(&mut bench, Role::SpinButton, "Least across");
    assert_eq!(ends(&bench), before);
}

#[test]
fn a_click_on_the_map_moves_the_design_and_undo_brings_it_back() {
    let mut bench = opened();
    let before = values(&bench.editor().model);
    bench.click_at(point(&bench, [0.5, 0.6]));
    let moved = values(&bench.editor().model);
    assert!(moved != before && bench.editor().model.document.fault().is_none(), "{moved:?}");
    // The middle of the picture is near the middle of both ranges.
    assert!((moved[0] - 41.5).abs() < 1.0 && (moved[1] - 33.0).abs() < 5.0, "{moved:?}");
    let number = |bench: &Bench| bench.editor().model.session.map.sweep.wanted().map(|order| order.number);
    let map = number(&bench);
    bench.choose("Edit", "Undo");
    assert_eq!(values(&bench.editor().model), before);
    assert_eq!(number(&bench), map, "the map stays");
    // A drag over the map is one step too.
    let [from, to] = [[0.4, 0.5], [0.6, 0.7]].map(|part| point(&bench, part));
    bench.harness.drag_at(from);
    bench.harness.run_steps(2);
    for part in [0.3_f32, 0.6, 1.0] {
        bench.harness.hover_at(from + (to - from) * part);
        bench.harness.run_steps(2);
    }
    bench.harness.drop_at(to);
    bench.harness.run_steps(3);
    assert_ne!(values(&bench.editor().model), before);
    bench.choose("Edit", "Undo");
    assert_eq!(values(&bench.editor().model), before);
}

#[test]
fn the_map_says_what_is_under_the_pointer_and_frames_the_published_range() {
    let mut bench = opened();
    assert!(bench.harness.query_by_label_contains("an estimate, not a grade").is_some());
    bench.harness.hover_at(point(&bench, [0.5, 0.5]));
    bench.harness.run_steps(3);
    assert!(bench.harness.query_by_label_contains("% (certainly ").is_some());
    pick(&mut bench, "Across", "Star length");
    assert!(bench.harness.query_by_label_contains("an estimate, not a grade").is_none());
    known(&mut bench, COARSE);
    assert!(
        bench.harness.query_by_label("Map: Return, even light over Star length and Crown angle").is_some()
    );
}

#[test]
fn the_arrow_keys_move_the_design_on_the_map() {
    let mut bench = opened();
    bench.harness.get_by_role_and_label(Role::Image, MAP).focus();
    bench.harness.run_steps(2);
    let before = values(&bench.editor().model);
    bench.harness.key_press(egui::Key::ArrowRight);
    bench.harness.run_steps(2);
    let moved = values(&bench.editor().model);
    assert!(moved[0] > before[0] && moved[1] == before[1], "{before:?} {moved:?}");
}

#[test]
fn the_map_begins_anew_after_a_change_beside_its_axes_and_closes_by_its_key() {
    let mut bench = opened();
    let number = bench.editor().model.session.map.sweep.wanted().unwrap().number;
    bench.type_number("Table", "60");
    known(&mut bench, COARSE);
    assert_ne!(bench.editor().model.session.map.sweep.wanted().unwrap().number, number);
    bench.harness.key_press_modifiers(egui::Modifiers::SHIFT, egui::Key::M);
    bench.harness.run_steps(3);
    assert!(bench.harness.query_by_label(MAP).is_none());
    bench.settle();
}

#[test]
fn a_measure_is_plotted_against_tilt_toward_the_chosen_azimuths() {
    let mut bench = Bench::sized(Setup::default(), vec2(1400.0, 1200.0));
    bench.settle();
    bench.harness.get_by_role_and_label(Role::ComboBox, "Plotted").scroll_to_me();
    bench.harness.run_steps(SCROLLED);
    pick(&mut bench, "Plotted", "Leakage");
    bench.settle();
    let curves = |bench: &Bench| bench.editor().model.session.tilt.curves();
    let found = curves(&bench);
    assert_eq!(bench.editor().model.session.tilt.options.measure, Some(MeasureName::Leakage));
    assert_eq!(found.iter().map(|(azimuth, _)| *azimuth).collect::<Vec<_>>(), [0.0, 45.0]);
    assert!(found.iter().all(|(_, curve)| curve.len() == 25), "{found:?}");
    assert!(bench.harness.query_by_label("Measure against tilt").is_some());
    bench.click("Azimuth 90°");
    bench.settle();
    assert_eq!(curves(&bench).len(), 3);
    let before = curves(&bench);
    bench.type_number("Pavilion angle", "42.5");
    bench.settle();
    assert_ne!(curves(&bench), before, "the curves follow the design");
}
