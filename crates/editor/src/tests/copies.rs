//! Tests of copies of a glass shape, moved as a person moves them.

use super::Bench;
use super::light_and_glass::pick;
use crate::editor::Editor;
use crate::setup::Setup;
use brillianteer_render::{Quality, Steps};
use brillianteer_scene::{Copies, Mipmap, Panorama, Pose};
use brillianteer_scene::{Look, Smoothing};
use brillianteer_session::model::{
    action::{Edit, FileAction},
    dialog::{Dialog, Then},
    eye::Eye,
    motion::Motion,
    plan::export_plan,
    preset::Preset,
    workspace::{PaneLayout, Workspace},
};
use brillianteer_session::shows::Shows;
use brillianteer_session::studio::{Which, hung};
use brillianteer_session::tasks::export_scene::SceneOut;
use egui::{Key, Pos2};
use egui_kittest::kittest::Queryable;
use std::path::PathBuf;
use std::sync::Arc;

/// Opens a scene, of the program's own or from a file, in a single render view.
pub(super) fn bench(scene: &str) -> Bench {
    let [render, ..] = Workspace::default().panes;
    let workspace = Workspace { layout: PaneLayout::One, panes: [render; 4], ..Workspace::default() };
    let setup = Setup { file: Some(PathBuf::from(scene)), workspace, ..Setup::default() };
    let mut bench = Bench::sized(setup, egui::vec2(860.0, 1240.0));
    bench.wait(|editor| editor.model.session.awaited.opening.is_empty());
    bench.harness.run_steps(3);
    bench
}

fn poses(editor: &Editor) -> Vec<brillianteer_scene::Pose> {
    editor.model.document.work.copies.poses.clone()
}

/// Returns the place in the window of a point of the film.
pub(super) fn at(bench: &Bench, x: f64, y: f64) -> Pos2 {
    let body = bench.harness.get_by_label("Render picture").rect();
    let film = bench.editor().model.session.ordered.shots[0].1.film;
    let pixel = film.pixels_from_image(glam::DMat2::IDENTITY).transform_point2(glam::DVec2::new(x, y));
    body.min + egui::vec2(pixel.x as f32, pixel.y as f32)
}

pub(super) fn drag(bench: &mut Bench, from: Pos2, by: egui::Vec2) {
    let (button, modifiers) = (egui::PointerButton::Primary, egui::Modifiers::NONE);
    bench.harness.hover_at(from);
    bench.harness.step();
    bench.harness.event(egui::Event::PointerButton { pos: from, button, pressed: true, modifiers });
    bench.harness.step();
    for k in 1..=8 {
        bench.harness.hover_at(from + by * (k as f32 / 8.0));
        bench.harness.step();
    }
    let pos = from + by;
    bench.harness.event(egui::Event::PointerButton { pos, button, pressed: false, modifiers });
    bench.harness.run_steps(3);
}

#[test]
fn a_preset_is_one_click_and_its_copies_are_dragged_scattered_and_counted() {
    let mut bench = bench("prism-rainbow");
    assert_eq!(poses(bench.editor()).len(), 4);
    bench.click("Subtle pill");
    let settings = &bench.editor().model.document.work.settings;
    assert_eq!(
        (settings.look.background.clone(), settings.look.background_mm, settings.look.strength),
        (Some("page".into()), Some(35.0), 0.035)
    );
    let before = poses(bench.editor());
    let (lean, middle) = (bench.editor().model.workspace.eye.lean, before[2].at);
    let from = at(&bench, middle.x, middle.y);
    let pixel = bench.editor().model.session.ordered.shots[0].1.film.pixel;
    drag(&mut bench, from, egui::vec2(40.0, -25.0));
    let after = poses(bench.editor());
    assert!((after[2].at - before[2].at - glam::DVec3::new(40.0, 25.0, 0.0) * pixel).length() < 1e-5);
    assert!(
        [0, 1, 3].iter().all(|&k| after[k] == before[k]) && bench.editor().model.workspace.eye.lean == lean
    );
    bench.harness.key_press_modifiers(egui::Modifiers::COMMAND, Key::Z);
    bench.harness.run_steps(3);
    assert_eq!(poses(bench.editor()), before, "a drag is one step");
    // A drag beside all copies turns the view.
    let beside = at(&bench, 0.0, 1.65);
    drag(&mut bench, beside, egui::vec2(30.0, 0.0));
    assert!(poses(bench.editor()) == before && bench.editor().model.workspace.eye.lean != lean);
    bench.harness.key_press(Key::Space);
    bench.harness.run_steps(3);
    let scattered = poses(bench.editor());
    assert!(scattered != before && scattered.len() == 4);
    bench.click("Scatter");
    assert_ne!(poses(bench.editor()), scattered);
    bench.type_number("Copies", "7");
    assert_eq!(poses(bench.editor()).len(), 7);
}

