//! Tests of the rows for metal and rings, found by their accessible names as a person with a screen reader finds them.

use super::Bench;
use super::copies::{at, bench, drag};
use super::light_and_glass::pick;
use crate::editor::Editor;
use brillianteer_math::bounds;
use brillianteer_optics::Metal;
use brillianteer_scene::{MetalInstance, Projection, RingStyle, SceneRing};
use brillianteer_session::model::{
    Model,
    action::FileAction,
    dialog::{Dialog, Then},
    plan::export_plan,
    recovery::KeptCompanions,
    task::Task,
    update,
    work::Work,
    workspace::Workspace,
};
use brillianteer_session::studio::{Shot, Which};
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;
use glam::DVec3;
use std::path::Path;

const REDO: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);

fn work(bench: &Bench) -> &Work {
    &bench.editor().model.document.work
}

fn ring(bench: &Bench) -> &SceneRing {
    work(bench).companions.ring.as_ref().unwrap()
}

fn body(bench: &Bench) -> &MetalInstance {
    &work(bench).companions.metals[ring(bench).metal]
}

/// Returns the last order of the render.
fn shot(bench: &Bench) -> &Shot {
    &bench.editor().model.session.ordered.shots[0].1
}

fn press_z(bench: &mut Bench, modifiers: Modifiers) {
    bench.harness.key_press_modifiers(modifiers, Key::Z);
    bench.harness.run_steps(3);
}

fn is_fitted(model: &Model) -> bool {
    let ring = model.document.work.companions.ring.as_ref();
    ring.map(|ring| &ring.made_of) == model.document.ring_plan().as_ref()
}

/// Returns whether the ring has the metal of its present numbers and stones.
fn has_followed(editor: &Editor) -> bool {
    is_fitted(&editor.model) && editor.model.session.ring.asked.is_none()
}

/// Returns half the width of the band along the finger, in mm.
fn half_width(bench: &Bench) -> f64 {
    bounds(body(bench).mesh.surface().points.iter().copied()).1.y
}

/// Unfolds the rows for the numbers of the ring.
fn unfold(bench: &mut Bench) {
    bench.click("Numbers of the ring");
    bench.harness.run_steps(super::SCROLLED);
}

/// Asserts that each seat of the ring holds one stone, as large as the seat.
fn assert_seated(bench: &Bench) {
    let Work { copies, companions, .. } = work(bench);
    let unit = bench.editor().model.document.specimen().unit_mm();
    let own = copies.poses.iter().map(|pose| (pose.at * unit, unit));
    let others = companions.stones.iter().map(|stone| (stone.pose.at, stone.pose.scale));
    let stones: Vec<(DVec3, f64)> = own.chain(others).collect();
    let (ring, pose) = (ring(bench), body(bench).pose);
    assert_eq!(stones.len(), ring.seats.len());
    for seat in ring.seats.iter() {
        let at = pose.place(seat.pose.at);
        let held = stones
            .iter()
            .filter(|(place, radius)| place.distance(at) < 1e-9 && (radius - seat.pose.scale).abs() < 1e-9);
        assert_eq!(held.count(), 1, "{at}");
    }
}

/// Exports the scene alone by the dialog, and returns the path of its file.
fn exported(bench: &mut Bench, folder: &Path) -> std::path::PathBuf {
    bench.choose("File", "Export…");
    let Some(Dialog::Export(export)) = &mut bench.harness.state_mut().model.session.dialog else { panic!() };
    export.plan.folder = folder.to_owned();
    (export.plan.selection.views, export.plan.stem) = (vec![], "mine".to_owned());
    bench.harness.run_steps(2);
    bench.click("Scene file and its cuts");
    bench.click("Write files");
    bench.wait(|editor| matches!(&editor.model.session.dialog, Some(Dialog::Export(e)) if !e.is_busy()));
    let Some(Dialog::Export(export)) = &bench.editor().model.session.dialog else { panic!() };
    assert_eq!(export.run.as_ref().and_then(|run| run.end.clone()), Some(Ok(())));
    bench.click("Close");
    folder.join("mine-scene.toml")
}

