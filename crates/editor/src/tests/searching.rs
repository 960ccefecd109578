//! The search for a better cut, as a person uses it: by the names in its window.

use super::fitting::pick;
use super::*;
use brillianteer_cut::Design;
use brillianteer_session::model::cut_search::{EndedSearch, SearchEnd, SearchState};
use egui::{Role, vec2};
use egui_kittest::kittest::NodeT;
use std::path::Path;

/// Opens an editor of a large window with the window of the search.
fn opened(setup: Setup) -> Bench {
    let mut bench = Bench::sized(setup, vec2(1000.0, 680.0));
    bench.settle();
    bench.choose("View", "Find a better cut");
    bench
}

fn design(bench: &Bench) -> &Design {
    &bench.editor().model.document.work.design
}

fn state(editor: &Editor) -> &SearchState {
    &editor.model.session.search.state
}

fn ended(bench: &Bench) -> &EndedSearch {
    match state(bench.editor()) {
        SearchState::Ended(ended) => ended,
        other => panic!("{other:?}"),
    }
}

/// Chooses a search over the pavilion angle alone that is soon over.
fn quick(bench: &mut Bench) {
    pick(bench, "Effort", "quick");
    bench.click("Vary Crown angle");
    let numbers = &bench.editor().model.session.search.form.numbers;
    assert!(numbers.iter().any(|number| number.name == "Crown angle" && !number.is_varied), "the click hits");
}

/// Opens a design that is easy to improve.
fn opened_steep_deep() -> Bench {
    let file = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("cuts/steep-deep.toml");
    opened(Setup { file: Some(file), ..Setup::default() })
}

/// Begins a search that takes long in a design that is easy to improve, and waits for a better design.
fn begun() -> Bench {
    let mut bench = opened_steep_deep();
    pick(&mut bench, "Effort", "thorough");
    bench.click("All");
    bench.click("Start");
    bench.wait(|editor| {
        let running = editor.model.session.search.running();
        running.is_some_and(|running| running.curve.len() > 1 && running.shown() != running.before())
    });
    bench
}

/// Returns the design with which the search that is under way has begun.
fn given(bench: &Bench) -> Design {
    bench.editor().model.session.search.running().unwrap().before().clone()
}

fn undo(bench: &mut Bench) {
    bench.harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::Z);
    bench.harness.run_steps(3);
}

fn steps(bench: &Bench) -> (bool, bool) {
    bench.editor().model.document.steps()
}

#[test]
fn a_search_shows_its_best_in_the_design_says_what_it_won_and_is_one_step_of_undo() {
    let mut bench = opened(Setup::default());
    let before = design(&bench).clone();
    quick(&mut bench);
    bench.type_number("Greatest Pavilion angle", "43");
    bench.click("Start");
    assert!(
        bench.harness.query_by_label("Stop").is_some() && bench.harness.query_by_label("Start").is_none()
    );
    bench.wait(|editor| matches!(state(editor), SearchState::Ended(_)));
    let SearchEnd::Found(report) = &ended(&bench).end else { panic!("{:?}", ended(&bench).end) };
    assert!(report.is_better() && report.outcome.best.total.least > report.start.total.most);
    let after = design(&bench).clone();
    assert_eq!(after, ended(&bench).after);
    assert!(after != before && bench.editor().model.document.fault().is_none());
    assert_eq!(bench.editor().model.document.specimen().design, after, "the views show it");
    for label in ["Won", "Pavilion angle", "Return, light by cosine²", "Keep"] {
        assert!(bench.harness.query_all_by_label(label).next().is_some(), "{label}");
    }
    assert!(bench.harness.query_by_label_contains("Progress of the search: ").is_some());
    bench.click("Keep");
    assert!(bench.harness.query_by_label("Start").is_some());
    bench.choose("Edit", "Undo");
    assert_eq!(*design(&bench), before);
    assert_eq!(steps(&bench), (false, true), "the search is one step");
    bench.choose("Edit", "Redo");
    assert_eq!(*design(&bench), after);
}