#[test]
fn what_moves_is_shown_moving_and_stands_still_when_stopped() {
    let mut bench = bench("rotating-cube");
    assert!(bench.editor().model.session.motion.is_on);
    bench.harness.state_mut().model.document.work.settings.look.smoothing =
        Smoothing::Temporal { newest: 0.5 };
    let pictures = |bench: &Bench| {
        let shown = &bench.editor().views.gallery.traced[&(0, Which::Present)];
        (shown.shot.copies.clone(), shown.taken.image.clone())
    };
    bench.wait(|editor| editor.views.gallery.traced.contains_key(&(0, Which::Present)));
    let first = pictures(&bench);
    let later = first.0.clone();
    bench.wait(move |editor| {
        editor.views.gallery.traced.get(&(0, Which::Present)).is_some_and(|shown| shown.shot.copies != later)
    });
    let second = pictures(&bench);
    assert!(first.0 != second.0 && first.1 != second.1);
    bench.harness.key_press(Key::M);
    bench.harness.run_steps(3);
    assert!(!bench.editor().model.session.motion.is_on);
    let (seconds, ordered) =
        (bench.editor().model.session.motion.seconds, bench.editor().model.session.ordered.clone());
    bench.harness.run_steps(5);
    assert!(
        seconds > 0.0
            && bench.editor().model.session.motion.seconds == seconds
            && bench.editor().model.session.ordered == ordered
    );
    bench.click("Reset pose");
    assert_eq!(bench.editor().model.session.motion.seconds, 0.0);
    bench.harness.key_press(Key::H);
    bench.harness.run_steps(3);
    assert!(bench.harness.query_by_label("Copies").is_none(), "views alone");
}

#[test]
fn plates_tumble_and_wave_or_do_what_their_row_says() {
    let mut bench = bench("wavy-plate");
    bench.harness.state_mut().model.session.motion = Motion::at(0.9);
    let shown = |bench: &mut Bench| {
        bench.harness.run_steps(3);
        let shot = &bench.editor().model.session.ordered.shots[0].1;
        let rest = &bench.editor().model.document;
        let is_turned = |(now, rest): (&Pose, &Pose)| now.turn.angle_between(rest.turn) > 0.2;
        let turned = shot.copies.iter().zip(&rest.work.copies.poses).all(is_turned);
        (turned, shot.specimen.design.cut != rest.specimen().design.cut)
    };
    assert_eq!(shown(&mut bench), (true, true));
    for (movement, seen) in [("wave", (false, true)), ("tumble", (true, false))] {
        pick(&mut bench, "Movement", movement);
        assert_eq!(shown(&mut bench), seen, "{movement}");
    }
    bench.harness.key_press_modifiers(egui::Modifiers::COMMAND, Key::Z);
    assert_eq!(shown(&mut bench), (false, true), "undone");
    // The scene file keeps it.
    let folder = tempfile::tempdir().unwrap();
    let mut plan = export_plan(&bench.editor().model);
    (plan.folder, plan.stem) = (folder.path().to_owned(), "mine".to_owned());
    SceneOut::of(&plan).write().unwrap();
    let again = Preset::read(&folder.path().join("mine-scene.toml")).unwrap();
    assert_eq!(again.copies.movement, brillianteer_scene::Movement::Wave);
    // What has no wave has no such row.
    bench.click("Rotating cube");
    bench.harness.run_steps(3);
    assert!(bench.harness.query_by_label("Movement").is_none());
}