/// Opens a scene file in an editor of its own, and waits until its metal is there.
fn reopened(path: &Path) -> Bench {
    let mut bench = bench(&path.to_string_lossy());
    bench.wait(|editor| !editor.model.document.work.companions.metals.is_empty());
    bench
}

#[test]
fn another_metal_and_roughness_are_drawn_undone_saved_and_there_again() {
    let folder = tempfile::tempdir().unwrap();
    let mut ring_bench = bench("four-prong");
    let bench_ = &mut ring_bench;
    let finish = |bench: &Bench| (body(bench).metal, body(bench).roughness);
    assert_eq!(finish(bench_), (Metal::Gold, 0.1));
    pick(bench_, "Metal", "silver");
    bench_.type_number("Roughness", "0.35");
    assert_eq!(finish(bench_), (Metal::Silver, 0.35));
    bench_.wait(|editor| {
        let shown = editor.views.gallery.traced.get(&(0, Which::Present));
        shown.is_some_and(|shown| {
            let metal = &shown.shot.companions.metals[0];
            (metal.metal, metal.roughness) == (Metal::Silver, 0.35)
        })
    });
    press_z(bench_, Modifiers::COMMAND);
    assert_eq!(finish(bench_), (Metal::Silver, 0.1));
    press_z(bench_, Modifiers::COMMAND);
    assert_eq!(finish(bench_), (Metal::Gold, 0.1));
    assert_eq!(bench_.editor().model.document.steps(), (false, true));
    (0..2).for_each(|_| press_z(bench_, REDO));
    assert_eq!(finish(bench_), (Metal::Silver, 0.35));
    let path = exported(bench_, folder.path());
    assert!(!bench_.editor().model.document.has_moved_copies(), "it is saved");
    // Nothing else of the scene is lost.
    let again = reopened(&path);
    assert_eq!(finish(&again), (Metal::Silver, 0.35));
    assert_eq!(ring(&again).ring, ring(bench_).ring);
    assert!(ring(&again).ring.style == RingStyle::FourProng && is_fitted(&again.editor().model));
    let (now, before) = (shot(&again), shot(bench_));
    assert_eq!((now.look.exposure, now.look.light_turn), (before.look.exposure, before.look.light_turn));
    let distance = |shot: &Shot| match shot.view.projection {
        Projection::Perspective { distance } => distance,
        other => panic!("{other:?} is no perspective"),
    };
    assert!((distance(now) / distance(before) - 1.0).abs() < 1e-9);
    let colours = "#3a2f2a-#120e0c";
    let behind = |shot: &Shot| shot.look.background.as_ref().map(ToString::to_string);
    assert_eq!((behind(now).as_deref(), behind(before).as_deref()), (Some(colours), Some(colours)));
    assert_eq!(work(&again).design, work(bench_).design);
    assert!(work(&again).copies.poses[0].at.distance(work(bench_).copies.poses[0].at) < 1e-9);
}

#[test]
fn bodies_of_metal_have_rows_of_their_own_unless_they_are_alike() {
    let folder = tempfile::tempdir().unwrap();
    let plate = |name: &str| {
        std::fs::write(folder.path().join(name), "v 0 0 0\nv 4 0 0\nv 0 8 0\nf 1 2 3\n").unwrap();
        format!("[[metal]]\nmesh = \"{name}\"\nmetal = \"gold\"\nat = [0, 0, -20]\n")
    };
    let metals = [plate("a.obj"), plate("a.obj").replace("-20", "-25"), plate("b.obj")].concat();
    let path = folder.path().join("mine.toml");
    let stone = "[[stone]]\ncut = \"tolkowsky\"\n";
    std::fs::write(&path, format!("format = 1\nname = \"Mine\"\n{stone}{metals}")).unwrap();
    let mut bench = reopened(&path);
    assert!(bench.harness.query_by_label("2 × a.obj").is_some());
    assert!(bench.harness.query_by_label("Numbers of the ring").is_none(), "no ring is here");
    pick(&mut bench, "Metal 1", "rhodium");
    bench.type_number("Roughness 2", "0");
    let finishes: Vec<_> =
        work(&bench).companions.metals.iter().map(|body| (body.metal, body.roughness)).collect();
    assert_eq!(finishes, [(Metal::Rhodium, 0.1), (Metal::Rhodium, 0.1), (Metal::Gold, 0.0)]);
}