#[test]
fn the_outcome_is_taken_back_by_its_own_button() {
    let mut bench = opened_steep_deep();
    let before = design(&bench).clone();
    quick(&mut bench);
    bench.click("Start");
    bench.wait(|editor| matches!(state(editor), SearchState::Ended(_)));
    assert_ne!(*design(&bench), before);
    bench.click("Undo search");
    assert_eq!(*design(&bench), before);
    assert_eq!(steps(&bench), (false, true));
}

#[test]
fn a_search_that_is_stopped_keeps_the_best_so_far() {
    let mut bench = begun();
    let before = given(&bench);
    assert!(bench.harness.query_by_label_contains("designs tried; the goal has grown from").is_some());
    bench.click("Stop");
    bench.wait(|editor| matches!(state(editor), SearchState::Ended(_)));
    let SearchEnd::Found(report) = &ended(&bench).end else { panic!("{:?}", ended(&bench).end) };
    assert!(report.outcome.was_stopped);
    assert_eq!(*design(&bench), ended(&bench).after);
    undo(&mut bench);
    assert_eq!(*design(&bench), before);
}

#[test]
fn a_search_that_is_discarded_leaves_no_trace() {
    let mut bench = begun();
    let before = given(&bench);
    assert_ne!(*design(&bench), before);
    bench.click("Discard");
    assert_eq!(*design(&bench), before);
    assert!(bench.harness.query_by_label("Start").is_some());
    bench.settle();
    assert_eq!((design(&bench), steps(&bench)), (&before, (false, false)), "later answers are dropped");
}

#[test]
fn an_edit_stops_the_search_and_both_are_steps_of_undo() {
    let mut bench = begun();
    let before = given(&bench);
    bench.type_number("Table", "60");
    let changed = design(&bench).clone();
    assert!(matches!(ended(&bench).end, SearchEnd::Interrupted));
    assert!(bench.harness.query_by_label_contains("because the design was changed").is_some());
    let found = ended(&bench).after.clone();
    bench.settle();
    assert_eq!(*design(&bench), changed, "nothing more comes of the search");
    bench.choose("Edit", "Undo");
    assert_eq!(*design(&bench), found);
    bench.choose("Edit", "Undo");
    assert_eq!(*design(&bench), before);
}

#[test]
fn undo_in_a_search_ends_it_and_takes_it_back() {
    let mut bench = begun();
    let before = given(&bench);
    undo(&mut bench);
    assert!(matches!(ended(&bench).end, SearchEnd::Interrupted));
    assert_eq!((design(&bench), steps(&bench)), (&before, (false, true)));
}

#[test]
fn another_exposure_does_not_stop_a_search_and_is_a_step_of_its_own() {
    let mut bench = begun();
    let before = given(&bench);
    bench.change_look(|look| look.exposure = 1.0);
    bench.harness.run_steps(3);
    assert!(bench.editor().model.session.search.running().is_some());
    bench.click("Discard");
    assert_eq!(*design(&bench), before);
    assert_eq!(bench.editor().model.document.work.settings.look.exposure, 1.0);
    bench.choose("Edit", "Undo");
    assert_eq!(bench.editor().model.document.work.settings.look.exposure, 0.0);
}

#[test]
fn another_document_ends_the_search() {
    let mut bench = begun();
    use brillianteer_session::model::{action::FileAction, dialog::Then};
    bench.harness.state_mut().act(FileAction::Ask(Then::Library("oval".to_owned())));
    bench.harness.run_steps(4);
    bench.click("Don't save");
    bench.settle();
    let oval = design(&bench).clone();
    assert!(matches!(state(bench.editor()), SearchState::Choosing));
    assert!(bench.harness.query_by_label("Vary Pavilion angle").is_some());
    bench.settle();
    assert_eq!(*design(&bench), oval);
}

#[test]
fn the_window_says_what_is_missing_and_why_glass_cannot_be_searched() {
    let mut bench = opened(Setup::default());
    bench.click("None");
    assert!(bench.harness.query_by_label_contains("Tick at least one number").is_some());
    assert!(bench.field(Role::Button, "Start").accesskit_node().is_disabled());
    bench.click("All");
    assert!(!bench.field(Role::Button, "Start").accesskit_node().is_disabled());
    let cuts = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("cuts");
    let bench = opened(Setup { file: Some(cuts.join("pill.toml")), ..Setup::default() });
    assert!(
        bench.harness.query_by_label_contains("Only a convex stone between planes can be searched").is_some()
    );
    assert!(bench.harness.query_by_label("Start").is_none());
}