/// Returns the place of each copy relative to the first, in mm, and its rotation.
fn arrangement(copies: &Copies, unit_mm: f64) -> Vec<(glam::DVec3, glam::DQuat)> {
    let first = copies.poses[0].at;
    copies.poses.iter().map(|pose| ((pose.at - first) * unit_mm, pose.turn)).collect()
}

#[test]
fn copies_are_saved_as_a_scene_that_is_opened_again_as_it_was() {
    let scenes = [
        ("rotating-cube", 1.3, 0.3),
        ("wavy-plate", 0.4, 0.3),
        ("plate", 0.4, 0.0),
        ("modern-ideal", 0.0, 0.3),
    ];
    for (scene, seconds, turn) in scenes {
        let folder = tempfile::tempdir().unwrap();
        let mut bench = bench(scene);
        bench.harness.state_mut().model.session.motion = Motion::at(seconds);
        bench.harness.state_mut().model.workspace.eye.turn = turn;
        bench.harness.state_mut().model.document.work.settings.look.background.get_or_insert("page".into());
        bench.harness.state_mut().model.workspace.panes[0].is_near = scene == "wavy-plate";
        if scene == "plate" {
            bench.harness.state_mut().model.document.work.copies.poses.truncate(1);
        }
        // One copy lies behind the others, so that the centre of all copies is not that of the first.
        if let [.., last] = &mut bench.harness.state_mut().model.document.work.copies.poses[1..] {
            last.at.z -= 3.0;
        }
        bench.harness.run_steps(2);
        let mut plan = export_plan(&bench.editor().model);
        (plan.folder, plan.stem) = (folder.path().to_owned(), "mine".to_owned());
        SceneOut::of(&plan).write().unwrap();
        let again = Preset::read(&folder.path().join("mine-scene.toml")).unwrap();
        let shot = &plan.shot;
        let is_alone = scene == "modern-ideal";
        assert_eq!(again.scene.stones.len(), if ["plate", "modern-ideal"].contains(&scene) { 1 } else { 4 });
        let kept =
            |look: &Look| (look.background.clone(), look.strength, look.exposure, look.glow, look.bounces);
        assert_eq!(kept(&again.scene.look), kept(&shot.look));
        assert!(again.design == if is_alone { &plan.upright } else { &shot.specimen }.design);
        assert_eq!(again.scene.angle_of_view.is_some(), scene == "wavy-plate");
        let unit_mm = shot.specimen.unit_mm();
        // The background is as far from each stone as before.
        let farther = again.scene.look.background_mm.unwrap() / unit_mm - hung(shot);
        let deeper = again.copies.poses[0].at.z - shot.copies[0].at.z;
        assert!((farther + deeper).abs() < 1e-9, "{scene}: {farther} {deeper}");
        assert_eq!(shot.view.turn, glam::DQuat::from_rotation_z(turn));
        let poses = shot.copies.iter().map(|pose| Pose::turned(shot.view.turn).after(pose)).collect();
        let shown = arrangement(&Copies { poses, ..Copies::default() }, unit_mm);
        for ((at, turn), (there, turned)) in arrangement(&again.copies, unit_mm).into_iter().zip(shown) {
            assert!(at.distance(there) < 1e-9 && turn.dot(turned).abs() > 1.0 - 1e-12, "{at} {there}");
        }
    }
}