#[test]
fn a_number_of_a_ring_makes_other_metal_in_one_step_of_undo() {
    let mut bench = bench("four-prong");
    let before = (half_width(&bench), ring(&bench).clone(), work(&bench).copies.clone());
    unfold(&mut bench);
    assert!(bench.harness.query_by_label("Small stones").is_none(), "this style has none");
    bench.type_number("Band width", "6.2");
    bench.type_number("Band thickness", "2.4");
    bench.wait(has_followed);
    assert!((half_width(&bench) - 3.1).abs() < 0.05, "{}", half_width(&bench));
    // Before, the head was wider than the band.
    assert!(before.0 < 3.0, "{}", before.0);
    assert_seated(&bench);
    // The thicker band carries the stone farther out.
    assert!(work(&bench).copies.poses[0].at.distance(before.2.poses[0].at) > 0.1);
    bench.wait(|editor| {
        let shown = editor.views.gallery.traced.get(&(0, Which::Present));
        shown.is_some_and(|shown| shown.shot.companions == editor.model.companions())
    });
    // The metal has joined the steps of the numbers: no step leads to numbers without their metal.
    press_z(&mut bench, Modifiers::COMMAND);
    bench.wait(has_followed);
    assert_eq!(
        (ring(&bench).ring.thickness_mm, ring(&bench).ring.width_mm),
        (before.1.ring.thickness_mm, 6.2)
    );
    press_z(&mut bench, Modifiers::COMMAND);
    bench.wait(has_followed);
    assert!(*ring(&bench) == before.1 && half_width(&bench) == before.0 && work(&bench).copies == before.2);
    assert_eq!(bench.editor().model.document.steps(), (false, true));
    (0..2).for_each(|_| press_z(&mut bench, REDO));
    assert_eq!(ring(&bench).ring.thickness_mm, 2.4);
    bench.wait(has_followed);
    assert!((half_width(&bench) - 3.1).abs() < 0.05 && !bench.editor().model.document.has_unsettled());
    assert_seated(&bench);
}

#[test]
fn numbers_that_make_no_ring_are_explained_and_the_metal_stays() {
    let folder = tempfile::tempdir().unwrap();
    let mut bench_ = bench("four-prong");
    let before = half_width(&bench_);
    unfold(&mut bench_);
    bench_.type_number("Comfort", "1.5");
    bench_.wait(|editor| editor.model.ring_fault().is_some());
    let said = bench_.harness.query_by_label_contains("The metal stays as it was. Comfort: the inside rises");
    assert!(said.is_some() && half_width(&bench_) == before && !is_fitted(&bench_.editor().model));
    // A scene file describes the metal that is there.
    let path = exported(&mut bench_, folder.path());
    let again = reopened(&path);
    assert!(work(&again).companions.ring.is_none() && work(&again).companions.metals.len() == 1);
    press_z(&mut bench_, Modifiers::COMMAND);
    assert!(bench_.editor().model.ring_fault().is_none() && is_fitted(&bench_.editor().model));
    assert!(bench_.harness.query_by_label_contains("The metal stays").is_none());
}