/// Opens the stone of the first design as a mesh, whose tiers cannot move alone.
fn opened_mesh(folder: &Path) -> Bench {
    let file = folder.join("stone.stl");
    let stone = brillianteer_session::model::document::Document::first().unwrap().specimen().clone();
    brillianteer_files::design_file::write(&stone, brillianteer_files::design_file::DesignFormat::Stl, &file)
        .unwrap();
    opened(Setup { file: Some(file), ..Setup::default() })
}

#[test]
fn a_mesh_is_searched_by_the_scales_of_its_sides_and_its_tiers_are_held() {
    let folder = tempfile::tempdir().unwrap();
    let mut bench = opened_mesh(folder.path());
    pick(&mut bench, "Effort", "quick");
    bench.click("Start");
    bench.wait(|editor| matches!(state(editor), SearchState::Ended(_)));
    let SearchEnd::Found(report) = &ended(&bench).end else { panic!("{:?}", ended(&bench).end) };
    let keys: Vec<String> = report.numbers.iter().map(|number| number.key.to_string()).collect();
    assert_eq!(keys, ["crown_scale", "pavilion_scale"]);
    assert!(report.held.len() > 4 && report.is_better(), "{report:?}");
    assert!(bench.harness.query_all_by_label_contains("Scale of the pavilion").next().is_some());
}

#[test]
fn a_mesh_none_of_whose_numbers_can_move_says_so_and_stays() {
    let folder = tempfile::tempdir().unwrap();
    let mut bench = opened_mesh(folder.path());
    let before = design(&bench).clone();
    for side in ["crown", "pavilion"] {
        let tick = format!("Vary Scale of the {side}");
        bench.click(&tick);
    }
    bench.click("Start");
    bench.wait(|editor| matches!(state(editor), SearchState::Ended(_)));
    assert!(matches!(ended(&bench).end, SearchEnd::Failed(_)), "{:?}", ended(&bench).end);
    assert!(bench.harness.query_by_label_contains("has no numbers to vary").is_some());
    bench.click("Back");
    assert_eq!(*design(&bench), before);
}

#[test]
fn a_goal_is_saved_and_opened_again() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("goal.toml");
    let mut bench = opened(Setup::default());
    bench.click("Add measure");
    pick(&mut bench, "Measure 2", "Leakage");
    pick(&mut bench, "Wanted 2", "less");
    bench.type_number("Weight 2", "0.5");
    bench.type_number("At most 2", "4");
    bench.type_number("Greatest Crown angle", "36");
    bench.choices.lock().unwrap().push(file.clone());
    bench.click("Save goal…");
    bench.wait(|_| brillianteer_paper::goal_file::read(&file).is_ok());
    let goal = brillianteer_paper::goal_file::read(&file).unwrap();
    assert_eq!((goal.measure[1].weight, goal.measure[1].at_most), (-0.5, Some(0.04)));
    assert_eq!(goal.vary["crown_angle"][1], 36.0);
    let mut bench = opened(Setup::default());
    bench.choices.lock().unwrap().push(file.clone());
    bench.click("Open goal…");
    bench.wait(|editor| editor.model.session.search.form.wanted() == Ok(goal.clone()));
    // A limit that is emptied is none.
    let field = bench.field(Role::SpinButton, "At most 2");
    field.focus();
    bench.harness.run_steps(2);
    bench.harness.get_by_role_and_label(Role::SpinButton, "At most 2").click();
    bench.harness.run_steps(2);
    bench.harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::A);
    bench.harness.key_press(egui::Key::Delete);
    bench.harness.run_steps(1);
    bench.harness.key_press(egui::Key::Enter);
    bench.harness.run_steps(3);
    assert_eq!(bench.editor().model.session.search.form.goal.measure[1].at_most, None);
}