#[test]
fn a_scene_is_seen_in_its_perspective_and_the_next_design_as_before() {
    let sight = |bench: &Bench| {
        let Workspace { panes, distance, eye, .. } = &bench.editor().model.workspace;
        (panes[0].is_near, *distance, bench.editor().model.document.work.settings.look.smoothing, *eye)
    };
    let text =
        "format = 1\nname = \"Near\"\nangle_of_view = 45\nexposure = 0.5\nstone = [{ cut = \"cube\" }]";
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("near.toml");
    std::fs::write(&path, text).unwrap();
    let mut bench = bench(path.to_str().unwrap());
    let reach = bench.editor().model.reach(Shows::Render);
    let (is_near, distance, smoothing, eye) = sight(&bench);
    assert!(is_near && (distance * 22.5_f64.to_radians().tan() / reach - 1.0).abs() < 1e-9, "{distance}");
    assert_eq!((smoothing, eye), (Smoothing::None, Eye::default()));
    assert_eq!(bench.editor().model.document.work.settings.look.exposure, 0.5);
    // The next preset has its own, and a design has the program's.
    let light = |bench: &Bench| {
        let settings = &bench.editor().model.document.work.settings;
        (settings.look.light.clone(), settings.look.exposure, settings.look.bounces)
    };
    bench.harness.state_mut().model.document.work.settings.look.bounces = 3;
    bench.harness.state_mut().act(FileAction::Ask(Then::Preset("free-diamond".to_owned())));
    bench.harness.run_steps(3);
    assert_eq!(light(&bench), ("city".to_owned(), 1.5, 64));
    bench.harness.state_mut().act(FileAction::Ask(Then::Library("modern-ideal".to_owned())));
    bench.harness.run_steps(3);
    assert_eq!(light(&bench), ("studio".to_owned(), 0.0, 64));
    assert_eq!((sight(&bench).0, sight(&bench).1), (false, Workspace::default().distance));
}

#[test]
fn whoever_holds_a_copy_that_goes_lets_go_of_it() {
    let mut bench = bench("cube");
    bench.leave_one();
    bench.harness.state_mut().act(Edit::LayOut(4));
    bench.harness.run_steps(3);
    let last = poses(bench.editor())[3].at;
    let (pos, button) = (at(&bench, last.x, last.y), egui::PointerButton::Primary);
    let modifiers = egui::Modifiers::NONE;
    bench.harness.hover_at(pos);
    bench.harness.step();
    bench.harness.event(egui::Event::PointerButton { pos, button, pressed: true, modifiers });
    bench.harness.step();
    for k in 1..=3 {
        bench.harness.hover_at(pos + egui::vec2(8.0 * k as f32, 0.0));
        bench.harness.step();
    }
    assert_eq!(bench.editor().model.session.held, Some((0, 3)));
    bench.harness.state_mut().model.document.work.copies = Copies::default();
    bench.harness.hover_at(pos + egui::vec2(40.0, 0.0));
    bench.harness.step();
    assert_eq!(bench.editor().model.session.held, None);
    assert_eq!(bench.editor().model.document.work.copies, Copies::default());
}

#[test]
fn turning_all_keeps_copies_apart_and_the_hand_on_the_one_it_holds() {
    let mut bench = bench("subtle-pill");
    let shown = |bench: &Bench| -> Vec<Pose> {
        let shot = &bench.editor().model.session.ordered.shots[0].1;
        shot.copies.iter().map(|pose| Pose::turned(shot.view.turn).after(pose)).collect()
    };
    let before = shown(&bench);
    bench.harness.state_mut().model.workspace.eye.turn = 1.2;
    bench.harness.run_steps(2);
    let turned = shown(&bench);
    for (k, pose) in turned.iter().enumerate() {
        for (other, was) in turned[..k].iter().zip(&before) {
            assert!((other.at.distance(pose.at) - was.at.distance(before[k].at)).abs() < 1e-12);
            assert!(pose.turn.angle_between(other.turn) < 1e-7);
        }
    }
    let (middle, pixel) = (turned[2].at, bench.editor().model.session.ordered.shots[0].1.film.pixel);
    let from = at(&bench, middle.x, middle.y);
    drag(&mut bench, from, egui::vec2(40.0, -25.0));
    let moved = shown(&bench)[2].at - middle;
    assert!((moved - glam::DVec3::new(40.0, 25.0, 0.0) * pixel).length() < 1e-5, "{moved}");
}