#[test]
fn a_ring_follows_its_stones_and_holds_as_many_small_ones_as_fit() {
    let mut bench_ = bench("halo-ring");
    assert_seated(&bench_);
    let main = work(&bench_).design.diameter_mm;
    bench_.type_number("Diameter", "8.4");
    bench_.wait(has_followed);
    let count = work(&bench_).companions.stones.len();
    assert!(main < 7.0 && count > 16, "a wider stone has a longer halo, not {count}");
    assert_seated(&bench_);
    unfold(&mut bench_);
    bench_.type_number("Small stones", "1.2");
    bench_.wait(has_followed);
    let small = &work(&bench_).companions.stones;
    assert!(small.len() > count && small.iter().all(|stone| stone.specimen.design.diameter_mm == 1.2));
    assert_seated(&bench_);
    // The small stones are edited in turn, and the ring still knows which are which.
    let label = {
        let design = &small[0].specimen.design;
        format!("Edit {} × diamond, 1.20 mm, {}", small.len(), design.name)
    };
    bench_.click(&label);
    assert!(is_fitted(&bench_.editor().model));
    bench_.type_number("Diameter", "1.6");
    bench_.wait(has_followed);
    assert_eq!(ring(&bench_).made_of.ring.small_diameter_mm, 1.6);
    assert_seated(&bench_);
    let folder = tempfile::tempdir().unwrap();
    let path = exported(&mut bench_, folder.path());
    let again = reopened(&path);
    assert!(is_fitted(&again.editor().model) && ring(&again).ring.small_diameter_mm == 1.6);
    assert_eq!(ring(&again).seats.len(), ring(&bench_).seats.len());
    assert_seated(&again);
}

#[test]
fn a_ring_holds_its_stones_against_drags() {
    let mut bench = bench("four-prong");
    bench.wait(|editor| editor.views.gallery.traced.contains_key(&(0, Which::Present)));
    let before = work(&bench).copies.clone();
    let stone = shot(&bench).copies[0].at;
    let from = at(&bench, stone.x, stone.y);
    drag(&mut bench, from, egui::vec2(30.0, 10.0));
    assert!(work(&bench).copies == before && bench.editor().model.session.held.is_none());
}

#[test]
fn metal_of_a_ring_that_was_recovered_is_made_anew() {
    let mut model = Model::new(Workspace::default()).unwrap();
    let begun = update(&mut model, FileAction::Ask(Then::Preset("four-prong".to_owned())).into());
    assert!(!begun.iter().any(|task| matches!(task, Task::MakeRing(..))), "the file's metal is there");
    let companions = &model.document.work.companions;
    let text = serde_json::to_string(&KeptCompanions::of(companions)).unwrap();
    let built = serde_json::from_str::<KeptCompanions>(&text).unwrap().built().unwrap();
    let kept = built.ring.clone().unwrap();
    assert!(kept.ring == companions.ring.as_ref().unwrap().ring && kept.seats.len() == 1);
    model.document.work.companions = built;
    let tasks = update(&mut model, brillianteer_session::model::action::NoteAction::DismissAll.into());
    let plan = tasks.iter().find_map(|task| match task {
        Task::MakeRing(_, plan) => Some(plan),
        _ => None,
    });
    assert!(plan.is_some_and(|plan| plan.ring == kept.ring && plan.stone.is_some()));
    assert!(export_plan(&model).ring().is_none(), "until then it is a mesh");
}

#[test]
fn colours_of_a_plain_background_are_picked() {
    let mut bench = bench("subtle-pill");
    let behind = |bench: &Bench| shot(bench).look.background.as_ref().map(ToString::to_string);
    pick(&mut bench, "Background", "two colours");
    bench.pick_colour("Upper colour", [200, 40, 10]);
    bench.pick_colour("Lower colour", [5, 60, 120]);
    assert_eq!(behind(&bench).as_deref(), Some("#c8280a-#053c78"));
    assert!(bench.harness.query_by_label("Strength").is_none(), "colours hang nowhere");
    pick(&mut bench, "Background", "one colour");
    bench.pick_colour("Back colour", [1, 2, 3]);
    assert_eq!(behind(&bench).as_deref(), Some("#010203"));
    bench.look();
    let picture = bench.picture(0);
    assert_eq!(picture[0], [1, 2, 3, 255], "the corner shows the background");
}