#[test]
fn zooming_shows_the_same_light_nearer_and_another_design_is_seen_as_physics() {
    let mut bench = bench("subtle-pill");
    let seen = |bench: &Bench| {
        let shot = bench.editor().model.session.ordered.shots[0].1.clone();
        let page = Panorama { width: 2, height: 2, pixels: vec![[1.0; 3]; 4] };
        let page = Arc::new(Mipmap::new(page));
        let job = shot.light_job(Some(page), 1, Steps::Strips, Quality::of_pictures(true));
        let width = job.lit().unwrap().environment.backplate.unwrap().width;
        (width, shot.film.pixel, shot.look.strength)
    };
    let before = seen(&bench);
    bench.harness.state_mut().model.workspace.eye.zoom_at(4.0, glam::DVec2::new(0.8, 0.3));
    bench.harness.run_steps(2);
    let after = seen(&bench);
    assert!(after.0 == before.0 && after.1 < before.1 && before.2 == 0.035);
    bench.harness.state_mut().act(FileAction::Ask(Then::Library("modern-ideal".to_owned())));
    bench.harness.run_steps(2);
    assert_eq!(seen(&bench).2, 1.0);
}

#[test]
fn a_preset_after_a_drag_asks_nothing_and_undo_brings_back_what_was_there() {
    let mut bench = bench("rotating-cube");
    bench.harness.state_mut().model.session.motion.rest();
    let strength = |bench: &Bench| bench.editor().model.document.work.settings.look.strength;
    bench.click("Prism rainbow");
    bench.click("Scatter");
    bench.type_number("Glow", "0.35");
    bench.type_number("Index", "1.61");
    let before = bench.editor().model.document.work.clone();
    bench.click("Subtle pill");
    assert!(bench.editor().model.session.dialog.is_none() && strength(&bench) == 0.035);
    assert_ne!(bench.editor().model.document.work.settings.look.glow, 0.35, "a preset brings its own");
    assert!(!bench.editor().model.document.is_changed() && !bench.editor().model.document.has_moved_copies());
    let undo = |bench: &mut Bench, modifiers| {
        bench.harness.key_press_modifiers(egui::Modifiers::COMMAND | modifiers, Key::Z);
        bench.harness.run_steps(3);
    };
    undo(&mut bench, egui::Modifiers::NONE);
    assert_eq!(bench.editor().model.document.work, before);
    assert!(bench.editor().model.document.is_changed() && bench.editor().model.document.has_moved_copies());
    undo(&mut bench, egui::Modifiers::SHIFT);
    assert_eq!(strength(&bench), 0.035);
    (0..2).for_each(|_| undo(&mut bench, egui::Modifiers::NONE));
    assert_eq!(bench.editor().model.document.work.settings.look.glow, 0.35, "the steps before are there too");
    // A file would be lost with the places of the copies.
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("other.toml");
    std::fs::write(&path, "format = 1").unwrap();
    let open = FileAction::Ask(Then::open(path));
    undo(&mut bench, egui::Modifiers::NONE);
    bench.harness.state_mut().act(open);
    bench.harness.run_steps(2);
    bench.click("Export…");
    let Some(Dialog::Export(export)) = &bench.editor().model.session.dialog else { panic!() };
    assert!(export.plan.selection.scene);
}
